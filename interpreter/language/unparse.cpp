#include "interpreter/language/unparse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interpreter/language/unparse_cloth.hpp"
#include "interpreter/language/unparse_scene.hpp"
#include "interpreter/language/unparse_seam.hpp"
#include "interpreter/language/unparse_text.hpp"
#include "interpreter/language/unparse_things.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/io/pattern_rotation.hpp"

namespace garment::interpreter {
namespace {

using design::Placement;

std::string curve_clause(const geometry::Curve& curve) {
  struct Printer {
    std::string operator()(const geometry::Line&) const { return {}; }
    std::string operator()(const geometry::Quadratic& q) const {
      return " control " + text::point(q.control);
    }
    std::string operator()(const geometry::Cubic& c) const {
      return fmt::format(" controls {}, {}", text::point(c.control_1), text::point(c.control_2));
    }
    std::string operator()(const geometry::Arc& arc) const { return " bulge " + text::length(arc.bulge); }
    std::string operator()(const geometry::Through& spline) const {
      std::string out;
      for (const design::Point2& p : spline.points)
        out += (out.empty() ? " through " : ", ") + text::point(p);
      return out;
    }
    std::string operator()(const geometry::Chain& chain) const { return " along " + text::curves(*chain.links); }
  };
  return std::visit(Printer{}, curve.shape());
}

class Unparser {
 public:
  Unparser(const design::Garment& garment, const UnparseOptions& options)
      : garment_(garment),
        options_(options),
        names_(text::make_names(garment, options.body.empty() ? std::string() : options.body_name)) {}

  std::string write() {
    write_head();
    for (std::size_t p = 0; p < garment_.panels.size(); ++p) write_panel(p);
    group();
    for (std::size_t i = 0; i < garment_.seams.size(); ++i) line(text::seam(garment_, names_, i));
    group();
    for (const std::string& statement : text::cloth_statements(garment_, names_)) line(statement);
    group();
    for (std::size_t p = 0; p < garment_.panels.size(); ++p) write_placement(p);
    group();
    for (const design::Attachment& attachment : garment_.attachments) write_attachment(attachment);
    for (std::size_t i = 0; i < garment_.pins.size(); ++i) {
      const design::Pin& pin = garment_.pins[i];
      line(fmt::format("pin {} on {} at {}", names_.pins[i], names_.panels[pin.panel],
                       text::point(pin.point)));
    }
    for (const std::string& statement : text::scene(garment_, names_)) line(statement);
    if (garment_.gravity != design::Garment{}.gravity)
      line("gravity " + text::acceleration(garment_.gravity));
    group();
    for (const std::string& act : options_.acts) line(act);
    if (!options_.trailer.empty()) group();
    for (const std::string& words : options_.trailer) line(words);
    return std::move(out_);
  }

 private:
  void line(const std::string& words) { out_ += words + '\n'; }
  /// A blank line before the next group, where the last one wrote something.
  void group() {
    if (!out_.empty() && !out_.ends_with("\n\n")) out_ += '\n';
  }

  void write_head() {
    for (const std::string& comment : options_.comments) write_comment(comment);
    group();
    line("garment 1 " + text::in_quotes(options_.title.empty() ? garment_.title : options_.title));
    std::vector<std::string> statements = things();
    std::string use;
    for (const char* library : {"fabrics", "bodies"})
      for (const std::string& statement : statements)
        if (statement.find(fmt::format("= {}.", library)) != std::string::npos) {
          use += (use.empty() ? "use " : ", ") + std::string(library);
          break;
        }
    if (!use.empty()) line(use);
    group();
    for (const std::string& statement : statements) line(statement);
    group();
  }

  void write_comment(const std::string& comment) {
    std::string clean;
    for (char c : comment) clean += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    line(clean.empty() ? "#" : "# " + clean);
  }

  std::vector<std::string> things() const {
    std::vector<std::string> statements;
    for (std::size_t i = 0; i < garment_.bodies.size(); ++i)
      statements.push_back(text::body(names_.bodies[i], garment_.bodies[i]));
    for (const std::string& name : names_.undeclared_bodies)
      statements.push_back(options_.body.empty() ? fmt::format("# body {} = mesh(\"body.obj\")", name)
                                                 : fmt::format("body {} = {}", name, options_.body));
    for (std::size_t i = 0; i < garment_.fabrics.size(); ++i)
      statements.push_back(i == 0 && !options_.fabric.empty()
                               ? fmt::format("fabric {} = {}", names_.fabrics[i], options_.fabric)
                               : text::fabric(names_.fabrics[i], garment_.fabrics[i]));
    return statements;
  }

  void write_panel(std::size_t p) {
    const design::Panel& panel = garment_.panels[p];
    group();
    line(fmt::format("panel {} of {}{} {{", names_.panels[p], names_.fabrics[panel.fabric],
                     text::stacking_clauses(garment_, names_, p)));
    write_loop("outline", panel.edges, names_.edges[p], 0, panel.edges.size());
    write_inside(p);
    write_details(p);
    line("}");
  }

  void write_loop(const std::string& head, const std::vector<design::Edge>& edges, const std::vector<std::string>& names,
                  std::size_t first, std::size_t count) {
    if (count == 0) return;
    line(fmt::format("  {} from {} {{", head, text::point(edges[first].curve.start())));
    for (std::size_t e = first; e < first + count; ++e) {
      const design::Edge& edge = edges[e];
      bool last = e + 1 == first + count;
      std::string where = last ? std::string() : " to " + text::point(edge.curve.end());
      std::string allowance = edge.allowance > 0 ? " allowance " + text::length(edge.allowance) : "";
      line(fmt::format("    {} {}{}{}{}{}", last ? "close" : "edge", names[e], where, curve_clause(edge.curve),
                       allowance, edge.free ? " free" : ""));
    }
    line("  }");
  }

  void write_inside(std::size_t p) {
    const design::Panel& panel = garment_.panels[p];
    for (std::size_t i = 0; i < panel.holes.size(); ++i)
      write_loop("hole " + names_.holes[p][i], panel.hole_edges, names_.hole_edges[p],
                 static_cast<std::size_t>(panel.holes[i].first), static_cast<std::size_t>(panel.holes[i].count));
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
      const geometry::Curve& curve = panel.lines[i].curve;
      line(fmt::format("  line {} from {} to {}{}", names_.lines[p][i], text::point(curve.start()),
                       text::point(curve.end()), curve_clause(curve)));
    }
    for (std::size_t i = 0; i < panel.points.size(); ++i)
      line(fmt::format("  point {} at {}", names_.points[p][i], text::point(panel.points[i].point)));
    for (std::size_t i = 0; i < panel.slits.size(); ++i)
      line(fmt::format("  slit {} along {}", names_.slits[p][i],
                       names_.lines[p][static_cast<std::size_t>(panel.slits[i].line)]));
  }

  void write_folds(std::size_t p) {
    using Kind = design::Pleat::Kind;
    const design::Panel& panel = garment_.panels[p];
    for (std::size_t i = 0; i < panel.inside_darts.size(); ++i) {
      const design::InsideDart& dart = panel.inside_darts[i];
      line(fmt::format("  dart {} inside from {} to {} width {} at {}%", names_.inside_darts[p][i],
                       text::point(dart.from), text::point(dart.to), text::length(dart.width),
                       text::number(100 * dart.at)));
    }
    for (std::size_t i = 0; i < panel.leg_darts.size(); ++i)
      line(fmt::format("  dart {}: {} to {}", names_.leg_darts[p][i], edge_called(p, panel.leg_darts[i].leg_a),
                       edge_called(p, panel.leg_darts[i].leg_b)));
    for (std::size_t i = 0; i < panel.pleats.size(); ++i) {
      const design::Pleat& pleat = panel.pleats[i];
      const bool tuck = pleat.kind == Kind::tuck;
      std::string words = fmt::format("  {} {} on {} at {}", tuck ? "tuck" : "pleat", names_.pleats[p][i],
                                      edge_called(p, pleat.edge), text::length(pleat.at));
      if (pleat.kind == Kind::box) words += " box";
      if (pleat.kind == Kind::inverted) words += " inverted";
      words += (tuck ? " width " : " underlay ") + text::length(pleat.underlay);
      if (pleat.count > 1) words += fmt::format(" count {} every {}", pleat.count, text::length(pleat.spacing));
      if (pleat.toward < 0 && (tuck || pleat.kind == Kind::knife)) words += " toward start";
      if (pleat.length > 0) words += (tuck ? " length " : " stitched ") + text::length(pleat.length);
      line(words + (pleat.ironed ? " ironed" : ""));
    }
  }

  void write_details(std::size_t p) {
    const design::Panel& panel = garment_.panels[p];
    if (panel.grain_angle != 0)
      line("  grain " + text::angle_deg(90 + panel.grain_angle * (180 / portable::kPi)));
    if (panel.resolution != design::Panel{}.resolution)
      line("  resolution " + text::length(panel.resolution));
    if (!panel.label.empty()) line("  label " + text::in_quotes(panel.label));
    for (std::size_t i = 0; i < panel.notches.size(); ++i)
      line(fmt::format("  notch {} on {} at {}", names_.notches[p][i], edge_called(p, panel.notches[i].edge),
                       text::length(panel.notches[i].at)));
    for (std::size_t i = 0; i < panel.darts.size(); ++i) {
      const design::EdgeDart& dart = panel.darts[i];
      std::string tip = dart.apex ? "to " + text::point(*dart.apex) : "depth " + text::length(dart.depth);
      line(fmt::format("  dart {} on {} at {} width {} {}", names_.darts[p][i], edge_called(p, dart.edge),
                       text::length(dart.at), text::length(dart.width), tip));
    }
    write_folds(p);
  }

  const std::string& edge_called(std::size_t p, const std::string& name) const {
    for (std::size_t e = 0; e < garment_.panels[p].edges.size(); ++e)
      if (garment_.panels[p].edges[e].name == name) return names_.edges[p][e];
    for (std::size_t e = 0; e < garment_.panels[p].lines.size(); ++e)
      if (garment_.panels[p].lines[e].name == name) return names_.lines[p][e];
    for (std::size_t e = 0; e < garment_.panels[p].hole_edges.size(); ++e)
      if (garment_.panels[p].hole_edges[e].name == name) return names_.hole_edges[p][e];
    return name;
  }

  std::string body_called(const std::string& name) const {
    for (std::size_t i = 0; i < garment_.bodies.size(); ++i)
      if (garment_.bodies[i].name == name) return names_.bodies[i];
    return name;
  }

  void write_placement(std::size_t p) {
    const Placement& place = garment_.panels[p].placement;
    std::string statement = "place " + names_.panels[p];
    const std::string part = body_called(place.body) + (place.part.empty() ? "" : "." + place.part);
    switch (place.kind) {
      case Placement::Kind::none:
        if (place.folded) line(statement + " start folded");
        return;
      case Placement::Kind::rigid: {
        statement += " at " + text::point(place.translation);
        Eigen::Vector3d turn = io::angles_zyx(place.rotation);
        std::string angles = fmt::format("({}, {}, {})", text::angle_deg(turn.x()), text::angle_deg(turn.y()),
                                         text::angle_deg(turn.z()));
        if (angles != "(0, 0, 0)") statement += " turn " + angles;
        break;
      }
      case Placement::Kind::on_part:
      case Placement::Kind::around:
        statement += (place.kind == Placement::Kind::around ? " around " : " on ") + part;
        if (!place.edge.empty())
          statement += fmt::format(" with {} at {}.{}", edge_called(p, place.edge), body_called(place.body),
                                   place.level);
        statement += " offset " + text::length(place.offset);
        break;
    }
    if (place.folded) statement += " start folded";
    line_about(place.body, statement);
  }

  /// A script that speaks of a body it does not declare would be refused: such a line is written as a
  /// comment.
  void line_about(const std::string& body, const std::string& words) {
    const std::vector<std::string>& missing = names_.undeclared_bodies;
    bool undeclared =
        options_.body.empty() && std::find(missing.begin(), missing.end(), body) != missing.end();
    line((undeclared ? "# " : "") + words);
  }

  void write_attachment(const design::Attachment& attachment) {
    std::string edges;
    for (const design::EdgePart& part : attachment.parts)
      edges += (edges.empty() ? "" : ", ") + text::edge_part(garment_, names_, part);
    line_about(attachment.body, fmt::format("attach {} to {}.{} {}", edges, body_called(attachment.body),
                                            attachment.level, attachment.slide ? "slide" : "hold"));
  }

  const design::Garment& garment_;
  const UnparseOptions& options_;
  text::Names names_;
  std::string out_;
};

}  // namespace

std::string unparse(const design::Garment& garment, const UnparseOptions& options) {
  return Unparser(garment, options).write();
}

}  // namespace garment::interpreter
