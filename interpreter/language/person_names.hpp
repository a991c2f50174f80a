#pragma once
// The names under which files state the measures of a person.
#include <string_view>
#include <vector>

namespace garment::interpreter {

struct PersonName {
  std::string_view measure;               ///< a parameter of bodies.woman and bodies.man
  std::vector<std::string_view> aliases;  ///< Seamly's and Valentina's name first, then what tables say
  bool needed = false;                    ///< nothing stands in for it
};

/// All measures of bodies.woman and bodies.man that files may state.
const std::vector<PersonName>& person_names();
const PersonName* find_person_name(std::string_view measure);

}  // namespace garment::interpreter
