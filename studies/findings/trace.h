// trace.h — an observer for plots: every channel along the steps of a run, in bounded memory, with every peak kept.
#pragma once

#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/recorders.h"
#include "engine/run/sources.h"

namespace kurbel {

// One quantity over time or over the crank angle.
struct Trace {
  std::string name, unit;  // SI
  std::vector<double> x, y;
  QuantityKind what = {};
  std::string of = {};
  // Straight between the points, which ascend in x; the first or the last value beyond them.
  double at(double place) const;
  std::vector<double> at(const std::vector<double>& places) const;

 private:
  double before(std::size_t next, double place) const;
};

// One whole cycle of the reduction link; the traces run over its angle from 0 [rad].
struct CycleTraces {
  double begin = 0, end = 0;  // [s]
  std::vector<Trace> traces;
  int cycles = 1;  // joined, one after the other
};

// Data of a run for plots, independent of the integrator.
struct Traces {
  std::vector<Trace> over_time;
  std::deque<CycleTraces>
      last_cycles;  // whole ones, at most two, the latest last; driven ones, if any; or one period of several
  const Trace* find(const std::string& name) const;
  static std::string node_key(int node) { return "twist_to_link." + std::to_string(node); }
};

// Records at the steps of the integrator, which are short at fast changes, and on both sides of every jump. In
// addition to the model's channels:
//   twist_to_link.NODE  angle of a node reduced to the reduction link, less the link's own angle [rad]
//   kinetic_energy, stored_energy, work.driving, work.useful, work.harmful, work.weight [J]
class TraceRecorder final : public Observer {
 public:
  explicit TraceRecorder(const Model& model);
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;

  // After the run: what was recorded until now; the last so many cycles in a row that end by `until` [s] as one.
  std::shared_ptr<const Traces> traces(int cycles = 1, double until = HUGE_VAL);

 private:
  void look(double t, std::span<const double> y, Equations& equations);  // now_ and angle_
  void put(double t, Equations& equations);
  void put_jumps(double t);
  void hand_over();  // the rows of the block
  // Angles of the link at both times.
  std::optional<double> border_between(double from, double angle_from, double to, double angle_to,
                                       StepView& view) const;
  void keep_open_cycle();
  void begin_cycle(double t, bool driven);
  void follow_cycle(double t, bool driven);

  const Model* model_;  // outlives the run
  std::vector<Channel> channels_;
  std::shared_ptr<Traces> traces_ = std::make_shared<Traces>();
  std::vector<std::size_t> over_angle_;  // traces that are also followed over the angle
  std::vector<std::size_t> works_;       // of each account of the model, the trace of its kind
  CycleTraces open_;
  double turn_ = 0;          // number of the open cycle
  bool open_whole_ = false;  // it was recorded from its beginning
  bool open_driven_ = false,
       any_driven_ = false;  // driven throughout; a whole driven cycle is preferred
  Sources sources_;
  std::vector<double> now_;
  double angle_ = 0;  // of the link
  // The latest rows, column by column; each column is appended to its trace at one go.
  std::vector<double> block_, times_, angles_;
};

}  // namespace kurbel
