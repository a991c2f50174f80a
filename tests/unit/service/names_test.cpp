// Hover, uses of names, rename, remedies.
#include <map>

#include "interpreter/service/hover.hpp"
#include "interpreter/service/names.hpp"
#include "interpreter/service/rename.hpp"
#include "support.hpp"

using namespace garment;
using namespace garment::service_test;

namespace {

const service::Names& names() {
  static const service::Names once = service::names_of(good().result);
  return once;
}

/// Offset in kScript of the `skip`th place of `what`, and `into` bytes more.
std::uint32_t find(const std::string& what, std::size_t into = 0, int skip = 0) {
  std::size_t at = kScript.find(what);
  while (skip-- > 0) at = kScript.find(what, at + 1);
  REQUIRE(at != std::string::npos);
  return static_cast<std::uint32_t>(at + into);
}

std::string hover(std::uint32_t offset) {
  const auto found = service::hover_at(good().sources, good().source, offset, good().result, names());
  return found ? found->text : "";
}

bool says(const std::string& text, const std::string& what) {
  UNSCOPED_INFO(text);
  return text.find(what) != std::string::npos;
}

service::Rename rename(std::uint32_t offset, const std::string& name) {
  interpreter::InterpretOptions options;
  options.stdlib_dir = GARMENT_STDLIB_DIR;
  return service::rename_at(good().sources, good().source, offset, name, good().result, names(),
                            system_host(), options);
}

/// The script after a rename that must be accepted.
std::string renamed(std::uint32_t offset, const std::string& name) {
  const service::Rename r = rename(offset, name);
  if (r.refused) UNSCOPED_INFO(r.refused->message);
  CHECK_FALSE(r.refused);
  return service::apply_edits(kScript, r.edits);
}

std::string replaced(std::string text, const std::vector<std::pair<std::string, std::string>>& changes) {
  for (const auto& [from, to] : changes) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string refused(std::uint32_t offset, const std::string& name) {
  const service::Rename r = rename(offset, name);
  CHECK(r.edits.empty());
  return r.refused ? r.refused->code : "";
}

}  // namespace

TEST_CASE("hover tells kind, unit, value and documentation") {
  CHECK(says(hover(find("long")), "a length, 58 cm"));
  CHECK(says(hover(find("long")), "waist to hem"));
  CHECK(says(hover(find("w = 20 cm")), "a length, 20 cm"));
  CHECK(says(hover(find("front of shell")), "a panel, "));
  CHECK(says(hover(find("front of shell")), "the front piece"));
  CHECK(says(hover(find("edge side", 5)), "an edge, 58.55 cm"));
  CHECK(says(hover(find("front.side", 6)), "sewn to"));
  CHECK(says(hover(find("edge waist", 5)), "sewn, "));  // the dart takes 2 cm of 22
  CHECK(says(hover(find("form.waist", 5)), "girth"));
  CHECK(says(hover(find("bodies.woman", 7)), "A woman of an EU size"));
  CHECK(says(hover(find("20 cm before")), "a length, 20 cm"));
  CHECK(says(hover(find("dart waist_dart", 5)), "2 cm"));
}

TEST_CASE("hover tells what the tables say of words") {
  CHECK(says(hover(find("panel front")), "panel NAME of FABRIC"));
  CHECK(says(hover(find("width 2 cm")), "of the mouth, along the edge"));
  CHECK(says(hover(find("both seam")), "left and the right half"));
  CHECK(hover(find("# ")).empty());
  CHECK(hover(find("\"test\"", 2)).empty());
}

TEST_CASE("an edge knows what it is sewn to") {
  const auto drawn =
      service::partners_at(good().sources, good().source, find("edge side", 6), good().result, names());
  REQUIRE(drawn.size() >= 2);
  CHECK(drawn[0].seam == "side.left");
  const auto named =
      service::partners_at(good().sources, good().source, find("front.side", 7), good().result, names());
  REQUIRE_FALSE(named.empty());
  CHECK(service::partners_at(good().sources, good().source, find("edge hem", 6), good().result, names())
            .empty());
}

TEST_CASE("names are renamed everywhere") {
  CHECK(renamed(find("shell"), "cloth") == replaced(kScript, {{"fabric shell", "fabric cloth"},
                                                              {"of shell on", "of cloth on"},
                                                              {"of shell like", "of cloth like"}}));
  CHECK(renamed(find("long = ", 1), "skirt_length") ==
        replaced(kScript, {{"param long", "param skirt_length"},
                           {"(22 cm, long)", "(22 cm, skirt_length)"},
                           {"(0, long)", "(0, skirt_length)"}}));
  // one thing: drawn in front, taken over by `like`, in both halves
  CHECK(renamed(find("front.side", 7), "flank") == replaced(kScript, {{"edge side", "edge flank"},
                                                                      {"on side at", "on flank at"},
                                                                      {"front.side", "front.flank"},
                                                                      {"back.side", "back.flank"}}));
  CHECK(renamed(find("rename cf", 7), "fold_line") == replaced(kScript, {{"on fold cf", "on fold fold_line"},
                                                                         {"close cf", "close fold_line"},
                                                                         {"rename cf", "rename fold_line"}}));
  CHECK(renamed(find("as cb", 3), "centre") == replaced(kScript, {{"as cb", "as centre"}}));
  CHECK(renamed(find("(x: length", 1), "y") ==
        replaced(kScript, {{"(x: length", "(y: length"}, {"= x / n", "= y / n"}}));
  CHECK(renamed(find("form.waist"), "lady") == replaced(kScript, {{"body form", "body lady"},
                                                                  {"form.front", "lady.front"},
                                                                  {"form.waist", "lady.waist"},
                                                                  {"form.back", "lady.back"},
                                                                  {"form.waist", "lady.waist"}}));
  CHECK(renamed(find("waist at form"), "top") == replaced(kScript, {{"edge waist", "edge top"},
                                                                    {"on waist at", "on top at"},
                                                                    {"with waist", "with top"},
                                                                    {"with waist", "with top"}}));
}

TEST_CASE("a rename that would do harm is refused") {
  CHECK(refused(find("long"), "w") == "G0302");
  CHECK(refused(find("long"), "cm") == "G0303");
  CHECK(refused(find("long"), "sqrt") == "G0303");
  CHECK(refused(find("long"), "end") == "G0303");
  CHECK(refused(find("long"), "two words") == "G1560");
  CHECK(refused(find("long"), "") == "G1560");
  CHECK(refused(find("edge side", 6), "waist") == "G0302");
  CHECK(refused(find("denim"), "jeans") == "G1561");
  CHECK(refused(find("panel front"), "x") == "G1561");
  CHECK(refused(find("fabrics"), "x") == "G1561");
}

TEST_CASE("a rename that a parameter would catch is refused") {
  const std::string text = "let w = 20 cm\nfn wide(x) = x + w\nassert wide(1 cm) == 21 cm \"it is\"\n";
  grammar::Sources sources;
  const grammar::SourceId id = sources.add("t.garment", text);
  interpreter::InterpretOptions options;
  const auto result = interpreter::interpret(sources, id, system_host(), options);
  const auto all = service::names_of(result);
  const auto r = service::rename_at(sources, id, 4, "x", result, all, system_host(), options);
  REQUIRE(r.refused);
  CHECK(r.refused->code == "G1562");
  const auto fine = service::rename_at(sources, id, 4, "v", result, all, system_host(), options);
  CHECK(service::apply_edits(text, fine.edits) ==
        "let v = 20 cm\nfn wide(x) = x + v\nassert wide(1 cm) == 21 cm \"it is\"\n");
}

TEST_CASE("remedies that replace a word are edits") {
  const std::string text = "fabric shell = fabrics.denim\nuse fabrics\nlet v = sqr(4)\n";
  grammar::Sources sources;
  const grammar::SourceId id = sources.add("t.garment", text);
  interpreter::InterpretOptions options;
  options.stdlib_dir = GARMENT_STDLIB_DIR;
  const auto result = interpreter::interpret(sources, id, system_host(), options);
  bool found = false;
  for (const auto& d : result.diagnostics)
    for (const auto& fix : service::fixes_of(d, sources)) {
      found = true;
      CHECK(fix.title == "write `sqrt`");
      CHECK(service::apply_edits(text, {fix.edit}).find("sqrt(4)") != std::string::npos);
    }
  CHECK(found);
}

namespace {

const std::string kParts = R"(use fabrics
## a strip of cloth
component strip(cloth: fabric, long: length = 30 cm) {
  let high = 10 cm
  panel upper of cloth {
    outline from (0, 0) {
      edge lower to (long, 0) free
      edge end_side to (long, high) free
      edge rim to (0, high)
      close start_side free
    }
  }
  port top = upper.rim
}
part one = strip(fabrics.denim, long: 40 cm)
part two = strip(fabrics.linen, 40 cm)
join one.top to two.top reversed
one.upper.resolution = 2 cm
)";

struct Parts {
  grammar::Sources sources;
  grammar::SourceId source = 0;
  interpreter::InterpretOptions options;
  interpreter::Interpretation result;
  service::Names all;
  Parts() : source(sources.add("parts.garment", kParts)) {
    options.stdlib_dir = GARMENT_STDLIB_DIR;
    result = interpreter::interpret(sources, source, system_host(), options);
    all = service::names_of(result);
  }
  std::string rename(const std::string& at, std::size_t into, const std::string& name) {
    const auto offset = static_cast<std::uint32_t>(kParts.find(at) + into);
    const auto r = service::rename_at(sources, source, offset, name, result, all, system_host(), options);
    if (r.refused) UNSCOPED_INFO(r.refused->message);
    CHECK_FALSE(r.refused);
    return service::apply_edits(kParts, r.edits);
  }
};

}  // namespace

TEST_CASE("names of components are renamed in their parts too") {
  Parts parts;
  for (const auto& d : parts.result.diagnostics) UNSCOPED_INFO(d.message);
  CHECK(parts.result.ok());
  CHECK(parts.rename("top = ", 1, "seamline") ==
        replaced(kParts,
                 {{"port top", "port seamline"}, {"one.top", "one.seamline"}, {"two.top", "two.seamline"}}));
  CHECK(parts.rename("long: length", 1, "reach") == replaced(kParts, {{"long: length", "reach: length"},
                                                                      {"(long, 0)", "(reach, 0)"},
                                                                      {"(long, high)", "(reach, high)"},
                                                                      {"long: 40", "reach: 40"}}));
  CHECK(parts.rename("one.upper", 5, "face") ==
        replaced(kParts,
                 {{"panel upper", "panel face"}, {"upper.rim", "face.rim"}, {"one.upper", "one.face"}}));
  CHECK(parts.rename("two.top", 1, "other") ==
        replaced(kParts, {{"part two", "part other"}, {"two.top", "other.top"}}));
  CHECK(parts.rename("strip(fabrics", 1, "band") ==
        replaced(kParts, {{"component strip", "component band"},
                          {"strip(fabrics.denim", "band(fabrics.denim"},
                          {"strip(fabrics.linen", "band(fabrics.linen"}}));
}

TEST_CASE("a part offers its ports and its panels") {
  Parts parts;
  grammar::Sources sources;
  const std::string text = kParts + "let x = one.";
  const auto id = sources.add("asked.garment", text);
  const auto found = service::complete(sources, id, static_cast<std::uint32_t>(text.size()), &parts.result);
  CHECK(texts(found).rfind("top", 0) == 0);
  CHECK(has(found, "upper"));
}
