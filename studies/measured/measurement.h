// measurement.h — a measured record: columns of a CSV file as channels of the machine, in SI.
#pragma once

#include <string>
#include <vector>

#include "engine/tables/table_file.h"

namespace kurbel {

// As requested by the user.
struct MeasurementRequest {
  std::string file;                  // "test.csv"
  std::vector<std::string> maps;     // "T1=torque.main_coupling", "T1=torque.main_coupling [kN*m]", "t=time [ms]"
  std::string shift;                 // "0.2 s", "fit"; empty: none
  std::vector<std::string> offsets;  // "T1=5 N*m", "T1=fit", "fit": every column's
  // Abscissa of the rows, as a column or a map names it, in SI: "time", "s"; "angle", "rad"; "mode", "".
  std::string over = "time", over_unit = "s";
  std::size_t fewest_rows = 4;
  bool asked() const { return !file.empty() || !maps.empty() || !shift.empty() || !offsets.empty(); }
};

// Of a workbook the first sheet that has the columns of all maps; else the first.
TableForm form_of(const std::string& file, const std::vector<std::string>& maps);

struct KnownChannel {
  std::string name, unit;  // SI
};

// A value to be identified by least squares, or given.
struct Fitted {
  double value = 0;
  bool fit = false;
};

struct MeasuredSignal {
  std::string column, channel, unit;  // SI
  std::vector<double> values;
  Fitted offset = {};  // subtracted from the readings
};

struct Measurement {
  std::string file;
  std::vector<double> time;  // as measured [s], ascending; for another abscissa its values, in SI
  Fitted shift = {};         // simulated time = measured time + shift [s]
  std::vector<MeasuredSignal> signals;
  bool over_angle = false;        // `time` and shift are angles of the link [rad]
  std::size_t rows_left_out = 0;  // which lack a number of a mapped column
  // "3 of 801 rows of test.csv are omitted: …"; empty: none.
  std::string gaps() const;
};

// Throws SceneError with all errors of file and options and their places, std::invalid_argument if options are missing.
Measurement read_measurement(const MeasurementRequest& request, const std::vector<KnownChannel>& channels);

// Refuses a given shift that leaves no time in common with the simulation. Throws std::invalid_argument.
void require_overlap(const Measurement& measurement, double begin, double end);

}  // namespace kurbel
