// free_vibration.h — how a settled machine vibrates when it is disturbed: frequencies and decays, from runs alone.
//
//     x₊(t) − x₋(t) = Σ Re a_m e^{λ_m t} p_m(t),   p_m(t + T) = p_m(t)                                    (Floquet)
// Two runs side by side for each state, pushed forwards and backwards; the period in sub-intervals, at whose begins the
// pushes are small again. What sub-interval k makes of a push is a matrix A_k; e^{λh} are the eigenvalues of the
// matrix that holds A_k as blocks below its diagonal, A_N in its corner: no product of them is ever formed, so that
// what dies away within a period is found as well. Of a vibration's frequencies ω + 2πk/T that with most energy counts.
//
// Nothing of engine/orbit and studies finds anything here; how fast the machine may vibrate, which only chooses the
// sub-intervals, comes from differences of the right-hand side.
#pragma once

#include <string>
#include <vector>

#include "tests/agreement/settled_run.h"

namespace kurbel::agreement {

struct FreeVibration {
  double omega = 0, decay = 0;              // λ = −decay ± i omega [rad/s], [1/s]
  double omega_error = 0, decay_error = 0;  // pushes to one side only against pushes to both; what runs leave
  std::string joint;                        // that vibrates most
  double share = 0;                         // of twists in its energy: about ½
  // To the period, by what varies in it: one of two with decays of their own; at an odd multiple of half of it.
  bool locked = false, turned = false;
  double natural() const;
  double ratio() const;  // ζ
};

struct FreeVibrations {
  bool measured = false;
  std::string why;                   // it was not
  std::vector<FreeVibration> list;   // of vibrations, by frequency; without what dies within a sub-interval
  double fastest = 0, shortest = 0;  // what could be seen: frequencies up to [rad/s], decays up to [1/s]
  int sub_intervals = 0, pushes = 0;
  double cpu_seconds = 0;
};

struct PushSettings {
  double tolerance = 1e-12;
  double push = 1e-4;  // of the scales of states
  int most_pushes = 40;
  double budget = 12;  // processor time [s]
};

FreeVibrations free_vibrations_of(const SettledRun& run, const PushSettings& settings = {});

}  // namespace kurbel::agreement
