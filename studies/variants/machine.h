// machine.h — a row of variants as a machine: the scene with the row's values, and the figures of a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/reading/read_scene.h"
#include "studies/experiments/design.h"
#include "studies/findings/result.h"
#include "studies/question/question.h"
#include "studies/variants/rows.h"

namespace kurbel {

enum class SweepStudy { run, steady, modes, size };
// Throws std::invalid_argument for another name.
SweepStudy study_named(const std::string& of);

struct MachineQuestion {
  std::string text, file;             // of the scene
  std::vector<std::string> settings;  // --set
  DataFiles allowed = DataFiles::below_the_scene;
  SweepStudy of = SweepStudy::run;
  std::size_t errors_every = 1;  // errors are measured in rows 0, n, 2 n …; 0: in none
  std::optional<double> delta;   // for size
  bool every_order = false;      // figures of all orders, not only of the significant ones
  const std::atomic<bool>* interrupted = nullptr;
};
// What machines are asked, and its options in every command that varies them.
struct MachineRequest {
  std::string of = "run";
  std::optional<double> delta = {};
  bool measure_error = true;
};
OptionsOf<MachineRequest> machine_options();
// Throws std::invalid_argument for another study, and for δ of one that needs none.
MachineQuestion question_of(const Inquiry& inquiry, const MachineRequest& asked);

// A scene that is read once and changed for each row. Keys of components that hold one quantity are changed in place,
// which is checked once per parameter against reading; all others are read again.
class VariedScene {
 public:
  // Reads the scene at the ends of every parameter's range. Throws SceneError for values that the reader refuses,
  // under "--vary", or at the column's heading.
  VariedScene(const MachineQuestion& question, const std::vector<SweptParameter>& parameters);

  // The scene with these values; valid until the next call. Throws SceneError if they are inconsistent.
  const Scene& at(const std::vector<double>& values);
  // The same, by reading the text.
  Scene read(const std::vector<double>& values) const;
  bool is_in_place(std::size_t parameter) const { return in_place_[parameter]; }

 private:
  Scene read_with(const std::vector<std::string>& further) const;
  void check_ends(std::size_t parameter);
  bool found_in_place(std::size_t parameter, double low, double high);

  MachineQuestion question_;
  std::vector<SweptParameter> parameters_;
  Scene scene_;
  std::vector<bool> in_place_;
  bool all_in_place_ = true;
};

// The component key of a path, if it holds one quantity; null: otherwise.
const Key* quantity_key(const Scene& scene, const std::string& path);

// Names and units of the study's figures for the given scene; for run also those of other variants.
std::vector<SweptFigure> figures_of(const MachineQuestion& question);
// The requested figures: full names, or a quantity ("delta": of all components); empty: all but single orders of a
// motion. Throws std::invalid_argument.
std::vector<SweptFigure> chosen(const std::vector<SweptFigure>& known, const std::vector<std::string>& asked);

// Result of a study for a machine.
struct MachineAnswer {
  RowState state = RowState::done;
  std::string diagnosis = {};  // if it failed or its accuracy is not confirmed
  std::vector<Figure> figures = {};
  // For the given scene, not for rows: the text includes the settings.
  std::string file = {}, title = {}, text = {};
  SpeedUnit speed_unit = {};

  bool done() const { return state == RowState::done; }
};
// For the given scene. Throws SceneError, and OutOfTime on interruption.
MachineAnswer answer_of(const MachineQuestion& question);

// Computes rows; one evaluator for each thread.
Evaluator machine_evaluator(MachineQuestion question, const VariedScene& scene,
                            const std::vector<SweptFigure>& figures);
// Rows for all these values, in order. Throws OutOfTime on interruption.
std::vector<SweepRow> rows_of(const MachineQuestion& question, const VariedScene& scene,
                              const std::vector<SweptFigure>& figures, const std::vector<std::vector<double>>& values,
                              int jobs);

}  // namespace kurbel
