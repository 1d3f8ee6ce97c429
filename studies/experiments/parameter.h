// parameter.h — a parameter of a sweep: a key of the scene and its possible values.
//
//     main_coupling.stiffness=500..1500 kN*m/rad     a range
//     flywheel.inertia=200,400,800 kg*m2             a list
//     press.load.kind=press,none                     a list of words
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace kurbel {

struct SweptParameter {
  std::string path;                             // "main_coupling.stiffness"
  std::string unit = {};                        // as given: "kN*m/rad"; empty: a plain number, or words
  double low = 0, high = 0;                     // of a range, in that unit
  std::vector<double> values = {};              // of a list, in that unit; for words their indices 0, 1, …
  std::vector<std::string> words = {};          // of a list of words
  std::string given = {};                       // as written
  std::string where = {};                       // for a column: file:line:col of its heading
  std::function<double(double)> quantile = {};  // instead of a range or list: the quantile function

  bool is_list() const { return !values.empty(); }
  // Value at the share 0 ≤ u < 1 of the range, or of the list's length; in the unit.
  double at_share(double u) const;
  // The i-th of n equally spaced values including both ends; for a list the i-th entry.
  double at_step(std::size_t i, std::size_t n) const;
  // "812.5 kN*m/rad": reading it gives the same number to the last bit.
  std::string text_of(double value) const;
  // "main_coupling.stiffness=812.5 kN*m/rad"
  std::string setting(double value) const { return path + "=" + text_of(value); }
};

// Throws std::invalid_argument with the allowed form.
SweptParameter parse_parameter(const std::string& text);

// A table of variants: headings name the keys, "flywheel.inertia [kg*m2]"; each row is a variant. Cells may have
// their own units.
struct VariantTable {
  std::vector<SweptParameter> parameters;  // with their lists of values
  std::vector<std::vector<double>> rows;   // one value per parameter
};
// Reads a table file (engine/tables). Throws SceneError with the line.
VariantTable read_variants(const std::string& path);

}  // namespace kurbel
