#pragma once
// Reader of sewing patterns in JSON: panels with curved edges, stitches, placement. Both editions of the
// format that GarmentCode (the newer) and Garment-Pattern-Generator (the older) write. What is read, how it
// is mapped and what is guessed: docs/formats.md.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"

namespace garment::io {

struct PatternLayout;

/// Where the origin of a pattern's space lies.
enum class PatternFrame {
  floor,   ///< the body stands on y = 0 (the newer format)
  pelvis,  ///< y = 0 is the pelvis of a body in T-pose, about 1.12 m above its feet (the older format)
};

struct PatternLimits {
  std::size_t max_bytes = 16u << 20;
  int max_depth = 64;  ///< of nested lists and objects
  std::size_t max_panels = 4096;
  std::size_t max_edges = 4096;   ///< of one panel, vertices too
  std::size_t max_total = 65536;  ///< edges of all panels; stitches
  double max_coordinate = 100;    ///< m, of anything, in any direction
};

struct PatternOptions {
  std::string title = "imported pattern";
  design::Fabric fabric;              ///< the files name none; every panel gets this one
  std::string body = "form";          ///< name of the body that attachments speak of
  double resolution = 0.01;           ///< grid spacing of every panel, m
  std::optional<PatternFrame> frame;  ///< overrides the guess
  bool keep_layout = true;            ///< give the file's layout too, for a writer
  bool attach = true;                 ///< guess attachments from labels and heights
  PatternLimits limits;
};

/// The cloth that imported patterns are taken to be of, since the files name none: a single jersey, class-typical (not
/// measured). Many of these patterns are smaller than their bodies and can only be worn in a cloth that stretches.
design::Fabric import_fabric();

/// A pattern as a declared garment. `garment` is empty when `findings` has errors. Its bodies are empty: the
/// caller adds one by the name in `PatternOptions::body`. Coordinates stay in the file's own frame (metres).
struct PatternResult {
  std::optional<design::Garment> garment;
  PatternFrame frame = PatternFrame::floor;
  std::shared_ptr<PatternLayout> layout;  ///< how the file had it (pattern_layout.hpp); null without a garment
  Findings findings;  ///< codes G0940 to G0959; they name the panel, the edge or the stitch
  std::vector<std::string>
      notes;  ///< what was mapped or guessed, one sentence each, in the order of the file
};

/// Reads a sewing pattern. Never throws and never hangs, whatever the bytes are; bounded by
/// `PatternOptions::limits`. Panels walked clockwise come out mirrored (x to -x, R to R Ry(180 deg)), so that
/// every outline runs counter-clockwise and the face stays the face.
PatternResult read_pattern(std::string_view json_text, const PatternOptions& options = {});

/// How far a garment in the pelvis frame must be raised for a body of `stature` metres that stands on y = 0:
/// the template's pelvis stands 1.12 m above its feet at a stature of 1.66 m.
inline double pelvis_shift(double stature) { return 1.12 / 1.66 * stature; }

/// Adds `offset` (m) to the place of every rigidly placed panel.
void move_garment(design::Garment& garment, const Eigen::Vector3d& offset);

}  // namespace garment::io
