// command_line.h — what the commands share: their options, progress, where results go and how they are shown.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/command.h"
#include "engine/scene/scene.h"
#include "studies/findings/watch.h"

namespace kurbel {
struct StudyOutput;
}  // namespace kurbel

namespace kurbel::app {

// What ran to the end, but not to the accuracy asked for, ends like a run that failed: its figures are not sure.
inline constexpr int exit_done = 0, exit_user_error = 2, exit_run_failed = 3, exit_not_confirmed = 3,
                     exit_interrupted = 130;

// Set by Ctrl-C; runs end cleanly on it.
const std::atomic<bool>& interrupted();
// Ctrl-C ends the run, and at the second time the program; a reader that leaves and a file that may not grow are errors
// of writing, not the end.
void catch_signals();

// Options that every study on a scene has.
struct StudyOptions {
  std::string study;  // the command: its results go into a folder of this name within the scene's
  std::string scene, out;
  std::string brand, author;   // of the page: a logo as SVG, a name
  std::string format = "csv";  // of the tables: "csv,mat,xlsx"
  bool all = false, json = false, quiet = false, no_files = false, open = false, plots = false, verbose = false;
  bool allow_files = false;
  std::vector<std::string> set;  // beside the scene: "main_coupling.stiffness=1 MN*m/rad"
};
// --out, or results/SCENE/STUDY: no study writes over another's results.
std::filesystem::path results_of(const StudyOptions& options);
void add_scene(OptionList& command, std::string& scene, bool& allow_files, std::vector<std::string>& set);
void add_study_options(OptionList& command, StudyOptions& options);
// On stderr. On a terminal a line that is written over, for work longer than a second; else a line every ten seconds.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  void operator()(const std::string& what, double fraction);

 private:
  bool shown_, terminal_, written_ = false;
  std::string line_;
  std::chrono::steady_clock::time_point begin_, last_{};
};

// Reads a scene; of data files those below its own folder, unless all are allowed. Throws SceneError.
Scene read(const std::string& file, bool allow_files, const std::vector<std::string>& set);
Scene read(const StudyOptions& options);  // and logs it
// A fault found in the scene that was read last, however late: placed in its file, or in the setting that brought it.
SceneError placed(const SceneError& error);

// Before anything runs: hours of work must not end at a folder that cannot be written. Throws std::invalid_argument.
void check_folder(const StudyOptions& options);

// Ctrl-C, the line of progress, and what --verbose says.
Watch watch_of(const StudyOptions& options, Progress& progress);

// The name that an option once had: taken still, and told nowhere.
void add_former_name(OptionList& command, const std::string& name, std::string& value);

// Prints, writes the files unless asked not to, and returns the exit code.
int present(StudyOutput output, const StudyOptions& options);

}  // namespace kurbel::app
