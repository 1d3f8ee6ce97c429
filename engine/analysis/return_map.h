// return_map.h — the machine's state from one cycle to the next: the map, its derivative, and its fixed points.
//
//     z ↦ P(z), steady motion P(z*) = z*, Floquet multipliers = eigenvalues of ∂P/∂z at z*
// A machine that knows no time: the section is the reduction link at an angle φ₀ (mod its cycle), z = [twists, speeds].
// A machine driven by time: the map runs over the common period of all that depends on it, and where angles matter too
// the link's angle is one of the unknowns; beside a prescribed speed it follows from the twists.
// Unknowns are scaled: twists by rated torque over stiffness, speeds by the rated speed.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/analysis/newton.h"
#include "engine/analysis/periodicity.h"
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

  std::size_t size() const { return size_; }
  const Model& model() const { return *shared_; }
  std::shared_ptr<const Model> shared_model() const { return shared_; }
  const Periodicity& periodicity() const { return periodicity_; }
  double section() const { return section_; }  // φ₀ [rad]
  // Takes section, sense of rotation and limits over from a map of a like machine.
  void follow(const ReturnMap& other);

  enum class End { returned, stands, turns_back, too_slow, failed, interrupted };
  struct Image {
    End end = End::failed;
    std::string why;             // in words, unless it returned
    Eigen::VectorXd z;           // P(z), scaled
    double time = 0;             // that the round took [s]
    double link_angle = 0;       // where it ended [rad]
    Eigen::MatrixXd derivative;  // ∂P/∂z, if asked for
    Eigen::RowVectorXd slowing;  // ∂(time)/∂z [s], if asked for
    bool grazed = false;         // an event was only just touched: the derivative is uncertain
  };
  // Observers see the round.
  Image image(const Eigen::VectorXd& z, bool with_derivative, const std::vector<Observer*>& observers = {});

  // Runs the scene's machine through one cycle from a quasi-static state with the link at this speed [rad/s], puts the
  // section where nothing happens, and returns the state there. end tells whether it came round.
  Image approach(double link_speed);

  // The state of z for another set of equations of the same model; sets their modes.
  std::vector<double> place(Equations& equations, const Eigen::VectorXd& z) const;
  double start_time() const { return start_time_; }
  // End of a round for those who run the machine themselves: falls through zero after `rounds` of them.
  std::function<double(double, std::span<const double>)> round_end(Equations& equations, std::span<const double> y,
                                                                   double rounds = 1) const;
  std::string unknown_name(std::size_t i) const;
  // Effort so far, in cycles: a round counts as its cycles, one with derivative as (size() + 1) times that.
  double cost() const { return cost_; }
  double time_limit() const { return time_limit_; }

 private:
  double link_angle_of(const Eigen::VectorXd& z) const;
  Eigen::MatrixXd first_directions() const;
  Eigen::VectorXd unknowns_of(std::span<const double> y, double link_angle) const;
  void read_derivative(const Eigen::MatrixXd& directions, std::span<const double> rate, Image& image) const;
  Image judge(const RunOutcome& outcome, double link_begin, Equations& equations) const;

  std::shared_ptr<const Model> shared_;
  ReturnMapOptions options_;
  Equations equations_;
  Periodicity periodicity_;
  std::size_t size_ = 0;
  bool angle_unknown_ = false;
  int fixed_shaft_ = -1;  // its speed is prescribed
  double section_ = 0, sense_ = 1, start_time_ = 0, time_limit_ = 0, windings_ = 0, cost_ = 0;
  std::vector<double> scale_;                        // of the unknowns
  std::vector<std::vector<double>> angle_by_twist_;  // per elastic joint, per shaft
};

// A fixed point of the map.
struct SteadyPoint {
  bool found = false;
  std::string why;  // in words, unless it was found
  ReturnMap::End end = ReturnMap::End::returned;
  Eigen::VectorXd z;
  Eigen::MatrixXd derivative;
  std::vector<std::complex<double>> multipliers;  // largest first
  double time = 0;                                // of one round [s]
  double residual = 0;                            // largest of |P(z) − z|, scaled
  int rounds = 0, derivatives = 0;                // of the map, and how many of them with derivative
  double cost = 0;                                // [cycles]
  bool grazed = false;
  double largest() const { return multipliers.empty() ? 0 : std::abs(multipliers.front()); }
  void take(const Eigen::VectorXd& at, const ReturnMap::Image& image);
};

// By Newton from a guess. `enough`: residual at which it ends.
SteadyPoint find_steady(ReturnMap& map, const Eigen::VectorXd& guess, double enough = 1e-10);

// Eigenvalues, largest magnitude first.
std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative);

}  // namespace kurbel
