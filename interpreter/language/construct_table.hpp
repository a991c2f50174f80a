#pragma once
// The one record of every construct and every builtin function. The parser's vocabulary, argument checks,
// did-you-mean, help and the reference page are all made from it.
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax_tree.hpp"
#include "interpreter/language/units.hpp"

namespace garment::interpreter {

struct Program;
struct Declaration;
struct Item;
struct Value;

/// The remedy where a word of the language has no meaning yet.
inline constexpr const char* kStillToCome = "its meaning is still to come; leave it out for now";

/// A clause word and what it takes. Where it takes one quantity, `dimension`, `min` and `max` (SI) are
/// checked when the clause is read; min > max means "no bounds".
struct ClauseRecord {
  std::string_view word;
  std::string_view takes;  ///< "LENGTH", "POINT", "EDGE"; empty: the word stands alone
  std::string_view doc;
  Dimension dimension{};
  double min = 1, max = 0;
  std::string_view standard{};  ///< what is taken when the clause is left out, as text
};

struct ConstructRecord {
  std::string_view keyword;
  bool declares_name = false;
  std::string_view form;  ///< the statement's shape: "pin NAME on PANEL at POINT"
  std::string_view doc;
  std::string_view example;
  std::vector<ClauseRecord> clauses{};
  bool has_body = false;
  std::vector<std::string_view> body_keywords{};
  bool top = true;          ///< stands at the top level
  bool supported = true;    ///< otherwise a known word whose meaning is still to come
  bool in_library = false;  ///< may stand in a used file
  /// Gives a declaration its meaning and its value; null for constructs that declare nothing.
  Value (*evaluate)(Program&, Declaration&) = nullptr;
  /// Makes room for a declaration in the garment and gives its index there, so that others may speak of it
  /// before it is evaluated.
  int (*reserve)(Program&, const Declaration&) = nullptr;
  /// Takes back what `evaluate` put into the garment, so that the declaration can be evaluated again (`solve`, the
  /// prompt). `forget_value` where it leaves nothing but the value; null: it cannot be evaluated again.
  void (*forget)(Program&, Declaration&) = nullptr;
  /// Runs a statement that declares nothing, or what is left to do for a declaration in the order of the script.
  void (*run)(Program&, const Item&) = nullptr;
};

/// Every construct, in the order of the reference.
const std::vector<ConstructRecord>& construct_table();
const ConstructRecord* find_construct(std::string_view keyword);
const ClauseRecord* find_clause(const ConstructRecord& construct, std::string_view word);

/// What the parser must know, made from the table.
const grammar::Vocabulary& vocabulary();

/// Text for `:help NAME`: form, doc, clauses with range and default, example. Empty if there is no such word.
std::string help_text(std::string_view name);

/// The reference of all constructs, functions and units as Markdown; docs/language.md holds it.
std::string reference_markdown();

/// The name of `candidates` nearest to `name`, if it is near enough to be a slip; else empty.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);
/// "did you mean `x`?" or empty.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// For a word that is none of the construct's: the clause word it may be a slip of, else all of them.
std::string words_hint(const ConstructRecord& construct, std::string_view word);

namespace detail {
std::vector<ConstructRecord> basics_constructs();
std::vector<ConstructRecord> cloth_constructs();
std::vector<ConstructRecord> panel_constructs();
std::vector<ConstructRecord> assembly_constructs();
std::vector<ConstructRecord> structure_constructs();
std::vector<ConstructRecord> scene_constructs();
std::vector<ConstructRecord> forces_constructs();
std::vector<ConstructRecord> acts_constructs();
}  // namespace detail

}  // namespace garment::interpreter
