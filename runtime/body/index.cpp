#include "runtime/body/index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "runtime/base/parallel.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::body {
namespace {

using Index = Body::Index;

constexpr int kLeafSize = 4;

double box_distance2(const std::array<double, 6>& box, const Vector3d& p) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    double d = std::max({box[k] - p[k], p[k] - box[k + 3], 0.0});
    sum += d * d;
  }
  return sum;
}

/// Copies FCL's tree: subtrees of at most kLeafSize triangles become one leaf.
class Flattener {
 public:
  Flattener(const TriangleMesh& mesh, Index& index) : mesh_(mesh), index_(index) {}

  void run() {
    index_.leaves.reserve(mesh_.triangles.size());
    struct Task {
      int from, parent, side;
    };
    std::vector<Task> tasks{{0, -1, 0}};  // a stack of its own: a hostile mesh can make the tree very deep
    while (!tasks.empty()) {
      Task task = tasks.back();
      tasks.pop_back();
      const auto& node = index_.model->getBV(task.from);
      int child = 0, count = 0;
      if (node.num_primitives <= kLeafSize || node.isLeaf()) {
        child = ~static_cast<int>(index_.leaves.size());
        add_leaves(task.from);
        count = static_cast<int>(index_.leaves.size()) - ~child;
      } else {
        child = static_cast<int>(index_.nodes.size());
        index_.nodes.emplace_back();
        tasks.push_back({node.rightChild(), child, 1});
        tasks.push_back({node.leftChild(), child, 0});
      }
      if (task.parent < 0 && count > 0) {  // the whole mesh is one leaf
        index_.nodes.emplace_back();
        index_.nodes[0].child = {child, child};
        index_.nodes[0].count = {count, 0};
        index_.nodes[0].box = {box_of(task.from), box_of(task.from)};
      } else if (task.parent >= 0) {
        Index::Node& parent = index_.nodes[task.parent];
        parent.child[task.side] = child;
        parent.count[task.side] = count;
        parent.box[task.side] = box_of(task.from);
      }
    }
  }

 private:
  std::array<double, 6> box_of(int i) const {
    const fcl::AABBd& b = index_.model->getBV(i).bv;
    return {b.min_[0], b.min_[1], b.min_[2], b.max_[0], b.max_[1], b.max_[2]};
  }

  void add_leaves(int i) {
    const auto& node = index_.model->getBV(i);
    if (!node.isLeaf()) {
      add_leaves(node.leftChild());
      add_leaves(node.rightChild());
      return;
    }
    const auto& t = mesh_.triangles[node.primitiveId()];
    index_.leaves.push_back(
        {{mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]}, node.primitiveId(), false});
  }

  const TriangleMesh& mesh_;
  Index& index_;
};

Vector3d unit_or_zero(const Vector3d& v) {
  double n = v.norm();
  return n > 0 ? Vector3d(v / n) : Vector3d::Zero();
}

double angle_between(const Vector3d& a, const Vector3d& b) {
  return portable::atan2(a.cross(b).norm(), a.dot(b));
}

/// Baerentzen & Aanaes 2005: with these normals the sign of the distance is right at edges and corners too.
void make_normals(const TriangleMesh& mesh, Index& index) {
  std::size_t n = mesh.triangles.size();
  index.normals.assign(n, {});
  std::vector<Vector3d> vertex(mesh.vertices.size(), Vector3d::Zero());
  std::vector<std::tuple<int, int, int, int>> edges;  // low vertex, high vertex, triangle, side
  edges.reserve(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& t = mesh.triangles[i];
    std::array<Vector3d, 3> p{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    Vector3d face = unit_or_zero((p[1] - p[0]).cross(p[2] - p[0]));
    index.normals[i][static_cast<int>(Feature::face)] = face;
    for (int k = 0; k < 3; ++k) {
      int next = (k + 1) % 3, last = (k + 2) % 3;
      vertex[t[k]] += angle_between(p[next] - p[k], p[last] - p[k]) * face;
      edges.emplace_back(std::min(t[k], t[next]), std::max(t[k], t[next]), static_cast<int>(i), k);
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t begin = 0; begin < edges.size();) {
    auto same = [&](std::size_t k) {
      return std::get<0>(edges[k]) == std::get<0>(edges[begin]) &&
             std::get<1>(edges[k]) == std::get<1>(edges[begin]);
    };
    Vector3d sum = Vector3d::Zero();
    std::size_t end = begin;
    for (; end < edges.size() && same(end); ++end)
      sum += index.normals[std::get<2>(edges[end])][static_cast<int>(Feature::face)];
    sum = unit_or_zero(sum);
    for (std::size_t k = begin; k < end; ++k)
      index.normals[std::get<2>(edges[k])][static_cast<int>(Feature::edge_0) + std::get<3>(edges[k])] = sum;
    begin = end;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) index.normals[i][k] = unit_or_zero(vertex[mesh.triangles[i][k]]);
}

/// Sums of a node from its leaves and, below it in the array, its children: children always come later.
void make_far(Index& index) {
  index.far.resize(index.nodes.size());
  std::vector<double> area(index.nodes.size(), 0);
  for (std::size_t i = index.nodes.size(); i-- > 0;) {
    const Index::Node& node = index.nodes[i];
    struct Item {
      double area;
      Vector3d center, dipole;
      Eigen::Matrix3d moment;
    };
    std::vector<Item> items;
    for (int side = 0; side < 2; ++side) {
      if (node.count[side] == 0 && node.child[side] >= 0) {
        const Index::Far& f = index.far[node.child[side]];
        items.push_back({area[node.child[side]], f.center, f.dipole, f.moment});
      }
      for (int k = 0; k < node.count[side]; ++k) {
        const auto& c = index.leaves[~node.child[side] + k].corner;
        Vector3d dipole = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
        items.push_back({dipole.norm(), (c[0] + c[1] + c[2]) / 3, dipole, Eigen::Matrix3d::Zero()});
      }
    }
    Index::Far far{Vector3d::Zero(), Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0};
    for (const Item& item : items) {
      area[i] += item.area;
      far.center += item.area * item.center;
      far.dipole += item.dipole;
    }
    far.center = area[i] > 0 ? Vector3d(far.center / area[i]) : items.front().center;
    for (const Item& item : items)
      far.moment += item.moment + item.dipole * (item.center - far.center).transpose();
    for (const auto& box : node.box)
      for (int corner = 0; corner < 8; ++corner) {
        Vector3d p(box[(corner & 1) * 3], box[(corner >> 1 & 1) * 3 + 1], box[(corner >> 2) * 3 + 2]);
        far.radius = std::max(far.radius, (p - far.center).norm());
      }
    index.far[i] = far;
  }
}

double exact_winding(const Index& index, const Vector3d& p) {
  double sum = 0;
  for (const Index::Leaf& leaf : index.leaves)
    sum += solid_angle(p, leaf.corner[0], leaf.corner[1], leaf.corner[2]);
  return sum;
}

double fast_winding(const Index& index, const Vector3d& p) {
  constexpr double kFar = 3;  // radii away: the error of the whole stays below 2e-2
  thread_local std::vector<int> stack;
  stack.assign(1, 0);
  double sum = 0, far_sum = 0;
  while (!stack.empty()) {
    int i = stack.back();
    stack.pop_back();
    const Index::Far& far = index.far[i];
    Vector3d r = far.center - p;
    double distance = r.norm();
    if (distance > kFar * far.radius) {
      double d3 = distance * distance * distance;
      far_sum += far.dipole.dot(r) / d3 + far.moment.trace() / d3 -
                 3 * r.dot(far.moment * r) / (d3 * distance * distance);
      continue;
    }
    const Index::Node& node = index.nodes[i];
    for (int side = 0; side < 2; ++side) {
      if (node.count[side] == 0 && node.child[side] >= 0) stack.push_back(node.child[side]);
      for (int k = 0; k < node.count[side]; ++k) {
        const auto& c = index.leaves[~node.child[side] + k].corner;
        sum += solid_angle(p, c[0], c[1], c[2]);
      }
    }
  }
  return sum + far_sum / (4 * portable::kPi);
}

}  // namespace

void build_index(Body& body) {
  auto index = std::make_shared<Index>();
  body.index = index;
  if (body.mesh.triangles.empty()) return;
  index->model = std::make_shared<fcl::BVHModel<fcl::AABBd>>();
  std::vector<fcl::Vector3d> points(body.mesh.vertices.begin(), body.mesh.vertices.end());
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(body.mesh.triangles.size());
  for (const auto& t : body.mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  index->model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
  index->model->addSubModel(points, triangles);
  index->model->endModel();
  const fcl::AABBd& box = index->model->getBV(0).bv;
  index->length = (box.max_ - box.min_).norm();
  Flattener(body.mesh, *index).run();
  make_normals(body.mesh, *index);
  make_far(*index);
  make_smooth(body.mesh, *index);
  mark_covered(body, *index);
}

std::optional<SurfacePoint> Body::closest(const Vector3d& p, double max_distance) const {
  if (!index || index->nodes.empty() || !p.allFinite() || !(max_distance >= 0)) return std::nullopt;
  double best = max_distance * max_distance;
  const Index::Leaf* hit = nullptr;
  TrianglePoint at;
  struct Entry {
    int node;
    double distance2;
  };
  thread_local std::vector<Entry> stack;
  stack.assign(1, {0, 0.0});
  while (!stack.empty()) {
    Entry entry = stack.back();
    stack.pop_back();
    if (entry.distance2 > best) continue;
    const Index::Node& node = index->nodes[entry.node];
    std::array<double, 2> distance2{box_distance2(node.box[0], p), box_distance2(node.box[1], p)};
    int near = distance2[1] < distance2[0] ? 1 : 0;
    for (int side : {near, 1 - near}) {
      for (int k = 0; k < node.count[side] && distance2[side] <= best; ++k) {
        const Index::Leaf& leaf = index->leaves[~node.child[side] + k];
        if (leaf.covered) continue;
        TrianglePoint q = closest_on_triangle(p, leaf.corner[0], leaf.corner[1], leaf.corner[2]);
        double d = (q.point - p).squaredNorm();
        if (d < best || (d == best && (!hit || leaf.triangle < hit->triangle))) {
          best = d;
          hit = &leaf;
          at = q;
        }
      }
    }
    for (int side : {1 - near, near})
      if (node.child[side] >= 0 && distance2[side] <= best)
        stack.push_back({node.child[side], distance2[side]});
  }
  if (!hit) return std::nullopt;
  return surface_point(*index, *hit, at, p);
}

double Body::winding(const Vector3d& p) const {
  if (!index || index->nodes.empty() || !p.allFinite()) return 0;
  double w = fast_winding(*index, p);
  // Too close to a half to trust the far field: on the surface, or in a hole. Rare enough to sum everything.
  double fraction = std::fabs(w - std::floor(w) - 0.5);
  return fraction < 0.05 ? exact_winding(*index, p) : w;
}

}  // namespace garment::body
