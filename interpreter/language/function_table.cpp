#include "interpreter/language/function_table.hpp"

namespace garment::interpreter {

const std::vector<FunctionRecord>& function_table() {
  static const std::vector<FunctionRecord> table = [] {
    std::vector<FunctionRecord> all;
    for (auto* part : {detail::number_functions, detail::list_functions, detail::point_functions, detail::curve_functions,
                       detail::crossing_functions, detail::garment_functions, detail::drape_functions, detail::drape_test_functions,
                       detail::record_functions, detail::shape_functions, detail::cloth_functions, detail::people_functions})
      for (const FunctionRecord& record : part()) all.push_back(record);
    return all;
  }();
  return table;
}

const FunctionRecord* find_function(std::string_view name) {
  for (const FunctionRecord& record : function_table())
    if (record.name == name) return &record;
  return nullptr;
}

}  // namespace garment::interpreter
