// figures.h — what a study found in numbers: figures with unit and measured error, quantities over time.
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kurbel {

// A figure. In SI: speeds in rad/s.
struct FigureValue {
  std::string name;  // "peak_torque.main_coupling"; what it means: kurbel explain
  double value = 0;
  std::string unit;             // "N*m"; empty: a plain number
  std::optional<double> error;  // measured by further runs; empty: not measured
  std::optional<double> at;     // the moment that it belongs to [s]
};

class FigureValues {
 public:
  FigureValues() = default;
  explicit FigureValues(std::vector<FigureValue> all) : all_(std::move(all)) {}
  // Null where there is none of this name.
  const FigureValue* find(const std::string& name) const;
  // Throws std::out_of_range with the nearest names.
  const FigureValue& operator[](const std::string& name) const;
  std::size_t size() const { return all_.size(); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

 private:
  std::vector<FigureValue> all_;
};

// One quantity over time, in the memory of the run that recorded it, which it keeps: value i lies at data()[i · stride].
class TimeSeries {
 public:
  TimeSeries() = default;
  TimeSeries(std::shared_ptr<const void> kept, const double* data, std::size_t size, std::size_t stride)
      : kept_(std::move(kept)), data_(data), size_(size), stride_(stride) {}
  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const { return data_[i * stride_]; }
  const double* data() const { return data_; }
  std::size_t stride() const { return stride_; }
  const std::shared_ptr<const void>& kept() const { return kept_; }

 private:
  std::shared_ptr<const void> kept_;
  const double* data_ = nullptr;
  std::size_t size_ = 0, stride_ = 1;
};

// Quantities over time: at equidistant times and, between them, at the peaks that are figures. The rows of trajectory.csv.
class Trajectory {
 public:
  Trajectory() = default;
  Trajectory(std::shared_ptr<const void> kept, const std::vector<double>* time, const std::vector<double>* values,
             std::vector<std::string> names, std::vector<std::string> units)
      : kept_(std::move(kept)), time_(time), values_(values), names_(std::move(names)), units_(std::move(units)) {}
  const std::vector<std::string>& names() const { return names_; }  // "speed.press", "torque.main_coupling"
  const std::vector<std::string>& units() const { return units_; }  // SI, in the order of the names
  std::size_t rows() const { return time_ ? time_->size() : 0; }
  TimeSeries time() const { return time_ ? TimeSeries(kept_, time_->data(), time_->size(), 1) : TimeSeries(); }
  // Throws std::out_of_range with the nearest names.
  TimeSeries operator[](const std::string& name) const;

 private:
  std::shared_ptr<const void> kept_;
  const std::vector<double>*time_ = nullptr, *values_ = nullptr;  // row by row
  std::vector<std::string> names_, units_;
};

}  // namespace kurbel
