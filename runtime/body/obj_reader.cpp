#include "runtime/body/obj_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/base/number.hpp"
#include "runtime/body/mesh_repair.hpp"
#include "runtime/body/shapes.hpp"

namespace garment::body {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

/// Cuts the next word off `line`; empty at its end.
std::string_view next_word(std::string_view& line) {
  std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return line = {};
  line.remove_prefix(begin);
  std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

/// A piece of the file that is safe to show: short and printable.
std::string shown(std::string_view text) {
  std::string out;
  for (char c : text.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > 40 ? out + "..." : out;
}

class ObjReader {
 public:
  ObjReader(std::string_view text, double scale, const std::string& name, OriginId origin, bool as_is = false)
      : text_(text), scale_(scale), name_(name), origin_(origin), as_is_(as_is) {}

  MeshResult run() {
    if (text_.size() > kMaxObjBytes)
      return fail("G0704",
                  fmt::format("`{}` has {} bytes; at most {} are read", name_, text_.size(), kMaxObjBytes),
                  "reduce the mesh: 20,000 triangles are plenty for a body");
    if (text_.find('\0') != std::string_view::npos)
      return fail("G0702", fmt::format("`{}` is a binary file, not an OBJ mesh", name_),
                  "export the body as Wavefront OBJ (text)");
    std::string_view rest = text_;
    while (!rest.empty() && result_.findings.empty()) {
      std::size_t end = rest.find('\n');
      ++line_number_;
      read_line(rest.substr(0, end));
      rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    if (result_.findings.empty()) check_whole();
    return std::move(result_);
  }

 private:
  void read_line(std::string_view line) {
    line_ = line;
    std::string_view keyword = next_word(line);
    if (keyword == "v") {
      read_vertex(line);
    } else if (keyword == "f") {
      read_face(line);
    }
  }

  void read_vertex(std::string_view line) {
    Vector3d p;
    for (int k = 0; k < 3; ++k) {
      std::string_view word = next_word(line);
      std::optional<double> number = parse_number(word);
      if (!number) {
        bad_line(word.empty() ? "a vertex needs three coordinates"
                              : fmt::format("`{}` is not a finite number", shown(word)));
        return;
      }
      p[k] = *number * scale_;
    }
    if (!(p.cwiseAbs().maxCoeff() <= kMaxCoordinate)) {
      fail("G0704",
           fmt::format("`{}` line {}: a vertex lies {} m from the origin; at most {} m", name_, line_number_,
                       format_number(p.cwiseAbs().maxCoeff(), 3), format_number(kMaxCoordinate)),
           "check the file, or give `scale` (0.01 for centimetres, 0.001 for millimetres)");
      return;
    }
    mesh_.vertices.push_back(p);
  }

  void read_face(std::string_view line) {
    corners_.clear();
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      if (word.front() == '#') break;
      std::string_view index_text = word.substr(0, word.find('/'));
      std::optional<double> number = parse_number(index_text);
      double count = static_cast<double>(mesh_.vertices.size());
      double index = number ? (*number < 0 ? count + *number : *number - 1) : -1;
      if (!number || *number == 0 || std::floor(index) != index || !(index >= 0 && index < count)) {
        bad_line(fmt::format("`{}` names no vertex; {} are known here", shown(word), mesh_.vertices.size()));
        return;
      }
      corners_.push_back(static_cast<int>(index));
    }
    if (corners_.size() < 3) {
      bad_line(fmt::format("a face needs three corners, this one has {}", corners_.size()));
      return;
    }
    if (mesh_.triangles.size() + corners_.size() - 2 > kMaxObjTriangles) {
      fail("G0704", fmt::format("`{}` has more than {} triangles", name_, kMaxObjTriangles),
           "reduce the mesh: 20,000 triangles are plenty for a body");
      return;
    }
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i)
      mesh_.triangles.push_back({corners_[0], corners_[i], corners_[i + 1]});
  }

  void check_whole() {
    if (mesh_.vertices.empty() || mesh_.triangles.empty()) {
      fail("G0702",
           text_.empty() ? fmt::format("`{}` is empty", name_)
                         : fmt::format("`{}` holds {} vertices and {} faces; a body needs both", name_,
                                       mesh_.vertices.size(), mesh_.triangles.size()),
           "export the body as Wavefront OBJ with its faces; a cut-off or misnamed file is the usual cause");
      return;
    }
    int dropped = clean_mesh(mesh_);
    SurfaceCheck check = check_surface(mesh_);
    if (mesh_.triangles.empty()) {
      fail("G0702", fmt::format("all {} triangles of `{}` are without area", dropped, name_),
           "export the body as Wavefront OBJ with its faces");
    } else if (as_is_) {
      result_.mesh = std::move(mesh_);
    } else if (check.open_edges > 0) {
      fail("G0705",
           fmt::format(
               "the surface of `{}` is open: {} edges belong to one triangle only, one at ({}, {}, {}) m",
               name_, check.open_edges, format_number(check.place.x(), 3), format_number(check.place.y(), 3),
               format_number(check.place.z(), 3)),
           "close the holes of the mesh (in Blender: select all, Mesh > Clean Up > Fill Holes); a cut-off "
           "file looks "
           "like this too");
    } else if (check.twisted_edges > 0) {
      fail("G0706",
           fmt::format("the faces of `{}` disagree about the outside at {} edges, one at ({}, {}, {}) m",
                       name_, check.twisted_edges, format_number(check.place.x(), 3),
                       format_number(check.place.y(), 3), format_number(check.place.z(), 3)),
           "let the modelling program recalculate the normals outside (in Blender: Mesh > Normals > "
           "Recalculate)");
    } else {
      remark(dropped);
    }
  }

  /// What does not stop the body from being used.
  void remark(int dropped) {
    double volume = signed_volume(mesh_);
    if (volume < 0) {
      for (auto& t : mesh_.triangles) std::swap(t[1], t[2]);
      note("G0708", fmt::format("the faces of `{}` looked inward and were turned", name_), "nothing to do");
    }
    if (dropped > 0)
      note("G0709", fmt::format("{} triangles without area were left out of `{}`", dropped, name_),
           "nothing to do");
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vector3d& p : mesh_.vertices) low = std::min(low, p.y()), high = std::max(high, p.y());
    double height = high - low;
    if (height > 10) {
      bool mm = height > 500;
      remarks_.push_back({"G0707",
                          Severity::warning,
                          fmt::format("`{}` is {} m high: its numbers look like {}", name_,
                                      format_number(height, 3), mm ? "millimetres" : "centimetres"),
                          {{origin_, ""}},
                          fmt::format("add `scale: {}`", mm ? "0.001" : "0.01")});
    } else if (height < 0.02) {
      remarks_.push_back({"G0707",
                          Severity::warning,
                          fmt::format("`{}` is only {} m high", name_, format_number(height, 3)),
                          {{origin_, ""}},
                          "check the units of the file; `scale` multiplies its numbers"});
    }
    result_.mesh = std::move(mesh_);
    result_.findings = std::move(remarks_);
  }

  void note(const char* code, std::string message, std::string help) {
    remarks_.push_back({code, Severity::note, std::move(message), {{origin_, ""}}, std::move(help)});
  }

  void bad_line(const std::string& what) {
    fail("G0703", fmt::format("`{}` line {}: {}, in `{}`", name_, line_number_, what, shown(line_)),
         "export the mesh again; a cut-off file ends like this");
  }

  MeshResult fail(const char* code, std::string message, std::string help) {
    result_.findings.push_back({code, Severity::error, std::move(message), {{origin_, ""}}, std::move(help)});
    return result_;
  }

  std::string_view text_, line_;
  double scale_;
  const std::string& name_;
  OriginId origin_;
  bool as_is_;
  TriangleMesh mesh_;
  std::vector<int> corners_;
  Findings remarks_;
  MeshResult result_;
  std::size_t line_number_ = 0;
};

}  // namespace

MeshResult read_obj(std::string_view text, double scale, const std::string& name, OriginId origin) {
  return ObjReader(text, scale, name, origin).run();
}

MeshResult read_obj_as_is(std::string_view text, const std::string& name) {
  return ObjReader(text, 1, name, OriginId{}, true).run();
}

}  // namespace garment::body
