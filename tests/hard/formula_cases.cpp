// formula_cases.cpp — laws by formulas: powers between 1 and 2, hundreds of jumps a turn, pulses of nanoseconds, slopes that
// leap by many decades at a kink.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Formula";

// Two free inertias of 1 kg·m² on a spring τ = k |θ|^(3/2), as of Hertz' contact: a half period takes
// (2√π Γ(7/5)/Γ(9/10)) α/v, α = (5 μ v²/(4k))^(2/5), v the speed of the twist through 0 (Deresiewicz 1968).
HardCase hertz(double v, double k) {
  constexpr long double mu = 0.5L;
  const long double form = 2 * std::sqrt(static_cast<long double>(pi)) * std::tgamma(1.4L) / std::tgamma(0.9L);
  const long double alpha = std::pow(5 * mu * v * v / (4 * static_cast<long double>(k)), 0.4L);
  constexpr int half_swings = 4;
  const auto until = static_cast<double>(half_swings * form * alpha / v);
  const std::string scene = fmt::format(
      "line = [\"j0\", \"a\", \"j1\"]\nj0 = {{ kind = \"flywheel\", inertia = \"1 kg*m2\" }}\n"
      "a = {{ kind = \"progressive coupling\", table = {{ over = \"twist\", formula = "
      "\"k*sign(theta)*abs(theta/(1 rad))^1.5\", range = [\"-3 rad\", \"3 rad\"], with = {{ k = {} }} }} }}\n"
      "j1 = {{ kind = \"flywheel\", inertia = \"1 kg*m2\" }}\neffects = {{ elasticity = true }}\n"
      "run = {{ start = {{ j0 = {{ speed = {} }}, j1 = {{ speed = {} }} }}, until = {} }}\n",
      quantity(k, "N*m"), quantity(v / 2, "rad/s"), quantity(-v / 2, "rad/s"), quantity(until, "s"));
  return {.family = family,
          .name = fmt::format("SpringOfHertzAtASpeedOf1e{}{:.0f}", v < 1 ? "m" : "", std::abs(std::log10(v))),
          .parameter = fmt::format("v = {:g} rad/s, k = {:.0e}", v, k),
          .scene = scene,
          .truths = {closed_form("half swing = 2√π Γ(7/5)/Γ(9/10) (5μv²/4k)^(2/5)/v",
                                 {{"final_speed.j0", v / 2}, {"final_angle.j0", 0, static_cast<double>(alpha)}})}};
}

// ±τ as sin(nφ) changes its sign: ½ J ω² is a straight line in φ from jump to jump, each piece takes 2Δφ/(ω_a + ω_b).
HardCase jumps(int n) {
  constexpr long double torque = 10, inertia = 1, speed = 10;
  const int pieces = 4 * n + 1;  // two turns and a bit; ends within a load of −τ
  long double t = 0, w = speed;
  const long double piece = static_cast<long double>(pi) / n;
  for (int i = 0; i < pieces; ++i) {
    const long double next = std::sqrt(w * w + (i % 2 == 0 ? -2 : 2) * torque / inertia * piece);
    t += 2 * piece / (w + next), w = next;
  }
  // Half of the next piece, so that no jump is met at the very end.
  const long double last = std::sqrt(w * w + torque / inertia * piece);
  t += piece / (w + last);
  const long double angle = piece * (pieces + 0.5L);
  const std::string scene = fmt::format(
      "line = [\"j0\"]\nj0 = {{ kind = \"load\", inertia = \"1 kg*m2\", table = {{ over = \"angle\", formula = "
      "\"if(sin({}*phi) > 0, 10 [N*m], -10 [N*m])\" }} }}\nrun = {{ start = {{ speed = \"10 rad/s\" }}, until = {} "
      "}}\n",
      n, quantity(static_cast<double>(t), "s"));
  return {
      .family = family,
      .name = fmt::format("LoadThatJumps{}TimesATurn", 2 * n),
      .parameter = fmt::format("{} jumps a turn", 2 * n),
      .scene = scene,
      .truths = {closed_form("½ J ω² straight from jump to jump", {{"final_speed.j0", static_cast<double>(last)},
                                                                   {"final_angle.j0", static_cast<double>(angle)}})}};
}

// M exp(−t/T) from t = 0: ω = ω₀ + M T (1 − e^(−t/T))/J; all of it happens in the first part in 1/T of the run.
HardCase pulse(int decades) {
  const double time = std::pow(10.0, -decades);
  const std::string scene = fmt::format(
      "line = [\"j0\"]\nj0 = {{ kind = \"torque source\", inertia = \"1 kg*m2\", table = {{ over = \"time\", formula = "
      "\"M*exp(-t/T)\", range = [\"0 s\", \"1 s\"], with = {{ M = {}, T = {} }} }} }}\n"
      "run = {{ start = {{ speed = \"10 rad/s\" }}, until = \"1 s\" }}\n",
      quantity(1 / time, "N*m"), quantity(time, "s"));
  return {.family = family,
          .name = fmt::format("PulseOf1em{:02d}Seconds", decades),
          .parameter = fmt::format("T = 1e-{} s of a run of 1 s", decades),
          .scene = scene,
          .truths = {closed_form("ω = ω₀ + M T/J", {{"final_speed.j0", 11}, {"final_angle.j0", 11 - time}})}};
}

// Soft up to θ = d, then harder by a factor: two free inertias, half a period within each law, in closed form.
HardCase kink(int decades) {
  const double factor = std::pow(10.0, decades), k = 100, d = 0.01, v = 0.5;
  const long double mu = 0.5L, w1 = std::sqrt(k / mu), w2 = w1 * std::sqrt(static_cast<long double>(factor));
  // To d: θ = (v/w1) sin w1 t; there the speed u. Beyond: θ − d + s = R cos …, s = d/factor, the spring's own rest.
  const long double t1 = std::asin(d * w1 / v) / w1, u = v * std::cos(w1 * t1), s = d / factor;
  const long double t2 = 2 * std::atan2(u, w2 * s) / w2;
  constexpr int swings = 3;  // whole ones, both sides
  const auto until = static_cast<double>(swings * 2 * (2 * t1 + t2));
  const std::string scene = fmt::format(
      "line = [\"j0\", \"a\", \"j1\"]\nj0 = {{ kind = \"flywheel\", inertia = \"1 kg*m2\" }}\n"
      "a = {{ kind = \"progressive coupling\", table = {{ over = \"twist\", formula = "
      "\"sign(theta)*(k*min(abs(theta), d) + n*k*max(abs(theta) - d, 0))\", range = [\"-1 rad\", \"1 rad\"], with = {{ "
      "k = "
      "{}, d = {}, n = {:.17g} }} }} }}\nj1 = {{ kind = \"flywheel\", inertia = \"1 kg*m2\" }}\n"
      "effects = {{ elasticity = true }}\n"
      "run = {{ start = {{ j0 = {{ speed = {} }}, j1 = {{ speed = {} }} }}, until = {} }}\n",
      quantity(k, "N*m/rad"), quantity(d, "rad"), factor, quantity(v / 2, "rad/s"), quantity(-v / 2, "rad/s"),
      quantity(until, "s"));
  return {.family = family,
          .name = fmt::format("SpringThatHardensByAFactorOf1e{:02d}", decades),
          .parameter = fmt::format("slopes 1 : 1e{}", decades),
          .scene = scene,
          .truths = {closed_form("sines joined at the kink", {{"final_speed.j0", v / 2}, {"final_angle.j0", 0, d}})}};
}

}  // namespace

std::vector<HardCase> formula_cases() {
  std::vector<HardCase> cases;
  for (const double v : {10.0, 1e-3}) cases.push_back(hertz(v, 1e5));
  for (const int n : {10, 200}) cases.push_back(jumps(n));
  for (const int decades : {3, 6, 9}) cases.push_back(pulse(decades));
  for (const int decades : {2, 6}) cases.push_back(kink(decades));
  return cases;
}

}  // namespace kurbel::hard
