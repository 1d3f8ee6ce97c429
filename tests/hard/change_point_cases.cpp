// change_point_cases.cpp — rods barely longer than the crank, links of equal length, offsets at their limit.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "ChangePoint";
constexpr double turning = 10;  // ω at φ = 0.3 [rad/s]
constexpr double begin = 0.3;

// ∫√I_r dφ from a to b. Near φ = ±π/2 the rod stands across the stroke, within δ = √(2 (l − r − |e|)/r) of it I_r
// leaps: φ = c + δ sinh v follows it.
long double action(const Crank& crank, long double a, long double b) {
  const long double margin = crank.rod - crank.radius - std::abs(crank.offset);
  const long double width = std::sqrt(2 * margin / crank.radius);
  long double sum = 0;
  for (long double cell = std::floor(a / pi); cell * pi < b; ++cell) {
    const long double centre = (cell + 0.5L) * pi;
    const auto integrand = [&](long double v) {
      return std::sqrt(crank.reduced_inertia(centre + width * std::sinh(v))) * width * std::cosh(v);
    };
    const auto place = [&](long double phi) { return std::asinh((phi - centre) / width); };
    sum += simpson(integrand, place(std::max(a, cell * pi)), place(std::min(b, (cell + 1) * pi)), 4000);
  }
  return sum;
}

std::string scene_of(const Crank& crank, double until, const std::string& more = "") {
  return fmt::format(
      "line = [\"crank\"]\ncrank = {{ {} }}\n{}run = {{ start = {{ angle = {}, speed = {} }}, until = {} }}\n",
      crank.keys(), more, quantity(begin, "rad"), quantity(turning, "rad/s"), quantity(until, "s"));
}

// A free crank: ½ I_r ω² = T₀, t = ∫√(I_r/(2 T₀)) dφ.
HardCase free_crank(const std::string& name, const std::string& parameter, const Crank& crank, double turns) {
  const auto part = [&](double end, double& until) {
    const long double energy = 0.5L * crank.reduced_inertia(begin) * turning * turning;
    until = static_cast<double>(action(crank, begin, end) / std::sqrt(2 * energy));
    const auto speed = static_cast<double>(std::sqrt(2 * energy / crank.reduced_inertia(end)));
    return closed_form("½ I ω² = T₀, and t = ∫dφ/ω", {{"final_angle.crank", end}, {"final_speed.crank", speed}});
  };
  double until = 0;
  const Truth truth = part(2 * pi * turns + 1, until);
  return {.family = family, .name = name, .parameter = parameter, .scene = scene_of(crank, until), .truths = {truth}};
}

HardCase rod_over_crank(double excess) {
  Crank crank;
  crank.rod = crank.radius * (1 + excess);
  HardCase c = free_crank(fmt::format("FreeCrankWithItsRodLongerBy{:.0f}Ppm", 1e6 * excess),
                          fmt::format("l/r = 1 + {:.0e}", excess), crank, 5);
  if (excess > 1e-2) c.variants["multibody"] = std::make_shared<HardCase>(free_crank("", c.parameter, crank, 0));
  return c;
}

HardCase offset_near_limit(double margin) {
  Crank crank;
  crank.offset = crank.rod - crank.radius * (1 + margin);
  return free_crank(fmt::format("FreeCrankWithItsOffset{:.0f}PpmBelowTheLimit", 1e6 * margin),
                    fmt::format("e = l − r (1 + {:.0e})", margin), crank, 5);
}

// A driven one, whose slider meets resistance where it leaps.
HardCase driven(double excess) {
  Crank crank;
  crank.rod = crank.radius * (1 + excess);
  const std::string scene = fmt::format(
      "line = [\"motor\", \"crank\"]\nmotor = {{ kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = "
      "\"20 "
      "rad/s\", inertia = \"0.1 kg*m2\" }}\ncrank = {{ {}, load = {{ kind = \"medium\", viscous = \"100 N*s/m\" }} "
      "}}\nrun = {{ "
      "start = {{ angle = \"0.3 rad\", speed = \"10 rad/s\" }}, until = \"2 s\" }}\n",
      crank.keys());
  return {.family = family,
          .name = fmt::format("DrivenCrankWithItsRodLongerBy{:.0f}Ppm", 1e6 * excess),
          .parameter = fmt::format("l/r = 1 + {:.0e}", excess),
          .scene = scene,
          .truths = {converged(scene, {"final_angle.crank", "final_speed.crank", "work.useful"})}};
}

HardCase refused(const std::string& name, const std::string& parameter, const Crank& crank) {
  return {.family = family,
          .name = name,
          .parameter = parameter,
          .scene = scene_of(crank, 1),
          .refusal = {"else the crank cannot turn fully", "lengthen the rod or shorten the crank"}};
}

std::string four_bar(double crank, double coupler, double rocker, double ground) {
  return fmt::format(
      "line = [\"bars\"]\nbars = {{ kind = \"four-bar\", crank = {}, coupler = {}, rocker = {}, ground = {}, "
      "crank_inertia "
      "= \"0.5 kg*m2\", rocker_inertia = \"0.4 kg*m2\", rocker_mass = \"2 kg\" }}\nrun = {{ start = {{ angle = \"1 "
      "rad\", "
      "speed = \"10 rad/s\" }}, until = \"3 s\" }}\n",
      quantity(crank, "m"), quantity(coupler, "m"), quantity(rocker, "m"), quantity(ground, "m"));
}

// crank + ground = coupler + rocker − margin: at φ = π all links fall nearly into one line.
HardCase four_bar_near_change(double margin) {
  const std::string scene = four_bar(0.1, 0.25, 0.2, 0.35 * (1 - margin));
  return {.family = family,
          .name = fmt::format("FourBar{:.0f}PpmBesideItsChangePoint", 1e6 * margin),
          .parameter = fmt::format("crank + ground = coupler + rocker − {:.0e} ground", margin),
          .scene = scene,
          .truths = {converged(scene, {"final_angle.bars", "final_speed.bars"})}};
}

}  // namespace

std::vector<HardCase> change_point_cases() {
  std::vector<HardCase> cases;
  for (const double excess : {5e-2, 1e-3, 1e-4, 1e-5}) cases.push_back(rod_over_crank(excess));
  for (const double margin : {1e-2, 1e-4}) cases.push_back(offset_near_limit(margin));
  for (const double excess : {1e-2, 1e-4}) cases.push_back(driven(excess));
  for (const double margin : {1e-2, 1e-4}) cases.push_back(four_bar_near_change(margin));
  cases.push_back(refused("EqualLinksAreRefused", "l = r", Crank{.rod = 0.1}));
  cases.push_back(refused("ARodShorterThanTheCrankIsRefused", "l = 0.999 r", Crank{.rod = 0.0999}));
  cases.push_back(refused("AnOffsetAtItsLimitIsRefused", "e = l − r", Crank{.rod = 0.3, .offset = 0.2}));
  cases.push_back({.family = family,
                   .name = "EqualLinksOfAFourBarAreRefused",
                   .parameter = "parallel crank: opposite links equal",
                   .scene = four_bar(0.1, 0.3, 0.1, 0.3),
                   .refusal = {"all links fall into one line"}});
  return cases;
}

}  // namespace kurbel::hard
