// single_run.cpp — asks the study for one rung of its ladder.
#include "tests/coverage/single_run.h"

#include "engine/events/equations.h"
#include "studies/run/simulate.h"

namespace kurbel::coverage {

Result single_run(const std::shared_ptr<const Model>& model, const RunSetting& setting) {
  SimulateOptions options;
  options.measure_error = false;
  options.method = setting.method;
  options.first_tolerance = setting.tolerance;
  options.budget = setting.budget;
  return simulate(model, "run", options);
}

std::map<std::string, double> shifts_of_angles(const std::shared_ptr<const Model>& model,
                                               const std::shared_ptr<const Model>& shifted) {
  const auto angles_at_start = [](const std::shared_ptr<const Model>& m) {
    Equations equations(m, false);
    const std::vector<double> y = equations.start(0);
    const Snapshot& s = equations.snapshot(0, y);
    std::map<std::string, double> angles;
    for (const std::string& component : m->network.components)
      angles["final_angle." + component] = s.node_angle[m->network.ports.at(component).out];
    return angles;
  };
  std::map<std::string, double> shifts = angles_at_start(shifted);
  for (const auto& [figure, angle] : angles_at_start(model)) shifts[figure] -= angle;
  return shifts;
}

}  // namespace kurbel::coverage
