#include "interpreter/session/body_cache.hpp"

#include "runtime/base/number.hpp"

namespace garment::session {
namespace {

constexpr std::size_t kMostKept = 16;  // bodies; a study of sizes asks for more

struct KeyMaker {
  std::string key;

  void add(const std::string& text) { key += text + '\n'; }
  void add(double x) { add(format_number(x)); }
  void add(const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  }

  void operator()(const design::Mannequin& m) {
    add(m.sex == design::Mannequin::Sex::woman ? "woman" : "man");
    add(m.size);
    for (const auto& [name, value] : m.measures) {
      add(name);
      add(value);
    }
  }
  void operator()(const design::MeshFile& m) {
    add(m.path);
    add(m.scale);
  }
  void operator()(const design::Sphere& s) { add(s.radius); }
  void operator()(const design::Ellipsoid& e) { add(e.semi_axes); }
  void operator()(const design::Cylinder& c) {
    add(c.radius);
    add(c.height);
  }
  void operator()(const design::Box& b) { add(b.size); }
  void operator()(const design::Floor&) {}
};

std::string key_of(const design::Body& body, const std::string& folder) {
  KeyMaker maker;
  maker.add(std::to_string(body.shape.index()));
  std::visit(maker, body.shape);
  maker.add(body.name);
  maker.add(body.position);
  maker.add(body.friction);
  maker.add(folder);
  return maker.key;
}

}  // namespace

body::BodyResult BodyCache::build(const design::Body& declared, Host& host, const std::string& folder) {
  const std::string key = key_of(declared, folder);
  if (const auto found = bodies_.find(key); found != bodies_.end()) return {found->second, {}};
  body::BodyResult result = body::build_body(declared, host, folder);
  ++n_built_;
  if (result.body && result.findings.empty()) {
    if (bodies_.size() >= kMostKept) bodies_.clear();
    bodies_.emplace(key, *result.body);
  }
  return result;
}

}  // namespace garment::session
