// event_kinds_test.cpp — every event of every example scene says what kind it is of, in agreement with its words; no
// figure depends on the words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "engine/events/event_words.h"
#include "tests/coverage/variant.h"
#include "tests/published/published.h"
#include "tests/support/scenes.h"

namespace kurbel::event_kinds_test {
namespace {

// By the words, which people read.
EventKind kind_by_words(const Event& e) {
  const auto begins = [&](const char* words) { return e.what.starts_with(words); };
  if (e.what == "load edge" || e.what == "load ends") return EventKind::load_edge;
  if (e.what.ends_with(": touches")) return e.from.ends_with(": in flight") ? EventKind::impact : EventKind::touch;
  if (e.what.ends_with(": in flight")) return EventKind::flight;
  if (begins("comes to rest")) return EventKind::rest;
  if (begins("is held by its losses")) return EventKind::held;
  if (begins("moves ")) return EventKind::motion;
  if (e.what == "locks" || e.what == "grips") return EventKind::lock;  // grips: an elastic belt
  if (begins("slips") && (e.from == "locked" || e.from.starts_with("slipping ") || e.from == "grips"))
    return EventKind::slip;
  if (begins("is held in proportion")) return EventKind::shares;
  if (begins("is set ") || begins("goes to ")) return EventKind::command;
  if (e.what == "on" || e.what == "off") return EventKind::window;
  if (begins("jams: ")) return EventKind::jam;
  if (e.component == "modes" || e.what.find("the contact chatters") != std::string::npos) return EventKind::note;
  return EventKind::law;
}

// What is now, by the words: a contact's sense, a command's value, on or off.
std::optional<double> value_by_words(const Event& e) {
  switch (e.kind) {
    case EventKind::rest:
    case EventKind::held:
    case EventKind::lock:
      return 0;
    case EventKind::motion:
    case EventKind::slip:
      if (e.what.ends_with(" forwards") || e.what == "slips") return 1;
      if (e.what.ends_with(" backwards")) return -1;
      return {};  // a law of its own, which names its modes itself
    case EventKind::command: {
      const std::string to =
          e.what.starts_with("is set ") ? e.what.substr(7) : e.what.substr(8, e.what.find(" within") - 8);
      return to == "on" ? 1 : to == "off" ? 0 : std::stod(to);
    }
    case EventKind::window:
      return e.what == "on" ? 1 : 0;
    default:
      return {};
  }
}

TEST(EventKinds, AgreeWithTheWordsInEveryScene) {
  std::map<EventKind, int> seen;
  int valued = 0;
  for (const std::string& name : coverage::scene_names()) {
    Scene scene = test::scene_file("scenes/" + name + ".toml");
    scene.run.until *= 0.5;
    Equations equations(compile(scene, scene.effects), true);
    RunOptions options;
    options.tolerance = 1e-6;
    options.until = scene.run.until;
    options.budget = 20;
    for (const Event& e : integrate(equations, options, {}).events) {
      EXPECT_EQ(e.kind, kind_by_words(e))
          << name << ": " << e.component << ": " << e.what << ", is a " << name_of(e.kind);
      const bool always = e.kind == EventKind::command || e.kind == EventKind::window;
      EXPECT_TRUE(e.value || !always) << name << ": " << e.component << ": " << e.what;
      if (e.value) {
        EXPECT_NEAR(*e.value, value_by_words(e).value_or(NAN), 1e-3 * std::abs(*e.value)) << e.component << e.what;
      }
      valued += e.value.has_value();
      ++seen[e.kind];
    }
  }
  for (const EventKind kind : {EventKind::law, EventKind::load_edge, EventKind::impact, EventKind::rest,
                               EventKind::lock, EventKind::slip, EventKind::command, EventKind::window})
    EXPECT_GT(seen[kind], 0) << name_of(kind);
  EXPECT_GT(valued, 40);
}

TEST(EventKinds, HaveANameEach) {
  std::set<std::string> names;
  for (int k = 0; k <= static_cast<int>(EventKind::note); ++k) names.insert(name_of(static_cast<EventKind>(k)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(EventKind::note) + 1);
}

// A torque that is rounding of the usual one is none, whatever could hold it; numbers in sentences have no exponents.
TEST(WordsOfWhatIsHeld, ReportWhatActsWithoutExponents) {
  Contact gear;
  gear.kind = Contact::Kind::loss, gear.torque_scale = 100, gear.name = "gear";
  const auto words = [&](double acts, double backwards, double forwards) {
    return words_of(gear, "gear",
                    {.acts = acts,
                     .backwards = backwards,
                     .forwards = forwards,
                     .missing_backwards = acts - backwards,
                     .missing_forwards = forwards - acts,
                     .unbounded = 1e3 * gear.torque_scale});
  };
  EXPECT_EQ(words(-1.022e-10, 0, 0),
            "\"gear\" is held at the end by gear: no torque acts, and any torque would move it");
  EXPECT_EQ(words(1e-9, -3e-9, 12),
            "\"gear\" is held at the end by gear: the acting torque is 0 N·m; forwards: up to 12 N·m are held, 12 N·m "
            "more would move it; "
            "backwards: any torque would move it");
  EXPECT_EQ(words(-14700, -50000, 36250.4),
            "\"gear\" is held at the end by gear: the acting torque is -14700 N·m; forwards: up to 36250 N·m are held, "
            "50950 N·m more would "
            "move it; backwards: up to -50000 N·m are held, 35300 N·m more would move it");
  EXPECT_NE(words(2.5e-5, -1e-4, 1.5).find(": the acting torque is 0.000025 N·m; forwards: up to 1.5 N·m"),
            std::string::npos);
}

}  // namespace
}  // namespace kurbel::event_kinds_test
