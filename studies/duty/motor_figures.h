// motor_figures.h — load on the motors in a run: power, RMS torque, heat of slip, use of their ratings.
//
//     mean power    ∫ M ω dt / t                        work of the motor's account over the time run
//     RMS torque    √( ∫ M² dt / t )                    a lower bound of heating: no-load losses and starts come on top
//     RMS current   √( ∫ i² dt / t )                    of a direct-current motor's armature: i = M/k, i² = M/κ; of a
//                                                       line of the two-axis model: i² = ½ |i_s|²
//     peak torque, power                                of greatest magnitude
//     peak current  |M|/k, √(|M|/κ) at the peak torque  of a direct-current motor's armature; of the two-axis model |i_s|
//     heat of slip  ω_s ∫ M dt − ∫ M ω dt               of the rotor of an induction motor at the mains (theory 4)
//                   3/2 R_r ∫ |i_r|² dt                 the same, of the two-axis model; of its stator with R_s, i_s
//     start heat    heat of slip − P_s (t_off − t_up)   P_s: of the last whole cycle; t_up … t_off: steady motion
//     thermal use   √( ∫ M² dt / T ) / M_n              over the last whole cycle of a periodic motion; if commands change
//                                                       the motion, over the heaviest repeated cycle; without a cycle
//                                                       from the steady torque
// All integrals are computed along with the motion: ∫ M dt and ∫ M² dt are quadratures of the audit.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/run/recorders.h"
#include "studies/duty/motor_currents.h"
#include "studies/findings/result.h"

namespace kurbel {

// Integrals up to the end `y` of a run of `duration` [s]; `work`: per account up to there [J]; `last`: the last whole
// cycle of a periodic motion, otherwise null.
struct MotorRun {
  Equations& equations;
  std::span<const double> y;
  const std::vector<double>& work;
  double duration = 0, energy_scale = 0;
  const CycleRecord* last = nullptr;
  std::vector<const CycleRecord*> repeating = {};  // all that repeat the two before them
  const MotorCurrents* currents = nullptr;
  double end = 0;       // of the run [s]
  bool steady = false;  // the motion is steady to the end
  struct Span {
    double begin = 0, end = 0;
  };
  std::optional<Span> after_run_up = {};  // from the end of run-up until the drive goes off, if there is one [s]
};
// Their peaks are reported before.
void report_motors(const MotorRun& run, FigureReporter& report);
// All figures that a run may yield.
void list_motors(const Model& model, FigureReporter& report);
// Peaks located along the run: of torque, of the power of a prescribed shaft's drive, of a current in two axes.
std::vector<ExtremeOf> motor_extremes_of(const Model& model);

// √( (1/t) ∫ x² dt )
inline double root_mean_square(double integral, double time) { return std::sqrt(std::max(0.0, integral) / time); }
// Driving work of all accounts of a component, from the work per account [J].
double driving_work(const Model& model, const std::string& component, std::span<const double> work);

}  // namespace kurbel
