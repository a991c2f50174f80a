#pragma once
// What `save` writes, by the ending of the file's name.
#include <optional>
#include <string>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/io/pdf_writer.hpp"
#include "runtime/model/model.hpp"

namespace garment::session {

/// The bytes of a file; else why there are none, and the remedy.
struct ResultFile {
  std::optional<std::string> bytes;
  std::string message, help;
};

/// The file `name` of a garment as it lies: .obj, .glb, .ply, .svg, .pdf, .dxf, .json, .png, .csv. Refuses other endings and names
/// that leave the folder they are written in. `paper` is that of a .pdf.
ResultFile make_result_file(const std::string& name, const design::Garment& garment,
                            const std::vector<body::Body>& bodies, const model::Model& model,
                            const model::State& state, const io::PaperSize& paper = {});

}  // namespace garment::session
