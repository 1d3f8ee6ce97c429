// command_line.h — what the commands share: options, progress, results folder and presentation.
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

// A study that ends without the requested accuracy exits like a run that failed: its figures are not confirmed.
inline constexpr int exit_done = 0, exit_user_error = 2, exit_run_failed = 3, exit_not_confirmed = 3,
                     exit_interrupted = 130;

// Set by Ctrl-C; runs end cleanly on it.
const std::atomic<bool>& interrupted();
// Ctrl-C ends the run, a second Ctrl-C the program. SIGPIPE and SIGXFSZ are ignored: a closed pipe and a file over
// its size limit become write errors.
void catch_signals();

// Options common to all studies on a scene.
struct StudyOptions {
  std::string study;  // name of the command and of its results folder, within that of the scene
  std::string scene, out;
  std::string brand, author;   // of the page: a logo as SVG, a name
  std::string format = "csv";  // of the tables: "csv,mat,xlsx"
  bool all = false, json = false, quiet = false, no_files = false, open = false, plots = false, verbose = false;
  bool allow_files = false;
  std::vector<std::string> set;  // changes to the scene: "main_coupling.stiffness=1 MN*m/rad"
};
// --out, or results/SCENE/STUDY, so that no study overwrites the results of another.
std::filesystem::path results_of(const StudyOptions& options);
void add_scene(OptionList& command, std::string& scene, bool& allow_files, std::vector<std::string>& set);
void add_study_options(OptionList& command, StudyOptions& options);
// Progress on stderr. On a terminal one line is rewritten, for work longer than a second; otherwise one line every ten seconds.
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

// Reads a scene. Data files must lie below the scene's folder, unless all are allowed. Throws SceneError.
Scene read(const std::string& file, bool allow_files, const std::vector<std::string>& set);
Scene read(const StudyOptions& options);  // and logs it
// An error found later in the scene read last, with its place in the file or in the setting that caused it.
SceneError placed(const SceneError& error);

// Called before any computation, so that no long run ends at a folder that is not writable. Throws std::invalid_argument.
void check_folder(const StudyOptions& options);

// Ctrl-C, progress line and the log of --verbose.
Watch watch_of(const StudyOptions& options, Progress& progress);

// Prints the results, writes the files unless they are switched off, and returns the exit code.
int present(StudyOutput output, const StudyOptions& options);

}  // namespace kurbel::app
