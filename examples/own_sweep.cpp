// own_sweep.cpp — a sweep with a function of the caller's: what a coupling of each stiffness costs by a formula of the
// caller's own, and what it must bear. The rows stay in a file; a second call finds them there.
#include <kurbel/kurbel.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

int main() {
  const kurbel::Machine machine = kurbel::Machine::from_text(R"(
title    = "Step torque on two masses"
line     = ["rotor", "coupling", "fan"]
rotor    = { kind = "inertia", inertia = "0.2 kg*m2" }
motor    = { kind = "torque source", torque = "50 N*m", on = "rotor" }
coupling = { kind = "coupling", stiffness = "4 kN*m/rad", damping = "0 N*m*s/rad" }
fan      = { kind = "inertia", inertia = "1.5 kg*m2" }
effects  = { elasticity = true }
run      = { until = "0.3 s" }
)");
  const kurbel::Variation variation{.vary = {"coupling.stiffness=2..10 kN*m/rad"}, .design = "grid:5"};
  const auto row = [&](const std::vector<double>& at) {
    const kurbel::Machine variant = machine.with({{"coupling.stiffness", std::to_string(at[0]) + " kN*m/rad"}});
    const double peak = kurbel::run(variant, {.no_error = true, .page = false}).figures()["peak_torque.coupling"].value;
    return std::vector<double>{peak, 40 + 3 * std::pow(at[0], 1.5)};
  };
  const std::string file = "own_sweep.db";
  std::filesystem::remove(file);
  const kurbel::SweepChoices choices{.into = file, .jobs = 2};
  const std::vector<kurbel::SweepColumn> columns = {{"peak", "N*m"}, {"cost", "EUR"}};
  const kurbel::SweepRows rows = kurbel::sweep(variation, "peak and cost", columns, row, choices);
  const kurbel::SweepRows again = kurbel::sweep(variation, "peak and cost", columns, row, choices);
  // Undamped, a step transmits twice what it would rigidly, whatever the stiffness.
  bool right = rows.complete && rows.computed == 5 && again.computed == 0 && again.lines.size() == 5;
  for (const kurbel::SweepLine& line : rows.lines) {
    std::printf("%4.1f kN·m/rad: %.9g N·m, %.2f EUR\n", line.parameters[0], *line.figures[0], *line.figures[1]);
    right = right && std::abs(*line.figures[0] / (2 * 50 * 1.5 / 1.7) - 1) < 1e-5;
  }
  return right ? 0 : 1;
}
