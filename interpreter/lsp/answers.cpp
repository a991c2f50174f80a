#include "interpreter/lsp/answers.hpp"

#include <algorithm>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/program.hpp"
#include "interpreter/service/completion.hpp"
#include "interpreter/service/hover.hpp"
#include "interpreter/service/rename.hpp"
#include "interpreter/service/symbols.hpp"

namespace garment::lsp {
namespace {

using grammar::Span;

constexpr std::size_t kMaxCompletions = 500;

Json markdown(const std::string& text) { return Json{{"kind", "markdown"}, {"value", text}}; }

/// Places in the files of one analysis, as the protocol has them.
class Places {
 public:
  Places(const Analysis& analysis, Encoding encoding) : analysis_(analysis), encoding_(encoding) {}

  Json range(Span span) { return lines(span.source).range(span); }
  Json location(Span span) {
    return Json{{"uri", uri_of(analysis_.sources[span.source].name)}, {"range", range(span)}};
  }

 private:
  const Lines& lines(grammar::SourceId source) {
    const auto known = lines_.find(source);
    if (known != lines_.end()) return known->second;
    return lines_.emplace(source, Lines(analysis_.sources[source].text, encoding_)).first->second;
  }

  const Analysis& analysis_;
  Encoding encoding_;
  std::map<grammar::SourceId, Lines> lines_;
};

int completion_kind(const std::string& kind) {
  static const std::map<std::string, int, std::less<>> kinds = {
      {"keyword", 14}, {"clause", 14},  {"word", 14}, {"function", 3}, {"fn", 3},     {"constant", 21},
      {"unit", 11},    {"panel", 7},    {"edge", 5},  {"close", 5},    {"dart", 5},   {"notch", 5},
      {"line", 5},     {"point", 5},    {"half", 5},  {"param", 6},    {"let", 6},    {"measure", 6},
      {"variable", 6}, {"argument", 6}, {"body", 7},  {"fabric", 7},   {"level", 20}, {"part", 20},
      {"length", 10},  {"number", 10},  {"field", 5}, {"module", 9},   {"seam", 18},  {"component", 7}};
  const auto found = kinds.find(kind);
  return found == kinds.end() ? 6 : found->second;
}

int symbol_kind(const std::string& keyword) {
  static const std::map<std::string, int, std::less<>> kinds = {
      {"panel", 5},   {"pair panel", 5}, {"component", 5}, {"outline", 3}, {"edge", 8},     {"close", 8},
      {"dart", 8},    {"notch", 20},     {"param", 14},    {"let", 13},    {"measure", 13}, {"fn", 12},
      {"seam", 11},   {"zip", 11},       {"body", 19},     {"fabric", 23}, {"region", 22},  {"layer", 23},
      {"button", 24}, {"pin", 20},       {"hole", 8}};
  const auto found = kinds.find(keyword);
  return found == kinds.end() ? 13 : found->second;
}

Json symbol_json(const service::Symbol& symbol, const Lines& lines) {
  Json json{{"name", symbol.name},
            {"kind", symbol_kind(symbol.keyword)},
            {"range", lines.range(symbol.span)},
            {"selectionRange", lines.range(symbol.name_span)}};
  json["detail"] = symbol.keyword + (symbol.detail.empty() ? "" : ' ' + symbol.detail);
  Json children = Json::array();
  for (const service::Symbol& child : symbol.children) children.push_back(symbol_json(child, lines));
  if (!children.empty()) json["children"] = children;
  return json;
}

Json edits_json(const std::vector<service::Edit>& edits, const Lines& lines) {
  Json json = Json::array();
  for (const service::Edit& edit : edits)
    json.push_back({{"range", lines.range(edit.span)}, {"newText", edit.text}});
  return json;
}

/// Things named at the place.
std::vector<int> things_at(const Question& q) {
  std::vector<int> things;
  for (const service::NameUse* use : q.now().names.at(q.now().source, q.offset()))
    if (std::find(things.begin(), things.end(), use->thing) == things.end()) things.push_back(use->thing);
  return things;
}

std::vector<const service::NameUse*> uses_at(const Question& q) {
  std::vector<const service::NameUse*> uses;
  for (const int thing : things_at(q))
    for (const service::NameUse* use : q.now().names.of(thing)) uses.push_back(use);
  return uses;
}

/// `use fabrics` means a file.
std::optional<Json> library_place(const Question& q, const service::Named& thing) {
  if (thing.keyword != "library") return std::nullopt;
  for (const interpreter::Module& module : q.now().result.program->modules) {
    if (!module.library) continue;
    const auto& values = q.now().result.program->main->scope->values;
    const auto value = values.find(thing.name);
    if (value == values.end() || value->second.as<interpreter::ModuleValue>() == nullptr) continue;
    if (value->second.as<interpreter::ModuleValue>()->module == &module)
      return Places(q.now(), q.encoding).location({module.script.source, 0, 0});
  }
  return std::nullopt;
}

}  // namespace

Json answer_hover(const Question& q) {
  const auto hover =
      service::hover_at(q.now().sources, q.now().source, q.offset(), q.now().result, q.now().names);
  if (!hover) return nullptr;
  return Json{{"contents", markdown(hover->text)}, {"range", q.lines().range(hover->span)}};
}

Json answer_completion(const Question& q) {
  const Analysis* good = q.document.good ? q.document.good.get() : nullptr;
  const std::vector<service::Completion> found =
      service::complete(q.now().sources, q.now().source, q.offset(), good ? &good->result : &q.now().result);
  const Lines lines = q.lines();
  Json items = Json::array();
  for (std::size_t k = 0; k < found.size() && k < kMaxCompletions; ++k) {
    const service::Completion& c = found[k];
    char order[8];
    std::snprintf(order, sizeof order, "%04zu", k);
    const Span span{q.now().source, c.replace_begin, c.replace_end};
    Json item{{"label", c.text}, {"kind", completion_kind(c.kind)}};
    if (!c.detail.empty()) item["detail"] = c.detail;
    if (!c.doc.empty()) item["documentation"] = markdown(c.doc);
    item["sortText"] = order;
    item["textEdit"] = Json{{"range", lines.range(span)}, {"newText", c.text}};
    items.push_back(std::move(item));
  }
  return Json{{"isIncomplete", found.size() > kMaxCompletions}, {"items", items}};
}

Json answer_signature(const Question& q) {
  const Analysis* good = q.document.good ? q.document.good.get() : nullptr;
  const auto signature = service::signature_at(q.now().sources, q.now().source, q.offset(),
                                               good ? &good->result : &q.now().result);
  if (!signature) return nullptr;
  Json parameters = Json::array();
  for (const std::string& text : signature->parameters) parameters.push_back({{"label", text}});
  Json one{
      {"label", signature->form}, {"documentation", markdown(signature->doc)}, {"parameters", parameters}};
  return Json{
      {"signatures", Json::array({one})}, {"activeSignature", 0}, {"activeParameter", signature->active}};
}

Json answer_definition(const Question& q) {
  Places at(q.now(), q.encoding);
  Json places = Json::array();
  for (const int id : things_at(q)) {
    const service::Named& thing = q.now().names.things[static_cast<std::size_t>(id)];
    const auto library = library_place(q, thing);
    places.push_back(library ? *library : at.location(thing.definition));
  }
  return places;
}

Json answer_references(const Question& q) {
  Places at(q.now(), q.encoding);
  const bool declaration = q.params.value("context", Json::object()).value("includeDeclaration", true);
  Json places = Json::array();
  for (const service::NameUse* use : uses_at(q))
    if (declaration || !use->declares) places.push_back(at.location(use->span));
  return places;
}

Json answer_highlight(const Question& q) {
  Json places = Json::array();
  const Lines lines = q.lines();
  for (const service::NameUse* use : uses_at(q))
    if (use->span.source == q.now().source)
      places.push_back({{"range", lines.range(use->span)}, {"kind", use->declares ? 3 : 2}});
  return places;
}

Json answer_partners(const Question& q) {
  Places at(q.now(), q.encoding);
  Json places = Json::array();
  const auto partners =
      service::partners_at(q.now().sources, q.now().source, q.offset(), q.now().result, q.now().names);
  for (const service::Partner& partner : partners)
    for (const Span& span : partner.definitions) {
      Json place = at.location(span);
      if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(std::move(place));
    }
  return places;
}

Json answer_symbols(const Question& q) {
  Json symbols = Json::array();
  const Lines lines = q.lines();
  for (const service::Symbol& symbol : service::symbols_of(*q.now().result.script, q.now().sources))
    symbols.push_back(symbol_json(symbol, lines));
  return symbols;
}

Json answer_folding(const Question& q) {
  Json folds = Json::array();
  const Lines lines = q.lines();
  for (const service::Fold& fold : service::folds_of(*q.now().result.script, q.now().sources)) {
    const Json range = lines.range(fold.span);
    const auto first = range["start"]["line"].get<int>(),
               last = range["end"]["line"].get<int>() - (fold.comment ? 0 : 1);
    if (last <= first) continue;
    Json json{{"startLine", first}, {"endLine", last}};
    if (fold.comment) json["kind"] = "comment";
    folds.push_back(json);
  }
  return folds;
}

Json answer_formatting(const Question& q) {
  const grammar::FormatResult formatted =
      grammar::format(q.now().sources, q.now().source, interpreter::vocabulary());
  if (!formatted.diagnostics.empty()) return nullptr;
  if (formatted.text == q.document.text) return Json::array();
  const Span all{q.now().source, 0, static_cast<std::uint32_t>(q.document.text.size())};
  return edits_json({{all, formatted.text}}, q.lines());
}

Json answer_actions(const Question& q) {
  const Lines lines = q.lines();
  const std::uint32_t begin = lines.offset(q.params.at("range").at("start")),
                      end = lines.offset(q.params["range"].at("end"));
  Json actions = Json::array();
  for (const grammar::Diagnostic& d : q.now().result.diagnostics) {
    if (d.labels.empty()) continue;
    const Span span = d.labels[0].span;
    if (span.source != q.now().source || span.end < begin || span.begin > end) continue;
    for (const service::Fix& fix : service::fixes_of(d, q.now().sources)) {
      if (fix.edit.span.source != q.now().source) continue;
      Json changes = Json::object();
      changes[q.document.uri] = edits_json({fix.edit}, lines);
      actions.push_back({{"title", fix.title},
                         {"kind", "quickfix"},
                         {"isPreferred", true},
                         {"edit", {{"changes", changes}}}});
    }
  }
  return actions;
}

Json answer_prepare_rename(const Question& q) {
  const service::Renamable found =
      service::renamable_at(q.now().source, q.offset(), q.now().result, q.now().names);
  if (!found.use) throw Refused{-32803, found.why};
  const service::Named& thing = q.now().names.things[static_cast<std::size_t>(found.use->thing)];
  return Json{{"range", q.lines().range(found.use->span)}, {"placeholder", thing.name}};
}

Json answer_rename(const Question& q) {
  const std::string name = q.params.at("newName").get<std::string>();
  const service::Rename rename =
      service::rename_at(q.now().sources, q.now().source, q.offset(), name, q.now().result, q.now().names,
                         q.documents.host(), q.documents.options_of(q.document.uri));
  if (rename.refused)
    throw Refused{-32803,
                  rename.refused->code + ": " + rename.refused->message + "; " + rename.refused->help};
  Json changes = Json::object();
  changes[q.document.uri] = edits_json(rename.edits, q.lines());
  return Json{{"changes", changes}};
}

// ---- semantic tokens

namespace {

const std::vector<std::string> kTokenKinds = {"keyword",  "property", "class",     "parameter",
                                              "variable", "function", "namespace", "enumMember"};

int token_kind(const std::string& keyword) {
  if (keyword == "panel" || keyword == "component" || keyword == "pair panel" || keyword == "fabric" ||
      keyword == "body")
    return 2;
  if (keyword == "param" || keyword == "parameter") return 3;
  if (keyword == "fn") return 5;
  if (keyword == "library") return 6;
  return keyword == "edge" || keyword == "close" || keyword == "dart" || keyword == "notch" ||
                 keyword == "seam"
             ? 7
             : 4;
}

void word_tokens(const grammar::Block& block, std::map<std::uint32_t, std::pair<Span, int>>& tokens) {
  for (const grammar::Statement& statement : block) {
    const char first = statement.keyword.text.empty() ? '=' : statement.keyword.text[0];
    if (first != '=') tokens.emplace(statement.keyword.span.begin, std::pair(statement.keyword.span, 0));
    for (const grammar::Clause& clause : statement.clauses)
      if (clause.word.text != ":" && clause.word.text != "=")
        tokens.emplace(clause.word.span.begin, std::pair(clause.word.span, 1));
    if (statement.body) word_tokens(*statement.body, tokens);
    if (statement.else_body) word_tokens(*statement.else_body, tokens);
  }
}

}  // namespace

Json token_legend() {
  return Json{{"tokenTypes", kTokenKinds}, {"tokenModifiers", Json::array({"declaration"})}};
}

Json answer_tokens(const Question& q) {
  std::map<std::uint32_t, std::pair<Span, int>> tokens;
  std::set<std::uint32_t> declaring;
  for (const service::NameUse& use : q.now().names.uses) {
    if (use.span.source != q.now().source || use.span.end == use.span.begin) continue;
    tokens.emplace(
        use.span.begin,
        std::pair(use.span, token_kind(q.now().names.things[static_cast<std::size_t>(use.thing)].keyword)));
    if (use.declares) declaring.insert(use.span.begin);
  }
  word_tokens(q.now().result.script->statements, tokens);
  Json data = Json::array();
  const Lines lines = q.lines();
  std::int64_t line = 0, column = 0;
  std::uint32_t end = 0;
  for (const auto& [begin, token] : tokens) {
    const Json range = lines.range(token.first);
    const auto at_line = range["start"]["line"].get<std::int64_t>(),
               at = range["start"]["character"].get<std::int64_t>();
    if (begin < end || range["end"]["line"] != range["start"]["line"]) continue;
    end = token.first.end;
    data.push_back(at_line - line);
    data.push_back(at_line == line ? at - column : at);
    data.push_back(range["end"]["character"].get<std::int64_t>() - at);
    data.push_back(token.second);
    data.push_back(declaring.contains(begin) ? 1 : 0);
    line = at_line;
    column = at;
  }
  return Json{{"data", data}};
}

// ---- diagnostics

namespace {

const char* const kUnused = "G0439";

Json diagnostic_json(const grammar::Diagnostic& d, Places& places, Span primary) {
  std::string text = d.message;
  if (!d.labels.empty() && !d.labels[0].text.empty()) text += "\n" + d.labels[0].text;
  if (!d.help.empty()) text += "\nhelp: " + d.help;
  Json json{{"range", places.range(primary)},
            {"severity", d.severity == Severity::error     ? 1
                         : d.severity == Severity::warning ? 2
                                                           : 3},
            {"code", d.code},
            {"codeDescription", {{"href", "garment:explain/" + d.code}}},
            {"source", "garment"},
            {"message", text}};
  if (d.code == kUnused) json["tags"] = Json::array({1});  // an editor shows it faded
  Json related = Json::array();
  for (std::size_t k = 1; k < d.labels.size(); ++k)
    related.push_back({{"location", places.location(d.labels[k].span)},
                       {"message", d.labels[k].text.empty() ? "here" : d.labels[k].text}});
  if (!related.empty()) json["relatedInformation"] = related;
  return json;
}

}  // namespace

std::map<std::string, Json> diagnostics_of(const Document& document, Encoding encoding) {
  std::map<std::string, Json> by_file;
  by_file[document.uri] = Json::array();
  if (document.now == nullptr) return by_file;
  const Analysis& analysis = *document.now;
  Places places(analysis, encoding);
  const bool library = interpreter::may_be_library(*analysis.result.script);
  for (const grammar::Diagnostics* some : {&analysis.result.diagnostics, &analysis.model})
    for (const grammar::Diagnostic& d : *some) {
      if (library && d.code == kUnused) continue;
      const Span primary = d.labels.empty() ? Span{analysis.source, 0, 0} : d.labels[0].span;
      const bool own = primary.source == analysis.source;
      const std::string& name = analysis.sources[primary.source].name;
      // What has no file of its own (a parameter's text) is shown at the top of the script.
      const bool file = own || (!name.empty() && name[0] == '/');
      const std::string uri = own || !file ? document.uri : uri_of(name);
      Json& list = by_file.try_emplace(uri, Json::array()).first->second;
      list.push_back(diagnostic_json(d, places, file ? primary : Span{analysis.source, 0, 0}));
    }
  return by_file;
}

}  // namespace garment::lsp
