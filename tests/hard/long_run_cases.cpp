// long_run_cases.cpp — undamped machines over very many cycles, angles after 1e7 rad. A million cycles are in the
// bench's growth of errors.
#include <numbers>

#include "tests/hard/families.h"
#include "tests/hard/linear_chain.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "LongRun";
constexpr double turning = 30;  // ω at the start [rad/s]
constexpr long double turn = 2 * std::numbers::pi_v<long double>;
const Crank crank{.inertia = 0.55};

// ∫√I_r dφ; of a full turn by the trapezoidal rule, which is exact for what is periodic and smooth.
long double action(long double a, long double b) {
  return simpson([](long double phi) { return std::sqrt(crank.reduced_inertia(phi)); }, a, b, 4000);
}

HardCase free_crank(const std::string& name, double start, long double remainder, double turns) {
  const long double beyond = 1, energy = 0.5L * crank.reduced_inertia(remainder) * turning * turning;
  const long double per_turn = action(remainder, remainder + turn);
  const auto until =
      static_cast<double>((turns * per_turn + action(remainder, remainder + beyond)) / std::sqrt(2 * energy));
  const auto end = static_cast<double>(static_cast<long double>(start) + turns * turn + beyond);
  const auto speed = static_cast<double>(std::sqrt(2 * energy / crank.reduced_inertia(remainder + beyond)));
  return {
      .family = family,
      .name = name,
      .parameter = fmt::format("{:g} turns from {:g} rad", turns, start),
      .scene = fmt::format("line = [\"crank\"]\ncrank = {{ {} }}\nrun = {{ start = {{ angle = {}, speed = {} }}, until "
                           "= {} }}\n",
                           crank.keys(), quantity(start, "rad"), quantity(turning, "rad/s"), quantity(until, "s")),
      .truths = {closed_form("½ I ω² = T₀, and t = ∫dφ/ω over whole turns and the rest",
                             {{"final_angle.crank", end}, {"final_speed.crank", speed}})},
      .condition = std::max(1.0, end),
      .condition_words = "the last digit of the angle, and of the time at the speed it moves with"};
}

// Two inertias that vibrate against each other, the step M on one; undamped.
HardCase chain(const std::string& name, double cycles) {
  const double k = 4e4, torque = 20, omega = std::sqrt(k * 1.5), until = (cycles + 0.1) * 2 * pi / omega;
  const LinearChain two{.inertia = {1, 2}, .stiffness = {k}, .damping = {0}, .torque = torque};
  const auto swing = static_cast<double>(torque / 3 / omega * std::sin(static_cast<long double>(omega) * until));
  return {.family = family,
          .name = name,
          .parameter = fmt::format("{:g} cycles", cycles),
          .scene = two.scene(until),
          .truths = {closed_form("ω = M t/ΣJ ± M J₂/(J₁ ΣJ) sin(ω t)/ω; peak 2 M J₂/ΣJ",
                                 {{"final_speed.j0", torque * until / 3 + 2 * swing},
                                  {"final_speed.j1", torque * until / 3 - swing},
                                  {"peak_spring_torque.k0", 2 * torque * 2 / 3}})},
          .condition = std::max(1.0, 2 * pi * cycles),
          .condition_words = "the phase ω t of the last digit of t"};
}

}  // namespace

HardCase free_crank_over(double turns) {
  return free_crank(fmt::format("FreeCrankOver{:.0f}Turns", turns), 0, 0, turns);
}

HardCase undamped_chain_over(double cycles) {
  return chain(fmt::format("UndampedChainOver{:.0f}Cycles", cycles), cycles);
}

std::vector<HardCase> long_run_cases() {
  std::vector<HardCase> cases;
  const auto shortened = [](HardCase c, const std::vector<const char*>& methods, const HardCase& by) {
    for (const char* method : methods) c.variants[method] = std::make_shared<HardCase>(by);
    return c;
  };
  const HardCase ten = free_crank("FreeCrankOverTenTurns", 0, 0, 10);
  const HardCase ten_cycles = chain("UndampedChainOverTenCycles", 10);
  HardCase multibody = free_crank("", 0, 0, 1);
  cases.push_back(shortened(ten, {"multibody"}, multibody));
  cases.push_back(shortened(free_crank("FreeCrankOverAThousandTurns", 0, 0, 1e3),
                            {"esdirk3", "esdirk", "esdirk5", "bdf", "adams"}, ten));
  cases.push_back(shortened(free_crank("FreeCrankOverTenThousandTurns", 0, 0, 1e4),
                            {"esdirk3", "esdirk", "esdirk5", "bdf", "adams", "dopri5", "verner6"}, ten));
  cases.push_back(ten_cycles);
  cases.push_back(shortened(chain("UndampedChainOverAThousandCycles", 1e3),
                            {"esdirk3", "esdirk", "esdirk5", "bdf", "adams"}, ten_cycles));
  cases.push_back(shortened(chain("UndampedChainOverTenThousandCycles", 1e4),
                            {"esdirk3", "esdirk", "esdirk5", "bdf", "adams", "dopri5", "verner6"}, ten_cycles));
  for (const double start : {1e4, 1e7, -1e7}) {
    const long double remainder = std::fmod(static_cast<long double>(start), turn);
    cases.push_back(
        free_crank(fmt::format("FreeCrankFrom{}1e{:.0f}Rad", start < 0 ? "Minus" : "", std::log10(std::abs(start))),
                   start, remainder, 10));
  }
  for (HardCase& c : cases) c.heavy = c.parameter.starts_with("1000 ") || c.parameter.starts_with("10000 ");
  // What auto and the work equation need for all accuracies of ten thousand turns.
  for (HardCase& c : cases)
    if (c.parameter.starts_with("10000 ")) c.budget = 20;
  return cases;
}

}  // namespace kurbel::hard
