#include "runtime/render/measure_picture.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/render/image.hpp"
#include "runtime/render/studio.hpp"
#include "runtime/render/text.hpp"

namespace garment::render {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kWidth = 1600, kHeight = 1100, kCaption = 60;
constexpr int kFrontWidth = 1000;  // of the front view, with its labels; the side view takes the rest
constexpr double kDot = 1.9;       // of the lettering
constexpr double kDistance = 14;   // m, from the eye to the body: nearly parallel rays
constexpr Rgb kGirth{176, 58, 46}, kLength{38, 84, 140}, kInk{60, 64, 72}, kLeader{150, 152, 158};

/// A view with its place in the picture.
struct Pane {
  Camera camera;
  int left = 0, width = 0, height = 0;

  Vector2d project(const Vector3d& p) const {
    const Vec3 d = p.cast<float>() - camera.eye;
    const float depth = d.dot(camera.forward);
    const float u = d.dot(camera.right) / depth, v = d.dot(camera.up) / depth;
    return {left + width * (u - camera.left_edge) / (camera.right_edge - camera.left_edge),
            height * (camera.top_edge - v) / (camera.top_edge - camera.bottom_edge)};
  }
  double depth(const Vector3d& p) const { return (p.cast<float>() - camera.eye).dot(camera.forward); }
};

/// Looks along `-out` at `target`; `high` metres fill the height of the pane.
Pane make_pane(const Vec3& out, const Vec3& target, double high, int left, int width, int height) {
  Pane pane{{}, left, width, height};
  Camera& c = pane.camera;
  c.eye = target + static_cast<float>(kDistance) * out;
  c.forward = -out;
  c.right = c.forward.cross(Vec3(0, 1, 0));
  c.up = Vec3(0, 1, 0);
  c.top_edge = static_cast<float>(0.5 * high / kDistance);
  c.bottom_edge = -c.top_edge;
  c.right_edge = c.top_edge * static_cast<float>(width) / static_cast<float>(height);
  c.left_edge = -c.right_edge;
  return pane;
}

void draw_line(Image& image, const Vector2d& a, const Vector2d& b, double width, Rgb color, double opacity) {
  const Vector2d low = a.cwiseMin(b).array() - width, high = a.cwiseMax(b).array() + width, along = b - a;
  const double length2 = along.squaredNorm();
  for (int j = static_cast<int>(low.y()); j <= static_cast<int>(high.y()); ++j)
    for (int i = static_cast<int>(low.x()); i <= static_cast<int>(high.x()); ++i) {
      const Vector2d p(i + 0.5, j + 0.5);
      const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
      const double away = (p - a - t * along).norm();
      image.blend(i, j, color, opacity * std::clamp(0.5 * width + 0.5 - away, 0.0, 1.0));
    }
}

/// The far half of a ring shows through the body faintly.
void draw_course(Image& image, const Pane& pane, const TapeCourse& tape) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : tape.course) middle += p / static_cast<double>(tape.course.size());
  const std::size_t n = tape.course.size(), segments = tape.closed ? n : n - 1;
  for (std::size_t k = 0; k < segments; ++k) {
    const Vector3d &a = tape.course[k], &b = tape.course[(k + 1) % n];
    const bool far = tape.closed && pane.depth(0.5 * (a + b)) > pane.depth(middle);
    draw_line(image, pane.project(a), pane.project(b), far ? 1.5 : 2.6, tape.closed ? kGirth : kLength,
              far ? 0.35 : 1);
  }
}

/// Labels in one column, each near the height of what it names, none over another.
class Column {
 public:
  Column(double edge, bool right_aligned) : edge_(edge), right_aligned_(right_aligned) {}
  void add(const std::string& text, const Vector2d& target, Rgb color) {
    rows_.push_back({text, target, color, 0});
  }
  void draw(Image& image) {
    constexpr double kRow = 11 * kDot;
    std::stable_sort(rows_.begin(), rows_.end(),
                     [](const Row& a, const Row& b) { return a.target.y() < b.target.y(); });
    double next = 14;
    for (Row& row : rows_) row.y = next = std::max(next, row.target.y()), next += kRow;
    double lowest = kHeight - kCaption - 14;
    for (auto row = rows_.rbegin(); row != rows_.rend(); ++row)
      row->y = lowest = std::min(lowest, row->y), lowest -= kRow;
    for (const Row& row : rows_) {
      const double width = text_width(row.text, kDot), x = right_aligned_ ? edge_ - width : edge_;
      const double from = right_aligned_ ? edge_ + 8 : edge_ - 8, bend = from + (right_aligned_ ? 30 : -30);
      draw_line(image, {from, row.y}, {bend, row.target.y()}, 1.2, kLeader, 0.9);
      draw_line(image, {bend, row.target.y()}, row.target, 1.2, kLeader, 0.9);
      draw_text(image, x, row.y - 3.5 * kDot, row.text, kDot, row.color);
    }
  }

 private:
  struct Row {
    std::string text;
    Vector2d target;
    Rgb color;
    double y;
  };
  double edge_;
  bool right_aligned_;
  std::vector<Row> rows_;
};

/// The place of the course that lies farthest to the left or to the right of the picture.
Vector2d outermost(const Pane& pane, const TapeCourse& tape, bool left) {
  Vector2d best = pane.project(tape.course.front());
  for (const Vector3d& p : tape.course) {
    const Vector2d q = pane.project(p);
    if (left ? q.x() < best.x() : q.x() > best.x()) best = q;
  }
  return best;
}

}  // namespace

std::string render_measures(const body::TriangleMesh& mesh, const std::vector<TapeCourse>& tapes,
                            const std::string& caption) {
  if (mesh.triangles.empty()) return {};
  body::Body body;
  body.mesh = mesh;
  Scene scene = make_scene({}, {}, {body});
  scene.low = Vec3::Constant(1e30f), scene.high = -scene.low;
  for (const Vector3d& p : mesh.vertices) {
    scene.low = scene.low.cwiseMin(p.cast<float>());
    scene.high = scene.high.cwiseMax(p.cast<float>());
  }
  scene.floor_y = scene.low[1];
  const Vec3 target = 0.5f * (scene.low + scene.high);
  const int height = kHeight - kCaption;
  const double body_high = scene.high[1] - scene.low[1], wide = scene.high[0] - scene.low[0];
  // The front view leaves 2 x 190 pixels for labels.
  const double high = std::max(1.1 * body_high, 1.02 * wide * height / (kFrontWidth - 380));
  const Pane front = make_pane({0, 0, 1}, target, high, 0, kFrontWidth, height);
  const Pane side = make_pane({1, 0, 0}, target, high, kFrontWidth, kWidth - kFrontWidth, height);

  const std::vector<float> no_values;
  const Tracer tracer(scene, no_values);
  Image image(kWidth, kHeight, {236, 237, 239});
  for (const Pane* pane : {&front, &side})
    image.paste(photograph(scene, tracer, pane->camera, pane->width, pane->height, {}), pane->left, 0);
  Column levels(180, true), lengths(kFrontWidth - 210, false), behind(kWidth - 200, false);
  for (const TapeCourse& tape : tapes) {
    if (tape.course.size() < 2) continue;
    if (tape.closed || !tape.from_side) draw_course(image, front, tape);
    if (tape.closed || tape.from_side) draw_course(image, side, tape);
    if (tape.closed) {
      const double x = tape.course.front().x();
      const bool arm = std::fabs(x) > 0.2 && std::all_of(tape.course.begin(), tape.course.end(),
                                                         [&](const Vector3d& p) { return p.x() * x > 0; });
      (arm && x > 0 ? lengths : levels).add(tape.label, outermost(front, tape, !(arm && x > 0)), kGirth);
    } else if (tape.from_side) {
      behind.add(tape.label, side.project(tape.course[tape.course.size() / 2]), kLength);
    } else {
      lengths.add(tape.label, front.project(tape.course[tape.course.size() / 2]), kLength);
    }
  }
  levels.draw(image), lengths.draw(image), behind.draw(image);
  draw_text(image, 24, kHeight - 0.5 * kCaption - 3.5 * kDot, caption, kDot, kInk);
  return encode_png(image);
}

}  // namespace garment::render
