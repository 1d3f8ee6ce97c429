// own_coupling.cpp — an element of one's own, without a change to kurbel: a coupling whose spring hardens with the cube of
// its twist. Two equal masses on it, twisted by A and let go, swing as Duffing's oscillator: from rest to rest in half of
//     T = 4 ∫₀^{π/2} dψ/√(ω₀² + ½ ε A² (1 + sin² ψ)),   ω₀² = k/J_red, ε = κ/J_red
// (energy ½ θ̇² + ½ ω₀² θ² + ¼ ε θ⁴ is constant, θ = A sin ψ), here by the midpoint rule, which is exact for periodic
// integrands but for rounding.
#include <kurbel/kurbel.h>

#include <cmath>
#include <cstdio>

int main() {
  kurbel::add_coupling(
      "cubic coupling", "spring that hardens: τ = k θ + κ θ³ + c θ̇",
      {{"stiffness", "N*m/rad", {}, "k"},
       {"cubic", "N*m/rad3", {}, "κ"},
       {"damping", "N*m*s/rad", "\"0 N*m*s/rad\"", "c"}},
      [](const kurbel::Parameters& p) {
        return kurbel::coupling_law([k = p["stiffness"], q = p["cubic"], c = p["damping"]](auto twist, auto rate) {
          return k * twist + q * twist * twist * twist + c * rate;
        });
      });
  const double k = 100, q = 4e4, inertia = 0.5, amplitude = 0.05;  // J_red of two masses of 1 kg·m²
  const kurbel::Machine machine = kurbel::Machine::from_text(R"(
title   = "Two masses on a hardening spring"
line    = ["left", "spring", "right"]
left    = { kind = "inertia", inertia = "1 kg*m2" }
right   = { kind = "inertia", inertia = "1 kg*m2" }
spring  = { kind = "cubic coupling", stiffness = "100 N*m/rad", cubic = "4e4 N*m/rad3" }
effects = { elasticity = true }
run     = { start = { spring = { twist = "0.05 rad" } }, until = "2 s" }
)");

  const int n = 64;
  double period = 0;
  for (int i = 0; i < n; ++i) {
    const double s = std::sin((i + 0.5) * std::acos(-1.0) / 2 / n);
    period += 4 * std::acos(-1.0) / 2 / n /
              std::sqrt(k / inertia + 0.5 * (q / inertia) * amplitude * amplitude * (1 + s * s));
  }
  // After three periods the spring is where it was let go.
  kurbel::Motion motion(machine, "", 1e-11);
  motion.go_to(3 * period);
  const double torque = motion["torque.spring"], first = k * amplitude + q * std::pow(amplitude, 3);
  const kurbel::Run run = kurbel::run(machine);
  const double peak = std::abs(run.figures()["peak_torque.spring"].value);
  std::printf("period %.9g s; torque after three: %.9g of %.9g N·m, peak %.9g\n%s\n", period, torque, first, peak,
              run.study().conclusion().c_str());
  return run.complete() && std::abs(torque / first - 1) < 1e-7 && std::abs(peak / first - 1) < 1e-6 ? 0 : 1;
}
