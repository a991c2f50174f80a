#pragma once
// Outlines, holes and lines as straight segments fine enough for checks (0.05 mm).
#include <optional>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

struct Segment {
  design::Point2 a, b;
  std::size_t edge = 0;  ///< index into the list it was made of
};

std::vector<Segment> segments_of(const std::vector<design::Edge>& edges);

/// Where two segments cross, each by more than 1e-7 m on either side of the other.
std::optional<design::Point2> crossing(const Segment& s, const Segment& t);

struct Crossing {
  std::size_t edge_a = 0, edge_b = 0;
  design::Point2 at{0, 0};
};

/// The crossing of an edge of `a` with one of `b` that comes first along `a`; nothing if there is none. Counts its steps.
std::optional<Crossing> first_crossing(Program& program, Span span, const std::vector<Segment>& a,
                                       std::vector<Segment> b);

/// True if the point lies inside the closed loops (even and odd), or within `tolerance` of them.
bool contains(const std::vector<Segment>& loops, const design::Point2& p, double tolerance);

/// Distance to the nearest segment, m; 1e9 if there is none.
double distance_to(const std::vector<Segment>& segments, const design::Point2& p);

}  // namespace garment::interpreter
