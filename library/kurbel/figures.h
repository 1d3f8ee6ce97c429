// figures.h — results of a study as numbers: figures with unit and measured error, quantities over time.
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <kurbel/estimate.h>

namespace kurbel {

// A figure, in SI: speeds in rad/s. Its error ± is measured by further runs; empty: not measured.
struct FigureValue : Estimate {
  std::string name;          // "peak_torque.main_coupling"; for its meaning: kurbel explain
  std::string unit;          // "N*m", of value and error; empty: a plain number
  std::optional<double> at;  // time at which it occurs [s]; empty: none
  std::string of = {};       // the model that it belongs to, if a study has several: "rigid"; empty: the only one
};
// Definition, formula, unit and limits of meaning of the figures with this name or these words. Throws
// std::invalid_argument with the nearest names.
std::string explain(const std::string& figure);
std::vector<std::string> explained_figures();  // the names that explain() knows: "delta", "peak_torque", …

// All figures of a run by name, in the order of the report.
class FigureValues {
 public:
  FigureValues() = default;
  explicit FigureValues(std::vector<FigureValue> all) : all_(std::move(all)) {}  // for kurbel itself
  // The figure of this name; null if there is none.
  const FigureValue* find(const std::string& name) const;
  // The figure of this name. Throws std::out_of_range with the nearest names.
  const FigureValue& operator[](const std::string& name) const;
  std::size_t size() const { return all_.size(); }  // how many there are
  auto begin() const { return all_.begin(); }       // of FigureValue, for range-based loops
  auto end() const { return all_.end(); }           // behind the last one

 private:
  std::vector<FigureValue> all_;
};

// One quantity over time, in the memory of the run, which it keeps alive: value i lies at data()[i · stride()].
class TimeSeries {
 public:
  TimeSeries() = default;
  // Moving copies, too: what was moved from is still that series.
  TimeSeries(const TimeSeries&) = default;
  TimeSeries& operator=(const TimeSeries&) = default;  // likewise
  // Refers to memory owned by `kept`.
  TimeSeries(std::shared_ptr<const void> kept, const double* data, std::size_t size, std::size_t stride)
      : kept_(std::move(kept)), data_(data), size_(size), stride_(stride) {}
  std::size_t size() const { return size_; }                             // how many values
  double operator[](std::size_t i) const { return data_[i * stride_]; }  // value i < size(), not checked, in SI
  const double* data() const { return data_; }                           // the first value
  std::size_t stride() const { return stride_; }                         // from value to value, in doubles
  const std::shared_ptr<const void>& kept() const { return kept_; }      // owner of the memory, for other languages

 private:
  std::shared_ptr<const void> kept_;
  const double* data_ = nullptr;
  std::size_t size_ = 0, stride_ = 1;
};

// Quantities over time: at equidistant times and, between them, at the peaks that are figures. The rows of trajectory.csv.
// Empty for a multibody run.
class Trajectory {
 public:
  Trajectory() = default;
  // Moving copies, too: what was moved from is still that trajectory.
  Trajectory(const Trajectory&) = default;
  Trajectory& operator=(const Trajectory&) = default;  // likewise
  // Refers to a recorder's memory: one row of all names at each time.
  Trajectory(std::shared_ptr<const void> kept, const std::vector<double>* time, const std::vector<double>* values,
             std::vector<std::string> names, std::vector<std::string> units)
      : kept_(std::move(kept)), time_(time), values_(values), names_(std::move(names)), units_(std::move(units)) {}
  const std::vector<std::string>& names() const { return names_; }  // "speed.press", "torque.main_coupling"
  const std::vector<std::string>& units() const { return units_; }  // SI, in the order of the names
  std::size_t rows() const { return time_ ? time_->size() : 0; }    // how many times
  // The times [s], ascending.
  TimeSeries time() const { return time_ ? TimeSeries(kept_, time_->data(), time_->size(), 1) : TimeSeries(); }
  // The quantity of this name over time(), in SI. Throws std::out_of_range with the nearest names.
  TimeSeries operator[](const std::string& name) const;

 private:
  std::shared_ptr<const void> kept_;
  const std::vector<double>*time_ = nullptr, *values_ = nullptr;  // row by row
  std::vector<std::string> names_, units_;
};

}  // namespace kurbel
