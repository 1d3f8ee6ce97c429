// instance_text.cpp — the state of an instance, kept and restored, and as text, to the last bit.
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/run/checkpoint.h"
#include "library/fmi/instance.h"

namespace kurbel {

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
  const nlohmann::json json{{"kind", "kurbel instance 1"},
                            {"token", machine_.token},
                            {"here", text_of(state.here, *equations_)},
                            {"parameters", state.parameters},
                            {"inputs", state.inputs},
                            {"applied", state.applied},
                            {"slopes", state.slopes},
                            {"peaks", state.peaks},
                            {"started", state.started},
                            {"begin", state.begin}};
  return json.dump();
}

InstanceState Instance::state_from(const std::string& text) {
  made();
  InstanceState state;
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("kind") != "kurbel instance 1" || json.at("token") != machine_.token)
      throw std::invalid_argument("this is no state of this component");
    json.at("parameters").get_to(state.parameters);
    json.at("inputs").get_to(state.inputs);
    json.at("applied").get_to(state.applied);
    json.at("slopes").get_to(state.slopes);
    json.at("peaks").get_to(state.peaks);
    json.at("started").get_to(state.started);
    json.at("begin").get_to(state.begin);
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
