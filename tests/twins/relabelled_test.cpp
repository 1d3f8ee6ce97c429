// relabelled_test.cpp — names, the order of a file and units mean nothing: the same machine in other words says the
// same in every output of every study, read from its JSON.
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/run/run_findings.h"
#include "tests/support/scenes.h"
#include "tests/support/thorough.h"
#include "tests/twins/twin_gears.h"

namespace kurbel::relabelled_test {
namespace {

using namespace test;  // NOLINT: the scenes' names
using Json = nlohmann::json;

class Relabelled : public EveryScene {
 protected:
  // In the short form every scene has its modes compared or its reduction, in turn.
  bool skipped(std::size_t study) const { return !thorough() && (scene().dear || (GetParam() + study) % 2 == 1); }
};

// --- other words -----------------------------------------------------------------------------------------------------

// Names whose order is the other way round, and which stand nowhere else.
std::map<std::string, std::string> other_names(const TwinScene& s) {
  std::map<std::string, std::string> names;
  for (const std::string* text : {&s.near_text, &s.far_text})
    for (const auto& [name, table] : tables_in(*text))
      if (name.find('.') == std::string::npos) names[name];
  char letter = 'Z';
  for (auto& [name, other] : names) other = fmt::format("part{}q", letter--);
  return names;
}

std::string renamed(std::string text, const std::map<std::string, std::string>& names) {
  for (const auto& [name, other] : names) {
    text = std::regex_replace(text, std::regex("\n\\[" + name + "\\]"), "\n[" + other + "]");
    text = std::regex_replace(text, std::regex("\\b(on|of|set|from)( *= *)\"" + name + "(\"|\\.)"),
                              "$1$2\"" + other + "$3");
    text = std::regex_replace(text, std::regex("(line = \\[)\"" + name + "\""), "$1\"" + other + "\"");
    text = std::regex_replace(text, std::regex("([,{] *)" + name + "( = \\{)"), "$1" + other + "$2");
  }
  return text;
}

// "0.3 kg*m2" → "3000 kg*cm2"
std::string in_other_units(const std::string& text) {
  static const std::map<std::string, std::pair<const char*, double>> units = {
      {"kg*m2", {"kg*cm2", 1e4}},
      {"N*m/rad", {"kN*m/deg", 1e-3 * M_PI / 180}},
      {"N*m*s/rad", {"N*m/rpm", M_PI / 30}},
      {"N*m", {"lbf*ft", 1 / (4.4482216152605 * 0.3048)}},
      {"rad/s", {"rpm", 30 / M_PI}},
      {"rad", {"deg", 180 / M_PI}},
      {"deg", {"rad", M_PI / 180}},
      {"m", {"in", 1 / 0.0254}},
      {"mm", {"cm", 0.1}},
      {"N", {"kN", 1e-3}},
      {"kN", {"N", 1e3}},
      {"kg", {"lb", 1 / 0.45359237}},
      {"s", {"ms", 1e3}},
      {"ms", {"s", 1e-3}},
      {"bar", {"Pa", 1e5}},
      {"kW", {"W", 1e3}},
      {"V", {"kV", 1e-3}},
      {"Hz", {"1/min", 60}}};
  static const std::regex quantity("\"(-?[0-9.]+(?:e[-+]?[0-9]+)?) ([A-Za-z0-9*/]+)\"");
  std::string out;
  auto from = text.begin();
  for (std::sregex_iterator match(text.begin(), text.end(), quantity), none; match != none; ++match) {
    out.append(from, text.begin() + match->position());
    from = text.begin() + match->position() + match->length();
    const auto unit = units.find((*match)[2]);
    out += unit == units.end()
               ? match->str()
               : fmt::format("\"{:.17g} {}\"", unit->second.second * std::stod((*match)[1]), unit->second.first);
  }
  return out + std::string(from, text.end());
}

std::string relabelled(const TwinScene& s, const std::map<std::string, std::string>& names) {
  std::vector<std::vector<std::string>> groups;
  for (const auto* group : {&s.near, &s.far, &s.rest}) {
    groups.emplace_back();
    for (const std::string& name : *group) groups.back().push_back(names.at(name));
  }
  std::string tables = "\n" + seen(s.end, {}, {}), text;
  auto components = tables_in(seen(s.near_text, {}, {}) + seen(s.far_text, {}, {}));
  for (auto table = components.rbegin(); table != components.rend(); ++table) tables += table->second;
  return line_of(groups) + in_other_units(renamed(tables, names));
}

// --- the same answers ------------------------------------------------------------------------------------------------

std::string with_old_names(std::string json, const std::map<std::string, std::string>& names) {
  for (const auto& [name, other] : names)
    for (std::size_t at = 0; (at = json.find(other, at)) != std::string::npos;) json.replace(at, other.size(), name);
  return json;
}

// What depends on rounding or on how long it took.
bool is_noise(const std::string& key) {
  for (const char* noise :
       {"statistics", "residual", "relative", "bodies_against_reduced", "free_bodies", "scene", "scene_text",
        "explanation", "torque_left_over", "accuracy", "captured_of_mean_square", "error", "errors"})
    if (key == noise) return true;
  return key.starts_with("cpu");
}

// Texts word by word; their numbers as far as they are printed.
bool same_words(std::string a, std::string b) {
  // "brake 62 %, bearing 38 %" stands in the order of the names.
  for (std::string* text : {&a, &b})
    if (text->find("in proportion to capacity") != std::string::npos) std::sort(text->begin(), text->end());
  if (a == b) return true;
  // A motion that never settles ends anywhere: how far it was then depends on the last digit of its start.
  const std::string unsettled = "there is no steady cycle to look at: after ";
  if (a.starts_with(unsettled) && b.starts_with(unsettled)) return true;
  const std::size_t changing_a = a.find("the motion still changes by"),
                    changing_b = b.find("the motion still changes by");
  if (changing_a != std::string::npos && changing_b != std::string::npos)
    return a.substr(0, a.find("after ")) == b.substr(0, b.find("after "));
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?");
  if (std::regex_replace(a, number, "#") != std::regex_replace(b, number, "#")) return false;
  std::sregex_iterator x(a.begin(), a.end(), number), y(b.begin(), b.end(), number), none;
  for (; x != none && y != none; ++x, ++y) {
    const double u = std::stod(x->str()), v = std::stod(y->str());
    if (std::abs(u - v) > 1e-3 * std::max({std::abs(u), std::abs(v), 1e-6})) return false;
  }
  return true;
}

void expect_same(const Json& a, const Json& b, const std::string& where, double scale = 0) {
  if (a.is_number() && b.is_number()) {
    const double x = a, y = b;
    if (std::abs(x - y) > 5e-6 * std::max({std::abs(x), std::abs(y), scale, 1e-6}))
      ADD_FAILURE() << fmt::format("{}: {:.10g}, but {:.10g}", where, x, y);
    return;
  }
  if (a.type() != b.type() || a.size() != b.size()) {
    ADD_FAILURE() << where << ": " << a.dump().substr(0, 300) << "\nbut " << b.dump().substr(0, 300);
    return;
  }
  if (a.is_object()) {
    const bool harmonic = a.contains("amplitude") && a.contains("phase");
    if (harmonic && b.contains("amplitude") && b.contains("phase")) {  // as one complex number
      const double u = a["amplitude"], v = a["phase"], x = b["amplitude"], y = b["phase"];
      expect_same(u * std::cos(v), x * std::cos(y), where + ", cosine", scale);
      expect_same(u * std::sin(v), x * std::sin(y), where + ", sine", scale);
    }
    for (const auto& [key, value] : a.items()) {
      if (is_noise(key) || (harmonic && key == "phase")) continue;
      if (key == "at" && value.is_number() && b.contains(key) && b[key].is_number()) {  // peaks are flat
        // The torque of a belt that slips stays at its largest value: rounding chooses the time.
        const std::string name = a.value("name", "");
        if (!name.starts_with("peak_") || name.find("torque.belt") == std::string::npos) {
          EXPECT_NEAR(value.get<double>(), b[key].get<double>(), 1e-4) << where << ": " << name;
        }
        continue;
      }
      if (!b.contains(key)) {
        ADD_FAILURE() << where << "." << key << " is missing";
        continue;
      }
      // What is judged is rounded by the size of its limit: a vibratory torque of nothing is 1e-11 either way.
      const bool judged = key == "value" && a.contains("limit") && a["limit"].is_number();
      expect_same(value, b[key], where + "." + key, judged ? std::abs(a["limit"].get<double>()) : scale);
    }
  } else if (a.is_array()) {
    // Lists of named things by name: their order may follow the names.
    const auto by_name = [](Json list) {
      std::stable_sort(list.begin(), list.end(), [](const Json& x, const Json& y) {
        return x.is_object() && x.contains("name") && x["name"].is_string() && x["name"] < y["name"];
      });
      return list;
    };
    const Json in_a = by_name(a), in_b = by_name(b);
    double largest = 0;
    for (const Json& value : in_a) {
      const bool harmonic = value.is_object() && value.contains("amplitude") && value["amplitude"].is_number();
      if (value.is_number()) largest = std::max(largest, std::abs(value.get<double>()));
      if (harmonic) largest = std::max(largest, std::abs(value["amplitude"].get<double>()));
    }
    for (std::size_t k = 0; k < in_a.size(); ++k)
      expect_same(in_a[k], in_b[k], fmt::format("{}[{}]", where, k), largest);
  } else if (a.is_string() ? !same_words(a, b) : a != b) {
    ADD_FAILURE() << where << ": " << a << "\nbut " << b;
  }
}

template <class Study>
void expect_same_output(const TwinScene& scene, const std::string& what, const Study& json_of) {
  const auto names = other_names(scene);
  SCOPED_TRACE(scene.name + ": " + what);
  const auto said = [&](const std::string& text) {
    try {
      Scene read = scene_from(text);
      read.speed_unit = {};  // words state speeds in the scene's own unit
      return json_of(read);
    } catch (const std::invalid_argument& refused) {  // both alike
      return Json({{"refused", refused.what()}}).dump();
    }
  };
  const std::string one = said(direct(scene, {}, {})), other = said(relabelled(scene, names));
  expect_same(Json::parse(one), Json::parse(with_old_names(other, names)), what);
}

TEST_P(Relabelled, RunSaysTheSame) {
  expect_same_output(scene(), "run", [](const Scene& s) { return output_of(run(s, false)).json(); });
}
TEST_P(Relabelled, ModesSayTheSame) {
  if (skipped(0)) GTEST_SKIP() << "takes long: scripts/test --thorough";
  expect_same_output(scene(), "modes", [](const Scene& s) { return output_of(find_modes(s, s.effects, {})).json(); });
}
TEST_P(Relabelled, ReductionSaysTheSame) {
  if (skipped(1)) GTEST_SKIP() << "takes long: scripts/test --thorough";
  expect_same_output(scene(), "reduce", [](const Scene& s) {
    return output_of(reduce(s, {.positions = 5, .to = {}, .speed = {}, .orders = 4})).json();
  });
}

INSTANTIATE_TEST_SUITE_P(All, Relabelled, ::testing::Range<std::size_t>(0, twin_scenes().size()), name_of_twin);

}  // namespace
}  // namespace kurbel::relabelled_test
