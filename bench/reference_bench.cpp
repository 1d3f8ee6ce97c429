// reference_bench.cpp — what do the reference problems R1, R2b, E1 and E2 cost, and how right are the answers?
//
// References: tests/cases/reference.toml (long-double integration with located events, confirmed by a second method).
#include <cmath>

#include "bench/machines.h"
#include "engine/recorders.h"
#include "engine/work_equation.h"
#include "mechanisms/multibody_run.h"

using namespace kurbel;
using namespace kurbel::bench;

namespace {

double r1_cost_at_1e6 = 0;

void crank_problem(const char* name, const char* scene, double reference) {
  const auto model = model_of(scene);
  std::printf("%s: error of the crank angle after 10 s against processor time\n  %-14s %-10s %12s %10s %8s\n", name, "",
              "tolerance", "error [rad]", "time [ms]", "steps");
  const auto tables = std::make_shared<WorkTables>(model);
  tables->edges(1);
  if (tables->of_angle_alone()) tables->diagram(1);
  for (const char* method : {"dop853", "work"})
    for (const double tolerance : {1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 5e-9, 1e-9, 1e-10, 1e-11}) {
      const TimedRun t = timed(101, [&] { return bare_run(model, tolerance, method, tables); });
      const double error = std::abs(final_angle(model, tolerance, method) - reference);
      std::printf("  %-14s %-10.0e %12.2e %10.3f %8lld\n",
                  std::string(method) == "work" ? "over the angle" : "over time", tolerance, error,
                  1e3 * t.median_seconds, static_cast<long long>(t.outcome.statistics.stepper.steps));
      if (error <= 1e-6 && r1_cost_at_1e6 == 0 && std::string(name) == "R1") r1_cost_at_1e6 = t.median_seconds;
    }
  if (!tables->of_angle_alone()) return;
  const WorkOverAngle& diagram = tables->diagram(1);
  WorkOverAngle::Motion end;
  constexpr int many = 1000;
  const StartSettings& begin = model->scene.run.start;
  const TimedRun t = timed(101, [&] {
    RunOutcome out;
    const double before = processor_seconds();
    for (int i = 0; i < many; ++i) end = diagram.advance(begin.angle, begin.speed, model->scene.run.until);
    out.statistics.cpu_seconds = (processor_seconds() - before) / many;
    return out;
  });
  std::printf("  %-14s %-10s %12.2e %10.4f\n", "work diagram", "",
              std::abs(static_cast<double>(end.cycles) * diagram.cycle() + end.s - reference), 1e3 * t.median_seconds);
}

void multibody() {
  MultibodyProblem problem;
  problem.mechanism = {.radius = 0.1,
                       .rod_length = 0.35,
                       .crank_inertia = 0.55,
                       .rod_mass = 2,
                       .rod_com = 0.1225,
                       .rod_inertia = 0.02,
                       .slider_mass = 3};
  problem.omega0 = 30;
  problem.t_end = 10;
  problem.accuracy = 1e-8;
  timespec a{}, b{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &a);
  const MultibodyResult result = run_multibody(problem);
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &b);
  const double seconds = static_cast<double>(b.tv_sec - a.tv_sec) + 1e-9 * static_cast<double>(b.tv_nsec - a.tv_nsec);
  std::printf(
      "R1 by Simbody's closed loop: error %.2e rad in %.2f s; the reduced machine to 1e-6 rad is %.0f times "
      "cheaper\n\n",
      std::abs(result.samples.back().phi - 294.719373652657), seconds, seconds / r1_cost_at_1e6);
}

void chain_e1() {
  const auto model = model_of("six_inertia_chain");
  std::printf(
      "E1: peak spring torque of c1 over 5 s (reference 290.808843395416 N·m at 15.016893772 ms)\n  %-10s %-22s %12s "
      "%14s %10s\n",
      "tolerance", "method", "error [N·m]", "time error [s]", "time [ms]");
  for (const char* method : {"dop853", "dopri5", "esdirk", "bdf"})
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      Equations equations(model, false);
      ExtremeRecorder peaks(extremes_of(*model));
      RunOptions options{
          .tolerance = tolerance, .method = method, .until = 5, .budget = 600, .interrupted = nullptr, .progress = {}};
      const RunOutcome out = integrate(equations, options, {&peaks});
      const auto& found = peaks.found()[1];
      std::printf("  %-10.0e %-22s %12.2e %14.2e %10.2f\n", tolerance, method, std::abs(found.value - 290.808843395416),
                  std::abs(found.time - 0.015016893772), 1e3 * out.statistics.cpu_seconds);
    }
  std::printf("\n");
}

void chains_e2() {
  std::printf(
      "E2: chains of N equal inertias for 0.2 s; cost per step and inertia should not grow with N\n  %-8s %-8s %10s "
      "%10s %22s %14s %14s\n",
      "N", "torque", "steps", "time [ms]", "per step and inertia", "omega first", "omega last");
  for (const bool spread : {false, true})
    for (const int n : {10, 100, 1000, 10000, 100000}) {
      const auto model = equal_chain(n, spread);
      const TimedRun t = timed(n >= 10000 ? 1 : 5, [&] { return bare_run(model, 1e-6, "dop853"); });
      const double steps = static_cast<double>(t.outcome.statistics.stepper.steps);
      std::printf("  %-8d %-8s %10.0f %10.2f %19.1f ns %14.7f %14.7f\n", n, spread ? "spread" : "first", steps,
                  1e3 * t.median_seconds, 1e9 * t.median_seconds / steps / n,
                  t.outcome.state[static_cast<std::size_t>(n)], t.outcome.state[2 * static_cast<std::size_t>(n) - 1]);
    }
  std::printf("  reference: N = 10: 12.64599, 12.64191; N = 100: 2.09731, 1.81029\n\n");
}

Scene stiffened(Scene scene, double factor, bool damping_ratio) {
  for (Section& section : scene.components) {
    for (Setting& setting : section.settings) {
      if (setting.key == "stiffness") setting.number *= factor;
      if (setting.key == "damping" && damping_ratio && section.kind->elastic) {
        setting.key = "damping_ratio";
        setting.number = 0.03;
      }
    }
  }
  return scene;
}

// Couplings stiffened at constant damping ratio: smooth torques, a step torque, and a press with load edges.
void rigid_limit() {
  std::printf("Rigid limit: couplings stiffened, damping ratio kept, tolerance 1e-7\n  %-42s %-12s %10s %8s  %s\n",
              "machine", "stiffness ×", "time [ms]", "ratio", "method");
  const std::string folder = std::string(KURBEL_SOURCE_DIR) + "/scenes/";
  Scene smooth = read_scene(folder + "six_inertia_chain.toml", all_kinds()), step = smooth;
  smooth.run.start.equilibrium = true;
  const Scene press = read_scene(folder + "crank_press.toml", all_kinds());
  const std::pair<const char*, const Scene*> cases[] = {{"chain E1 started in balance (smooth torques)", &smooth},
                                                        {"chain E1 from rest (step torque)", &step},
                                                        {"press (load edges that ring)", &press}};
  for (const auto& [name, scene] : cases) {
    double first = 0;
    for (const double factor : {1.0, 10.0, 100.0, 1000.0}) {
      const Scene stiff = stiffened(*scene, factor, true);
      const auto model = compile(stiff, stiff.effects);
      const TimedRun t = timed(5, [&] { return bare_run(model, 1e-7); });
      if (first == 0) first = t.median_seconds;
      std::printf("  %-42s %-12.0f %10.2f %8.2f  %s, %lld steps\n", name, factor, 1e3 * t.median_seconds,
                  t.median_seconds / first, t.outcome.statistics.method.c_str(),
                  static_cast<long long>(t.outcome.statistics.stepper.steps));
    }
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  print_machine();
  if (argc > 1 && std::string(argv[1]) == "rigid") {
    rigid_limit();
    return 0;
  }
  crank_problem("R1", "free_slider_crank", 294.719373652657);
  multibody();
  crank_problem("R2b", "driven_slider_crank", 175.990300636005);
  std::printf("\n");
  chain_e1();
  chains_e2();
  rigid_limit();
  std::printf(
      "Conclusion: R1 to 1e-6 rad costs %.2f ms by time stepping; peaks of E1 are right to the tolerance's digits with "
      "every\n"
      "method; cost grows linearly with the number of inertias.\n",
      1e3 * r1_cost_at_1e6);
}
