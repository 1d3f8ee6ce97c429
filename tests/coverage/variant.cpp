// variant.cpp — draws a variant until reader, compiler and method take it.
#include "tests/coverage/variant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "engine/events/equations.h"
#include "engine/rigid/work_equation.h"
#include "engine/scene/document.h"
#include "studies/scenes/kinds.h"
#include "tests/coverage/variant_motors.h"

namespace kurbel::coverage {
namespace {

constexpr int most_draws = 60;

std::uint64_t hash_of(const std::string& scene, std::uint64_t seed, int draw) {
  std::uint64_t h = 0xcbf29ce484222325;
  const auto take = [&](std::uint64_t v) { h = (h ^ v) * 0x100000001b3; };
  for (const char c : scene) take(static_cast<unsigned char>(c));
  for (int i = 0; i < 8; ++i) take((seed >> (8 * i)) & 255);
  take(static_cast<std::uint64_t>(draw));
  return h ^ (h >> 29);
}

std::string path_of(const std::string& scene) { return fmt::format("{}/scenes/{}.toml", KURBEL_SOURCE_DIR, scene); }

// Which effects are on: mostly those of the scene.
std::string effects_table(const Scene& original, const Scene& scene, bool rigid, Dice& dice) {
  const Effects& effects = original.effects;
  std::vector<std::string> elastic;
  for (const Section& s : scene.components)
    if (s.kind->elastic) elastic.push_back(s.name);
  std::string names;
  const double all_or_none = dice.uniform();
  for (const std::string& name : elastic) {
    bool on = all_or_none < 0.15 ? true : all_or_none < 0.3 ? false : effects.is_elastic(name);
    if (all_or_none > 0.9) on = dice.chance(0.5);
    if (on && !rigid) names += (names.empty() ? "\"" : ", \"") + name + "\"";
  }
  std::string text = fmt::format("\n[effects]\nelasticity = [{}]\n", names);
  for (const EffectFlag& flag : effect_flags()) {
    // Simbody in the loop is the same physics at many times the cost.
    if (flag.flag == &Effects::multibody) continue;
    const bool possible = flag.is_usual() || has_parameters(scene, flag);
    bool on = effects.*(flag.flag) ||
              (flag.by_default == EffectFlag::Default::where_given && !has_parameters(original, flag));
    if (dice.chance(flag.is_usual() ? 0.08 : 0.25)) on = !on;
    if (possible) text += fmt::format("{} = {}\n", flag.name, on);
  }
  return text;
}

bool turns_a_mechanism(const Scene& scene) {
  return std::any_of(scene.components.begin(), scene.components.end(), [](const Section& s) {
    const std::string& kind = s.kind->name;
    return kind == "slider-crank" || kind == "four-bar" || kind == "quick-return" || kind == "inverted slider-crank" ||
           kind == "knuckle press";
  });
}

std::string run_table(const Scene& scene, double accuracy, const std::string& method, double length, Dice& dice) {
  const StartSettings& start = scene.run.start;
  const double faster = dice.factor(0.7, 1.4);
  double angle = start.angle;
  if (turns_a_mechanism(scene) && dice.chance(0.7)) angle = 2 * std::numbers::pi * dice.uniform();
  std::string text =
      fmt::format("start    = {{ angle = \"{:.9g} rad\", speed = \"{:.9g} rad/s\"", angle, faster * start.speed);
  if (start.equilibrium) text += ", equilibrium = true";
  if (!start.on.empty()) text += fmt::format(", on = \"{}\"", start.on);
  for (const auto& [component, c] : start.components) {
    text += ", " + component + " = {";
    const char* comma = " ";
    const auto put = [&](const char* key, const std::optional<double>& value, const char* unit, double by) {
      if (!value) return;
      text += fmt::format("{}{} = \"{:.9g} {}\"", comma, key, *value * by, unit);
      comma = ", ";
    };
    put("angle", c.angle, "rad", 1);
    put("speed", c.speed, "rad/s", faster);
    put("twist", c.twist, "rad", 1);
    text += " }";
  }
  text += " }\n";
  const double until = length * scene.run.until * dice.between(0.15, 1);
  return fmt::format("\n[run]\n{}until    = \"{:.6g} s\"\naccuracy = {:.0e}\nmethod   = \"{}\"\n", text, until,
                     accuracy, method);
}

// Reasons without names and numbers, so that they can be counted.
std::string kind_of_reason(const std::string& message) {
  std::string reason = message.substr(0, message.find('\n'));
  if (const std::size_t place = reason.find(".toml:"); place != std::string::npos) {
    const std::size_t words = reason.find(": ", place);
    if (words != std::string::npos) reason = reason.substr(words + 2);
  }
  std::string kind;
  bool quoted = false;
  for (const char c : reason) {
    if (c == '"') {
      quoted = !quoted;
      if (quoted) kind += "…";
      continue;
    }
    if (quoted) continue;
    const bool digit = c >= '0' && c <= '9';
    if (digit && kind.ends_with('#')) continue;
    if ((c == '.' || c == 'e' || c == '-') && kind.ends_with('#') && c == '.') continue;
    kind += digit ? '#' : c;
  }
  return kind.substr(0, 110);
}

// Empty: the method integrates the variant.
std::string refusal_by_method(const Scene& scene, const std::string& method) {
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  equations.start(0);
  if (method != "work" && method != "fehlberg8") return {};
  if (method == "work") return WorkTables::refusal(model);
  if (model->free_shafts < model->shafts.size()) return "a speed is prescribed over time";
  for (const Network::ShaftElement& e : model->network.elements)
    if (e.element->uses_time) return "a torque depends on time";
  return {};
}

}  // namespace

const std::vector<std::string>& scene_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const auto& file : std::filesystem::directory_iterator(KURBEL_SOURCE_DIR "/scenes"))
      if (file.path().extension() == ".toml") found.push_back(file.path().stem());
    std::sort(found.begin(), found.end());
    return found;
  }();
  return names;
}

const std::vector<std::string>& methods() { return methods_of("reduced"); }

const std::vector<double>& accuracies() {
  static const std::vector<double> all = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
  return all;
}

Variant make_variant(const std::string& scene, std::uint64_t seed, double length) {
  const std::string path = path_of(scene), original = read_text_file(path, max_scene_bytes);
  const Scene plain = parse_scene(original, path, all_kinds());
  Variant variant{.scene = scene, .seed = seed, .text = {}, .method = {}, .refused = {}, .read = {}};
  for (int draw = 0; draw < most_draws; ++draw) {
    Dice dice(hash_of(scene, seed, draw));
    variant.method = methods()[dice.index(methods().size())];
    variant.accuracy = accuracies()[dice.index(accuracies().size())];
    const std::string moved = with_other_motors(moved_text(original, path, dice), path, dice);
    try {
      // Effects of the scene as it was, switched where the machine as it is has parameters for them.
      const Scene machine = parse_scene(moved, path, all_kinds());
      variant.text = moved + effects_table(plain, machine, variant.method == "work", dice) +
                     run_table(plain, variant.accuracy, variant.method, length, dice);
      variant.read = parse_scene(variant.text, path, all_kinds());
      const std::string why = refusal_by_method(variant.read, variant.method);
      if (why.empty()) return variant;
      ++variant.refused[fmt::format("method \"{}\": {}", variant.method, kind_of_reason(why))];
    } catch (const std::exception& error) {
      ++variant.refused[kind_of_reason(error.what())];
    }
  }
  std::string reasons;
  for (const auto& [reason, count] : variant.refused) reasons += fmt::format("\n{} × {}", count, reason);
  throw std::runtime_error(
      fmt::format("{} draws of {} with seed {} were refused:{}", most_draws, scene, seed, reasons));
}

std::optional<Scene> started_a_cycle_on(const Model& model) {
  const auto whole_turns = [&](int node) {
    const double turns = model.node_ratio[static_cast<std::size_t>(node)] * model.cycle / (2 * std::numbers::pi);
    return std::abs(turns - std::round(turns)) < 1e-9;
  };
  if (!(model.cycle > 0)) return {};
  for (const SequenceStep& step : model.scene.sequence.steps)
    if (step.when == SequenceStep::When::angle) return {};
  for (const Network::ShaftElement& e : model.network.elements)
    if (e.element->is.uses_angle && !whole_turns(e.node)) return {};
  for (const Network::Joint& joint : model.network.joints)
    if (joint.element && joint.element->is.uses_angle && !whole_turns(joint.a)) return {};
  Scene shifted = model.scene;
  StartSettings& start = shifted.run.start;
  const auto ratio_of = [&](const std::string& component) {
    const int node = component.empty() ? model.reduction_node : model.network.ports.at(component).in;
    return model.node_ratio[static_cast<std::size_t>(node)];
  };
  start.angle += model.cycle * ratio_of(start.on);
  for (auto& [component, own] : start.components)
    if (own.angle) *own.angle += model.cycle * ratio_of(component);
  return shifted;
}

}  // namespace kurbel::coverage
