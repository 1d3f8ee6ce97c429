// exported.h — what the tests of exported components share: the program as it is called, its runs, components by their scene.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/fmi/importer.h"
#include "tests/support/program.h"

namespace exported_components {

using namespace importer;
namespace fs = std::filesystem;

struct Folder {
  fs::path path = folder_of_its_own();
  ~Folder() { fs::remove_all(path); }
};

inline std::string command(const std::string& line, int expected = 0) {
  const kurbel::test::Said said = kurbel::test::said_by(line);
  EXPECT_EQ(said.code, expected) << line << "\n" << said.text;
  return said.text;
}

inline std::string scene(const std::string& name) {
  return std::string(KURBEL_SOURCE_DIR) + "/scenes/" + name + ".toml";
}

inline std::string without_sequence(const std::string& name) {
  std::ifstream file(scene(name));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::size_t begin = text.find("[sequence]"), end = text.find("[effects]");
  return text.replace(begin, end - begin, "");
}

// Exported by the program; each of the scenes once.
inline std::shared_ptr<const Unpacked> exported(const std::string& file, int fmi, const std::string& options = "") {
  static std::map<std::string, std::shared_ptr<const Unpacked>> known;
  std::shared_ptr<const Unpacked>& kept = known[file + std::to_string(fmi) + options];
  if (kept) return kept;
  const Folder folder;
  const std::string out = (folder.path / "out").string();
  command(std::string(KURBEL_EXECUTABLE) + " export " + file + " --quiet --fmi " + std::to_string(fmi) + " " + options +
          " --out " + out);
  for (const fs::directory_entry& entry : fs::directory_iterator(out))
    if (entry.path().extension() == ".fmu") return kept = std::make_shared<const Unpacked>(entry.path());
  throw std::runtime_error("no component");
}

inline std::string written(const Folder& folder, const std::string& text) {
  const std::string file = (folder.path / "machine.toml").string();
  std::ofstream(file) << text;
  return file;
}

// What `kurbel run` records: columns by their names, rows with the located peaks among them.
struct Happened {
  double t = 0;
  std::string what;  // "brake: is set off"
};
struct Trajectory {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;  // the time first
  std::vector<Happened> events;           // behind the start
};
inline const Trajectory& run(const std::string& file, double until) {
  static std::map<std::string, Trajectory> known;
  const auto [place, fresh] = known.try_emplace(file + " until " + std::to_string(until));
  Trajectory& t = place->second;
  if (!fresh) return t;
  const Folder folder;
  const std::string out = (folder.path / "out").string();
  command(std::string(KURBEL_EXECUTABLE) + " run " + file + " --quiet --no-trials --set run.samples=41 --until \"" +
          std::to_string(until) + " s\" --out " + out);
  std::ifstream csv(out + "/trajectory.csv");
  std::string line, cell;
  std::getline(csv, line);
  for (std::istringstream heading(line); std::getline(heading, cell, ',');)
    t.names.push_back(cell.substr(0, cell.find(" [")));
  while (std::getline(csv, line)) {
    t.rows.emplace_back();
    for (std::istringstream row(line); std::getline(row, cell, ',');) t.rows.back().push_back(std::stod(cell));
  }
  std::ifstream json(out + "/summary.json");
  for (const auto& event : nlohmann::json::parse(json).value("events", nlohmann::json::array()))
    if (event["t"].get<double>() > 0 && event["kind"] != "note")
      t.events.push_back({event["t"], event["component"].get<std::string>() + ": " + event["what"].get<std::string>()});
  return t;
}

struct Machine {
  const char* scene;
  double until;
};
// The five of drives, and two linkages.
inline const Machine machines[] = {{"crank_press", 0.5}, {"planetary_brake", 1.6},  {"gear_pair", 0.3},
                                   {"dc_hoist", 2},      {"diesel_generator", 0.5}, {"six_link_press", 0.5},
                                   {"stephenson", 0.5}};

}  // namespace exported_components
