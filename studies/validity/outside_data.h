// outside_data.h — use of data outside their range in a motion: beyond the ends of tables.
//
// Beyond the end of a table a law is extrapolated: by its end value or its slope. Unless the scene specifies this
// (beyond = …), the error is unknown: results that depend on it are reported and have no error bar.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/return_map/return_map.h"
#include "engine/rigid/rigid_machine.h"
#include "engine/run/run.h"
#include "studies/findings/result.h"

namespace kurbel {

// How far a motion went beyond each end of each table.
class DataRangeRecorder final : public Observer {
 public:
  explicit DataRangeRecorder(const Model& model);
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  // Without modes: for a machine that follows no operating sequence.
  void see(double t, const Snapshot& snapshot, const Modes* modes = nullptr);
  void remember(Tape& tape) override { tape(since_, least_, greatest_); }
  bool empty() const { return watched_.empty(); }

  // First time outside of any table [s]; empty: never.
  std::optional<double> since() const;
  // One sentence for each table. Throws SceneError if a table must not be left.
  std::vector<std::string> sentences() const;

 private:
  struct Watched {
    Network::DataRange range;
    std::vector<std::size_t> elements;   // elements whose torque it gives; none: always in force
    std::optional<std::size_t> command;  // the command of its part, if parts have their own
    std::function<double(const Snapshot&)> value;
    std::function<double(const Modes&)> of_law = {};  // instead of `value`, for a law of the operating sequence
  };
  void watch(Watched watched);
  void watch_laws();
  bool is_in_force(const Watched& watched, const Snapshot& snapshot) const;

  const Model& model_;
  std::vector<Watched> watched_;
  std::vector<double> since_, least_, greatest_;  // of each: ∞ and its own ends if it was never left
};

// Removes the errors of figures from that time on, and of figures without a time; of a run also those of its final state,
// events and claims.
void drop_errors(std::vector<Figure>& figures, double since);
void drop_errors(Result& result, double since);

// Where rounding decides a run's motion, by its claims of the start: no error is known.
void drop_errors_after_unstable_start(Result& result);

// Reports it among a run's results; dependent figures lose their errors.
void report_outside_data(const DataRangeRecorder& ranges, Result& result);

// For the steady motion from the map's fixed point: one more period, only if there are such tables. One sentence each.
std::vector<std::string> outside_data(const ReturnMap& map, const SteadyPoint& point);

// For the rigid machine over one cycle of its link at this speed [rad/s], ≠ 0. One sentence each.
std::vector<std::string> outside_data(RigidMachine& machine, double speed);

// The table over speed beyond whose end this speed of the link lies [rad/s]; null: none.
const Network::DataRange* table_left_at(const Model& model, double link_speed);

// "this speed lies outside the table of torque of "motor", which ends at 157 rad/s; its slope there is not known"
std::string beyond_in_words(const Model& model, const Network::DataRange& table, double link_speed);

}  // namespace kurbel
