// Values come back as they went; bytes that are none are refused and do no harm.
#include "runtime/base/archive.hpp"

#include <catch2/catch.hpp>
#include <limits>

using garment::Archive;

namespace {

enum class Colour { red, green, blue };

struct Thing {
  int n = 0;
  double x = 0, any = 0;
  bool yes = false;
  Colour colour = Colour::red;
  std::string text;
  std::vector<double> list;
  std::vector<std::string> lines;

  void keep(Archive& a) {
    a.keep(n);
    a.keep(x);
    a.keep_any(any);
    a.keep(yes);
    a.keep(colour, Colour::blue);
    a.keep(text);
    a.keep(list);
    if (a.length(lines, 8))
      for (std::string& line : lines) a.keep(line);
  }
  friend bool operator==(const Thing&, const Thing&) = default;
};

const Thing kThing{-3, 0.1, std::numeric_limits<double>::infinity(), true, Colour::green, "a\0b", {1, -0.0, 1e-300}, {"", "x"}};

std::string bytes_of(Thing thing) {
  Archive a;
  thing.keep(a);
  return a.take();
}

}  // namespace

TEST_CASE("archive: what is written is read") {
  const std::string bytes = bytes_of(kThing);
  Thing back;
  Archive a(bytes);
  back.keep(a);
  CHECK(a.whole());
  CHECK(back == kThing);
  CHECK(bytes_of(back) == bytes);
}

TEST_CASE("archive: bytes that end too early, or go on, are refused") {
  const std::string bytes = bytes_of(kThing);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    Thing back;
    Archive a(std::string_view(bytes).substr(0, n));
    back.keep(a);
    CHECK_FALSE(a.ok());
  }
  Thing back;
  const std::string longer = bytes + 'x';
  Archive a(longer);
  back.keep(a);
  CHECK(a.ok());
  CHECK_FALSE(a.whole());
  CHECK(a.rest() == "x");
}

TEST_CASE("archive: lengths that cannot be take no memory, and numbers are finite") {
  Archive huge;
  std::uint64_t n = std::numeric_limits<std::uint64_t>::max() / 16;
  huge.keep(n);
  const std::string bytes = huge.take();
  std::vector<double> list{1};
  Archive a(bytes);
  a.keep(list);
  CHECK_FALSE(a.ok());
  CHECK(list == std::vector<double>{1});

  Archive nan;
  double value = std::numeric_limits<double>::quiet_NaN();
  nan.keep_any(value);
  const std::string one = nan.take();
  double read = 7;
  Archive b(one);
  b.keep(read);
  CHECK_FALSE(b.ok());
  CHECK(read == 7);
}
