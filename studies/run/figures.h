// figures.h — one run with all that watches it, and the figures that it yields.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "studies/answers/link_recorder.h"
#include "studies/answers/slip_recorder.h"
#include "studies/duty/flywheel_falls.h"
#include "studies/duty/motor_currents.h"
#include "studies/duty/work_periods.h"
#include "studies/findings/result.h"
#include "studies/findings/trace.h"
#include "studies/limits/heat_recorder.h"
#include "studies/run/periods.h"
#include "studies/validity/outside_data.h"

namespace kurbel {

// Of a line of the energy balance, in a cycle.
QuantityKind work_per_cycle_of(Account account);

// One run at one tolerance with all that watches it.
struct OneRun {
  RunOutcome outcome;
  std::shared_ptr<TrajectoryRecorder> trajectory;
  std::unique_ptr<ExtremeRecorder> extremes;
  CycleRecorder cycles;
  std::unique_ptr<SpeedRecorder> speed;
  std::unique_ptr<EnergyAudit> energy;
  std::unique_ptr<HeatRecorder> heat;  // null: none is rated
  std::unique_ptr<SlipRecorder> slips;
  std::unique_ptr<LinkRecorder> link;
  std::unique_ptr<FlywheelFalls> falls;
  std::unique_ptr<MotorCurrents> currents;
  std::unique_ptr<DataRangeRecorder> ranges;  // of tables
  std::unique_ptr<TraceRecorder> traces;
  std::vector<Figure> figures;
  std::vector<Figure> last_state;  // of all components: angle, speed, and those of the driven shaft; without names
  Periods periods;
  std::vector<WorkPeriod> work_periods;
};

// Fills `figures` and `last_state` of a run that has got somewhere; `tolerance`: of its steps, which tells what is
// steady.
void collect_figures(const Model& model, Equations& equations, double tolerance, OneRun& run);

// What becomes of these watchers in a Result.
EnergyBalance energy_balance(const Model& model, const EnergyAudit& audit);
// By component; none from a run that has got nowhere, whose `last_state` is empty.
std::map<std::string, ComponentState> final_state(const Model& model, const std::vector<Figure>& last_state);

}  // namespace kurbel
