#pragma once
// Which edges of an imported pattern hang on the body, from labels and heights.
#include "runtime/design/garment.hpp"
#include "runtime/io/pattern_json.hpp"
#include "runtime/io/pattern_names.hpp"
#include "runtime/io/pattern_report.hpp"

namespace garment::io {

/// Attachments of a garment whose seams are read: `lower_interface` at the waist, `strapless_top` at the
/// bust, `left_collar` and `right_collar` at the neck; then, for every piece without labels that does not
/// reach above the bust, its free upper edges at the waist. All of them may slide. One sentence for each goes
/// into the notes.
std::vector<design::Attachment> guess_attachments(const design::Garment& garment, const EdgeLabels& labels,
                                                  PatternFrame frame, const std::string& body,
                                                  PatternReport& report);

}  // namespace garment::io
