// linkage_cycle.h — one problem of kinetostatics over a cycle: position by position, then peaks, means and works.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/joints/mechanism_statics.h"
#include "studies/forces/crank_motion.h"
#include "studies/forces/forces.h"

namespace kurbel {

// At one crank angle; at a change point of the mechanism, beside it.
PositionForces linkage_position(const MechanismStatics& statics, OutputLoads& loads, double phi, CrankMotion motion);
// Along one motion; `samples`: all abscissae that are not rows only, ascending. Throws std::runtime_error if the
// mechanism has no finite reactions.
ForceCycle linkage_cycle(const MechanismStatics& statics, OutputLoads& loads, const MotionAlong& motion,
                         std::vector<PositionForces>* samples = nullptr);
// Angles at which a mechanism with change points has unbounded reactions, at this crank speed.
UnboundedReactions unbounded_reactions(const MechanismData& data, OutputLoads& loads, double speed);
// Marks the peaks that are unbounded.
void mark_unbounded(const UnboundedReactions& unbounded, ForceCycle& cycle);
// Begin of the conclusion: "saw at 290 rpm: its joints' reactions have no bound at 90° and 270°, 10.4 kN within 0.01
// rad of them"; empty if they are bounded.
std::string begin_unbounded(const std::string& mechanism, const UnboundedReactions& unbounded);

// Input, useful output, loss, and the efficiency if there is one; from the works and their errors.
void judge_works(ForceCycle& cycle);
void widen_peak(Peak& peak, const Peak& other, double times);

// For a slider-crank, else empty: counterweights with the remaining shaking force and load of the main bearing, at
// the crank speed of `turn`. `samples` as given by linkage_cycle, `at` between them.
std::optional<Balancing> balancing_of(const MechanismData& data, const ForceCycle& turn,
                                      const std::vector<PositionForces>& samples,
                                      const std::function<PositionForces(double phi)>& at);

}  // namespace kurbel
