#pragma once
// Closed paths of a drawing as panels. What is read, how it is mapped and what is guessed: docs/formats.md.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"

namespace garment::io {

struct SvgLimits {
  std::size_t max_bytes = 64u << 20;
  int max_depth = 64;  ///< of groups
  std::size_t max_curves = 200'000;
  std::size_t max_panels = 4096;
  std::size_t max_edges = 4096;  ///< of one panel
};

struct SvgOptions {
  std::string title = "imported drawing";
  design::Fabric fabric;
  double resolution = 0.01;  ///< grid spacing of every panel, m
  SvgLimits limits;
};

struct SvgResult {
  std::optional<design::Garment> garment;  ///< empty when `findings` has errors
  Findings findings;                       ///< codes G0970 to G0979
  std::vector<std::string> notes;
};

/// Reads a drawing. Never throws and never hangs, whatever the bytes are. The panels lie side by side, as
/// drawn, face up.
SvgResult read_svg(std::string_view bytes, const SvgOptions& options = {});

}  // namespace garment::io
