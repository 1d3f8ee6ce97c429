// flywheel_falls.h — speed drops of flywheels and the energy they give, for example in the stroke of a press or punch.
//
//     fall = max (|ω(t₁)| − |ω(t₂)|), t₁ < t₂, while something drives
//     speed_drop = fall/|ω(t₁)|,   energy_given = ½ J (ω(t₁)² − ω(t₂)²)
// A fall below a billionth of the usual speed is none: of a wheel at the start, it may be all of its speed.
#pragma once

#include <string>
#include <vector>

#include "engine/run/sources.h"
#include "studies/findings/result.h"

namespace kurbel {

class FlywheelFalls final : public Observer {
 public:
  explicit FlywheelFalls(const Model& model);
  bool empty() const { return wheels_.empty(); }
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(wheels_); }

  // For all flywheels whose inertia is given; `seen`: observed in a run.
  static void report(const Model& model, const FlywheelFalls* seen, double energy_scale, FigureReporter& report);

 private:
  struct Wheel {
    std::string component;
    double inertia = 0;  // [kg·m²]
    int shaft = 0;
    double gain = 1;
    std::size_t state = 0;    // in y
    double highest = 0;       // |ω| so far [rad/s]
    double from = 0, to = 0;  // of the greatest fall [rad/s]
    double low_at = 0;        // time of the minimum; of equal falls the first [s]
    double alike = 0;         // the fall at that time [rad/s]
    bool risen = false;       // the speed has risen since then
    double change = 0;        // of |ω| in the previous step [rad/s]
    void look(double t, double speed);
    void remember(Tape& tape) { tape(highest, from, to, low_at, alike, risen, change); }
  };
  template <class See>
  void search(StepView& view, const Wheel& wheel, const See& see);

  Sources sources_;
  std::vector<Wheel> wheels_;
};

}  // namespace kurbel
