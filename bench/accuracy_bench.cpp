// accuracy_bench.cpp — how long do R1, R2b, R2stick, E1 and the example scenes take to a given error, and how long
// peers?
//
// References: tests/cases/reference.toml (long-double integration with located events, confirmed by a second method).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/benches.h"
#include "bench/machines.h"
#include "bench/peers/hand_written.h"
#include "bench/peers/simbody_loops.h"
#ifdef KURBEL_MUJOCO
#include "bench/peers/mujoco_crank.h"
#endif
#include "engine/rigid/work_equation.h"
#include "engine/run/recorders.h"
#include "engine/scene/units.h"
#include "mechanisms/bodies/multibody_run.h"
#include "mechanisms/reduced/mechanism_data.h"
#include "studies/accuracy/accuracy.h"
#include "studies/report/write_output.h"
#include "studies/run/run_findings.h"

namespace kurbel::bench {
namespace {

constexpr double tolerances[] = {1e-3, 1e-4, 1e-5, 3e-6,  1e-6,  1e-7,  3e-8,
                                 1e-8, 3e-9, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};

// Median, fastest and slowest of runs, some 0.2 s of them.
template <class Run>
void take_times(BenchPoint& p, Run run) {
  std::vector<double> seconds;
  double sum = 0;
  while (seconds.size() < 3 || (seconds.size() < 101 && sum < 0.2)) {
    seconds.push_back(run());
    sum += seconds.back();
    if (sum > 3) break;
  }
  std::sort(seconds.begin(), seconds.end());
  p.seconds = seconds[seconds.size() / 2];
  p.fastest = seconds.front();
  p.slowest = seconds.back();
}

// The crank's angle at the end, bare: nobody watches.
BenchCurve crank_curve(const std::string& problem, const std::shared_ptr<const Model>& model, const std::string& method,
                       double reference) {
  BenchCurve curve{.problem = problem, .solver = "kurbel " + method, .points = {}};
  const auto tables = std::make_shared<WorkTables>(model);
  tables->edges(1);
  if (tables->of_angle_alone()) tables->diagram(1);
  for (const double tolerance : tolerances) {
    BenchPoint p{.setting = tolerance};
    p.error = std::abs(final_angle(model, tolerance, method) - reference);
    RunOutcome outcome = bare_run(model, tolerance, method, tables);
    p.steps = static_cast<long>(outcome.statistics.stepper.steps);
    take_times(p, [&] { return bare_run(model, tolerance, method, tables).statistics.cpu_seconds; });
    curve.points.push_back(p);
    if (p.seconds > 0.5) break;
  }
  return curve;
}

const std::vector<const char*> time_methods = {"dop853", "verner6", "fehlberg8", "dopri5",
                                               "adams",  "esdirk",  "esdirk5",   "bdf"};

BenchCurve hand_curve(const std::string& problem, const std::string& method,
                      BenchPoint (*run)(const std::string&, double)) {
  BenchCurve curve{.problem = problem, .solver = "hand-written " + method, .peer = true, .points = {}};
  for (const double tolerance : tolerances) curve.points.push_back(run(method, tolerance));
  return curve;
}

void free_crank(BenchBook& book) {
  const auto model = model_of("free_slider_crank");
  const double reference = 294.719373652657;
  for (const char* method : time_methods) book.curves.push_back(crank_curve("R1", model, method, reference));
  book.curves.push_back(crank_curve("R1", model, "work", reference));

  BenchCurve diagram{.problem = "R1", .solver = "kurbel work diagram", .points = {}};
  WorkTables tables(model);
  const WorkOverAngle& work = tables.diagram(1);
  WorkOverAngle::Motion end;
  BenchPoint p;
  constexpr int many = 1000;
  take_times(p, [&] {
    const double before = processor_time();
    for (int i = 0; i < many; ++i) end = work.advance(0, 30, 10);
    return (processor_time() - before) / many;
  });
  p.error = std::abs(static_cast<double>(end.cycles) * work.cycle() + end.s - reference);
  diagram.points.push_back(p);
  book.curves.push_back(diagram);

  for (const char* method : {"dop853", "verner6", "dopri5"})
    book.curves.push_back(hand_curve("R1", method, hand_written_r1));

  MultibodyProblem problem;
  problem.mechanism = MechanismData(SliderCrankData{.radius = 0.1,
                                                    .rod_length = 0.35,
                                                    .crank_inertia = 0.55,
                                                    .rod_mass = 2,
                                                    .rod_com = 0.1225,
                                                    .rod_inertia = 0.02,
                                                    .slider_mass = 3})
                          .bodies_of();
  problem.omega0 = 30;
  problem.t_end = 10;
  for (const char* integrator : {"RungeKuttaMerson", "RungeKuttaFeldberg", "CPodes"}) {
    BenchCurve plane{
        .problem = "R1", .solver = fmt::format("Simbody {}, point in plane", integrator), .peer = true, .points = {}};
    BenchCurve ball{
        .problem = "R1", .solver = fmt::format("Simbody {}, slider and ball", integrator), .peer = true, .points = {}};
    for (const double accuracy : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
      BenchPoint a{.setting = accuracy}, b{.setting = accuracy};
      problem.accuracy = accuracy;
      problem.integrator = integrator;
      double before = processor_time();
      try {
        const MultibodyResult result = run_multibody(problem);
        a.seconds = a.fastest = a.slowest = processor_time() - before;
        a.error = std::abs(result.samples.back().phi - reference);
        a.steps = result.steps;
        plane.points.push_back(a);
      } catch (const std::exception& failure) {
        std::printf("%s at %.0e: %s\n", plane.solver.c_str(), accuracy, failure.what());
      }
      if (accuracy < 1e-10) continue;  // the ball costs twice as much
      before = processor_time();
      try {
        const SimbodyEnd end_of_ball = simbody_r1_with_slider(integrator, accuracy);
        b.seconds = b.fastest = b.slowest = processor_time() - before;
        b.error = std::abs(end_of_ball.phi - reference);
        b.steps = end_of_ball.steps;
        ball.points.push_back(b);
      } catch (const std::exception& failure) {
        std::printf("%s at %.0e: %s\n", ball.solver.c_str(), accuracy, failure.what());
      }
    }
    book.curves.push_back(plane);
    book.curves.push_back(ball);
  }
#ifdef KURBEL_MUJOCO
  BenchCurve mujoco{.problem = "R1", .solver = "MuJoCo RK4", .peer = true, .points = {}};
  for (const double step : {2e-4, 1e-4, 3e-5}) {
    BenchPoint m{.setting = step};
    const double before = processor_time();
    m.error = std::abs(mujoco_r1(step) - reference);
    m.seconds = m.fastest = m.slowest = processor_time() - before;
    m.steps = std::lround(10 / step);
    mujoco.points.push_back(m);
  }
  book.curves.push_back(mujoco);
#endif
}

void driven_crank(BenchBook& book) {
  const auto model = model_of("driven_slider_crank");
  for (const char* method : time_methods) book.curves.push_back(crank_curve("R2b", model, method, 175.990300636005));
  book.curves.push_back(crank_curve("R2b", model, "work", 175.990300636005));
  for (const char* method : {"dop853", "verner6", "dopri5"})
    book.curves.push_back(hand_curve("R2b", method, hand_written_r2b));
}

// Stops under its load and is held for ever.
void sticking_crank(BenchBook& book) {
  Scene scene = read_scene(std::string(KURBEL_SOURCE_DIR) + "/scenes/driven_slider_crank.toml", all_kinds());
  scene.run.start.speed = 10;
  const auto model = compile(scene, scene.effects);
  for (const char* method : {"dop853", "verner6", "work"})
    book.curves.push_back(crank_curve("R2stick", model, method, 2.01784108852116));
}

BenchPoint chain_point(const std::shared_ptr<const Model>& model, const std::string& method, double tolerance) {
  std::vector<ExtremeOf> wanted = extremes_of(*model);
  std::erase_if(wanted, [](const ExtremeOf& e) { return e.name != "peak_spring_torque.c1"; });
  BenchPoint p{.setting = tolerance};
  take_times(p, [&] {
    Equations equations(model, false);
    ExtremeRecorder peaks(wanted);
    RunOptions options{
        .tolerance = tolerance, .method = method, .until = 5, .budget = 600, .interrupted = nullptr, .progress = {}};
    const RunOutcome out = integrate(equations, options, {&peaks});
    p.error = std::abs(std::abs(peaks.found()[0].value) - 290.808843395416);
    p.steps = static_cast<long>(out.statistics.stepper.steps);
    return out.statistics.cpu_seconds;
  });
  return p;
}

BenchCurve chain_curve(const std::shared_ptr<const Model>& model, const std::string& method) {
  BenchCurve curve{.problem = "E1", .solver = fmt::format("kurbel {}", method), .points = {}};
  for (const double tolerance : tolerances) {
    curve.points.push_back(chain_point(model, method, tolerance));
    if (curve.points.back().seconds > 0.5) break;
  }
  return curve;
}

void chain_peak(BenchBook& book) {
  const auto model = model_of("six_inertia_chain");
  for (const char* method : time_methods) book.curves.push_back(chain_curve(model, method));
  for (const char* method : {"dop853", "verner6", "dopri5"})
    book.curves.push_back(hand_curve("E1", method, hand_written_e1));
}

std::string times(double ratio) { return std::isfinite(ratio) ? fmt::format("{:.3g} ×", ratio) : "not reached"; }
std::string in_ms(double seconds) {
  return std::isfinite(seconds) ? fmt::format("{:.4g} ms", 1e3 * seconds) : "not reached";
}

void judge_problems(BenchBook& book) {
  const auto named = [](const std::string& name) { return [name](const BenchCurve& c) { return c.solver == name; }; };
  const auto starting = [](const std::string& name) {
    return [name](const BenchCurve& c) { return c.solver.starts_with(name); };
  };
  const auto over_time = [](const BenchCurve& c) { return !c.peer && c.solver.find("work") == std::string::npos; };
  const double simbody = book.best("R1", 1e-6, starting("Simbody")), ours = book.best("R1", 1e-6, over_time),
               diagram = book.best("R1", 1e-6, named("kurbel work diagram"));
  book.target("R1 to 1e-6 over time, against Simbody's best", "≥ 500 ×", times(simbody / ours), simbody / ours >= 500);
  book.target("R1 to 1e-6 by the work diagram, against Simbody's best", "≥ 1e5 ×", times(simbody / diagram),
              simbody / diagram >= 1e5);
  for (const char* problem : {"R1", "R2b", "E1"})
    for (const char* method : {"dop853", "verner6", "dopri5"}) {
      const double ratio = book.best(problem, 1e-6, named(fmt::format("kurbel {}", method))) /
                           book.best(problem, 1e-6, named(fmt::format("hand-written {}", method)));
      if (std::isnan(ratio)) continue;
      book.target(fmt::format("{} to 1e-6 by {}, against the hand-written loop", problem, method), "≤ 1.3 ×",
                  times(ratio), ratio <= 1.3);
    }
  const double tight = book.best("R1", 1e-9, named("kurbel work diagram"));
  book.target("R1 to 1e-9 by the work diagram", "≤ 0.01 ms", in_ms(tight), tight <= 1e-5);
  const double edges = book.best("R2b", 1e-6, [](const BenchCurve& c) { return !c.peer; });
  book.target("R2b to 1e-6", "≤ 0.5 ms", in_ms(edges), edges <= 5e-4);
  const double peak = book.best("E1", 1e-6, [](const BenchCurve& c) { return !c.peer; });
  book.target("E1, peak spring torque to 1e-6 N·m over 5 s", "≤ 3 ms", in_ms(peak), peak <= 3e-3);
}

// Reading, compiling, running to 1e-6 with its errors measured, and the report on disk.
void whole_program(BenchBook& book) {
  BenchPoint p;
  const auto folder = std::filesystem::temp_directory_path() / "kurbel_bench_press";
  take_times(p, [&] {
    const double before = processor_time();
    Scene scene = read_scene(std::string(KURBEL_SOURCE_DIR) + "/scenes/crank_press.toml", all_kinds());
    SimulateOptions options;
    options.traces = true;
    options.accuracy = 1e-6;
    const Result result = simulate(scene, scene.effects, "elastic", options);
    write_output(output_of(result), folder.string());
    return processor_time() - before;
  });
  std::filesystem::remove_all(folder);
  book.target("press, elastic, to 1e-6, whole program with report", "≤ 500 ms", in_ms(p.seconds), p.seconds <= 0.5);
}

}  // namespace

void accuracy_of_problems(BenchBook& book) {
  free_crank(book);
  driven_crank(book);
  sticking_crank(book);
  chain_peak(book);
  judge_problems(book);
  whole_program(book);
}

// The same method on both sides, in turn, so that a machine that is shared slows both alike.
void ratios_to_hand_written(BenchBook& book) {
  constexpr int turns = 5;
  const std::string method = "dop853";
  const auto free = model_of("free_slider_crank"), driven = model_of("driven_slider_crank"),
             chain = model_of("six_inertia_chain");
  const auto in_turn = [&](const std::string& problem, const auto& ours,
                           BenchPoint (*by_hand)(const std::string&, double)) {
    std::vector<double> ratios;
    for (int turn = 0; turn < turns; ++turn) {
      const BenchCurve curve = ours();
      ratios.push_back(curve.time_to(1e-6) / hand_curve(problem, method, by_hand).time_to(1e-6));
    }
    std::sort(ratios.begin(), ratios.end());
    return std::vector<std::string>{problem, times(ratios[turns / 2]),
                                    fmt::format("{:.3g} … {:.3g}", ratios.front(), ratios.back())};
  };
  book.tables.push_back(
      {.title = "Processor time to 1e-6 by dop853 over that of the loop by hand, five turns of both",
       .columns = {"problem", "median", "range"},
       .rows = {in_turn(
                    "R1", [&] { return crank_curve("R1", free, method, 294.719373652657); }, hand_written_r1),
                in_turn(
                    "R2b", [&] { return crank_curve("R2b", driven, method, 175.990300636005); }, hand_written_r2b),
                in_turn(
                    "E1", [&] { return chain_curve(chain, method); }, hand_written_e1)}});
}

void accuracy_of_scenes(BenchBook& book) {
  Table table{.title = "Example scenes: what their key figure costs",
              .columns = {"scene", "found"},
              .rows = {},
              .text_columns = 2};
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(KURBEL_SOURCE_DIR) + "/scenes"))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const auto& path : scenes) {
    try {
      AccuracyOptions options;
      options.tolerances = {1e-3, 1e-5, 1e-7, 1e-9};
      options.methods = {"work", "dopri5", "verner6", "dop853", "esdirk", "bdf"};
      options.multibody = false;
      options.time = 15;
      const AccuracyStudy study = measure_accuracy(read_scene(path.string(), all_kinds()), options);
      for (std::size_t i = 0; i < study.findings.size(); ++i)
        table.rows.push_back({i == 0 ? path.stem().string() : "", study.findings[i]});
    } catch (const std::exception& refusal) {
      table.rows.push_back({path.stem().string(), refusal.what()});
    }
  }
  book.tables.push_back(table);
}

}  // namespace kurbel::bench
