#include "runtime/modeller/unmodelled.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/modeller/unmodelled_cloth.hpp"

namespace garment::modeller {
namespace {

class Unmodelled {
 public:
  explicit Unmodelled(Severity severity) : severity_(severity) {}

  void say(const std::string& what, OriginId origin) {
    for (const Finding& told : findings_)  // both halves of a panel on the fold come of one statement
      if (told.labels[0].origin.value == origin.value && origin.value != 0) return;
    findings_.push_back({"G0460",
                         severity_,
                         what + " is declared, but cannot be modelled yet",
                         {{origin, ""}},
                         "the script is checked as a whole; to drape it, leave this out for now"});
  }

  Findings take() { return std::move(findings_); }

 private:
  Severity severity_;
  Findings findings_;
};

}  // namespace

Findings find_unmodelled(const design::Garment& garment, Severity severity) {
  Unmodelled out(severity);
  find_unmodelled_cloth(garment, [&out](const std::string& what, OriginId origin) { out.say(what, origin); });
  return out.take();
}

Findings in_one(const Findings& findings) {
  constexpr std::size_t kFew = 2, kNamed = 6;
  std::vector<std::string> names;
  Finding one;
  Findings others;
  for (const Finding& finding : findings) {
    if (finding.code != "G0460") {
      others.push_back(finding);
      continue;
    }
    const std::string what = finding.message.substr(0, finding.message.find(" is declared,"));
    if (std::find(names.begin(), names.end(), what) == names.end()) names.push_back(what);
    if (one.code.empty()) one = finding;
    else one.labels.insert(one.labels.end(), finding.labels.begin(), finding.labels.end());
  }
  if (names.size() <= kFew) return findings;
  one.message = fmt::format("{} declared things cannot be modelled yet: ", names.size());
  for (std::size_t k = 0; k < std::min(kNamed, names.size()); ++k) one.message += (k > 0 ? ", " : "") + names[k];
  if (names.size() > kNamed) one.message += " ...";
  one.help = "the script is checked as a whole; to drape it, leave these out for now";
  others.insert(others.begin(), std::move(one));
  return others;
}

}  // namespace garment::modeller
