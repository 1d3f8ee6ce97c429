// instance_text.cpp — the state of an instance, kept and restored, and as text, to the last bit.
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/run/checkpoint.h"
#include "library/fmi/instance.h"

namespace kurbel {
namespace {

const char* const instance_kind = "kurbel instance 1";

// What is kept as it is; `here` has a text of its own.
template <class State, class Take>
void each_kept(State& state, const Take& take) {
  take("parameters", state.parameters), take("inputs", state.inputs), take("applied", state.applied);
  take("slopes", state.slopes), take("peaks", state.peaks), take("started", state.started), take("begin", state.begin);
}

}  // namespace

InstanceState Instance::state() {
  made();
  s_.here.state.modes = equations_->modes();
  return s_;
}

void Instance::restore(const InstanceState& state) {
  s_ = state;
  if (s_.stale) return;
  if (compiled_ != s_.parameters) compile();
  equations_->bind(s_.here.state.modes);
}

std::string Instance::text(const InstanceState& state) {
  made();
  nlohmann::json json{{"kind", instance_kind}, {"token", machine_.token}, {"here", text_of(state.here, *equations_)}};
  each_kept(state, [&](const char* key, const auto& member) { json[key] = member; });
  return json.dump();
}

InstanceState Instance::state_from(const std::string& text) {
  made();
  InstanceState state;
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("kind") != instance_kind || json.at("token") != machine_.token)
      throw std::invalid_argument("this is no state of this component");
    each_kept(state, [&](const char* key, auto& member) { json.at(key).get_to(member); });
    state.here = checkpoint_from(json.at("here").get<std::string>(), *equations_);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("this is no state of this component: ") + error.what());
  }
  if (state.parameters.size() != s_.parameters.size() || state.inputs.size() != s_.inputs.size() ||
      state.applied.size() != s_.inputs.size() || state.slopes.size() != s_.inputs.size() ||
      (!state.peaks.empty() && state.peaks.size() != view_->peaks.size()))
    throw std::invalid_argument("this is no state of this component: its ports are others");
  state.stale = false;
  return state;
}

}  // namespace kurbel
