// Components: parts of a garment that are written once and used often.
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/dependencies.hpp"
#include "interpreter/language/parts.hpp"

namespace garment::interpreter::detail {
namespace {

/// A join takes what a seam takes, but for the `:` of its first side.
std::vector<ClauseRecord> join_clauses() {
  std::vector<ClauseRecord> clauses;
  for (const ConstructRecord& record : assembly_constructs())
    if (record.keyword == "seam")
      for (const ClauseRecord& clause : record.clauses)
        if (clause.word != ":") clauses.push_back(clause);
  return clauses;
}

const std::vector<std::string_view> kComponentBody = {
    "let",       "fn",        "measure", "assert", "solve",  "fabric", "panel", "pair panel",
    "seam",      "hem",       "tack",    "zip",    "button", "layer",  "pad",   "region",
    "iron",      "starch",    "place",   "attach", "pin",    "clamp",  "force", "pressure",
    "constrain", "component", "part",    "port",   "join",   "slash",  "move",  "scale"};

}  // namespace

std::vector<ConstructRecord> structure_constructs() {
  return {
      {.keyword = "component",
       .form = "component NAME(PARAMETER: KIND = DEFAULT, ...) { ... port NAME = EDGE }",
       .doc = "a part of a garment, written once; its names are its own, and a part brings them in under the "
              "part's name",
       .example = "component flare(length_below: length, share: number = 1/2) { let more = share * length_below }",
       .has_body = true,
       .body_keywords = kComponentBody,
       .in_library = true,
       .evaluate = evaluate_component},
      {.keyword = "port",
       .declares_name = true,
       .form = "port NAME = EDGE",
       .doc = "an edge of the component that others are joined to",
       .example = "port cap = upper.cap",
       .clauses = {{"=", "EDGE", "an edge, a part of one, a line or a chain"}},
       .top = false,
       .evaluate = evaluate_port,
       .forget = forget_value},
      {.keyword = "part",
       .declares_name = true,
       .form = "part NAME = COMPONENT(ARGUMENT, NAME: ARGUMENT, ...)",
       .doc = "uses a component: its panels are NAME.PANEL, its ports NAME.PORT; assignments reach in",
       .example = "part left_cuff = strip(length(sleeve.cuff), cloth: shell)",
       .clauses = {{"=", "COMPONENT(...)", "the component and its arguments"}},
       .evaluate = evaluate_part},
      {.keyword = "join",
       .form = "join PORT [ease % | gather FACTOR | ...] to EDGE [to EDGE ...]",
       .doc = "sews a port, as `seam` does; what is stated besides speaks of the port",
       .example = "join cuff.upper_cap to sleeve.cuff",
       .clauses = join_clauses()},
  };
}

}  // namespace garment::interpreter::detail
