#include "interpreter/service/hover.hpp"

#include <algorithm>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/service/context.hpp"
#include "interpreter/service/documentation.hpp"
#include "interpreter/service/locate.hpp"
#include "interpreter/service/members.hpp"
#include "interpreter/service/symbols.hpp"

namespace garment::service {
namespace {

using namespace interpreter;

const Module* module_of(const Program& program, grammar::SourceId source) {
  for (const Module& module : program.modules)
    if (module.script.source == source) return &module;
  return nullptr;
}

std::string code(const std::string& text) { return "```garment\n" + text + "\n```"; }

std::string plain_doc(const std::string& doc) { return doc.empty() ? "" : "\n\n" + doc; }

/// Blanks and line ends as one blank, at most 160 bytes.
std::string one_line(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 400)) {
    const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ' && out.back() != '(')
      out += ' ';
  }
  if (out.size() > 160) out = out.substr(0, out.find_last_of(' ', 160)) + " ...";
  return out;
}

// ---- values

Value edge_value(int panel, const PanelInfo& info, const NamedEdge& edge) {
  EdgeSpan span;
  span.panel = panel;
  span.name = info.panel.name + '.' + (edge.half.empty() ? "" : edge.half + '.') + edge.name;
  span.parts = edge.parts;
  return Value{EdgeValue{{span}}};
}

/// "upper" as written in a component is "left_sleeve.upper" in the garment.
bool is_panel_named(const std::string& name, const std::string& written) {
  if (name == written + ".left" || name == written + ".right") return true;  // of a pair
  return name == written || name.ends_with('.' + written);
}

/// The edges of its panel that a thing means: the halves of a fold. Panels that are `like` it have edges of
/// their own.
std::vector<EdgeValue> edges_of(const Program& program, const Named& thing) {
  std::vector<EdgeValue> found;
  for (std::size_t k = 0; k < program.panels.size(); ++k)
    for (const NamedEdge& edge : program.panels[k].edges)
      if (is_panel_named(program.panels[k].panel.name, thing.owner) && edge.name == thing.name)
        found.push_back(*edge_value(static_cast<int>(k), program.panels[k], edge).as<EdgeValue>());
  return found;
}

bool overlap(const design::EdgePart& a, const design::EdgePart& b) {
  if (a.panel != b.panel || a.edge != b.edge || a.on != b.on) return false;
  const double low = std::max(std::min(a.from, a.to), std::min(b.from, b.to));
  const double high = std::min(std::max(a.from, a.to), std::max(b.from, b.to));
  return high - low > 1e-6;
}

bool shares(const EdgeValue& a, const EdgeValue& b) {
  for (const EdgeSpan& x : a.spans)
    for (const EdgeSpan& y : b.spans)
      for (const design::EdgePart& p : x.parts)
        for (const design::EdgePart& q : y.parts)
          if (overlap(p, q)) return true;
  return false;
}

std::vector<Span> drawn_at(const Program& program, const EdgeValue& edge) {
  std::vector<Span> places;
  for (std::size_t k = 0; k < program.panels.size(); ++k)
    for (const NamedEdge& named : program.panels[k].edges) {
      const Value whole = edge_value(static_cast<int>(k), program.panels[k], named);
      if (named.half.empty() && program.panels[k].folded && !edge.spans.empty() &&
          edge.spans[0].parts.size() < 2)
        continue;
      if (!shares(*whole.as<EdgeValue>(), edge)) continue;
      if (std::find(places.begin(), places.end(), named.span) == places.end()) places.push_back(named.span);
    }
  return places;
}

std::vector<Partner> partners_of(const Program& program, const EdgeValue& edge) {
  std::vector<Partner> partners;
  for (const SeamInfo& seam : program.seams)
    for (std::size_t k = 0; k < seam.sides.size(); ++k) {
      if (!shares(seam.sides[k], edge)) continue;
      for (std::size_t j = 0; j < seam.sides.size(); ++j) {
        if (j == k) continue;
        Partner partner{seam.seam.name, show(Value{seam.sides[j]}),
                        j < seam.spans.size() ? seam.spans[j] : Span{}, drawn_at(program, seam.sides[j])};
        const bool known = std::any_of(partners.begin(), partners.end(), [&](const Partner& p) {
          return p.seam == partner.seam && p.edges == partner.edges;
        });
        if (!known) partners.push_back(std::move(partner));
      }
    }
  return partners;
}

std::string sewn_to(const std::vector<Partner>& partners) {
  std::string text;
  for (const Partner& p : partners) text += "\n- sewn to `" + p.edges + "` by seam `" + p.seam + "`";
  return text.empty() ? "" : "\n" + text;
}

// ---- what stands under the pointer

class Teller {
 public:
  Teller(const grammar::Sources& sources, grammar::SourceId source, std::uint32_t offset,
         const Interpretation& interpretation, const Names& names)
      : sources_(sources),
        source_(source),
        offset_(offset),
        program_(*interpretation.program),
        names_(names) {
    module_ = module_of(program_, source);
    if (module_ != nullptr) located_ = locate(module_->script, offset);
    for (const NameUse* use : names.at(source, offset))
      if (use_ == nullptr || use->span.begin > use_->span.begin) use_ = use;
  }

  std::optional<Hover> hover() {
    if (module_ == nullptr || located_.statements.empty()) return std::nullopt;
    if (use_ != nullptr) return Hover{tell_name(*use_), use_->span};
    if (auto told = tell_expression()) return told;
    const Statement& statement = *located_.statements.back();
    if (holds(statement.keyword.span, offset_)) return tell_keyword(statement);
    const ConstructRecord* record = find_construct(statement.keyword.text);
    if (located_.clause != nullptr && record != nullptr && holds(located_.clause->word.span, offset_))
      if (const ClauseRecord* clause = find_clause(*record, located_.clause->word.text))
        return tell_clause(*clause);
    return std::nullopt;
  }

  std::vector<Partner> partners() {
    std::vector<Partner> all;
    auto take = [&](const EdgeValue& edge) {
      for (Partner& partner : partners_of(program_, edge)) all.push_back(std::move(partner));
    };
    if (use_ != nullptr && use_->declares)
      for (const EdgeValue& edge : edges_of(program_, names_.things[static_cast<std::size_t>(use_->thing)]))
        take(edge);
    if (!all.empty()) return all;
    if (const auto value = value_here())
      if (const auto* edge = value->as<EdgeValue>()) take(*edge);
    return all;
  }

 private:
  std::optional<Hover> tell_keyword(const Statement& statement) {
    const ConstructRecord* record = find_construct(statement.keyword.text);
    if (record != nullptr)
      return Hover{code(std::string(record->form)) + "\n" + construct_doc(*record), statement.keyword.span};
    for (const ParserWord& word : parser_words())
      if (word.word == statement.keyword.text)
        return Hover{code(word.form) + "\n" + word.doc, statement.keyword.span};
    return std::nullopt;
  }

  std::optional<Hover> tell_clause(const ClauseRecord& clause) {
    std::string text =
        code(std::string(clause.word) + (clause.takes.empty() ? "" : ' ' + std::string(clause.takes)));
    text += "\n" + std::string(clause.doc.empty() ? "not supported yet" : clause.doc);
    const std::string detail = clause_detail(clause);
    if (detail.size() > clause.takes.size()) text += "\n\n" + detail;
    return Hover{text, located_.clause->word.span};
  }

  /// The expression that ends with the word under the pointer: `front.left.side` on `side`.
  const Expr* expression_here() const {
    for (std::size_t k = located_.exprs.size(); k-- > 0;) {
      const Expr& expr = *located_.exprs[k];
      if (expr.kind == ExprKind::member) return &expr;
      if (expr.kind == ExprKind::name || expr.kind == ExprKind::number) return &expr;
      if (expr.kind != ExprKind::text) return nullptr;
    }
    return nullptr;
  }

  std::optional<Value> value_here() {
    if (use_ != nullptr && use_->declares)
      return declared_value(names_.things[static_cast<std::size_t>(use_->thing)]);
    const Expr* expr = expression_here();
    if (expr == nullptr) return std::nullopt;
    if (const std::string panel = own_panel(); !panel.empty() && expr->kind == ExprKind::name)
      if (auto own = quiet_value(program_, panel + '.' + expr->text)) return own;
    return quiet_value(program_, *expr, *scope_at(*module_, located_));
  }

  /// The panel in whose block a name stands that means one of the panel's own things.
  std::string own_panel() const {
    if (use_ == nullptr) return "";
    const Named& thing = names_.things[static_cast<std::size_t>(use_->thing)];
    return thing.part_of < 0 ? "" : names_.things[static_cast<std::size_t>(thing.part_of)].name;
  }

  std::optional<Value> declared_value(const Named& thing) {
    if (thing.part_of >= 0) return quiet_value(program_, thing.owner + '.' + thing.name);
    for (const Declaration& declaration : program_.declarations) {
      if (declaration.state != Declaration::State::done || declaration.statement == nullptr) continue;
      const Span* span = declared_span(*declaration.statement);
      if (span != nullptr && *span == thing.definition) return declaration.value;
    }
    return std::nullopt;
  }

  /// First line of the statement that declares a thing.
  std::string head_of(const Named& thing) const {
    if (thing.keyword == "parameter") return std::string(sources_.text(thing.statement));
    if (thing.keyword == "variable") return "for " + thing.name + " in ...";
    std::string text(sources_.text(thing.statement));
    if (thing.keyword == "fn") return one_line(text);
    if (const std::size_t line = text.find('\n'); line != std::string::npos) text.resize(line);
    if (text.size() > 160) text = text.substr(0, text.find_last_of(' ', 160)) + " ...";
    return text;
  }

  std::string tell_name(const NameUse& use) {
    const Named& thing = names_.things[static_cast<std::size_t>(use.thing)];
    std::string text = code(head_of(thing));
    std::optional<Value> value = value_here();
    const bool called = value && value->as<FunctionValue>() != nullptr;
    if (value && !called) text += "\n" + describe_value(program_, *value);
    std::vector<EdgeValue> edges;
    if (value && value->as<EdgeValue>() != nullptr) edges.push_back(*value->as<EdgeValue>());
    if (edges.empty() && !value) edges = edges_of(program_, thing);
    if (!value && !edges.empty()) text += "\n" + describe_value(program_, Value{edges.front()});
    std::vector<Partner> sewn = partners();
    text += sewn_to(sewn);
    text += plain_doc(thing.doc);
    if (!thing.owner.empty() && thing.part_of >= 0) text += "\n\nof panel `" + thing.owner + "`";
    return text;
  }

  std::optional<Hover> tell_expression() {
    const Expr* expr = expression_here();
    if (expr == nullptr) return std::nullopt;
    const Span span = expr->kind == ExprKind::member ? expr->name_span : expr->span;
    if (!holds(span, offset_)) return std::nullopt;
    if (expr->kind == ExprKind::number) return tell_number(*expr);
    if (expr->kind == ExprKind::name)
      if (const FunctionRecord* function = find_function(expr->text))
        return Hover{code(std::string(function->form)) + "\n" + function_doc(*function), span};
    const auto value = quiet_value(program_, *expr, *scope_at(*module_, located_));
    if (!value) return std::nullopt;
    return Hover{code(std::string(sources_.text(expr->span))) + "\n" + describe_value(program_, *value) +
                     levels_of(*value),
                 span};
  }

  /// `form.waist`: height and girth of a level.
  std::string levels_of(const Value& value) {
    if (value.as<BodyPlaceValue>() == nullptr) return "";
    std::string text;
    for (const Member& member : members_of(program_, value))
      if (member.kind == "length") text += (text.empty() ? ": " : ", ") + member.name + " " + member.detail;
    return text;
  }

  std::optional<Hover> tell_number(const Expr& expr) {
    if (expr.unit.empty()) return std::nullopt;
    const auto value = quiet_value(program_, expr, *module_->scope);
    const auto* q = value ? value->as<Quantity>() : nullptr;
    if (q == nullptr) return std::nullopt;
    const std::string shown = format_quantity(q->value, q->dimension, q->percent, 6);
    return Hover{describe(q->dimension) + ", " + shown, expr.span};
  }

  const grammar::Sources& sources_;
  grammar::SourceId source_;
  std::uint32_t offset_;
  Program& program_;
  const Names& names_;
  const Module* module_ = nullptr;
  Located located_;
  const NameUse* use_ = nullptr;
};

}  // namespace

std::optional<Hover> hover_at(const grammar::Sources& sources, grammar::SourceId source, std::uint32_t offset,
                              const Interpretation& interpretation, const Names& names) {
  return Teller(sources, source, offset, interpretation, names).hover();
}

std::vector<Partner> partners_at(const grammar::Sources& sources, grammar::SourceId source,
                                 std::uint32_t offset, const Interpretation& interpretation,
                                 const Names& names) {
  return Teller(sources, source, offset, interpretation, names).partners();
}

std::optional<Signature> signature_at(const grammar::Sources& sources, grammar::SourceId source,
                                      std::uint32_t offset, const Interpretation* interpretation) {
  const Context context = context_at(sources[source].text, offset);
  for (std::size_t k = context.open.size(); k-- > 0;) {
    const OpenBracket& bracket = context.open[k];
    if (bracket.sign != '(' || bracket.callee.empty()) continue;
    Program* program = interpretation == nullptr ? nullptr : interpretation->program.get();
    const auto called = find_callable(program, bracket.callee);
    if (!called) return std::nullopt;
    Signature signature{called->form, called->doc, {}, bracket.commas};
    for (std::size_t p = 0; p < called->parameters.size(); ++p) {
      signature.parameters.push_back(called->parameters[p].text);
      if (!bracket.label.empty() && called->parameters[p].name == bracket.label)
        signature.active = static_cast<int>(p);
    }
    return signature;
  }
  return std::nullopt;
}

}  // namespace garment::service
