// record_machine_test.cpp — what a machine shows of a record: means over the points' width, tables that move together
// with the start, and the scatter of cycles.
#include "studies/fit/record_machine.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace kurbel::record_machine_test {
namespace {

namespace fs = std::filesystem;

// 30 N·m and 20 more or less over each turn; with a drag it turns at 15 rad/s on average.
RecordRequest driven(Over over, const char* drag) {
  RecordRequest request;
  request.name = "test", request.file = "test.csv", request.over = over;
  request.scene.file = "test.toml";
  request.scene.text = std::string(R"(
line = ["rotor", "drive", "drag"]
rotor = { kind = "flywheel", inertia = "0.3 kg*m2" }
drive = { kind = "torque source", table = { over = "angle", unit = ["deg", "N*m"], period = "360 deg", points = [[0, 30], [70, 50], [250, 10], [360, 30]] } }
drag = { kind = "load", damping = ")") +
                       drag + R"(" }
run = { start = { speed = "15 rad/s" }, until = "2 s", accuracy = 1e-9 }
)";
  return request;
}
FitRecord record_of(Over over, std::vector<double> at) {
  FitRecord record{.name = "test", .file = "test.csv", .over = over, .at = std::move(at), .channels = {}};
  record.channels.push_back({.channel = "speed.rotor", .unit = "rad/s", .mean = std::vector(record.at.size(), 15.0)});
  return record;
}

// A point's mean over time of what turns through 2r is 2r/∫dφ/ω: the harmonic mean of its speeds.
TEST(RecordMachine, MeansOverAnAngleAreByTheTimeThatItTakes) {
  RecordMachine machine(driven(Over::angle, "2 N*m*s/rad"), record_of(Over::angle, {0, 1, 2, 3, 4, 5}), 0, {});
  const Response response = machine.at(Eigen::VectorXd());
  ASSERT_EQ(response.failed, "");
  const ShownSignal& shown = response.channels.at(0);
  double least = HUGE_VAL, most = 0;
  for (const double x : {0.4, 1.9, 3.1, 5.0})
    for (const double reach : {0.2, 1.5}) {
      constexpr int parts = 2000;
      double time = 0;
      for (int i = 0; i < parts; ++i) {
        const double speed = shown.signal.at(x + reach * ((2 * i + 1.0) / parts - 1));
        time += 2 * reach / parts / speed;
        least = std::min(least, speed), most = std::max(most, speed);
      }
      const double mean = 2 * reach / time;
      EXPECT_NEAR(shown.mean(x, reach), mean, 1e-4 * mean) << x << " ± " << reach;
    }
  EXPECT_GT(most, 1.2 * least);  // else every mean is the same
}

// A table and the start, both later by one angle, are the machine as it was; the table alone is not.
TEST(RecordMachine, ADeadCentreMovesTheTableTogetherWithTheStart) {
  const RecordRequest request = driven(Over::time, "0.1 N*m*s/rad");
  const FitRecord record = record_of(Over::time, {0, 0.5, 1, 1.5});
  const auto speeds = [&](const char* unknown, double u) {
    RecordMachine machine(request, record, 0, parse_unknowns({unknown}, {record}));
    const Response response = machine.at(Eigen::VectorXd::Constant(1, u));
    EXPECT_EQ(response.failed, "");
    std::vector<double> values;
    for (const double t : record.at) values.push_back(response.channels.at(0).signal.at(t));
    return values;
  };
  const char* const together = "dead centre of drive.table=-0.5..0.5 rad";
  const std::vector<double> as_given = speeds(together, 0.5), later = speeds(together, 0.9),
                            alone = speeds("shift of drive.table=-0.5..0.5 rad", 0.9);
  double off = 0;
  for (std::size_t k = 0; k < as_given.size(); ++k) {
    EXPECT_NEAR(later[k], as_given[k], 1e-5 * as_given[k]) << record.at[k];
    off = std::max(off, std::abs(alone[k] / as_given[k] - 1));
  }
  EXPECT_GT(off, 1e-3);
}

// s² = Σ (y − ȳ)²/(n − 1) of each point: 1, 2, 3 have 1; 4, 4, 7 have 3. Of three cycles it is the mean over fifteen points.
TEST(FitRecord, ScatterOfCyclesIsTheirStandardDeviation) {
  const fs::path file = fs::temp_directory_path() / ("kurbel_scatter_" + std::to_string(getpid()) + ".csv");
  std::ofstream(file) << "t [s],c1 [rad/s],c2 [rad/s],c3 [rad/s]\n0,1,2,3\n1,4,4,7\n2,5,9,1\n3,1,0,-1\n";
  RecordRequest request = driven(Over::time, "2 N*m*s/rad");
  request.file = file.string(), request.maps = {"c*=speed.rotor"};
  const FitRecord record = read_record(request);
  fs::remove(file);
  EXPECT_EQ(record.cycles, 3);
  ASSERT_EQ(record.channels.size(), 1u);
  const RecordChannel& c = record.channels[0];
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(c.mean[k], (std::array{2.0, 5.0, 5.0, 0.0}[k]), 1e-15);
    EXPECT_NEAR(c.scatter[k], std::sqrt((1 + 3 + 16 + 1) / 4.0), 1e-15);
  }
}

}  // namespace
}  // namespace kurbel::record_machine_test
