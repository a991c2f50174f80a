#include "runtime/render/studio.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"

namespace garment::render {
namespace {

constexpr std::size_t kRows = 8;        // rows of one chunk of parallel work
constexpr float kEdgeContrast = 0.03f;  // of displayed brightness, above which a pixel is sampled again

/// Eight rooks: one sample in every row and column of an 8 x 8 pixel.
constexpr std::array<std::array<float, 2>, 8> kRooks = {{{0.0625f, 0.4375f},
                                                         {0.1875f, 0.9375f},
                                                         {0.3125f, 0.1875f},
                                                         {0.4375f, 0.6875f},
                                                         {0.5625f, 0.3125f},
                                                         {0.6875f, 0.8125f},
                                                         {0.8125f, 0.0625f},
                                                         {0.9375f, 0.5625f}}};

class Photograph {
 public:
  Photograph(const Scene& scene, const Tracer& tracer, const Camera& camera, int width, int height,
             const Look& look)
      : tracer_(tracer), camera_(camera), width_(width), height_(height), look_(look), light_(scene, camera) {
    const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    hits_.resize(n);
    seen_.resize(n);
    scratch_.resize(n);
  }

  Image take() {
    for_rows([this](int y) { expose(y); });
    for (int step : {1, 2, 4, 8, 16}) {
      for_rows([this, step](int y) { smooth(y, step); });
      seen_.swap(scratch_);
    }
    Image first(width_, height_);
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) first.at(x, y) = develop(shade_pixel(x, y), x, y);
    });
    Image out = first;
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x)
        if (is_edge(first, x, y)) out.at(x, y) = develop(refine(x, y), x, y);
    });
    return out;
  }

 private:
  template <class Row>
  void for_rows(const Row& row) const {
    parallel_for(static_cast<std::size_t>(height_), kRows, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) row(static_cast<int>(y));
    });
  }

  std::size_t id(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  Vec3 ray(float x, float y) const {
    return camera_.direction(x / static_cast<float>(width_), y / static_cast<float>(height_)).normalized();
  }

  Vec3 background(float y) const { return backdrop(1 - y / static_cast<float>(height_)); }

  /// Rounds by an ordered pattern, so that the slow gradients of paper and cloth show no steps.
  static Rgb develop(const Vec3& color, int x, int y) {
    static constexpr std::array<float, 16> threshold = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    const float t =
        (threshold[static_cast<std::size_t>(y & 3) * 4 + static_cast<std::size_t>(x & 3)] + 0.5f) / 16;
    Rgb out;
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = static_cast<std::uint8_t>(
          std::min(255.0f, std::floor(255 * displayed(color[static_cast<Eigen::Index>(k)]) + t)));
    return out;
  }

  void expose(int y) {
    for (int x = 0; x < width_; ++x) {
      Hit& hit = hits_[id(x, y)];
      hit = tracer_.trace(camera_.eye, ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      seen_[id(x, y)] = hit.surface == Surface::none ? Visibility{} : light_.measure(tracer_, hit, x, y);
    }
  }

  /// How alike the light at two hits must be; 0 across edges.
  static float likeness(const Hit& a, const Hit& b) {
    if (a.surface != b.surface) return 0;
    const float bend = std::max(0.0f, a.normal.dot(b.normal));
    const float reach = 0.004f * a.distance;  // some pixels
    const float off_plane = std::fabs(a.flat_normal.dot(b.point - a.point));
    const float bend4 = bend * bend * bend * bend;
    return bend4 * bend4 / (1 + off_plane * off_plane / (reach * reach) * 16);
  }

  /// One round of an edge-avoiding blur, 5 x 5 samples `step` pixels apart (Dammertz et al. 2010).
  void smooth(int y, int step) {
    static constexpr std::array<float, 3> kernel = {0.375f, 0.25f, 0.0625f};
    for (int x = 0; x < width_; ++x) {
      const Hit& center = hits_[id(x, y)];
      // Only the floor is plain enough for the widest rounds.
      if (center.surface == Surface::none || (step > 4 && center.surface != Surface::floor)) {
        scratch_[id(x, y)] = seen_[id(x, y)];
        continue;
      }
      float sum = 0;
      Visibility mean{0, 0};
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const int u = x + i * step, v = y + j * step;
          if (u < 0 || v < 0 || u >= width_ || v >= height_) continue;
          const float w = kernel[std::abs(i)] * kernel[std::abs(j)] * likeness(center, hits_[id(u, v)]);
          sum += w;
          mean.box += w * seen_[id(u, v)].box;
          mean.dome += w * seen_[id(u, v)].dome;
        }
      scratch_[id(x, y)] = {mean.box / sum, mean.dome / sum};  // the centre itself counts 1: sum > 0
    }
  }

  Vec3 shade_pixel(int x, int y) const {
    const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
    return light_.shade(hits_[id(x, y)], seen_[id(x, y)], ray(px, py), background(py), look_);
  }

  static float brightness(const Rgb& c) { return (0.3f * c[0] + 0.6f * c[1] + 0.1f * c[2]) / 255; }

  bool is_edge(const Image& image, int x, int y) const {
    const float here = brightness(image.at(x, y));
    for (const auto& [i, j] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (!image.holds(x + i, y + j)) continue;
      if (hits_[id(x, y)].surface != hits_[id(x + i, y + j)].surface &&
          std::max(hits_[id(x, y)].surface, hits_[id(x + i, y + j)].surface) > Surface::floor)
        return true;
      if (std::fabs(here - brightness(image.at(x + i, y + j))) > kEdgeContrast) return true;
    }
    return false;
  }

  /// Light at a finer sample, taken over from the pixel about it that lies on the same piece of surface.
  Visibility borrowed(const Hit& hit, int x, int y) const {
    float best = 0.02f;
    const Visibility* found = nullptr;
    for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
        const Hit& other = hits_[id(u, v)];
        const float like = likeness(hit, other) / (1 + (hit.point - other.point).squaredNorm() * 1e5f);
        if (like > best) {
          best = like;
          found = &seen_[id(u, v)];
        }
      }
    return found ? *found : light_.measure(tracer_, hit, x, y);
  }

  Vec3 refine(int x, int y) const {
    Vec3 sum = Vec3::Zero();
    for (const auto& [i, j] : kRooks) {
      const float px = static_cast<float>(x) + i, py = static_cast<float>(y) + j;
      const Vec3 direction = ray(px, py);
      const Hit hit = tracer_.trace(camera_.eye, direction);
      const Visibility seen = hit.surface == Surface::none ? Visibility{} : borrowed(hit, x, y);
      sum += light_.shade(hit, seen, direction, background(py), look_).cwiseMin(1.5f);
    }
    return sum / static_cast<float>(kRooks.size());
  }

  const Tracer& tracer_;
  const Camera& camera_;
  int width_, height_;
  const Look& look_;
  Light light_;
  std::vector<Hit> hits_;
  std::vector<Visibility> seen_, scratch_;
};

}  // namespace

Image photograph(const Scene& scene, const Tracer& tracer, const Camera& camera, int width, int height,
                 const Look& look) {
  return Photograph(scene, tracer, camera, width, height, look).take();
}

}  // namespace garment::render
