// sweep.h — many variants: of a machine, or of whatever a function of the caller's computes. Rows are kept in a file
// (SQLite) as they come, so that an interrupted sweep goes on where it was.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <kurbel/studies.h>

namespace kurbel {

class Machine;

// What is varied, as kurbel sweep is told: "main_coupling.stiffness=500..1500 kN*m/rad", "flywheel.inertia=200,400 kg*m2".
struct Variation {
  std::vector<std::string> vary;  // "PATH=LOW..HIGH UNIT" or "PATH=VALUE,VALUE UNIT"
  std::string design = "grid";    // "grid:21x3", "sobol:4096", "lhs:500", "random:500", "saltelli:1024"
  std::uint64_t seed = 1;         // of designs by chance
};

// The values of all rows, in the units of `vary`; row i is a function of i, design and seed alone. Throws
// std::invalid_argument in words.
std::vector<std::vector<double>> rows_of(const Variation& variation);
// The same as settings of a scene, for Machine::with(). Throws std::invalid_argument in words.
std::vector<std::vector<std::pair<std::string, std::string>>> settings_of(const Variation& variation);

// Where the rows go, and who computes them.
struct SweepChoices {
  std::string into;           // the file; gone on with where it holds the same sweep
  int jobs = 0;               // threads; 0: one for each core
  std::string shard = "1/1";  // only rows of this shard, I/N with 1 ≤ I ≤ N; kurbel merge puts them together
  bool lines = true;          // in the answer; false: in the file alone, for rows_in()
  Watcher watcher = {};       // interrupted, it ends with the rows that are done
};

// A figure that every row has.
struct SweepColumn {
  std::string name;  // "peak_torque.main_coupling"
  std::string unit;  // SI, "N*m"; empty: a plain number
};
// One variant.
struct SweepLine {
  std::size_t row = 0;                         // of the design, from 0
  std::string state;                           // "done", "unconfirmed", "failed"
  std::string diagnosis;                       // of a failed one
  std::vector<double> parameters;              // in the units of `vary`
  std::vector<std::optional<double>> figures;  // in the order of the columns, SI
  std::vector<std::optional<double>> errors;   // of them; empty: not measured
};
// What a sweep's file holds.
struct SweepRows {
  std::vector<std::string> vary;     // as it was given
  std::vector<SweepColumn> columns;  // of every line's figures
  std::vector<SweepLine> lines;      // by row; none where they were not wanted
  std::size_t computed = 0;          // now, and not before
  bool complete = false;             // all of the shard are there
};

// Of a row with these parameters; throws for one that fails, which says why. Called by several threads at once.
using RowFunction = std::function<std::vector<double>(const std::vector<double>& parameters)>;
// A function over a design. `question` names what it computes: a file holds one question's rows alone, of one version of
// kurbel. Throws std::invalid_argument for a variation that is none and for a file of another sweep.
SweepRows sweep(const Variation& variation, const std::string& question, const std::vector<SweepColumn>& columns,
                const RowFunction& function, const SweepChoices& choices);

// Figures of a machine: of "run", "steady", "modes" or "size". `figures`: whole names, or a quantity ("delta"); empty: all.
// Throws BadScene where the machine is none with what is varied, std::invalid_argument as above.
SweepRows sweep(const Machine& machine, const Variation& variation, const std::vector<std::string>& figures,
                const SweepChoices& choices, const std::string& of = "run");

// What a sweep's file holds, merged or not. With `visit` lines go there one by one and none is held, however many there are.
// Throws std::invalid_argument for a file that is none.
SweepRows rows_in(const std::string& file, const std::function<void(const SweepLine&)>& visit = {});
// Its report, as `kurbel sweep` tells it: response curves, what moves the figures, failures, the worst machines. Limits as
// "delta.press <= 0.05". Throws std::invalid_argument for a file or a limit that is none.
Study sweep_report(const std::string& file, const std::vector<std::string>& limits = {});
// Shards of one sweep into one file; how many rows it has. Throws std::invalid_argument where they are of several sweeps.
std::size_t merge(const std::vector<std::string>& files, const std::string& into);

// What a row is made of, for whoever sends rows to processes of their own.
struct SweepAnswer {
  std::string state;      // "done", "unconfirmed", "failed"
  std::string diagnosis;  // of a failed one, of one whose accuracy is not confirmed
  FigureValues figures;   // SI
};
// Of one machine: "run", "steady", "modes" or "size". Throws BadScene, and std::invalid_argument for another question.
SweepAnswer answer(const Machine& machine, const std::string& of = "run", bool errors = true,
                   const Watcher& watcher = {});

}  // namespace kurbel
