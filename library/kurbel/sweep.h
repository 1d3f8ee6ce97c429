// sweep.h — many variants of a machine or of a function of the caller. Rows are stored in a file (SQLite) as they are
// computed, so that an interrupted sweep continues where it stopped.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <kurbel/studies.h>

namespace kurbel {

class Machine;

// What is varied, as in kurbel sweep: "main_coupling.stiffness=500..1500 kN*m/rad", "flywheel.inertia=200,400 kg*m2".
struct Variation {
  std::vector<std::string> vary;  // "PATH=LOW..HIGH UNIT" or "PATH=VALUE,VALUE UNIT"
  std::string design = "grid";    // "grid:21x3", "sobol:4096", "lhs:500", "random:500", "saltelli:1024"
  std::uint64_t seed = 1;         // of random designs
};

// The values of all rows, in the units of `vary`; row i depends on i, design and seed alone. Throws
// std::invalid_argument with the reason.
std::vector<std::vector<double>> rows_of(const Variation& variation);
// The same as settings of a scene, for Machine::with(). Throws std::invalid_argument with the reason.
std::vector<std::vector<std::pair<std::string, std::string>>> settings_of(const Variation& variation);

// Where the rows are stored, and how they are computed.
struct SweepChoices {
  std::string into;           // the file; a file with the same sweep is continued
  int jobs = 0;               // threads; 0: one for each core
  std::string shard = "1/1";  // only rows of this shard, I/N with 1 ≤ I ≤ N; kurbel merge joins them
  bool lines = true;          // return the rows; false: in the file only, for rows_in()
  Watcher watcher = {};       // on interruption the sweep ends with the finished rows
};

// A figure of every row.
struct SweepColumn {
  std::string name;  // "peak_torque.main_coupling"
  std::string unit;  // SI, "N*m"; empty: a plain number
};
// One variant.
struct SweepLine {
  std::size_t row = 0;                         // in the design, from 0
  std::string state;                           // "done", "unconfirmed", "failed"
  std::string diagnosis;                       // of a failed one
  std::vector<double> parameters;              // in the units of `vary`
  std::vector<std::optional<double>> figures;  // in the order of the columns, SI
  std::vector<std::optional<double>> errors;   // of them; empty: not measured
};
// Contents of a sweep's file.
struct SweepRows {
  std::vector<std::string> vary;     // as given
  std::vector<SweepColumn> columns;  // of every line's figures
  std::vector<SweepLine> lines;      // by row; empty if not requested
  std::size_t computed = 0;          // number of rows computed in this call
  bool complete = false;             // all rows of the shard are there
};

// Figures of a row with these parameters; throws with the reason if it fails. Called by several threads at once.
using RowFunction = std::function<std::vector<double>(const std::vector<double>& parameters)>;
// A function over a design. `question` names what it computes: a file holds rows of one question and one version of
// kurbel. Throws std::invalid_argument for an invalid variation and for a file of another sweep.
SweepRows sweep(const Variation& variation, const std::string& question, const std::vector<SweepColumn>& columns,
                const RowFunction& function, const SweepChoices& choices);

// Figures of a machine: of "run", "steady", "modes" or "size". `figures`: full names, or a quantity ("delta"); empty: all.
// Throws BadScene if the variation makes the machine invalid, std::invalid_argument as above.
SweepRows sweep(const Machine& machine, const Variation& variation, const std::vector<std::string>& figures,
                const SweepChoices& choices, const std::string& of = "run");

// Contents of a sweep's file, merged or not. With `visit` the lines are passed one by one and not stored, however many.
// Throws std::invalid_argument for another file.
SweepRows rows_in(const std::string& file, const std::function<void(const SweepLine&)>& visit = {});
// The report of `kurbel sweep`: response curves, most influential parameters, failures, worst machines. Limits as
// "delta.press <= 0.05". Throws std::invalid_argument for an invalid file or limit.
Study sweep_report(const std::string& file, const std::vector<std::string>& limits = {});
// Joins shards of one sweep in one file; returns its number of rows. Throws std::invalid_argument for shards of several sweeps.
std::size_t merge(const std::vector<std::string>& files, const std::string& into);

// The data of a row, for callers that distribute rows to their own processes.
struct SweepAnswer {
  std::string state;      // "done", "unconfirmed", "failed"
  std::string diagnosis;  // of a row that failed or whose accuracy is not confirmed
  FigureValues figures;   // SI
};
// For one machine: "run", "steady", "modes" or "size". Throws BadScene, and std::invalid_argument for another question.
SweepAnswer answer(const Machine& machine, const std::string& of = "run", bool no_error = false,
                   const Watcher& watcher = {});

}  // namespace kurbel
