#pragma once
// A woman of size 40 for the tests of placement, made once.
#include <catch2/catch.hpp>

#include "runtime/base/host.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/modeller/modeller.hpp"

namespace garment::test {

inline const std::vector<body::Body>& woman() {
  static const std::vector<body::Body> bodies = [] {
    design::Body declared;
    declared.name = "form";
    design::Mannequin person;  // the measures of stdlib's size 40 in cm
    for (auto [name, cm] :
         std::initializer_list<std::pair<const char*, double>>{{"stature", 168},
                                                               {"bust_chest", 92},
                                                               {"underbust", 77},
                                                               {"waist", 76},
                                                               {"hip", 100.0},
                                                               {"neckcircumference", 32.6},
                                                               {"neckcircumferencebase", 37.1},
                                                               {"biacromialbreadth", 37.2},
                                                               {"bideltoidbreadth", 44.5},
                                                               {"shoulderlength", 13.8},
                                                               {"shouldercircumference", 102.8},
                                                               {"sleeveoutseam", 56.2},
                                                               {"acromionradialelength", 32.1},
                                                               {"sleevelengthspinewrist", 82.7},
                                                               {"bicepscircumferenceflexed", 29.6},
                                                               {"wristcircumference", 15.6},
                                                               {"thighcircumference", 59.9},
                                                               {"lowerthighcircumference", 39.4},
                                                               {"calfcircumference", 36.9},
                                                               {"anklecircumference", 21.6},
                                                               {"waistbacklength", 43.0},
                                                               {"interscyei", 36.9},
                                                               {"crotchheight", 81.6},
                                                               {"waistheightomphalion", 102.0},
                                                               {"trochanterionheight", 87.6},
                                                               {"kneeheightmidpatella", 46.7},
                                                               {"cervicaleheight", 144.2},
                                                               {"acromialheight", 137.9},
                                                               {"axillaheight", 128.3},
                                                               {"chestheight", 121.6},
                                                               {"chestbreadth", 26.7},
                                                               {"chestdepth", 23.8},
                                                               {"waistbreadth", 29.0},
                                                               {"waistdepth", 20.1},
                                                               {"hipbreadth", 34.8},
                                                               {"buttockdepth", 22.4},
                                                               {"headcircumference", 56.4}})
      person.measures[name] = cm / 100;
    declared.shape = person;
    body::BodyResult built = body::build_body(declared, system_host(), "");
    REQUIRE(built.body);
    std::vector<body::Body> all;
    all.push_back(std::move(*built.body));
    return all;
  }();
  return bodies;
}

/// The model of a garment that she wears; the test fails where there is none.
inline model::Model build_on_woman(const design::Garment& g) {
  modeller::ModelResult r = modeller::build_model(g, woman());
  for (const Finding& f : r.findings)
    if (f.severity == Severity::error) FAIL(f.code << " " << f.message);
  REQUIRE(r.model);
  return std::move(*r.model);
}

/// Least distance of the particles from the body, m; 1 where none is near.
inline double least_distance(const model::Model& m, const body::Body& body) {
  double least = 1;
  for (const auto& p : m.start)
    if (auto hit = body.closest(p, 0.3)) least = std::min(least, hit->distance);
  return least;
}

inline int panel_index(const model::Model& m, const std::string& name) {
  for (std::size_t p = 0; p < m.panels.size(); ++p)
    if (m.panels[p].name == name) return static_cast<int>(p);
  return -1;
}

/// Winding of the panels' particles round the segment from `a` to `b`, seen along it: the angle between
/// neighbours, summed over the ring of particles that lie within `band` of its middle, in order of angle;
/// here simply whether each of eight sectors round the axis holds a particle.
inline bool surrounds(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b, double band) {
  Eigen::Vector3d axis = (b - a).normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  int sectors = 0;
  for (const auto& p : points) {
    Eigen::Vector3d d = p - (a + b) / 2;
    if (std::abs(d.dot(axis)) > band) continue;
    double x = d.dot(u), y = d.dot(v);
    int sector = (x > 0 ? 1 : 0) + (y > 0 ? 2 : 0) + (std::abs(x) > std::abs(y) ? 4 : 0);
    sectors |= 1 << sector;
  }
  return sectors == 0xff;
}

}  // namespace garment::test
