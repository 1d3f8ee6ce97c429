// studies.h — every question that kurbel answers: conclusions, figures and pages of its commands.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <kurbel/figures.h>

namespace kurbel {

class Machine;
struct StudyParts;

// Observes a study while it runs.
struct Watcher {
  const std::atomic<bool>* interrupted = nullptr;                               // set: stops and keeps its results
  std::function<void(const std::string& what, double fraction)> progress = {};  // 0 … 1 of the named work
};

// The result of a study. A value: copies share it.
class Study {
 public:
  explicit Study(std::shared_ptr<const StudyParts> parts) : parts_(std::move(parts)) {}  // for kurbel itself
  // Moving copies, too: what was moved from is still that result.
  Study(const Study&) = default;
  Study& operator=(const Study&) = default;  // likewise
  std::string conclusion() const;            // one line
  std::string text() const;                  // complete, for a terminal
  std::string json() const;                  // the same for programs: summary.json, docs/summary.schema.json
  std::string html() const;                  // the page, self-contained
  bool complete() const;                     // it reached its end …
  std::string diagnosis() const;             // … or why not
  std::string unconfirmed() const;           // why the requested accuracy is not confirmed; empty: it is
  // All figures in the summary, in order; if there are several models, `of` names the model.
  std::vector<FigureValue> figures() const;
  // CSV files by name, and a printable sheet if one was requested ("sheet.html").
  std::vector<std::pair<std::string, std::string>> tables() const;
  // Writes summary.json, report.html and the tables into a folder, as one result set: complete or not at all.
  // `formats` of the tables: "csv,mat,xlsx". Throws std::invalid_argument for others, std::runtime_error if it cannot
  // be written.
  void write(const std::string& folder, const std::string& formats = "csv") const;

 private:
  std::shared_ptr<const StudyParts> parts_;
};

// Options by the names of the command: {"mid_speed", "60 rpm"} is `--mid-speed "60 rpm"`. A flag is "true"; an option
// that the command accepts repeatedly may be repeated here.
using Options = std::vector<std::pair<std::string, std::string>>;

// Answers one of study_names() for a machine. Throws std::invalid_argument for another name, and for an option that
// the study does not have (with those that it has); BadScene if the machine cannot be compiled or started.
Study study(const std::string& name, const Machine& machine, const Options& options = {}, const Watcher& watcher = {});
// Without a machine: a pair of gears alone, {{"teeth", "19,95"}, {"module", "4 mm"}}; the list of effects. Throws
// std::invalid_argument, also for a study that needs a machine.
Study study(const std::string& name, const Options& options, const Watcher& watcher = {});
// Whether study() needs a machine to answer it.
bool needs_machine(const std::string& study);
std::vector<std::string> study_names();                           // "compare", "steady", "modes", …
std::vector<std::string> option_names(const std::string& study);  // "mid_speed", …; std::invalid_argument: none such

// Rigid against elastic, or two sets of effects (`effects`, `against`): the figures of both and their ratio. After
// short runs the effects that are off are tried, unless `no_trials` is "true".
inline Study compare(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("compare", m, o, w);
}
// The steady motion after a start: δ at every shaft, torques, works, stability. A measured record is compared with it
// by `measured`, `map`, `shift`, `offset`.
inline Study steady(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("steady", m, o, w); }
// Natural frequencies [Hz], shapes, damping; the response to the machine's own orders.
inline Study modes(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("modes", m, o, w); }
// Reactions in every joint of a mechanism [N], balancing torque [N·m], shaking forces [N].
inline Study forces(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("forces", m, o, w); }
// The flywheel's inertia [kg·m²] for a demanded δ = (ω_max − ω_min)/ω_mean (`delta`), and its dimensions.
inline Study size(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("size", m, o, w); }
// The machine reduced to one link (`to`): inertia, torque and elastic chain of the drive over its angle.
inline Study reduce(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("reduce", m, o, w); }
// Gear pairs of stages given by module, or a pair alone: contact ratio, sliding, undercut, mesh stiffness.
inline Study gears(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("gears", m, o, w); }
// A pair alone, by its numbers of teeth: {{"teeth", "19,95"}, {"module", "4 mm"}}.
inline Study gears(const Options& o, const Watcher& w = {}) { return study("gears", o, w); }
// What each effect changes and costs: the full model without one effect at a time.
inline Study effects(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("effects", m, o, w);
}
// The cheapest set of effects whose figures deviate from the full model by at most `within` (relative).
inline Study advise(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("advise", m, o, w); }
// Cost of accuracy: integrators and tolerances against references by two independent methods.
inline Study accuracy(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("accuracy", m, o, w);
}
// Effect of the tolerances given in the scene on its figures, by gradients and by samples.
inline Study uncertainty(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("uncertainty", m, o, w);
}

// Two machines figure by figure, and how their scenes differ: `of` ("run", "steady", "modes", "size"), `no_error`, `delta`.
Study diff(const Machine& a, const Machine& b, const Options& options = {}, const Watcher& watcher = {});

}  // namespace kurbel
