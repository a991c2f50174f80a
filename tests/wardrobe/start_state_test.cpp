// Twelve garments on nine bodies: does the modelled start state pass the exact certificate?
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "runtime/base/host.hpp"
#include "runtime/base/number.hpp"
#include "runtime/io/pattern_json.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/simulator/certificate.hpp"
#include "tests/unit/body/size_table.hpp"

using namespace garment;

namespace {

const std::string kData = GARMENT_DATA_DIR;

constexpr const char* kGarments[] = {
    "garment_pattern_generator/basic_tee/tee.json",
    "garment_pattern_generator/basic_tee/tee_sleeveless.json",
    "garment_pattern_generator/basic_tee/jacket_hood.json",
    "garment_pattern_generator/skirts/skirt_4_panels.json",
    "garment_pattern_generator/skirts/skirt_waistband.json",
    "garment_pattern_generator/pants/pants_straight_sides.json",
    "garment_pattern_generator/combos/dress_sleeveless.json",
    "garment_pattern_generator/combos/jumpsuit.json",
    "garmentcode/shirt_mean_specification.json",
    "garmentcode/hoody_mean_specification.json",
    "garmentcode/js_mean_all_specification.json",
    "garmentcode/dress_pencil_specification.json",
};

struct Wearer {
  std::string name;
  body::Body body;
};

void add(std::vector<Wearer>& out, const std::string& name, const design::Body& declared) {
  body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  built.body->name = "form";
  out.push_back({name, std::move(*built.body)});
}

std::vector<Wearer> wearers() {
  std::vector<Wearer> out;
  for (const body::SizeRow& row : body::size_table()) {
    const bool woman = row.person.sex == design::Mannequin::Sex::woman;
    const std::set<int> sizes = woman ? std::set<int>{36, 42, 48} : std::set<int>{46, 50, 56};
    if (!sizes.contains(static_cast<int>(row.person.size))) continue;
    design::Body declared = body::declare(row.person);
    add(out, (woman ? "woman " : "man ") + format_number(row.person.size), declared);
  }
  for (const char* file : {"f_smpl_average_A40.obj", "m_smpl_average_A40.obj", "f_smpl_template.obj"}) {
    design::Body declared;
    declared.name = "form";
    declared.shape = design::MeshFile{kData + "/bodies/" + file, 1};
    add(out, file, declared);
  }
  return out;
}

struct Heights {
  double low = 1e300, high = -1e300;
};
Heights heights_of(const body::Body& body) {
  Heights h;
  for (const auto& v : body.mesh.vertices) h.low = std::min(h.low, v.y()), h.high = std::max(h.high, v.y());
  return h;
}

/// As the program raises or lowers an imported garment into the space of its body.
void share_frame(design::Garment& garment, io::PatternFrame frame, const body::Body& body) {
  const Heights h = heights_of(body);
  const bool on_floor = h.low > -0.3 * (h.high - h.low);
  const double shift = io::pelvis_shift(h.high - h.low);
  if (frame == io::PatternFrame::pelvis && on_floor) io::move_garment(garment, {0, shift, 0});
  if (frame == io::PatternFrame::floor && !on_floor) io::move_garment(garment, {0, -shift, 0});
}

struct Outcome {
  std::string refused;  ///< code and message, where the model was not built
  std::size_t cloth = 0, body = 0, inside = 0;
  std::string pairs;  ///< "front x lfsleeve 12, ...": which panels meet
  bool clean() const { return refused.empty() && cloth + body + inside == 0; }
};

Outcome outcome(const std::string& text, const body::Body& body) {
  io::PatternOptions options;
  options.fabric = io::import_fabric();
  io::PatternResult pattern = io::read_pattern(text, options);
  REQUIRE(pattern.garment);
  share_frame(*pattern.garment, pattern.frame, body);
  design::Body declared;
  declared.name = options.body;
  pattern.garment->bodies.push_back(declared);
  const std::vector<body::Body> bodies{body};
  const modeller::ModelResult built = modeller::build_model(*pattern.garment, bodies);
  Outcome out;
  if (!built.model) {
    for (const Finding& f : built.findings)
      if (f.severity == Severity::error && out.refused.empty()) out.refused = f.code + ": " + f.message;
    CHECK_FALSE(out.refused.empty());
    return out;
  }
  model::State state;
  state.position = built.model->start;
  state.velocity.assign(built.model->n_particles(), Eigen::Vector3d::Zero());
  const simulator::Certificate c = simulator::certify(*built.model, state, bodies);
  out.cloth = c.self_intersections, out.body = c.body_intersections, out.inside = c.inside_body;
  auto panel_of = [&](model::Index triangle) {
    return built.model
        ->panels[static_cast<std::size_t>(built.model->triangle_panel[static_cast<std::size_t>(triangle)])]
        .name;
  };
  std::map<std::string, int> pairs;
  for (const simulator::SelfHit& hit : c.self_hits) {
    const std::string a = panel_of(hit.a), b = panel_of(hit.b);
    ++pairs[std::min(a, b) + " x " + std::max(a, b)];
  }
  for (const auto& [name, n] : pairs)
    out.pairs += (out.pairs.empty() ? "" : ", ") + name + " " + std::to_string(n);
  return out;
}

}  // namespace

TEST_CASE("imported garments start clear of bodies of both sexes and all sizes") {
  const auto present = system_host().read_file(kData + "/" + kGarments[0], 1u << 24);
  if (!present) {
    WARN("skipped: no reference data in " << kData);
    return;
  }
  const std::vector<Wearer> people = wearers();
  REQUIRE(people.size() == 9);
  int clean = 0, all = 0;
  std::string table;
  for (const char* garment : kGarments) {
    const auto text = system_host().read_file(kData + "/" + garment, 1u << 24);
    REQUIRE(text);
    for (const Wearer& wearer : people) {
      INFO(garment << " on " << wearer.name);
      const Outcome found = outcome(*text.value, wearer.body);
      INFO(found.pairs << found.refused);
      CHECK(found.body == 0);
      CHECK(found.inside == 0);
      CHECK(found.cloth == 0);
      clean += found.clean(), ++all;
      if (!found.clean())
        table += std::string(garment) + " on " + wearer.name + ": " + found.pairs + found.refused + "\n";
    }
  }
  CHECK(all == 108);
  CHECK(clean == all);
  if (clean < all) WARN(clean << " of " << all << " start without any intersection; the others:\n" << table);
}
