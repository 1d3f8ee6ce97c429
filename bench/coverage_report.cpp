// coverage_report.cpp — what a campaign found: tables, a picture, the worst misses with their scenes, targets.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bench/coverage.h"
#include "tests/coverage/statistics.h"
#include "tests/coverage/variant.h"

namespace kurbel::bench {
namespace {

using coverage::JudgedFigure;
using coverage::MeasuredVariant;
using coverage::Miss;
using coverage::Share;
using coverage::Verdict;
using Variants = std::vector<MeasuredVariant>;

constexpr double wanted_overall = 0.995, wanted_each = 0.98;
constexpr double wanted_median = 50, wanted_q90 = 1000, wanted_unconfirmed = 0.01, wanted_cost = 2;
constexpr std::size_t misses_shown = 40, scenes_shown = 8;

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }

Tone tone_of(const Share& share) {
  if (share.judged == 0) return Tone::aside;
  return share.share() >= wanted_each ? Tone::good : share.share() >= 0.95 ? Tone::fair : Tone::bad;
}

Verdict verdict_by_two(const JudgedFigure& f) { return f.by_two; }

// One row of a table of shares: a name, and whose figures.
std::vector<std::string> row_of(const std::string& name, const Variants& all, const coverage::OfRun& run,
                                const coverage::OfFigure& figure, Tone& tone) {
  const Share now = coverage::share_of(all, run, figure), two = coverage::share_of(all, run, figure, verdict_by_two);
  tone = tone_of(now);
  return {name,
          std::to_string(now.runs),
          std::to_string(now.judged),
          std::to_string(now.judged - now.covered),
          now.judged ? percent(now.share()) : "–",
          now.judged ? percent(now.lower) : "–",
          two.judged ? percent(two.share()) : "–"};
}

struct Group {
  std::string name;
  coverage::OfRun run = coverage::every_run;
  coverage::OfFigure figure = coverage::every_figure;
};

Table shares(const std::string& title, const std::string& what, const Variants& all, const std::vector<Group>& groups,
             bool folded = false) {
  Table table{.title = title,
              .columns = {what, "runs", "figures", "missed", "covered", "lower 95 % bound", "by two runs"},
              .rows = {},
              .folded = folded};
  for (const Group& group : groups) {
    Tone tone = Tone::none;
    table.rows.push_back(row_of(group.name, all, group.run, group.figure, tone));
    std::vector<Tone> tones(table.columns.size(), Tone::none);
    tones[4] = tone;
    table.tones.push_back(std::move(tones));
  }
  return table;
}

Group of_method(const std::string& method) {
  return {method, [method](const MeasuredVariant& v) { return v.method == method; }};
}
Group of_accuracy(double accuracy) {
  return {fmt::format("{:.0e}", accuracy),
          [accuracy](const MeasuredVariant& v) { return std::abs(v.accuracy / accuracy - 1) < 1e-6; }};
}

template <class T, class Make>
std::vector<Group> groups_of(const std::vector<T>& keys, Make make) {
  std::vector<Group> groups;
  for (const T& key : keys) groups.push_back(make(key));
  return groups;
}

std::vector<Group> families(const Variants& all) {
  std::set<std::string> names;
  for (const MeasuredVariant& v : all)
    for (const JudgedFigure& f : v.figures)
      if (coverage::every_figure(f)) names.insert(f.family());
  std::vector<Group> groups;
  for (const std::string& name : names)
    groups.push_back({name, coverage::every_run,
                      [name](const JudgedFigure& f) { return coverage::every_figure(f) && f.family() == name; }});
  return groups;
}

// Times of located figures, by family, and those of events.
Table times(const Variants& all) {
  std::set<std::string> names;
  const auto what = [](const JudgedFigure& f) {
    const std::size_t family = f.name.find('.') + 1;
    return f.name.starts_with("event.") ? std::string("events")
                                        : f.name.substr(family, f.name.find('.', family) - family);
  };
  for (const MeasuredVariant& v : all)
    for (const JudgedFigure& f : v.figures)
      if (coverage::every_time(f)) names.insert(what(f));
  std::vector<Group> groups = {{"all", coverage::every_run, coverage::every_time}};
  for (const std::string& name : names)
    groups.push_back({name, coverage::every_run,
                      [name, what](const JudgedFigure& f) { return coverage::every_time(f) && what(f) == name; }});
  return shares("Times that are stated with their errors", "time of", all, groups, true);
}

std::vector<Group> scenes(const Variants& all) {
  std::set<std::string> names;
  for (const MeasuredVariant& v : all) names.insert(v.scene);
  std::vector<Group> groups;
  for (const std::string& name : names)
    groups.push_back({name, [name](const MeasuredVariant& v) { return v.scene == name; }});
  return groups;
}

Table matrix(const Variants& all) {
  Table table{.title = "Covered, in percent: method by requested accuracy", .columns = {"method"}, .rows = {}};
  for (const double accuracy : coverage::accuracies()) table.columns.push_back(fmt::format("{:.0e}", accuracy));
  for (const std::string& method : coverage::methods()) {
    std::vector<std::string> row = {method};
    std::vector<Tone> tones = {Tone::none};
    for (const double accuracy : coverage::accuracies()) {
      const Group a = of_accuracy(accuracy);
      const Share s = coverage::share_of(all, [&](const MeasuredVariant& v) { return v.method == method && a.run(v); });
      row.push_back(s.judged ? fmt::format("{:.1f}", 100 * s.share()) : "–");
      tones.push_back(tone_of(s));
    }
    table.rows.push_back(std::move(row));
    table.tones.push_back(std::move(tones));
  }
  return table;
}

Plot histogram(const std::vector<double>& ratios) {
  constexpr int low = -4, high = 8, a_decade = 4;
  std::vector<double> counts((high - low) * a_decade, 0);
  for (const double ratio : ratios) {
    const double place = ratio > 0 ? (std::log10(ratio) - low) * a_decade : 0;
    const auto bin = std::clamp(std::floor(place), 0.0, static_cast<double>(counts.size() - 1));
    counts[static_cast<std::size_t>(bin)] += 100.0 / static_cast<double>(ratios.size());
  }
  Series missed{.name = "missed", .role = Role::vermillion, .x = {}, .y = {}},
      covered{.name = "covered", .role = Role::elastic, .x = {}, .y = {}};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double middle = low + (static_cast<double>(k) + 0.5) / a_decade;
    Series& series = middle < 0 ? missed : covered;
    series.x.push_back(middle);
    series.y.push_back(counts[k]);
  }
  return {.title = "How much larger the stated errors are than the true ones",
          .x = {"log₁₀ of stated over true error"},
          .y = {"share of figures", "%"},
          .series = {covered, missed},
          .marks = {{0, "stated = true"}},
          .note =
              "Left of 0 the stated error is too small. A true error that hides in the uncertainty of the "
              "references counts as that uncertainty.",
          .bars = true};
}

Table worst_misses(const std::vector<Miss>& misses) {
  Table table{.title = fmt::format("Worst of {} misses", misses.size()),
              .columns = {"scene", "method", "figure", "seed", "accuracy", "value", "stated", "true error",
                          "true/stated", "over its scale"},
              .rows = {},
              .text_columns = 3};
  for (std::size_t k = 0; k < std::min(misses.size(), misses_shown); ++k) {
    const MeasuredVariant& v = *misses[k].variant;
    const JudgedFigure& f = *misses[k].figure;
    table.rows.push_back({v.scene, v.method, f.name, std::to_string(v.seed), fmt::format("{:.0e}", v.accuracy),
                          fmt::format("{:.6g} {}", f.value, f.unit), fmt::format("{:.1e}", f.stated),
                          fmt::format("{:.1e}", f.error()), fmt::format("{:.3g}", misses[k].factor()),
                          f.scale > 0 ? fmt::format("{:.1e}", f.error() / f.scale) : "–"});
  }
  return table;
}

// Where the references contradict each other most: a machine that rounding decides, or a fault that a start one cycle
// on or another method brings to light.
Table disputed_truths(const Variants& all) {
  struct Dispute {
    double relative;
    const MeasuredVariant* variant;
    const JudgedFigure* figure;
  };
  std::vector<Dispute> worst;
  for (const MeasuredVariant& v : all) {
    Dispute most{0, &v, nullptr};
    for (const JudgedFigure& f : v.figures)
      if (const double relative = f.uncertainty / f.scale;
          coverage::every_figure(f) && f.scale > 0 && f.verdict == Verdict::uncertain && relative > most.relative)
        most = {relative, &v, &f};
    if (most.figure) worst.push_back(most);
  }
  std::sort(worst.begin(), worst.end(), [](const Dispute& a, const Dispute& b) { return a.relative > b.relative; });
  Table table{.title = "Where the references contradict each other most: the worst figure of each run",
              .columns = {"scene", "method", "figure", "seed", "accuracy", "value", "stated", "references differ by",
                          "over its scale"},
              .rows = {},
              .folded = true,
              .text_columns = 3};
  for (std::size_t k = 0; k < std::min(worst.size(), misses_shown); ++k) {
    const auto& [relative, v, f] = worst[k];
    table.rows.push_back({v->scene, v->method, f->name, std::to_string(v->seed), fmt::format("{:.0e}", v->accuracy),
                          fmt::format("{:.6g} {}", f->value, f->unit), fmt::format("{:.1e}", f->stated),
                          fmt::format("{:.1e}", f->uncertainty), fmt::format("{:.1e}", relative)});
  }
  return table;
}

// Measurement and its predecessor, in evaluations of the right-hand side.
struct Cost {
  double now = 0, two = 0, logarithms = 0;
  long runs = 0;
  double of_sums() const { return two > 0 ? now / two : 0; }
  double mean() const { return runs > 0 ? std::exp(logarithms / static_cast<double>(runs)) : 0; }
};
Cost cost_of(const Variants& all, const coverage::OfRun& run) {
  Cost cost;
  for (const MeasuredVariant& v : all) {
    if (!v.whole || v.flow_calls_of_two <= 0 || v.flow_calls <= 0 || !run(v)) continue;
    const auto now = static_cast<double>(v.flow_calls), two = static_cast<double>(v.flow_calls_of_two);
    cost.now += now;
    cost.two += two;
    cost.logarithms += std::log(now / two);
    ++cost.runs;
  }
  return cost;
}
Table costs(const Variants& all) {
  Table table{.title = "Evaluations of the right-hand side, over those of two runs at tolerances 30 apart",
              .columns = {"method", "runs", "mean ratio", "ratio of sums", "unconfirmed"},
              .rows = {}};
  std::vector<Group> groups = groups_of(coverage::methods(), of_method);
  groups.insert(groups.begin(), {"all", coverage::every_run});
  for (const Group& group : groups) {
    const Cost cost = cost_of(all, group.run);
    const auto unconfirmed = std::count_if(
        all.begin(), all.end(), [&](const MeasuredVariant& v) { return v.whole && !v.confirmed && group.run(v); });
    const auto ratio = [&](double value) { return cost.runs > 0 ? fmt::format("{:.2f}", value) : std::string("–"); };
    table.rows.push_back({group.name, std::to_string(cost.runs), ratio(cost.mean()), ratio(cost.of_sums()),
                          std::to_string(unconfirmed)});
  }
  return table;
}

std::string without_numbers(const std::string& words) {
  std::string kind;
  for (const char c : words.substr(0, 140)) {
    const bool digit = (c >= '0' && c <= '9') || (c == '.' && kind.ends_with('#'));
    if (!digit || !kind.ends_with('#')) kind += digit ? '#' : c;
  }
  return kind;
}
Table reasons(const std::string& title, const std::map<std::string, long>& count) {
  Table table{.title = title, .columns = {"reason", "times"}, .rows = {}, .folded = true};
  std::vector<std::pair<long, std::string>> sorted;
  for (const auto& [reason, times] : count) sorted.emplace_back(-times, reason);
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [times, reason] : sorted) table.rows.push_back({reason, std::to_string(-times)});
  return table;
}

// What was measured, and what was set apart.
struct Counts {
  long whole = 0, finished = 0, unconfirmed = 0;
  std::map<Verdict, long> figures;
  long impacts = 0, impacts_right = 0, uncertain_runs = 0;
  std::map<std::string, long> ended, doubted, refused;
  double uncertain_share() const {
    double all = 0;
    for (const auto& [verdict, n] : figures) all += static_cast<double>(n);
    const auto found = figures.find(Verdict::uncertain);
    return found == figures.end() ? 0 : static_cast<double>(found->second) / all;
  }
};
Counts count(const Variants& all) {
  Counts c;
  for (const MeasuredVariant& v : all) {
    for (const auto& [reason, times] : v.refused) c.refused[reason] += times;
    // A run that came to its end without a second opinion was not confirmed, either; one whose budget here was spent
    // says nothing.
    const bool without_errors =
        v.words.starts_with(coverage::no_errors) && v.words.find("processor time is spent") == std::string::npos;
    c.finished += v.whole || without_errors;
    c.unconfirmed += (v.whole && !v.confirmed) || without_errors;
    if (v.whole && !v.confirmed) ++c.doubted[without_numbers(v.words)];
    if (!v.whole) {
      ++c.ended[without_numbers(v.words)];
      continue;
    }
    ++c.whole;
    bool uncertain = false;
    for (const JudgedFigure& f : v.figures) {
      if (f.kind == JudgedFigure::Kind::time) continue;
      if (f.kind == JudgedFigure::Kind::count) {
        ++c.impacts;
        c.impacts_right += f.value == f.truth || f.verdict == Verdict::covered;
        continue;
      }
      ++c.figures[f.verdict];
      uncertain = uncertain || f.verdict == Verdict::uncertain;
    }
    c.uncertain_runs += uncertain;
  }
  return c;
}
Table counts_table(const Variants& all, const Counts& c) {
  Table table{.title = "What was measured", .columns = {"what", "number"}, .rows = {}};
  const auto add = [&](const std::string& what, long n) { table.rows.push_back({what, std::to_string(n)}); };
  long draws = 0;
  for (const auto& [reason, times] : c.refused) draws += times;
  add("variants", static_cast<long>(all.size()));
  add("measured and judged", c.whole);
  add("ended otherwise (reasons below)", static_cast<long>(all.size()) - c.whole);
  add("draws refused by reader, compiler or method, and drawn again", draws);
  for (const Verdict v : {Verdict::covered, Verdict::missed, Verdict::uncertain, Verdict::unstated, Verdict::unknown}) {
    const auto found = c.figures.find(v);
    add(fmt::format("figures {}", name_of(v)), found == c.figures.end() ? 0 : found->second);
  }
  add("runs with a figure whose truth is uncertain", c.uncertain_runs);
  add("numbers of impacts, judged apart", c.impacts);
  add("of them within what was stated", c.impacts_right);
  return table;
}

// The worst of several groups.
std::pair<double, std::string> least_share(const Variants& all, const std::vector<Group>& groups) {
  std::pair<double, std::string> least = {1, "none"};
  for (const Group& group : groups)
    if (const Share s = coverage::share_of(all, group.run); s.judged > 0 && s.share() < least.first)
      least = {s.share(), group.name};
  return least;
}

void add_targets(BenchBook& book, const Variants& all, const Share& overall, const Counts& c,
                 const std::vector<double>& ratios) {
  const auto method = least_share(all, groups_of(coverage::methods(), of_method));
  const auto accuracy = least_share(all, groups_of(coverage::accuracies(), of_accuracy));
  const double median = coverage::quantile(ratios, 0.5), q90 = coverage::quantile(ratios, 0.9);
  const double unconfirmed = c.finished ? static_cast<double>(c.unconfirmed) / static_cast<double>(c.finished) : 0;
  const Cost cost = cost_of(all, coverage::every_run);
  book.target("coverage: figures whose stated error covers, lower 95 % bound", "≥ 99.5 %",
              fmt::format("{} ({} of them)", percent(overall.lower), percent(overall.share())),
              overall.lower >= wanted_overall);
  book.target("coverage: with every method", "≥ 98 %", fmt::format("{} ({})", percent(method.first), method.second),
              method.first >= wanted_each);
  book.target("coverage: at every accuracy 1e-2 … 1e-9", "≥ 98 %",
              fmt::format("{} ({})", percent(accuracy.first), accuracy.second), accuracy.first >= wanted_each);
  book.target("coverage: median of stated over true error", "≤ 50", fmt::format("{:.3g}", median),
              median <= wanted_median);
  book.target("coverage: 90 % quantile of stated over true error", "≤ 1000", fmt::format("{:.3g}", q90),
              q90 <= wanted_q90);
  book.target("coverage: runs that were not confirmed", "≤ 1 %", percent(unconfirmed),
              unconfirmed <= wanted_unconfirmed);
  book.target("coverage: evaluations over those of two runs", "≤ 2",
              fmt::format("{:.2f} on average, {:.2f} in sum", cost.mean(), cost.of_sums()), cost.mean() <= wanted_cost);
}

// Scenes of the worst misses, each once.
void add_scenes(ReportSection& section, const std::vector<Miss>& misses) {
  std::set<std::pair<std::string, std::uint64_t>> shown;
  for (const Miss& miss : misses) {
    const MeasuredVariant& v = *miss.variant;
    if (shown.size() == scenes_shown) return;
    if (!shown.insert({v.scene, v.seed}).second) continue;
    section.cards.emplace_back(Text{.title = fmt::format("{}, seed {}: {} misses by {:.3g}; the scene", v.scene, v.seed,
                                                         miss.figure->name, miss.factor()),
                                    .body = coverage::make_variant(v.scene, v.seed).text,
                                    .verbatim = true,
                                    .folded = true});
  }
}

}  // namespace

void report_coverage(BenchBook& book, const Variants& all) {
  const Share overall = coverage::share_of(all),
              two = coverage::share_of(all, coverage::every_run, coverage::every_figure, verdict_by_two);
  const Counts c = count(all);
  const std::vector<double> ratios = coverage::ratios_of(all);
  const std::vector<Miss> misses = coverage::misses_of(all);
  book.conclusions.push_back(fmt::format(
      "{} of {} stated errors cover the true one in {} variants of {} scenes (at least {} with 95 % certainty; two "
      "runs "
      "at tolerances 30 apart: {}); the median stated error is {:.3g} × the true one; {} of figures have a truth too "
      "uncertain to judge them.",
      percent(overall.share()), overall.judged, c.whole, scenes(all).size(), percent(overall.lower),
      percent(two.share()), coverage::quantile(ratios, 0.5), percent(c.uncertain_share())));
  add_targets(book, all, overall, c, ratios);
  ReportSection section{.title = "Do stated errors cover the true ones?"};
  section.cards.emplace_back(histogram(ratios));
  section.cards.emplace_back(shares("By method", "method", all, groups_of(coverage::methods(), of_method)));
  section.cards.emplace_back(shares("By accuracy", "accuracy", all, groups_of(coverage::accuracies(), of_accuracy)));
  section.cards.emplace_back(shares("By what the program says of its run", "run", all,
                                    {{"confirmed", [](const MeasuredVariant& v) { return v.confirmed; }},
                                     {"not confirmed", [](const MeasuredVariant& v) { return !v.confirmed; }}}));
  section.cards.emplace_back(shares("By family of figures", "figure", all, families(all), true));
  section.cards.emplace_back(times(all));
  section.cards.emplace_back(shares("By scene", "scene", all, scenes(all), true));
  section.cards.emplace_back(costs(all));
  section.cards.emplace_back(reasons("How variants ended that were not judged", c.ended));
  section.cards.emplace_back(reasons("Why runs were not confirmed", c.doubted));
  section.cards.emplace_back(reasons("Why draws were refused", c.refused));
  book.tables.insert(book.tables.end(), {matrix(all), counts_table(all, c)});
  ReportSection worst{.title = "Where they do not"};
  worst.cards.emplace_back(worst_misses(misses));
  worst.cards.emplace_back(disputed_truths(all));
  add_scenes(worst, misses);
  book.sections.push_back(std::move(section));
  book.sections.push_back(std::move(worst));
}

}  // namespace kurbel::bench
