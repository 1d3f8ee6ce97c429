// checkpoint.cpp — state, modes and the loop's memory as JSON, whose numbers are exact.
#include "engine/run/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace kurbel {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(Command, value, rate, from, until, to, law, piece)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Modes, piece, prescribed_piece, active, on_since, direction, slip, loss_direction,
                                   loss_sign, regularised, capacity, turns, first_two_turns, command, next_step,
                                   armed_time, armed_angle, last_step_time, cycle_began)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoopMemory::Recent, time, fired)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoopMemory, implicit, last_event, last_jam, events_here, jams_here, shortened,
                                   last_step, recent, held_needed, held, explicit_step, implicit_steps, implicit_since,
                                   window_begin)

namespace {

using Json = nlohmann::json;

const char* const kind = "kurbel checkpoint 7";

std::vector<std::string> names_of(const Equations& equations) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < equations.size() - equations.integral_count(); ++i)
    names.push_back(equations.state_name(i));
  return names;
}

// Every list as long as this machine needs it, every number a number, every sense a sense.
void check(const Checkpoint& c, const Equations& equations) {
  const auto all_finite = [](const std::vector<double>& list) {
    return std::all_of(list.begin(), list.end(), [](double v) { return std::isfinite(v); });
  };
  const auto alike = [](const auto& a, const auto& b) { return a.size() == b.size(); };
  const Modes &m = c.state.modes, &own = equations.modes();
  const bool fits = alike(m.piece, own.piece) && alike(m.prescribed_piece, own.prescribed_piece) &&
                    alike(m.active, own.active) && alike(m.on_since, own.on_since) &&
                    alike(m.direction, own.direction) && alike(m.slip, own.slip) &&
                    alike(m.loss_direction, own.loss_direction) && alike(m.loss_sign, own.loss_sign) &&
                    alike(m.regularised, own.regularised) && alike(m.capacity, own.capacity) &&
                    alike(m.turns, own.turns) && alike(m.command, own.command);
  if (!fits) throw UnfitCheckpoint("is of a machine with other elements, contacts or commands than this scene's");
  const bool valid = std::isfinite(c.state.t) && all_finite(c.state.y) && all_finite(c.integrals) &&
                     all_finite(m.capacity) && all_finite(m.on_since) && all_finite(m.turns) &&
                     std::all_of(c.observers.begin(), c.observers.end(), all_finite) && c.loop.held_needed > 0 &&
                     c.loop.held >= 0 && c.loop.implicit_steps >= 0 && std::isfinite(c.loop.implicit_since) &&
                     std::isfinite(c.loop.window_begin) && c.loop.explicit_step >= 0 &&
                     m.next_step <= equations.model().scene.sequence.steps.size();
  const auto pieces = [](const std::vector<int>& list) {
    constexpr int most = 100'000'000;  // of a table's rows; a starter's pause keeps its begin as a negative number
    return std::all_of(list.begin(), list.end(), [](int v) { return v <= most; });
  };
  const auto follows = [&](const Command& c) {
    const auto& steps = equations.model().scene.sequence.steps;
    if (c.law < 0) return c.law == -1;
    return c.law < static_cast<int>(steps.size()) && !steps[static_cast<std::size_t>(c.law)].law.empty();
  };
  const auto senses = [](const std::vector<int>& list) {
    return std::all_of(list.begin(), list.end(), [](int v) { return v >= -1 && v <= 1; });
  };
  if (!valid || !std::all_of(m.command.begin(), m.command.end(), follows) || !pieces(m.piece) ||
      !pieces(m.prescribed_piece) || !senses(m.direction) || !senses(m.slip) || !senses(m.loss_direction) ||
      !senses(m.loss_sign))
    throw UnfitCheckpoint("holds values that no run leaves behind");
}

}  // namespace

std::string text_of(const Checkpoint& checkpoint, const Equations& equations) {
  const Json json{{"kind", kind},
                  {"states", names_of(equations)},
                  {"t", checkpoint.state.t},
                  {"y", checkpoint.state.y},
                  {"modes", checkpoint.state.modes},
                  {"integrals", checkpoint.integrals},
                  {"loop", checkpoint.loop},
                  {"observers", checkpoint.observers}};
  return json.dump(1) + "\n";
}

Checkpoint checkpoint_from(const std::string& text, const Equations& equations) {
  Checkpoint c;
  try {
    const Json json = Json::parse(text);
    if (json.at("kind") != kind) throw UnfitCheckpoint("is no state of this version; write it again with --save-state");
    const auto names = json.at("states").get<std::vector<std::string>>();
    const std::vector<std::string> own = names_of(equations);
    for (std::size_t i = 0; i < std::max(names.size(), own.size()); ++i)
      if (i >= names.size() || i >= own.size() || names[i] != own[i])
        throw UnfitCheckpoint(fmt::format("is of another machine: its state {} is {}, here it is {}", i + 1,
                                          i < names.size() ? names[i] : "missing",
                                          i < own.size() ? own[i] : "missing"));
    json.at("t").get_to(c.state.t);
    json.at("y").get_to(c.state.y);
    json.at("modes").get_to(c.state.modes);
    json.at("integrals").get_to(c.integrals);
    json.at("loop").get_to(c.loop);
    json.at("observers").get_to(c.observers);
    if (c.state.y.size() != own.size()) throw UnfitCheckpoint("has not as many values as states");
    if (!c.integrals.empty() && equations.audit() && c.integrals.size() != equations.integral_count())
      throw UnfitCheckpoint("has other accounts of work than this scene");
  } catch (const Json::exception&) {
    throw UnfitCheckpoint("is no state of a run; give a file that --save-state wrote");
  }
  check(c, equations);
  return c;
}

std::vector<std::vector<double>> memory_of(const std::vector<Observer*>& observers) {
  std::vector<std::vector<double>> memory;
  for (Observer* observer : observers) {
    Tape tape;
    observer->remember(tape);
    memory.push_back(tape.take());
  }
  return memory;
}

void recall(const std::vector<Observer*>& observers, const std::vector<std::vector<double>>& memory) {
  if (memory.empty()) return;
  if (memory.size() != observers.size()) throw std::invalid_argument("the checkpoint remembers other observers");
  for (std::size_t i = 0; i < observers.size(); ++i) {
    Tape tape(memory[i]);
    observers[i]->remember(tape);
    if (!tape.at_end()) throw std::invalid_argument("the checkpoint remembers another observer");
  }
}

}  // namespace kurbel
