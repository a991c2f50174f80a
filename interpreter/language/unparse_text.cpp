#include "interpreter/language/unparse_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/units.hpp"
#include "runtime/base/number.hpp"

namespace garment::interpreter::text {
namespace {

constexpr std::string_view kExpressionWords[] = {
    "all", "and", "bodies", "draped", "else", "end",   "fabrics", "false", "for", "if",
    "in",  "is",  "minus",  "not",    "or",   "start", "true",    "x",     "y",   "z"};
constexpr std::string_view kPanelWords[] = {"left", "right", "start", "end", "middle", "at", "resolution"};

template <std::size_t n>
bool is_one_of(std::string_view word, const std::string_view (&words)[n]) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

std::string rounded(double value, double per_unit) {
  double scaled = std::round(value * per_unit);
  // Beyond 2^53 there are no decimals left to round.
  return format_number(std::abs(scaled) < 9e15 ? scaled / per_unit : value);
}

}  // namespace

std::string length(double metres) {
  std::string number = rounded(metres * 100, 1e10);
  return number == "0" ? number : number + " cm";
}

std::string point(const design::Point2& p) { return fmt::format("({}, {})", length(p.x()), length(p.y())); }

std::string point(const Eigen::Vector3d& p) {
  return fmt::format("({}, {}, {})", length(p.x()), length(p.y()), length(p.z()));
}

std::string curves(const std::vector<geometry::Curve>& links) {
  struct Course {
    std::string operator()(const geometry::Line&) const { return {}; }
    std::string operator()(const geometry::Quadratic& q) const { return ", control: " + point(q.control); }
    std::string operator()(const geometry::Cubic& c) const {
      return fmt::format(", controls: [{}, {}]", point(c.control_1), point(c.control_2));
    }
    std::string operator()(const geometry::Arc& arc) const { return ", bulge: " + length(arc.bulge); }
    std::string operator()(const geometry::Through& spline) const {
      std::string out;
      for (const design::Point2& p : spline.points) out += (out.empty() ? "" : ", ") + point(p);
      return ", through: [" + out + "]";
    }
    std::string operator()(const geometry::Chain&) const { return {}; }  // a link is never a chain
  };
  std::string out;
  for (const geometry::Curve& link : links) {
    const bool straight = std::holds_alternative<geometry::Line>(link.shape());
    const bool arc = std::holds_alternative<geometry::Arc>(link.shape());
    out += fmt::format("{}{}({}, {}{})", out.empty() ? "" : " + ", straight ? "line" : arc ? "arc" : "curve",
                       point(link.start()), point(link.end()), std::visit(Course{}, link.shape()));
  }
  return out;
}

std::string angle_deg(double degrees) {
  std::string number = rounded(degrees, 1e10);
  return number == "0" ? number : number + " deg";
}

std::string number(double value) { return format_number(value, 12); }

std::string in_quotes(std::string_view words) {
  std::string out = "\"";
  for (char c : words) {
    if (c == '"') c = '\'';
    if (c == '\\') c = '/';
    if (c == '{') c = '(';
    if (c == '}') c = ')';
    out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  return out + '"';
}

bool is_kept_word(std::string_view word) {
  return is_one_of(word, kExpressionWords) || find_construct(word) || find_function(word) || find_unit(word);
}

bool is_kept_in_panel(std::string_view word) {
  if (is_one_of(word, kPanelWords) || word == "close" || find_unit(word)) return true;
  const ConstructRecord* edge = find_construct("edge");
  return word == "edge" || (edge && find_clause(*edge, word));
}

std::string fresh_name(std::string_view name, std::string_view fallback, std::set<std::string>& taken,
                       bool (*kept)(std::string_view)) {
  std::string base;
  for (char c : name) {
    bool word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    base += word ? c : '_';
  }
  if (base.empty() || (base[0] >= '0' && base[0] <= '9') || base[0] == '_')
    base = std::string(fallback) + base;
  std::string candidate = base;
  for (int n = 1; kept(candidate) || taken.count(candidate) > 0; ++n)
    candidate = fmt::format("{}_{}", base, n);
  taken.insert(candidate);
  return candidate;
}

const std::string& edge_name(const Names& names, const design::EdgePart& part) {
  using On = design::EdgePart::On;
  const auto& lists = part.on == On::hole ? names.hole_edges : part.on == On::line ? names.lines : names.edges;
  return lists[static_cast<std::size_t>(part.panel)][static_cast<std::size_t>(part.edge)];
}

Names make_names(const design::Garment& garment, const std::string& also_body) {
  Names names;
  std::set<std::string> taken;
  for (const design::Body& body : garment.bodies)
    names.bodies.push_back(fresh_name(body.name, "body", taken));
  std::vector<std::string> used;
  for (const design::Attachment& attachment : garment.attachments) used.push_back(attachment.body);
  for (const design::Panel& panel : garment.panels) used.push_back(panel.placement.body);
  if (garment.bodies.empty() &&
      std::all_of(used.begin(), used.end(), [](const auto& n) { return n.empty(); }))
    used.push_back(also_body);
  for (const std::string& name : used) {
    auto same = [&](const design::Body& body) { return body.name == name; };
    bool declared = std::any_of(garment.bodies.begin(), garment.bodies.end(), same);
    bool known = std::count(names.undeclared_bodies.begin(), names.undeclared_bodies.end(), name) > 0;
    if (name.empty() || declared || known) continue;
    names.undeclared_bodies.push_back(name);
    taken.insert(name);
  }
  for (const design::Fabric& fabric : garment.fabrics)
    names.fabrics.push_back(fresh_name(fabric.name, "cloth", taken));
  for (const design::Panel& panel : garment.panels) {
    names.panels.push_back(fresh_name(panel.name, "panel", taken));
    std::set<std::string> of_panel;
    std::vector<std::string>& edges = names.edges.emplace_back();
    for (const design::Edge& edge : panel.edges)
      edges.push_back(fresh_name(edge.name, "edge", of_panel, is_kept_in_panel));
    auto name_all = [&](std::vector<std::vector<std::string>>& into, const auto& things, const char* fallback) {
      std::vector<std::string>& list = into.emplace_back();
      for (const auto& thing : things) list.push_back(fresh_name(thing.name, fallback, of_panel, is_kept_in_panel));
    };
    name_all(names.darts, panel.darts, "dart");
    name_all(names.notches, panel.notches, "notch");
    name_all(names.hole_edges, panel.hole_edges, "edge");
    name_all(names.holes, panel.holes, "hole");
    name_all(names.lines, panel.lines, "line");
    name_all(names.points, panel.points, "point");
    name_all(names.slits, panel.slits, "slit");
    name_all(names.inside_darts, panel.inside_darts, "dart");
    name_all(names.leg_darts, panel.leg_darts, "dart");
    name_all(names.pleats, panel.pleats, "pleat");
  }
  for (const design::Seam& seam : garment.seams) names.seams.push_back(fresh_name(seam.name, "seam", taken));
  for (const design::Pin& pin : garment.pins) names.pins.push_back(fresh_name(pin.name, "pin", taken));
  return names;
}

}  // namespace garment::interpreter::text
