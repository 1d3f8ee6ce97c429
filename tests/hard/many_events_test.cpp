// many_events_test.cpp — thousands of events of many kinds in one run: no chatter, no lost energy.
#include <gtest/gtest.h>

#include <map>

#include "tests/support/scenes.h"

namespace kurbel::many_events_test {
namespace {

// Twelve shafts, two clutches, two brakes, a one-way clutch, a torque limiter and three gaps under shaking torques
// (bench/scenes/twelve_shafts.toml; the bench runs it to 10⁴ events).
TEST(ManyEvents, ClutchesBrakesAndGapsRunWithoutChatter) {
  Scene scene = test::scene_file("bench/scenes/twelve_shafts.toml");
  scene.run.until = 12;
  const Result r = test::run(scene, false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_GT(r.statistics.events, 1500);
  // Restarts beyond one for each event are those of angles wrapped and edges of the sequence; chatter would show as
  // more.
  EXPECT_LE(r.statistics.stepper.restarts, 2 * r.statistics.events);
  EXPECT_LT(r.energy.relative, 1e-7);
  // Nothing was regularised: all that is said is what holds still at the end.
  for (const std::string& note : r.notes)
    EXPECT_TRUE(note.find("is held at the end by") != std::string::npos ||
                note.starts_with("the rows of trajectory.csv"))
        << note;
  // No contact goes there and back at one instant.
  std::map<std::string, const Event*> last;
  for (const Event& e : r.events) {
    const Event*& before = last[e.component];
    if (before && before->t == e.t) {
      EXPECT_NE(before->from, e.what) << e.component << " at " << e.t;
    }
    before = &e;
  }
}

}  // namespace
}  // namespace kurbel::many_events_test
