// measure.h — one variant measured as a user would, and its stated errors judged by references.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "studies/findings/result.h"
#include "tests/coverage/variant.h"

namespace kurbel::coverage {

enum class Verdict {
  covered,    // |value − truth| ≤ stated error
  missed,     // more than that
  uncertain,  // the truth itself is known to no more than a tenth of the stated error
  unstated,   // a figure without an error
  unknown     // the references have no such figure
};
const char* name_of(Verdict verdict);

struct JudgedFigure {
  std::string name, unit;
  double value = 0, scale = 0, stated = 0, truth = 0, uncertainty = 0;
  Verdict verdict = Verdict::unknown;
  // What the difference of two runs at tolerances 30 apart would have stated, and whether it would have covered.
  double stated_by_two = 0;
  Verdict by_two = Verdict::unknown;
  // Numbers of blows are whole, and times have no scale of their own: judged apart.
  enum class Kind { value, time, count };
  Kind kind = Kind::value;

  double error() const;
  std::string family() const { return name.substr(0, name.find('.')); }
};

// How the words of a variant begin that came to its end without errors.
inline constexpr const char* no_errors = "no errors were measured";

struct MeasuredVariant {
  std::string scene, method;
  std::uint64_t seed = 0;
  double accuracy = 0;
  bool whole = false;      // measured and judged
  std::string words;       // why not, or why it was not confirmed
  bool confirmed = false;  // the program says that the requested accuracy was reached
  int runs = 0;
  double tolerance = 0;                                // of the run that the figures are from
  std::int64_t flow_calls = 0, flow_calls_of_two = 0;  // of the measurement; of the ladder of two tolerances
  double cpu_seconds = 0;                              // of the measurement
  std::vector<JudgedFigure> figures;
  std::map<std::string, int> refused;  // draws before this one, by reason
};

struct MeasureSettings {
  double budget = 2;            // processor time of one integration [s]
  double reference_budget = 6;  // of one that is a reference [s]
  bool by_two = true;           // compare with two runs at tolerances 30 apart
};

MeasuredVariant measure(const Variant& variant, const MeasureSettings& settings);

// Times that a result states: of figures that are located within the run ("at.peak_torque.shaft"), and of its events
// ("event.clutch.locks#0/3", the first of three of its like: where another run has two, nothing says which of them it is),
// with their errors where they were measured.
struct ReportedTime {
  std::string name;
  double value = 0;
  std::optional<double> error;
};
std::vector<ReportedTime> times_of(const Result& result);

// Figures of like meaning differ by so much: peaks by their magnitude, of two equal ones either may be the larger.
double difference(const std::string& figure, double a, double b);

}  // namespace kurbel::coverage
