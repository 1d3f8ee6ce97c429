// sweep_command.cpp — kurbel sweep: a design of variants of a scene, into a database; kurbel merge: shards into one.
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "app/question_command.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "engine/scene/document.h"
#include "engine/tables/table_text.h"
#include "studies/sweep/sweep.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/variants/in_threads.h"
#include "studies/variants/machine.h"

namespace kurbel::app::sweep_command {
namespace {

struct SweepAsked {
  MachineAsked machine;
  std::vector<std::string> vary, figures, limits;
  std::string variants, design, into, shard = "1/1", xlsx;
  std::size_t errors_every = 1;
  int jobs = 0;
  std::uint64_t seed = 1;
};

const OptionsOf<SweepAsked>& sweep_options() {
  static const auto made =
      OptionsOf<SweepAsked>()
          .add({.name = "vary",
                .doc = "KEY=FROM..TO UNIT or KEY=A,B,C UNIT, e.g. \"main_coupling.stiffness=500..1500 kN*m/rad\", "
                       "\"flywheel.inertia=200,400,800 kg*m2\"; repeatable",
                .each_time = true},
               &SweepAsked::vary)
          .add({.name = "variants",
                .doc = "a table instead: a CSV file whose header names the keys, \"flywheel.inertia [kg*m2]\"; a row "
                       "a variant"},
               &SweepAsked::variants)
          .add({.name = "design",
                .doc = "grid:21x3, sobol:4096, lhs:500, random:500, or saltelli:1024 for Sobol indices, which makes "
                       "1024 (k + 2) rows (default: grid, of lists)"},
               &SweepAsked::design)
          .add({.name = "figures",
                .doc = "names joined by commas, or a quantity for all that have it: delta,peak_torque (default: all)",
                .words = true},
               &SweepAsked::figures)
          .add({.name = "limit",
                .doc = "\"delta.press <= 0.05\": counted, drawn, and how sure; repeatable",
                .each_time = true},
               &SweepAsked::limits)
          .add(machine_options(), &SweepAsked::machine)
          .add({.name = "error_every",
                .doc = "20 measures the errors of every 20th row only (default: 1)",
                .domain = {.low = 1, .high = 1'000'000}},
               &SweepAsked::errors_every)
          .add({.name = "into",
                .doc = "the database (SQLite) that is filled or continued, on a local disk; what is committed (four "
                       "times a second) survives a kill and, if the disk really flushes, a power cut"},
               &SweepAsked::into)
          .add({.name = "jobs", .doc = "threads (default: one for each core)", .domain = {.low = 1, .high = 1024}},
               &SweepAsked::jobs)
          .add({.name = "shard", .doc = "I/N: only rows of this shard, e.g. 3/64; kurbel merge puts them together"},
               &SweepAsked::shard)
          .add({.name = "seed",
                .doc = "of random, lhs, and the shift of sobol (default: 1; 0: sobol as published)",
                .domain = {.low = 0, .high = 9007199254740992}},
               &SweepAsked::seed)
          .add({.name = "xlsx", .doc = "writes the variants as a spread sheet, too"}, &SweepAsked::xlsx);
  return made;
}

struct SweepArguments {
  StudyOptions study;
  DeclaredOptions declared;
};

// As the database records it.
std::string errors_in_words(const SweepAsked& a) {
  if (!a.machine.measure_error) return "none";
  return a.errors_every == 1 ? "measure" : fmt::format("every:{}", a.errors_every);
}

// The varied parameters: --variants with its values, else --vary.
VariantTable table_asked(const SweepAsked& a) {
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

Design design_of(const SweepAsked& a, VariantTable table) {
  if (!a.variants.empty()) return Design(std::move(table));
  return Design(a.design.empty() ? "grid" : a.design, std::move(table.parameters), a.seed);
}

SweepIdentity identity_of(const SweepAsked& a, const std::vector<std::string>& settings, const Scene& scene,
                          const Design& design, const std::vector<SweptFigure>& figures) {
  std::map<std::string, std::string> meta{{"title", scene.title},
                                          {"scene file", scene.file},
                                          {"scene text", scene.text},
                                          {"settings", joined_lines(settings)},
                                          {"of", a.machine.of},
                                          {"errors", errors_in_words(a)},
                                          {"seed", std::to_string(a.seed)}};
  if (a.machine.delta) meta["delta"] = fmt::format("{}", *a.machine.delta);
  if (!a.variants.empty()) meta["variants"] = read_table_text(a.variants).text;
  return identity_of(design, figures, a.shard, std::move(meta));
}

int sweep(const SweepArguments& given) {
  // All errors are reported before anything is written.
  const Scene scene = read(given.study);
  const SweepAsked a = sweep_options().read(given.declared.given(), "sweep", scene);
  VariantTable table = table_asked(a);
  SweepJob job{.jobs = threads_of(a.jobs)};
  read_shard(a.shard, job);
  Progress progress(given.study.quiet);
  MachineQuestion question = question_of(inquiry_of(scene, given.study, progress), a.machine);
  question.errors_every *= a.errors_every;
  const VariedScene varied(question, table.parameters);
  const Design design = design_of(a, std::move(table));
  job.design = &design;
  const std::vector<SweptFigure> figures = chosen(figures_of(question), a.figures);
  for (const std::string& limit : a.limits) parse_limit(limit, figures);
  check_folder(given.study);
  if (!a.xlsx.empty()) check_xlsx(a.xlsx, design.rows() / job.shards);

  SweepStore store(a.into, identity_of(a, given.study.set, scene, design, figures));
  job.watch = watch_of(given.study, progress);
  job.evaluator = [&] { return machine_evaluator(question, varied, figures); };
  const SweepEnd end = run_sweep(job, store);
  if (end.there > 0)
    complain(fmt::format("kurbel: {} of {} rows were there already, {} computed\n", end.there, end.rows, end.computed));
  SweepStudyResult study = study_of(store, a.limits);
  study.wanted = end.rows;
  study.speed_unit = scene.speed_unit;
  study.interrupted = interrupted();
  if (!a.xlsx.empty()) write_xlsx(study, a.xlsx);
  return present(output_of(study), given.study);
}

void set_up_sweep(OptionList& command, int& code) {
  const auto a = std::make_shared<SweepArguments>();
  add_study_options(command, a->study);
  a->declared.add_to(command, sweep_options().declared());
  command.option("--into").required();
  command.action([&code, a] { code = sweep(*a); });
}

struct MergeArguments {
  std::vector<std::string> files;
  std::string into;
};

int merge(const MergeArguments& a) {
  const std::size_t rows = merge_sweeps(a.files, a.into);
  const std::size_t wanted = SweepStore(a.into).identity().rows;
  say(fmt::format("{}: {} of {} rows\n", a.into, rows, wanted));
  if (rows < wanted)
    complain(fmt::format("kurbel: {} rows are missing; kurbel sweep with --into {} and without --shard computes them\n",
                         wanted - rows, a.into));
  return exit_done;
}

void set_up_merge(OptionList& command, int& code) {
  const auto a = std::make_shared<MergeArguments>();
  command.add_option("files", a->files, "databases of the shards").required();
  command.add_option("--into", a->into, "the database that is made").required();
  command.action([&code, a] { code = merge(*a); });
}

const Verb sweep_verb{
    {{.place = 112,
      .name = "sweep",
      .arguments = "scene.toml --vary \"main_coupling.stiffness=500..1500 kN*m/rad\" --design sobol:512 --into r.db",
      .help = "thousands of variants of a scene into a database, and which parameters matter",
      .does = "computes a design of variants (`--vary`, `--variants`, `--design`), each with measured errors, into an "
              "SQLite file that resumes by itself; response curves, maps with limits (`--limit`), influence by Sobol's "
              "indices, failures by reason, worst machines with the line that computes each alone"},
     set_up_sweep}};

const Verb merge_verb{
    {{.place = 114,
      .name = "merge",
      .arguments = "a.db b.db --into all.db",
      .help = "shards of a sweep into one database",
      .does = "puts shards of one sweep together, after checking that scene, design and version agree "
              "and that no row has two results"},
     set_up_merge,
     false}};

}  // namespace
}  // namespace kurbel::app::sweep_command
