#include "runtime/geometry/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>

namespace garment::geometry {
namespace {

__extension__ using Wide = __int128;

/// Coordinates in [-2^26, 2^26], the enclosing triangle within 2^29: every determinant below fits 127 bits.
struct Lattice {
  std::int64_t x, y;
};
constexpr double kLatticeHalf = 67108864;  // 2^26
constexpr std::int64_t kFar = std::int64_t{1} << 29;

int sign(Wide v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

int orient(const Lattice& a, const Lattice& b, const Lattice& c) {
  return sign(Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x));
}

/// Is d strictly inside the circle through a, b, c (counter-clockwise)?
bool in_circle(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
  std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  Wide a2 = Wide{ax} * ax + Wide{ay} * ay, b2 = Wide{bx} * bx + Wide{by} * by,
       c2 = Wide{cx} * cx + Wide{cy} * cy;
  return a2 * (Wide{bx} * cy - Wide{by} * cx) - b2 * (Wide{ax} * cy - Wide{ay} * cx) +
             c2 * (Wide{ax} * by - Wide{ay} * bx) >
         0;
}

///          2
///         / \        side k lies opposite corner k; next[k] is the triangle beyond it
///        1   0
///       /     \      .
///      0---2---1
struct Tri {
  std::array<int, 3> v;
  std::array<int, 3> next;
  std::array<bool, 3> fixed{false, false, false};
};

int after(int k) { return k == 2 ? 0 : k + 1; }
int before(int k) { return k == 0 ? 2 : k - 1; }

class Mesh {
 public:
  explicit Mesh(std::vector<Lattice> points) : p_(std::move(points)) {
    int n = static_cast<int>(p_.size());
    p_.push_back({-kFar, -kFar});
    p_.push_back({kFar, -kFar});
    p_.push_back({0, kFar});
    t_.reserve(2 * p_.size() + 8);
    t_.push_back({{n, n + 1, n + 2}, {-1, -1, -1}});
    touch_.assign(p_.size(), -1);
    for (int k = 0; k < 3; ++k) touch_[n + k] = 0;
  }

  /// Adds point i; returns the point that already lies there, or -1.
  int insert(int i) {
    int t = locate(p_[i]);
    int zero = -1, zeros = 0;
    for (int k = 0; k < 3; ++k)
      if (orient(p_[t_[t].v[after(k)]], p_[t_[t].v[before(k)]], p_[i]) == 0) {
        zero = k;
        ++zeros;
      }
    if (zeros == 2) {
      for (int k = 0; k < 3; ++k)
        if (p_[t_[t].v[k]].x == p_[i].x && p_[t_[t].v[k]].y == p_[i].y) return t_[t].v[k];
    }
    if (zeros == 0)
      split_inside(t, i);
    else
      split_side(t, zero, i);
    legalise();
    return -1;
  }

  /// Makes a-b a side; false if it runs through a point or across a fixed side.
  bool fix(int a, int b) {
    if (mark(a, b)) return true;
    std::deque<std::array<int, 2>> crossed;
    if (!find_crossed(a, b, crossed)) return false;
    std::vector<std::array<int, 2>> fresh;
    std::size_t budget = 64 + 16 * crossed.size() * crossed.size();
    while (!crossed.empty()) {
      if (budget-- == 0) return false;
      auto [c, d] = crossed.front();
      crossed.pop_front();
      auto [t, k] = side(c, d);
      if (!flippable(t, k)) {
        crossed.push_back({c, d});
        continue;
      }
      flip(t, k);
      auto [e, f] = side_ends(t, k);  // the new diagonal
      bool shares = e == a || e == b || f == a || f == b;
      if (!shares && orient(p_[a], p_[b], p_[e]) * orient(p_[a], p_[b], p_[f]) < 0)
        crossed.push_back({e, f});
      else
        fresh.push_back({e, f});
    }
    if (!mark(a, b)) return false;
    for (auto [c, d] : fresh) {
      auto [t, k] = side(c, d);
      if (t >= 0) stack_.push_back({t, k});
    }
    legalise();
    return true;
  }

  /// Triangles reached from the left of the border without crossing a fixed side.
  std::vector<std::array<int, 3>> region(const std::vector<std::array<int, 2>>& border) const {
    std::vector<char> inside(t_.size(), 0);
    std::vector<int> todo;
    auto reach = [&](int t) {
      if (t >= 0 && !inside[t]) {
        inside[t] = 1;
        todo.push_back(t);
      }
    };
    for (auto [a, b] : border) reach(side(a, b).first);
    while (!todo.empty()) {
      int t = todo.back();
      todo.pop_back();
      for (int k = 0; k < 3; ++k)
        if (!t_[t].fixed[k]) reach(t_[t].next[k]);
    }
    std::vector<std::array<int, 3>> result;
    for (std::size_t t = 0; t < t_.size(); ++t)
      if (inside[t]) result.push_back(t_[t].v);
    return result;
  }

 private:
  std::vector<Lattice> p_;
  std::vector<Tri> t_;
  std::vector<int> touch_;                  // a triangle at each point
  std::vector<std::pair<int, int>> stack_;  // (triangle, side) to be checked
  int last_ = 0;

  std::array<int, 2> side_ends(int t, int k) const { return {t_[t].v[after(k)], t_[t].v[before(k)]}; }

  int locate(const Lattice& q) {
    int t = last_;
    for (;;) {
      int k = 0;
      for (; k < 3; ++k)
        if (orient(p_[t_[t].v[after(k)]], p_[t_[t].v[before(k)]], q) < 0) break;
      if (k == 3) return last_ = t;
      t = t_[t].next[k];
    }
  }

  /// The triangle with a, b in counter-clockwise order and the number of that side; (-1, 0) if there is none.
  std::pair<int, int> side(int a, int b) const {
    int start = touch_[a], t = start;
    for (int sense = 0; sense < 2; ++sense) {
      do {
        int k = corner(t, a);
        if (t_[t].v[after(k)] == b) return {t, before(k)};
        t = t_[t].next[sense == 0 ? after(k) : before(k)];
      } while (t >= 0 && t != start);
      if (t == start) break;
      t = start;
    }
    return {-1, 0};
  }

  int corner(int t, int a) const { return t_[t].v[0] == a ? 0 : t_[t].v[1] == a ? 1 : 2; }
  int side_towards(int t, int other) const {
    return t_[t].next[0] == other ? 0 : t_[t].next[1] == other ? 1 : 2;
  }

  bool mark(int a, int b) {
    auto [t, k] = side(a, b);
    if (t < 0) return false;
    t_[t].fixed[k] = true;
    int other = t_[t].next[k];
    if (other >= 0) t_[other].fixed[side_towards(other, t)] = true;
    return true;
  }

  void relink(int t, int from, int to) {
    if (t >= 0) t_[t].next[side_towards(t, from)] = to;
  }

  void split_inside(int t, int i) {
    Tri old = t_[t];
    int t1 = static_cast<int>(t_.size()), t2 = t1 + 1;
    t_[t] = {{old.v[0], old.v[1], i}, {t1, t2, old.next[2]}};
    t_.push_back({{old.v[1], old.v[2], i}, {t2, t, old.next[0]}});
    t_.push_back({{old.v[2], old.v[0], i}, {t, t1, old.next[1]}});
    relink(old.next[0], t, t1);
    relink(old.next[1], t, t2);
    for (int k = 0; k < 3; ++k) touch_[old.v[k]] = k == 2 ? t1 : t;
    touch_[i] = t;
    for (int s : {t, t1, t2}) stack_.push_back({s, 2});
  }

  void split_side(int t, int k, int i) {
    int u = t_[t].next[k];
    Tri a = t_[t], b = t_[u];
    int m = side_towards(u, t);
    int c = a.v[k], l = a.v[after(k)], r = a.v[before(k)], d = b.v[m];
    int cl = a.next[before(k)], rc = a.next[after(k)];  // beyond c-l and r-c
    int ld = b.next[after(m)], dr = b.next[before(m)];  // beyond l-d and d-r
    int t1 = static_cast<int>(t_.size()), t2 = t1 + 1;
    t_[t] = {{c, l, i}, {u, t1, cl}};
    t_[u] = {{l, d, i}, {t2, t, ld}};
    t_.push_back({{r, c, i}, {t, t2, rc}});
    t_.push_back({{d, r, i}, {t1, u, dr}});
    relink(rc, t, t1);
    relink(dr, u, t2);
    touch_[c] = touch_[l] = touch_[i] = t;
    touch_[d] = touch_[r] = t2;
    for (int s : {t, u, t1, t2}) stack_.push_back({s, 2});
  }

  bool flippable(int t, int k) const {
    int u = t_[t].next[k];
    if (u < 0 || t_[t].fixed[k]) return false;
    const Lattice &c = p_[t_[t].v[k]], &l = p_[t_[t].v[after(k)]], &r = p_[t_[t].v[before(k)]],
                  &d = p_[t_[u].v[side_towards(u, t)]];
    return orient(c, l, d) > 0 && orient(d, r, c) > 0;
  }

  /// Turns side k of t: (c, l, r) + (d, r, l) become (l, d, c) in t and (r, c, d) in its neighbour; the new
  /// diagonal is side k of t again.
  void flip(int t, int k) {
    int u = t_[t].next[k], m = side_towards(u, t);
    int c = t_[t].v[k], l = t_[t].v[after(k)], r = t_[t].v[before(k)], d = t_[u].v[m];
    int cl = t_[t].next[before(k)], rc = t_[t].next[after(k)], ld = t_[u].next[after(m)],
        dr = t_[u].next[before(m)];
    bool f_cl = t_[t].fixed[before(k)], f_rc = t_[t].fixed[after(k)], f_ld = t_[u].fixed[after(m)],
         f_dr = t_[u].fixed[before(m)];
    t_[t].v[k] = l;
    t_[t].v[after(k)] = d;
    t_[t].v[before(k)] = c;
    t_[t].next[k] = u;  // d-c
    t_[t].next[after(k)] = cl;
    t_[t].next[before(k)] = ld;
    t_[t].fixed[k] = false;
    t_[t].fixed[after(k)] = f_cl;
    t_[t].fixed[before(k)] = f_ld;
    t_[u].v[m] = r;
    t_[u].v[after(m)] = c;
    t_[u].v[before(m)] = d;
    t_[u].next[m] = t;  // c-d
    t_[u].next[after(m)] = dr;
    t_[u].next[before(m)] = rc;
    t_[u].fixed[m] = false;
    t_[u].fixed[after(m)] = f_dr;
    t_[u].fixed[before(m)] = f_rc;
    relink(ld, u, t);
    relink(rc, t, u);
    touch_[l] = touch_[c] = touch_[d] = t;
    touch_[r] = u;
  }

  bool find_crossed(int a, int b, std::deque<std::array<int, 2>>& crossed) const {
    // all triangles at a, to find the one that a-b leaves through
    int start = touch_[a], t = start, k = -1;
    do {
      k = corner(t, a);
      int l = t_[t].v[after(k)], r = t_[t].v[before(k)];
      int ol = orient(p_[a], p_[b], p_[l]), orr = orient(p_[a], p_[b], p_[r]);
      if (ol < 0 && orr > 0 && orient(p_[l], p_[r], p_[b]) < 0) break;
      t = t_[t].next[after(k)];
      k = -1;
    } while (t >= 0 && t != start);
    if (k < 0) return false;
    for (;;) {
      if (t_[t].fixed[k]) return false;
      auto [l, r] = side_ends(t, k);
      crossed.push_back({l, r});
      int u = t_[t].next[k];
      if (u < 0) return false;
      int m = side_towards(u, t), d = t_[u].v[m];
      if (d == b) return true;
      int o = orient(p_[a], p_[b], p_[d]);
      if (o == 0) return false;
      k = o > 0 ? after(m) : before(m);
      t = u;
    }
  }

  void legalise() {
    while (!stack_.empty()) {
      auto [t, k] = stack_.back();
      stack_.pop_back();
      int u = t_[t].next[k];
      if (u < 0 || t_[t].fixed[k]) continue;
      int m = side_towards(u, t);
      if (!in_circle(p_[t_[t].v[0]], p_[t_[t].v[1]], p_[t_[t].v[2]], p_[t_[u].v[m]])) continue;
      if (!flippable(t, k)) continue;
      flip(t, k);
      for (int s = 0; s < 3; ++s) {
        if (t_[t].next[s] != u) stack_.push_back({t, s});
        if (t_[u].next[s] != t) stack_.push_back({u, s});
      }
    }
  }
};

std::vector<Lattice> to_lattice(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d low = points[0], high = points[0];
  for (const Eigen::Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Eigen::Vector2d middle = 0.5 * (low + high);
  double scale = kLatticeHalf / std::max(1e-300, 0.5 * (high - low).maxCoeff());
  std::vector<Lattice> result;
  result.reserve(points.size());
  for (const Eigen::Vector2d& p : points)
    result.push_back({static_cast<std::int64_t>(std::floor((p.x() - middle.x()) * scale + 0.5)),
                      static_cast<std::int64_t>(std::floor((p.y() - middle.y()) * scale + 0.5))});
  return result;
}

}  // namespace

Triangulation triangulate(const std::vector<Eigen::Vector2d>& points,
                          const std::vector<std::array<int, 2>>& border) {
  Triangulation result;
  if (points.size() < 3 || border.size() < 3) return result;
  Mesh mesh(to_lattice(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    int there = mesh.insert(static_cast<int>(i));
    if (there >= 0) {
      result.bad = {there, static_cast<int>(i)};
      return result;
    }
  }
  for (const auto& segment : border) {
    if (!mesh.fix(segment[0], segment[1])) {
      result.bad = segment;
      return result;
    }
  }
  result.triangles = mesh.region(border);
  result.ok = true;
  return result;
}

}  // namespace garment::geometry
