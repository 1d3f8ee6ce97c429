// fit_record.h — measured records for a fit: points over time, over the angle of a period, or modes; one cycle, a
// mean with its scatter, or many cycles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/measured/measurement.h"
#include "studies/variants/machine.h"

namespace kurbel {

enum class Over { time, angle, mode };
// "time", "angle", "modes"; throws std::invalid_argument for another word.
Over over_named(const std::string& word);
inline const char* name_of(Over over) { return over == Over::time ? "time" : over == Over::angle ? "angle" : "mode"; }

// A record as described by the user.
struct RecordRequest {
  std::string name, file;      // "half", "half.csv"
  MachineQuestion scene = {};  // the machine on which it was measured
  Over over = Over::angle;
  std::vector<std::string> maps = {};     // "speed=speed.engine", "c*=speed.engine", "sd=scatter of speed.engine"
  int cycles = 1;                         // number of cycles averaged, if a column gives their scatter
  double window = 0;                      // averaging width of a point, half on either side [s or rad]
  std::string teeth = {};                 // "60-2": the speed column contains the tooth times of an encoder
  std::string hold_by = {};               // steady: the quantity that holds the mean speed; empty: none
  std::optional<double> mean_speed = {};  // speed to be held; none: that of the record [rad/s]
  std::vector<double> orders = {};        // orders of the reduction link to compare; empty: all points
};

struct RecordChannel {
  std::string channel, unit;                     // SI
  std::vector<double> mean;                      // at the abscissae of the record
  std::vector<double> scatter = {};              // standard deviation of single cycles, per point; empty: not given
  std::vector<std::vector<double>> cycles = {};  // each like the mean; empty: not given
  bool has_scatter() const { return !scatter.empty(); }
};

struct FitRecord {
  std::string name, file;
  Over over = Over::angle;
  std::vector<double> at;          // [s], [rad], or mode numbers
  std::vector<double> reach = {};  // a point is the mean over at ± reach; empty: a local value
  std::vector<RecordChannel> channels;
  double period = 0;            // over the angle: the machine's cycle [rad]
  int cycles = 1;               // that were averaged
  std::string gaps = {};        // which rows are omitted
  double machine_error = 1e-7;  // of the simulated values, over the greatest: lower limit of deviations
};

// Throws SceneError and std::invalid_argument: a file that cannot be read, a map to an unknown channel, a record
// shorter than a period, a channel that does not vary.
FitRecord read_record(const RecordRequest& request);

// Mean over time of a channel over the angle, by the link's speed: 2π n/∮ dφ/ω [rad/s]. Empty: no such channel.
std::optional<double> mean_speed_of(const FitRecord& record);

// Weights of a sum over the points of a record over the angle: ∮ y dφ/Φ ≈ Σ w y.
std::vector<double> weights_over(const FitRecord& record);

}  // namespace kurbel
