// explained_names_test.cpp — kurbel explain knows what stands in tables' headings and rows, on axes and at curves of pages.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "studies/dictionary/dictionary.h"
#include "studies/dictionary/page_words.h"
#include "tests/support/files.h"

namespace kurbel::explained_names_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// The data of the page that a command writes.
Json page_of(const std::string& command) {
  const test::ScratchFolder folder;
  const std::string line = fmt::format("cd {0} && NAMES={3} && {1} {2} --out {3}/page > /dev/null 2>&1",
                                       KURBEL_SOURCE_DIR, KURBEL_EXECUTABLE, command, folder.string());
  EXPECT_EQ(std::system(line.c_str()), 0) << command;
  const std::string html = test::text_of(folder / "page/report.html");
  const std::string mark = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = html.find(mark);
  if (begin == std::string::npos) return ADD_FAILURE() << command << ": no page", Json::object();
  return Json::parse(html.substr(begin + mark.size(), html.find("</script>", begin) - begin - mark.size()));
}

// Names that the page takes from the scene: components and what they own, keys, cases, its file; and numbers.
bool is_of_scene(const std::string& name, const std::string& scene) {
  static const std::regex number("^[-+]?[0-9.]+(e[-+]?[0-9]+)?( (±|\\+|−|-) .*| kg·m².*)?$");
  if (std::regex_match(name, number)) return true;
  const auto stands = [&](const std::string& word) {
    return scene.find('"' + word + '"') != std::string::npos || scene.find("\n[" + word + "]") != std::string::npos ||
           scene.find("\n" + word + " ") != std::string::npos;
  };
  return stands(name) || stands(name.substr(0, name.find_first_of(".:")));
}

struct Reported {
  std::size_t names = 0;
  std::set<std::string> unknown, in_radians;
};

void collect(const std::string& command, Reported& reported) {
  const Json page = page_of(command);
  std::string scene;
  static const std::regex file("[^ ]+\\.(toml|csv)");
  for (std::sregex_iterator i(command.begin(), command.end(), file), end; i != end; ++i)
    scene += fmt::format("\n{}\n\"{}\" \"{}\"", test::text_of(fs::path(KURBEL_SOURCE_DIR) / i->str()), i->str(),
                         fs::path(i->str()).stem().string());
  const bool in_radians = scene.find("rad/s\"") != std::string::npos;  // the scene's own unit
  const auto meet = [&](const std::string& name) {
    if (name.empty() || is_of_scene(name, scene)) return;
    ++reported.names;
    if (!meant_by(name)) reported.unknown.insert(fmt::format("{} ({})", name, command.substr(0, command.find(' '))));
  };
  for (const Json& section : page.value("sections", Json::array()))
    for (const Json& card : section["cards"]) {
      for (const std::string heading : card.value("columns", Json::array())) {
        meet(heading);
        if (!in_radians && heading.ends_with(" [rad/s]")) reported.in_radians.insert(command + ": " + heading);
      }
      for (const Json& row : card.value("rows", Json::array()))
        for (const Json& cell : row)
          if (!in_radians && cell == "rad/s") reported.in_radians.insert(command + ": " + row[0].get<std::string>());
      for (const Json& row : card.value("rows", Json::array()))
        if (row[0].get<std::string>().size() < 60) meet(row[0]);  // longer ones are sentences
      if (card["kind"] != "plot") continue;
      for (const char* axis : {"x", "y"}) meet(card[axis]["label"]);
      for (const Json& series : card["series"]) meet(series["name"]);
    }
}

TEST(ExplainedNames, OfTablesAndPlotsOfAllCommands) {
  Reported reported;
  for (const char* command :
       {"run docs/tasks/eccentric_press.toml",
        "run scenes/belt_mill.toml",
        "compare scenes/crank_press.toml --until '3 s' --accuracy 1e-4",
        "diff scenes/crank_press.toml scenes/crank_press.toml --other-set 'main_coupling.stiffness=2 MN*m/rad' --set "
        "'run.until=2 s'",
        "steady scenes/single_cylinder_engine.toml",
        "steady scenes/crank_press.toml",
        "size scenes/crank_press.toml --delta 0.05",
        "reduce scenes/single_cylinder_engine.toml",
        "forces scenes/single_cylinder_engine.toml",
        "forces scenes/four_bar_rocker.toml",
        "forces scenes/six_link_press.toml",
        "forces scenes/shaper.toml",
        "run scenes/compressor.toml",
        "modes docs/tasks/two_cylinder_compressor.toml",
        "modes scenes/crank_press.toml --torque main_coupling",
        "gears scenes/gear_pair.toml",
        "effects scenes/screw_jack.toml",
        "advise scenes/crank_press.toml --set 'run.until=2 s'",
        "accuracy scenes/six_inertia_chain.toml --set 'run.until=0.3 s'",
        "uncertainty docs/tasks/fan_drive.toml --of modes --figures natural_frequency.1 --limit 'natural_frequency.1 "
        "<= "
        "22.5 Hz' --no-trials",
        "sweep scenes/crank_press.toml --vary 'main_coupling.stiffness=500..1500 kN*m/rad' --vary "
        "'flywheel.inertia=200,400 kg*m2' --design grid:3x2 --set 'run.until=1 s' --into $NAMES/sweep.db",
        "fit docs/tasks/fit_set.toml --measured docs/tasks/fit_set_1500.csv --map 'c*=speed.engine' --orders "
        "0.5,1.5,2.5 "
        "--hold 'mean speed by load.torque' --free 'rotor.inertia=0.05..0.8 kg*m2'",
        "report docs/tasks/gear_fan.toml"})
    collect(command, reported);
  EXPECT_GT(reported.names, 700u);
  for (const std::string& name : reported.unknown) ADD_FAILURE() << name << " is not explained";
  for (const std::string& place : reported.in_radians) ADD_FAILURE() << place << " is not in the scene's unit of speed";
}

// A part of a definition's words is not what was requested.
TEST(ExplainedNames, NoWordOfAnotherFigureStandsForThem) {
  for (const char* word :
       {"time [s]", "f [Hz]", "RMS", "mean [N·m]", "joint", "states", "moment [N·m]", "largest", "margin [%]"}) {
    const Definition* const known = meant_by(word);
    ASSERT_TRUE(known) << word;
    EXPECT_EQ(known->words, word_of_pages) << word << " is " << known->name;
  }
  EXPECT_EQ(meant_by("driving torque M_d [N·m]")->name, "M_d");
  EXPECT_EQ(meant_by("engine.load (driving)")->is, meant_by("driving")->is);
  EXPECT_EQ(meant_by("greatest peak_torque.coupling")->name, "peak_torque");
  EXPECT_EQ(meant_by("mode 3, 20 Hz: wheel")->name, "natural_frequency");
  // Terms of the field are not a star's: "* angle" is a shaft's, T_* a slide's friction.
  for (const char* word :
       {"transmission angle", "pressure angle", "T_KW", "T_KN", "T_Kmax", "S_f", "K_A", "critical speed"}) {
    const Definition* const known = meant_by(word);
    ASSERT_TRUE(known) << word;
    EXPECT_EQ(known->name, word);
  }
  for (const char* word : {"xyzzy", "xyzzy 3", "1", "2", "mode xyzzy", "from here", "to do", "by hand"})
    EXPECT_FALSE(meant_by(word)) << word;
}

}  // namespace
}  // namespace kurbel::explained_names_test
