#pragma once
// Writer of sewing patterns in JSON, the format that pattern_json reads. What is kept of a file that was
// read, and what goes into the block `garment`: docs/formats.md.
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"

namespace garment::io {

struct PatternLayout;

struct PatternText {
  std::string text;
  Findings findings;  ///< G0906: what the format cannot hold
};

/// The garment as a specification: outlines with darts cut away, edges divided where seams begin or meet a
/// corner, one stitch for each pair of edges. With the `layout` of the file that the garment came from its
/// numbers, names and words are used again wherever they mean what the garment says; without one coordinates
/// are centimetres.
PatternText write_pattern_json(const design::Garment& garment, const PatternLayout* layout = nullptr);

/// True if both are the same but for numbers that differ by at most `tolerance`; 1, 1.0 and true are one
/// number.
bool same_numbers(const nlohmann::json& a, const nlohmann::json& b, double tolerance);

/// A circle: of a flat one the radius says little, so that digits of the ends that a script drops come back
/// as millimetres of radius. Its own words are always kept.
bool is_circle(const nlohmann::json& edge);

}  // namespace garment::io
