// sweep_bench.cpp — what does a sweep cost over the bare runs, do two threads do the work of two processes, and how much
// faster is it than a shell loop over kurbel run?
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "bench/benches.h"
#include "studies/run/simulate.h"
#include "studies/sweep/sweep.h"
#include "studies/variants/machine.h"

namespace kurbel::bench {
namespace {

namespace fs = std::filesystem;

struct SweptMachine {
  const char* name;
  std::string text;
  std::vector<std::string> vary;
  std::size_t rows;
};

std::string two_masses() {
  return "line = [\"rotor\", \"spring\", \"mass\"]\n"
         "rotor = { kind = \"inertia\", inertia = \"0.2 kg*m2\" }\n"
         "motor = { kind = \"torque source\", torque = \"50 N*m\", on = \"rotor\" }\n"
         "spring = { kind = \"coupling\", stiffness = \"4 kN*m/rad\", damping_ratio = 0.02 }\n"
         "mass = { kind = \"load\", quadratic = \"0.01 N*m*s2/rad2\", inertia = \"1.5 kg*m2\" }\n"
         "effects = { elasticity = true }\nrun = { until = \"0.1 s\" }\n";
}

// A crank whose mechanism's tables are made anew where its geometry is swept.
std::string crank() {
  return "line = [\"motor\", \"shaft\", \"crank\"]\n"
         "motor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"15 rad/s\", inertia = \"1 "
         "kg*m2\" }\n"
         "shaft = { kind = \"coupling\", stiffness = \"2 kN*m/rad\", damping_ratio = 0.02 }\n"
         "crank = { kind = \"slider-crank\", radius = \"20 mm\", rod = \"100 mm\", crank_inertia = \"0.8 kg*m2\", "
         "slider_mass = \"3 kg\" }\n"
         "effects = { elasticity = true }\nrun = { until = \"0.5 s\" }\n";
}

std::string six_inertias() {
  std::ifstream file(std::string(KURBEL_SOURCE_DIR) + "/scenes/six_inertia_chain.toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

// One machine, its design, the figures required of it, at errors measured.
struct Campaign {
  explicit Campaign(const SweptMachine& m) : machine(m) {
    question.text = m.text, question.file = "bench.toml";
    for (const std::string& text : m.vary) parameters.push_back(parse_parameter(text));
    design = std::make_unique<Design>(fmt::format("sobol:{}", m.rows), parameters, 1);
    varied = std::make_unique<VariedScene>(question, parameters);
    figures = chosen(figures_of(question), {"peak_torque", "max_speed"});
  }

  void sweep(const fs::path& into, int jobs, std::size_t shard = 1, std::size_t shards = 1) const {
    fs::remove(into);
    SweepStore store(into, {.meta = {{"design", design->text()}},
                            .shard = fmt::format("{}/{}", shard, shards),
                            .parameters = design->parameters(),
                            .figures = figures,
                            .rows = design->rows()});
    run_sweep({.design = design.get(),
               .shard = shard,
               .shards = shards,
               .jobs = jobs,
               .evaluator = [&] { return machine_evaluator(question, *varied, figures); }},
              store);
  }

  // The same machines as a program would run them that knows no sweep: compiled, run, their errors measured.
  void bare() const {
    VariedScene scenes = *varied;
    for (std::size_t i = 0; i < design->rows(); ++i) {
      const Scene& scene = scenes.at(design->row(i));
      simulate(compile(scene, scene.effects), "", SimulateOptions{});
    }
  }

  SweptMachine machine;
  MachineQuestion question;
  std::vector<SweptParameter> parameters;
  std::unique_ptr<Design> design;
  std::unique_ptr<VariedScene> varied;
  std::vector<SweptFigure> figures;
};

double processor_of(const auto& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double clock_of(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Two processes, a shard and a file each, side by side.
void two_processes(const Campaign& c, const fs::path& folder) {
  std::vector<pid_t> children;
  for (std::size_t shard = 1; shard <= 2; ++shard) {
    const pid_t child = fork();
    if (child == 0) {
      c.sweep(folder / fmt::format("shard{}.db", shard), 1, shard, 2);
      _exit(0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) waitpid(child, nullptr, 0);
}

// Kurbel run for each of the first rows, from a shell, in seconds a row.
double shell_loop(const Campaign& c, const std::string& program, const fs::path& folder, std::size_t rows) {
  std::ofstream(folder / "bench.toml") << c.question.text;
  std::string lines = fmt::format("cd '{}'\n", folder.string());
  for (std::size_t i = 0; i < rows; ++i) {
    lines += fmt::format("'{}' run bench.toml --no-files --no-trials --quiet", program);
    const std::vector<double> values = c.design->row(i);
    for (std::size_t k = 0; k < values.size(); ++k)
      lines += fmt::format(" --set '{}'", c.parameters[k].setting(values[k]));
    lines += " > /dev/null || exit 1\n";
  }
  std::ofstream(folder / "loop.sh") << lines;
  const std::string command = fmt::format("sh '{}'", (folder / "loop.sh").string());
  int ended = 0;
  const double took = clock_of([&] { ended = std::system(command.c_str()); });
  if (ended != 0) throw std::runtime_error("the shell loop over kurbel run failed");
  return took / static_cast<double>(rows);
}

}  // namespace

void rates_of_sweeps(BenchBook& book, const std::string& program) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("kurbel_sweep_bench_{}", getpid());
  fs::create_directories(folder);
  const SweptMachine machines[] = {
      {"two masses", two_masses(), {"spring.stiffness=3..5 kN*m/rad", "mass.inertia=1..2 kg*m2"}, 2000},
      {"six inertias", six_inertias(), {"c1.stiffness=3..5 kN*m/rad", "fan.inertia=0.5..0.7 kg*m2"}, 60},
      {"crank", crank(), {"shaft.stiffness=1..3 kN*m/rad", "crank.crank_inertia=0.5..1 kg*m2"}, 300},
      {"crank, its geometry swept", crank(), {"crank.radius=15..25 mm", "crank.rod=90..120 mm"}, 300}};
  Table table{.title = "Sweeps, errors measured: medians of five",
              .columns = {"machine", "rows", "bare runs, ms a row", "sweep, ms a row", "overhead",
                          "two jobs over two processes", "one job over a shell loop", "two jobs over it"},
              .rows = {}};
  for (const SweptMachine& machine : machines) {
    const Campaign c(machine);
    std::vector<double> bare, swept, ratio, clock, by_two;
    for (int repeat = 0; repeat < 5; ++repeat) {
      bare.push_back(processor_of([&] { c.bare(); }));
      swept.push_back(processor_of([&] { clock.push_back(clock_of([&] { c.sweep(folder / "one.db", 1); })); }));
      const double processes = clock_of([&] { two_processes(c, folder); });
      by_two.push_back(clock_of([&] { c.sweep(folder / "two.db", 2); }));
      ratio.push_back(processes / by_two.back());
    }
    const double rows = static_cast<double>(machine.rows), overhead = median(swept) / median(bare) - 1;
    const double loop = shell_loop(c, program, folder, 40) * rows;
    table.rows.push_back({machine.name, fmt::format("{}", machine.rows),
                          fmt::format("{:.3g}", 1e3 * median(bare) / rows),
                          fmt::format("{:.3g}", 1e3 * median(swept) / rows), fmt::format("{:.1f} %", 100 * overhead),
                          fmt::format("{:.0f} %", 100 * median(ratio)), fmt::format("{:.1f} ×", loop / median(clock)),
                          fmt::format("{:.1f} ×", loop / median(by_two))});
    book.target(fmt::format("sweep of {}: processor time over bare runs", machine.name), "≤ 5 %",
                fmt::format("{:.1f} %", 100 * overhead), overhead <= 0.05);
    book.target(fmt::format("sweep of {}: two jobs against two processes", machine.name), "≥ 95 %",
                fmt::format("{:.0f} %", 100 * median(ratio)), median(ratio) >= 0.95);
    if (&machine == machines)
      book.target("sweep of two masses, two jobs, against a shell loop over kurbel run", "≥ 20 ×",
                  fmt::format("{:.1f} ×", loop / median(by_two)), loop / median(by_two) >= 20);
  }
  book.tables.push_back(std::move(table));
  fs::remove_all(folder);
}

}  // namespace kurbel::bench
