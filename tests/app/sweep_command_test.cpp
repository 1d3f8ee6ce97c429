// sweep_command_test.cpp — kurbel sweep and merge on the command line: exit codes, what is refused before anything is
// written, resuming, shards of a SLURM array.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "studies/sweep/sweep_findings.h"
#include "tests/support/files.h"
#include "tests/support/program.h"
#include "tests/support/sweep_rows.h"

namespace kurbel::sweep_command_test {
namespace {

namespace fs = std::filesystem;

using test::Said;

class SweepCommand : public ::testing::Test {
 protected:
  SweepCommand() {
    std::ofstream(folder_ / "two.toml")
        << "title = \"Two masses\"\nline = [\"rotor\", \"spring\", \"mass\"]\n"
           "rotor = { kind = \"inertia\", inertia = \"0.2 kg*m2\" }\n"
           "motor = { kind = \"torque source\", torque = \"50 N*m\", on = \"rotor\" }\n"
           "spring = { kind = \"coupling\", stiffness = \"4 kN*m/rad\", damping_ratio = 0.02 }\n"
           "mass = { kind = \"inertia\", inertia = \"1.5 kg*m2\" }\n"
           "effects = { elasticity = true }\nrun = { until = \"0.1 s\" }\n";
  }

  Said kurbel(const std::string& arguments) const {
    return test::said_by(fmt::format("cd '{}' && {} {}", folder_.string(), KURBEL_EXECUTABLE, arguments));
  }
  // `more`: its own design and the rest.
  Said sweep(const std::string& more) const {
    return kurbel("sweep two.toml --no-files --figures peak_torque " + more);
  }
  std::vector<SweepRow> rows(const std::string& file) const { return test::rows_of(SweepStore(folder_ / file)); }
  static void expect_same(const std::vector<SweepRow>& a, const std::vector<SweepRow>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].row, b[i].row);
      EXPECT_EQ(a[i].parameters, b[i].parameters);
      EXPECT_EQ(a[i].figures.at(0).value, b[i].figures.at(0).value);
      EXPECT_EQ(a[i].figures.at(0).error, b[i].figures.at(0).error);
    }
  }

  const test::ScratchFolder folder_;
};

const std::string varied = "--vary 'spring.stiffness=3..5 kN*m/rad' --vary 'mass.inertia=1,1.5,2 kg*m2' ";

TEST_F(SweepCommand, WrongOptionsAreReportedBeforeAnythingIsWritten) {
  const struct {
    std::string options, reported;
  } cases[] = {
      {"", "nothing is varied"},
      {"--vary 'spring.stifness=3..5 kN*m/rad' --design sobol:4", "stiffness"},
      {"--vary 'spring.stiffness=3..5 kg*m2' --design sobol:4", "N·m/rad"},
      {"--vary 'spring.stiffness=-3..5 kN*m/rad' --design sobol:4", "> 0"},
      {"--vary 'spring.stiffness=5..3 kN*m/rad' --design sobol:4", "below"},
      {"--vary 'spring.stiffness=3..5 kN*m/rad' --design grid", "how many steps"},
      {varied + "--design grid:4x4", "whose list has 3"},
      {varied + "--design sobl:4", "allowed"},
      {varied + "--design lhs:0", "1 …"},
      {varied + "--design lhs:4 --figures peak_torque,peek", "no such figure"},
      {varied + "--design lhs:4 --limit 'peak_torque.spring <= 3 m'", "torque"},
      {varied + "--design lhs:4 --shard 0/3", "I/N"},
      {varied + "--design lhs:4 --error-every 0", "--error-every \"0\": must be 1 …"},
      {varied + "--design lhs:4 --jobs 0", "--jobs \"0\": must be 1 … 1024"},
      {varied + "--design lhs:4 --delta 0.05", "--delta: belongs to --of size"},
      {varied + "--design lhs:4 --of modesty", "run, steady, modes or size"},
      {varied + "--variants v.csv", "omit"},
      {"--vary 'mass.inertia=1,2 kg*m2' --vary 'mass.inertia=1,2 kg*m2'", "twice"},
  };
  for (const auto& c : cases) {
    const Said said = sweep("--into x.db " + c.options);
    EXPECT_EQ(said.code, 2) << c.options << said.text;
    EXPECT_NE(said.text.find(c.reported), std::string::npos) << c.options << "\n" << said.text;
    EXPECT_FALSE(fs::exists(folder_ / "x.db")) << c.options;
  }
  // Of a table the heading's place is reported.
  std::ofstream(folder_ / "w.csv") << "spring.stiffness [kN*m/rad],masss.inertia [kg*m2]\n4,1\n";
  const Said wrong = sweep("--into x.db --variants w.csv");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(wrong.text.starts_with("w.csv:1:29: \"masss.inertia [kg*m2]\": the scene has no \"masss\""))
      << wrong.text;
  EXPECT_FALSE(fs::exists(folder_ / "x.db"));
  std::ofstream(folder_ / "no.db") << "no database, but a text of some length";
  EXPECT_EQ(sweep("--into no.db " + varied + "--design lhs:4").code, 2);
  EXPECT_EQ(sweep("--into there/is/none.db " + varied + "--design lhs:4").code, 2);
}

// The bounds stand with the option alone: what it declares is what the study takes.
TEST_F(SweepCommand, BoundsOfAnOptionAreThoseDeclared) {
  for (const auto& [options, reported] :
       {std::pair{"uncertainty two.toml --samples 19", "--samples \"19\": must be 20 … "},
        std::pair{"modes two.toml --orders 1001", "at most 1000"},
        std::pair{"modes two.toml --spot-checks 101", "must be 0 … 100"},
        std::pair{"reduce two.toml --orders 0", "must be 1 … 1000"}}) {
    const Said said = kurbel(std::string(options) + " --no-files");
    EXPECT_EQ(said.code, 2) << options;
    EXPECT_NE(said.text.find(reported), std::string::npos) << options << "\n" << said.text;
  }
}

TEST_F(SweepCommand, GoesOnWhereItEndedAndTakesNoOtherSweepsFile) {
  ASSERT_EQ(sweep("--into r.db " + varied + "--design grid:5x3 --jobs 2").code, 0);
  const Said again = sweep("--into r.db " + varied + "--design grid:5x3");
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.text.find("15 of 15 rows were there already, 0 computed"), std::string::npos) << again.text;
  const Said other = sweep("--into r.db " + varied + "--design grid:6x3");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.text.find("grid:5x3"), std::string::npos) << other.text;
  EXPECT_EQ(sweep("--into r.db " + varied + "--design grid:5x3 --set run.until='0.2 s'").code, 2);
  EXPECT_EQ(rows("r.db").size(), 15u);
}

TEST_F(SweepCommand, WritesAReportThatReproducesItsWorstMachine) {
  const Said said = kurbel("sweep two.toml --figures peak_torque --into r.db " + varied +
                           "--design saltelli:16 --limit 'peak_torque.spring <= 92 N*m' --xlsx r.xlsx --out out");
  ASSERT_EQ(said.code, 0) << said.text;
  std::ifstream in(folder_ / "out" / "summary.json");
  const auto json = nlohmann::json::parse(in);
  EXPECT_EQ(json["rows"], 64);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "out" / "variants.csv"));
  EXPECT_GT(fs::file_size(folder_ / "r.xlsx"), 2000u);
  // What no sheet holds is said before hours of work.
  const std::string many = "--vary 'spring.stiffness=3..5 kN*m/rad' --design random:1048576 --into many.db ";
  const Said refused = sweep(many + "--xlsx many.xlsx");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("a sheet holds 1048575 rows, the sweep has 1048576"), std::string::npos) << refused.text;
  EXPECT_FALSE(fs::exists(folder_ / "many.db"));
  EXPECT_NO_THROW(check_xlsx((folder_ / "many.xlsx").string(), 1'048'575));
  std::string line = json["worst"][0]["line"];
  ASSERT_TRUE(line.starts_with("kurbel run ")) << line;
  const Said alone = kurbel(line.substr(7) + " --json --no-files --no-trials");
  ASSERT_EQ(alone.code, 0) << alone.text;
  const auto run = nlohmann::json::parse(alone.text.substr(alone.text.find('{')));
  bool found = false;
  for (const auto& figure : run["figures"])
    if (figure["name"] == "peak_torque.spring") {
      found = true;
      EXPECT_EQ(figure["value"].get<double>(), json["worst"][0]["value"].get<double>());
    }
  EXPECT_TRUE(found);
}

TEST_F(SweepCommand, ShardsOfASlurmArrayMergedAreOneSweep) {
  ASSERT_EQ(sweep("--into whole.db " + varied + "--design sobol:21").code, 0);
  for (int task = 3; task <= 6; ++task) {
    const Said said = test::said_by(fmt::format(
        "cd '{}' && KURBEL='{}' TMPDIR='{}' SLURM_ARRAY_TASK_ID={} SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_COUNT=4 "
        "'{}/scripts/sweep.slurm' results two.toml --figures peak_torque {} --design sobol:21",
        folder_.string(), KURBEL_EXECUTABLE, folder_.string(), task, KURBEL_SOURCE_DIR, varied));
    ASSERT_EQ(said.code, 0) << said.text;
  }
  const Said missing = kurbel("merge results/shard_1.db results/shard_2.db --into part.db");
  EXPECT_EQ(missing.code, 0);
  EXPECT_NE(missing.text.find("10 rows are missing"), std::string::npos) << missing.text;
  ASSERT_EQ(kurbel("merge results/shard_*.db --into all.db").code, 0);
  expect_same(rows("all.db"), rows("whole.db"));
  // What is missing of a merge is computed by a sweep into it.
  ASSERT_EQ(sweep("--into part.db " + varied + "--design sobol:21").code, 0);
  expect_same(rows("part.db"), rows("whole.db"));
  ASSERT_EQ(sweep("--into other.db " + varied + "--design sobol:22").code, 0);
  EXPECT_EQ(kurbel("merge whole.db other.db --into no.db").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "no.db"));
}

// A short form of what scripts/sweep-kills does with 200 kills.
TEST_F(SweepCommand, KillsAtRandomMomentsLoseNothingThatWasCommitted) {
  const Said said = test::said_by(fmt::format("'{}/scripts/sweep-kills' --kills 12 --rows 300 --program '{}'",
                                              KURBEL_SOURCE_DIR, KURBEL_EXECUTABLE));
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_NE(said.text.find("nothing committed was lost"), std::string::npos) << said.text;
}

// In the foreground: else timeout interrupts twice, the program and its group, and a second interrupt ends at once.
TEST_F(SweepCommand, AnInterruptKeepsWhatIsDone) {
  const std::string design = varied + "--design sobol:200000 ";
  const Said said = test::said_by(fmt::format(
      "{{ cd '{}' && timeout --foreground -s INT 1 {} sweep two.toml --no-files --figures peak_torque --into r.db {} "
      "--jobs 2; }}",
      folder_.string(), KURBEL_EXECUTABLE, design));
  EXPECT_NE(said.text.find("interrupted"), std::string::npos) << said.text;
  const std::vector<SweepRow> there = rows("r.db");
  EXPECT_GT(there.size(), 0u);
  EXPECT_LT(there.size(), 200000u);
  for (const SweepRow& r : there) EXPECT_EQ(r.state, RowState::done);
}

}  // namespace
}  // namespace kurbel::sweep_command_test
