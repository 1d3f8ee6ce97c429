// figure_errors.h — rounding errors of figures from closed forms, and the tables that show them.
//
// Backward error: each given number, and each intermediate result used by others, is changed by a small part h of
// itself (2⁻³⁰; values in modules by h of 1 + |x|). The uncertainty of a figure f is the effect of a few units of
// rounding at all of these places,
//
//     Δf = 8 ε (|f| + s + Σₖ |f(k moved) − f|/h),   ε = 2⁻⁵²,
//
// with the larger of the changes down and up, and s the size of terms whose difference is f. Given numbers are exact:
// manufacturing tolerances are not included.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "drivetrain/gears/bevel_worm.h"
#include "drivetrain/gears/gear_pair.h"
#include "studies/findings/rows.h"

namespace kurbel {

inline constexpr double in_millimetres = 1e3;  // a length [m] times this is in mm
inline constexpr double part_moved = 0x1p-30;
inline constexpr double units_of_rounding = 8 * std::numeric_limits<double>::epsilon();

// The same object with one number changed down, and up; empty if no such object exists.
template <class T>
using Moved = std::vector<std::array<std::optional<T>, 2>>;

Moved<GearPair> moved(const GearPair& pair);
Moved<BevelPair> moved(const BevelPair& pair);
Moved<WormPair> moved(const WormPair& pair);

// Δf of `get`, in its unit; NaN if the figure is not finite, or if no changed object has it.
template <class T, class Get>
double error_by_rounding(const T& here, const Moved<T>& moved, Get get, double terms = 0) {
  const double value = std::invoke(get, here);
  double sum = std::abs(value) + terms;
  for (const auto& both : moved) {
    double most = -1;
    for (const std::optional<T>& other : both)
      if (other) most = std::max(most, std::abs(static_cast<double>(std::invoke(get, *other)) - value));
    if (!(most >= 0)) return std::numeric_limits<double>::quiet_NaN();
    sum += most / part_moved;
  }
  return std::isfinite(sum) ? units_of_rounding * sum : std::numeric_limits<double>::quiet_NaN();
}

// Largest known one; NaN: none is known.
double largest_error(std::span<const double> errors);
// As text, in its unit: rounded up to one digit, to two if the first is a 1, "2e-13", "1.2"; "0": exact; "—": not known.
std::string error_text(double error);
// A number as text, cut to the place where its error begins; `rounding` becomes the largest change by that.
std::string ended_at_error(std::string number, double error, double& rounding);
// Factor from SI to a unit used for gears: 1000 for "mm" and "mrad".
double in_unit(const std::string& unit);

// One row per quantity: name, symbol, a value for each object, their largest error, unit. For programs a record per
// object, with KEY and KEY_error.
template <class T>
class MeasuredQuantities {
 public:
  using Get = std::function<double(const T&)>;
  using ErrorOf = std::function<double(std::size_t thing, const Get&)>;

  MeasuredQuantities(std::string title, std::vector<std::string> headings, std::span<const T> things, ErrorOf error)
      : title_(std::move(title)),
        headings_(std::move(headings)),
        things_(things),
        error_(std::move(error)),
        records_(things.size()) {
    headings_.insert(headings_.end() - 1, "numerical error");
  }
  template <class Of, class Read = ReadAs>
  MeasuredQuantities& quantity(const std::string& key, std::string name, std::string symbol, std::string unit, Of get,
                               Read read = {}) {
    return add<Of>(key, {std::move(name), std::move(symbol)}, std::move(unit), get, read, error_);
  }
  // For an error other than rounding.
  template <class Of, class Read = ReadAs>
  MeasuredQuantities& quantity_with(ErrorOf error, const std::string& key, std::string name, std::string symbol,
                                    std::string unit, Of get, Read read = {}) {
    return add<Of>(key, {std::move(name), std::move(symbol)}, std::move(unit), get, read, error);
  }
  template <class Of>
  MeasuredQuantities& only_for_programs(const std::string& key, Of get) {
    report<Of>(key, get, error_);
    return *this;
  }
  Rows rows() const {
    Rows table = words_table(title_, headings_, lines_);
    table.text_columns = table.text_columns_on_terminal = 2;
    return table;
  }
  const std::vector<Record>& records() const { return records_; }

 private:
  // Floating-point results have an error; counts and flags do not.
  template <class Of>
  static constexpr bool is_measured = std::is_floating_point_v<std::decay_t<std::invoke_result_t<Of, const T&>>>;

  template <class Of, class Read>
  MeasuredQuantities& add(const std::string& key, std::vector<std::string> line, std::string unit, const Of& get,
                          const Read& read, const ErrorOf& error) {
    const std::vector<double> errors = report<Of>(key, get, error);
    const double largest = in_unit(unit) * largest_error(errors);
    double rounding = 0;
    for (const T& thing : things_) {
      line.push_back(ended_at_error(read_as(std::invoke(get, thing), read), largest, rounding));
    }
    line.push_back(errors.empty() ? "0" : error_text(largest + rounding));
    line.push_back(std::move(unit));
    lines_.push_back(std::move(line));
    return *this;
  }
  template <class Of>
  std::vector<double> report(const std::string& key, const Of& get, const ErrorOf& error) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < things_.size(); ++i) {
      Value value = std::invoke(get, things_[i]);
      if constexpr (is_measured<Of>) {
        errors.push_back(error(i, [&](const T& thing) { return std::invoke(get, thing); }));
        value = Estimate{std::invoke(get, things_[i]), errors.back()};
      }
      if (!key.empty()) records_[i].push_back({key, std::move(value)});
    }
    return errors;
  }

  std::string title_;
  std::vector<std::string> headings_;
  std::span<const T> things_;
  ErrorOf error_;
  Lines lines_;
  std::vector<Record> records_;
};

}  // namespace kurbel
