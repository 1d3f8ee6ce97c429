// return_map.h — Poincaré map of the machine from one cycle to the next: the map, its derivative, and its fixed points.
//
//     z ↦ P(z), steady motion P(z*) = z*, Floquet multipliers = eigenvalues of ∂P/∂z at z*
// Autonomous machine: the section is at an angle φ₀ of the reduction link (mod its cycle). Machine with laws over time: the
// map is over their common period, and angles used by laws are among the unknowns. z is defined by the section
// (poincare_section.h): twists, speeds, internal states, relative to the state of the section.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <complex>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/return_map/newton.h"
#include "engine/return_map/periodicity.h"
#include "engine/return_map/poincare_section.h"
#include "engine/run/run.h"

namespace kurbel {

struct ReturnMapOptions {
  double tolerance = 1e-12;  // local, over the scale of each state
  std::string method = "auto";
  int cycles = 1;  // of the machine in one period of the map: k finds motions with the period of k cycles
  double budget = 300;
  const std::atomic<bool>* interrupted = nullptr;
  bool clocked = true;  // a clocked sequence keeps to its clock
};

class ReturnMap {
 public:
  // Throws std::invalid_argument if the machine has no section (see periodicity_of), or more than 400 unknowns.
  ReturnMap(std::shared_ptr<const Model> model, ReturnMapOptions options);
  // For a machine with a self-excited vibration or a repeated sequence, whose period [s] follows only from its motion.
  ReturnMap(std::shared_ptr<const Model> model, ReturnMapOptions options, double own_period);

  const Model& model() const { return *shared_; }
  std::shared_ptr<const Model> shared_model() const { return shared_; }
  const Periodicity& periodicity() const { return periodicity_; }
  bool has_own_period() const { return own_period_; }  // not given by any law

  // Puts the section through this state, with the link at about this speed [rad/s].
  void go_through(State state, std::vector<char> sticks_throughout, double link_speed);
  const PoincareSection& section() const { return *section_; }
  std::size_t size() const { return section_->size(); }
  double section_angle() const { return section_angle_; }  // φ₀ [rad]
  // Copies section, period, direction of rotation and limits of a period from a map of a similar machine.
  void follow(const ReturnMap& other);

  enum class End { returned, stands, turns_back, too_slow, failed, interrupted };
  struct Image {
    End end = End::failed;
    std::string why;             // the reason, unless it returned
    Eigen::VectorXd z;           // P(z), scaled
    double missed = 0;           // greatest difference of speeds there from those by z, over the usual ones
    double time = 0;             // duration of the period [s]
    double link_angle = 0;       // at its end [rad]
    double turned = 0;           // rotation of the link [rad]
    Eigen::MatrixXd derivative;  // ∂P/∂z, if requested
    Eigen::RowVectorXd slowing;  // ∂(time)/∂z [s], if requested
    double uncertain = 0;        // error of an entry of the derivative, by the tolerances of the integration
    bool grazed = false;         // a guard was touched tangentially: the derivative is uncertain
  };
  // Observers follow the period. If joints jam, also at its begin or end, it fails with a message.
  Image image(const Eigen::VectorXd& z, bool with_derivative, const std::vector<Observer*>& observers = {});

  // Integrates one cycle from a quasi-static state with the link at this speed [rad/s], puts the section at a position
  // without events, and returns the state there. `end`: whether the cycle was completed.
  Image approach(double link_speed);
  // The same from a given state.
  Image approach_from(State state);

  // The state of z for another set of equations of the same model; sets their modes.
  std::vector<double> place(Equations& equations, const Eigen::VectorXd& z) const {
    return section_->place(equations, z);
  }
  double start_time() const { return section_->state().t; }
  // End of a period for other integrations of the machine: falls through zero after `periods` periods.
  std::function<double(double, std::span<const double>)> period_end(Equations& equations, std::span<const double> y,
                                                                    double periods = 1) const;
  // Effort so far, in cycles: a period counts as its cycles; with derivative (size() + 1) times as much by variational
  // equations, 2 size() + 1 times by differences.
  double cost() const { return cost_; }
  // Of a period with derivative, in periods.
  double derivative_cost() const { return (variational_ ? 1.0 : 2.0) * static_cast<double>(size()) + 1; }
  double time_limit() const { return time_limit_; }
  // Most evaluations of the equations in a period, learnt from the cheapest completed one; 0: none was.
  std::int64_t effort() const { return most_flow_calls_; }
  void limit_effort(std::int64_t evaluations) { most_flow_calls_ = evaluations; }
  const ReturnMapOptions& options() const { return options_; }
  // The scaled direction of z along the motion, in which the phase of a machine with its own period is arbitrary. Zero for
  // other machines, and if commands or laws over time define the begin of a period.
  Eigen::VectorXd along_the_motion(const Eigen::VectorXd& z);
  // Derivatives by variational equations with jumps; else by differences.
  bool variational() const { return variational_; }

 private:
  Image approach_as_given(double from);
  Image period_from(State state);
  Image image_of(const Eigen::VectorXd& z, bool with_derivative, const std::vector<Observer*>& observers);
  RunOptions run_options(double from, double until) const;
  void learn_effort(const RunOutcome& outcome);
  void take_period(const Periodicity& periodicity);
  void set_pace(double link_speed);
  void differentiate(const Eigen::VectorXd& z, Image& image);
  void in_step_with_sequence(const RunOutcome& outcome, Image& image);
  Image judge(const RunOutcome& outcome, double from, double link_begin, Equations& equations) const;

  std::shared_ptr<const Model> shared_;
  ReturnMapOptions options_;
  Equations equations_;
  Periodicity periodicity_;
  bool own_period_ = false;
  bool variational_ = true;  // derivatives by variational equations, else by differences
  std::optional<PoincareSection> section_;
  double section_angle_ = 0, sense_ = 1, time_limit_ = 0, cost_ = 0;
  std::int64_t most_flow_calls_ = 0;  // limit for a period, by the cheapest completed one; 0: unknown
};

// A fixed point of the map.
struct SteadyPoint {
  bool found = false;
  std::string why;  // the reason, unless it was found
  ReturnMap::End end = ReturnMap::End::returned;
  Eigen::VectorXd z, first;  // the point, and the image of the guess
  Eigen::MatrixXd derivative;
  std::vector<std::complex<double>> multipliers;  // largest first
  double multiplier_error = 0;                    // of the largest, by the error of the derivative
  // Estimated remaining change of z by integration, or where round-off ends Newton's method. Empty: less than required.
  Eigen::VectorXd to_come;
  double time = 0;                   // of one period [s]
  double turned = 0;                 // rotation of the link in it [rad]
  double residual = 0;               // largest of |P(z) − z|, scaled
  int periods = 0, derivatives = 0;  // periods of the map, and those with derivative
  double cost = 0;                   // [cycles]
  bool grazed = false;
  bool vibrates() const { return std::abs(turned) <= 1e-8; }  // the link has zero mean speed
  double largest() const { return multipliers.empty() ? 0 : std::abs(multipliers.front()); }
  // Member of a family: the multiplier cannot be distinguished from 1. Slow convergence alone does not count.
  bool neutral() const { return !multipliers.empty() && std::abs(largest() - 1) <= multiplier_error; }
  bool unstable() const { return largest() > 1 + multiplier_error; }
  double still_to_come() const { return to_come.size() > 0 ? to_come.cwiseAbs().maxCoeff() : 0; }
  void take(const Eigen::VectorXd& at, const ReturnMap::Image& image);
  // Takes the point as found only if z describes the state at the end of the period (`missed`).
  void find(const ReturnMap::Image& image);
};

// By Newton's method from a guess. `enough`: residual of convergence.
SteadyPoint find_steady(ReturnMap& map, const Eigen::VectorXd& guess, double enough = 1e-10);

// By integration only: a few periods, and the decrease of their changes. Not found if a period changes more than `enough`,
// or if no decrease can be shown.
SteadyPoint find_by_periods(ReturnMap& map, const Eigen::VectorXd& guess, double enough);

// A map of the same or a similar machine with this tolerance, and with section, period and limits of the given map.
std::shared_ptr<ReturnMap> looser_map(const ReturnMap& map, double tolerance,
                                      std::shared_ptr<const Model> model = nullptr);

// The same motion by a looser map: the difference is the error of all results of the motion. A point found only by
// integration is moved by to_come; members of a family and grazing motions are kept. `point` is not found if the looser
// search finds another motion.
struct SteadyTwin {
  std::shared_ptr<ReturnMap> map;
  SteadyPoint point;
};
SteadyTwin looser_twin(const ReturnMap& map, const SteadyPoint& point, double tolerance,
                       std::shared_ptr<const Model> model = nullptr);

// Eigenvalues, largest magnitude first.
std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative);

}  // namespace kurbel
