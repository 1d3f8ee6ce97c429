// figure_text.cpp — figures in tiles, sentences and tables.
#include "studies/findings/figure_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/scene/units.h"
#include "studies/claims/headline.h"
#include "studies/findings/report.h"

namespace kurbel {

TileText tile_text(const Estimate& estimate, int digits) {
  const FigureText text = figure_text(estimate);
  std::string known = digits > 0 ? rounded_number(estimate.value, digits) : text.value;
  std::string error = error_is_visible(estimate, text) ? text.error : "";
  if (significant_digits(known) <= headline_digits) return {std::move(known), "", std::move(error)};
  return {headline_number(estimate.value), std::move(known), std::move(error)};
}

std::string with_error(const Estimate& estimate, std::string_view unit, int most_digits) {
  const FigureText text = figure_text(estimate, most_digits);
  const std::string its = unit.empty() ? "" : " " + pretty_unit(unit);
  if (!error_is_visible(estimate, text)) return text.value + its;
  if (*estimate.error < std::abs(estimate.value)) return text.value + " " + text.error + its;
  return "less than " + readable(rounded_number(std::abs(estimate.value) + *estimate.error, 2)) + its;
}

std::string short_text(double value, const std::string& si_unit, const SpeedUnit& speed) {
  const ReadableUnit unit = readable_unit(value, si_unit, speed);
  const std::string number = headline_number(unit.factor * value);
  return unit.unit.empty() ? number : number + " " + pretty_unit(unit.unit);
}

Estimate without_rounding(Estimate value, double scale) {
  if (!value.error && std::abs(value.value) < 1e-12 * scale) value.value = 0;
  return value;
}

std::string duration_text(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.3g} µs", 1e6 * seconds)
         : seconds < 1  ? fmt::format("{:.3g} ms", 1e3 * seconds)
                        : fmt::format("{:.3g} s", seconds);
}

namespace {
std::string cell_of(const FigureText& text) { return text.error.empty() ? "not measured" : text.error; }
}  // namespace

FigureCells figure_cells(const Estimate& estimate, const std::string& si_unit, const SpeedUnit& speed,
                         int most_digits) {
  const bool turns = si_unit == "rad/s";
  const Estimate shown = turns ? estimate / speed.size : estimate;
  const FigureText text = figure_text(shown, most_digits);
  return {text.value, most_digits == digits_in_tables ? cell_of(text) : error_cell(shown),
          pretty_unit(turns ? speed.name : si_unit)};
}

std::string error_cell(const Estimate& estimate) { return cell_of(figure_text(estimate)); }

}  // namespace kurbel
