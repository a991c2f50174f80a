#pragma once
// A small vocabulary that covers the script of the language's design, and short cuts to parse with it.
#include <string>

#include "grammar/syntax_tree.hpp"

namespace garment::grammar::test {

inline const Vocabulary& vocabulary() {
  static const Vocabulary made = [] {
    Vocabulary v;
    auto add = [&v](std::string keyword, bool named, std::vector<std::string> clauses,
                    std::vector<std::string> body = {}) {
      bool has_body = !body.empty();
      v.keywords.push_back({std::move(keyword), named, std::move(clauses), has_body, std::move(body)});
    };
    std::vector<std::string> panel_body = {"outline", "grain", "dart", "notch",
                                           "rename",  "hole",  "line", "replace edge"};
    add("garment", false, {});
    add("use", false, {});
    add("param", true, {"=", "in"});
    add("let", true, {"="});
    add("fn", false, {"="});
    add("body", true, {"="});
    add("fabric", true, {"=", "kes"});
    add("panel", true, {"of", "on", "like", "mirrored", "under", "over"}, panel_body);
    add("pair panel", true, {"of", "on", "like"}, panel_body);
    add("outline", false, {"from"}, {"edge", "close", "free"});
    add("edge", true, {"to", "by", "heading", "length", "along", "offset", "through", "tangents", "bulge"});
    add("replace edge", true, {"to", "by", "through", "tangents"});
    add("close", true, {});
    add("free", false, {});
    add("grain", false, {});
    add("line", true, {"from", "to", "through"});
    add("hole", true, {}, {"edge", "close"});
    add("dart", true, {"on", "at", "take", "depth", "to", ":"});
    add("notch", true, {"on", "at"});
    add("rename", false, {"as"});
    add("seam", true, {":", "to", "ease", "start", "reversed", "gather"});
    add("zip", true, {":", "to", "open"});
    add("hem", true, {"on", "turn", "to"});
    add("iron", true, {"along", "in", "fold", "to", "set", "radius"});
    add("place", false, {"on", "with", "at", "offset", "around", "turn"});
    add("attach", false, {"to", "slide", "hold"});
    add("region", true, {"in", ":", "within", "of", "above", "and", "or"});
    add("drape", false, {"until", "for", "settle"});
    add("expect", false, {"within", "is"});
    add("assert", false, {});
    add("save", false, {});
    add("vary", false, {"over"}, {"drape", "save", "expect"});
    add("component", true, {}, {"panel", "seam", "port", "let"});
    add("port", true, {"="});
    v.top = {"garment",    "use",    "param",  "let",  "fn",   "body",     "fabric", "panel",
             "pair panel", "seam",   "zip",    "hem",  "iron", "place",    "attach", "region",
             "drape",      "expect", "assert", "save", "vary", "component"};
    v.units = {"m", "cm", "mm", "inch", "deg", "rad", "%", "g", "kg", "gf", "N", "s", "ms"};
    return v;
  }();
  return made;
}

struct Parsed {
  Sources sources;
  ParseResult result;
};

inline Parsed parse_text(std::string text) {
  Parsed parsed;
  SourceId id = parsed.sources.add("test.garment", std::move(text));
  parsed.result = parse(parsed.sources, id, vocabulary());
  return parsed;
}

/// All diagnostics as a person sees them.
inline std::string rendered(const Parsed& parsed) {
  std::string out;
  for (const Diagnostic& d : parsed.result.diagnostics) out += render(d, parsed.sources, false);
  return out;
}

/// The outline of the tree, or the diagnostics if there are any.
inline std::string outline(std::string text) {
  Parsed parsed = parse_text(std::move(text));
  return parsed.result.diagnostics.empty() ? to_outline(parsed.result.script) : rendered(parsed);
}

/// The codes of the diagnostics, joined by blanks.
inline std::string codes(std::string text) {
  std::string out;
  for (const Diagnostic& d : parse_text(std::move(text)).result.diagnostics)
    out += (out.empty() ? "" : " ") + d.code;
  return out;
}

/// The script of the language's design, section 4, with the block that it leaves out.
extern const char* const kSkirt;

}  // namespace garment::grammar::test
