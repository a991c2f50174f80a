#pragma once
// A script with the place of the cursor in it, for tests of the editor service.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "grammar/source.hpp"
#include "interpreter/language/interpret.hpp"
#include "interpreter/service/completion.hpp"

namespace garment::service_test {

/// A skirt front and back, a body, a loop and a function; most tests complete or ask in a text that begins
/// with it.
inline const std::string kScript = R"(garment 1 "test"
use fabrics, bodies
## waist to hem
param long = 58 cm in 30 cm .. 110 cm "waist to hem"
let w = 20 cm
fn half(x: length, n: number = 2) = x / n
body form = bodies.woman(size: 40)
fabric shell = fabrics.denim
## the front piece
panel front of shell on fold cf {
  outline from (0, 0) {
    edge hem to (30 cm, 0) free
    edge side to (22 cm, long)
    edge waist to (0, long)
    close cf
  }
  dart waist_dart on waist at 50% width 2 cm depth 9 cm
  notch hip on side at 20 cm before end
}
panel back of shell like front {
  rename cf as cb
}
both seam side: front.side to back.side
place front on form.front with waist at form.waist
place back on form.back with waist at form.waist
)";

/// kScript, interpreted once.
struct Good {
  grammar::Sources sources;
  grammar::SourceId source = 0;
  interpreter::Interpretation result;
  Good() : source(sources.add("good.garment", kScript)) {
    interpreter::InterpretOptions options;
    options.stdlib_dir = GARMENT_STDLIB_DIR;
    result = interpreter::interpret(sources, source, system_host(), options);
  }
};
inline const Good& good() {
  static const Good once;
  return once;
}

struct Asked {
  grammar::Sources sources;
  grammar::SourceId source = 0;
  std::uint32_t offset = 0;
};

/// The text without its `|`, where the cursor stands.
inline std::unique_ptr<Asked> ask(const std::string& marked) {
  auto asked = std::make_unique<Asked>();
  std::string text = marked;
  const std::size_t at = text.find('|');
  asked->offset = static_cast<std::uint32_t>(at);
  text.erase(at, 1);
  asked->source = asked->sources.add("asked.garment", text);
  return asked;
}

inline std::vector<service::Completion> completions(const std::string& marked) {
  const auto asked = ask(marked);
  return service::complete(asked->sources, asked->source, asked->offset, &good().result);
}

/// "hem side waist": the texts, in their order.
inline std::string texts(const std::vector<service::Completion>& all, const std::string& kind = "") {
  std::string out;
  for (const service::Completion& c : all)
    if (kind.empty() || c.kind == kind) out += (out.empty() ? "" : " ") + c.text;
  return out;
}

inline bool has(const std::vector<service::Completion>& all, const std::string& text) {
  return std::any_of(all.begin(), all.end(), [&](const service::Completion& c) { return c.text == text; });
}

}  // namespace garment::service_test
