// fit_problem.h — machines and records as one least-squares problem: residuals and derivatives by runs in threads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/watch.h"
#include "studies/fit/bounded_fit.h"
#include "studies/fit/record_machine.h"

namespace kurbel {

class FitProblem {
 public:
  // Throws as read_record, parse_unknowns and RecordMachine do; std::invalid_argument if there are more unknowns than data.
  FitProblem(std::vector<RecordRequest> requests, const std::vector<std::string>& free, int jobs, Watch watch);

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  const std::vector<RecordRequest>& requests() const { return requests_; }
  const std::vector<FitRecord>& records() const { return records_; }
  const std::vector<ComparedRecord>& comparisons() const { return comparisons_; }
  const std::vector<RecordMachine>& machines() const { return machines_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(unknowns_.size()); }
  std::size_t values_compared() const;

  // Values in the scenes, limited to the bounds; the middle of the range if no scene gives the value.
  Eigen::VectorXd given() const;
  // Chooses the steps of the derivatives so that errors of the runs are below a thousandth of each difference, within
  // 0.001 … 0.05 of the range; second differences over 1e-7 of it show these errors (Moré, Wild 2011). False: the
  // machine does not run there, see failure().
  bool choose_steps(const Eigen::VectorXd& u);
  double noise() const { return noise_; }  // largest relative error of the derivatives

  // Starts from u. Only `active` records count; `effects` replaces the effects for single records.
  BoundedFit fit(const Eigen::VectorXd& u, int most_steps = 40);
  std::vector<bool> active;
  std::vector<std::optional<Effects>> effects;

  // Residuals over deviations for all active records, 0 for the others. Empty: one cannot be computed.
  std::optional<Eigen::VectorXd> residuals(const Eigen::VectorXd& u);
  const std::vector<Response>& responses() const { return responses_; }  // of the last u
  const std::string& failure() const { return failure_; }
  std::size_t runs() const { return runs_; }

  Eigen::VectorXd deviations() const;  // of all records' values
  // The values of a record to be compared, at u. From the responses at the last u.
  Eigen::VectorXd shown(std::size_t record, const Eigen::VectorXd& u) const;
  // Weights a record, of which it determines so many of the unknowns, by its residuals, from the responses at the last u.
  void weigh(std::size_t record, const Eigen::VectorXd& u, double determined) {
    comparisons_[record].weigh_by(shown(record, u) - comparisons_[record].data(), determined);
  }
  std::size_t unknowns_of(std::size_t record) const;  // number of unknowns that may affect it

  // Runs of one machine at many u, in threads. Throws OutOfTime on interruption.
  std::vector<Response> responses_of(const RecordMachine& machine, const std::vector<Eigen::VectorXd>& at);
  // u decreased and increased by the unknown's step, within the bounds.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> around(const Eigen::VectorXd& u, std::size_t unknown, double step) const;
  double step_of(std::size_t unknown) const { return steps_[unknown]; }

 private:
  struct Item {
    std::size_t machine = 0;
    Eigen::VectorXd u;
  };
  std::vector<Response> compute(const std::vector<RecordMachine>& machines, const std::vector<Item>& items);
  // u decreased and increased by each unknown's step; u itself if the machine does not run there, or at a bound.
  struct Sides {
    Eigen::VectorXd below, above;      // u
    Eigen::VectorXd r_below, r_above;  // residuals
  };
  std::optional<std::vector<Sides>> sides(const Eigen::VectorXd& u, const std::vector<double>& steps);
  std::optional<Eigen::MatrixXd> derivative(const Eigen::VectorXd& u);
  Eigen::VectorXd stacked(const std::vector<Response>& responses, const Eigen::VectorXd& u) const;

  std::vector<RecordRequest> requests_;
  std::vector<FitRecord> records_;
  std::vector<Unknown> unknowns_;
  std::vector<RecordMachine> machines_;
  std::vector<ComparedRecord> comparisons_;
  std::vector<double> steps_;
  int jobs_;
  Watch watch_;
  double noise_ = 0;
  std::vector<Response> responses_;
  std::string failure_;
  std::size_t runs_ = 0;
};

}  // namespace kurbel
