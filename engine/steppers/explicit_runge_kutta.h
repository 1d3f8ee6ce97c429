// explicit_runge_kutta.h — Stepper by an explicit embedded Runge–Kutta method; no allocation and no copy in a step.
#pragma once

#include <array>

#include "engine/steppers/slope_sums.h"
#include "engine/steppers/stepper.h"

namespace kurbel {

class ExplicitRungeKutta final : public Stepper {
 public:
  ExplicitRungeKutta(const EmbeddedTable& table, OdeSystem& system, const ErrorControl& control);

  void start(double t, std::span<const double> y) override;
  void step(double t_limit) override;
  void retake(double t) override;
  void interpolate(double t, std::span<double> y) override;
  double interpolate(double t, std::size_t state) override;

  double t() const override { return t_; }
  double t_previous() const override { return t_previous_; }
  std::span<const double> y() const override { return {y_, size_}; }
  std::span<const double> y_previous() const override { return {y_previous_, size_}; }
  std::span<const double> ydot() const override { return {slope_[table_.stages], size_}; }
  std::span<const double> ydot_previous() const override { return {slope_[0], size_}; }
  bool held_by_stability() const override { return stiff_steps_ >= stiff_steps_to_report; }
  StepLimit limited_by() override { return {limit_, worst_}; }

 private:
  static constexpr int stiff_steps_to_report = 15;  // successive steps to detect stiffness, and
  static constexpr int mild_steps_to_forget = 6;    // to reset the detection (Hairer–Wanner II, section IV.2)

  struct Aim {
    double t, h;
    bool cut;  // shorter than needed by accuracy, to end at t_limit
  };

  double first_step(double longest);
  void search_step(double t_limit);
  Aim aim(double h, double t_limit) const;
  void evaluate(double t, const double* y, std::size_t stage);
  void take_stages(double h);   // from y_previous_ and slope_[0]
  void take(double h);          // stages and solution, to y_
  void nudge(double t);         // y_ from t_ to a time close by
  double error_norm(double h);  // ≤ 1: accepted; not finite if any value of the step is not
  bool end_slope_is_finite() const;
  void adapt(double error, const Aim& done, bool after_rejection);
  void watch_stability(double h);
  void prepare_dense_stages();
  void prepare_dense_output();
  const std::array<double, 4>& dense_of(std::size_t state);
  DensePlace place_of(double t) const;
  void stand_still();
  [[noreturn]] void fail(double h, double error) const;

  const EmbeddedTable& table_;
  OdeSystem& system_;
  std::size_t size_;
  std::vector<double> weight_;  // 1/(tolerance · scale), 0 for states out of control
  double tolerance_;
  double stiff_from_ = 0;  // h·ρ
  bool error_needs_end_slope_;

  std::vector<double> storage_;  // the following pointers point into it
  double* y_;
  double* y_previous_;
  double* stage_y_;  // argument of the last stage before the end slope
  Slopes slope_{};
  std::array<double*, 4> dense_{};
  bool dense_stages_are_ready_ = false, dense_is_ready_ = false;
  std::size_t dense_state_ = 0;  // whose dense output alone stands in dense_of_; size_: none
  std::array<double, 4> dense_of_{};

  double t_ = 0, t_previous_ = 0;
  double step_end_ = 0;    // of the last step as it was accepted
  double stages_end_ = 0;  // to which the stages belong: t_, or close to it
  double h_next_ = 0;      // 0: unknown
  double previous_error_ = 1e-4;
  std::size_t worst_ = 0;  // state with the largest error in the last step tried
  StepLimit::By limit_ = StepLimit::By::end;
  int stiff_steps_ = 0, mild_steps_ = 0;
  bool started_ = false;
};

}  // namespace kurbel
