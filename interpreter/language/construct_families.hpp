#pragma once
// The construct table in families: the chapters of the reference.
#include <string_view>
#include <vector>

#include "interpreter/language/construct_table.hpp"

namespace garment::interpreter {

/// One chapter: what its constructs are about, and where their records come from.
struct ConstructFamily {
  std::string_view title;
  std::vector<ConstructRecord> (*records)();
};

/// In the order of the reference. A new file of constructs is named here and nowhere else.
inline constexpr ConstructFamily kConstructFamilies[] = {
    {"Names and values", detail::basics_constructs},
    {"Cloth", detail::cloth_constructs},
    {"Panels", detail::panel_constructs},
    {"Assembly", detail::assembly_constructs},
    {"Components", detail::structure_constructs},
    {"Scene", detail::scene_constructs},
    {"Holds, forces, motion", detail::forces_constructs},
    {"Acts", detail::acts_constructs},
};

}  // namespace garment::interpreter
