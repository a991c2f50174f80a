#pragma once
// Closest points of a point and a triangle and of two segments, with barycentric weights. Defined for
// degenerate input too: a triangle may be a segment or a point, segments may be points or parallel.
#include <Eigen/Core>
#include <array>

namespace garment::simulator {

inline constexpr double kZeroGap = 1e-12;  ///< m: below this the gap between closest points has no direction

using Eigen::Vector3d;

/// The part of a triangle (or segment) on which a closest point lies.
///
///          a            corner k = corner_a + k, edge_ab lies between corners a and b
///         / \           a segment uses corner_a, corner_b and edge_ab
///        b---c
enum class Feature : unsigned char { face, edge_ab, edge_bc, edge_ca, corner_a, corner_b, corner_c };

/// Closest point of a triangle to a point: weights[0] a + weights[1] b + weights[2] c.
struct TrianglePoint {
  std::array<double, 3> weights{};  ///< >= 0, sum 1
  Feature feature = Feature::face;
};

/// Closest point of triangle abc to p. The choice between edge and corner hangs on the sign of (w - u) . (p -
/// u) at corner u alone, so it is the same for all triangles around a corner and for `closest_on_segment`.
/// Source: Ericson, Real-Time Collision Detection, 5.1.5.
TrianglePoint closest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Closest point of segment ab to p: (1 - t) a + t b.
struct SegmentPoint {
  double t = 0;  ///< [0, 1]
  Feature feature = Feature::edge_ab;
};
SegmentPoint closest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b);

/// Closest points of segments ab and cd: (1 - s) a + s b and (1 - t) c + t d.
struct SegmentPair {
  double s = 0, t = 0;  ///< [0, 1]
};

/// Closest points of two segments; of parallel segments that overlap, one pair at an end of the overlap.
/// Source: Ericson 5.1.9, with the clamped case solved again from both sides so that nearly parallel segments
/// lose no digits.
SegmentPair closest_of_segments(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d);

}  // namespace garment::simulator
