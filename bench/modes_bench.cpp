// modes_bench.cpp — how long do the lowest 20 modes of a large drive take, branched and geared, and how do they grow?
#include "bench/benches.h"
#include "bench/machines.h"
#include "engine/linear/eigen_modes.h"

namespace kurbel::bench {
namespace {

// A trunk with a geared branch of four inertias at every fifth of its own.
std::shared_ptr<const Model> branched_and_geared(int n) {
  Network net;
  int i = 0, trunk = -1, springs = 0;
  const auto inertia = [&](double j) {
    const std::string name = "j" + std::to_string(i++);
    const int node = net.add_node(name, "", j);
    net.ports[name] = {node, node};
    net.components.push_back(name);
    return node;
  };
  const auto spring = [&](int a, int b, double k) {
    net.connect(a, b, 1, "k" + std::to_string(springs++), Coupling{k, 1e-5 * k});
  };
  while (i < n) {
    const int here = inertia(0.01 + 0.001 * (i % 7));
    if (trunk >= 0) spring(trunk, here, 1e5);
    trunk = here;
    if (i % 9 != 5) continue;
    const int wheel = inertia(0.002);
    net.join(here, wheel, 2.5, "gear" + std::to_string(i));
    for (int k = 0, before = wheel; k < 4 && i < n; ++k) {
      const int next = inertia(0.004);
      spring(before, next, 3e4 + 10 * i);
      before = next;
    }
  }
  return compile_network(std::move(net), Scene{}, Effects{true, {}});
}

void report(const char* what, const std::shared_ptr<const Model>& model) {
  double linear = 1e9, modes = 1e9, damped = 1e9;
  UndampedModes found;
  for (int repeat = 0; repeat < 3; ++repeat) {
    double begin = processor_time();
    const LinearDrive drive = linearise(model, {.speed = 100});
    linear = std::min(linear, processor_time() - begin);
    begin = processor_time();
    found = undamped_modes(drive, {.count = 20});
    modes = std::min(modes, processor_time() - begin);
    begin = processor_time();
    const auto swings = damped_modes(drive, found, {.count = 20});
    damped = std::min(damped, processor_time() - begin);
  }
  std::printf(
      "%-28s %7zu inertias  M, C, K %7.1f ms  20 modes %7.1f ms  damped %7.1f ms  basis %3d  residual %.1e  "
      "counted %d\n",
      what, model->network.nodes.size(), 1e3 * linear, 1e3 * modes, 1e3 * damped, found.basis, found.residual,
      found.counted_below);
}

}  // namespace

void costs_of_modes() {
  for (const int n : {100, 1000, 10000}) report("branched and geared", branched_and_geared(n));
  for (const int n : {1000, 10000, 100000}) report("equal chain", equal_chain(n, false));
  std::printf("\nAim: the lowest 20 modes of 10000 inertias, branched and geared, within 500 ms.\n");
}

}  // namespace kurbel::bench
