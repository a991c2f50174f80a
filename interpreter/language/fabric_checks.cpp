// What a fabric leaves open, and figures that do not go with its weight.
#include <fmt/format.h>

#include <algorithm>

#include "interpreter/language/fabric_fields.hpp"
#include "interpreter/language/files.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

/// Bands of figures against weight. Source: the shell and lining fabrics of the table of fabrics in
/// stdlib/fabrics.garment (Matsudaira et al. 2015; a FAST laboratory report of 2014; Kawabata's population
/// means; class-typical figures), 16 cloths of 35 .. 407 g/m^2. Found there, W in kg/m^2, SI:
///   B / W^2 = 1.3e-4 .. 6.8e-4     bending grows with the square of the weight
///   G / W   = 156 .. 586
///   EM      = 2.5 .. 8 % at 500 gf/cm, whatever the weight
///   W / T   = 267 .. 500 kg/m^3
/// The bands are three times as wide on either side (twice for thickness, which varies less; EM up to ten
/// times: knits give more than the woven cloths of the table).
struct Band {
  double low, high;
};
Band bend_band(double w) { return {1.3e-4 / 3 * w * w, 6.8e-4 * 3 * w * w}; }
Band shear_band(double w) { return {156.0 / 3 * w, 586.0 * 3 * w}; }
Band extension_band() { return {0.025 / 3, 0.08 * 10}; }
Band thickness_band(double w) { return {w / (500.0 * 2), w / (267.0 / 2)}; }

const char* direction_text(std::size_t d) { return d == 0 ? "_warp" : "_weft"; }

void warn_band(Program& program, const std::string& fabric, const std::string& figure, double value,
               Band band, Dimension dimension, bool percent, double weight, Span span) {
  if (value >= band.low && value <= band.high) return;
  auto text = [&](double x) {
    if (dimension == kMoment) return fmt::format("{:.2g} N*m ({:.2g} gf*cm^2/cm)", x, x / 9.80665e-5);
    if (dimension == kShearRigidity) return fmt::format("{:.2g} N/m ({:.2g} gf/cm/deg)", x, x / 56.187966);
    return format_quantity(x, dimension, percent, 2);
  };
  report(
      program,
      Message("G1131",
              "`" + figure + "` of fabric `" + fabric + "` is " + text(value) + "; cloth of " +
                  format_quantity(weight, kArealDensity, false, 3) + " has " + text(band.low) + " .. " +
                  text(band.high),
              span)
          .warning()
          .help("is a unit or a power of ten wrong? Interlinings, coated cloth and knits may lie outside"));
}

}  // namespace

void warn_defaults(Program& program, const Given& given, const std::string& name, Span span) {
  const design::Fabric standard;
  std::vector<std::string> taken;
  auto has = [&](std::size_t d, std::initializer_list<Slot> slots) {
    return std::any_of(slots.begin(), slots.end(), [&](Slot slot) { return given.at(slot, d).has_value(); });
  };
  auto both = [&](const std::string& figure, const std::string& value, std::initializer_list<Slot> slots) {
    const bool warp = has(0, slots), weft = has(1, slots);
    if (!warp && !weft) taken.push_back(figure + " = " + value);
    if (warp != weft) taken.push_back(figure + direction_text(warp ? 1 : 0) + " = " + value);
  };
  if (!has(0, {Slot::W})) taken.push_back("W = " + format_quantity(standard.areal_density, kArealDensity));
  if (!has(0, {Slot::T})) taken.push_back("T = " + format_quantity(standard.thickness, kLength));
  both("EM", format_quantity(standard.tensile[0].max_strain, {}, true),
       {Slot::EM, Slot::stretch, Slot::E100});
  if (!has(0, {Slot::G, Slot::EB5}))
    taken.push_back("G = " + format_quantity(standard.shear_rigidity, kForcePerLength));
  both("B", fmt::format("{:.2g} N*m", standard.bending_rigidity[0]), {Slot::B, Slot::bending_length});
  if (taken.empty()) return;
  std::string list;
  for (const std::string& figure : taken) list += (list.empty() ? "" : ", ") + figure;
  report(program, Message("G1130", "fabric `" + name + "` leaves figures open; taken are " + list, span)
                      .warning()
                      .help("give them, or begin with a known cloth: `fabrics.denim with { ... }`"));
}

void warn_implausible(Program& program, const design::Fabric& fabric, const Given& given,
                      const std::string& name) {
  const double w = fabric.areal_density;
  for (std::size_t d = 0; d < 2; ++d) {
    if (given.at(Slot::B, d) && !(d == 1 && given.at(Slot::B, 0) == given.at(Slot::B, 1)))
      warn_band(program, name, std::string("B") + direction_text(d), fabric.bending_rigidity[d], bend_band(w),
                kMoment, false, w, given.place(Slot::B, d));
    if (given.at(Slot::EM, d) && !(d == 1 && given.at(Slot::EM, 0) == given.at(Slot::EM, 1)))
      warn_band(program, name, std::string("EM") + direction_text(d), fabric.tensile[d].max_strain,
                extension_band(), {}, true, w, given.place(Slot::EM, d));
  }
  if (given.at(Slot::G, 0))
    warn_band(program, name, "G", fabric.shear_rigidity, shear_band(w), kShearRigidity, false, w,
              given.place(Slot::G, 0));
  if (given.at(Slot::T, 0))
    warn_band(program, name, "T", fabric.thickness, thickness_band(w), kLength, false, w,
              given.place(Slot::T, 0));
}

void check_pattern(Program& program, const std::string& path, Span span) {
  constexpr std::uint64_t kMaxPicture = 64u << 20;
  const std::string file = readable_path(program, path, span);
  const bool picture = path.ends_with(".png") || path.ends_with(".jpg") || path.ends_with(".jpeg");
  if (!picture)
    fail(program,
         Message("G1133", "`" + path + "` is no picture by its name", span).help("a .png or .jpg file"));
  const std::string& folder = program.options.script_dir;
  const HostResult<std::string> bytes =
      program.host.read_file(folder.empty() || file[0] == '/' ? file : folder + '/' + file, kMaxPicture);
  if (!bytes)
    fail(program, Message("G1133", "the picture `" + path + "` cannot be read: " + bytes.error.message, span)
                      .help("put the file beside the script"));
}

void note_unused(Program& program, const Given& given) {
  constexpr std::pair<Slot, const char*> kUnused[] = {{Slot::RT, "`RT`"},
                                                      {Slot::HG, "`two_HG`"},
                                                      {Slot::HG5, "`two_HG5`"},
                                                      {Slot::HB, "`two_HB`"}};
  std::vector<std::string> names;
  std::vector<Span> places;
  for (const auto& [slot, name] : kUnused)
    for (std::size_t d = 0; d < 2; ++d) {
      if (!given.at(slot, d) || program.in_library(given.place(slot, d))) continue;
      if (names.empty() || names.back() != name) names.emplace_back(name);
      if (std::find(places.begin(), places.end(), given.place(slot, d)) == places.end())
        places.push_back(given.place(slot, d));
    }
  const bool told = std::any_of(program.diagnostics.begin(), program.diagnostics.end(),
                                [](const Diagnostic& d) { return d.code == "G0461"; });
  if (names.empty() || told) return;  // of the first fabric: it is alike for all
  Message message("G0461", enumerated(names) + (names.size() == 1 ? " is" : " are") +
                               " kept with the fabric; a drape to rest uses " +
                               (names.size() == 1 ? "it" : "them") + " only with `hysteresis on`",
                  places[0]);
  for (std::size_t k = 1; k < places.size(); ++k) message.also(places[k], "");
  message.diagnostic.severity = Severity::note;
  report(program, message.help("nothing is to be done: cloth springs back without loss, but in rigs (`solver quasi_static`)"));
}

}  // namespace garment::interpreter
