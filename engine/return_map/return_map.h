// return_map.h — the machine's state from one cycle to the next: the map, its derivative, and its fixed points.
//
//     z ↦ P(z), steady motion P(z*) = z*, Floquet multipliers = eigenvalues of ∂P/∂z at z*
// A machine that knows no time: the section is the reduction link at an angle φ₀ (mod its cycle). A machine driven by time:
// the map runs over the common period of all that depends on it, and where angles matter too, they are among the unknowns.
// What z is, the section knows (poincare_section.h): twists, speeds, own states, relative to the state that it goes through.
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
  int cycles = 1;  // of the machine in one round of the map: k finds motions that repeat after k cycles
  double budget = 300;
  const std::atomic<bool>* interrupted = nullptr;
};

class ReturnMap {
 public:
  // Throws std::invalid_argument where the machine has no section (see periodicity_of), or more than 400 unknowns.
  ReturnMap(std::shared_ptr<const Model> model, ReturnMapOptions options);
  // Of a machine that swings by itself, or by its repeated sequence, with a period [s] that only its motion tells.
  ReturnMap(std::shared_ptr<const Model> model, ReturnMapOptions options, double own_period);

  const Model& model() const { return *shared_; }
  std::shared_ptr<const Model> shared_model() const { return shared_; }
  const Periodicity& periodicity() const { return periodicity_; }
  bool has_own_period() const { return own_period_; }  // that no law gives

  // The section goes through this state, with the link turning at about this speed [rad/s].
  void go_through(State state, std::vector<char> sticks_throughout, double link_speed);
  const PoincareSection& section() const { return *section_; }
  std::size_t size() const { return section_->size(); }
  double section_angle() const { return section_angle_; }  // φ₀ [rad]
  // Takes section, period, sense of rotation and limits of a round over from a map of a like machine.
  void follow(const ReturnMap& other);

  enum class End { returned, stands, turns_back, too_slow, failed, interrupted };
  struct Image {
    End end = End::failed;
    std::string why;             // in words, unless it returned
    Eigen::VectorXd z;           // P(z), scaled
    double time = 0;             // that the round took [s]
    double link_angle = 0;       // where it ended [rad]
    double turned = 0;           // by the link [rad]
    Eigen::MatrixXd derivative;  // ∂P/∂z, if asked for
    Eigen::RowVectorXd slowing;  // ∂(time)/∂z [s], if asked for
    double uncertain = 0;        // of an entry of the derivative, by the tolerances of the round
    bool grazed = false;         // an event was only just touched: the derivative is uncertain
  };
  // Observers see the round. Where joints jam, at its begin or its end too, it fails in words.
  Image image(const Eigen::VectorXd& z, bool with_derivative, const std::vector<Observer*>& observers = {});

  // Runs the machine through one cycle from a quasi-static state with the link at this speed [rad/s], puts the section
  // where nothing happens, and returns the state there. end tells whether it came round.
  Image approach(double link_speed);
  // The same from any state.
  Image approach_from(State state);

  // The state of z for another set of equations of the same model; sets their modes.
  std::vector<double> place(Equations& equations, const Eigen::VectorXd& z) const {
    return section_->place(equations, z);
  }
  double start_time() const { return section_->state().t; }
  // End of a round for those who run the machine themselves: falls through zero after `rounds` of them.
  std::function<double(double, std::span<const double>)> round_end(Equations& equations, std::span<const double> y,
                                                                   double rounds = 1) const;
  // Effort so far, in cycles: a round counts as its cycles, one with derivative as (size() + 1) times that by variational
  // equations, 2 size() + 1 times by differences.
  double cost() const { return cost_; }
  // Of a round with derivative, in rounds.
  double derivative_cost() const { return (variational_ ? 1.0 : 2.0) * static_cast<double>(size()) + 1; }
  double time_limit() const { return time_limit_; }
  const ReturnMapOptions& options() const { return options_; }
  // The direction, scaled, in which z moves with time alone: along it a machine with a period of its own is at home
  // everywhere. Zero for any other, and where commands or laws over time say when a round begins.
  Eigen::VectorXd along_the_motion(const Eigen::VectorXd& z);
  // Derivatives come from variational equations with their jumps; else from differences.
  bool variational() const { return variational_; }

 private:
  Image approach_as_given(double from);
  Image round_from(State state);
  Image round_of(const Eigen::VectorXd& z, bool with_derivative, const std::vector<Observer*>& observers);
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
  bool variational_ = true;  // the derivative comes from variational equations, else from differences
  std::optional<PoincareSection> section_;
  double section_angle_ = 0, sense_ = 1, time_limit_ = 0, cost_ = 0;
  std::int64_t most_flow_calls_ = 0;  // of a round: many times those of the first one that came round; 0: not known yet
};

// A fixed point of the map.
struct SteadyPoint {
  bool found = false;
  std::string why;  // in words, unless it was found
  ReturnMap::End end = ReturnMap::End::returned;
  Eigen::VectorXd z, first;  // the point, and the image of the guess
  Eigen::MatrixXd derivative;
  std::vector<std::complex<double>> multipliers;  // largest first
  double multiplier_error = 0;                    // of the largest, by what the derivative is good for
  // Found by running alone: what further rounds would still add to z. Empty: found by Newton's method.
  Eigen::VectorXd to_come;
  double time = 0;                  // of one round [s]
  double turned = 0;                // by the link in it [rad]
  double residual = 0;              // largest of |P(z) − z|, scaled
  int rounds = 0, derivatives = 0;  // of the map, and how many of them with derivative
  double cost = 0;                  // [cycles]
  bool grazed = false;
  bool vibrates() const { return std::abs(turned) <= 1e-8; }  // the link does not turn in the mean
  double largest() const { return multipliers.empty() ? 0 : std::abs(multipliers.front()); }
  // One of a family: the multiplier is not to be told from 1. A machine that is merely slow is not.
  bool neutral() const { return !multipliers.empty() && std::abs(largest() - 1) <= multiplier_error; }
  bool unstable() const { return largest() > 1 + multiplier_error; }
  double still_to_come() const { return to_come.size() > 0 ? to_come.cwiseAbs().maxCoeff() : 0; }
  void take(const Eigen::VectorXd& at, const ReturnMap::Image& image);
};

// By Newton from a guess. `enough`: residual at which it ends.
SteadyPoint find_steady(ReturnMap& map, const Eigen::VectorXd& guess, double enough = 1e-10);

// Where the run itself goes: a few rounds, and by how much they shrink from one to the next. Not found where a round
// changes more than `enough`, or where nothing tells that rounds shrink.
SteadyPoint find_by_rounds(ReturnMap& map, const Eigen::VectorXd& guess, double enough);

// A map of a like machine, or of the same one, with this tolerance; its section, period and limits are those of the map.
std::shared_ptr<ReturnMap> looser_map(const ReturnMap& map, double tolerance,
                                      std::shared_ptr<const Model> model = nullptr);

// The same motion by a looser map: what differs is the error of all that is read from the motion. What the run alone came to,
// is moved by what is still to come; a member of a family, and what an event only just touches, is kept as it is. `point` is
// not found where the looser search comes to another motion.
struct SteadyTwin {
  std::shared_ptr<ReturnMap> map;
  SteadyPoint point;
};
SteadyTwin looser_twin(const ReturnMap& map, const SteadyPoint& point, double tolerance,
                       std::shared_ptr<const Model> model = nullptr);

// Eigenvalues, largest magnitude first.
std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative);

}  // namespace kurbel
