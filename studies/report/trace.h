// trace.h — an observer for plots: every channel along the steps of a run, in bounded memory, with every peak kept.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "engine/recorders.h"

namespace kurbel {

// One quantity over time or over the crank angle.
struct Trace {
  std::string name, unit;  // SI
  std::vector<double> x, y;
};

// One whole cycle of the reduction link; the traces run over its angle from 0 [rad].
struct CycleTraces {
  double begin = 0, end = 0;  // [s]
  std::vector<Trace> traces;
};

// Follows the steps of the integrator, which are short where something happens, and both sides of every jump. Beside
// the model's channels:
//   twist_to_link.NODE  angle of a node reduced to the reduction link, less the link's own angle [rad]
//   kinetic_energy, stored_energy, work.driving, work.useful, work.harmful, work.weight [J]
class TraceRecorder final : public Observer {
 public:
  explicit TraceRecorder(const Model& model);
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;

  const std::vector<Trace>& traces() const { return traces_; }
  const Trace* find(const std::string& name) const;
  // The last whole cycles, at most two, the latest last.
  const std::deque<CycleTraces>& last_cycles() const { return cycles_; }
  static std::string node_key(int node) { return "twist_to_link." + std::to_string(node); }

 private:
  void record(double t, std::span<const double> y, Equations& equations, bool only_jumps);
  void follow_cycle(double t, double angle);

  const Model* model_;  // outlives the run
  std::vector<Channel> channels_;
  std::vector<Trace> traces_;
  std::vector<std::size_t> over_angle_;  // traces that are also followed over the angle
  std::deque<CycleTraces> cycles_;
  CycleTraces open_;
  double turn_ = 0;          // number of the open cycle
  bool open_whole_ = false;  // it was seen from its beginning
  std::vector<double> now_;
};

}  // namespace kurbel
