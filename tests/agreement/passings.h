// passings.h — where a motion is examined again and again: passings of an angle, begins of a period of time.
#pragma once

#include <span>
#include <vector>

#include "engine/run/run.h"

namespace kurbel::agreement {

struct Passing {
  double t = 0;
  double angle = 0;           // of the link, turns counted [rad]
  double speed = 0;           // of the link [rad/s]
  double kinetic_energy = 0;  // [J], where requested
  std::vector<double> state;  // speeds and spring twists over their scales
};

// The largest difference of speeds and twists, over their scales.
double difference(const Passing& a, const Passing& b);

// Where the link passes multiples of an angle, or time those of a period; located on the continuous solution.
class Passings final : public Observer {
 public:
  enum class Of { angle, time };
  Passings(Of of, double base, bool energies = false) : of_(of), base_(base), energies_(energies) {}
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  const std::vector<Passing>& list() const { return list_; }

 private:
  double place(double t, std::span<const double> y, Equations& equations) const;
  void take(double t, std::span<const double> y, Equations& equations);

  Of of_;
  double base_;
  bool energies_;
  double last_ = 0;  // multiple passed last, or below the begin
  std::vector<double> scale_;
  std::vector<std::size_t> looked_at_;  // states
  std::vector<Passing> list_;
};

}  // namespace kurbel::agreement
