// The pattern on paper, measured on the written pages by poppler.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>

#include "runtime/io/pattern_sheet.hpp"
#include "runtime/io/pdf_writer.hpp"
#include "tests/support/skirt_pattern.hpp"

using namespace garment;
namespace fs = std::filesystem;

namespace {

/// Standard output of a command.
std::string output_of(const std::string& command) {
  std::string out;
  if (FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r")) {
    char part[4096];
    while (const std::size_t n = std::fread(part, 1, sizeof part, pipe)) out.append(part, n);
    pclose(pipe);
  }
  return out;
}

bool poppler_present() {
  if (!output_of("command -v pdftoppm").empty() && !output_of("command -v pdfinfo").empty()) return true;
  WARN("skipped: no poppler-utils");
  return false;
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("garment_pdf_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

std::string write(const Folder& folder, const std::string& bytes) {
  const std::string file = (folder.path / "pattern.pdf").string();
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

/// Grey levels of a page at 254 dpi: ten dots a millimetre.
struct Grey {
  int width = 0, height = 0;
  std::string dots;
  int at(int x, int y) const {
    return static_cast<unsigned char>(dots[static_cast<std::size_t>(y) * width + x]);
  }
};
Grey page_of(const Folder& folder, const std::string& file, int page) {
  const std::string stem = (folder.path / "page").string();
  output_of("pdftoppm -gray -r 254 -f " + std::to_string(page) + " -l " + std::to_string(page) +
            " -singlefile " + file + " " + stem);
  std::ifstream in(stem + ".pgm", std::ios::binary);
  Grey g;
  std::string magic;
  int depth = 0;
  in >> magic >> g.width >> g.height >> depth;
  in.get();
  g.dots.resize(static_cast<std::size_t>(g.width) * g.height);
  in.read(g.dots.data(), static_cast<std::streamsize>(g.dots.size()));
  return g;
}

}  // namespace

TEST_CASE("the same pattern gives the same bytes, without a date") {
  const design::Garment skirt = test::make_skirt_pattern();
  const std::string a = io::write_pattern_pdf(skirt, nullptr, {}),
                    b = io::write_pattern_pdf(skirt, nullptr, {});
  CHECK(a.size() > 3000);
  CHECK(a.substr(0, 5) == "%PDF-");
  CHECK(a == b);
  CHECK(a.find("CreationDate") == std::string::npos);
}

TEST_CASE("papers are found by their names") {
  CHECK(io::find_paper("a3")->width == 297);
  CHECK(io::find_paper("Letter")->height == Approx(279.4));
  CHECK_FALSE(io::find_paper("A"));
  CHECK_FALSE(io::find_paper("A44"));
}

TEST_CASE("pages have the size of the paper, and the test square measures 50 mm") {
  if (!poppler_present()) return;
  Folder folder;
  for (const char* name : {"A4", "A3", "letter"}) {
    INFO(name);
    const io::PaperSize paper = *io::find_paper(name);
    const std::string file = write(folder, io::write_pattern_pdf(test::make_skirt_pattern(), nullptr, paper));
    std::smatch found;
    const std::string info = output_of("pdfinfo " + file);
    REQUIRE(std::regex_search(info, found, std::regex("Page size: +([0-9.]+) x ([0-9.]+) pts")));
    CHECK(std::stod(found[1]) == Approx(paper.width / 25.4 * 72).margin(0.1));
    CHECK(std::stod(found[2]) == Approx(paper.height / 25.4 * 72).margin(0.1));
    REQUIRE(std::regex_search(info, found, std::regex("Pages: +([0-9]+)")));
    CHECK(std::stoi(found[1]) > 1);
    const Grey cover = page_of(folder, file, 1);
    CHECK(cover.width == Approx(10 * paper.width).margin(1));
    // The row of dots through the square's upper part, where it has no letters: its two sides.
    const int y = 450;
    std::vector<double> sides;
    for (int x = 0; x < 700; ++x)
      if (cover.at(x, y) < 140 && (x == 0 || cover.at(x - 1, y) >= 140)) {
        int end = x;
        while (cover.at(end, y) < 140) ++end;
        sides.push_back(0.5 * (x + end));
      }
    REQUIRE(sides.size() == 2);
    CHECK((sides[1] - sides[0]) / 10 == Approx(50).margin(0.15));
  }
}

TEST_CASE("a large sheet holds a whole piece, and the cover its cut list") {
  if (!poppler_present()) return;
  Folder folder;
  design::Garment skirt = test::make_skirt_pattern();
  skirt.panels.resize(1);
  REQUIRE(io::PatternSheet(skirt, nullptr, true).size()[0] < 800);
  const std::string file = write(folder, io::write_pattern_pdf(skirt, nullptr, *io::find_paper("A0")));
  const std::string info = output_of("pdfinfo " + file);
  CHECK_THAT(info, Catch::Contains("Pages:           2"));
  CHECK_THAT(output_of("pdftotext -f 1 -l 1 -layout " + file + " -"),
             Catch::Contains("Cut list") && Catch::Contains("front"));
}

TEST_CASE("a pair is cut twice and drawn once") {
  design::Garment g = test::make_skirt_pattern();
  REQUIRE(g.panels.size() == 2);
  g.panels[0].name = "leg.left";
  g.panels[1] = g.panels[0];
  g.panels[1].name = "leg.right";
  const std::vector<io::CutRow> rows = io::cut_list(g);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].piece == "leg");
  CHECK(rows[0].count == 2);
  CHECK(rows[0].pair);
  CHECK(io::PatternSheet(g, nullptr, true).size().prod() <
        0.7 * io::PatternSheet(g, nullptr, false).size().prod());
}
