// Words of the language whose meaning is still to come. They parse, and then give one coded error; so a
// script never means less than it says.
#include <initializer_list>

#include "interpreter/language/construct_table.hpp"

namespace garment::interpreter::detail {
namespace {

using Words = std::initializer_list<std::string_view>;

ConstructRecord later(std::string_view keyword, bool declares_name, std::string_view form,
                      std::string_view doc, Words clauses, bool has_body = false, Words body = {}) {
  ConstructRecord record;
  record.keyword = keyword;
  record.declares_name = declares_name;
  record.form = form;
  record.doc = doc;
  for (std::string_view word : clauses) record.clauses.push_back({word, "", ""});
  record.has_body = has_body;
  record.body_keywords = body;
  record.supported = false;
  return record;
}


}  // namespace

std::vector<ConstructRecord> later_constructs() {
  return {
  };
}

}  // namespace garment::interpreter::detail
