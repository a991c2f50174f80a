#include <algorithm>

#include "grammar/diagnostic.hpp"

namespace garment::grammar {

const std::vector<CodeInfo>& code_table() {
  static const std::vector<CodeInfo> table = {
#define GARMENT_CODE(code, title, explanation) CodeInfo{code, title, explanation},
#include "grammar/codes.def"
#undef GARMENT_CODE
  };
  return table;
}

const CodeInfo* find_code(std::string_view code) {
  const std::vector<CodeInfo>& table = code_table();
  auto row =
      std::find_if(table.begin(), table.end(), [&](const CodeInfo& info) { return info.code == code; });
  return row == table.end() ? nullptr : &*row;
}

std::string remedy_of(std::string_view code) {
  constexpr std::string_view kLead = "What to do: ";
  const CodeInfo* info = find_code(code);
  const std::size_t lead = info == nullptr ? std::string_view::npos : info->explanation.rfind(kLead);
  if (lead == std::string_view::npos) return "";
  const std::string_view text = info->explanation.substr(lead + kLead.size());
  // A full stop ends it; the points of `0 .. 1` and what stands in `code` do not.
  bool in_code = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '`') in_code = !in_code;
    const bool stop = text[k] == '.' && !in_code && (k == 0 || text[k - 1] != '.');
    if (stop && (k + 1 == text.size() || text[k + 1] == ' ' || text[k + 1] == '\n')) return std::string(text.substr(0, k));
    if (text[k] == '\n') return std::string(text.substr(0, k));
  }
  return std::string(text);
}

}  // namespace garment::grammar
