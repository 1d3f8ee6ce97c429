// two_masses.cpp — a rotor switched onto a fan through a coupling: the elastic peak beside the rigid torque.
#include <kurbel/kurbel.h>

#include <cstdio>

int main() {
  const kurbel::Machine machine = kurbel::Machine::from_text(R"(
title    = "Step torque on two masses"
line     = ["rotor", "coupling", "fan"]
rotor    = { kind = "inertia", inertia = "0.2 kg*m2" }
motor    = { kind = "torque source", torque = "50 N*m", on = "rotor" }
coupling = { kind = "coupling", stiffness = "4 kN*m/rad", damping_ratio = 0.02 }
fan      = { kind = "load", quadratic = "0.01 N*m*s2/rad2", inertia = "1.5 kg*m2" }
effects  = { elasticity = true }
run      = { until = "1 s" }
)");
  const kurbel::Run run = kurbel::run(machine);
  const kurbel::FigureValue& peak = run.figures()["peak_torque.coupling"];
  std::printf("%s\n", run.study().conclusion().c_str());
  std::printf("peak torque: %.6g ± %.1g %s at %.4g s\n", peak.value, *peak.error, peak.unit.c_str(), *peak.at);
  // 50 N·m · 1.5/1.7 would be transmitted rigidly; a step rings to nearly twice that.
  return peak.value > 1.8 * 50 * 1.5 / 1.7 && peak.value < 2 * 50 * 1.5 / 1.7 ? 0 : 1;
}
