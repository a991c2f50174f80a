// Scripts in random layouts: whatever blanks, line ends and comments stand where they may, the script says the same,
// and the formatter brings it to a layout that stays as it is.
#include <catch2/catch.hpp>
#include <filesystem>

#include "grammar/text.hpp"
#include "interpreter/language/construct_table.hpp"
#include "runtime/base/host.hpp"
#include "tests/property/mutations/mutate.hpp"

using namespace garment;
using mutations::Dice;

namespace {

namespace fs = std::filesystem;

/// A script laid out anew: other blanks between the words of a line, line ends and comments inside ( and [, comments and
/// empty lines between statements, another indentation. Two words that touch go on touching: that has a meaning.
class Layout {
 public:
  Layout(std::string_view text, Dice& dice) : text_(text), dice_(dice), deeper_(1 + dice.roll(3)), tabs_(dice.roll(3) == 0) {}

  std::string run() {
    while (at_ < text_.size()) line();
    return std::move(out_);
  }

 private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\n'; }

  void line() {
    std::size_t indent = 0;
    while (here() == ' ') ++indent, ++at_;
    if (here() != '\n') out_ += indentation(indent * deeper_);
    const bool comment = here() == '#';
    while (here() != '\n') token();
    end_line(indent, comment);
  }

  void token() {
    if (here() == '#') {
      while (here() != '\n') out_ += text_[at_++];
      has_comment_ = true;
    } else if (here() == '"') {
      const std::size_t end = grammar::end_of_string(text_, at_);
      out_ += text_.substr(at_, end - at_);
      at_ = end;
    } else if (here() == ' ') {
      while (here() == ' ') ++at_;
      gap();
    } else {
      if (here() == '(' || here() == '[') ++open_;
      if (here() == ')' || here() == ']') --open_;
      out_ += text_[at_++];
    }
  }

  void gap() {
    if (here() == '\n' || here() == '#') {
      out_ += "  ";
    } else if (open_ > 0 && !before_unit() && dice_.roll(4) == 0) {
      comment_at_end();
      out_ += '\n';
      if (dice_.roll(4) == 0) out_ += "   # between\n";
      out_ += std::string(dice_.roll(9), ' ');
    } else {
      out_ += dice_.roll(6) == 0 ? "\t" : std::string(1 + dice_.roll(4), ' ');
    }
  }

  /// A unit stands in the line of its number.
  bool before_unit() const {
    return !out_.empty() && grammar::is_digit(out_.back()) && (here() == '%' || grammar::is_word_start(here()));
  }

  void end_line(std::size_t indent, bool comment) {
    if (at_ < text_.size()) ++at_;
    if (!has_comment_) comment_at_end();
    has_comment_ = false;
    if (dice_.roll(5) == 0) out_ += "  ";
    out_ += '\n';
    // A comment or an empty line between a `##` line and its statement would part them.
    const bool goes_on = next_indent() > indent && text_[at_ - 2] != '{';
    if (comment || goes_on || open_ > 0) return;
    if (dice_.roll(8) == 0) out_ += std::string(1 + dice_.roll(3), '\n');
    if (dice_.roll(8) == 0) out_ += std::string(dice_.roll(6), ' ') + "# on its own\n";
  }

  void comment_at_end() {
    if (dice_.roll(8) == 0) out_ += "  # why: \"not ( this\"";
  }

  std::size_t next_indent() const {
    std::size_t at = at_;
    while (at < text_.size() && text_[at] == ' ') ++at;
    return at - at_;
  }

  std::string indentation(std::size_t n) const {
    return tabs_ ? std::string(n / 4, '\t') + std::string(n % 4, ' ') : std::string(n, ' ');
  }

  std::string_view text_;
  Dice& dice_;
  std::size_t deeper_;
  bool tabs_;
  std::size_t at_ = 0;
  int open_ = 0;
  bool has_comment_ = false;
  std::string out_;
};

struct Read {
  grammar::Sources sources;
  grammar::ParseResult parsed;
  std::string laid_out;
};

Read read(const std::string& text) {
  Read r;
  const grammar::SourceId id = r.sources.add("script.garment", text);
  r.parsed = grammar::parse(r.sources, id, interpreter::vocabulary());
  r.laid_out = grammar::format(r.sources, id, interpreter::vocabulary()).text;
  return r;
}

std::vector<fs::path> scripts() {
  std::vector<fs::path> found;
  for (const char* folder : {"examples", "stdlib", "tests/golden/check"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GARMENT_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".garment") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_CASE("a script says the same in any layout, and its canonical layout stays") {
  std::size_t n = 0, seed = 1;
  for (const fs::path& path : scripts()) {
    const auto text = system_host().read_file(path.string(), 4 << 20);
    REQUIRE(text);
    const Read plain = read(*text.value);
    if (!plain.parsed.diagnostics.empty()) continue;
    ++n;
    for (int k = 0; k < 4; ++k) {
      Dice dice(seed++);
      const std::string other = Layout(*text.value, dice).run();
      const Read loose = read(other), canonical = read(loose.laid_out);
      INFO(path << ", layout " << k << "\n" << other);
      for (const grammar::Diagnostic& d : loose.parsed.diagnostics) FAIL_CHECK(grammar::render(d, loose.sources, false));
      CHECK(same_tree(plain.parsed.script.statements, loose.parsed.script.statements));
      INFO(loose.laid_out);
      CHECK(same_tree(plain.parsed.script.statements, canonical.parsed.script.statements));
      CHECK(canonical.laid_out == loose.laid_out);
    }
  }
  CHECK(n > 200);
}
