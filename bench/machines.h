// machines.h — the reference problems as models, and a clock.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "drivetrain/couplings/coupling.h"
#include "drivetrain/loads/loads.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/numerics/deadline.h"
#include "engine/run/run.h"
#include "studies/scenes/kinds.h"

namespace kurbel::bench {

// The E2 chain: N equal inertias of 0.01 kg·m² joined by k = 1e5 N·m/rad, c = 1 N·m·s/rad; 10 N·m on the first (or
// spread evenly over all), 0.5 N·m·s/rad against the last.
inline std::shared_ptr<const Model> equal_chain(int n, bool spread, double until = 0.2) {
  Network net;
  int before = -1;
  for (int i = 0; i < n; ++i) {
    const std::string name = "j" + std::to_string(i);
    const int node = net.add_node(name, "", 0.01);
    net.ports[name] = {node, node};
    net.components.push_back(name);
    if (before >= 0) net.connect(before, node, 1, "k" + std::to_string(i), Coupling{1e5, 1.0});
    if (spread || i == 0) net.put(node, name, HarmonicTorque{Account::driving, spread ? 10.0 / n : 10.0, 0, 0, 0});
    if (i + 1 == n) net.put(node, name, SpeedLoad{Account::useful, 0.5, 0});
    before = node;
  }
  Scene scene;
  scene.run.until = until;
  return compile_network(std::move(net), scene, Effects{true, {}});
}

inline std::shared_ptr<const Model> model_of(const std::string& scene) {
  const Scene read = read_scene(std::string(KURBEL_SOURCE_DIR) + "/scenes/" + scene + ".toml", all_kinds());
  return compile(read, read.effects);
}

// A bare run: no audit, nobody watching.
inline RunOutcome bare_run(Equations& equations, double tolerance, const std::string& method = "auto",
                           std::shared_ptr<WorkTables> tables = nullptr) {
  const RunOptions options{.tolerance = tolerance,
                           .method = method,
                           .until = equations.model().scene.run.until,
                           .budget = 600,
                           .interrupted = nullptr,
                           .progress = {},
                           .work_tables = std::move(tables)};
  return integrate(equations, options, {});
}
inline RunOutcome bare_run(const std::shared_ptr<const Model>& model, double tolerance,
                           const std::string& method = "auto", std::shared_ptr<WorkTables> tables = nullptr) {
  Equations equations(model, false);
  return bare_run(equations, tolerance, method, std::move(tables));
}

struct TimedRun {
  double median_seconds;
  RunOutcome outcome;
};
inline TimedRun timed(int repetitions, const std::function<RunOutcome()>& run) {
  std::vector<double> seconds;
  TimedRun result{0, run()};  // warm-up
  for (int i = 0; i < repetitions; ++i) {
    result.outcome = run();
    seconds.push_back(result.outcome.statistics.cpu_seconds);
  }
  std::nth_element(seconds.begin(), seconds.begin() + repetitions / 2, seconds.end());
  result.median_seconds = seconds[static_cast<std::size_t>(repetitions / 2)];
  return result;
}

inline double final_angle(const std::shared_ptr<const Model>& model, double tolerance, const std::string& method) {
  Equations equations(model, false);
  const RunOutcome out = bare_run(equations, tolerance, method);
  return equations.angle_with_turns(static_cast<std::size_t>(model->reduction_angle), out.state);
}

}  // namespace kurbel::bench
