#pragma once
// The flat pattern as a drawing to scale.
#include <string>

#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::io {

/// Every panel side by side without overlap, one millimetre of the drawing a millimetre of cloth: outline
/// (the stitch line) with darts, grain, notches, names and lengths of edges in mm, and the letter of every
/// seam at all its sides, with an arrow in the direction of sewing. A scale bar and a list of seams stand
/// below. Returns the bytes of an SVG file.
std::string write_pattern_svg(const design::Garment& garment);

/// The same with the area and mass of each panel as modelled.
std::string write_pattern_svg(const design::Garment& garment, const model::Model& model);

}  // namespace garment::io
