#include "interpreter/language/panels.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/modifiers.hpp"
#include "interpreter/language/outline.hpp"
#include "interpreter/language/panel_interior.hpp"
#include "interpreter/language/panel_marks.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/word_lists.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/design/fineness.hpp"
#include "runtime/design/unfold.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

class PanelMaker {
 public:
  PanelMaker(Program& program, Declaration& declaration, PanelInfo& info)
      : program_(program), declaration_(declaration), info_(info), panel_(info.panel) {}

  void make() {
    const Statement& statement = *declaration_.statement;
    const auto recipe = std::make_shared<Recipe>(make_recipe(program_, declaration_));
    recipe_ = recipe.get();
    panel_.name = declaration_.name;
    panel_.origin = program_.origin(statement.span);
    take_fabric();
    take_values();
    if (recipe_->outline.statement == nullptr)
      fail(program_, Message("G0411", "panel `" + panel_.name + "` has no outline", head_span())
                         .help("write `outline from (0, 0) { edge ... close ... }`"));
    Drawing drawing{program_, declaration_.index, info_, panel_, *recipe_};
    draw_outline(drawing);
    bool good = draw_interior(drawing) && check_interior(drawing);
    good = add_marks(drawing) && good;
    if (!good || !apply_modifiers(drawing)) throw Stop{};
    if (recipe_->mirrored) mirror();
    if (!recipe_->fold.empty()) open_fold();
    finish();
    program_.recipes[declaration_.index] = recipe;
  }

 private:
  void draw_outline(Drawing& drawing) {
    Loop loop;
    loop.head = &recipe_->outline;
    for (const RecipeItem& edge : recipe_->edges) loop.edges.push_back(&edge);
    loop.folded = !recipe_->fold.empty();
    loop.fold_span = recipe_->fold_span;
    draw_loop(drawing, loop, panel_.edges, spans_);
    check_crossings(program_, "`" + panel_.name + "`", panel_.edges, spans_);
    for (std::size_t k = 0; k < panel_.edges.size(); ++k) info_.spans[panel_.edges[k].name] = spans_[k];
  }

  Span head_span() const {
    const Statement& statement = *declaration_.statement;
    return statement.name ? grammar::cover(statement.keyword.span, statement.name->span)
                          : statement.keyword.span;
  }

  void take_fabric() {
    if (recipe_->fabric.value == nullptr)
      fail(program_, Message("G0312", "panel `" + panel_.name + "` needs a fabric", head_span())
                         .help("write `panel " + panel_.name + " of FABRIC { ... }`"));
    const Value value = eval(program_, *recipe_->fabric.value, *recipe_->fabric.scope);
    const auto* fabric = value.as<FabricValue>();
    if (fabric == nullptr)
      fail(program_,
           Message("G0306", kind_of(value) + " where `of` takes a fabric", recipe_->fabric.value->span));
    panel_.fabric = fabric_index(program_, fabric->fabric);
  }

  const RecipeValue* value_of(const char* word) const {
    const auto found = recipe_->values.find(word);
    return found == recipe_->values.end() ? nullptr : &found->second;
  }

  void take_values() {
    if (const RecipeValue* grain = value_of("grain")) {
      const Point2 way = eval_direction(program_, *grain->value, *grain->scope, "`grain`");
      panel_.grain_angle = portable::atan2(-way.x(), way.y());
    }
    if (const RecipeValue* resolution = value_of("resolution")) {
      panel_.resolution =
          eval_quantity(program_, *resolution->value, *resolution->scope, kLength, "`resolution`").value;
      if (!(panel_.resolution >= 1e-3 && panel_.resolution <= 0.1))
        fail(program_, Message("G0409",
                               "a resolution of " + format_quantity(panel_.resolution, kLength) +
                                   "; it must lie in 1 mm .. 10 cm",
                               resolution->value->span)
                           .help("5 mm to 15 mm suit most garments; is a unit wrong?"));
    }
    if (const RecipeValue* label = value_of("label")) {
      panel_.label = eval_text(program_, *label->value, *label->scope, "`label`");
      if (panel_.label != "body" && panel_.label != "leg" && panel_.label != "arm")
        fail(program_,
             Message("G0309", "\"" + panel_.label + "\" where `label` takes \"body\", \"leg\" or \"arm\"", label->value->span)
                 .help("it says where the piece is worn; leave it out where none fits"));
    }
  }

  double signed_area() const {
    double area = 0;
    for (const design::Edge& edge : panel_.edges) area += edge.curve.area_term();
    return area;
  }

  void mirror() {
    auto image = [](Point2& p) { p.x() = -p.x(); };
    for (auto* edges : {&panel_.edges, &panel_.hole_edges, &panel_.lines})
      for (design::Edge& edge : *edges) edge.curve = edge.curve.mirrored_x(0);
    for (design::InteriorPoint& point : panel_.points) image(point.point);
    for (design::EdgeDart& dart : panel_.darts)
      if (dart.apex) image(*dart.apex);
    for (design::InsideDart& dart : panel_.inside_darts) image(dart.from), image(dart.to);
    panel_.grain_angle = -panel_.grain_angle;
  }

  void open_fold() {
    std::size_t fold = panel_.edges.size();
    std::vector<std::string> names;
    for (std::size_t k = 0; k < panel_.edges.size(); ++k) {
      names.push_back(panel_.edges[k].name);
      if (panel_.edges[k].name == recipe_->fold) fold = k;
    }
    if (fold == panel_.edges.size())
      fail(program_,
           Message("G0301", "panel `" + panel_.name + "` has no edge `" + recipe_->fold + "` to fold on",
                   recipe_->fold_span)
               .help(meant_or_listed(recipe_->fold, names, "its edges are")));
    for (const design::Notch& notch : panel_.notches) refuse_on_fold(notch.edge, notch.name);
    for (const design::EdgeDart& dart : panel_.darts) refuse_on_fold(dart.edge, dart.name);
    for (const design::Pleat& pleat : panel_.pleats) refuse_on_fold(pleat.edge, pleat.name);
    const double fold_x = panel_.edges[fold].curve.start().x();
    double reach = 0;
    for (const design::Edge& edge : panel_.edges)
      reach += edge.curve.point_at(edge.curve.length() / 2).x() - fold_x;
    const bool drawn_is_left = (reach > 0) != info_.on_back;
    const std::size_t n = panel_.edges.size();
    design::UnfoldResult whole = design::unfold(panel_, fold, drawn_is_left);
    for (Diagnostic& diagnostic : to_diagnostics(whole.findings, program_.origins)) {
      Message message("", "", head_span());
      message.diagnostic = std::move(diagnostic);
      if (!info_.modifiers.empty()) message.also(info_.modifiers.back().statement->span, "changed here");
      report(program_, std::move(message));
    }
    if (!whole.panel) throw Stop{};
    drawn_names_ = names;
    drawn_spans_ = spans_;
    panel_ = *whole.panel;
    info_.folded = true;
    name_halves(n, fold, drawn_is_left);
  }

  void refuse_on_fold(const std::string& edge, const std::string& name) {
    if (edge != recipe_->fold) return;
    fail(program_, Message("G0414", "`" + name + "` stands on the fold, which is no edge of the opened panel",
                           info_.spans[name])
                       .help("notches, darts and pleats stand on the other edges"));
  }

  design::EdgePart part(std::size_t edge, bool with_curve) const {
    const double length = panel_.edges[edge].curve.length();
    return {declaration_.index, static_cast<int>(edge), with_curve ? 0 : length, with_curve ? length : 0};
  }

  /// Whole: edges 0 .. n-2 as drawn from the fold's end, then their images in reverse order.
  void name_halves(std::size_t n, std::size_t fold, bool drawn_is_left) {
    const std::string drawn = drawn_is_left ? "left" : "right", mirrored = drawn_is_left ? "right" : "left";
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const std::size_t source = (fold + 1 + k) % n, image = 2 * (n - 1) - 1 - k;
      const Span span = drawn_spans_[source];
      info_.edges.push_back({drawn_names_[source], drawn, {part(k, true)}, span});
      info_.edges.push_back({drawn_names_[source], mirrored, {part(image, false)}, span});
      if (k == 0) info_.edges.push_back({drawn_names_[source], "", {part(image, true), part(k, true)}, span});
      if (k + 2 == n && k > 0)
        info_.edges.push_back({drawn_names_[source], "", {part(k, true), part(image, true)}, span});
    }
  }

  void finish() {
    const double area = signed_area();
    info_.counter_clockwise = area > 0;
    info_.area = std::fabs(area);
    if (info_.area < 1e-6)
      fail(program_, Message("G0401", "the outline of `" + panel_.name + "` encloses no area", head_span())
                         .help("its edges run back on themselves: check the signs of the points"));
    if (!info_.folded) {
      if (recipe_->outline.statement->operands.empty()) {
        for (std::size_t k = 0; k < panel_.edges.size(); ++k)
          info_.edges.push_back({panel_.edges[k].name, "", {part(k, true)}, spans_[k]});
      } else {
        std::string name = panel_.edges[0].name;
        name.resize(name.size() - 2);  // "rim.1"
        info_.edges.push_back({name, "", {part(0, true), part(1, true)}, spans_[0]});
      }
    }
    name_interior(info_, declaration_.index);
    Point2 low(1e9, 1e9), high(-1e9, -1e9);
    for (const design::Edge& edge : panel_.edges)
      for (const Point2& p : edge.curve.polyline(1e-3)) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double narrow = (high - low).minCoeff();
    const double fits = design::fitting_resolution(design::half_mean_width(panel_), panel_.resolution);
    if (narrow < 2 * panel_.resolution)
      report(program_, Message("G0410",
                               "panel `" + panel_.name + "` is " + format_quantity(narrow, kLength) +
                                   " across: fewer than 3 particles at a resolution of " +
                                   format_quantity(panel_.resolution, kLength),
                               head_span())
                           .warning()
                           .help("state `" + panel_.name + ".resolution = " +
                                 format_quantity(std::max(design::kFinestResolution, fits), kLength) + "`"));
    info_.ready = true;
  }

  Program& program_;
  Declaration& declaration_;
  PanelInfo& info_;
  design::Panel& panel_;
  const Recipe* recipe_ = nullptr;
  std::vector<Span> spans_, drawn_spans_;
  std::vector<std::string> drawn_names_;
};

/// The word after the last dot of `form.back`, as written.
bool names_back(const Statement& statement) {
  for (const Clause& clause : statement.clauses)
    if (clause.word.text == "on" && clause.values.size() == 1 && clause.values[0].kind == ExprKind::member &&
        clause.values[0].text == "back")
      return true;
  return false;
}

}  // namespace

int reserve_panel(Program& program, const Declaration& declaration) {
  if (program.panels.size() >= kMaxPanels) {
    report(program, Message("G1604", "the garment has more than " + std::to_string(kMaxPanels) + " panels",
                            declaration.statement->keyword.span)
                        .help("make fewer pieces: a loop probably runs further than meant"));
    throw Exhausted{};
  }
  PanelInfo& info = program.panels.emplace_back();
  info.panel.name = declaration.name;
  info.part = declaration.scope->part;
  return static_cast<int>(program.panels.size()) - 1;
}

Value evaluate_panel(Program& program, Declaration& declaration) {
  // The right one of a pair is its left one's image: what is wrong with both is said once.
  if (declaration.pair_left != nullptr) force(program, *declaration.pair_left, declaration.statement->keyword.span);
  const std::size_t told = program.diagnostics.size();
  PanelMaker(program, declaration, program.panels[static_cast<std::size_t>(declaration.index)]).make();
  if (declaration.pair_left != nullptr) program.diagnostics.resize(told);
  return Value{PanelValue{declaration.index}};
}

void forget_panel(Program& program, Declaration& declaration) {
  PanelInfo& info = program.panels[static_cast<std::size_t>(declaration.index)];
  PanelInfo blank;
  blank.panel.name = declaration.name;
  blank.on_back = info.on_back;
  blank.part = info.part;
  info = std::move(blank);
  program.recipes.erase(declaration.index);
  std::erase_if(program.panel_places, [&](const Item& item) { return item.declaration == &declaration; });
}

void find_backs(Program& program) {
  for (const Item& item : program.main->items) {
    const std::string& keyword = item.statement->keyword.text;
    if (item.declaration != nullptr && (keyword == "panel" || keyword == "pair panel") && item.statement->body)
      for (const Statement& inner : *item.statement->body)
        if (inner.keyword.text == "place" && names_back(inner))
          program.panels[static_cast<std::size_t>(item.declaration->index)].on_back = true;
    if (item.statement->keyword.text != "place" || item.statement->operands.size() != 1) continue;
    if (!names_back(*item.statement)) continue;
    try {
      const Declaration* declaration =
          find_path(program, item.statement->operands[0], *item.scope).declaration;
      if (declaration != nullptr && declaration->index >= 0 &&
          (declaration->statement->keyword.text == "panel" || declaration->statement->keyword.text == "pair panel"))
        program.panels[static_cast<std::size_t>(declaration->index)].on_back = true;
    } catch (const Stop&) {
    }
  }
}

}  // namespace garment::interpreter
