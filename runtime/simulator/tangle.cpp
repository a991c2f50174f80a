// What cuts what: exact tests of edges against triangles, and winding numbers of particles.
#include <Eigen/Geometry>
#include <algorithm>

#include "runtime/base/parallel.hpp"
#include "runtime/geometry/triangle_hit.hpp"
#include "runtime/simulator/untangle.hpp"

namespace garment::simulator {
namespace {

constexpr std::size_t kCutGrain = 256;  // of one chunk: parts to try, or particles

struct HitTest {
  const ContactMesh& mesh;
  const std::vector<Vector3d>& x;

  bool operator()(Index e, Index t) const {
    const Indices<2>& i = mesh.edge[e];
    const Indices<3>& c = mesh.triangle[t];
    for (Index corner : c)
      if (corner == i[0] || corner == i[1]) return false;
    return geometry::segment_hits_triangle(mesh.at(x, i[0]), mesh.at(x, i[1]),
                                           {mesh.at(x, c[0]), mesh.at(x, c[1]), mesh.at(x, c[2])});
  }
};

template <class Part>
FloatBox box_of(const ContactMesh& mesh, const std::vector<Vector3d>& x, const Part& part) {
  FloatBox box;
  for (Index p : part) box.grow(mesh.at(x, p));
  return box;
}

void find_hits(const ContactMesh& mesh, const std::vector<Vector3d>& x, std::vector<EdgeHit>& out) {
  const HitTest hit{mesh, x};
  if (mesh.options.self) {
    std::vector<FloatBox> boxes(mesh.n_cloth_triangles);
    for (std::size_t t = 0; t < boxes.size(); ++t) boxes[t] = box_of(mesh, x, mesh.triangle[t]);
    Bvh tree = mesh.cloth_triangle_tree;
    tree.refit(boxes);
    parallel_collect(static_cast<std::size_t>(mesh.n_cloth_edges), kCutGrain, out, [&](Index e, std::vector<EdgeHit>& found) {
      tree.query(box_of(mesh, x, mesh.edge[e]), [&](std::int32_t t) {
        if (hit(e, t)) found.push_back({e, t});
      });
    });
  }
  parallel_collect(static_cast<std::size_t>(mesh.n_cloth_edges), kCutGrain, out, [&](Index e, std::vector<EdgeHit>& found) {
    mesh.body_triangle_tree.query(box_of(mesh, x, mesh.edge[e]), [&](std::int32_t t) {
      if (hit(e, t + mesh.n_cloth_triangles)) found.push_back({e, t + mesh.n_cloth_triangles});
    });
  });
  parallel_collect(static_cast<std::size_t>(mesh.n_cloth_triangles), kCutGrain, out, [&](Index t, std::vector<EdgeHit>& found) {
    mesh.body_edge_tree.query(box_of(mesh, x, mesh.triangle[t]), [&](std::int32_t e) {
      if (hit(e + mesh.n_cloth_edges, t)) found.push_back({e + mesh.n_cloth_edges, t});
    });
  });
  std::sort(out.begin(), out.end());
}

void find_inside(const std::vector<body::Body>& bodies, const std::vector<Vector3d>& x, Tangle& out) {
  out.inside.assign(x.size(), 0);
  for (const body::Body& body : bodies) {
    if (body.mesh.vertices.empty()) continue;
    Vector3d low = body.mesh.vertices.front(), high = low;
    for (const Vector3d& v : body.mesh.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    parallel_for(x.size(), kCutGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if ((x[i].array() >= low.array()).all() && (x[i].array() <= high.array()).all() && body.inside(x[i]))
          out.inside[i] = 1;
    });
  }
  for (std::uint8_t inside : out.inside) out.n_inside += inside;
}

}  // namespace

Tangle find_tangle(const ContactMesh& mesh, const std::vector<body::Body>& bodies,
                   const std::vector<Vector3d>& x) {
  Tangle out;
  find_hits(mesh, x, out.hits);
  find_inside(bodies, x, out);
  return out;
}

}  // namespace garment::simulator
