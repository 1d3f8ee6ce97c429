// simbody_loops.h — R1 in Simbody's bodies with the other closure: the slider a body of its own, pinned to the rod.
#pragma once

#include <string>

namespace kurbel::bench {

struct SimbodyEnd {
  double phi = 0;
  long steps = 0;
};
// integrator: RungeKuttaMerson, RungeKuttaFeldberg or CPodes.
SimbodyEnd simbody_r1_with_slider(const std::string& integrator, double accuracy);

}  // namespace kurbel::bench
