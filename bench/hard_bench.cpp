// hard_bench.cpp — do the hard cases end right? Every case with every method at every requested accuracy, as a matrix.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "bench/benches.h"
#include "tests/hard/families.h"

namespace kurbel::bench {
namespace {

using hard::CaseOutcome;
using hard::HardCase;
using hard::Verdict;

// All cells of one case: method by accuracy.
struct CaseMatrix {
  const HardCase* hard_case = nullptr;
  std::vector<std::vector<CaseOutcome>> cells;
};

constexpr std::array verdicts = {Verdict::passed,     Verdict::reported, Verdict::refused,
                                 Verdict::unfinished, Verdict::excluded, Verdict::failed};

Tone tone_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
    case Verdict::refused:
      return Tone::good;
    case Verdict::reported:
    case Verdict::unfinished:
      return Tone::fair;
    case Verdict::excluded:
      return Tone::aside;
    case Verdict::failed:
      return Tone::bad;
  }
  return Tone::bad;
}

// The worst of a row: the further down the list, the worse; what is excluded is aside.
Verdict worst_of(const std::vector<CaseOutcome>& row) {
  Verdict worst = Verdict::excluded;
  for (const CaseOutcome& o : row) {
    if (o.verdict == Verdict::excluded) continue;
    if (worst == Verdict::excluded || o.verdict > worst) worst = o.verdict;
  }
  return worst;
}

std::string words_of(const CaseOutcome& o) {
  if (o.verdict == Verdict::excluded) return o.words;
  if (o.runs == 0) return fmt::format("{}: {}", hard::name_of(o.verdict), o.words);
  return fmt::format("{}: error {:.1e}, asked {:.0e}; {} steps, smallest {:.1e} s, {} events, {:.3g} ms. {}",
                     hard::name_of(o.verdict), o.error, o.asked, o.steps, o.smallest_step, o.events,
                     1e3 * o.cpu_seconds, o.words);
}

std::string error_cell(const CaseOutcome& o) {
  if (o.verdict == Verdict::excluded) return "–";
  if (o.verdict == Verdict::refused) return "words";
  if (o.verdict == Verdict::unfinished) return "budget";
  return o.error > 0 || o.verdict == Verdict::failed ? fmt::format("{:.0e}", o.error) : "0";
}

// "FreeCrankOver10Turns" → "Free crank over 10 turns"; "1e9" and "1em9" are one number, and 1e-9 the other.
std::string in_words(const std::string& name) {
  const auto is = [&](int (*kind)(int), std::size_t i) {
    return i < name.size() && kind(static_cast<unsigned char>(name[i])) != 0;
  };
  std::string words;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (i > 1 && name[i] == 'm' && name[i - 1] == 'e' && is(std::isdigit, i - 2) && is(std::isdigit, i + 1)) {
      words += '-';
      continue;
    }
    const bool in_number = i > 1 && (name[i - 1] == 'e' || name[i - 1] == 'm') && words.size() > 1 &&
                           (words.back() == '-' || is(std::isdigit, i - 2));
    const bool word = i > 0 && is(std::isupper, i);
    const bool number = i > 0 && is(std::isdigit, i) && is(std::islower, i - 1) && !in_number;
    if (word || number) words += ' ';
    const bool lower = word && (is(std::islower, i + 1) || name[i] == 'A');  // "DC" stays
    words += lower ? static_cast<char>(std::tolower(static_cast<unsigned char>(name[i]))) : name[i];
  }
  return words;
}

// Cases by methods: how many accuracies were met.
Table overview(const std::string& family, const std::vector<CaseMatrix>& matrices) {
  Table table{.title = fmt::format("{}: accuracies met, of {}", family, hard::all_accuracies().size()),
              .columns = {"case", "parameter"},
              .rows = {},
              .text_columns = 2};
  for (const std::string& method : hard::all_methods()) table.columns.push_back(method);
  for (const CaseMatrix& m : matrices) {
    if (m.hard_case->family != family) continue;
    std::vector<std::string> row = {in_words(m.hard_case->name), m.hard_case->parameter};
    std::vector<Tone> tones(2, Tone::none);
    for (const std::vector<CaseOutcome>& cells : m.cells) {
      const auto met = std::count_if(cells.begin(), cells.end(), [](const CaseOutcome& o) {
        return o.verdict == Verdict::passed || o.verdict == Verdict::refused;
      });
      const Verdict worst = worst_of(cells);
      row.push_back(worst == Verdict::excluded ? "–" : std::to_string(met));
      tones.push_back(tone_of(worst));
    }
    table.rows.push_back(std::move(row));
    table.tones.push_back(std::move(tones));
  }
  return table;
}

// One case: errors, methods by accuracies.
Table errors_of(const CaseMatrix& m) {
  const HardCase& c = *m.hard_case;
  Table table{.title = fmt::format("{} ({}): errors", in_words(c.name), c.parameter),
              .columns = {"method"},
              .rows = {},
              .folded = true};
  for (const double accuracy : hard::all_accuracies()) table.columns.push_back(fmt::format("{:.0e}", accuracy));
  for (std::size_t k = 0; k < m.cells.size(); ++k) {
    std::vector<std::string> row = {hard::all_methods()[k]};
    std::vector<Tone> tones = {Tone::none};
    for (const CaseOutcome& o : m.cells[k]) {
      row.push_back(error_cell(o));
      tones.push_back(tone_of(o.verdict));
    }
    table.rows.push_back(std::move(row));
    table.tones.push_back(std::move(tones));
  }
  return table;
}

// One case: everything of every cell.
Table cells_of(const CaseMatrix& m) {
  const HardCase& c = *m.hard_case;
  Table table{.title = fmt::format("{} ({}): steps, events, time", in_words(c.name), c.parameter),
              .columns = {"method", "verdict", "words", "asked", "error", "steps", "smallest step / s", "events",
                          "runs", "time / ms"},
              .rows = {},
              .folded = true,
              .text_columns = 3};
  for (std::size_t k = 0; k < m.cells.size(); ++k)
    for (const CaseOutcome& o : m.cells[k])
      table.rows.push_back({hard::all_methods()[k], hard::name_of(o.verdict), o.words, fmt::format("{:.0e}", o.asked),
                            fmt::format("{:.1e}", o.error), std::to_string(o.steps),
                            fmt::format("{:.1e}", o.smallest_step), std::to_string(o.events), std::to_string(o.runs),
                            fmt::format("{:.3g}", 1e3 * o.cpu_seconds)});
  return table;
}

// Methods that do not apply, and why, each reason once.
Table exclusions(const std::string& family, const std::vector<CaseMatrix>& matrices) {
  Table table{.title = family + ": why methods are excluded",
              .columns = {"method", "reason", "cases"},
              .rows = {},
              .folded = true,
              .text_columns = 3};
  for (const CaseMatrix& m : matrices) {
    if (m.hard_case->family != family) continue;
    for (std::size_t k = 0; k < m.cells.size(); ++k) {
      const CaseOutcome& o = m.cells[k].front();
      if (o.verdict != Verdict::excluded) continue;
      const std::string& method = hard::all_methods()[k];
      const auto known = std::find_if(table.rows.begin(), table.rows.end(), [&](const std::vector<std::string>& row) {
        return row[0] == method && row[1] == o.words;
      });
      if (known == table.rows.end()) {
        table.rows.push_back({method, o.words, m.hard_case->name});
      } else {
        (*known)[2] += ", " + m.hard_case->name;
      }
    }
  }
  return table;
}

std::vector<std::string> families_of(const std::vector<CaseMatrix>& matrices) {
  std::vector<std::string> names;
  for (const CaseMatrix& m : matrices)
    if (std::find(names.begin(), names.end(), m.hard_case->family) == names.end()) names.push_back(m.hard_case->family);
  return names;
}

// By family: cells, verdicts, the worst ratio of error to the requested accuracy (and the condition) among those that
// passed.
Table summary(const std::vector<CaseMatrix>& matrices) {
  Table table{.title = "Hard cases: every case with every method at accuracies of 1e-3 … 1e-10",
              .columns = {"family", "cases", "cells"},
              .rows = {}};
  for (const Verdict v : verdicts) table.columns.emplace_back(hard::name_of(v));
  table.columns.insert(table.columns.end(), {"worst passed / asked", "time / s"});
  for (const std::string& family : families_of(matrices)) {
    std::array<long, verdicts.size()> count{};
    long cases = 0, cells = 0;
    double worst = 0, seconds = 0;
    for (const CaseMatrix& m : matrices) {
      if (m.hard_case->family != family) continue;
      ++cases;
      for (const auto& row : m.cells)
        for (const CaseOutcome& o : row) {
          ++cells;
          ++count[static_cast<std::size_t>(o.verdict)];
          seconds += o.cpu_seconds;
          if (o.verdict == Verdict::passed) worst = std::max(worst, hard::allowed_ratio * o.error / o.allowed);
        }
    }
    std::vector<std::string> row = {family, std::to_string(cases), std::to_string(cells)};
    for (const long n : count) row.push_back(std::to_string(n));
    row.insert(row.end(), {fmt::format("{:.2g}", worst), fmt::format("{:.3g}", seconds)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Errors at one local tolerance over 10 … 10 000 cycles, over a million by one method, and the exponents p of N^p that
// they grow with from the first to the last.
Table growth_of_errors(const std::string& title, HardCase (*machine)(double cycles), const std::string& long_runner) {
  Table table{.title = title,
              .columns = {"method", "error at N = 10", "100", "1000", "1e4", "1e6", "grows as", "energy at N = 10",
                          "100", "1000", "1e4", "1e6", "grows as"},
              .rows = {}};
  for (const char* method : {"work", "dopri5", "verner6", "dop853", "fehlberg8", "adams", "esdirk", "bdf"}) {
    std::vector<double> counts = {10.0, 100.0, 1e3, 1e4}, errors, energies;
    if (method == long_runner) counts.push_back(1e6);
    try {
      for (const double count : counts) {
        HardCase hard_case = machine(count);
        hard_case.budget = 600;
        const Result r = hard::single_run(hard_case, method, 1e-7);
        double worst = 0;
        for (const hard::Truth& truth : hard_case.truths) worst = std::max(worst, truth.judge(r).error);
        errors.push_back(worst);
        energies.push_back(r.energy.relative);
      }
    } catch (const std::invalid_argument&) {  // the work equation knows no twist
      continue;
    }
    std::vector<std::string> row = {method};
    for (const std::vector<double>& values : {errors, energies}) {
      for (const double v : values) row.push_back(fmt::format("{:.1e}", v));
      if (values.size() == 4) row.emplace_back("–");
      row.push_back(
          fmt::format("N^{:.2f}", std::log(values.back() / values.front()) / std::log(counts.back() / counts.front())));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table legend(double budget) {
  return {.title =
              "In a family's table a number says at how many accuracies the cell is green; its colour is that of the "
              "worst.",
          .columns = {"cell", "what it says"},
          .rows = {{"green", fmt::format("the right answer, with an error of at most {:g} × (requested accuracy + "
                                         "condition × rounding); or the words that belong to a machine that cannot run",
                                         hard::allowed_ratio)},
                   {"amber", fmt::format("the program says that it reached less than requested, and how much; or "
                                         "that its budget was spent ({:g} s of processor time an integration, more for "
                                         "the heavy cases)",
                                         budget)},
                   {"grey", "the method does not apply; the reasons stand at the end of each family"},
                   {"red", "a wrong answer, or other words than belong there"}},
          .text_columns = 2,
          .tones = {
              {Tone::good, Tone::none}, {Tone::fair, Tone::none}, {Tone::aside, Tone::none}, {Tone::bad, Tone::none}}};
}

// A finer accuracy than one that spent its budget is not tried.
CaseOutcome not_tried(const CaseOutcome& coarser, double accuracy) {
  CaseOutcome out;
  out.verdict = Verdict::unfinished;
  out.asked = accuracy;
  out.words = fmt::format("not tried: the budget was spent at {:.0e}", coarser.asked);
  return out;
}

CaseMatrix run_all(const HardCase& hard_case, double budget) {
  CaseMatrix matrix{&hard_case, {}};
  for (const std::string& method : hard::all_methods()) {
    std::vector<CaseOutcome>& row = matrix.cells.emplace_back();
    const CaseOutcome* spent = nullptr;
    row.reserve(hard::all_accuracies().size());
    for (const double accuracy : hard::all_accuracies()) {
      if (spent) {
        row.push_back(not_tried(*spent, accuracy));
        continue;
      }
      row.push_back(hard::run_case(hard_case, method, accuracy, hard_case.heavy ? hard_case.budget : budget));
      if (row.back().verdict == Verdict::unfinished) spent = &row.back();
      const CaseOutcome& o = row.back();
      if (o.verdict == Verdict::failed || o.verdict == Verdict::unfinished || o.verdict == Verdict::reported)
        std::fprintf(stderr, "%s %s (%s), %s: %s\n", hard_case.family.c_str(), hard_case.name.c_str(),
                     hard_case.parameter.c_str(), method.c_str(), words_of(o).c_str());
    }
  }
  return matrix;
}

}  // namespace

void hard_cases(BenchBook& book, const std::string& only, double budget) {
  std::vector<CaseMatrix> matrices;
  long red = 0, cells = 0;
  for (const HardCase& hard_case : hard::all_cases()) {
    if (!only.empty() && (hard_case.family + "_" + hard_case.name).find(only) == std::string::npos) continue;
    std::fprintf(stderr, "%s %s\n", hard_case.family.c_str(), hard_case.name.c_str());
    matrices.push_back(run_all(hard_case, budget));
    for (const auto& row : matrices.back().cells)
      for (const CaseOutcome& o : row) {
        ++cells;
        red += o.verdict == Verdict::failed;
      }
  }
  book.tables.push_back(summary(matrices));
  if (std::string("LongRun").find(only) == 0) {
    book.tables.push_back(
        growth_of_errors("Growth of errors over N turns of a free slider-crank at local tolerances of 1e-8",
                         hard::free_crank_over, "work"));
    book.tables.push_back(
        growth_of_errors("Growth of errors over N cycles of an undamped chain at local tolerances of 1e-8",
                         hard::undamped_chain_over, "dop853"));
  }
  book.conclusions.push_back(
      red == 0
          ? fmt::format("{} hard cases in {} cells, none red: each ends with the right answer, or says in words how "
                        "far it came or why it cannot go on.",
                        matrices.size(), cells)
          : fmt::format("{} hard cases in {} cells, {} red.", matrices.size(), cells, red));
  book.sections.push_back({.title = "Hard cases: how to read the tables", .cards = {legend(budget)}});
  book.target("hard cases: cells without the right answer or the right words", "0", fmt::format("{} of {}", red, cells),
              red == 0);
  for (const std::string& family : families_of(matrices)) {
    ReportSection section{.title = family};
    section.cards.emplace_back(overview(family, matrices));
    for (const CaseMatrix& m : matrices) {
      if (m.hard_case->family != family) continue;
      std::string truths;
      for (const hard::Truth& truth : m.hard_case->truths) truths += truth.words + "\n";
      if (m.hard_case->condition > 0)
        truths += fmt::format("condition {:.3g}: {}\n", m.hard_case->condition, m.hard_case->condition_words);
      for (const std::string& words : m.hard_case->refusal) truths += "to end with the words \"" + words + "\"\n";
      section.cards.emplace_back(errors_of(m));
      section.cards.emplace_back(cells_of(m));
      section.cards.emplace_back(Text{.title = in_words(m.hard_case->name) + ": how the answer is known; the scene",
                                      .body = truths + "\n" + m.hard_case->scene,
                                      .verbatim = true,
                                      .folded = true});
    }
    if (Table table = exclusions(family, matrices); !table.rows.empty()) section.cards.emplace_back(std::move(table));
    book.sections.push_back(std::move(section));
  }
}

}  // namespace kurbel::bench
