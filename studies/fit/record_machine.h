// record_machine.h — the machine of a record: its response with given unknowns, converted to the compared values.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/matrices/linear_algebra.h"
#include "studies/fit/unknowns.h"
#include "studies/measured/alignment.h"
#include "studies/steady/steady.h"

namespace kurbel {

// A signal of the machine. Over the angle time passes as 1/ω: `pace`. Over time, of a speed with an encoder's pattern,
// the `angle` of its shaft.
struct ShownSignal {
  Signal signal;
  std::optional<Signal> pace = {}, angle = {};
  // ∫ y dt/∫ dt over x ± reach, by the midpoints of equal parts.
  double mean(double x, double reach) const;
};

// The response of the machine over the record's axis.
struct Response {
  std::string failed;  // reason of failure; empty: success
  std::vector<ShownSignal> channels = {};
  std::vector<std::vector<double>> modes = {};  // per channel, at the record's rows
  std::optional<HeldQuantity> held = {};
};

// The machine of one record or prediction. May be copied: each thread has its own.
class RecordMachine {
 public:
  // Refuses, like the scene's reader, unknown keys and ranges that exceed a key's domain.
  RecordMachine(const RecordRequest& request, const FitRecord& record, std::size_t number,
                const std::vector<Unknown>& unknowns);

  // Response with scaled unknowns u, with `effects` instead of the scene's, if given.
  Response at(const Eigen::VectorXd& u, const Effects* effects = nullptr);
  bool depends_on(std::size_t unknown) const;
  const Scene& scene_at(const Eigen::VectorXd& u) { return varied_.at(values_of(u)); }
  // "rotor.inertia=0.0123 kg*m2" for each key of this machine, and for the quantity that held the speed.
  std::vector<std::string> settings_at(const Eigen::VectorXd& u, const std::optional<HeldQuantity>& held) const;
  const std::vector<std::size_t>& keys() const { return keys_; }

 private:
  std::vector<double> values_of(const Eigen::VectorXd& u) const;
  void change_tables(Scene& scene, const Eigen::VectorXd& u) const;
  Response run(const Scene& scene, const Effects& effects) const;
  Response cycle(const Scene& scene, const Effects& effects) const;
  Response modes(const Scene& scene) const;

  RecordRequest request_;
  std::shared_ptr<const FitRecord> record_;
  std::vector<Unknown> unknowns_;
  std::vector<std::size_t> keys_, tables_;  // unknowns that are keys; unknowns that change tables
  VariedScene varied_;
  double until_ = 0;
};

// The compared values of a record: its points, or orders of the link's turns, each as real and imaginary part of A
// e^{iψ} = 2 Σ w y e^{−ikφ}, y = A cos(kφ + ψ).
class ComparedRecord {
 public:
  ComparedRecord(const FitRecord& record, const std::vector<double>& orders, std::size_t number);

  Eigen::Index size() const { return data_.size(); }
  const Eigen::VectorXd& data() const { return data_; }
  const Eigen::VectorXd& deviation() const { return deviation_; }  // of each value, for its weight
  const Eigen::VectorXd& scatter() const { return scatter_; }  // of the mean; for channels without it the data's size
  bool of_scatter() const { return of_scatter_; }              // all channels have scatter
  const Eigen::MatrixXd& cycles() const { return cycles_; }    // one row each: cycle − mean; none: not known
  Eigen::Index begin(std::size_t channel) const { return static_cast<Eigen::Index>(channel) * per_channel_; }
  Eigen::Index per_channel() const { return per_channel_; }
  const std::vector<double>& orders() const { return orders_; }

  // The values of the response at the record's points, channel after channel.
  Eigen::VectorXd points_of(const Response& response, const std::vector<Unknown>& unknowns,
                            const Eigen::VectorXd& u) const;
  // From points to the compared values: a linear map.
  Eigen::VectorXd compared(const Eigen::VectorXd& points) const;
  Eigen::VectorXd measured_points() const;
  // Sets the weights from the residual `left` of a fit of which the record determines so many `unknowns`: for a channel without scatter it is the
  // deviation; with scatter the deviation is multiplied by the root of the reduced χ² if that exceeds 1. Correlated
  // values count as one: deviations grow by √τ, τ = 1 + 2 Σ ρ_k.
  void weigh_by(const Eigen::VectorXd& left, double unknowns);
  double widened() const { return widened_; }                             // factor on deviations from scatter
  double length(std::size_t channel) const { return lengths_[channel]; }  // τ ≥ 1: number of correlated values
  double independent() const;                                             // number of values, correlated ones once

 private:
  bool points_scatter_together() const;
  Eigen::MatrixXd cycles_of(const RecordChannel& channel) const;
  Eigen::VectorXd sizes(const Eigen::VectorXd& data) const;

  FitRecord record_;
  std::vector<double> orders_;
  std::size_t number_;
  Eigen::Index per_channel_ = 0;
  Eigen::MatrixXd map_;  // of one channel's points to its orders; empty: points are compared
  Eigen::VectorXd data_, deviation_, scatter_;
  Eigen::MatrixXd cycles_;
  std::vector<double> lengths_;
  bool of_scatter_ = true;
  double widened_ = 1;
};

// For each channel and order if orders are compared: A, ψ.
struct OrderPart {
  Estimate amplitude, phase;  // [rad]
};
OrderPart order_part(double real, double imaginary);

}  // namespace kurbel
