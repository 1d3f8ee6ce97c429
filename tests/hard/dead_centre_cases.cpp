// dead_centre_cases.cpp — starts from rest on and beside the dead centres, with and without static friction.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "DeadCentre";
const Crank crank;

std::string crank_scene(const std::string& more, const std::string& load, double angle, double until,
                        const std::string& line = "\"crank\"") {
  return fmt::format("line = [{}]\ncrank = {{ {}{} }}\n{}run = {{ start = {{ angle = {} }}, until = {} }}\n", line,
                     crank.keys(), load.empty() ? "" : ", load = " + load, more, quantity(angle, "rad"),
                     quantity(until, "s"));
}

// --- beside the folded dead centre, where a force towards the extended end drives away from it ---
//     ½ I_r ω² = F (x(φ) − x(φ₀)), φ = π + ε cosh u: du/dt = √(2 F (x − x₀)/I_r)/(ε sinh u), regular from u = 0 on.
constexpr double force = 400;

long double gained(long double away, long double start) {  // x(π + away) − x(π + start), without cancellation
  const long double s = std::sin(0.5L * (away + start)), d = std::sin(0.5L * (away - start));
  const long double cosines = 2 * s * d;                                     // cos(start) − cos(away)
  const long double squares = cosines * (std::cos(start) + std::cos(away));  // sin² away − sin² start
  const long double roots = crank.root(away) + crank.root(start);
  return crank.radius * cosines - crank.radius * crank.radius * squares / roots;
}

struct Motion {
  double angle, speed;
};

Motion away_from_folded(double start, double t) {
  const long double e = start;
  const auto away = [&](long double u) { return e * std::cosh(u); };
  const auto speed = [&](long double u) {
    return std::sqrt(2 * force * gained(away(u), e) / crank.reduced_inertia(pi + away(u)));
  };
  const auto rate = [&](long double u) {
    if (u < 1e-6L) {
      const long double curvature = crank.radius - static_cast<long double>(crank.radius) * crank.radius / crank.rod;
      return std::sqrt(force * curvature / crank.inertia);
    }
    return speed(u) / (e * std::sinh(u));
  };
  const long double u = integrate_scalar(rate, 0.0L, static_cast<long double>(t), 20000);
  return {static_cast<double>(pi + away(u)), static_cast<double>(speed(u))};
}

HardCase beside_folded(double off) {
  const double until = 0.35 + 0.13 * std::log(0.1 / off);
  const auto at = [&](double t) {
    const Motion m = away_from_folded(off, t);
    return closed_form("½ I ω² = F Δx, and t = ∫dφ/ω with φ = π + ε cosh u",
                       {{"final_angle.crank", m.angle}, {"final_speed.crank", m.speed, 30}});
  };
  const auto scene = [&](double t) {
    return crank_scene("", fmt::format("{{ kind = \"constant\", force = {} }}", quantity(force, "N")), pi + off, t);
  };
  HardCase c{.family = family,
             .name = fmt::format("LeavesTheFoldedEndByItsForceFrom{:.0f}Digits", -std::log10(off)),
             .parameter = fmt::format("{:.0e} rad beside the dead centre", off),
             .scene = scene(until),
             .truths = {at(until)}};
  const Motion m = away_from_folded(off, until), shifted = away_from_folded(off * (1 + 1e-6), until);
  c.condition = pi * std::abs(shifted.angle - m.angle) / (1e-6 * off);
  c.condition_words = "the start angle π + ε holds its last digit only: ∂φ(T)/∂ε, measured on the closed form";
  return c;
}

}  // namespace

std::vector<HardCase> dead_centre_cases() {
  std::vector<HardCase> cases;
  for (const double off : {1e-2, 1e-5, 1e-9}) cases.push_back(beside_folded(off));
  return cases;
}

}  // namespace kurbel::hard
