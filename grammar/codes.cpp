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

}  // namespace garment::grammar
