#pragma once
// What is asked of a recorded curve: plain numbers, whatever they measure.
#include <array>
#include <optional>
#include <vector>

namespace garment::interpreter {

/// Points (x, y) in the order in which they were recorded; loops go to and fro.
using CurvePoints = std::vector<std::array<double, 2>>;

/// The first part of the curve on which x goes from `from` to `to`, and not back beyond `from` in between. Its ends are put in
/// on the straight line between two points. Nothing where the curve does not go there.
std::optional<CurvePoints> passage(const CurvePoints& curve, double from, double to);

/// Slope of the straight line that fits the passage best (least squares of y).
std::optional<double> slope_of(const CurvePoints& curve, double from, double to);
/// Integral of y over x along the passage; on a way back it is that of the way out with the other sign.
std::optional<double> work_of(const CurvePoints& curve, double from, double to);
/// y where x passes `at` for the first time.
std::optional<double> reading_of(const CurvePoints& curve, double at);
/// By how much y differs between the first time that x passes `at` and the next, when it comes back.
std::optional<double> loop_width_of(const CurvePoints& curve, double at);

}  // namespace garment::interpreter
