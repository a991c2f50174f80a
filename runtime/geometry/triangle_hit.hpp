#pragma once
// Do triangles in space meet? Decided with exact signs; touching counts, degenerate triangles are segments or
// points.
#include <Eigen/Core>
#include <array>

namespace garment::geometry {

using Triangle3 = std::array<Eigen::Vector3d, 3>;

/// True when the closed segment pq and the closed triangle abc have a point in common.
bool segment_hits_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Triangle3& t);

/// True when the two closed triangles have a point in common.
bool triangles_hit(const Triangle3& s, const Triangle3& t);

}  // namespace garment::geometry
