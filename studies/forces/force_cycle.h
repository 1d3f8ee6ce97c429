// force_cycle.h — one problem of kinetostatics over a cycle: where it is looked at, peaks on the continuous motion,
// works with their errors.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/rigid/rigid_machine.h"
#include "studies/forces/forces.h"

namespace kurbel {

// The loads on the slider, from the mechanism's own element on a shaft of its own: angle and speed are the crank's.
class SliderLoads {
 public:
  SliderLoads(const Scene& scene, const std::string& component);
  const Model& model() const { return machine_.model(); }
  double cycle() const { return machine_.cycle(); }
  std::vector<double> edges(int direction) { return machine_.edges(direction); }

  // Sum of all forces along +x [N].
  double force(double phi, double omega);
  // Of each of model().accounts, reduced to the crank [N·m]; omega ≠ 0.
  std::span<const double> shares(double phi, double omega);

 private:
  explicit SliderLoads(const std::shared_ptr<const Model>& model) : machine_(model), equations_(model, false) {}

  RigidMachine machine_;
  Equations equations_;
  int channel_ = -1;
};

// The element by which a slider-crank works on its shaft.
const Network::ShaftElement& slider_crank_element(const Network& network, const std::string& component);

// An angle of the crank that is looked at.
struct Abscissa {
  double phi = 0;
  double weight = 0;  // of the integral over the cycle
  bool grid = false;  // one of the even positions that curves and orders are made of
  bool row = false;   // one of the positions asked for; alone, it takes no part in anything else
};
// The same for any number of rows: an even grid, Gauss' three points between its points and the load edges, a point on
// either side of each edge; and the rows.
std::vector<Abscissa> abscissae(double cycle, const std::vector<double>& edges, int rows_of_turn);

struct CrankMotion {
  double omega = 0, alpha = 0;  // [rad/s], [rad/s²]
};

// The largest magnitude of a function of the crank's angle. Local peaks of the samples near the largest one are
// refined by the golden section between their neighbours, so that the peak is one of the function, not of the samples;
// at an edge the samples stand on either side of it. Of equal peaks (a crank's two strokes) the first one counts,
// however rounding decides between them.
Peak peak_of(const std::vector<double>& phi, const std::vector<double>& values,
             const std::function<double(double)>& value);

class CycleBuilder {
 public:
  CycleBuilder(const SliderCrankStatics& statics, SliderLoads& loads, ForceCycle& cycle);

  void add(const Abscissa& where, CrankMotion motion);
  void finish();
  // Between what was added, too.
  CyclePosition at(double phi) const { return at(phi, motion_at(phi)); }
  const std::vector<CyclePosition>& samples() const { return samples_; }

 private:
  CyclePosition at(double phi, CrankMotion motion) const;
  CrankMotion motion_at(double phi) const;
  void find_extremes();
  void call_rounding_zero();
  void collect_curves();
  void find_harmonics();
  void balance_powers();

  const SliderCrankStatics& statics_;
  SliderCrankGeometry geometry_;
  SliderLoads& loads_;
  ForceCycle& cycle_;
  std::vector<CyclePosition> samples_;  // every abscissa but rows alone
  double time_ = 0;
};

// What goes in, what comes out, what is lost, and the efficiency where there is one; from the works and their errors.
void judge_works(ForceCycle& cycle);

// Counterweights by what they leave of the shaking force and the main bearing's load, at the crank's speed of `turn`.
std::vector<Counterweight> propose_counterweights(const SliderCrankStatics& statics, const CycleBuilder& turn,
                                                  const std::vector<CyclePosition>& positions);

}  // namespace kurbel
