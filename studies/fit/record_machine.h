// record_machine.h — the machine of a record: what it shows there with given unknowns, brought to what is compared.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/matrices/linear_algebra.h"
#include "studies/fit/unknowns.h"
#include "studies/measured/alignment.h"
#include "studies/steady/steady.h"

namespace kurbel {

// A signal with its integrals: means over stretches of it. Over the angle time passes as 1/ω: `pace`, its density.
class Averaged {
 public:
  Averaged(const Signal& signal, const Signal* pace);
  double at(double x) const { return signal_.at(x); }
  // ∫ y p dx/∫ p dx over x ± reach.
  double mean(double x, double reach) const;

 private:
  double integral(const std::vector<double>& sums, double x, bool weighted_by_value) const;
  Signal signal_;
  std::optional<Signal> pace_;
  std::vector<double> value_, weight_;  // ∫ y p dx, ∫ p dx up to each point
};

// What the machine shows over the record's axis.
struct Response {
  std::string failed;  // why it shows nothing; empty: it does
  std::vector<Averaged> channels = {};
  std::vector<std::vector<double>> modes = {};  // per channel, at the record's rows
  double begin = 0, end = 0;                    // of what was simulated
  std::optional<HeldQuantity> held = {};
};

// Of one record, a prediction likewise. May be copied: each thread has its own.
class RecordMachine {
 public:
  // Refuses, as the scene's reader does, keys that are none, and ends of ranges beyond a key's domain.
  RecordMachine(const RecordRequest& request, const FitRecord& record, std::size_t number,
                const std::vector<Unknown>& unknowns);

  // With scaled unknowns u. Another set of effects in place of the scene's, where one is given.
  Response at(const Eigen::VectorXd& u, const Effects* effects = nullptr);
  bool depends_on(std::size_t unknown) const;
  const Scene& scene_at(const Eigen::VectorXd& u) { return varied_.at(values_of(u)); }
  // "rotor.inertia=0.0123 kg*m2" for each key that this machine has, and of what held the speed.
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
  std::vector<std::size_t> keys_, tables_;  // unknowns that are its keys; that change its tables
  VariedScene varied_;
  double until_ = 0;
};

// What of a record is compared: its points, or orders of the link's turns, each as real and imaginary part of
// A e^{iψ} = 2 Σ w y e^{−ikφ}, y = A cos(kφ + ψ).
class ComparedRecord {
 public:
  ComparedRecord(const FitRecord& record, const std::vector<double>& orders, std::size_t number);

  Eigen::Index size() const { return data_.size(); }
  const Eigen::VectorXd& data() const { return data_; }
  const Eigen::VectorXd& deviation() const { return deviation_; }  // of each, that weights it
  bool of_scatter() const { return of_scatter_; }                  // deviations are those of cycles, not relative
  const Eigen::MatrixXd& cycles() const { return cycles_; }  // a row each: cycle − mean; none: not known one by one
  Eigen::Index begin(std::size_t channel) const { return static_cast<Eigen::Index>(channel) * per_channel_; }
  Eigen::Index per_channel() const { return per_channel_; }
  const std::vector<double>& orders() const { return orders_; }

  // What a record would show of the response: at its points, a channel behind the other.
  Eigen::VectorXd points_of(const Response& response, const std::vector<Unknown>& unknowns,
                            const Eigen::VectorXd& u) const;
  // The same of what is compared: a linear map of points.
  Eigen::VectorXd compared(const Eigen::VectorXd& points) const;
  Eigen::VectorXd measured_points() const;
  // Of relative weights: by what is left of each channel.
  void weigh_by(const Eigen::VectorXd& residual);

 private:
  FitRecord record_;
  std::vector<double> orders_;
  std::size_t number_;
  Eigen::Index per_channel_ = 0;
  Eigen::MatrixXd map_;  // of one channel's points to its orders; empty: points are compared
  Eigen::VectorXd data_, deviation_;
  Eigen::MatrixXd cycles_;
  bool of_scatter_ = true;
};

// Per channel and order of what is compared by orders: A, ψ.
struct OrderPart {
  double amplitude = 0, phase = 0;  // [rad]
};
OrderPart order_part(double real, double imaginary);

}  // namespace kurbel
