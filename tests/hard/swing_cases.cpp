// swing_cases.cpp — pendulums let go near the top, where the period grows without bound; by their elliptic integral.
//     T = 4 √(J/(m g l)) K(sin θ₀/2),   K(k) = π/(2 agm(1, √(1 − k²)))
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Swing";
constexpr double mass = 1, distance = 2, inertia = 4.1, gravity = 9.80665;  // tests/cases/mb05_adams_pendulum.toml

long double quarter_period(long double amplitude) {
  long double a = 1, b = std::cos(amplitude / 2);
  for (int i = 0; i < 40; ++i) {
    const long double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::sqrt(inertia / (static_cast<long double>(mass) * gravity * distance)) * std::numbers::pi_v<long double> /
         (2 * a);
}

// As a crank that turns, with a slider of no mass; or one that rocks, within ±143.3 deg.
std::string keys(bool rocks) {
  const std::string linkage =
      rocks ? "kind = \"four-bar\", crank = \"3 m\", coupler = \"10 m\", rocker = \"7.5 m\", ground = \"15 m\", "
              "ground_angle = \"-90 deg\""
            : "kind = \"slider-crank\", radius = \"1 m\", rod = \"3 m\", stroke_angle = \"-90 deg\"";
  return fmt::format("{}, crank_mass = {}, crank_com = {}, crank_inertia = {}, gravity = {}", linkage,
                     quantity(mass, "kg"), quantity(distance, "m"), quantity(inertia, "kg*m2"),
                     quantity(gravity, "m/s2"));
}

HardCase let_go(double degrees, bool rocks, bool whole) {
  const double amplitude = degrees * pi / 180, half = std::sin(amplitude / 2);
  const long double quarter = quarter_period(amplitude);
  const double fastest = 2 * std::sqrt(mass * gravity * distance / inertia) * half;
  // How far a change of the start moves what is read at the bottom: dT/dθ₀ times the speed.
  const double slope = static_cast<double>((quarter_period(amplitude) - quarter_period(amplitude - 1e-6L)) / 1e-6L);
  HardCase c{.family = family,
             .name = fmt::format("{}CrankLetGoAt{}DegreesHasThePeriodOfItsEllipticIntegral{}",
                                 rocks ? "Rocking" : "Turning", static_cast<int>(degrees), whole ? "AndComesBack" : ""),
             .parameter = fmt::format("θ₀ = {}°", degrees),
             .scene = fmt::format(
                 "line = [\"bob\"]\nbob = {{ {} }}\nrun = {{ start = {{ angle = {} }}, until = {} }}\n", keys(rocks),
                 quantity(amplitude, "rad"), quantity(static_cast<double>((whole ? 4 : 1) * quarter), "s")),
             .condition = std::max(10.0, (whole ? 4 : 1) * slope * fastest * amplitude)};
  const std::string words = "T/4 = √(J/(m g l)) K(sin θ₀/2)";
  if (whole)
    c.truths = {closed_form(words, {{"final_angle.bob", amplitude, 1}})};
  else
    c.truths = {closed_form(words, {{"final_angle.bob", 0, 1}, {"final_speed.bob", -fastest, 1}})};
  return c;
}

}  // namespace

std::vector<HardCase> swing_cases() {
  std::vector<HardCase> cases;
  for (const double degrees : {90.0, 170.0, 179.9}) cases.push_back(let_go(degrees, false, false));
  cases.push_back(let_go(140, true, false));
  cases.push_back(let_go(140, true, true));
  return cases;
}

}  // namespace kurbel::hard
