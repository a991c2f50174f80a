#include "runtime/modeller/corner_fans.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;
using Side = std::array<int, 2>;
using Corners = std::array<int, 3>;

constexpr double kLeastAngle = 15;  // degrees

Side side_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class CornerFans {
 public:
  CornerFans(const LoopBorder& border, LoopMesh& mesh) : mesh_(mesh) {
    for (std::size_t k = 0; k < border.next.size(); ++k)
      if (border.next[k] >= 0) drawn_.push_back(side_of(static_cast<int>(k), border.next[k]));
    for (const Side& s : border.lines) lines_.push_back(side_of(s[0], s[1]));
    drawn_.insert(drawn_.end(), lines_.begin(), lines_.end());
    std::sort(lines_.begin(), lines_.end());
    std::sort(drawn_.begin(), drawn_.end());
  }

  void cells() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const std::array<int, 4>& v = mesh_.cells[c];
      for (int k = 0; k < 4; ++k) {
        const int corner = v[k], next = v[(k + 1) % 4], across = v[(k + 2) % 4], last = v[(k + 3) % 4];
        if (!is_corner(corner, next, last)) continue;
        mesh_.cell_halves[2 * c] = {corner, next, across};
        mesh_.cell_halves[2 * c + 1] = {corner, across, last};
        break;
      }
    }
  }

  void triangles() {
    std::map<Side, int> owner;  // of directed sides
    for (std::size_t t = 0; t < mesh_.cut.size(); ++t)
      for (int k = 0; k < 3; ++k) owner[{mesh_.cut[t][k], mesh_.cut[t][(k + 1) % 3]}] = static_cast<int>(t);
    for (std::size_t t = 0; t < mesh_.cut.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int corner = mesh_.cut[t][k], next = mesh_.cut[t][(k + 1) % 3], last = mesh_.cut[t][(k + 2) % 3];
        const auto other = owner.find({last, next});
        if (other == owner.end() || !is_corner(corner, next, last) || is_drawn(next, last)) continue;
        Corners& beyond = mesh_.cut[static_cast<std::size_t>(other->second)];
        const int across = beyond[0] + beyond[1] + beyond[2] - next - last;
        const Corners first{corner, next, across}, second{corner, across, last};
        if (std::min(least_angle(first), least_angle(second)) < kLeastAngle) continue;
        const int t_beyond = other->second;
        owner.erase({next, last});
        owner.erase({last, next});
        mesh_.cut[t] = first;
        beyond = second;
        for (const auto& [which, corners] : {std::pair{static_cast<int>(t), first}, std::pair{t_beyond, second}})
          for (int m = 0; m < 3; ++m) owner[{corners[m], corners[(m + 1) % 3]}] = which;
        break;
      }
  }

 private:
  bool is_drawn(int a, int b) const { return std::binary_search(drawn_.begin(), drawn_.end(), side_of(a, b)); }
  bool is_line(int a, int b) const { return std::binary_search(lines_.begin(), lines_.end(), side_of(a, b)); }
  /// Both sides are drawn, and one is a line inside.
  bool is_corner(int corner, int next, int last) const {
    return is_drawn(corner, next) && is_drawn(corner, last) && (is_line(corner, next) || is_line(corner, last));
  }

  /// Degrees; below zero where the triangle is turned over.
  double least_angle(const Corners& t) const {
    double least = 180;
    for (int k = 0; k < 3; ++k) {
      const Vector2d a = mesh_.at[t[(k + 1) % 3]] - mesh_.at[t[k]], b = mesh_.at[t[(k + 2) % 3]] - mesh_.at[t[k]];
      least = std::min(least, portable::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * 180 / portable::kPi);
    }
    return least;
  }

  LoopMesh& mesh_;
  std::vector<Side> lines_, drawn_;
};

}  // namespace

void fan_out_corners(const LoopBorder& border, LoopMesh& mesh) {
  if (border.lines.empty()) return;
  CornerFans fans(border, mesh);
  fans.cells();
  fans.triangles();
}

}  // namespace garment::modeller
