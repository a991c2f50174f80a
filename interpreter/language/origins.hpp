#pragma once
// Where in a script the things of the declared garment come from.
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "runtime/base/finding.hpp"

namespace garment::interpreter {

/// Whose business a place is that stands in a component or a library: the place in the script that brought it in.
struct Caller {
  grammar::Label label;
  bool first = false;  ///< the script's own place comes first: the other one stands in a library
};

/// By OriginId; [0] stands for "no statement".
class Origins {
 public:
  const grammar::Span& operator[](std::size_t id) const { return places_[id]; }
  std::size_t size() const { return places_.size(); }
  OriginId add(grammar::Span place, std::optional<Caller> caller) {
    if (caller) callers_.emplace(places_.size(), std::move(*caller));
    places_.push_back(place);
    return OriginId{static_cast<std::uint32_t>(places_.size() - 1)};
  }
  const Caller* caller_of(std::size_t id) const {
    const auto found = callers_.find(id);
    return found == callers_.end() ? nullptr : &found->second;
  }

 private:
  std::vector<grammar::Span> places_{grammar::Span{}};
  std::map<std::size_t, Caller> callers_;
};

/// Findings of a stage with the places of the script.
grammar::Diagnostics to_diagnostics(const Findings& findings, const Origins& origins);

}  // namespace garment::interpreter
