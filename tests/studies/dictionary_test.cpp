// dictionary_test.cpp — every figure is explained, once, and every explanation is of something that is printed.
#include "studies/dictionary/dictionary.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "engine/run/recorders.h"
#include "engine/scene/units.h"
#include "studies/findings/output.h"
#include "studies/report/theory.h"
#include "studies/run/run_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::dictionary_test {
namespace {

namespace fs = std::filesystem;

// Of channels and figures of a scene, without a run.
struct Reported {
  std::vector<Figure> figures;
  std::vector<Channel> channels;
};
const std::map<std::string, Reported>& reported_by_scenes() {
  static const std::map<std::string, Reported> all = [] {
    std::map<std::string, Reported> reported;
    for (const auto& entry : fs::directory_iterator(test::source_path("scenes"))) {
      if (entry.path().extension() != ".toml") continue;
      const std::string name = entry.path().stem().string();
      const Scene scene = test::scene_file("scenes/" + name + ".toml");
      const auto model = compile(scene, scene.effects);
      reported[name] = {figure_list(*model), channels_of(*model, {})};
    }
    return reported;
  }();
  return all;
}

Name name_of(const Figure& f) { return {f.what, f.of, f.name}; }

TEST(Dictionary, EveryQuantityHasItsDefinition) {
  for (const QuantityKind& what : {quantities::angle,
                                   quantities::speed,
                                   quantities::twist,
                                   quantities::slip,
                                   quantities::torque,
                                   quantities::spring_torque,
                                   quantities::position,
                                   quantities::velocity,
                                   quantities::acceleration,
                                   quantities::force,
                                   quantities::load_torque,
                                   quantities::peak_torque,
                                   quantities::peak_spring_torque,
                                   quantities::peak_velocity,
                                   quantities::peak_acceleration,
                                   quantities::peak_force,
                                   quantities::peak_load_torque,
                                   quantities::max_speed,
                                   quantities::min_speed,
                                   quantities::rms_torque,
                                   quantities::rms_spring_torque,
                                   quantities::final_angle,
                                   quantities::final_speed,
                                   quantities::steady_speed,
                                   quantities::run_up_time,
                                   quantities::run_down_time,
                                   quantities::stopping_time,
                                   quantities::stopping_angle,
                                   quantities::slip_heat,
                                   quantities::impacts,
                                   quantities::amplification,
                                   quantities::work,
                                   quantities::peak_drive_torque,
                                   quantities::mean_drive_torque,
                                   quantities::rms_drive_torque,
                                   quantities::mid_speed,
                                   quantities::mean_speed,
                                   quantities::delta,
                                   quantities::cycle_fluctuation,
                                   quantities::cycle_time,
                                   quantities::period,
                                   quantities::driving_work_per_cycle,
                                   quantities::useful_work_per_cycle,
                                   quantities::harmful_work_per_cycle,
                                   quantities::weight_work_per_cycle,
                                   quantities::work_per_cycle,
                                   quantities::speed_order,
                                   quantities::speed_order_phase,
                                   quantities::torque_order,
                                   quantities::torque_order_phase}) {
    const Definition* d = definition_of(what);
    ASSERT_NE(d, nullptr) << word(what);
    EXPECT_EQ(d->name, word(what));
  }
}

TEST(Dictionary, DefinitionsAreWholeAndEachNameAndItsWordsStandOnce) {
  std::set<std::string_view> names, words;
  for (const Definition& d : dictionary()) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name << " twice";
    EXPECT_TRUE(words.insert(d.words).second) << d.words << " twice";
    EXPECT_FALSE(d.is.empty()) << d.name;
    EXPECT_FALSE(d.is.ends_with('.')) << d.name;
    UnitError error;
    EXPECT_TRUE(parse_unit(d.unit, error)) << d.name << " in " << d.unit;
    if (d.theory.empty()) continue;
    EXPECT_EQ(theory_notes("theory " + std::string(d.theory)).size(), 1u) << d.name << ": theory " << d.theory;
  }
}

TEST(Dictionary, EquationsItCitesStandInTheTheory) {
  std::string pages;
  for (const auto& entry : fs::directory_iterator(test::source_path("docs/theory"))) {
    if (entry.path().extension() != ".md") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    pages += text.str();
  }
  for (const Definition& d : dictionary()) {
    if (d.theory.find('.') == std::string_view::npos) continue;
    EXPECT_NE(pages.find("<a id=\"eq-" + std::string(d.theory) + "\">"), std::string::npos) << d.name;
  }
}

TEST(Dictionary, WhatRunsOfAllScenesReportIsExplained) {
  for (const auto& [scene, reported] : reported_by_scenes()) {
    for (const Figure& f : reported.figures) {
      const Definition* d = definition_of(name_of(f));
      ASSERT_NE(d, nullptr) << scene << ": " << f.name;
      EXPECT_TRUE(d->is_printed_by("run")) << scene << ": " << f.name;
      EXPECT_EQ(definition_of(f.name), d) << scene << ": by its text, " << f.name << " is another";
    }
    for (const Channel& c : reported.channels) {
      const Definition* d = definition_of(c.name);
      ASSERT_NE(d, nullptr) << scene << ": " << c.name.text;
      EXPECT_TRUE(d->is_printed_by("run")) << scene << ": " << c.name.text;
    }
  }
}

// What moves may rock, and what shifts has a rate: their units are stated beside the first.
TEST(Dictionary, UnitsAreThoseOfTheFigures) {
  for (const auto& [scene, reported] : reported_by_scenes())
    for (const Figure& f : reported.figures) {
      const Definition* d = definition_of(name_of(f));
      if (!d || is_one_of(f.what, {quantities::peak_velocity, quantities::peak_acceleration})) continue;
      EXPECT_EQ(d->unit, f.unit) << scene << ": " << f.name;
    }
}

TEST(Dictionary, WhatItSaysThatRunsReportIsReportedByOne) {
  std::set<std::string_view> reported;
  for (const auto& [scene, of] : reported_by_scenes()) {
    for (const Figure& f : of.figures) reported.insert(definition_of(name_of(f))->name);
    for (const Channel& c : of.channels) reported.insert(definition_of(c.name)->name);
  }
  // No scene of the folder has the element, or the model of it, that brings them along.
  // The measured ones are reported where a test's record is laid over the run (measured_test.cpp), the current of a
  // cycle where a two-axis motor drives a mechanism (drive_figures_test.cpp), a time above a level where a scene
  // requests it (asked_figures_test.cpp).
  const std::set<std::string_view> not_in_scenes = {
      "bristle",           "guide_shift*",   "guide_tilt*",     "residual_rms", "residual_largest",
      "residual_relative", "measured_shift", "measured_offset", "current_use",  "time_above_*"};
  for (const Definition& d : dictionary()) {
    if (!d.is_printed_by("run") || d.name == "coordinates" || d.name == "change_with") continue;
    EXPECT_NE(reported.contains(d.name), not_in_scenes.contains(d.name)) << d.name;
  }
}

TEST(Dictionary, ARunReportsNothingThatIsNotListed) {
  for (const char* name : {"dc_hoist", "press_drive", "worm_hoist"}) {
    Scene scene = test::scene_file(std::string("scenes/") + name + ".toml");
    std::set<std::string> listed;
    for (const Figure& f : reported_by_scenes().at(name).figures) listed.insert(f.name);
    for (const Figure& f : test::run(scene, false).figures) EXPECT_TRUE(listed.contains(f.name)) << f.name;
  }
}

TEST(Dictionary, WordsFindWhatIsMeant) {
  const auto name = [](const char* asked) {
    const Definition* d = meant_by(asked);
    return d ? d->name : "nothing";
  };
  EXPECT_EQ(name("delta.press"), "delta");
  EXPECT_EQ(name("δ"), "delta");
  EXPECT_EQ(name("Speed fluctuation"), "delta");
  EXPECT_EQ(name("mean speed"), "mean_speed");
  EXPECT_EQ(name("mid speed"), "mid_speed");
  EXPECT_EQ(name("peak torque"), "peak_torque");
  EXPECT_EQ(name("work.driving"), "work");
  EXPECT_EQ(name("peak_current.motor"), "current");
  EXPECT_EQ(name("cycle_peak_bending_1.crank"), "bending_*");
  EXPECT_EQ(name("torqe"), "nothing");
  EXPECT_EQ(names_like("torqe", 3).front(), "torque");
  EXPECT_EQ(names_like("meanspeed", 3).front(), "mean_speed");
}

TEST(Dictionary, AFigureUnderAnotherNameIsNamed) {
  const std::vector<std::string> reported = {"cycle_fluctuation.press", "peak_torque.main", "cycle_max_speed.press"};
  EXPECT_EQ(stated_instead("delta.press", reported), "cycle_fluctuation.press");
  EXPECT_EQ(stated_instead("delta", reported), "cycle_fluctuation.press");
  EXPECT_EQ(stated_instead("cycle_peak_torque.main", reported), "peak_torque.main");
  EXPECT_EQ(stated_instead("max_speed.press", reported), "cycle_max_speed.press");
  EXPECT_EQ(stated_instead("delta.flywheel", reported), "");
  EXPECT_EQ(stated_instead("impacts.press", reported), "");
}

// The peaks of a cycle have names of their own: none is that of a whole run.
TEST(Dictionary, FiguresOfACycleAreNotCalledAsThoseOfARun) {
  for (const QuantityKind& what : {quantities::peak_torque, quantities::peak_spring_torque, quantities::peak_velocity,
                                   quantities::peak_acceleration, quantities::peak_force, quantities::peak_load_torque,
                                   quantities::max_speed, quantities::min_speed, quantities::rms_torque}) {
    const Name whole = Name::make(what, "a"), cycle = whole.of_cycle();
    EXPECT_EQ(cycle.text, "cycle_" + whole.text);
    EXPECT_EQ(cycle.of, "a");
    EXPECT_TRUE(definition_of(cycle)->is_printed_by("steady")) << cycle.text;
    EXPECT_FALSE(definition_of(whole)->is_printed_by("steady")) << whole.text;
    EXPECT_EQ(is_peak(cycle.what), is_peak(what));
  }
  EXPECT_EQ(Name::own("current", "motor").peak().of_cycle().text, "cycle_peak_current.motor");
  EXPECT_EQ(Name::make(quantities::delta, "a").of_cycle(), Name::make(quantities::delta, "a"));
}

TEST(Dictionary, AFigureIsAskedForByItsNameOrItsQuantity) {
  EXPECT_TRUE(is_asked_for("delta.press", "delta.press"));
  EXPECT_TRUE(is_asked_for("delta.press", "delta"));
  EXPECT_FALSE(is_asked_for("delta_reached", "delta"));
  EXPECT_FALSE(is_asked_for("delta", "delta.press"));
  EXPECT_FALSE(is_asked_for("delta", ""));
}

TEST(Dictionary, AListHasEveryFigureAndARunWhatItFound) {
  const auto reported = [](bool listing) {
    std::vector<Figure> figures;
    FigureReporter report(figures, listing);
    report(quantities::mid_speed, "press", [] { return Found{6.2, 6, 1.5, true, 1e-9}; });
    report("thermal_use", "motor", []() -> std::optional<Found> { return {}; });
    return figures;
  };
  const std::vector<Figure> list = reported(true), found = reported(false);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "mid_speed.press");
  EXPECT_EQ(list[0].unit, "rad/s");
  EXPECT_EQ(list[1].name, "thermal_use.motor");
  EXPECT_EQ(list[1].words(), "thermal_use");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].value, 6.2);
  EXPECT_EQ(found[0].scale, 6);
  EXPECT_EQ(found[0].at, 1.5);
  EXPECT_EQ(found[0].resolution, 1e-9);
  EXPECT_TRUE(found[0].exact);
}

TEST(Dictionary, APageDefinesTheFiguresThatItShowsAndNoOthers) {
  const Result result = test::run_until(test::scene_file("scenes/crank_press.toml"), 1);
  const Report page = page_of(findings_of(result));
  std::set<std::string> defined, shown;
  for (const Meaning& m : page.meanings) EXPECT_TRUE(defined.insert(m.id).second) << m.id;
  for (const KeyFigure& f : page.figures) shown.insert(f.means);
  for (const ReportSection& s : page.sections)
    for (const Card& card : s.cards)
      if (const Table* table = std::get_if<Table>(&card)) {
        EXPECT_TRUE(table->means.empty() || table->means.size() == table->rows.size()) << table->title;
        shown.insert(table->means.begin(), table->means.end());
      }
  EXPECT_EQ(defined, shown);
  EXPECT_TRUE(defined.contains("peak_torque"));
  EXPECT_FALSE(defined.contains("impacts"));
}

}  // namespace
}  // namespace kurbel::dictionary_test
