// mujoco_crank.h — R1 in MuJoCo, where its library is present.
#pragma once

namespace kurbel::bench {

// φ(10 s) with equal steps [s] of its RK4 at tight settings.
double mujoco_r1(double step);

}  // namespace kurbel::bench
