// machine.h — a row of variants as a machine: the scene with the row's values in it, and the figures that a study finds.
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
  std::optional<double> delta;   // of size
  bool every_order = false;      // figures of all orders, not of those alone that matter in the machine
  const std::atomic<bool>* interrupted = nullptr;
};
// Throws std::invalid_argument for another study.
MachineQuestion question_of(const Inquiry& inquiry, const std::string& of, bool measure_error = true);

// A scene that is read once; what a row changes is put into it. Keys of components that hold one quantity are changed
// in place, which is checked against reading once per parameter; all else is read anew.
class VariedScene {
 public:
  // Reads the scene at the ends of every parameter. Throws SceneError for what the reader refuses there, told under
  // "--vary", or at the column's heading.
  VariedScene(const MachineQuestion& question, const std::vector<SweptParameter>& parameters);

  // With these values; valid until the next call. Throws SceneError where they do not go together.
  const Scene& at(const std::vector<double>& values);
  // The same by reading the text.
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

// The key of a component that a path leads to, if it holds one quantity; null: it is none such.
const Key* quantity_key(const Scene& scene, const std::string& path);

// Names and units of what the study yields for the scene as it is; of run also what other variants may yield.
std::vector<SweptFigure> figures_of(const MachineQuestion& question);
// Those asked for: whole names, or a quantity ("delta": of whatever has one); empty: all but single orders of a motion.
// Throws std::invalid_argument.
std::vector<SweptFigure> chosen(const std::vector<SweptFigure>& known, const std::vector<std::string>& asked);

// What a study says of a machine.
struct MachineAnswer {
  RowState state = RowState::done;
  std::string diagnosis = {};  // of one that failed, or whose accuracy is not confirmed
  std::vector<Figure> figures = {};
  // Of the scene as it is, not of rows: settings are in its text.
  std::string file = {}, title = {}, text = {};
  SpeedUnit speed_unit = {};

  bool done() const { return state == RowState::done; }
};
// Of the scene as it is. Throws SceneError, and OutOfTime where it is interrupted.
MachineAnswer answer_of(const MachineQuestion& question);

// Computes rows: one for each thread.
Evaluator machine_evaluator(MachineQuestion question, const VariedScene& scene,
                            const std::vector<SweptFigure>& figures);
// All rows of these values, in their order. Throws OutOfTime where it is interrupted.
std::vector<SweepRow> rows_of(const MachineQuestion& question, const VariedScene& scene,
                              const std::vector<SweptFigure>& figures, const std::vector<std::vector<double>>& values,
                              int jobs);

}  // namespace kurbel
