#include "runtime/model/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/model/array_rows.hpp"
#include "runtime/model/model_arrays.hpp"

namespace garment::model {
namespace {

constexpr std::size_t kMostFindings = 10;

enum class Sign { positive, not_negative, any };

class Check {
 public:
  explicit Check(const Model& m) : m_(m) {}
  Findings findings;

  void fail(std::string message) {
    if (findings.size() < kMostFindings)
      findings.push_back({"G0490",
                          Severity::error,
                          std::move(message),
                          {},
                          "this is a fault of the program that made the model"});
  }

  template <class T>
  void array(const char* name, const std::vector<T>& values, Rows rows, Rows refers_to, Sign sign) {
    if (values.size() != row_count(m_, rows)) {
      fail(fmt::format("`{}` has {} rows, expected {}", name, values.size(), row_count(m_, rows)));
      return;
    }
    std::size_t limit = row_count(m_, refers_to);
    if (refers_to == Rows::fit_entry) ++limit;  // bounds may lie at the end
    for (std::size_t i = 0; i < values.size(); ++i) {
      bool good = true;
      for_each_number(values[i], [&](auto x) { good = good && number_is_good(x, refers_to, limit, sign); });
      if (good) continue;
      fail(fmt::format("row {} of `{}` is out of range", i, name));
      return;
    }
  }

  void ranges() {
    Index vertex = 0, triangle = 0;
    for (const PanelRange& p : m_.panels) {
      if (p.first_vertex != vertex || p.first_triangle != triangle || p.n_vertices < 0 || p.n_triangles < 0)
        fail(fmt::format("the ranges of panel `{}` do not follow those before it", p.name));
      vertex = p.first_vertex + p.n_vertices;
      triangle = p.first_triangle + p.n_triangles;
    }
    if (static_cast<std::size_t>(vertex) != m_.n_vertices() ||
        static_cast<std::size_t>(triangle) != m_.n_triangles())
      fail("the ranges of the panels do not cover all vertices and triangles");
    for (std::size_t k = 0; k + 1 < m_.fit_begin.size(); ++k)
      if (m_.fit_begin[k] > m_.fit_begin[k + 1])
        return fail(fmt::format("the entries of fit {} end before they begin", k));
    if (!m_.fit_begin.empty() && static_cast<std::size_t>(m_.fit_begin.back()) != m_.fit_particle.size())
      fail("the fits do not cover all entries");
    for (std::size_t f = 0; f < std::min(m_.fold_fit.size(), m_.fold_begin.size()); ++f) {
      const Index k = m_.fold_fit[f];
      if (f + 1 >= m_.fold_begin.size() || k < 0 || static_cast<std::size_t>(k) + 1 >= m_.fit_begin.size() ||
          m_.fold_begin[f + 1] - m_.fold_begin[f] != m_.fit_begin[k + 1] - m_.fit_begin[k])
        return fail(fmt::format("fold {} has not the places of its fit's particles", f));
    }
    for (const SeamChain& seam : m_.seams)
      for (Index i : seam.particles)
        if (i < 0 || static_cast<std::size_t>(i) >= m_.n_particles())
          return fail(fmt::format("seam `{}` names no particle", seam.name));
  }

  void ties() {
    for (std::size_t k = 0; k < std::min(m_.tie.size(), m_.tie_weights.size()); ++k) {
      const auto& w = m_.tie_weights[k];
      if (!(std::abs(w[0] + w[1] + w[2] - 1) < 1e-9 && std::abs(w[3] + w[4] + w[5] - 1) < 1e-9))
        return fail(fmt::format("the weights of tie {} do not sum to 1", k));
    }
    for (const Closure& c : m_.closures)
      if (!(c.mass >= 0 && std::isfinite(c.mass))) return fail(fmt::format("closure `{}` has no mass", c.name));
  }

  void motions() {
    auto fail_of = [&](const Motion& m) { fail(fmt::format("the poses of motion `{}` do not follow each other", m.name)); };
    for (const Motion& m : m_.motions) {
      bool good = !m.poses.empty() && m.pivot.allFinite();
      for (std::size_t k = 0; good && k < m.poses.size(); ++k)
        good = std::isfinite(m.poses[k].time) && m.poses[k].move.allFinite() && m.poses[k].turn.allFinite() &&
               (k == 0 || m.poses[k].time > m.poses[k - 1].time);
      if (!good) return fail_of(m);
    }
    for (const Holder& h : m_.holders)
      for (Index i : h.particles)
        if (i < 0 || static_cast<std::size_t>(i) >= m_.n_particles())
          return fail(fmt::format("holder `{}` names no particle", h.name));
    if (!m_.air.wind.allFinite() || !(m_.air.drag >= 0 && m_.air.gust >= 0)) fail("the air is out of range");
  }

  void laws() {
    for (std::size_t k = 0; k < m_.laws.size(); ++k) {
      const TensileLaw& law = m_.laws[k];
      bool good = law.strain.size() >= 2 && law.force.size() == law.strain.size() &&
                  law.slope.size() == law.strain.size();
      for (std::size_t i = 0; good && i < law.strain.size(); ++i) {
        good = std::isfinite(law.strain[i]) && std::isfinite(law.force[i]) && std::isfinite(law.slope[i]) &&
               law.slope[i] > 0;
        if (i > 0) good = good && law.strain[i] > law.strain[i - 1] && law.force[i] > law.force[i - 1];
      }
      if (!good) fail(fmt::format("tensile law {} does not rise", k));
    }
  }

 private:
  const Model& m_;

  static bool number_is_good(double x, Rows, std::size_t, Sign sign) {
    return std::isfinite(x) && (sign == Sign::any || x > 0 || (sign == Sign::not_negative && x == 0));
  }
  static bool number_is_good(Index x, Rows refers_to, std::size_t limit, Sign) {
    return refers_to == Rows::none || (x >= 0 && static_cast<std::size_t>(x) < limit);
  }
};

}  // namespace

Findings validate(const Model& model) {
  Check check(model);
#define CHECK_ARRAY(name, rows, refers_to, sign, unit) \
  check.array(#name, model.name, Rows::rows, Rows::refers_to, Sign::sign);
  GARMENT_MODEL_ARRAYS(CHECK_ARRAY)
#undef CHECK_ARRAY
  check.ranges();
  check.laws();
  check.ties();
  check.motions();
  return std::move(check.findings);
}

}  // namespace garment::model
