#include "interpreter/service/completion.hpp"

#include <algorithm>
#include <set>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/standard_libraries.hpp"
#include "interpreter/service/context.hpp"
#include "interpreter/service/documentation.hpp"
#include "interpreter/service/members.hpp"
#include "interpreter/service/symbols.hpp"

namespace garment::service {
namespace {

using namespace interpreter;

bool is_panel_block(const std::string& keyword) { return is_any(keyword, {"panel", "pair panel"}); }

class Proposer {
 public:
  Proposer(const grammar::Sources& sources, grammar::SourceId source, const Context& context,
           Program* program)
      : sources_(sources), context_(context), program_(program) {
    script_ = grammar::parse(sources, source, vocabulary()).script;
    symbols_ = symbols_of(script_, sources);
    record_ = find_construct(context.keyword);
  }

  std::vector<Completion> run() {
    if (context_.silent || context_.names_itself) return {};
    if (!context_.base.empty()) {
      propose_members();
    } else if (context_.after_number && context_.open.empty() && !context_.touches_number) {
      propose_units();
      propose_clauses();
    } else if (context_.after_number) {
      propose_units();
    } else if (!context_.open.empty()) {
      propose_in_bracket(context_.open.back());
    } else {
      if (context_.in_statement) propose_in_statement();
      if (context_.begins_statement) propose_statements();
    }
    return std::move(out_);
  }

 private:
  void add(std::string text, std::string kind, std::string detail, std::string doc) {
    if (text.compare(0, context_.prefix.size(), context_.prefix) != 0) return;
    if (!seen_.insert(text).second) return;
    out_.push_back({std::move(text), std::move(kind), std::move(detail), std::move(doc), context_.word_begin,
                    context_.word_end});
  }
  void add(const Member& member) { add(member.name, member.kind, member.detail, member.doc); }

  // ---- what stands first in a statement

  const ConstructRecord* block_record() const {
    return context_.blocks.empty() ? nullptr : find_construct(context_.blocks.back().keyword);
  }

  void propose_statements() {
    const ConstructRecord* block = block_record();
    for (const ConstructRecord& record : construct_table()) {
      const bool here = block == nullptr ? record.top
                                         : std::find(block->body_keywords.begin(), block->body_keywords.end(),
                                                     record.keyword) != block->body_keywords.end();
      if (here && record.supported)
        add(std::string(record.keyword), "keyword", std::string(record.form), construct_doc(record));
    }
    for (const ParserWord& word : parser_words())
      if (!(context_.both && word.word == "both")) add(word.word, "keyword", word.form, word.doc);
    if (!context_.both) propose_assignable();
  }

  /// `NAME = value` and `NAME.clause = value` are statements too.
  void propose_assignable() {
    if (!context_.blocks.empty() && is_panel_block(context_.blocks.back().keyword)) {
      for (const Member& item : own_items()) add(item);
      return;
    }
    if (!context_.blocks.empty()) return;
    for (const Symbol& symbol : symbols_)
      if (!is_any(symbol.keyword, {"let", "measure", "fn", "garment"})) add_symbol(symbol);
  }

  // ---- after the keyword

  /// The second word of `pair panel`.
  void propose_second_word() {
    for (const ConstructRecord& record : construct_table())
      if (record.keyword.starts_with(context_.target + ' '))
        add(std::string(record.keyword.substr(context_.target.size() + 1)), "keyword", std::string(record.form),
            construct_doc(record));
  }

  void propose_in_statement() {
    if (!context_.target.empty()) propose_second_word();
    const bool operands_next = context_.clause.empty();
    const bool wants_value = context_.after_operator || context_.values == 0;
    if (!operands_next && wants_value && propose_words()) return;
    if (wants_value) propose_values(wanted());
    if (!wants_value || wanted().empty()) propose_clauses();
  }

  std::string wanted() const {
    if (record_ == nullptr) return "";
    if (!context_.clause.empty()) {
      const ClauseRecord* clause = find_clause(*record_, context_.clause);
      return clause == nullptr ? "" : std::string(clause->takes);
    }
    return operands_of(*record_);
  }

  /// Words that the clause takes from a fixed choice; true if it takes nothing else.
  bool propose_words() {
    const FixedWords words = fixed_words(wanted());
    for (const std::string& word : words.words) add(word, "word", context_.clause, "");
    return words.only && !words.words.empty();
  }

  void propose_clauses() {
    if (record_ == nullptr || !context_.open.empty()) return;
    for (const ClauseRecord& clause : record_->clauses) {
      if (clause.doc.empty() || clause.word == ":" || clause.word == "=") continue;
      const bool used =
          std::find(context_.clauses.begin(), context_.clauses.end(), clause.word) != context_.clauses.end();
      if (used && record_->keyword != "seam") continue;
      add(std::string(clause.word), "clause", clause_detail(clause), std::string(clause.doc));
    }
  }

  void propose_units() {
    const ClauseRecord* clause =
        record_ == nullptr || context_.clause.empty() ? nullptr : find_clause(*record_, context_.clause);
    const bool exact = clause != nullptr && context_.open.empty() && !clause->dimension.none();
    for (const Unit& unit : unit_table()) {
      if (exact && unit.dimension != clause->dimension) continue;
      add(std::string(unit.name), "unit", describe(unit.dimension), "");
    }
  }

  // ---- values

  void add_symbol(const Symbol& symbol) {
    std::string detail = symbol.keyword;
    if (program_ != nullptr && program_->main != nullptr)
      if (Declaration* declaration = find_declaration(*program_->main->scope, symbol.name))
        if (declaration->state == Declaration::State::done)
          detail = describe_value(*program_, declaration->value);
    add(symbol.name, symbol.keyword, detail, symbol.doc);
  }

  /// Declared things of these constructs; of all if there is none.
  void propose_declared(const std::vector<std::string_view>& keywords) {
    for (const Symbol& symbol : symbols_)
      if (keywords.empty() || std::find(keywords.begin(), keywords.end(), symbol.keyword) != keywords.end())
        add_symbol(symbol);
  }

  void propose_modules() {
    for (const Statement& statement : script_.statements) {
      if (statement.keyword.text != "use") continue;
      for (const Expr& operand : statement.operands)
        if (operand.kind == ExprKind::name) add(operand.text, "module", "library", "");
      for (const Clause& clause : statement.clauses)
        for (const Expr& value : clause.values)
          if (value.kind == ExprKind::name) add(value.text, "module", "library", "");
    }
  }

  void propose_functions() {
    for (const FunctionRecord& function : function_table())
      if (function.name.find('.') == std::string_view::npos)
        add(std::string(function.name),
            function.bare && function.parameters.empty() ? "constant" : "function",
            std::string(function.form), function_doc(function));
  }

  /// Edges, darts and notches of the panel whose block this is: by the last evaluation, and as written.
  std::vector<Member> own_items() {
    std::vector<Member> items;
    const std::string name = panel_around();
    if (name.empty()) return items;
    if (program_ != nullptr)
      for (std::size_t k = 0; k < program_->panels.size(); ++k)
        if (program_->panels[k].panel.name == name) items = panel_items(*program_, static_cast<int>(k));
    for (const Symbol& symbol : symbols_)
      if (symbol.name == name) written_items(symbol, items, 0);
    return items;
  }

  std::string panel_around() const {
    for (const OpenBlock& block : context_.blocks)
      if (is_panel_block(block.keyword)) return block.name;
    return "";
  }

  void written_items(const Symbol& symbol, std::vector<Member>& items, int depth) {
    for (const Symbol& child : symbol.children) {
      const bool known =
          std::any_of(items.begin(), items.end(), [&](const Member& m) { return m.name == child.name; });
      if (child.keyword != "outline" && !known)
        items.push_back({child.name, child.keyword, child.keyword, child.doc});
      written_items(child, items, depth);
    }
    const std::size_t like = symbol.detail.find("like ");
    if (like == std::string::npos || depth > 16) return;
    const std::string source(
        symbol.detail.substr(like + 5, symbol.detail.find_first_of(" {", like + 5) - like - 5));
    const auto other =
        std::find_if(symbols_.begin(), symbols_.end(), [&](const Symbol& s) { return s.name == source; });
    if (other != symbols_.end()) written_items(*other, items, depth + 1);
  }

  void propose_values(const std::string& takes) {
    auto mentions = [&](std::string_view word) { return takes.find(word) != std::string::npos; };
    if (record_ != nullptr && record_->keyword == "use") return propose_libraries();
    const bool edges = mentions("EDGE") || mentions("SIDE") || mentions("LINE");
    if (edges || mentions("MARK") || mentions("POSITION"))
      for (const Member& item : own_items()) add(item);
    const bool narrow = !takes.empty() && propose_things(takes);
    if (narrow) return;
    propose_locals();
    propose_declared({});
    propose_modules();
    for (const Member& item : own_items()) add(item);
    propose_functions();
    for (const char* word : {"true", "false", "if", "not"}) add(word, "word", "", "");
  }

  /// Proposes the kind of thing that a place takes; true if it takes nothing else.
  bool propose_things(const std::string& takes) {
    static const std::pair<std::string_view, std::vector<std::string_view>> kinds[] = {
        {"FABRIC", {"fabric"}},
        {"PANEL", {"panel", "pair panel"}},
        {"BODY", {"body"}},
        {"LEVEL", {"body"}},
        {"EDGE", {"panel", "pair panel", "part"}},
        {"SIDE", {"panel", "pair panel", "part"}},
        {"REGION", {"region"}},
        {"LINE", {"panel", "pair panel"}},
        {"SEAM", {"seam"}},
        {"ZIP", {"zip"}},
        {"PATH", {"path"}},
        {"CLAMP", {"clamp"}},
        {"COMPONENT", {"component"}},
        {"PORT", {"part"}}};
    bool found = false;
    for (const auto& [word, keywords] : kinds) {
      if (takes.find(word) == std::string::npos) continue;
      found = true;
      propose_locals();
      propose_declared(keywords);
      if (word == "FABRIC") propose_modules();
    }
    for (const char* other : {"LENGTH", "POINT", "VALUE", "NUMBER", "ANGLE", "(X", "CONDITION", "POSITION"})
      if (takes.find(other) != std::string::npos) return false;
    return found;
  }

  /// Variables of the loops and functions around.
  void propose_locals() {
    for (const std::string& name : context_.loop_variables) add(name, "variable", "loop variable", "");
    for (const Statement& statement : script_.statements) propose_locals(statement);
  }
  void propose_locals(const Statement& statement) {
    const std::uint32_t at = context_.word_begin;
    const bool around = statement.span.begin <= at && at <= statement.span.end;
    if (!around) return;
    const bool called = statement.keyword.text == "fn" || statement.keyword.text == "component";
    if (called && !statement.operands.empty() && statement.operands[0].kind == ExprKind::call)
      for (const Parameter& parameter : parameters_of_head(statement.operands[0], sources_))
        add(parameter.name, "variable", parameter.text, "");
    if (statement.body)
      for (const Statement& inner : *statement.body) {
        propose_locals(inner);
        if (inner.keyword.text == "let" && inner.name) add(inner.name->text, "let", "let", inner.doc);
      }
  }

  void propose_libraries() {
    for (const StandardLibrary& library : kStandardLibraries)
      add(std::string(library.name), "module", "library", std::string(library.offers));
  }

  // ---- in brackets and after a dot

  void propose_in_bracket(const OpenBracket& bracket) {
    if (bracket.sign == '{' && bracket.label.empty()) {
      if (context_.keyword == "fabric" || context_.keyword == "param" || context_.keyword == "let")
        for (const std::string& field : fabric_field_names())
          if (std::find(bracket.labels.begin(), bracket.labels.end(), field) == bracket.labels.end())
            add(field, "field", "fabric", "");
      if (context_.keyword == "fabric") return;
    }
    if (bracket.sign == '(' && !bracket.callee.empty() && bracket.label.empty() && !bracket.in_value)
      propose_arguments(bracket);
    if (bracket.sign == '[' && !bracket.callee.empty()) propose_marks(bracket.callee);
    propose_values(bracket.callee.empty() ? "" : "VALUE");
  }

  void propose_arguments(const OpenBracket& bracket) {
    const auto called = find_callable(program_, bracket.callee);
    if (!called) return;
    for (const Parameter& parameter : called->parameters)
      if (!parameter.name.empty() &&
          std::find(bracket.labels.begin(), bracket.labels.end(), parameter.name) == bracket.labels.end())
        add(parameter.name + ":", "argument", parameter.text, "");
  }

  /// `side[start .. hip]`: the ends and notches of that edge.
  void propose_marks(const std::string& edge) {
    add("start", "word", edge, "");
    add("end", "word", edge, "");
    if (const auto value = base_value(edge))
      for (const Member& member : members_of(*program_, *value))
        if (member.kind == "notch") add(member);
  }

  std::optional<Value> base_value(const std::string& base) {
    if (program_ == nullptr) return std::nullopt;
    if (const std::string panel = panel_around(); !panel.empty())
      if (auto own = quiet_value(*program_, panel + '.' + base)) return own;
    return quiet_value(*program_, base);
  }

  void propose_members() {
    const std::size_t n = out_.size();
    const bool assigns = context_.keyword.empty() || context_.begins_statement;
    if (assigns) propose_item_properties();
    if (const auto value = base_value(context_.base))
      for (const Member& member : members_of(*program_, *value)) add(member);
    // As written: also what has not been evaluated yet, and what an assignment may change.
    for (const Symbol& symbol : symbols_)
      if (symbol.name == context_.base) {
        std::vector<Member> items;
        if (is_panel_block(symbol.keyword) || symbol.keyword == "component") written_items(symbol, items, 0);
        for (const Member& item : items) add(item);
        if (assigns) propose_properties(symbol.keyword);
      }
    if (out_.size() == n) propose_item_properties();
    for (const char* half : {"left", "right"})
      if (program_ != nullptr &&
          find_declaration(*program_->main->scope, context_.base + '.' + half) != nullptr)
        add(half, "half", "made by `both`", "");
  }

  void propose_properties(const std::string& keyword) {
    if (const ConstructRecord* record = find_construct(keyword))
      for (const ClauseRecord& clause : record->clauses)
        if (!clause.doc.empty() && clause.word != ":" && clause.word != "=")
          add(std::string(clause.word), "clause", clause_detail(clause), std::string(clause.doc));
  }

  /// `front.waist_dart.`, and in a panel's block `waist_dart.`: what the item's statement says.
  void propose_item_properties() {
    std::string panel = panel_around(), item = context_.base;
    if (const std::size_t dot = item.find('.'); dot != std::string::npos && panel.empty()) {
      panel = item.substr(0, dot);
      item = item.substr(dot + 1);
    }
    std::vector<Member> items;
    for (const Symbol& symbol : symbols_)
      if (symbol.name == panel) written_items(symbol, items, 0);
    for (const Member& member : items)
      if (member.name == item && member.kind != "edge" && member.kind != "close")
        propose_properties(member.kind);
  }

  const grammar::Sources& sources_;
  const Context& context_;
  Program* program_;
  const ConstructRecord* record_ = nullptr;
  grammar::Script script_;
  std::vector<Symbol> symbols_;
  std::set<std::string> seen_;
  std::vector<Completion> out_;
};

}  // namespace

std::vector<Completion> complete(const grammar::Sources& sources, grammar::SourceId source,
                                 std::uint32_t offset, const interpreter::Interpretation* interpretation) {
  const Context context = context_at(sources[source].text, offset);
  Program* program = interpretation == nullptr ? nullptr : interpretation->program.get();
  if (program != nullptr && (program->main == nullptr || program->main->scope == nullptr)) program = nullptr;
  return Proposer(sources, source, context, program).run();
}

}  // namespace garment::service
