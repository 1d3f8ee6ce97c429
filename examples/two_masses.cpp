// two_masses.cpp — kurbel from C++: a scene as text, run rigid and elastic, figures by name.
#include <cstdio>

#include "studies/run/compare.h"
#include "studies/scenes/kinds.h"

int main() {
  const kurbel::Scene scene = kurbel::parse_scene(R"(
title = "Step torque on two masses"
line  = ["rotor", "coupling", "fan"]

[rotor]
kind    = "inertia"
inertia = "0.2 kg*m2"

[motor]
kind   = "torque source"
torque = "50 N*m"
on     = "rotor"

[coupling]
kind          = "coupling"
stiffness     = "4 kN*m/rad"
damping_ratio = 0.02

[fan]
kind      = "load"
quadratic = "0.01 N*m*s2/rad2"
inertia   = "1.5 kg*m2"

[run]
until = "1 s"
)",
                                                  "two_masses.toml", kurbel::all_kinds());

  kurbel::Effects rigid, elastic;
  elastic.all_elastic = true;
  const kurbel::Comparison c = kurbel::compare(scene, rigid, "rigid", elastic, "elastic", {});

  std::printf("%s\n", c.conclusion.c_str());
  const kurbel::Figure& peak = *c.b.find("peak_torque.coupling");
  std::printf("peak torque: %.6g ± %.1g N·m at %.4g s\n", peak.value, *peak.error, *peak.at);
  // 50 N·m · 1.5/1.7 would be transmitted rigidly; a step rings to nearly twice that.
  return peak.value > 1.8 * 50 * 1.5 / 1.7 && peak.value < 2 * 50 * 1.5 / 1.7 ? 0 : 1;
}
