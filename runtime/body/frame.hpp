#pragma once
// What a script may ask of a person without the surface: levels and parts, from the measures alone.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/body/body.hpp"

namespace garment::body {

/// A level as the tape knows it. A figure that no measure states is missing; the built body's `levels` has
/// it.
struct FrameLevel {
  std::optional<double> height;  ///< y, m
  std::optional<double> girth;   ///< m
};

struct Frame {
  std::map<std::string, FrameLevel> levels;
  std::vector<std::string> parts;
  std::map<std::string, double>
      lengths;  ///< other measures of the person by name, m: "back_length", "sleeve"
};

struct FrameResult {
  std::optional<Frame> frame;  ///< nothing for shapes that are no mannequin, and where the measures are wrong
  Findings findings;
};

/// The frame of a declared mannequin, within a millisecond or two. Girths are the tape measures themselves;
/// the built surface meets them within 0.3 mm. Errors: those of check_measures.
FrameResult make_frame(const design::Body& declared);

}  // namespace garment::body
