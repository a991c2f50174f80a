// Builtin functions that give the shape of a body.
#include <algorithm>

#include "interpreter/language/files.hpp"
#include "interpreter/language/function_arguments.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter::detail {
namespace {

/// Measures of a person: the columns of the size table. Lengths, but for the weight.
constexpr std::string_view kMeasures[] = {"stature",
                                          "bust_chest",
                                          "underbust",
                                          "waist",
                                          "hip",
                                          "neckcircumference",
                                          "neckcircumferencebase",
                                          "biacromialbreadth",
                                          "bideltoidbreadth",
                                          "shoulderlength",
                                          "shouldercircumference",
                                          "sleeveoutseam",
                                          "acromionradialelength",
                                          "sleevelengthspinewrist",
                                          "bicepscircumferenceflexed",
                                          "wristcircumference",
                                          "thighcircumference",
                                          "lowerthighcircumference",
                                          "calfcircumference",
                                          "anklecircumference",
                                          "waistbacklength",
                                          "interscyei",
                                          "crotchheight",
                                          "waistheightomphalion",
                                          "trochanterionheight",
                                          "kneeheightmidpatella",
                                          "cervicaleheight",
                                          "acromialheight",
                                          "axillaheight",
                                          "chestheight",
                                          "chestbreadth",
                                          "chestdepth",
                                          "waistbreadth",
                                          "waistdepth",
                                          "hipbreadth",
                                          "buttockdepth",
                                          "headcircumference"};

double bounded_length_at(Call& call, std::size_t k, double min, double max) {
  const std::string name(call.record.parameters[k]);
  const double x =
      as_quantity(call.program, call.arguments[k], place(call, k), kLength, "`" + name + "`").value;
  if (!(x >= min && x <= max))
    fail(call.program, Message("G0309",
                               "`" + name + "` is " + format_quantity(x, kLength) + "; it must lie in " +
                                   format_quantity(min, kLength) + " .. " + format_quantity(max, kLength),
                               place(call, k)));
  return x;
}

/// Which measures of a person taken from a file come from the size table instead.
void note_estimates(Call& call, double size) {
  std::vector<std::string> estimated;
  std::swap(estimated, call.program.estimated);
  if (estimated.empty()) return;
  Message message("G0724", std::to_string(estimated.size()) + " measures of the person are estimated, from size " +
                               format_quantity(size, {}) + ": " + listed(estimated), call.expr.span);
  message.diagnostic.severity = Severity::note;
  report(call.program, std::move(message.help("state what you know, in the file or here, as in `thigh: 56 cm`")));
}

Value run_mannequin(Call& call) {
  design::Mannequin person;
  const auto* sex = call.arguments[0].as<std::string>();
  if (sex == nullptr || (*sex != "woman" && *sex != "man"))
    fail(call.program, Message("G0309", (sex == nullptr ? kind_of(call.arguments[0]) : "\"" + *sex + "\"") + " where `sex` takes \"woman\" or \"man\"", place(call, 0)));
  const bool woman = *sex == "woman";
  person.sex = woman ? design::Mannequin::Sex::woman : design::Mannequin::Sex::man;
  person.size = as_quantity(call.program, call.arguments[1], place(call, 1), kNumber, "`size`").value;
  const double min = woman ? 34 : 44, max = woman ? 48 : 58;
  if (!(person.size >= min && person.size <= max))
    fail(call.program, Message("G0309",
                               "size " + format_quantity(person.size, {}) + "; the table has " +
                                   format_quantity(min, {}) + " .. " + format_quantity(max, {}),
                               place(call, 1))
                           .help("take the nearest size and override measures, as in `bust: 94 cm`"));
  const std::vector<std::string> names(std::begin(kMeasures), std::end(kMeasures));
  for (std::size_t k = 0; k < call.further.size(); ++k) {
    const auto& [name, value] = call.further[k];
    const Span span = call.further_places[k]->span;
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail(call.program,
           Message("G0307", "a person has no measure `" + name + "`", span).help(meant_or_listed(name, names, "its measures are")));
    const double x = as_quantity(call.program, value, span, kLength, "`" + name + "`").value;
    if (!(x >= 0.05 && x <= 2.6))
      fail(call.program,
           Message("G0309",
                   "`" + name + "` is " + format_quantity(x, kLength) + "; a measure lies in 5 cm .. 260 cm",
                   span));
    person.measures[name] = x;
  }
  note_estimates(call, person.size);
  return Value{ShapeValue{person}};
}

Value run_mesh(Call& call) {
  const auto* path = call.arguments[0].as<std::string>();
  if (path == nullptr)
    fail(call.program, Message("G0306", "`mesh` takes a file name in quotes", place(call, 0)));
  design::MeshFile file;
  file.path = readable_path(call.program, *path, place(call, 0));
  if (call.given(1)) {
    file.scale = as_quantity(call.program, call.arguments[1], place(call, 1), kNumber, "`scale`").value;
    if (!(file.scale >= 1e-4 && file.scale <= 1e4))
      fail(call.program, Message("G0309", "`scale` is " + format_quantity(file.scale, {}) + "; it must lie in 0.0001 .. 10000", place(call, 1)).help("it is metres for one unit of the file: 0.01 for centimetres, 0.001 for millimetres"));
  }
  return Value{ShapeValue{file}};
}

constexpr double kSmallest = 1e-3, kLargest = 20;  // m

Eigen::Vector3d sizes_at(Call& call, std::size_t k) {
  const auto* p = call.arguments[k].as<PointValue>();
  const std::string name(call.record.parameters[k]);
  if (p == nullptr || p->size != 3 || p->dimension != kLength)
    fail(call.program, Message("G0306", "`" + name + "` takes three lengths `(x, y, z)`", place(call, k)));
  for (double x : p->at)
    if (!(x >= kSmallest && x <= kLargest))
      fail(call.program,
           Message("G0309",
                   "`" + name + "` has " + format_quantity(x, kLength) + "; each must lie in 1 mm .. 20 m",
                   place(call, k)));
  return {p->at[0], p->at[1], p->at[2]};
}

}  // namespace

std::vector<FunctionRecord> shape_functions() {
  return {
      {.name = "mannequin",
       .form = "mannequin(sex: \"woman\" | \"man\", size: N, MEASURE: LENGTH, ...)",
       .doc = "a person by measures; `bodies.woman` and `bodies.man` fill them from the size table",
       .example = "mannequin(sex: \"woman\", size: 40, waist: 76 cm)",
       .parameters = {"sex", "size"},
       .required = 2,
       .run = run_mannequin,
       .open = true},
      {"mesh",
       "mesh(\"FILE.obj\" [, scale: N])",
       "a closed surface from a file, metres unless scaled",
       "mesh(\"form.obj\")",
       {"file", "scale"},
       1,
       run_mesh},
      {"sphere",
       "sphere(radius: LENGTH)",
       "a ball about the body's place",
       "sphere(radius: 15 cm)",
       {"radius"},
       1,
       [](Call& call) { return Value{ShapeValue{design::Sphere{bounded_length_at(call, 0, kSmallest, kLargest)}}}; }},
      {"ellipsoid",
       "ellipsoid(semi_axes: (X, Y, Z))",
       "an ellipsoid about the body's place",
       "ellipsoid(semi_axes: (20 cm, 30 cm, 15 cm))",
       {"semi_axes"},
       1,
       [](Call& call) { return Value{ShapeValue{design::Ellipsoid{sizes_at(call, 0)}}}; }},
      {"cylinder",
       "cylinder(radius: LENGTH, height: LENGTH)",
       "an upright cylinder on the body's place: a round table",
       "cylinder(radius: 40 cm, height: 72 cm)",
       {"radius", "height"},
       2,
       [](Call& call) {
         const double radius = bounded_length_at(call, 0, kSmallest, kLargest);
         return Value{ShapeValue{design::Cylinder{radius, bounded_length_at(call, 1, kSmallest, kLargest)}}};
       }},
      {"box",
       "box(size: (X, Y, Z))",
       "a box about the body's place",
       "box(size: (80 cm, 72 cm, 80 cm))",
       {"size"},
       1,
       [](Call& call) { return Value{ShapeValue{design::Box{sizes_at(call, 0)}}}; }},
  };
}

}  // namespace garment::interpreter::detail
