// heading.h — a column's heading: its name and its unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kurbel {

// "speed [rad/s]", "torque (N*m)", "n / min^-1", "time in s"; a text in [] is a unit, known or not; in the other forms only
// known units count. "[-]" and "[1]" are plain numbers.
struct NameWithUnit {
  std::string name;
  std::optional<std::string> unit;
};
NameWithUnit name_with_unit(std::string_view heading);

// A cell of a line of units: "N*m", "[N*m]", "-"; empty if the cell is empty or not a unit.
std::optional<std::string> unit_in_cell(std::string_view cell);

}  // namespace kurbel
