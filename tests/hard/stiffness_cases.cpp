// stiffness_cases.cpp — stiffness and inertia ratios over many decades, almost massless and massless shafts.
#include "tests/hard/families.h"
#include "tests/hard/linear_chain.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Stiffness";

// c for a damping ratio ζ of two inertias joined by k alone.
double damping(double ratio, double stiffness, double a, double b) {
  return 2 * ratio * std::sqrt(stiffness * (a > 0 && b > 0 ? a * b / (a + b) : a + b));
}

HardCase chain_case(const std::string& name, const std::string& parameter, const LinearChain& chain, double until) {
  const LinearChain::Motion end = chain.at(until);
  std::vector<Known> known;
  for (std::size_t i = 0; i < end.speed.size(); ++i) {
    const std::string speed =
        fmt::format("final_speed.j{}", i);  // that of the driven one by itself: some runs are short
    known.push_back(i == 0 ? by_its_size(speed, end.speed[i]) : Known{speed, end.speed[i]});
    known.push_back({fmt::format("final_angle.j{}", i), end.angle[i]});
  }
  return {.family = family,
          .name = name,
          .parameter = parameter,
          .scene = chain.scene(until),
          .truths = {closed_form("exp(A t) in long double", std::move(known))}};
}

// Three equal inertias on a soft and a stiff coupling.
HardCase stiffness_ratio(int decades) {
  const double soft = 100, stiff = soft * std::pow(10.0, decades);
  const LinearChain chain{.inertia = {1, 1, 1},
                          .stiffness = {soft, stiff},
                          .damping = {damping(0.02, soft, 1, 1), damping(0.02, stiff, 1, 1)},
                          .torque = 10};
  return chain_case(fmt::format("StiffnessesOneTo1e{:02d}", decades), fmt::format("k ratio 1e{}", decades), chain,
                    decades < 8 ? 0.3 : 0.01);
}

// A light inertia between two others, or a heavy one.
HardCase inertia_ratio(int decades) {
  const double middle = std::pow(10.0, decades), k = 1000;
  const LinearChain chain{.inertia = {1, middle, 1},
                          .stiffness = {k, k},
                          .damping = {damping(0.02, k, 1, middle), damping(0.02, k, middle, 1)},
                          .torque = 10};
  return chain_case(fmt::format("Inertias{}OneTo1e{:02d}", decades < 0 ? "Light" : "Heavy", std::abs(decades)),
                    fmt::format("J ratio 1e{}", decades), chain, decades > -6 ? 0.1 : 0.003);
}

// 1e-12 kg·m² between two dampers: its own motion dies within 1e-12 s and leaves the balance of the torques, as of a
// massless shaft, up to J/(c T) = 1e-12.
HardCase almost_massless() {
  LinearChain chain{.inertia = {1, 0, 1}, .stiffness = {1000, 3000}, .damping = {1, 1}, .torque = 20};
  HardCase c = chain_case("AlmostMasslessShaftBetweenDampers", "J = 1e-12 kg·m², c = 1 N·m·s/rad", chain, 0.5);
  chain.inertia[1] = 1e-12;
  c.scene = chain.scene(0.5);
  const std::string reason =
      "explicit: stability holds its steps at 3e-12 s, 1e11 of them for this run; auto changes to esdirk after 200";
  for (const char* method : {"dopri5", "verner6", "dop853", "fehlberg8"}) c.excluded[method] = reason;
  c.excluded["adams"] =
      "iterates by fixed points, which hold its steps as stability does the explicit methods': 1e-12 s";
  return c;
}

HardCase massless() {
  const LinearChain chain{.inertia = {1, 0, 1}, .stiffness = {1000, 3000}, .damping = {1, 1}, .torque = 20};
  return {.family = family,
          .name = "AMasslessShaftBetweenCouplingsIsRefused",
          .parameter = "J = 0",
          .scene = chain.scene(0.5),
          .refusal = {"has no inertia", "its motion is undefined"}};
}

// With the couplings rigid the massless shaft merges into its neighbours.
HardCase massless_merged() {
  const LinearChain chain{.inertia = {1, 0, 1}, .stiffness = {1000, 3000}, .damping = {1, 1}, .torque = 20};
  return {.family = family,
          .name = "AMasslessShaftOnARigidCouplingIsMerged",
          .parameter = "J = 0",
          .scene = chain.scene(0.5),
          .effects = "none",
          .truths = {closed_form("ω = M t/ΣJ", {{"final_speed.j1", 5}, {"final_angle.j1", 1.25}})}};
}

}  // namespace

std::vector<HardCase> stiffness_cases() {
  std::vector<HardCase> cases;
  for (const int decades : {0, 2, 4, 6, 8, 10}) cases.push_back(stiffness_ratio(decades));
  for (const int decades : {-3, -6, -9, 3, 6, 9}) cases.push_back(inertia_ratio(decades));
  const LinearChain chain{.inertia = {1, 1e-12, 1},
                          .stiffness = {1000, 3000},
                          .damping = {damping(0.02, 1000, 1, 1e-12), damping(0.02, 3000, 1e-12, 1)},
                          .torque = 20};
  cases.push_back(chain_case("AlmostMasslessShaftThatRings", "J = 1e-12 kg·m², ζ = 0.02", chain, 3e-5));
  cases.push_back(almost_massless());
  cases.push_back(massless());
  cases.push_back(massless_merged());
  return cases;
}

}  // namespace kurbel::hard
