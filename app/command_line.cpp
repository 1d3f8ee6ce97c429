// command_line.cpp — what the commands share.
#include "app/command_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "app/terminal.h"
#include "engine/scene/printable.h"
#include "studies/files/result_set.h"
#include "studies/files/spawn.h"
#include "studies/measured/measurement.h"
#include "studies/report/write_output.h"
#include "studies/scenes/kinds.h"

namespace kurbel::app {
namespace {

std::atomic<bool> interrupt_seen{false};
// The second Ctrl-C ends the program at once. Signals in quick succession count as one: timeout(1) signals its child
// and then the child's group.
extern "C" void on_interrupt(int) {
  constexpr std::int64_t one_blow = 300'000'000;  // [ns]
  static std::atomic<std::int64_t> first{0};
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t ns = now.tv_sec * 1'000'000'000 + now.tv_nsec;
  std::int64_t before = 0;
  if (!first.compare_exchange_strong(before, ns) && ns - before > one_blow) _exit(exit_interrupted);
  interrupt_seen = true;
}

// The scene's name without ".toml", as the name of a folder: never a hidden one, nor "." or "..".
std::string folder_name_of(const std::string& scene_file) {
  std::string name = std::filesystem::path(scene_file).stem().string();
  if (name.empty() || name[0] == '.') name = "_" + name.substr(std::min(name.find_first_not_of('.'), name.size()));
  return name;
}

// A browser, where the desktop has one.
void open_in_browser(const std::filesystem::path& path) {
  const bool desktop = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
  if (!desktop || !is_installed("xdg-open") || spawn({"xdg-open", std::filesystem::absolute(path).string()}) < 0)
    complain(fmt::format("kurbel: no browser to open here; the report is {}\n", path.string()));
}

}  // namespace

std::filesystem::path results_of(const StudyOptions& options) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path("results") / folder_name_of(options.scene) / options.study;
}

const std::atomic<bool>& interrupted() { return interrupt_seen; }

void catch_signals() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void add_scene(OptionList& command, std::string& scene, bool& allow_files, std::vector<std::string>& set) {
  command.add_option("scene", scene, "scene file (TOML)").required();
  command.add_flag("--allow-files", allow_files,
                   "let the scene read data files outside of its own folder (default: only there and below)");
  command
      .add_option("--set", set,
                  "COMPONENT.KEY=VALUE instead of what the scene says, e.g. \"main_coupling.stiffness=1 MN*m/rad\", "
                  "\"run.start.speed=58 rpm\", \"gearbox.stages[2].efficiency=0.97\"; without a value: the key's "
                  "default; repeatable")
      .repeatable();
}

namespace {

constexpr std::uintmax_t largest_logo = 1 << 20;

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Why a file is not a logo; empty: it is one.
std::string svg_fault(const std::string& path) {
  if (path.empty()) return "";  // stated for every option
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return fmt::format("{} cannot be read ({}); give an SVG file", in_quotes(path), error.message());
  if (size > largest_logo)
    return fmt::format("{} has {} bytes; allowed: up to {} for a logo", in_quotes(path), size, largest_logo);
  if (text_of_file(path).find("<svg") == std::string::npos)
    return fmt::format("{} is no SVG: it has no \"<svg\"; give a drawing saved as SVG", in_quotes(path));
  return "";
}

// Why a list contains no valid formats; empty: it does.
std::string format_fault(const std::string& list) {
  if (list.empty()) return "must not be empty";
  try {
    table_formats(list);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace

void add_study_options(OptionList& command, StudyOptions& options) {
  options.study = command.name();
  add_scene(command, options.scene, options.allow_files, options.set);
  command.add_option("-o,--out", options.out,
                     "folder for report.html, summary.json and tables, replaced as a whole (default: results/SCENE/" +
                         options.study + ")");
  command
      .add_option("--format", options.format,
                  "files of the tables, joined by commas: csv, mat (Modelica's layout of results), xlsx (one workbook, "
                  "with figures and events); default: csv")
      .check(format_fault);
  command.add_flag("--no-files", options.no_files, "print only");
  command.add_flag("--open", options.open, "open the report in a browser");
  command.add_flag("--plots", options.plots,
                   "write the plots for gnuplot too, and as SVG and PNG where it is installed");
  command.add_option("--brand", options.brand, "logo above the report, an SVG file").check(svg_fault);
  command.add_option("--author", options.author, "name above the report");
  command.add_flag("--all", options.all,
                   "print everything: all figures with all digits, every row of every table, works, notes");
  command.add_flag("--json", options.json, "print the summary as JSON");
  command.add_flag("--quiet", options.quiet, "print only the conclusion in one line, and no progress");
  command.add_flag("--verbose", options.verbose, "say on stderr what is read, compiled, chosen and run");
}

Progress::Progress(bool quiet)
    : shown_(!quiet), terminal_(isatty(STDERR_FILENO) != 0), begin_(std::chrono::steady_clock::now()), last_(begin_) {}

Progress::~Progress() {
  if (written_) show_progress("");
}

void Progress::operator()(const std::string& what, double fraction) {
  if (!shown_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - begin_ < std::chrono::seconds(1)) return;
  if (now - last_ < (terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(10))) return;
  const std::string line = fmt::format("{}: {:.0f} %", what, 100 * fraction);
  if (!terminal_ && line == line_) return;
  last_ = now, line_ = line;
  if (!terminal_) return complain(line + "\n");
  written_ = true;
  show_progress(line);
}

namespace {

// The scene of the current command.
std::optional<SettledText>& scene_read() {
  static std::optional<SettledText> text;
  return text;
}

}  // namespace

Scene read(const std::string& file, bool allow_files, const std::vector<std::string>& set) {
  scene_read().emplace(read_text_file(file, max_scene_bytes), file, set);
  return parse_scene(*scene_read(), all_kinds(), allow_files ? DataFiles::anywhere : DataFiles::below_the_scene);
}

SceneError placed(const SceneError& error) { return scene_read() ? scene_read()->placed(error) : error; }

Scene read(const StudyOptions& options) {
  Scene scene = read(options.scene, options.allow_files, options.set);
  if (const auto log = make_log(options.verbose))
    log(fmt::format("read {}: {} components on {} line{}, effects: {}", scene.file, scene.components.size(),
                    scene.lines.size(), scene.lines.size() == 1 ? "" : "s", scene.effects.describe()));
  return scene;
}

void check_folder(const StudyOptions& options) {
  if (options.no_files) return;
  const std::filesystem::path folder = results_of(options);
  for (const std::filesystem::path& place : {folder, incomplete_place(folder)})
    if (const std::string why = why_no_results_in(place); !why.empty())
      throw std::invalid_argument(fmt::format("--out {}: {}, or --no-files", folder.string(), why));
}

Watch watch_of(const StudyOptions& options, Progress& progress) {
  return {.interrupted = &interrupt_seen,
          .progress = [&progress](const std::string& what, double fraction) { progress(what, fraction); },
          .log = make_log(options.verbose)};
}

namespace {

// Writes the files and reports where they are.
void write_files(const StudyOutput& output, const StudyOptions& options, bool stopped) {
  const WriteOptions how{
      .plots = options.plots,
      .interrupted = stopped,
      .made_by = fmt::format("kurbel {} {}", options.study, options.scene),
      .head = {.brand_svg = options.brand.empty() ? "" : text_of_file(options.brand), .author = options.author},
      .formats = table_formats(options.format)};
  const std::filesystem::path folder = write_output(output, results_of(options), how);
  const bool has_sheet = std::any_of(output.files.begin(), output.files.end(),
                                     [](const auto& file) { return file.first == "sheet.html"; });
  if (!options.json && !options.quiet) {
    say(fmt::format("results: {}\n", (folder / "summary.json").string()));
    if (options.plots) say(fmt::format("plots for gnuplot: {}\n", (folder / "plots").string()));
    say(fmt::format("report: {}\n", (folder / "report.html").string()));
    if (output.complete && has_sheet) say(fmt::format("sheet: {}\n", (folder / "sheet.html").string()));
  }
  if (options.open) open_in_browser(folder / "report.html");
}

}  // namespace

int present(StudyOutput output, const StudyOptions& options) {
  if (!output.words.empty()) say(options.json ? output.json() + "\n" : output.words);
  if (!output.aside.empty()) complain(fmt::format("kurbel: {}\n", output.aside));
  if (!output.words.empty()) return exit_done;
  // Settings are recorded in every summary.
  if (!options.set.empty()) output.record("set", options.set);
  // Read once: files and exit code must agree.
  const bool stopped = interrupt_seen;
  if (options.json)
    say(output.json() + "\n");
  else if (options.quiet)
    say(printable(output.conclusion()) + "\n");
  else if (options.all || !output.brief)
    say_with_conclusion(output.text(options.all), conclusion_text(output));
  else
    say_with_conclusion(brief_text(output), headline_text(output));
  if (!options.no_files) write_files(output, options, stopped);
  if (output.complete && !stopped) {
    if (output.unconfirmed.empty()) {
      if (!output.next.empty() && !options.no_files && !options.json && !options.quiet)
        say(fmt::format(fmt::runtime(output.next), fmt::arg("scene", options.scene),
                        fmt::arg("summary", (results_of(options) / "summary.json").string())) +
            "\n");
      return exit_done;
    }
    complain(fmt::format("kurbel: not confirmed: {}\n", output.unconfirmed));
    return exit_not_confirmed;
  }
  complain(fmt::format("kurbel: {}\n", output.complete ? "interrupted" : output.diagnosis));
  return stopped ? exit_interrupted : exit_run_failed;
}

}  // namespace kurbel::app
