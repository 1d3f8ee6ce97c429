// moved_from_test.cpp — values of <kurbel/kurbel.h> that were moved from are still themselves; a Motion says that it is not.
#include <gtest/gtest.h>
#include <kurbel/kurbel.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace kurbel::moved_from_test {
namespace {

const char* const two_masses = R"(
title    = "Step torque on two masses"
line     = ["rotor", "coupling", "fan"]
rotor    = { kind = "inertia", inertia = "0.2 kg*m2" }
motor    = { kind = "torque source", torque = "50 N*m", on = "rotor" }
coupling = { kind = "coupling", stiffness = "4 kN*m/rad", damping = "0 N*m*s/rad" }
fan      = { kind = "inertia", inertia = "1.5 kg*m2" }
effects  = { elasticity = true }
run      = { until = "0.3 s" }
)";

}  // namespace

// NOLINTBEGIN(bugprone-use-after-move): that is what is tested
TEST(MovedFrom, ValuesAreStillThemselvesAndAMotionSaysThatItIsNot) {
  Machine machine = Machine::from_text(two_masses);
  const Machine other = std::move(machine);
  RunChoices quick;
  quick.no_error = true, quick.page = false;
  kurbel::Run first = run(machine, quick);
  const kurbel::Run kept = std::move(first);
  EXPECT_EQ(first.figures()["peak_torque.coupling"].value, kept.figures()["peak_torque.coupling"].value);
  Study study = modes(machine);
  const Study same = std::move(study);
  EXPECT_EQ(study.conclusion(), same.conclusion());
  Trajectory rows = kept.trajectory();
  { const Trajectory gone = std::move(rows); }
  TimeSeries torque = rows["torque.coupling"];
  { const TimeSeries gone = std::move(torque); }
  EXPECT_EQ(torque.size(), rows.rows());
  EXPECT_TRUE(torque.kept());

  Motion motion(machine), onward(other);
  motion.go_to(0.1);
  SavedState state = motion.state();
  const SavedState as_text = std::move(state);
  EXPECT_TRUE(state == as_text);
  onward = std::move(motion);
  EXPECT_EQ(onward.time(), 0.1);
  for (const auto& use : std::vector<std::function<void()>>{
           [&] { motion.go_to(0.2); }, [&] { motion.time(); }, [&] { motion.state(); }, [&] { motion.restore(state); },
           [&] { motion.state_from(state.text()); }, [&] { motion.names(); }, [&] { motion.units(); },
           [&] { motion["torque.coupling"]; }, [&] { motion.values(); }, [&] { motion.state_names(); }})
    try {
      use();
      ADD_FAILURE() << "was answered";
    } catch (const std::logic_error& error) {
      EXPECT_STREQ(error.what(), "this Motion was moved from; assign another one to it first");
    }
  motion = Motion(machine);
  motion.go_to(0.2);
}
// NOLINTEND(bugprone-use-after-move)

}  // namespace kurbel::moved_from_test
