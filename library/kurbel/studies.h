// studies.h — every question that kurbel answers: the words, figures and pages of its commands.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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
  explicit Study(std::shared_ptr<const StudyParts> parts) : parts_(std::move(parts)) {}
  std::string conclusion() const;   // in one line
  std::string text() const;         // as the command prints it
  std::string json() const;         // the same for programs: summary.json, docs/summary.schema.json
  std::string html() const;         // the page, whole in itself
  bool complete() const;            // it came to its end …
  std::string diagnosis() const;    // … or why not
  std::string unconfirmed() const;  // why the accuracy asked for is not sure; empty: it is
  std::vector<std::pair<std::string, std::string>> tables() const;  // CSV files by their names
  // summary.json, report.html and the tables into a folder, as one result set: whole or not there. Formats of the tables,
  // joined by commas: "csv,mat,xlsx". Throws std::invalid_argument for others.
  void write(const std::string& folder, const std::string& formats = "csv") const;

 private:
  std::shared_ptr<const StudyParts> parts_;
};

// Options by the names that the command has: {"mid_speed", "60 rpm"} is --mid-speed "60 rpm". A flag is "true".
using Options = std::vector<std::pair<std::string, std::string>>;

// One of study_names() put to a machine. Throws std::invalid_argument for another name, and for an option that the study
// does not have (with those that it has).
Study study(const std::string& name, const Machine& machine, const Options& options = {}, const Watcher& watcher = {});
std::vector<std::string> study_names();  // "compare", "steady", "modes", …
std::vector<std::string> option_names(const std::string& study);

inline Study compare(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("compare", m, o, w);
}
inline Study steady(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("steady", m, o, w); }
inline Study modes(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("modes", m, o, w); }
inline Study forces(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("forces", m, o, w); }
inline Study size(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("size", m, o, w); }
inline Study reduce(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("reduce", m, o, w); }
inline Study gears(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("gears", m, o, w); }
inline Study effects(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("effects", m, o, w);
}
inline Study advise(const Machine& m, const Options& o = {}, const Watcher& w = {}) { return study("advise", m, o, w); }
inline Study accuracy(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("accuracy", m, o, w);
}
inline Study uncertainty(const Machine& m, const Options& o = {}, const Watcher& w = {}) {
  return study("uncertainty", m, o, w);
}

}  // namespace kurbel
