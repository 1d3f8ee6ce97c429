// parameter.h — what a sweep varies: a key of the scene and the values that it may take.
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
  std::string unit = {};                        // as it was given: "kN*m/rad"; empty: a plain number, or words
  double low = 0, high = 0;                     // of a range, in that unit
  std::vector<double> values = {};              // of a list, in that unit; of words their numbers 0, 1, …
  std::vector<std::string> words = {};          // of a list of words
  std::string given = {};                       // as it was written
  std::string where = {};                       // of a column: file:line:col of its heading
  std::function<double(double)> quantile = {};  // in place of a range or list: the value at a share of the probability

  bool is_list() const { return !values.empty(); }
  // At a share 0 ≤ u < 1 of the range, or of the list's length; in the unit.
  double at_share(double u) const;
  // The i-th of n equally spaced values, the ends among them; of a list its i-th.
  double at_step(std::size_t i, std::size_t n) const;
  // "812.5 kN*m/rad": read back, it is the same number to the last bit.
  std::string text_of(double value) const;
  // "main_coupling.stiffness=812.5 kN*m/rad"
  std::string setting(double value) const { return path + "=" + text_of(value); }
};

// Throws std::invalid_argument in words, with what may stand there.
SweptParameter parse_parameter(const std::string& text);

// A table of variants: its heading names the keys, "flywheel.inertia [kg*m2]"; a row is a variant. Cells may carry units
// of their own.
struct VariantTable {
  std::vector<SweptParameter> parameters;  // their lists of values
  std::vector<std::vector<double>> rows;   // a value of each
};
// From a file of a table (engine/tables). Throws SceneError with the line.
VariantTable read_variants(const std::string& path);

}  // namespace kurbel
