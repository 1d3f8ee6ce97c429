// holding.cpp — torques of joints that are locked at full command, over what they hold.
#include "studies/duty/holding.h"

#include <cmath>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double closed = 1 - 1e-6;  // a command may come to 1 as exp does: never in full
constexpr double least_held = 1e-6;  // of the capacity: what passes less than that on has no reserve worth a figure

// A joint that locks, and the command that closes it; −1: it is always closed.
struct Holder {
  std::string component;
  int elastic = 0, joint = 0, command = -1;
  double capacity = 0, scale = 1;  // M_s, usual torque [N·m]
};

std::vector<Holder> holders_of(const Model& m) {
  std::vector<Holder> list;
  for (std::size_t e = 0; e < m.elastic.size(); ++e) {
    const int joint = m.elastic[e].joint;
    const std::string& component = m.network.joints[at(joint)].component;
    const std::string kind = m.network.kind_of(component);
    if (!m.elastic[e].slips || (kind != "clutch" && kind != "torque limiter")) continue;
    Holder h{.component = component, .elastic = static_cast<int>(e), .joint = joint};
    h.capacity = m.network.joints[at(joint)].element->capacity;
    h.scale = m.torque_scale / m.scale_ratio[at(m.network.joints[at(joint)].a)];
    h.command = m.command_of(component);
    list.push_back(h);
  }
  return list;
}

}  // namespace

std::vector<ExtremeOf> held_torques_of(const Model& model) {
  std::vector<ExtremeOf> wanted;
  for (const Holder& h : holders_of(model))
    wanted.push_back({.name = Name::own("held_torque", h.component),
                      .unit = "N*m",
                      .scale = h.scale,
                      .value =
                          [h](const Snapshot& s) {
                            const bool holds = h.command < 0 || s.now.command[h.command] >= closed;
                            return holds && s.now.slip[h.elastic] == 0 ? s.joint_torque[h.joint] : 0.0;
                          },
                      .rate = {}});
  return wanted;
}

void report_reserves(const Model& model, FigureReporter& report) {
  for (const Holder& h : holders_of(model))
    report("torque_reserve", h.component, [&]() -> std::optional<Found> {
      const Figure* held = report.find("held_torque." + h.component);
      if (!held || !(std::abs(held->value) > least_held * h.capacity)) return {};
      return Found{h.capacity / std::abs(held->value), 1};
    });
}

}  // namespace kurbel
