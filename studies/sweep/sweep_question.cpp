// sweep_question.cpp — kurbel sweep: a design of variants of a scene, into a database; kurbel merge: shards into one.
#include "studies/sweep/sweep_question.h"

#include <fmt/format.h>

#include <stdexcept>

#include "engine/tables/table_text.h"
#include "studies/question/question.h"
#include "studies/variants/in_threads.h"

namespace kurbel {
namespace {

OptionsOf<SweepRequest> sweep_options() {
  return OptionsOf<SweepRequest>()
      .add({.name = "vary",
            .doc = "KEY=FROM..TO UNIT or KEY=A,B,C UNIT, e.g. \"main_coupling.stiffness=500..1500 kN*m/rad\", "
                   "\"flywheel.inertia=200,400,800 kg*m2\"; repeatable",
            .each_time = true},
           &SweepRequest::vary)
      .add({.name = "variants",
            .doc = "a table instead: a CSV file whose header names the keys, \"flywheel.inertia [kg*m2]\"; a row a "
                   "variant"},
           &SweepRequest::variants)
      .add({.name = "design",
            .doc = "grid:21x3, sobol:4096, lhs:500, random:500, or saltelli:1024 for Sobol indices, which makes "
                   "1024 (k + 2) rows (default: grid, of lists)"},
           &SweepRequest::design)
      .add({.name = "figures",
            .doc = "names joined by commas, or a quantity for all that have it: delta,peak_torque (default: all)",
            .words = true},
           &SweepRequest::figures)
      .add({.name = "limit",
            .doc =
                "\"delta.press <= 0.05\": share of variants within the limit, with its confidence interval; repeatable",
            .each_time = true},
           &SweepRequest::limits)
      .add(machine_options(), &SweepRequest::machine)
      .add({.name = "error_every",
            .doc = "20 measures the errors of every 20th row only (default: 1)",
            .domain = {.low = 1, .high = 1'000'000}},
           &SweepRequest::errors_every)
      .add({.name = "into",
            .doc = "the database (SQLite) that is filled or continued, on a local disk; what is committed (four "
                   "times a second) survives a kill and, if the disk really flushes, a power cut",
            .required = true},
           &SweepRequest::into)
      .add({.name = "jobs", .doc = "threads (default: one for each core)", .domain = {.low = 1, .high = 1024}},
           &SweepRequest::jobs)
      .add({.name = "shard", .doc = "I/N: only rows of this shard, e.g. 3/64; kurbel merge puts them together"},
           &SweepRequest::shard)
      .add({.name = "seed",
            .doc = "of random, lhs, and the shift of sobol (default: 1; 0: sobol as published)",
            .domain = {.low = 0, .high = 9007199254740992}},
           &SweepRequest::seed)
      .add({.name = "xlsx", .doc = "writes the variants as a spreadsheet, too"}, &SweepRequest::xlsx);
}

// As the database records it.
std::string errors_in_words(const SweepRequest& a) {
  if (!a.machine.measure_error) return "none";
  return a.errors_every == 1 ? "measure" : fmt::format("every:{}", a.errors_every);
}

// The varied parameters: --variants with its values, else --vary.
VariantTable table_asked(const SweepRequest& a) {
  if (!a.variants.empty()) {
    if (!a.vary.empty() || !a.design.empty())
      throw std::invalid_argument("--variants is the whole design; omit --vary and --design");
    return read_variants(a.variants);
  }
  VariantTable table;
  for (const std::string& text : a.vary) table.parameters.push_back(parse_parameter(text));
  if (table.parameters.empty())
    throw std::invalid_argument(
        "nothing is varied; give --vary \"main_coupling.stiffness=500..1500 kN*m/rad\" or --variants FILE.csv");
  return table;
}

SweepIdentity identity_of(const SweepRequest& a, const Inquiry& inquiry, const Design& design,
                          const std::vector<SweptFigure>& figures) {
  std::map<std::string, std::string> meta{{"title", inquiry.scene.title},
                                          {"scene file", inquiry.scene.file},
                                          {"scene text", inquiry.scene.text},
                                          {"settings", joined_lines(inquiry.settings)},
                                          {"of", a.machine.of},
                                          {"errors", errors_in_words(a)},
                                          {"seed", std::to_string(a.seed)}};
  if (a.machine.delta) meta["delta"] = fmt::format("{}", *a.machine.delta);
  if (!a.variants.empty()) meta["variants"] = read_table_text(a.variants).text;
  return identity_of(design, figures, a.shard, std::move(meta));
}

StudyOutput sweep(const Inquiry& inquiry, SweepRequest asked) {
  auto [store, end] = fill_sweep(inquiry, asked);
  const auto kept = std::make_shared<StoredSweep>(std::move(store), asked.limits);
  kept->study.wanted = end.rows;
  kept->study.speed_unit = inquiry.scene.speed_unit;
  kept->study.interrupted = inquiry.watch.stopped();
  if (!asked.xlsx.empty()) write_xlsx(kept->study, asked.xlsx);
  StudyOutput output = output_of(kept);
  if (end.there > 0)
    output.aside = fmt::format("{} of {} rows were there already, {} computed", end.there, end.rows, end.computed);
  return output;
}

struct MergeRequest {
  std::vector<std::string> files;
  std::string into;
};

StudyOutput merge(const Inquiry&, MergeRequest asked) {
  const std::size_t rows = merge_sweeps(asked.files, asked.into);
  const std::size_t wanted = SweepStore(asked.into).identity().rows;
  StudyOutput output = in_words(fmt::format("{}: {} of {} rows\n", asked.into, rows, wanted));
  if (rows < wanted)
    output.aside = fmt::format("{} rows are missing; kurbel sweep with --into {} and without --shard computes them",
                               wanted - rows, asked.into);
  return output;
}

}  // namespace

FilledSweep fill_sweep(const Inquiry& inquiry, const SweepRequest& asked) {
  VariantTable table = table_asked(asked);
  SweepJob job{.jobs = threads_of(asked.jobs)};
  read_shard(asked.shard, job);
  MachineQuestion question = question_of(inquiry, asked.machine);
  question.errors_every *= asked.errors_every;
  const VariedScene varied(question, table.parameters);
  const Design design = asked.variants.empty() ? Design(asked.design.empty() ? "grid" : asked.design,
                                                        std::move(table.parameters), asked.seed)
                                               : Design(std::move(table));
  job.design = &design;
  const std::vector<SweptFigure> figures = chosen(figures_of(question), asked.figures);
  for (const std::string& limit : asked.limits) parse_limit(limit, figures);
  if (!asked.xlsx.empty()) check_xlsx(asked.xlsx, design.rows() / job.shards);
  auto store = std::make_unique<SweepStore>(asked.into, identity_of(asked, inquiry, design, figures));
  job.watch = inquiry.watch;
  job.evaluator = [&] { return machine_evaluator(question, varied, figures); };
  const SweepEnd end = run_sweep(job, *store);
  return {std::move(store), end};
}

StudyOutput output_of(std::shared_ptr<const StoredSweep> sweep) { return {findings_of(sweep->study), {}, {}, sweep}; }

Question sweep_question() {
  return make_question(
      {.place = 112,
       .name = "sweep",
       .arguments = "scene.toml --vary \"main_coupling.stiffness=500..1500 kN*m/rad\" --design sobol:512 --into r.db",
       .help = "thousands of variants of a scene into a database, and which parameters matter",
       .does = "computes a design of variants (`--vary`, `--variants`, `--design`), each with measured errors, into an "
               "SQLite file that resumes by itself; response curves, maps with limits (`--limit`), influence by "
               "Sobol's indices, failures by reason, worst machines with the line that computes each alone"},
      sweep_options(), sweep);
}

Question merge_question() {
  return make_question(
      {.place = 114,
       .name = "merge",
       .arguments = "a.db b.db --into all.db",
       .help = "shards of a sweep into one database",
       .does = "puts shards of one sweep together, after checking that scene, design and version "
               "agree and that no row has two results",
       .of_scene = false},
      OptionsOf<MergeRequest>()
          .add({.name = "files", .doc = "databases of the shards", .words = true, .required = true, .by_place = true},
               &MergeRequest::files)
          .add({.name = "into", .doc = "the database that is made", .required = true}, &MergeRequest::into),
      merge);
}

}  // namespace kurbel
