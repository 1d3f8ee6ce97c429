// asked_figures.h — figures that a scene requests by [[figure]]: functional ∘ channel ∘ window.
//
// Within each step of the integration the channel x(t) is divided at its turns, the roots of its rate, into pieces that
// rise or fall. All is found on the dense solution, not between samples:
//     peak, max, min       at the ends of the pieces
//     time above a level   by the root of x(t) − level, one at most in a piece
//     mean, RMS            ∫ x dt, ∫ x² dt by Gauss points
// A step of the sequence ends where a step of the integration does; the ends of cycles divide those. The three periods of a
// run are known after it: what they need is kept for each half step, and where a period ends within one, the channel is
// interpolated in it. Errors are measured by other runs, as of all figures.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/numerics/roots.h"
#include "engine/run/recorders.h"
#include "studies/findings/result.h"

namespace kurbel {

struct AskedFigure {
  Channel channel;
  Functional functional = Functional::peak;
  QuantityKind::Window window = QuantityKind::Window::run;  // run, steady_cycle, step, or one of the three periods
  int step = 0;                                             // from 1
  double level = 0;                                         // in SI
  Figure figure = {};                                       // its name and unit
};

// Without those of channels that exist only under other effects, such as the twist of what is rigid. Throws SceneError for
// a channel that no machine of these components has, and for a level that is not in its unit.
std::vector<AskedFigure> asked_figures(const Model& model);
// A note on each that a run did not give: those, and others whose window it did not come to.
std::vector<std::string> figures_not_given(const Model& model, const std::vector<Figure>& given);

// One of the three periods of a run.
struct PeriodOfRun {
  QuantityKind::Window window = QuantityKind::Window::run;
  double begin = 0, end = 0;
  double begin_open = 0, end_open = 0;  // shifts of its ends that errors of the run may cause, common to all runs [s]
};

class AskedRecorder final : public Observer {
 public:
  // `cycles` observe the same run, before this; null: the run is one steady cycle, and only figures of it are given.
  explicit AskedRecorder(const Model& model, const CycleRecorder* cycles = nullptr,
                         const CycleRecorder* by_time = nullptr);
  bool empty() const { return asked_.empty(); }
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  // Figures not reported yet, of windows that the run came to; of all cycles the given ones, or none.
  void report(const CycleRecord* cycle, std::span<const PeriodOfRun> periods, FigureReporter& report) const;

 private:
  // What is known of one window.
  struct Gauge {
    double begin = 0, end = 0;  // so far [s]
    double sum = 0;             // ∫ x dt, ∫ x² dt, or the time above
    std::optional<Sampled> extreme = {};
  };
  // What a functional needs of a channel x.
  struct Meter {
    Functional functional = Functional::peak;
    double level = 0, size = 0;  // of time above; greatest magnitude of the channel so far

    bool needs_integral() const { return functional == Functional::rms || functional == Functional::mean; }
    double merit(double value) const;
    // Extremes and time above between two times; `at`: x at the times_within them.
    template <class X>
    void add(Gauge& gauge, double from, double to, const X& x, const std::array<double, 7>& at);
    void add_integral(Gauge& gauge, double weight, double value) const;
    void add_extreme(Gauge& gauge, const Sampled& found);
    template <class X>
    void add_monotone(Gauge& gauge, const X& x, const Sampled& a, const Sampled& b);
    double value(const Gauge& gauge) const;
  };
  // Of half a step, with the channel at its ends and at the Gauss points between them.
  struct Stretch : Gauge {
    std::array<double, 7> x = {};
  };
  struct Asked : AskedFigure {
    Meter meter = {};
    bool open = false;                    // its window is under way
    Gauge now = {};                       // in it
    std::vector<Gauge> whole = {};        // in windows gone through: between all borders of cycles, in the last step
    std::vector<Stretch> stretches = {};  // of the whole run, for its periods
  };
  static Gauge between(const Asked& asked, double begin, double end);
  std::optional<Gauge> gauge_of(const Asked& asked, const CycleRecord* cycle) const;
  static void give(const Asked& asked, const Gauge& gauge, double resolution, FigureReporter& report);
  void follow_sequence(const Equations& equations, double t);
  std::vector<double> ends_of_cycles(const StepView& view);
  void begin_cycle(double t);
  void take(StepView& view, double a, double b);
  void take_half(StepView& view, double from, double to);

  std::vector<Asked> asked_;
  std::array<const CycleRecorder*, 2> cycles_;
  std::array<std::size_t, 2> seen_cycles_ = {};
  std::size_t next_step_ = 0;
  double step_began_ = -HUGE_VAL;  // that of the sequence under way [s]; infinite: not examined yet
};

}  // namespace kurbel
