#pragma once
// The libraries that come with the program: the one list of their names.
#include <array>
#include <string>
#include <string_view>

namespace garment::interpreter {

struct StandardLibrary {
  std::string_view name;   ///< as after `use`; of its file in stdlib/
  std::string_view offers; ///< in one line, with an example
};

inline constexpr std::array kStandardLibraries{
    StandardLibrary{"fabrics", "measured cloth: `fabrics.denim`"},
    StandardLibrary{"bodies", "persons by size: `bodies.woman(size: 40)`"},
    StandardLibrary{"blocks", "skirt, tee and other blocks as components: `part front = blocks.skirt(...)`"},
    StandardLibrary{"skirts", "flared and gathered skirts: `part lower = skirts.flared(...)`"},
    StandardLibrary{"sleeves", "sleeves of one and two pieces, cuffs: `part arms = sleeves.one_piece(...)`"},
    StandardLibrary{"collars", "collars and hoods: `part collar = collars.shirt_collar(...)`"},
    StandardLibrary{"details", "bands, pockets, rows of buttons: `part waistband = details.band(...)`"},
    StandardLibrary{"modifiers", "changes of a part: `part longer = modifiers.lengthen_body(top, by: 5 cm)`"},
};

/// "fabrics, bodies and modifiers", for messages.
inline std::string standard_library_names() {
  std::string text;
  for (std::size_t k = 0; k < kStandardLibraries.size(); ++k)
    text += (k == 0 ? "" : k + 1 == kStandardLibraries.size() ? " and " : ", ") + std::string(kStandardLibraries[k].name);
  return text;
}

}  // namespace garment::interpreter
