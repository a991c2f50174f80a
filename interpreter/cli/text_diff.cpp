#include "interpreter/cli/text_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace garment::cli {
namespace {

constexpr std::size_t kContext = 3, kWindow = 40;

/// Lines with their ends.
std::vector<std::string_view> lines_with_ends(const std::string& text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    lines.push_back(std::string_view(text).substr(begin, end - begin));
    begin = end;
  }
  return lines;
}

/// A stretch of lines of both texts: equal, or one to be replaced by the other.
struct Stretch {
  bool equal;
  std::size_t a, a_end, b, b_end;
};

/// From the mismatch at (i, j) the nearest lines that are the same again; the ends where none is near.
std::pair<std::size_t, std::size_t> next_match(const std::vector<std::string_view>& a, const std::vector<std::string_view>& b,
                                               std::size_t i, std::size_t j) {
  for (std::size_t sum = 1; sum < 2 * kWindow; ++sum)
    for (std::size_t di = sum < kWindow ? 0 : sum - kWindow; di <= std::min(sum, kWindow); ++di)
      if (i + di < a.size() && j + sum - di < b.size() && a[i + di] == b[j + sum - di]) return {i + di, j + sum - di};
  return {std::min(i + kWindow, a.size()), std::min(j + kWindow, b.size())};
}

std::vector<Stretch> stretches_of(const std::vector<std::string_view>& a, const std::vector<std::string_view>& b) {
  std::vector<Stretch> out;
  const auto add = [&](bool equal, std::size_t a0, std::size_t a1, std::size_t b0, std::size_t b1) {
    if (!out.empty() && out.back().equal == equal)
      out.back().a_end = a1, out.back().b_end = b1;
    else
      out.push_back({equal, a0, a1, b0, b1});
  };
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      add(true, i, i + 1, j, j + 1);
      ++i, ++j;
      continue;
    }
    const auto [p, q] = next_match(a, b, i, j);
    add(false, i, p, j, q);
    i = p, j = q;
  }
  return out;
}

void put(std::string& out, char sign, std::string_view line) {
  out += sign;
  out += line;
  if (line.empty() || line.back() != '\n') out += "\n\\ No newline at end of file\n";
}

/// "12,5": the first line, from 1, and how many.
std::string range(std::size_t begin, std::size_t end) {
  return fmt::format("{},{}", end > begin ? begin + 1 : begin, end - begin);
}

}  // namespace

std::string unified_diff(const std::string& before, const std::string& after, const std::string& name) {
  if (before == after) return "";
  const std::vector<std::string_view> a = lines_with_ends(before), b = lines_with_ends(after);
  const std::vector<Stretch> all = stretches_of(a, b);
  std::string out = fmt::format("--- {}\n+++ {}\n", name, name);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].equal) continue;
    std::size_t last = k;  // changes with few equal lines between them share a hunk
    while (last + 2 < all.size() && all[last + 1].a_end - all[last + 1].a <= 2 * kContext) last += 2;
    const std::size_t lead = std::min(kContext, k > 0 ? all[k - 1].a_end - all[k - 1].a : 0);
    const std::size_t tail = std::min(kContext, last + 1 < all.size() ? all[last + 1].a_end - all[last + 1].a : 0);
    const std::size_t a0 = all[k].a - lead, b0 = all[k].b - lead, a1 = all[last].a_end + tail, b1 = all[last].b_end + tail;
    out += fmt::format("@@ -{} +{} @@\n", range(a0, a1), range(b0, b1));
    for (std::size_t i = a0; i < all[k].a; ++i) put(out, ' ', a[i]);
    for (std::size_t s = k; s <= last; ++s) {
      for (std::size_t i = all[s].a; i < all[s].a_end; ++i) put(out, all[s].equal ? ' ' : '-', a[i]);
      for (std::size_t j = all[s].b; !all[s].equal && j < all[s].b_end; ++j) put(out, '+', b[j]);
    }
    for (std::size_t i = all[last].a_end; i < a1; ++i) put(out, ' ', a[i]);
    k = last;
  }
  return out;
}

}  // namespace garment::cli
