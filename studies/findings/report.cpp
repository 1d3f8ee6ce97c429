// report.cpp — helpers for filling a report: colours, readable units, versions in the footer.
#include "studies/findings/report.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "engine/scene/units.h"
#include "studies/findings/plots.h"

namespace kurbel {

Role further_role(std::size_t i) {
  constexpr Role roles[] = {Role::orange, Role::green, Role::vermillion, Role::purple, Role::sky, Role::elastic};
  return roles[i % std::size(roles)];
}

ReportSection& Report::add(const std::string& section_title) {
  sections.push_back({section_title, {}});
  return sections.back();
}

ReadableUnit readable_unit(double largest, const std::string& si_unit, const SpeedUnit& speed) {
  largest = std::abs(largest);
  if (si_unit == "rad/s") return {speed.name, speed.of(1)};
  if (si_unit == "m") return largest < 2 ? ReadableUnit{"mm", 1e3} : ReadableUnit{"m", 1};
  if (si_unit == "N" || si_unit == "N*m" || si_unit == "J" || si_unit == "W" || si_unit == "N*m/rad") {
    const std::string unit = pretty_unit(si_unit);
    if (largest >= 2e6) return {"M" + unit, 1e-6};
    if (largest >= 2e3) return {"k" + unit, 1e-3};
    return {unit, 1};
  }
  if (si_unit == "Pa" && largest >= 2e5) return {"MPa", 1e-6};
  if (si_unit == "rad") return largest < 0.2 ? ReadableUnit{"mrad", 1e3} : ReadableUnit{"rad", 1};
  return {pretty_unit(si_unit), 1};
}

ReadableUnit unit_on_tile(double value, const std::string& unit) {
  constexpr double large = 1e4;
  return unit == "rad/s" || !(std::abs(value) >= large) ? ReadableUnit{unit, 1} : readable_unit(value, unit);
}

std::string report_footer() {
  return fmt::format("kurbel {} · g++ {} · Plotly.js 3.7.0 (basic)", KURBEL_VERSION, __VERSION__);
}

}  // namespace kurbel
