// sweep_command.cpp — kurbel sweep: a design of variants of a scene, into a database; kurbel merge: shards into one;
// kurbel diff: two machines side by side.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <stdexcept>

#include "app/question_command.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "engine/scene/document.h"
#include "engine/tables/table_text.h"
#include "studies/difference/difference.h"
#include "studies/question/option_values.h"
#include "studies/sweep/sweep.h"
#include "studies/sweep/sweep_findings.h"
#include "studies/variants/in_threads.h"
#include "studies/variants/machine.h"

namespace kurbel::app::sweep_command {
namespace {

constexpr int most_threads = 1024;

// Why a text is no number of threads; an empty text is accepted, as the check runs for every option.
std::string thread_count(const std::string& text) {
  if (text.empty()) return "";
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const bool is_count = error == std::errc() && end == text.data() + text.size() && count >= 1 && count <= most_threads;
  return is_count ? "" : fmt::format("Value {} not in range [1 - {}]", text, most_threads);
}

struct SweepArguments {
  StudyOptions study;
  std::vector<std::string> vary, figures, limits;
  std::string variants, design, of = "run", errors = "measure", into, shard = "1/1", delta, xlsx;
  int jobs = 0;
  std::uint64_t seed = 1;
};

std::size_t errors_every(const std::string& errors) {
  if (errors == "measure") return 1;
  if (errors == "none") return 0;
  std::size_t every = 0;
  const char* const end = errors.data() + errors.size();
  if (errors.starts_with("every:") && errors.size() > 6 && errors.size() < 16)
    if (const auto read = std::from_chars(errors.data() + 6, end, every); read.ptr == end && every > 0) return every;
  throw std::invalid_argument(
      fmt::format("--errors {}: must be measure, none or every:N, e.g. every:20", in_quotes(errors)));
}

// The varied parameters: --variants with its values, else --vary.
VariantTable table_asked(const SweepArguments& a) {
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

Design design_of(const SweepArguments& a, VariantTable table) {
  if (!a.variants.empty()) return Design(std::move(table));
  return Design(a.design.empty() ? "grid" : a.design, std::move(table.parameters), a.seed);
}

MachineQuestion question_of(const SweepArguments& a, const Inquiry& inquiry) {
  MachineQuestion q = kurbel::question_of(inquiry, a.of);
  q.errors_every = errors_every(a.errors);
  if (!a.delta.empty() && q.of != SweepStudy::size)
    throw std::invalid_argument(fmt::format("--delta {}: belongs to --of size", a.delta));
  if (!a.delta.empty()) q.delta = quantity_of("--delta", a.delta, "a plain number", "0.05", any_number);
  return q;
}

SweepIdentity identity_of(const SweepArguments& a, const Scene& scene, const Design& design,
                          const std::vector<SweptFigure>& figures) {
  std::map<std::string, std::string> meta{{"title", scene.title},
                                          {"scene file", a.study.scene},
                                          {"scene text", scene.text},
                                          {"settings", joined_lines(a.study.set)},
                                          {"of", a.of},
                                          {"errors", a.errors},
                                          {"seed", std::to_string(a.seed)}};
  if (!a.delta.empty()) meta["delta"] = a.delta;
  if (!a.variants.empty()) meta["variants"] = read_table_text(a.variants).text;
  return identity_of(design, figures, a.shard, std::move(meta));
}

int sweep(const SweepArguments& a) {
  VariantTable table = table_asked(a);
  SweepJob job{.jobs = threads_of(a.jobs)};
  read_shard("--shard", a.shard, job);
  // All errors are reported before anything is written.
  const Scene scene = read(a.study);
  Progress progress(a.study.quiet);
  const MachineQuestion question = question_of(a, inquiry_of(scene, a.study, progress));
  const VariedScene varied(question, table.parameters);
  const Design design = design_of(a, std::move(table));
  job.design = &design;
  const std::vector<SweptFigure> figures = chosen(figures_of(question), a.figures);
  for (const std::string& limit : a.limits) parse_limit(limit, figures);
  check_folder(a.study);
  if (!a.xlsx.empty()) check_xlsx(a.xlsx, design.rows() / job.shards);

  SweepStore store(a.into, identity_of(a, scene, design, figures));
  job.watch = watch_of(a.study, progress);
  job.evaluator = [&] { return machine_evaluator(question, varied, figures); };
  const SweepEnd end = run_sweep(job, store);
  if (end.there > 0)
    complain(fmt::format("kurbel: {} of {} rows were there already, {} computed\n", end.there, end.rows, end.computed));
  SweepStudyResult study = study_of(store, a.limits);
  study.wanted = end.rows;
  study.interrupted = interrupted();
  if (!a.xlsx.empty()) write_xlsx(study, a.xlsx);
  return present(output_of(study), a.study);
}

void set_up_sweep(OptionList& command, int& code) {
  const auto a = std::make_shared<SweepArguments>();
  add_study_options(command, a->study);
  command
      .add_option("--vary", a->vary,
                  "KEY=FROM..TO UNIT or KEY=A,B,C UNIT, e.g. \"main_coupling.stiffness=500..1500 kN*m/rad\", "
                  "\"flywheel.inertia=200,400,800 kg*m2\"; repeatable")
      .repeatable();
  command.add_option(
      "--variants", a->variants,
      "a table instead: a CSV file whose header names the keys, \"flywheel.inertia [kg*m2]\"; a row a variant");
  command.add_option("--design", a->design,
                     "grid:21x3, sobol:4096, lhs:500, random:500, or saltelli:1024 for Sobol indices, which makes 1024 "
                     "(k + 2) rows (default: grid, of lists)");
  command
      .add_option(
          "--figures", a->figures,
          "names joined by commas, or a quantity for all that have it: delta,peak_torque.main_coupling (default: all)")
      .split_at(',');
  command.add_option("--limit", a->limits, "\"delta.press <= 0.05\": counted, drawn, and how sure; repeatable")
      .repeatable();
  command.add_option("--of", a->of, "run (default), steady, modes or size");
  command.add_option("--delta", a->delta, "demanded δ, of --of size");
  command.add_option("--errors", a->errors, "measure (default), none, or every:20 for those of every 20th row");
  command
      .add_option("--into", a->into,
                  "the database (SQLite) that is filled or continued, on a local disk; what is committed (four times a "
                  "second) survives a kill and, if the disk really flushes, a power cut")
      .required();
  command.add_option("--jobs", a->jobs, "threads (default: one for each core)").check(thread_count);
  command.add_option("--shard", a->shard, "I/N: only rows of this shard, e.g. 3/64; kurbel merge puts them together");
  command.add_option("--seed", a->seed, "of random, lhs, and the shift of sobol (default: 1; 0: sobol as published)");
  command.add_option("--xlsx", a->xlsx, "writes the variants as a spread sheet, too");
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

struct DifferenceArguments {
  StudyOptions study;
  std::string other;
  std::vector<std::string> other_set;
  DeclaredOptions declared;
};

int compare_scenes(const DifferenceArguments& a) {
  StudyOptions second = a.study;
  second.scene = a.other;
  second.set.insert(second.set.end(), a.other_set.begin(), a.other_set.end());
  // Errors in either scene are reported with their place.
  const Scene one = read(a.study), other = read(second);
  check_folder(a.study);
  Progress progress(a.study.quiet);
  return present(
      difference(inquiry_of(one, a.study, progress), inquiry_of(other, second, progress), a.declared.given()), a.study);
}

void set_up_difference(OptionList& command, int& code) {
  const auto a = std::make_shared<DifferenceArguments>();
  add_study_options(command, a->study);
  command.add_option("other", a->other, "scene file of the other machine").required();
  command
      .add_option("--other-set", a->other_set,
                  "COMPONENT.KEY=VALUE in the other machine alone; --set holds for both; repeatable")
      .repeatable();
  a->declared.add_to(command, difference_options());
  command.action([&code, a] { code = compare_scenes(*a); });
}

const Verb difference_verb{
    {{.place = 22,
      .name = "diff",
      .arguments = "a.toml b.toml",
      .help = "two machines figure by figure, and what differs in their scenes",
      .does =
          "puts the same question (`--of`) to two scenes, or to one with other values (`--other-set`): every figure of "
          "both with its error, whether they differ by more than that, and the keys that differ",
      .more = {"a.toml a.toml --other-set \"main_coupling.stiffness=1 MN*m/rad\" | what one value does"}},
     set_up_difference}};

}  // namespace
}  // namespace kurbel::app::sweep_command
