#include <catch2/catch.hpp>

#include "grammar/source.hpp"
#include "grammar/text.hpp"

using namespace garment::grammar;

TEST_CASE("lines and columns count from one, columns in characters") {
  Sources sources;
  SourceId id = sources.add("a", "ab\né漢x\n");
  auto at = [&](std::uint32_t offset) {
    Place place = sources.place(id, offset);
    return std::make_pair(place.line, place.column);
  };
  CHECK(at(0) == std::make_pair(1u, 1u));
  CHECK(at(2) == std::make_pair(1u, 3u));
  CHECK(at(3) == std::make_pair(2u, 1u));
  CHECK(at(5) == std::make_pair(2u, 2u));
  CHECK(at(8) == std::make_pair(2u, 3u));
  CHECK(at(10) == std::make_pair(3u, 1u));
  CHECK(at(1000) == std::make_pair(3u, 1u));
  CHECK(sources.text({id, 3, 5}) == "é");
  CHECK(sources.text({id, 9, 500}) == "\n");
  CHECK(sources.text({id, 500, 3}) == "");
}

TEST_CASE("UTF-8 is decoded strictly") {
  CHECK(decode_utf8("\xF0\x9F\x98\x80", 0).code == 0x1F600);
  CHECK(find_invalid_utf8("aé漢\xF0\x9F\x98\x80") == std::string::npos);
  for (const char* bad :
       {"\x80", "\xC1\x81", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8\x80\x80\x80", "\xC3"})
    CHECK(find_invalid_utf8(std::string("ab") + bad) == 2);
}

TEST_CASE("widths and escapes of characters") {
  CHECK(display_width('a') == 1);
  CHECK(display_width(0x301) == 0);
  CHECK(display_width(0x6F22) == 2);
  CHECK(is_control(0x1B));
  CHECK(is_control(0x202E));
  CHECK_FALSE(is_control(0xE9));
  CHECK(escape_controls("a\tb\x7f\xC2\x85\xFF") == "a\\tb\\x7f\\x85\\xff");
}

TEST_CASE("distance of words counts single slips") {
  CHECK(edit_distance("panel", "panel") == 0);
  CHECK(edit_distance("pannel", "panel") == 1);
  CHECK(edit_distance("grian", "grain") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(closest_word("semi", {"panel", "seam", "hem"}) == "");
  CHECK(closest_word("saem", {"panel", "seam", "hem"}) == "seam");
  CHECK(closest_word("x", {"y", "z"}) == "");
  CHECK(closest_word(std::string(10000, 'a'), {"a"}) == "");
}

TEST_CASE("strings end at their quote, also with strings in their holes") {
  CHECK(end_of_string("\"abc\" d", 0) == 5);
  CHECK(end_of_string("\"a\\\"c\" d", 0) == 6);
  CHECK(end_of_string("\"a {f(\"x\")} b\" d", 0) == 14);
  CHECK(end_of_string("\"abc\nd\"", 0) == 4);
  CHECK(end_of_string("\"abc", 0) == 4);
  CHECK(end_of_string("\"abc\\", 0) == 5);
}
