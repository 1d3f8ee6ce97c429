// asked_figures.h — figures that a scene asks for by [[figure]]: functional ∘ channel ∘ window.
//
// Within each step of the integration the channel x(t) is divided at its turns, the roots of its rate, into pieces that
// rise or fall. All is found on the dense solution, not between samples:
//     peak, max, min       at the ends of the pieces
//     time above a level   by the root of x(t) − level, one at most in a piece
//     mean, RMS            ∫ x dt, ∫ x² dt by Gauss points
// A step of the sequence ends where a step of the integration does; the ends of cycles divide those. Errors are measured
// by other runs, as of all figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/numerics/roots.h"
#include "engine/run/recorders.h"
#include "studies/findings/result.h"

namespace kurbel {

struct AskedFigure {
  Channel channel;
  Functional functional = Functional::peak;
  QuantityKind::Window window = QuantityKind::Window::run;  // run, steady_cycle or step
  int step = 0;                                             // from 1
  double level = 0;                                         // in SI
  Figure figure = {};                                       // its name and unit
};

// Without those of channels that exist only under other effects, such as the twist of what is rigid. Throws SceneError for
// a channel that no machine of these components has, and for a level that is not in its unit.
std::vector<AskedFigure> asked_figures(const Model& model);
// A note on each that a run did not give: those, and others whose window it did not come to.
std::vector<std::string> figures_not_given(const Model& model, const std::vector<Figure>& given);

class AskedRecorder final : public Observer {
 public:
  // `cycles` observes the same run, before this; null: the run is one steady cycle, and only figures of it are given.
  explicit AskedRecorder(const Model& model, const CycleRecorder* cycles = nullptr);
  bool empty() const { return asked_.empty(); }
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  // Figures not reported yet, of windows that the run came to; of all cycles the one with this end.
  void report(double cycle_end, FigureReporter& report) const;

 private:
  // What is known of one window.
  struct Gauge {
    double begin = 0, end = 0;  // so far [s]
    double sum = 0;             // ∫ x dt, ∫ x² dt, or the time above
    std::optional<Sampled> extreme = {};
  };
  struct Asked : AskedFigure {
    bool open = false;              // its window is under way
    Gauge now = {};                 // in it
    std::vector<Gauge> whole = {};  // in windows gone through: in all cycles, in the last step
    double size = 0;                // greatest magnitude of the channel
  };
  static double merit(const Asked& asked, double value);
  const Gauge* gauge_of(const Asked& asked, double cycle_end) const;
  void follow_sequence(const Equations& equations, double t);
  std::vector<double> ends_of_cycles(const StepView& view);
  void begin_cycle(double t);
  void take(StepView& view, double a, double b);
  void add_piece(StepView& view, Asked& asked, const Sampled& a, const Sampled& b);

  std::vector<Asked> asked_;
  const CycleRecorder* cycles_;
  std::size_t seen_cycles_ = 0, next_step_ = 0;
  double step_began_ = -HUGE_VAL;  // that of the sequence under way [s]; infinite: not looked at yet
};

}  // namespace kurbel
