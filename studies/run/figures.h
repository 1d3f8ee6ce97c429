// figures.h — one run with all its observers, and the figures that it yields.
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
#include "studies/figures/asked_figures.h"
#include "studies/findings/result.h"
#include "studies/findings/trace.h"
#include "studies/limits/heat_recorder.h"
#include "studies/run/periods.h"
#include "studies/validity/outside_data.h"

namespace kurbel {

// Quantity of a line of the energy balance, over a cycle.
QuantityKind work_per_cycle_of(Account account);

// One run at one tolerance with all its observers.
struct OneRun {
  RunOutcome outcome;
  std::shared_ptr<TrajectoryRecorder> trajectory;
  std::unique_ptr<ExtremeRecorder> extremes;
  CycleRecorder cycles, by_time;  // the latter: periods of the laws over time, if there are any
  std::unique_ptr<SpeedRecorder> speed;
  SwitchingRecorder switchings;
  std::unique_ptr<EnergyAudit> energy;
  std::unique_ptr<HeatRecorder> heat;  // null: no heat is rated
  std::unique_ptr<SlipRecorder> slips;
  std::unique_ptr<LinkRecorder> link;
  std::unique_ptr<FlywheelFalls> falls;
  std::unique_ptr<MotorCurrents> currents;
  std::unique_ptr<DataRangeRecorder> ranges;  // of tables
  std::unique_ptr<AskedRecorder> asked;       // null: nothing
  std::vector<Figure> figures;
  std::vector<Figure> last_state;  // of all components: angle, speed, and those of the driven shaft; without names
  Periods periods;
  std::vector<WorkPeriod> work_periods;
  std::optional<Works> works_at(double t) const {  // at borders of the periods
    const std::optional<Works> work = speed->works_at(t);
    return work ? work : switchings.works_at(t);
  }
};

// Fills `figures` and `last_state` of a run that made progress; `tolerance` of its steps, for the criterion of steady
// motion.
void collect_figures(const Model& model, Equations& equations, double tolerance, OneRun& run);

// By component; empty for a run without progress, whose `last_state` is empty.
std::map<std::string, ComponentState> final_state(const Model& model, const std::vector<Figure>& last_state);

}  // namespace kurbel
