// force_cycle.h — one problem of kinetostatics of a slider-crank over a cycle: peaks on the continuous motion, works
// with their errors.
#pragma once

#include <vector>

#include "studies/forces/crank_motion.h"
#include "studies/forces/forces.h"

namespace kurbel {

class CycleBuilder {
 public:
  CycleBuilder(const SliderCrankStatics& statics, OutputLoads& loads, ForceCycle& cycle);

  void add(const Abscissa& where, CrankMotion motion);
  void finish();
  // Between what was added, too.
  CyclePosition at(double phi) const { return at(phi, motion_between(motion_, phi)); }
  CyclePosition at(double phi, CrankMotion motion) const;
  const std::vector<CyclePosition>& samples() const { return samples_; }

 private:
  void find_extremes();
  void call_rounding_zero();
  void collect_curves();
  void find_harmonics();
  void balance_powers();
  void find_errors_of_works();

  const SliderCrankStatics& statics_;
  MechanismData data_;
  OutputLoads& loads_;
  ForceCycle& cycle_;
  std::vector<CyclePosition> samples_;  // every abscissa but rows alone
  std::vector<MotionSample> motion_;    // of these, ascending
  double time_ = 0;
};

// What goes in, what comes out, what is lost, and the efficiency where there is one; from the works and their errors.
void judge_works(ForceCycle& cycle);

// Counterweights by what they leave of the shaking force and the main bearing's load, at the crank's speed of `turn`.
std::vector<Counterweight> propose_counterweights(const SliderCrankStatics& statics, const CycleBuilder& turn,
                                                  const std::vector<CyclePosition>& positions);

}  // namespace kurbel
