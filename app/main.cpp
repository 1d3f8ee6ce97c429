// main.cpp — the command line, nothing else.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "app/scene_commands.h"
#include "app/terminal.h"
#include "engine/units.h"
#include "studies/compare.h"
#include "studies/kinds.h"
#include "studies/output.h"
#include "studies/schema.h"
#include "studies/simulate.h"

namespace {

constexpr int exit_user_error = 2, exit_run_failed = 3, exit_interrupted = 130;

std::atomic<bool> interrupted{false};
// The second time, at once.
extern "C" void on_interrupt(int) {
  if (interrupted.exchange(true)) _exit(exit_interrupted);
}

struct Arguments {
  std::string kind, file;
  std::string scene, effects, against, out, method;
  std::optional<double> accuracy;
  std::string until;
  bool json = false, no_error = false, explain = false, quiet = false, no_files = false, open = false, plots = false,
       verbose = false;
};

// A line on stderr that is written over, on a terminal only, and only for work longer than a second.
class Progress {
 public:
  explicit Progress(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO)), begin_(std::chrono::steady_clock::now()) {}
  ~Progress() {
    if (written_) fmt::print(stderr, "\r\033[K");
  }
  void operator()(const std::string& what, double fraction) {
    if (!shown_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - begin_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    written_ = true;
    fmt::print(stderr, "\r\033[K{}: {:.0f} %", what, 100 * fraction);
    std::fflush(stderr);
  }

 private:
  bool shown_, written_ = false;
  std::chrono::steady_clock::time_point begin_, last_{};
};

kurbel::SimulateOptions simulate_options(const Arguments& arguments, Progress& progress) {
  kurbel::SimulateOptions options;
  options.measure_error = !arguments.no_error;
  options.traces = !arguments.no_files;
  options.interrupted = &interrupted;
  options.log = kurbel::app::make_log(arguments.verbose);
  options.progress = [&progress](const std::string& what, double fraction) { progress(what, fraction); };
  if (!arguments.method.empty()) options.method = arguments.method;
  if (arguments.accuracy) {
    if (!(*arguments.accuracy >= 1e-12 && *arguments.accuracy <= 0.1))
      throw std::invalid_argument(fmt::format("--accuracy {}: must be 1e-12 … 0.1", *arguments.accuracy));
    options.accuracy = arguments.accuracy;
  }
  if (!arguments.until.empty()) {
    kurbel::UnitError error;
    const auto until = kurbel::parse_quantity(arguments.until, error);
    const auto second = kurbel::parse_unit("s", error);
    if (!until)
      throw std::invalid_argument(
          fmt::format("--until {}: {}; write e.g. \"3 s\"", kurbel::in_quotes(arguments.until), error.text));
    if (until->dimension != second->dimension || !(until->value > 0))
      throw std::invalid_argument(fmt::format("--until {}: must be a time > 0 with its unit, e.g. \"3 s\"",
                                              kurbel::in_quotes(arguments.until)));
    options.until = until->value;
  }
  return options;
}

// results/<scene's name> unless asked otherwise.
std::string folder_of(const Arguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return (std::filesystem::path("results") / std::filesystem::path(arguments.scene).stem()).string();
}

// Before anything runs: hours of work must not end at a folder that cannot be written, or at a method's name.
void check_arguments(const Arguments& arguments, const kurbel::Scene& scene) {
  if (!arguments.method.empty()) kurbel::check_method(arguments.method, scene.run.model);
  if (arguments.no_files) return;
  const std::string folder = folder_of(arguments);
  std::error_code status;
  std::filesystem::path existing = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(existing, status) && existing.has_relative_path()) existing = existing.parent_path();
  if (!std::filesystem::is_directory(existing, status))
    throw std::invalid_argument(fmt::format("--out {}: {} is a file; give a folder", folder, existing.string()));
  if (access(existing.c_str(), W_OK) != 0)
    throw std::invalid_argument(fmt::format(
        "--out {}: no permission to write in {}; give another folder, or --no-files", folder, existing.string()));
}

// A browser, where the desktop has one.
void open_in_browser(const std::string& path) {
  const bool desktop = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
  setenv("KURBEL_REPORT", path.c_str(), 1);  // so that no path is read as a command
  if (!desktop || std::system("command -v xdg-open > /dev/null && xdg-open \"$KURBEL_REPORT\" > /dev/null 2>&1 &") != 0)
    fmt::print(stderr, "kurbel: no browser to open here; the report is {}\n", path);
}

template <class AnyResult>
void show(const AnyResult& result, const Arguments& arguments) {
  if (arguments.json) {
    fmt::print("{}\n", kurbel::json_of(result));
  } else if (arguments.quiet) {
    fmt::print("{}\n", kurbel::app::conclusion_of(result));
  } else {
    const std::string table = kurbel::table_of(result);
    fmt::print("{}", kurbel::app::wants_colour(STDOUT_FILENO)
                         ? kurbel::app::coloured(table, kurbel::app::conclusion_of(result))
                         : table);
  }
  if (arguments.no_files) return;
  const std::filesystem::path folder = folder_of(arguments);
  kurbel::write_results(result, folder.string(), arguments.plots);
  if (!arguments.json && !arguments.quiet) {
    fmt::print("results: {}\n", (folder / "summary.json").string());
    if (arguments.plots) fmt::print("plots for gnuplot: {}\n", (folder / "plots").string());
    fmt::print("report: {}\n", (folder / "report.html").string());
  }
  if (arguments.open) open_in_browser((folder / "report.html").string());
}

void log_scene(const kurbel::Scene& scene, const Arguments& arguments) {
  if (const auto log = kurbel::app::make_log(arguments.verbose))
    log(fmt::format("read {}: {} components on {} line{}, effects: {}", scene.file, scene.components.size(),
                    scene.lines.size(), scene.lines.size() == 1 ? "" : "s", scene.effects.describe()));
}

int end_of_run(bool complete, const std::string& diagnosis) {
  if (complete && !interrupted) return 0;
  fmt::print(stderr, "kurbel: {}\n", complete ? "interrupted" : diagnosis);
  return interrupted ? exit_interrupted : exit_run_failed;
}

int run(const Arguments& arguments) {
  const kurbel::Scene scene = kurbel::read_scene(arguments.scene, kurbel::all_kinds());
  log_scene(scene, arguments);
  const kurbel::Effects effects =
      arguments.effects.empty() ? scene.effects : kurbel::parse_effects(arguments.effects, scene);
  const auto model = kurbel::compile(scene, effects);
  if (arguments.explain) {
    fmt::print("{}", model->explain());
    return 0;
  }
  check_arguments(arguments, scene);
  Progress progress(arguments.quiet);
  const auto options = simulate_options(arguments, progress);
  const kurbel::Result result = kurbel::simulate(model, model->elastic.empty() ? "rigid" : "elastic", options);
  show(result, arguments);
  return end_of_run(result.complete, result.diagnosis);
}

// Rigid against the scene's own effects; a scene without any is compared with all of its elasticity.
int compare(const Arguments& arguments) {
  const kurbel::Scene scene = kurbel::read_scene(arguments.scene, kurbel::all_kinds());
  log_scene(scene, arguments);
  kurbel::Effects full = arguments.effects.empty() ? scene.effects : kurbel::parse_effects(arguments.effects, scene);
  check_arguments(arguments, scene);
  if (arguments.effects.empty() && full.describe() == "none") full.all_elastic = true;
  kurbel::Effects simple;
  if (!arguments.against.empty()) simple = kurbel::parse_effects(arguments.against, scene);
  const bool rigid = simple.describe() == "none";
  Progress progress(arguments.quiet);
  const auto options = simulate_options(arguments, progress);
  const std::string full_label = full.describe() == "none" ? "rigid" : rigid ? "elastic" : "second";
  if (full.describe() == simple.describe())
    throw std::invalid_argument(fmt::format(
        "both models have the same effects ({}); choose others with --effects and --against", full.describe()));
  const kurbel::Comparison c = kurbel::compare(scene, simple, rigid ? "rigid" : "first", full, full_label, options);
  show(c, arguments);
  return end_of_run(c.a.complete && c.b.complete, c.a.complete ? c.b.diagnosis : c.a.diagnosis);
}

int check(const Arguments& arguments) {
  const kurbel::Scene scene = kurbel::read_scene(arguments.scene, kurbel::all_kinds());
  const auto model = kurbel::compile(scene, scene.effects);
  fmt::print("{}: sound; {} component{}, {} coordinate{} with effects: {}\n", arguments.scene, scene.components.size(),
             scene.components.size() == 1 ? "" : "s", model->free_shafts + model->twist_count(),
             model->free_shafts + model->twist_count() == 1 ? "" : "s", scene.effects.describe());
  return 0;
}

int figures(const Arguments& arguments) {
  const kurbel::Scene scene = kurbel::read_scene(arguments.scene, kurbel::all_kinds());
  for (const kurbel::Figure& f : kurbel::figure_list(*kurbel::compile(scene, scene.effects)))
    fmt::print("{}{}\n", f.name, f.unit.empty() ? "" : fmt::format(" [{}]", f.unit));
  return 0;
}

void add_scene(CLI::App* command, Arguments& arguments) {
  command->add_option("scene", arguments.scene, "scene file (TOML)")->required();
}
void add_run_options(CLI::App* command, Arguments& arguments) {
  add_scene(command, arguments);
  command->add_option("--effects", arguments.effects,
                      "none, elasticity, or elasticity:COUPLING,… (overrides the scene)");
  command->add_option("--accuracy", arguments.accuracy,
                      "measured error of every figure over its scale (overrides the scene)");
  command->add_option("--until", arguments.until, "end of the simulated time, e.g. \"3 s\" (overrides the scene)");
  command->add_option("--method", arguments.method,
                      "auto, dop853, dopri5, esdirk, bdf, adams; for multibody one of Simbody's integrators");
  command->add_option("--out", arguments.out,
                      "folder for report.html, summary.json and trajectory.csv (default: results/SCENE)");
  command->add_flag("--no-error", arguments.no_error, "skip the second run that measures the errors");
  command->add_flag("--no-files", arguments.no_files, "print only");
  command->add_flag("--open", arguments.open, "open the report in a browser");
  command->add_flag("--plots", arguments.plots, "write the plots for gnuplot too, and as SVG where it is installed");
  command->add_flag("--json", arguments.json, "print the summary as JSON");
  command->add_flag("--quiet", arguments.quiet, "print only the conclusion in one line, and no progress");
  command->add_flag("--verbose", arguments.verbose, "say on stderr what is read, compiled, chosen and run");
}

// " — did you mean "--quiet"?" for the first option that the command does not know.
std::string option_meant(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || std::find(names.begin(), names.end(), word) != names.end()) continue;
    const auto near = kurbel::nearest(word, names);
    return near ? fmt::format(" — did you mean \"{}\"?", *near) : "";
  }
  return "";
}

// CLI11 says little about a mistyped command.
int refuse_command(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    const auto near = kurbel::nearest(argv[1], names);
    fmt::print(stderr, "kurbel: unknown command \"{}\"{}; allowed: {}. See kurbel --help\n", argv[1],
               near ? fmt::format(" — did you mean \"{}\"?", *near) : "", kurbel::listed(names));
  } else if (argc == 1) {
    fmt::print(stderr, "kurbel: no command given; allowed: {}. Begin with kurbel new press, or see kurbel --help\n",
               kurbel::listed(names));
  } else {
    std::string meant;
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && argv[1][0] != '-')
      meant = option_meant(*app.get_subcommand(argv[1]), argc, argv);
    fmt::print(stderr, "kurbel: {}{} See kurbel{} --help\n", error.what(), meant.empty() ? "." : meant,
               argv[1][0] == '-' ? "" : fmt::format(" {}", argv[1]));
  }
  return exit_user_error;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "kurbel — dynamics of machine units: is the rigid model good enough, and if not, how far is it off?\n"
      "begin with: kurbel new press\n"
      "exit codes: 0 done, 2 the input is wrong, 3 a run failed, 130 interrupted"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "kurbel 0.1.0");
  Arguments arguments;
  int code = 0;
  const auto add = [&](const char* name, const char* what, int (*action)(const Arguments&)) {
    CLI::App* command = app.add_subcommand(name, what);
    command->callback([&code, &arguments, action] { code = action(arguments); });
    return command;
  };
  CLI::App* run_command = add("run", "simulate a scene", run);
  add_run_options(run_command, arguments);
  run_command->add_flag("--explain", arguments.explain,
                        "print what is merged, the coordinates and their inertias, and stop");
  CLI::App* compare_command =
      add("compare", "the rigid against the elastic model, or any two sets of effects", compare);
  add_run_options(compare_command, arguments);
  compare_command->add_option("--against", arguments.against, "effects of the first model (default: none)");
  add_scene(add("check", "validate a scene", check), arguments);
  add_scene(add("figures", "list the figures that runs of a scene yield", figures), arguments);
  CLI::App* new_command = add("new", "write a commented scene to start from: press, pump, engine, compressor or chain",
                              [](const Arguments& a) { return kurbel::app::new_scene(a.kind, a.file); });
  new_command->add_option("kind", arguments.kind, "press, pump, engine, compressor or chain");
  new_command->add_option("file", arguments.file,
                          "file to write (default: KIND.toml); one that exists is never overwritten");
  add("keys", "print the keys of one kind, or of a whole scene (Markdown)", [](const Arguments& a) {
    return kurbel::app::print_keys(a.kind);
  })->add_option("kind", arguments.kind, "e.g. coupling, \"induction motor\", run (default: all)");
  add("schema", "print the JSON Schema of a scene, for editors", [](const Arguments&) {
    fmt::print("{}", kurbel::scene_schema());
    return 0;
  });
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  try {
    app.parse(argc, argv);
    return code;
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return refuse_command(app, error, argc, argv);
  } catch (const kurbel::SceneError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_user_error;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "kurbel: {}\n", error.what());
    return exit_user_error;
  } catch (const std::exception& error) {
    fmt::print(stderr, "kurbel: {}\n", error.what());
    return exit_run_failed;
  }
}
