// slip_recorder.cpp — the state of a joint over a step, by its mode and its command at both ends of it.
#include "studies/answers/slip_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/numerics/index.h"
#include "engine/numerics/turns.h"

namespace kurbel {
namespace {

using State = SlipRecorder::State;

State next_state(State before, bool open, bool closed, bool slips) {
  if (open) return State::open;
  if (!slips) return State::locked;
  if (!closed) return State::engaging;
  return before == State::locked || before == State::let_go ? State::let_go : State::engaging;
}

}  // namespace

SlipRecorder::SlipRecorder(const Model& m) {
  for (std::size_t e = 0; e < m.elastic.size(); ++e) {
    const ElasticJoint& joint = m.elastic[e];
    const std::string& component = m.network.joints[at(joint.joint)].component;
    const std::string kind = m.network.kind_of(component);
    if (!joint.slips || (kind != "clutch" && kind != "torque limiter" && kind != "one-way clutch")) continue;
    Joint made{.component = component, .kind = kind, .elastic = e};
    made.usual_speed = std::abs(joint.gain_a * m.shafts[at(joint.shaft_a)].speed_scale);
    made.command = m.command_of(component);
    joints_.push_back(std::move(made));
  }
}

void SlipRecorder::step(StepView& view) {
  const Modes& modes = view.equations().modes();
  const Model& m = view.equations().model();
  for (Joint& joint : joints_) {
    const auto command = [&](double t) {
      return joint.command < 0 ? 1.0 : modes.command[at(joint.command)].at(t, m.scene.sequence);
    };
    const double begin = command(view.t_previous()), end = command(view.t());
    constexpr double full = 1 - 1e-12;
    joint.closed = begin >= full && end >= full;
    const State state =
        next_state(joint.state, std::max(begin, end) <= 0, joint.closed, modes.slip[joint.elastic] != 0);
    Spell* spell = state == State::open       ? &joint.open
                   : state == State::engaging ? &joint.engaging
                   : state == State::let_go   ? &joint.let_go
                                              : nullptr;
    if (spell && state != joint.state && spell->times++ == 0) spell->first = view.t_previous();
    joint.state = state;
    joint.gripped = joint.gripped || state == State::locked;
    if (state == State::open && std::exchange(joint.slips_closed, false)) ++joint.in_vain;
    joint.slips_closed = joint.slips_closed || (state == State::engaging && joint.closed);
    if (!spell || state == State::open) continue;
    const ElasticJoint& e = m.elastic[joint.elastic];
    const auto speed = [&](int shaft, double t) {
      return at(shaft) < m.free_shafts ? view.at(t, view.equations().speed_index(shaft))
                                       : view.snapshot(t).now.speed[shaft];
    };
    const auto slip = [&](double t) { return e.gain_a * speed(e.shaft_a, t) - e.gain_b * speed(e.shaft_b, t); };
    const auto see = [&](double t) { spell->fastest = std::max(spell->fastest, std::abs(slip(t))); };
    see(view.t_previous()), see(view.t());
    for_each_turn_within(view.t_previous(), view.t(), slip, see);
  }
}

}  // namespace kurbel
