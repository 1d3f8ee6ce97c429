// change_point_cases.cpp — rods barely longer than the crank, links of equal length, offsets at their limit.
#include <numbers>
#include <utility>

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

// --- through change points: φ(t) by ½ I_r ω² = T₀ with I_r(φ) in closed form, two turns and a bit ---

template <class Inertia>
HardCase through(const std::string& name, const std::string& parameter, const std::string& keys, const Inertia& inertia,
                 const std::string& component) {
  const long double end = begin + 4 * pi + 0.5L, energy = 0.5L * inertia(begin) * turning * turning;
  const auto time = [&](long double phi) { return std::sqrt(inertia(phi) / (2 * energy)); };
  const auto until = static_cast<double>(simpson(time, begin, end, 20000));
  const auto speed = static_cast<double>(std::sqrt(2 * energy / inertia(end)));
  const std::string scene = fmt::format(
      "line = [\"{0}\"]\n{0} = {{ {1} }}\nrun = {{ start = {{ angle = {2}, speed = {3} }}, until = {4} }}\n", component,
      keys, quantity(begin, "rad"), quantity(turning, "rad/s"), quantity(until, "s"));
  return {.family = family,
          .name = name,
          .parameter = parameter,
          .scene = scene,
          .truths = {closed_form(
              "½ I ω² = T₀, t = ∫dφ/ω through the change point",
              {{"final_angle." + component, static_cast<double>(end)}, {"final_speed." + component, speed}})}};
}

// Rod = crank, a thin rod of 2 kg with its centre of mass 0.06 m from the crank pin: β = −φ, or β = φ + π.
HardCase equal_links(bool follows) {
  const Crank crank{.rod = 0.1};
  const std::string keys = crank.keys() + fmt::format(", rod_mass = \"2 kg\", rod_com = \"60 mm\", branch = \"{}\"",
                                                      follows ? "follows" : "folds");
  const auto inertia = [=](long double phi) -> long double {
    const long double s = std::sin(phi), c = std::cos(phi);
    if (!follows) return crank.inertia + 2 * 0.04L * 0.04L;
    return crank.inertia + 2 * (0.16L * 0.16L * s * s + 0.04L * 0.04L * c * c) + crank.mass * 0.04L * s * s;
  };
  return through(follows ? "EqualLinksFollow" : "EqualLinksFold", "l = r", keys, inertia, "crank");
}

// e = l − r: cos β changes its sign with sin(φ/2 + π/4), two turns are the cycle.
HardCase offset_at_limit() {
  const Crank crank{.rod = 0.3, .offset = 0.2};
  const auto inertia = [=](long double phi) {
    const long double half = phi / 2 + std::numbers::pi_v<long double> / 4, k = std::cos(half);
    const long double rod_rate = -std::sqrt(0.1L) * k / std::sqrt(0.2L + 0.1L * k * k);
    const long double slope = -0.1L * std::sin(phi) - (0.2L - 0.1L * std::sin(phi)) * rod_rate;
    return crank.inertia + crank.mass * slope * slope;
  };
  return through("AnOffsetAtItsLimitTakesTwoTurns", "e = l − r", crank.keys(), inertia, "crank");
}

std::string bars(double crank, double coupler, double rocker, double ground, const std::string& branch) {
  return fmt::format(
      "kind = \"four-bar\", crank = {}, coupler = {}, rocker = {}, ground = {}, crank_inertia = \"0.5 kg*m2\", "
      "rocker_inertia = \"0.4 kg*m2\", branch = \"{}\"",
      quantity(crank, "m"), quantity(coupler, "m"), quantity(rocker, "m"), quantity(ground, "m"), branch);
}

// Opposite links equal. Parallelogram: ψ = φ. Crossed: of the symmetric trapezium that the two long links are the
// diagonals of, tan(ψ/2) = −((d + a)/(d − a)) tan(φ/2).
HardCase parallel_crank(bool crossed) {
  const auto inertia = [=](long double phi) -> long double {
    const long double q = (0.3L + 0.1L) / (0.3L - 0.1L), c = std::cos(phi / 2), s = std::sin(phi / 2);
    const long double rate = crossed ? -q / (c * c + q * q * s * s) : 1;
    return 0.5L + 0.4L * rate * rate;
  };
  return through(crossed ? "AntiparallelogramGoesOn" : "ParallelogramGoesOn", "opposite links equal",
                 bars(0.1, 0.3, 0.1, 0.3, crossed ? "crossed" : "open"), inertia, "bars");
}

// Crank = ground, coupler = rocker: B stands at ρ = a cos(φ/2) + √(b² − a² sin²(φ/2)) on the ray of half the angle.
HardCase kite() {
  const auto psi = [](long double phi) {
    const long double s = 0.1L * std::sin(phi / 2), rho = 0.1L * std::cos(phi / 2) + std::sqrt(0.0625L - s * s);
    return std::pair{rho * std::cos(phi / 2) - 0.1L, rho * std::sin(phi / 2)};
  };
  const auto inertia = [=](long double phi) {
    const long double h = 1e-3L, c = 0.25L * 0.25L;  // ψ′ c² = x y′ − y x′
    const auto [x, y] = psi(phi);
    const auto slope = [&](auto&& of) {
      return (of(-3) * -1 + of(-2) * 9 - of(-1) * 45 + of(1) * 45 - of(2) * 9 + of(3)) / (60 * h);
    };
    const long double x1 = slope([&](int k) { return psi(phi + k * h).first; });
    const long double y1 = slope([&](int k) { return psi(phi + k * h).second; });
    const long double rate = (x * y1 - y * x1) / c;
    return 0.5L + 0.4L * rate * rate;
  };
  return through("KiteTakesTwoTurns", "crank = ground, coupler = rocker", bars(0.1, 0.25, 0.25, 0.1, "open"), inertia,
                 "bars");
}

// It rocks: driven on it comes to the end of its arc.
HardCase ends_reported(const std::string& name, const std::string& parameter, const Crank& crank) {
  return {.family = family,
          .name = name,
          .parameter = parameter,
          .scene = scene_of(crank, 1),
          .refusal = {"comes to the end of its arc", "let a load, a spring or a brake reverse it before"}};
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
  for (const bool follows : {true, false}) cases.push_back(equal_links(follows));
  cases.push_back(offset_at_limit());
  for (const bool crossed : {false, true}) cases.push_back(parallel_crank(crossed));
  cases.push_back(kite());
  cases.push_back(ends_reported("ARodShorterThanTheCrankEndsAtItsArcTold", "l = 0.999 r", Crank{.rod = 0.0999}));
  return cases;
}

}  // namespace kurbel::hard
