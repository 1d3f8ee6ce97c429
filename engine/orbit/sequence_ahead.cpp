// sequence_ahead.cpp — whether a period of the motion triggers the armed step of a sequence.
#include "engine/orbit/sequence_ahead.h"

#include "engine/events/operating_sequence.h"
#include "engine/orbit/follow_period.h"

namespace kurbel {

bool sequence_goes_on(const ReturnMap& map, const Eigen::VectorXd& z) {
  constexpr double never = 1e299;
  const Model& m = map.model();
  const Sequence& sequence = m.scene.sequence;
  if (sequence.repeat || sequence.steps.empty()) return false;
  Equations equations(map.shared_model(), false);
  const std::vector<double> y = map.place(equations, z);
  const std::size_t armed = equations.modes().next_step;
  if (armed >= sequence.steps.size()) return false;
  if (equations.modes().armed_time < never || sequence.steps[armed].when == SequenceStep::When::angle) return true;
  const double* speed = equations.snapshot(map.start_time(), y).now.speed;
  if (OperatingSequence(m).guard(equations.modes(), y, speed) <= 0) return true;
  follow_period(map, z, equations, {.tolerance = 1e-9}, {});
  return equations.modes().next_step != armed;
}

}  // namespace kurbel
