// studies.h — every question that kurbel answers: the words, figures and pages of its commands.
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

// Who watches a study at work.
struct Watcher {
  const std::atomic<bool>* interrupted = nullptr;                               // set: it stops and keeps what there is
  std::function<void(const std::string& what, double fraction)> progress = {};  // 0 … 1 of what is said
};

// What a study found. A value: copies share it.
class Study {
 public:
  explicit Study(std::shared_ptr<const StudyParts> parts) : parts_(std::move(parts)) {}  // for kurbel itself
  std::string conclusion() const;                                                        // in one line
  std::string text() const;                                                              // all of it, for a terminal
  std::string json() const;         // the same for programs: summary.json, docs/summary.schema.json
  std::string html() const;         // the page, whole in itself
  bool complete() const;            // it came to its end …
  std::string diagnosis() const;    // … or why not
  std::string unconfirmed() const;  // why the accuracy asked for is not sure; empty: it is
  // All figures in the summary, in their order; those of several models have its name in `of`.
  std::vector<FigureValue> figures() const;
  // CSV files by their names, and a sheet to be printed where one was asked for ("sheet.html").
  std::vector<std::pair<std::string, std::string>> tables() const;
  // summary.json, report.html and the tables into a folder, as one result set: whole or not there. Formats of the tables,
  // joined by commas: "csv,mat,xlsx". Throws std::invalid_argument for others, std::runtime_error where it cannot be
  // written.
  void write(const std::string& folder, const std::string& formats = "csv") const;

 private:
  std::shared_ptr<const StudyParts> parts_;
};

// Options by the names that the command has: {"mid_speed", "60 rpm"} is `--mid-speed "60 rpm"`. A flag is "true"; what may be
// given again there may be given again here.
using Options = std::vector<std::pair<std::string, std::string>>;

// One of study_names() put to a machine. Throws std::invalid_argument for another name, and for an option that the study
// does not have (with those that it has); BadScene where the machine cannot be compiled or started.
Study study(const std::string& name, const Machine& machine, const Options& options = {}, const Watcher& watcher = {});
std::vector<std::string> study_names();                           // "compare", "steady", "modes", …
std::vector<std::string> option_names(const std::string& study);  // "mid_speed", …; std::invalid_argument: no study

// Rigid against elastic, or two sets of effects (`effects`, `against`): the figures of both, and their ratio. Behind short
// runs the effects that are off are tried, unless `no_trials` is "true".
inline Study compare(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("compare", m, o, w);
}
// The motion that a start leads to: δ at every shaft, torques, works, whether it is stable. A test's record is laid over it by
// `measured`, `map`, `shift`, `offset`.
inline Study steady(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("steady", m, o, w); }
// Natural frequencies [Hz], shapes, damping; the response to the machine's own orders.
inline Study modes(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("modes", m, o, w); }
// Reactions in every joint of a mechanism [N], balancing torque [N·m], shaking forces [N].
inline Study forces(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("forces", m, o, w); }
// The flywheel's inertia [kg·m²] for a demanded δ = (ω_max − ω_min)/ω_mean (`delta`), and its dimensions.
inline Study size(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("size", m, o, w); }
// The machine on one link (`to`): inertia, torque and the drive's elastic chain over its angle.
inline Study reduce(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("reduce", m, o, w); }
// Gear pairs of the stages that are given by module: contact ratio, sliding, undercut, mesh stiffness.
inline Study gears(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("gears", m, o, w); }
// What each effect changes and costs: the full model without one effect at a time.
inline Study effects(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("effects", m, o, w);
}
// The cheapest set of effects whose figures stay within a part (`within`) of the fullest model's.
inline Study advise(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("advise", m, o, w); }
// What accuracy costs: integrators and tolerances against references by two independent methods.
inline Study accuracy(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("accuracy", m, o, w);
}
// What tolerances that the scene gives make of its figures, by gradients and by samples.
inline Study uncertainty(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("uncertainty", m, o, w);
}

// Two machines figure by figure, and what differs in their scenes: `of` ("run", "steady", "modes", "size"), `no_error`, `delta`.
Study diff(const Machine& a, const Machine& b, const Options& options = {}, const Watcher& watcher = {});

}  // namespace kurbel
