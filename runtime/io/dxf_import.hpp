#pragma once
// AAMA-292 and ASTM D6673 DXF into a declared garment: a panel of each piece of one size. What is read, how
// it is mapped and what is guessed: docs/formats.md.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/io/dxf_document.hpp"

namespace garment::io {

struct DxfOptions {
  std::string title = "imported pattern";
  design::Fabric fabric;     ///< of every panel: the files name cloths, but tell nothing of them
  std::string size;          ///< empty: the sample size
  double resolution = 0.01;  ///< grid spacing of every panel, m
  std::size_t max_panels = 4096;
  DxfLimits limits;
};

struct DxfResult {
  std::optional<design::Garment> garment;  ///< empty when `findings` has errors
  std::vector<std::string> sizes;          ///< in the order of the file
  Findings findings;  ///< codes G0960 to G0969; where one place is meant, with the line of the file
  std::vector<std::string> notes;
};

/// Reads a pattern. Never throws and never hangs, whatever the bytes are. The panels lie side by side, flat
/// and face up, in the order of the file; nothing is sewn.
DxfResult read_dxf(std::string_view bytes, const DxfOptions& options = {});

}  // namespace garment::io
