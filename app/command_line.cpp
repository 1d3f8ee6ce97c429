// command_line.cpp — what the commands share.
#include "app/command_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "app/terminal.h"
#include "engine/units.h"
#include "studies/kinds.h"

namespace kurbel::app {
namespace {

std::atomic<bool> interrupt_seen{false};
// The second time, at once.
extern "C" void on_interrupt(int) {
  if (interrupt_seen.exchange(true)) _exit(exit_interrupted);
}

std::filesystem::path folder_of(const StudyOptions& options) {
  return options.out.empty() ? results_of(options.scene, options.study) : std::filesystem::path(options.out);
}

// A browser, where the desktop has one.
void open_in_browser(const std::string& path) {
  const bool desktop = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
  setenv("KURBEL_REPORT", path.c_str(), 1);  // so that no path is read as a command
  if (!desktop || std::system("command -v xdg-open > /dev/null && xdg-open \"$KURBEL_REPORT\" > /dev/null 2>&1 &") != 0)
    fmt::print(stderr, "kurbel: no browser to open here; the report is {}\n", path);
}

}  // namespace

std::filesystem::path results_of(const std::string& scene_file, const std::string& study) {
  const auto folder = std::filesystem::path("results") / std::filesystem::path(scene_file).stem();
  return study.empty() ? folder : folder / study;
}

const std::atomic<bool>& interrupted() { return interrupt_seen; }

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

void add_scene(CLI::App& command, std::string& scene) {
  command.add_option("scene", scene, "scene file (TOML)")->required();
}

void add_study_options(CLI::App& command, StudyOptions& options, const std::string& study) {
  options.study = study;
  add_scene(command, options.scene);
  command.add_option("--out", options.out,
                     "folder for report.html, summary.json and tables as CSV (default: results/SCENE" +
                         (study.empty() ? ")" : "/" + study + ")"));
  command.add_flag("--no-files", options.no_files, "print only");
  command.add_flag("--open", options.open, "open the report in a browser");
  command.add_flag("--plots", options.plots,
                   "write the plots for gnuplot too, and as SVG and PNG where it is installed");
  command.add_flag("--json", options.json, "print the summary as JSON");
  command.add_flag("--quiet", options.quiet, "print only the conclusion in one line, and no progress");
  command.add_flag("--verbose", options.verbose, "say on stderr what is read, compiled, chosen and run");
}

Progress::Progress(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO)), begin_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (written_) fmt::print(stderr, "\r\033[K");
}

void Progress::operator()(const std::string& what, double fraction) {
  if (!shown_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - begin_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  written_ = true;
  fmt::print(stderr, "\r\033[K{}: {:.0f} %", what, 100 * fraction);
  std::fflush(stderr);
}

Scene read(const StudyOptions& options) {
  Scene scene = read_scene(options.scene, all_kinds());
  if (const auto log = make_log(options.verbose))
    log(fmt::format("read {}: {} components on {} line{}, effects: {}", scene.file, scene.components.size(),
                    scene.lines.size(), scene.lines.size() == 1 ? "" : "s", scene.effects.describe()));
  return scene;
}

void check_folder(const StudyOptions& options) {
  if (options.no_files) return;
  const std::filesystem::path folder = folder_of(options);
  std::error_code status;
  std::filesystem::path existing = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(existing, status) && existing.has_relative_path()) existing = existing.parent_path();
  if (!std::filesystem::is_directory(existing, status))
    throw std::invalid_argument(
        fmt::format("--out {}: {} is a file; give a folder", folder.string(), existing.string()));
  if (access(existing.c_str(), W_OK) != 0)
    throw std::invalid_argument(
        fmt::format("--out {}: no permission to write in {}; give another folder, or --no-files", folder.string(),
                    existing.string()));
}

SimulateOptions simulate_options(const StudyOptions& options, Progress& progress) {
  SimulateOptions simulation;
  simulation.traces = !options.no_files;
  simulation.interrupted = &interrupt_seen;
  simulation.log = make_log(options.verbose);
  simulation.progress = [&progress](const std::string& what, double fraction) { progress(what, fraction); };
  return simulation;
}

double quantity_of(const std::string& option, const std::string& text, const std::string& what,
                   const std::string& example, const Domain& domain) {
  UnitError error;
  const auto value = parse_quantity(text, error);
  if (!value)
    throw std::invalid_argument(
        fmt::format("{} {}: {}; write e.g. \"{}\"", option, in_quotes(text), error.text, example));
  if (value->dimension != parse_quantity(example, error)->dimension || !domain.contains(value->value))
    throw std::invalid_argument(
        fmt::format("{} {}: must be {} with its unit, e.g. \"{}\"", option, in_quotes(text), what, example));
  return value->value;
}

int present(const StudyOutput& output, const StudyOptions& options) {
  if (options.json) {
    fmt::print("{}\n", output.json);
  } else if (options.quiet) {
    fmt::print("{}\n", output.conclusion);
  } else {
    fmt::print("{}", wants_colour(STDOUT_FILENO) ? coloured(output.table, output.conclusion) : output.table);
  }
  if (!options.no_files) {
    const std::filesystem::path folder = folder_of(options);
    write_output(output, folder.string(), options.plots);
    if (!options.json && !options.quiet) {
      fmt::print("results: {}\n", (folder / "summary.json").string());
      if (options.plots) fmt::print("plots for gnuplot: {}\n", (folder / "plots").string());
      fmt::print("report: {}\n", (folder / "report.html").string());
    }
    if (options.open) open_in_browser((folder / "report.html").string());
  }
  if (output.complete && !interrupt_seen) {
    if (output.unconfirmed.empty()) return exit_done;
    fmt::print(stderr, "kurbel: not confirmed: {}. Loosen --accuracy, or take --no-error if no error is wanted\n",
               output.unconfirmed);
    return exit_not_confirmed;
  }
  fmt::print(stderr, "kurbel: {}\n", output.complete ? "interrupted" : output.diagnosis);
  return interrupt_seen ? exit_interrupted : exit_run_failed;
}

}  // namespace kurbel::app
