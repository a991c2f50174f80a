// Each example of the construct and function tables and each block of the documents runs: it is put into
// record_context.garment (which says how) and gives no error. (That docs/reference.md is that of the tables
// is looked at in tests/cli.)
#include <algorithm>
#include <set>
#include <utility>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

std::string file(const std::string& name) {
  const auto text = system_host().read_file(std::string(GARMENT_SOURCE_DIR) + '/' + name, 4 << 20);
  REQUIRE(text);
  return *text.value;
}

grammar::Script parsed(const std::string& text, grammar::Sources& sources) {
  return grammar::parse(sources, sources.add("text", text), vocabulary()).script;
}

/// What there is only one of in a block: a name, or a statement without one (`grain`), or a `close`.
std::string key_of(const grammar::Statement& statement) {
  const std::string& keyword = statement.keyword.text;
  if (statement.name && keyword != "close") return statement.name->text;
  if ((keyword != "fn" && keyword != "component") || statement.operands.empty()) return ' ' + keyword;
  const grammar::Expr& head = statement.operands[0];
  return head.kind == grammar::ExprKind::call && !head.children.empty() ? head.children[0].text : head.text;
}

/// The innermost block that holds `at`.
const grammar::Block& block_at(const grammar::Block& block, std::size_t at) {
  for (const grammar::Statement& statement : block)
    if (statement.body && statement.body_span.begin < at && at < statement.body_span.end)
      return block_at(*statement.body, at);
  return block;
}

/// Where an example of `keyword` stands in the context; the end of the text for the top level.
std::size_t place_of(const std::string& context, const ConstructRecord& record) {
  std::vector<std::string> words{std::string(record.keyword)};
  for (const ConstructRecord& other : construct_table())
    for (std::string_view inner : other.body_keywords)
      if (inner == record.keyword) words.emplace_back(other.keyword);
  for (const std::string& word : words)
    for (std::size_t at = context.find("# EXAMPLE"); at != std::string::npos;
         at = context.find("# EXAMPLE", at + 1)) {
      const std::size_t end = context.find('\n', at);
      if ((context.substr(at + 9, end - at - 9) + ' ').find(' ' + word + ' ') != std::string::npos)
        return end + 1;
    }
  FAIL("record_context.garment has no line `# EXAMPLE " << words.front() << "`");
  return 0;
}

/// The context with the example in its place and without what it declares itself.
std::string with_example(std::string text, const std::string& example, std::size_t place) {
  const std::string line = example + '\n';
  text.insert(place, line);
  grammar::Sources sources;
  const grammar::Script script = parsed(text, sources);
  const grammar::Block& block = block_at(script.statements, place);
  const auto is_example = [&](const grammar::Statement& statement) {
    return statement.span.begin >= place && statement.span.begin < place + line.size();
  };
  std::set<std::string> names;
  for (const grammar::Statement& statement : block)
    if (is_example(statement)) names.insert(key_of(statement));
  for (auto statement = block.rbegin(); statement != block.rend(); ++statement)
    if (!is_example(*statement) && names.contains(key_of(*statement)))
      text.erase(statement->span.begin, statement->span.end - statement->span.begin);
  return text;
}

void runs(const std::string& script) {
  InterpretOptions options;
  options.script_dir = GARMENT_SOURCE_DIR "/tests/unit/interpreter";
  const Trial trial(script, options);
  INFO(trial.text());
  CHECK(trial.result.ok());
}

}  // namespace

TEST_CASE("what the examples stand in is right by itself") {
  runs(file("tests/unit/interpreter/record_context.garment"));
}

TEST_CASE("every example of the construct table runs") {
  const std::string context = file("tests/unit/interpreter/record_context.garment");
  for (const ConstructRecord& record : construct_table()) {
    if (!record.supported) continue;
    const std::string example(record.example);
    INFO(example);
    const std::size_t place = record.top ? context.size() : place_of(context, record);
    runs(with_example(context, example, place));
  }
}

TEST_CASE("every example of the function table has a value") {
  const std::string context = file("tests/unit/interpreter/record_context.garment");
  for (const FunctionRecord& record : function_table()) {
    const std::string example(record.example);
    INFO(example);
    REQUIRE_FALSE(example.empty());
    if (example == "strain(all)" && record.name == "all") continue;  // a value only as an argument
    if (record.doc.ends_with("(not supported yet)")) continue;
    grammar::Sources sources;
    // An example may need a line of its own before it: `...; EXPRESSION`.
    const std::size_t cut = example.rfind("; ");
    const std::string before = cut == std::string::npos ? "" : example.substr(0, cut) + "\n";
    const std::string value = cut == std::string::npos ? example : example.substr(cut + 2);
    std::string script = context + before;
    if (record.asks_drape) script += "drape until rest\n";
    script += record.asks_drape ? "measure" : "let";
    script += " answer = " + value + '\n';
    runs(script);
  }
}

TEST_CASE("every garment block of the documents runs") {
  const std::string context = file("tests/unit/interpreter/record_context.garment");
  const std::string fence = "```garment\n";
  int blocks = 0;
  for (const char* name : {"README.md", "docs/language.md", "docs/meaning.md", "docs/prompt.md"}) {
    const std::string page = file(name);
    for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
      const std::size_t begin = at + fence.size();
      const std::string block = page.substr(begin, page.find("```\n", begin) - begin);
      INFO(name << "\n" << block);
      ++blocks;
      // A block without a `garment` line is a part of a script: it stands in the context of the examples.
      runs(block.rfind("garment 1", 0) == 0 ? block : with_example(context, block, context.size()));
    }
  }
  CHECK(blocks >= 27);
}

TEST_CASE("a script that the guide shares with the examples is the same in both") {
  const std::string page = file("docs/language.md");
  int shared = 0;
  for (const char* name : {"tshirt", "lined_skirt", "jacket_front", "cusick", "cantilever"}) {
    INFO(name);
    const std::string text = file(std::string("examples/") + name + ".garment");
    CHECK(page.find("```garment\n" + text + "```\n") != std::string::npos);
    ++shared;
  }
  CHECK(shared == 5);
}
