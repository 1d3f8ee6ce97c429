// work_stepper.h — Stepper of rigid machines over their angle: T and t as functions of φ, load edges as step ends.
//
//     dT/dφ = M(φ, ω),   dt/dφ = 1/ω,   ω = √(2T/I_r)                                             (theory 2.5)
// Dormand–Prince 8(5,3) over s = ±φ; T is taken from the work diagram if torques depend only on the angle, so that the
// energy is exact and phase errors grow linearly with time, not quadratically. Near rest, T < 0.2 rad · |M|, 1/ω is nearly
// singular and the machine is integrated over time instead; so starts, stalls and reversals are ordinary events of the
// run.
#pragma once

#include <memory>
#include <vector>

#include "engine/events/equations.h"
#include "engine/rigid/work_equation.h"
#include "engine/steppers/explicit_runge_kutta.h"

namespace kurbel {

// [T | t | quadratures] over the angle turned since the start, in the direction of motion. T is constant if the work
// diagram gives it.
class MotionOverAngle final : public OdeSystem {
 public:
  MotionOverAngle(Equations& equations, WorkTables& tables);
  std::size_t size() const override { return 2 + quadratures_; }
  void flow(double turned, std::span<const double> x, std::span<double> rate) override;
  const SparsityPattern& jacobian_pattern() override { return no_pattern_; }
  void jacobian(double, std::span<const double>, std::span<double>) override {}

  // Starts at a state of the equations with ω ≠ 0. A start at the end of the last motion keeps its energy to the last
  // bit.
  void start(double t, std::span<const double> y, std::span<double> x);
  void end(double turned, std::span<const double> y);
  void state(double turned, std::span<const double> x, std::span<double> y) const;  // of the equations
  double kinetic(double turned, std::span<const double> x) const;                   // T [J]
  double speed(double turned, std::span<const double> x) const;                     // |ω| [rad/s]
  double place(double turned) const { return place_ + turned; }  // s [rad], within a cycle at the start
  int direction() const { return direction_; }
  ErrorControl error_control(double tolerance) const;

 private:
  double inertia(double turned) const;
  double place_of(std::span<const double> y) const;

  Equations& equations_;
  WorkTables& tables_;
  const Model& model_;
  std::size_t quadratures_, speed_index_, link_;
  const WorkOverAngle* diagram_ = nullptr;  // null: torques depend on the speed
  int direction_ = 1;
  double place_ = 0, energy_ = 0;         // energy: T − W(s) [J]
  double end_place_ = 0, end_speed_ = 0;  // where the last motion ended
  std::vector<double> begin_, looked_up_, y_, ydot_;
  SparsityPattern no_pattern_;
};

class WorkStepper final : public Stepper {
 public:
  // control: of the states of the equations. tables: of the same model; null: made here.
  // Throws std::invalid_argument with the reason if the work equation does not apply.
  WorkStepper(Equations& equations, const ErrorControl& control, std::shared_ptr<WorkTables> tables = nullptr);

  void start(double t, std::span<const double> y) override;
  void step(double t_limit) override;
  void retake(double t) override;
  void interpolate(double t, std::span<double> y) override;
  double t() const override { return t_; }
  double t_previous() const override { return t_previous_; }
  std::span<const double> y() const override { return y_; }
  std::span<const double> y_previous() const override { return y_previous_; }
  std::span<const double> ydot() const override { return slope(t_, y_, ydot_); }
  std::span<const double> ydot_previous() const override { return slope(t_previous_, y_previous_, ydot_previous_); }
  bool ends_on_edges() const override { return true; }
  bool at_edge() const override { return at_edge_; }
  StepLimit limited_by() override;

 private:
  bool regular(double least_angle);
  void step_over_angle(double t_limit);
  void step_over_time(double t_limit);
  double next_stop();
  double turned_at(double t);
  void land(double t);
  void count();
  std::span<const double> slope(double t, std::span<const double> y, std::vector<double>& ydot) const;

  Equations& equations_;
  std::shared_ptr<WorkTables> tables_;
  MotionOverAngle motion_;
  ExplicitRungeKutta over_time_, over_angle_;
  bool by_angle_ = false, begun_ = false, at_edge_ = false;  // begun: the present variable is started
  bool landed_ = false;                                      // the last step over the angle ended at a time
  double t_ = 0, t_previous_ = 0, edge_ = 0;                 // edge: next one, as rotation
  std::vector<double> y_, y_previous_, x_;
  mutable std::vector<double> ydot_, ydot_previous_;
};

std::unique_ptr<Stepper> make_work_stepper(Equations& equations, const ErrorControl& control,
                                           std::shared_ptr<WorkTables> tables);

}  // namespace kurbel
