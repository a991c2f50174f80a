#pragma once
// Names side by side, as a message says them.
#include <string>
#include <vector>

#include "interpreter/language/construct_table.hpp"

namespace garment::interpreter {

/// "a, b, c".
inline std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// "a, b and c".
inline std::string enumerated(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

/// The name that was meant, else what there is: "its edges are a, b, c".
inline std::string meant_or_listed(std::string_view name, const std::vector<std::string>& names, const std::string& what) {
  const std::string meant = did_you_mean(name, names);
  return meant.empty() && !names.empty() ? what + ' ' + listed(names) : meant;
}

}  // namespace garment::interpreter
