#include "runtime/model/dump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/base/number.hpp"
#include "runtime/model/array_rows.hpp"
#include "runtime/model/model_arrays.hpp"

namespace garment::model {
namespace {

struct Fnv {
  std::uint64_t value = 0xcbf29ce484222325ull;
  void add(std::uint64_t bits) {
    for (int k = 0; k < 8; ++k) {
      value ^= (bits >> (8 * k)) & 0xff;
      value *= 0x100000001b3ull;
    }
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(Index x) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(x))); }
  template <class T>
  void add(const std::vector<T>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const T& row : values) for_each_number(row, [&](auto x) { add(x); });
  }
};

std::string number(double x) { return std::isfinite(x) ? format_number(x) : "null"; }
std::string number(Index x) { return fmt::to_string(x); }

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <class T>
std::string row_text(const T& row) {
  std::string text;
  for_each_number(row, [&](auto x) {
    if (!text.empty()) text += ',';
    text += number(x);
  });
  return kIsTuple<T> ? "[" + text + "]" : text;
}

template <class T>
std::string list_text(const std::vector<T>& values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += ',';
    text += row_text(values[i]);
  }
  return text + "]";
}

template <class T, class F>
std::string objects_text(const std::vector<T>& values, const F& one) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i > 0 ? ",\n    " : "\n    ") + one(values[i]);
  return text + (values.empty() ? "]" : "\n  ]");
}

std::string motion_text(const Motion& m) {
  std::string poses;
  for (const Pose& p : m.poses)
    poses += fmt::format("{}{{\"time\": {}, \"move\": {}, \"turn\": {}}}", poses.empty() ? "" : ", ", number(p.time),
                         row_text(p.move), row_text(p.turn));
  return fmt::format(R"({{"name": {}, "body": {}, "pivot": {}, "poses": [{}]}})", quoted(m.name), m.body, row_text(m.pivot), poses);
}

}  // namespace

std::uint64_t state_hash(const State& state) {
  Fnv hash;
  for (const Vector3d& x : state.position)
    for (int k = 0; k < 3; ++k) hash.add(x[k]);
  return hash.value;
}

std::uint64_t model_hash(const Model& model) {
  Fnv hash;
  // What few garments have counts where there is any: a garment without it is the model it was before the Model knew of it.
#define HASH_ARRAY(name, rows, refers_to, sign, unit) \
  if (!is_rare(Rows::rows) || !model.name.empty()) hash.add(model.name);
  GARMENT_MODEL_ARRAYS(HASH_ARRAY)
#undef HASH_ARRAY
  for (const TensileLaw& law : model.laws) {
    hash.add(law.strain);
    hash.add(law.force);
    hash.add(law.slope);
  }
  for (const PanelRange& p : model.panels) {
    for (Index i : {p.first_vertex, p.n_vertices, p.first_triangle, p.n_triangles}) hash.add(i);
    for (double x : {p.area, p.mass}) hash.add(x);
  }
  for (const SeamChain& s : model.seams) {
    hash.add(s.particles);
    hash.add(s.length);
  }
  for (int k = 0; k < 3; ++k) hash.add(model.gravity[k]);
  for (const Motion& m : model.motions) {
    hash.add(m.body);
    for_each_number(m.pivot, [&](double x) { hash.add(x); });
    for (const Pose& pose : m.poses) {
      hash.add(pose.time);
      for (const Vector3d* v : {&pose.move, &pose.turn}) for_each_number(*v, [&](double x) { hash.add(x); });
    }
  }
  if (model.air.still()) return hash.value;
  for_each_number(model.air.wind, [&](double x) { hash.add(x); });
  for (double x : {model.air.gust, model.air.drag}) hash.add(x);
  return hash.value;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string summary_text(const Model& model) {
  double mass = 0, area = 0;
  for (const PanelRange& p : model.panels) {
    mass += p.mass;
    area += p.area;
  }
  for (const Closure& c : model.closures) mass += c.mass;
  std::string text;
  auto line = [&](const std::string& l) { text += l + "\n"; };
  line(fmt::format("particles {}, vertices {}, triangles {}", model.n_particles(), model.n_vertices(),
                   model.n_triangles()));
  line(fmt::format("cells {}, springs {}, membranes {}, bends {}, fits {}, holds {}", model.cell.size(),
                   model.spring.size(), model.membrane.size(), model.bend.size(), model.fit_area.size(),
                   model.hold_particle.size()));
  line(fmt::format("mass {} g, area {} cm^2", format_number(mass * 1000, 6), format_number(area * 1e4, 6)));
  for (const PanelRange& p : model.panels)
    line(fmt::format("panel {}: {} vertices, {} triangles, {} cm^2, {} g", p.name, p.n_vertices,
                     p.n_triangles, format_number(p.area * 1e4, 6), format_number(p.mass * 1000, 6)));
  for (const SeamChain& s : model.seams)
    line(fmt::format("seam {}: {} particles, {} mm", s.name, s.particles.size(),
                     format_number(s.length * 1000, 6)));
  for (std::size_t c = 0; c < model.closures.size(); ++c) {
    const auto n = std::count(model.tie_closure.begin(), model.tie_closure.end(), static_cast<Index>(c));
    line(fmt::format("closure {}: {} {}", model.closures[c].name, n, n == 1 ? "tie" : "ties"));
  }
  for (const RegionValues& r : model.regions)
    line(fmt::format("region {} on {}: {} cm^2, {} g/m^2, bending {} and {} uN m, stretch {} and {} N/m", r.name, r.panel,
                     format_number(r.area * 1e4, 5), format_number(r.areal_density * 1000, 4), format_number(r.bending[0] * 1e6, 4),
                     format_number(r.bending[1] * 1e6, 4), format_number(r.tensile[0], 4), format_number(r.tensile[1], 4)));
  line("hash " + hash_text(model_hash(model)));
  return text;
}

std::string dump_json(const Model& model) {
  std::string text = "{\n";
#define DUMP_ARRAY(name, rows, refers_to, sign, unit) \
  text += "  \"" #name "\": " + list_text(model.name) + ",\n";
  GARMENT_MODEL_ARRAYS(DUMP_ARRAY)
#undef DUMP_ARRAY
  text +=
      "  \"laws\": " +
      objects_text(model.laws,
                   [](const TensileLaw& law) {
                     return fmt::format(R"({{"strain": {}, "force": {}, "slope": {}}})",
                                        list_text(law.strain), list_text(law.force), list_text(law.slope));
                   }) +
      ",\n";
  text +=
      "  \"panels\": " +
      objects_text(
          model.panels,
          [](const PanelRange& p) {
            return fmt::format(
                R"({{"name": {}, "first_vertex": {}, "n_vertices": {}, "first_triangle": {}, "n_triangles": {}, "area": {}, "mass": {}, "color": {}}})",
                quoted(p.name), p.first_vertex, p.n_vertices, p.first_triangle, p.n_triangles, number(p.area),
                number(p.mass), row_text(p.color));
          }) +
      ",\n";
  text += "  \"seams\": " +
          objects_text(model.seams,
                       [](const SeamChain& s) {
                         return fmt::format(R"({{"name": {}, "length": {}, "particles": {}}})",
                                            quoted(s.name), number(s.length), list_text(s.particles));
                       }) +
          ",\n";
  text +=
      "  \"regions\": " +
      objects_text(
          model.regions,
          [](const RegionValues& r) {
            return fmt::format(
                R"({{"name": {}, "panel": {}, "area": {}, "areal_density": {}, "thickness": {}, "friction": {}, "tensile": {}, "shear": {}, "bending": {}, "twist": {}, "rest_length": {}}})",
                quoted(r.name), quoted(r.panel), number(r.area), number(r.areal_density), number(r.thickness), number(r.friction),
                row_text(r.tensile), number(r.shear), row_text(r.bending), number(r.twist), row_text(r.rest_length));
          }) +
      ",\n";
  text += "  \"closures\": " +
          objects_text(model.closures,
                       [](const Closure& c) {
                         return fmt::format(R"({{"name": {}, "mass": {}}})", quoted(c.name), number(c.mass));
                       }) +
          ",\n";
  text += "  \"motions\": " + objects_text(model.motions, motion_text) + ",\n";
  text += "  \"holders\": " +
          objects_text(model.holders,
                       [](const Holder& h) {
                         return fmt::format(R"({{"name": {}, "particles": {}}})", quoted(h.name), list_text(h.particles));
                       }) +
          ",\n";
  text += fmt::format("  \"air\": {{\"wind\": {}, \"gust\": {}, \"drag\": {}}},\n", row_text(model.air.wind),
                      number(model.air.gust), number(model.air.drag));
  text += "  \"gravity\": " + row_text(model.gravity) + ",\n";
  text += "  \"hash\": \"" + hash_text(model_hash(model)) + "\"\n}\n";
  return text;
}

}  // namespace garment::model
