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

const Words kActs = {"drape", "expect", "save", "record", "release"};

}  // namespace

std::vector<ConstructRecord> later_constructs() {
  return {
      later("vary", false, "vary NAME over VALUE, ... { ... }", "a study side by side", {"over"}, true,
            kActs),
      later("record", false, "record curve VALUE, VALUE every TIME as \"FILE\"", "writes a curve",
            {"every", "as"}),
      later("release", false, "release NAME", "lets a pin or clamp go", {}),
      later("wind", false, "wind (X, Y, Z)", "moving air", {"gust"}),
      later("drag", false, "drag FACTOR", "air drag", {}),
      later("solver", false, "solver NAME", "chooses the simulator", {"step"}),
      later("clamp", true, "clamp NAME: REGION [path PATH]", "holds a region", {":", "path"}),
      later("force", true, "force NAME on PANEL at POINT", "a force on a point", {"on", "at", "of", "by"}),
      later("pressure", true, "pressure NAME on PANEL of PRESSURE", "a pressure on a panel", {"on", "of"}),
      later("constrain", false, "constrain distance | on_line | on_plane | equal ...",
            "a bilateral constraint", {"to", "on", "at"}),
      later("path", true, "path NAME of BODY { ... }", "a body's motion in time", {"of", "for", "to", "="}, true),
      later("friction", false, "friction A B MU", "friction of a pair", {}),
  };
}

}  // namespace garment::interpreter::detail
