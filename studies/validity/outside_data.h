// outside_data.h — what a motion takes from outside of the data that its scene gives: beyond the ends of tables.
//
// A table ends somewhere, and a law goes on: its end values hold, or its slope does. Where the scene does not say so
// (beyond = …), nobody knows how far that is from the truth: what hangs on it is told, and carries no error bar.
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
  // Without its modes: of a machine that follows no operating sequence.
  void see(double t, const Snapshot& snapshot, const Modes* modes = nullptr);
  void remember(Tape& tape) override { tape(since_, least_, greatest_); }
  bool empty() const { return watched_.empty(); }

  // From when on it is outside of any [s]; nothing: it never is.
  std::optional<double> since() const;
  // A sentence for each table. Throws SceneError where a table is not to be left.
  std::vector<std::string> sentences() const;

 private:
  struct Watched {
    Network::DataRange range;
    std::vector<std::size_t> elements;   // whose torque it is; none: always in force
    std::optional<std::size_t> command;  // that a part of it has for itself
    std::function<double(const Snapshot&)> value;
    std::function<double(const Modes&)> of_law = {};  // in its place, of a law of the operating sequence
  };
  void watch(Watched watched);
  void watch_laws();
  bool is_in_force(const Watched& watched, const Snapshot& snapshot) const;

  const Model& model_;
  std::vector<Watched> watched_;
  std::vector<double> since_, least_, greatest_;  // of each: ∞ and its own ends where it was never left
};

// Figures from that time on are without errors, and so is all that belongs to no time.
void drop_errors(std::vector<Figure>& figures, double since);

// Says it among a run's answers; what hangs on it loses its error.
void tell_outside_data(const DataRangeRecorder& ranges, Result& result);

// Of the steady motion from the map's fixed point: a round more, only where there are such tables. A sentence each.
std::vector<std::string> outside_data(const ReturnMap& map, const SteadyPoint& point);

// Of the rigid machine whose link turns round once at this speed [rad/s], ≠ 0. A sentence each.
std::vector<std::string> outside_data(RigidMachine& machine, double speed);

// Whether this speed of the link lies beyond a table over the speed [rad/s].
bool lies_beyond_a_table(const Model& model, double link_speed);

}  // namespace kurbel
