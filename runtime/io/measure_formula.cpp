#include "runtime/io/measure_formula.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::io {
namespace {

constexpr int kMaxDepth = 40;
constexpr double kDegree = portable::kPi / 180;

struct Function {
  const char* name;
  std::size_t least, most;  ///< arguments
  double (*run)(const std::vector<double>&);
};
constexpr std::size_t kAny = 1000;
const Function kFunctions[] = {
    {"min", 1, kAny, [](const std::vector<double>& a) { return *std::min_element(a.begin(), a.end()); }},
    {"max", 1, kAny, [](const std::vector<double>& a) { return *std::max_element(a.begin(), a.end()); }},
    {"sum", 1, kAny,
     [](const std::vector<double>& a) {
       double s = 0;
       for (double x : a) s += x;
       return s;
     }},
    {"avg", 1, kAny,
     [](const std::vector<double>& a) {
       double s = 0;
       for (double x : a) s += x;
       return s / static_cast<double>(a.size());
     }},
    {"abs", 1, 1, [](const std::vector<double>& a) { return std::fabs(a[0]); }},
    {"sqrt", 1, 1, [](const std::vector<double>& a) { return std::sqrt(a[0]); }},
    {"sin", 1, 1, [](const std::vector<double>& a) { return portable::sin(a[0]); }},
    {"cos", 1, 1, [](const std::vector<double>& a) { return portable::cos(a[0]); }},
    {"tan", 1, 1, [](const std::vector<double>& a) { return portable::sin(a[0]) / portable::cos(a[0]); }},
    {"sinD", 1, 1, [](const std::vector<double>& a) { return portable::sin(kDegree * a[0]); }},
    {"cosD", 1, 1, [](const std::vector<double>& a) { return portable::cos(kDegree * a[0]); }},
    {"tanD", 1, 1,
     [](const std::vector<double>& a) {
       return portable::sin(kDegree * a[0]) / portable::cos(kDegree * a[0]);
     }},
    {"degTorad", 1, 1, [](const std::vector<double>& a) { return kDegree * a[0]; }},
    {"radTodeg", 1, 1, [](const std::vector<double>& a) { return a[0] / kDegree; }},
};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Recursive descent; the first mistake stays in `error_` and everything ends.
class FormulaParser {
 public:
  FormulaParser(std::string_view text, const FormulaNames& names) : text_(text), names_(names) {}

  FormulaResult run() {
    const double value = sum();
    if (error_.empty() && !at_end())
      fail("`" + std::string(text_.substr(at_, 20)) + "` where the formula should end");
    if (error_.empty() && !std::isfinite(value)) fail("the formula has no finite value");
    if (!error_.empty()) return {std::nullopt, error_};
    return {value, ""};
  }

 private:
  void fail(std::string what) {
    if (error_.empty()) error_ = std::move(what);
    at_ = text_.size();
  }
  bool at_end() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
    return at_ == text_.size();
  }
  bool take(char c) {
    if (at_end() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  double sum() {
    double value = product();
    for (;;) {
      if (take('+'))
        value += product();
      else if (take('-'))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = sign();
    for (;;) {
      if (take('*')) {
        value *= sign();
      } else if (take('/')) {
        const double by = sign();
        if (by == 0) fail("a division by zero");
        value /= by;
      } else {
        return value;
      }
    }
  }
  /// A sign binds less than a power: -2 ^ 2 is -4.
  double sign() {
    bool minus = false;
    for (;;) {
      if (take('-'))
        minus = !minus;
      else if (!take('+'))
        break;
    }
    const double value = power();
    return minus ? -value : value;
  }
  double power() {
    if (++depth_ > kMaxDepth) fail("brackets nested more than 40 deep");
    double value = error_.empty() ? atom() : 0;
    if (take('^')) value = portable::pow(value, sign());
    --depth_;
    return value;
  }
  double atom() {
    if (at_end()) return fail("the formula ends too early"), 0;
    if (take('(')) {
      const double value = sum();
      if (!take(')')) fail("a `)` is missing");
      return value;
    }
    if (is_digit(text_[at_]) || text_[at_] == '.') return number();
    const bool custom = text_[at_] == '@' || text_[at_] == '#';
    if (custom) ++at_;
    if (at_ < text_.size() && is_letter(text_[at_])) return named(custom);
    fail("`" + std::string(text_.substr(at_, 20)) + "` where a number or a name should stand");
    return 0;
  }
  double number() {
    const std::size_t from = at_;
    while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) ++at_;
    const std::string_view digits = text_.substr(from, at_ - from);
    const auto value = parse_number(digits);
    if (!value) fail("`" + std::string(digits.substr(0, 20)) + "` is no number");
    return value.value_or(0);
  }
  double named(bool custom) {
    const std::size_t from = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string name(text_.substr(from, at_ - from));
    if (!custom && take('(')) return call(name);
    FormulaResult found = names_(name);
    if (!found.value) fail(found.error);
    return found.value.value_or(0);
  }
  double call(const std::string& name) {
    std::vector<double> arguments;
    do {
      arguments.push_back(sum());
    } while (error_.empty() && (take(',') || take(';')));
    if (!take(')')) fail("a `)` is missing after the arguments of `" + name + "`");
    if (!error_.empty()) return 0;
    for (const Function& f : kFunctions) {
      if (name != f.name) continue;
      if (arguments.size() >= f.least && arguments.size() <= f.most) return f.run(arguments);
      fail("`" + name + "` takes one value");
      return 0;
    }
    fail("`" + name + "` is no function; there are min max sum avg abs sqrt sin cos tan sinD cosD tanD");
    return 0;
  }

  std::string_view text_;
  const FormulaNames& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string error_;
};

}  // namespace

FormulaResult compute_formula(std::string_view text, const FormulaNames& names) {
  return FormulaParser(text, names).run();
}

}  // namespace garment::io
