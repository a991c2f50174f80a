#include "interpreter/language/limit_table.hpp"

#include <fmt/format.h>

#include "runtime/base/limits.hpp"

namespace garment::interpreter {
namespace {

/// 1048576 -> "1,048,576".
std::string grouped(std::uint64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

}  // namespace

const std::vector<LimitRecord>& limit_table() {
  static const std::vector<LimitRecord> table = {
      {"source_bytes", kMaxSourceBytes, "bytes of one source file", "G0901"},
      {"tree_depth", kMaxTreeDepth, "brackets, blocks and operators within each other, chains too", "G0210"},
      {"use_depth", kMaxUseDepth, "files that use files", "G0318"},
      {"steps", kMaxSteps, "steps of evaluation", "G0317"},
      {"call_depth", kMaxCalls, "calls within calls", "G0316"},
      {"evaluation_depth", kMaxEvaluationDepth, "expressions and declarations that need each other, in a row", "G0316"},
      {"loop_statements", kMaxStatements, "statements made by loops", "G0327"},
      {"panels", kMaxPanels, "panels of a garment", "G1604"},
      {"particles", kMaxParticles, "particles of a model", "G0452"},
      {"value_bytes", kMaxValueBytes, "bytes of all texts, lists, records and curves together", "G1601"},
      {"value_depth", kMaxValueDepth, "lists and records within each other", "G1602"},
      {"text_bytes", kMaxText, "bytes of one text", "G0326"},
      {"chain_links", kMaxLinks, "edges of one chain", "G1603"},
      {"solve_depth", kMaxSolveDepth, "solves that need each other", "G1207"},
      {"mesh_bytes", kMaxMeshBytes, "bytes of one mesh file", "G0701"},
  };
  return table;
}

std::string limits_text() {
  std::string out;
  for (const LimitRecord& limit : limit_table())
    out += fmt::format("{:<18}{:>15}  {}  {}\n", limit.name, grouped(limit.value), limit.code, limit.text);
  return out;
}

std::string limits_json() {
  std::string out = "[";
  for (const LimitRecord& limit : limit_table())
    out += fmt::format("{}\n  {{\"name\": \"{}\", \"value\": {}, \"text\": \"{}\", \"code\": \"{}\"}}", out.size() > 1 ? "," : "",
                       limit.name, limit.value, limit.text, limit.code);
  return out + "\n]\n";
}

}  // namespace garment::interpreter
