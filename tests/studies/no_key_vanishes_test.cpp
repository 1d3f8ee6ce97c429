// no_key_vanishes_test.cpp — every number that a scene states has an effect: changed by a tenth it changes how the machine
// moves, a figure, a verdict, a note, or it is refused. The short form takes every few numbers and looks at the equations
// and a short run; the thorough form (scripts/test --thorough) takes all of them, with whole runs and the modes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "studies/findings/output.h"
#include "studies/limits/ratings.h"
#include "studies/modes/modes.h"
#include "studies/report/render.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"
#include "tests/support/thorough.h"

namespace kurbel::no_key_vanishes_test {
namespace {

namespace fs = std::filesystem;

// A number of a scene's text, and the key that it stands behind.
struct Stated {
  std::size_t begin = 0, length = 0;
  int line = 1;
  std::string key;
  bool whole = false;  // it counts something: 3 becomes 4
};

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// All numbers that are values: not those in comments, titles, names of files, keys or units ("kg*m2").
std::vector<Stated> numbers_in(const std::string& text) {
  std::vector<Stated> found;
  int line = 1;
  std::string key;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
      continue;
    }
    const bool alone = i == 0 || !is_word(text[i - 1]);
    if (alone && std::isalpha(static_cast<unsigned char>(c))) {
      std::size_t end = i;
      while (end < text.size() && is_word(text[end])) ++end;
      std::size_t next = end;
      while (next < text.size() && text[next] == ' ') ++next;
      if (next < text.size() && text[next] == '=') key = text.substr(i, end - i);
      i = end;
      continue;
    }
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!alone || !digit) {
      ++i;
      continue;
    }
    char* stop = nullptr;
    const double value = std::strtod(text.c_str() + i, &stop);
    const auto length = static_cast<std::size_t>(stop - (text.c_str() + i));
    const char before = i > 0 ? text[i - 1] : ' ', behind = i + length < text.size() ? text[i + length] : ' ';
    const bool in_unit = before == '*' || before == '/' || before == '^' || before == '.';
    const bool name = key == "title" || key == "file" || key == "line" || key == "format" || is_word(behind);
    if (value != 0 && !in_unit && !name)
      found.push_back(
          {i, length, line, key, before != '"' && text.substr(i, length).find_first_of(".e") == std::string::npos});
    i += length;
  }
  return found;
}

std::string changed(const std::string& text, const Stated& number) {
  const double value = std::stod(text.substr(number.begin, number.length));
  std::string one = text;
  one.replace(number.begin, number.length,
              number.whole ? fmt::format("{:.0f}", value + 1) : fmt::format("{:.12g}", 1.1 * value));
  return one;
}

// What is seen of a scene: words and numbers, to be compared as they are.
struct Seen {
  std::vector<double> numbers;
  std::string words;
  bool operator==(const Seen& other) const {
    return words == other.words && numbers.size() == other.numbers.size() &&
           std::equal(numbers.begin(), numbers.end(), other.numbers.begin(), [](double a, double b) {
             return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
           });
  }
};

// How the compiled machine moves at a few states and times, with the scene's effects and with elasticity.
Seen equations_of(const Scene& scene) {
  Seen seen;
  Effects elastic = scene.effects;
  elastic.all_elastic = true;
  for (const Effects& effects : {scene.effects, elastic}) try {
      const auto model = compile(scene, effects);
      seen.words += model->explain();
      seen.numbers.insert(seen.numbers.end(), {model->cycle, model->speed_scale, model->torque_scale});
      Equations equations(model, true);
      const std::vector<double> start = equations.start(0);
      seen.numbers.insert(seen.numbers.end(), start.begin(), start.end());
      const std::vector<double> scale = equations.error_control(1e-6).scale;
      std::mt19937 random(7);
      std::uniform_real_distribution<double> some(-1, 1);
      for (int k = 0; k < 6; ++k) {
        std::vector<double> y = start;
        for (std::size_t i = 0; i < equations.state_count(); ++i) y[i] += 2 * scale[i] * some(random);
        const double t = k * scene.run.until / 6;
        equations.wrap(y);
        equations.modes_at(t, y);
        const Snapshot& s = equations.snapshot(t, y);
        const auto add = [&](const double* from, std::size_t count) {
          seen.numbers.insert(seen.numbers.end(), from, from + count);
        };
        add(s.alpha, model->shafts.size());
        add(s.joint_torque, model->network.joints.size());
        add(s.sums.internal_rate, model->internal_states.size());
        add(s.sums.element_torque, model->network.elements.size());
        seen.numbers.push_back(equations.stored_energy(t, y));
      }
    } catch (const std::exception& refused) {
      seen.words += refused.what();
    }
  return seen;
}

Seen run_of(const Scene& scene) {
  Seen seen;
  try {
    SimulateOptions options;
    options.measure_error = false;
    if (!test::thorough()) options.until = std::min(scene.run.until, 20.0);
    const Result r = simulate(scene, scene.effects, "", options);
    for (const Figure& f : r.figures) seen.numbers.push_back(f.value);
    for (const std::string& note : r.notes) seen.words += note + "\n";
    for (const Claim& claim : r.claims) seen.words += claim.text + "\n";
    for (const Verdict& v : judge_ratings(r)) {
      for (const double number : {v.value, v.limit})
        if (!std::isnan(number)) seen.numbers.push_back(number);
      seen.words += v.component + v.requirement + v.note + "\n";
    }
    seen.numbers.insert(seen.numbers.end(), {r.accuracy, r.until, static_cast<double>(scene.run.samples)});
  } catch (const std::exception& refused) {
    seen.words += refused.what();
  }
  return seen;
}

Seen modes_of(const Scene& scene) {
  Seen seen;
  try {
    seen.words = output_of(find_modes(scene, scene.effects, {})).text();
  } catch (const std::exception& refused) {
    seen.words = refused.what();
  }
  return seen;
}

// Numbers of one scene that change nothing, in words.
std::vector<std::string> idle_numbers(const std::string& file, std::size_t first, std::size_t step) {
  std::vector<std::string> idle;
  const std::string path = test::source_path(file), text = test::text_of(path);
  const auto read = [&](const std::string& words) { return parse_scene(words, path, all_kinds()); };
  const Scene scene = read(text);
  const Seen usual = equations_of(scene);
  std::optional<Seen> usual_run, usual_modes;
  const std::vector<Stated> numbers = numbers_in(text);
  for (std::size_t n = first; n < numbers.size(); n += step) {
    std::optional<Scene> other;
    try {
      other = read(changed(text, numbers[n]));
    } catch (const SceneError&) {
      continue;  // refused, in words
    }
    if (!(equations_of(*other) == usual)) continue;
    if (!usual_run) usual_run = run_of(scene);
    if (!(run_of(*other) == *usual_run)) continue;
    if (test::thorough()) {
      if (!usual_modes) usual_modes = modes_of(scene);
      if (!(modes_of(*other) == *usual_modes)) continue;
    }
    idle.push_back(fmt::format("{}:{}: {} = … {}", file, numbers[n].line, numbers[n].key,
                               text.substr(numbers[n].begin, numbers[n].length)));
  }
  return idle;
}

// Keys that no run reads, and what does; the thorough form asks modes, too, and then only the others remain.
const std::set<std::string>& read_elsewhere() {
  static const std::set<std::string> keys = {
      "application_factor",
      "vibratory_torque",
      "dissipated_power",
      "nominal_torque",  // kurbel modes
      "samples",         // how many rows are written
  };
  return keys;
}

// A point of a linkage's sketch, which picks the branch alone where the lengths about it are given.
bool is_sketched(const std::string& key) {
  return key.size() == 1 && std::isupper(static_cast<unsigned char>(key[0])) != 0;
}

// A number of a bearing's oil film, which kurbel forces reads; `idle`: FILE:LINE: KEY = ….
bool is_of_a_film(const std::string& idle, const std::string& key) {
  static const std::set<std::string> keys = {"roughness", "bore_roughness", "viscosity", "film_length", "clearance"};
  if (!keys.contains(key)) return false;
  const std::size_t colon = idle.find(':');
  std::ifstream file(test::source_path(idle.substr(0, colon)));
  std::string line;
  for (int n = std::stoi(idle.substr(colon + 1)); n > 0; --n) std::getline(file, line);
  return line.find("film_length") != std::string::npos;
}

std::vector<std::string> scenes() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(test::source_path("scenes")))
    if (entry.path().extension() == ".toml") files.push_back("scenes/" + entry.path().filename().string());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(NoKeyVanishes, numbers_of_the_scenes_have_an_effect) {
  const std::size_t step = test::thorough() ? 1 : 29;
  std::size_t first = 0;
  for (const std::string& file : scenes()) {
    for (const std::string& idle : idle_numbers(file, test::thorough() ? 0 : first % step, step)) {
      const std::size_t begin = idle.find(": ", idle.find(".toml")) + 2;
      const std::string key = idle.substr(begin, idle.find(' ', begin) - begin);
      EXPECT_TRUE(read_elsewhere().contains(key) || is_sketched(key) || is_of_a_film(idle, key)) << idle;
    }
    first += 5;
  }
}

// The test sees what it is for: damping that vanishes.
TEST(NoKeyVanishes, damping_beside_a_flange_without_inertia_has_an_effect) {
  for (const std::string& idle : idle_numbers("tests/cases/reports/vanishing_damping.toml", 0, 1))
    EXPECT_EQ(idle.find("damping"), idle.rfind("damping")) << idle;  // once: in the file's name
}

}  // namespace
}  // namespace kurbel::no_key_vanishes_test
