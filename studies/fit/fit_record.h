// fit_record.h — measured records that a machine is fitted to: points over time, over the angle of a period, or modes;
// once, as a mean with its scatter, or as many cycles.
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

// One of the records, as the user describes it.
struct RecordRequest {
  std::string name, file;      // "half", "half.csv"
  MachineQuestion scene = {};  // whose machine it was measured on
  Over over = Over::angle;
  std::vector<std::string> maps = {};     // "speed=speed.engine", "c*=speed.engine", "sd=scatter of speed.engine"
  int cycles = 1;                         // that a mean is of, where a column gives their scatter
  double window = 0;                      // a point is the mean over so much, half of it on either side [s or rad]
  std::string teeth = {};                 // "60-2": the column of a speed holds the times of an encoder's teeth
  std::string hold_by = {};               // steady: the quantity that keeps the mean speed; empty: none
  std::optional<double> mean_speed = {};  // to be kept; none: the record's own [rad/s]
  std::vector<double> orders = {};        // of the reduction link that are compared; empty: all points
};

struct RecordChannel {
  std::string channel, unit;                     // SI
  std::vector<double> mean;                      // at the places of the record
  std::vector<double> scatter = {};              // deviation of one cycle, at each place; empty: not given
  std::vector<std::vector<double>> cycles = {};  // each as the mean; empty: not given
  bool has_scatter() const { return !scatter.empty(); }
};

struct FitRecord {
  std::string name, file;
  Over over = Over::angle;
  std::vector<double> at;          // [s], [rad], or the numbers of modes
  std::vector<double> reach = {};  // a point is the mean over at ± reach; empty: at the point
  std::vector<RecordChannel> channels;
  double period = 0;            // over the angle: of the machine's cycle [rad]
  int cycles = 1;               // that the mean is of
  double machine_error = 1e-7;  // of what the machine shows, over its greatest value: no deviation is below it
};

// Throws SceneError and std::invalid_argument: a file that cannot be read, a map that leads nowhere, a record shorter than
// a period, a channel that does not vary.
FitRecord read_record(const RecordRequest& request);

// Mean over time of a channel over the angle, by the link's speed: 2π n/∮ dφ/ω [rad/s]. Nothing: no such channel.
std::optional<double> mean_speed_of(const FitRecord& record);

// Weights of a sum over the places of a record over the angle: ∮ y dφ/Φ ≈ Σ w y.
std::vector<double> weights_over(const FitRecord& record);

}  // namespace kurbel
