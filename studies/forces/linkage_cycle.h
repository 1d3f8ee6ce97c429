// linkage_cycle.h — one problem of kinetostatics over a cycle, position by position, and its largest values, means and works.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/joints/mechanism_statics.h"
#include "studies/forces/crank_motion.h"
#include "studies/forces/forces.h"

namespace kurbel {

// At one angle of the crank; of a mechanism that passes change points, beside them.
PositionForces linkage_position(const MechanismStatics& statics, OutputLoads& loads, double phi, CrankMotion motion);
// Along one motion; `samples`: every abscissa but rows alone, ascending. Throws std::runtime_error where the mechanism has no
// finite reactions.
ForceCycle linkage_cycle(const MechanismStatics& statics, OutputLoads& loads, const MotionAlong& motion,
                         std::vector<PositionForces>* samples = nullptr);
// Where a mechanism that passes change points has reactions without bound, at this speed of its crank.
UnboundedReactions unbounded_reactions(const MechanismData& data, OutputLoads& loads, double speed);
// Marks the peaks that have none.
void mark_unbounded(const UnboundedReactions& unbounded, ForceCycle& cycle);
// "saw at 290 rpm: its joints' reactions have no bound at 90° and 270°, 10.4 kN within 0.01 rad of them": how a conclusion
// begins; empty where they are bounded.
std::string begin_unbounded(const std::string& mechanism, const UnboundedReactions& unbounded);

// What goes in, what comes out, what is lost, and the efficiency where there is one; from the works and their errors.
void judge_works(ForceCycle& cycle);
void widen_peak(Peak& peak, const Peak& other, double times);

// Of a slider-crank, else empty: counterweights by what they leave of the shaking force and the main bearing's load, at the
// crank's speed of `turn`. `samples` as linkage_cycle gives them, `at` between them.
std::optional<Balancing> balancing_of(const MechanismData& data, const ForceCycle& turn,
                                      const std::vector<PositionForces>& samples,
                                      const std::function<PositionForces(double phi)>& at);

}  // namespace kurbel
