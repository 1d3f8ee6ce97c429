// accuracy_output.cpp — table, JSON, CSV and report of the study of accuracy.
#include "studies/accuracy/accuracy_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/scene/units.h"
#include "studies/accuracy/known_accuracy.h"
#include "studies/accuracy/machine_info.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

std::string error_number(double error) { return std::isnan(error) ? "—" : fmt::format("{:.1e}", error); }
std::string tolerance_of(const MeasuredSetting& s) {
  return s.tolerance > 0 ? fmt::format("{:.0e}", s.tolerance) : "—";
}
std::string milliseconds(double seconds) { return fmt::format("{:.3g}", 1e3 * seconds); }
// "± 4 %": half the range over the median.
std::string spread(const MeasuredSetting& s) {
  return s.repetitions < 2 ? "" : fmt::format("± {:.0f} %", 50 * (s.slowest - s.fastest) / s.seconds);
}
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

// --- terminal ---

std::vector<std::string> setting_columns(const AccuracyStudy& study) {
  std::vector<std::string> columns = {"model", "method", "tolerance", "error of motion"};
  for (const FollowedFigure& f : study.figures) columns.push_back("error of " + f.name);
  for (const char* name : {"total error", "time [ms]", "spread", "steps", "right-hand sides", "Jacobians", "events",
                           "energy drift", "front"})
    columns.push_back(name);
  return columns;
}

std::vector<std::string> setting_row(const AccuracyStudy& study, const MeasuredSetting& s) {
  std::vector<std::string> row = {study.levels[s.level].name, s.method, tolerance_of(s),
                                  error_number(s.trajectory_error)};
  for (const double e : s.numerical_error) row.push_back(error_number(e));
  row.push_back(s.total_error.empty() ? "—" : error_number(s.total_error[study.key]));
  row.push_back(milliseconds(s.seconds));
  row.push_back(spread(s));
  row.push_back(fmt::format("{}", s.steps));
  row.push_back(fmt::format("{}", s.flow_calls));
  row.push_back(fmt::format("{}", s.jacobian_calls));
  row.push_back(fmt::format("{}", s.events));
  row.push_back(error_number(s.energy_drift));
  row.push_back(std::string(s.on_front ? "all" : "") + (s.on_front && s.on_level_front ? ", " : "") +
                (s.on_level_front ? "model" : ""));
  return row;
}

// On a terminal the fronts alone, with the key figure; all settings are in the files.
std::string front_table(const AccuracyStudy& study) {
  std::vector<std::vector<std::string>> rows = {
      {"model", "method", "tolerance", "time [ms]", "error of motion", "numerical error", "total error", "front"}};
  std::vector<const MeasuredSetting*> shown;
  for (const MeasuredSetting& s : study.settings)
    if (s.on_front || s.on_level_front) shown.push_back(&s);
  std::stable_sort(shown.begin(), shown.end(), [](const MeasuredSetting* a, const MeasuredSetting* b) {
    return a->level != b->level ? a->level < b->level : a->seconds < b->seconds;
  });
  for (const MeasuredSetting* s : shown)
    rows.push_back({study.levels[s->level].name, s->method, tolerance_of(*s), milliseconds(s->seconds),
                    error_number(s->trajectory_error), error_number(s->numerical_error[study.key]),
                    error_number(s->total_error[study.key]),
                    s->on_front ? "cheapest of all at its error" : "of its model"});
  return aligned(rows, 2);
}

std::string table_text(const AccuracyStudy& study) {
  std::string text = study.title + "\n";
  for (const std::string& sentence : study.findings) text += "  " + sentence + "\n";
  for (const std::string& answer : study.answers) text += "  " + answer + "\n";
  if (!study.settings.empty() && !study.figures.empty())
    text += fmt::format("\nerrors of {} are relative; settings that no other beats in error and time:\n{}\n",
                        study.figures[study.key].name, front_table(study));
  for (const Omission& o : study.omissions) text += fmt::format("  left out: {}: {}\n", o.what, o.why);
  return text + fmt::format("  {} settings in {:.3g} s of processor time; {}\n", study.settings.size(), study.seconds,
                            machine_info());
}

// --- JSON, CSV ---

Json setting_json(const AccuracyStudy& study, const MeasuredSetting& s) {
  Json j = {{"model", study.levels[s.level].name},
            {"method", s.method},
            {"tolerance", s.tolerance > 0 ? Json(s.tolerance) : Json()},
            {"trajectory_error", number_json(s.trajectory_error)},
            {"seconds", {{"median", s.seconds}, {"fastest", s.fastest}, {"slowest", s.slowest}}},
            {"repetitions", s.repetitions},
            {"steps", s.steps},
            {"rejected", s.rejected},
            {"right_hand_sides", s.flow_calls},
            {"jacobians", s.jacobian_calls},
            {"events", s.events},
            {"energy_drift", number_json(s.energy_drift)},
            {"on_front", s.on_front},
            {"on_front_of_model", s.on_level_front}};
  j["figures"] = Json::array();
  for (std::size_t i = 0; i < study.figures.size(); ++i)
    j["figures"].push_back({{"name", study.figures[i].name},
                            {"numerical_error", number_json(s.numerical_error[i])},
                            {"total_error", number_json(s.total_error[i])}});
  return j;
}

Json study_json(const AccuracyStudy& study) {
  Json j;
  j["title"] = study.title;
  j["scene"] = study.scene_file;
  j["fingerprint"] = fingerprint(study.scene_text);
  j["complete"] = study.complete;
  if (!study.complete) j["diagnosis"] = study.diagnosis;
  j["findings"] = study.findings;
  j["answers"] = study.answers;
  j["key_figure"] = study.figures.empty() ? Json() : Json(study.figures[study.key].name);
  j["models"] = Json::array();
  for (const ModelLevel& level : study.levels) {
    Json m = {{"name", level.name},
              {"effects", level.effects},
              {"coordinates", level.coordinates},
              {"reference",
               {{"methods", {level.first, level.second}},
                {"tolerance", level.tolerance},
                {"agreement_of_motion", number_json(level.agreement)}}}};
    m["figures"] = Json::array();
    for (std::size_t i = 0; i < study.figures.size(); ++i)
      m["figures"].push_back({{"name", study.figures[i].name},
                              {"value", number_json(level.value[i])},
                              {"unit", study.figures[i].unit},
                              {"agreement", number_json(level.floor[i])},
                              {"model_error", number_json(level.model_error[i])}});
    j["models"].push_back(std::move(m));
  }
  j["settings"] = Json::array();
  for (const MeasuredSetting& s : study.settings) j["settings"].push_back(setting_json(study, s));
  j["omissions"] = Json::array();
  for (const Omission& o : study.omissions) j["omissions"].push_back({{"what", o.what}, {"why", o.why}});
  j["machine"] = machine_info();
  j["processor_seconds"] = study.seconds;
  return j;
}

std::string settings_csv(const AccuracyStudy& study) {
  std::string text = "model,method,tolerance,trajectory_error";
  for (const FollowedFigure& f : study.figures) text += fmt::format(",numerical_error.{0},total_error.{0}", f.name);
  text +=
      ",seconds,fastest,slowest,repetitions,steps,rejected,right_hand_sides,jacobians,events,energy_drift,on_front\n";
  const auto cell = [](double v) { return std::isfinite(v) ? fmt::format("{:.6g}", v) : std::string(); };
  for (const MeasuredSetting& s : study.settings) {
    text += fmt::format("\"{}\",{},{},{}", study.levels[s.level].name, s.method, cell(s.tolerance),
                        cell(s.trajectory_error));
    for (std::size_t i = 0; i < study.figures.size(); ++i)
      text += fmt::format(",{},{}", cell(s.numerical_error[i]), cell(s.total_error[i]));
    text += fmt::format(",{},{},{},{},{},{},{},{},{},{},{}\n", cell(s.seconds), cell(s.fastest), cell(s.slowest),
                        s.repetitions, s.steps, s.rejected, s.flow_calls, s.jacobian_calls, s.events,
                        cell(s.energy_drift), s.on_front ? 1 : 0);
  }
  return text;
}

// --- report ---

// Explicit methods solid, implicit ones dashed.
struct Style {
  const char* method;
  Role role;
  bool dashed;
};
constexpr Style styles[] = {{"work", Role::rigid, false},           {"dopri5", Role::sky, false},
                            {"verner6", Role::green, false},        {"dop853", Role::elastic, false},
                            {"fehlberg8", Role::purple, false},     {"adams", Role::orange, false},
                            {"bdf", Role::vermillion, true},        {"esdirk3", Role::green, true},
                            {"esdirk", Role::elastic, true},        {"esdirk5", Role::purple, true},
                            {"RungeKuttaMerson", Role::sky, false}, {"RungeKuttaFeldberg", Role::orange, false},
                            {"CPodes", Role::vermillion, false}};
Style style_of(const std::string& method) {
  for (const Style& s : styles)
    if (method == s.method) return s;
  return {"", Role::reference, false};
}

std::string label_of(const AccuracyStudy& study, const MeasuredSetting& s) {
  return fmt::format("{}: {}, {} steps", study.name_of(s), with_unit(s.seconds, "s", 3), s.steps);
}

// One line per method of a level, loose to tight.
template <class Error>
std::vector<Series> method_series(const AccuracyStudy& study, std::size_t level, Error error) {
  std::vector<Series> all;
  for (const MeasuredSetting& s : study.settings) {
    if (s.level != level || !(error(s) > 0)) continue;
    auto found = std::find_if(all.begin(), all.end(), [&](const Series& x) { return x.name == s.method; });
    if (found == all.end()) {
      const Style style = style_of(s.method);
      all.push_back({.name = s.method, .role = style.role, .x = {}, .y = {}, .dashed = style.dashed, .points = true});
      found = all.end() - 1;
    }
    found->x.push_back(error(s));
    found->y.push_back(1e3 * s.seconds);
    found->labels.push_back(label_of(study, s));
  }
  return all;
}

// The settings of a front, joined in the order of time.
template <class Member, class Error>
Series front_series(const AccuracyStudy& study, Member wanted, Error error) {
  std::vector<const MeasuredSetting*> front;
  for (const MeasuredSetting& s : study.settings)
    if (wanted(s) && error(s) > 0) front.push_back(&s);
  std::sort(front.begin(), front.end(),
            [](const MeasuredSetting* a, const MeasuredSetting* b) { return a->seconds < b->seconds; });
  Series series{.name = "Pareto front", .role = Role::reference, .x = {}, .y = {}, .dashed = true, .points = false};
  for (const MeasuredSetting* s : front) {
    series.x.push_back(error(*s));
    series.y.push_back(1e3 * s->seconds);
    series.labels.push_back(label_of(study, *s));
  }
  return series;
}

Plot work_precision(const AccuracyStudy& study, std::size_t level) {
  const auto error = [](const MeasuredSetting& s) { return s.trajectory_error; };
  const ModelLevel& m = study.levels[level];
  Plot plot{.title = fmt::format("What the motion's accuracy costs, {} model", m.name),
            .x = {"largest error of the motion", "", true},
            .y = {"processor time", "ms", true},
            .series = method_series(study, level, error)};
  plot.series.push_back(front_series(
      study, [&](const MeasuredSetting& s) { return s.level == level && s.on_level_front; }, error));
  plot.note = fmt::format(
      "Angles in rad, speeds and twists over their largest value. {} and {} agree to {:.1e}: nothing "
      "is drawn to the left of that. Solid: explicit; dashed: implicit.",
      m.first, m.second, m.agreement);
  return plot;
}

Plot figure_cost(const AccuracyStudy& study, std::size_t figure) {
  const auto error = [&](const MeasuredSetting& s) { return s.numerical_error[figure]; };
  const ModelLevel& m = study.levels[study.fullest];
  Plot plot{.title = fmt::format("What {} costs, {} model", study.figures[figure].name, m.name),
            .x = {"numerical error", "relative", true},
            .y = {"processor time", "ms", true},
            .series = method_series(study, study.fullest, error)};
  plot.note = fmt::format("Nothing is drawn below {:.1e}, to which the references agree.", m.floor[figure]);
  return plot;
}

constexpr Role level_role(std::size_t level, std::size_t fullest) {
  constexpr Role lean[] = {Role::rigid, Role::green, Role::orange, Role::purple, Role::sky};
  return level == fullest ? Role::elastic : lean[level < fullest ? level : level - fullest + 1];
}

// Every setting by its numerical error and the error of its model: right of the diagonal the numbers are the coarser of
// the two, left of it the model is, and a tighter tolerance buys nothing.
Plot error_plane(const AccuracyStudy& study) {
  const std::size_t k = study.key;
  Plot plot{.title = fmt::format("Error of the model against error of the numbers: {}", study.figures[k].name),
            .x = {"numerical error", "relative", true},
            .y = {"error of the model", "relative", true},
            .series = {}};
  double low = HUGE_VAL, high = 0;
  const double floor = study.levels[study.fullest].floor[k];
  for (std::size_t level = 0; level < study.levels.size(); ++level) {
    const ModelLevel& m = study.levels[level];
    Series series{.name = m.name, .role = level_role(level, study.fullest), .x = {}, .y = {}, .line = false};
    for (const MeasuredSetting& s : study.settings) {
      if (s.level != level || !(s.numerical_error[k] > 0)) continue;
      series.x.push_back(s.numerical_error[k]);
      series.y.push_back(std::max(m.model_error[k], floor));
      series.labels.push_back(label_of(study, s));
      low = std::min({low, series.x.back(), series.y.back()});
      high = std::max({high, series.x.back(), series.y.back()});
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  plot.series.push_back({.name = "numbers as coarse as the model",
                         .role = Role::reference,
                         .x = {low, high},
                         .y = {low, high},
                         .dashed = true});
  plot.note = fmt::format(
      "Above the diagonal the model is coarser than the numbers: a tighter tolerance is wasted there. "
      "The {} model, which the others are judged by, lies at {:.1e}, to which its references agree.",
      study.levels[study.fullest].name, floor);
  return plot;
}

Plot total_cost(const AccuracyStudy& study) {
  const std::size_t k = study.key;
  const auto error = [&](const MeasuredSetting& s) { return s.total_error[k]; };
  Plot plot{.title = fmt::format("What is bought per time, model and numbers together: {}", study.figures[k].name),
            .x = {"total error", "relative", true},
            .y = {"processor time", "ms", true},
            .series = {}};
  for (std::size_t level = 0; level < study.levels.size(); ++level) {
    Series series{
        .name = study.levels[level].name, .role = level_role(level, study.fullest), .x = {}, .y = {}, .line = false};
    for (const MeasuredSetting& s : study.settings) {
      if (s.level != level || !(error(s) > 0)) continue;
      series.x.push_back(error(s));
      series.y.push_back(1e3 * s.seconds);
      series.labels.push_back(label_of(study, s));
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  plot.series.push_back(front_series(
      study, [](const MeasuredSetting& s) { return s.on_front; }, error));
  plot.note = fmt::format("Against the converged {} model.", study.levels[study.fullest].name);
  return plot;
}

Table level_table(const AccuracyStudy& study) {
  Table table{.title = "Models and their references",
              .columns = {"model", "effects", "reference by", "coordinates", "agreement of motion"},
              .rows = {},
              .text_columns = 3};
  for (const FollowedFigure& f : study.figures) {
    table.columns.push_back(fmt::format("{} [{}]", f.name, pretty_unit(f.unit)));
    table.columns.push_back("model error");
  }
  for (const ModelLevel& level : study.levels) {
    std::vector<std::string> row = {level.name, level.effects, fmt::format("{}, {}", level.first, level.second),
                                    fmt::format("{}", level.coordinates), error_number(level.agreement)};
    for (std::size_t i = 0; i < study.figures.size(); ++i) {
      row.push_back(std::isnan(level.value[i])
                        ? "—"
                        : figure_text(level.value[i], level.floor[i] * std::abs(level.value[i])).value);
      row.push_back(std::isnan(level.model_error[i]) ? "—" : fmt::format("{:.2g} %", 100 * level.model_error[i]));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Report report_of(const AccuracyStudy& study) {
  Report report{.title = study.title,
                .subtitle = "What accuracy costs: methods, tolerances and models against converged references",
                .conclusion = study.findings.empty() ? study.diagnosis : study.findings.front() + ".",
                .complete = study.complete};
  report.footer = machine_info() + " · " + report_footer();
  if (study.settings.empty() || study.figures.empty()) return report;
  const ModelLevel& full = study.levels[study.fullest];
  for (std::size_t i = 0; i < std::min<std::size_t>(study.figures.size(), 3); ++i)
    report.figures.push_back({fmt::format("{}, {}", study.figures[i].name, full.name), full.value[i],
                              study.figures[i].unit, full.floor[i] * std::abs(full.value[i])});
  const auto fastest =
      std::min_element(study.settings.begin(), study.settings.end(),
                       [](const MeasuredSetting& a, const MeasuredSetting& b) { return a.seconds < b.seconds; });
  report.figures.push_back({"settings measured",
                            static_cast<double>(study.settings.size()),
                            "",
                            {},
                            fmt::format("the fastest: {}", study.name_of(*fastest)),
                            4});

  ReportSection& words = report.add("What it means");
  std::string text;
  for (const std::string& sentence : study.findings) text += sentence + ".\n";
  for (const std::string& answer : study.answers) text += answer + ".\n";
  words.cards.push_back(Text{.title = "", .body = text});

  ReportSection& plane = report.add("Model and numbers");
  plane.cards.push_back(total_cost(study));
  if (study.levels.size() > 1) plane.cards.push_back(error_plane(study));
  ReportSection& motion = report.add("The motion");
  for (std::size_t level = 0; level < study.levels.size(); ++level)
    if (std::count_if(study.settings.begin(), study.settings.end(),
                      [&](const MeasuredSetting& s) { return s.level == level; }) > 1)
      motion.cards.push_back(work_precision(study, level));
  ReportSection& figures = report.add("The figures");
  for (std::size_t i = 0; i < std::min<std::size_t>(study.figures.size(), 4); ++i)
    figures.cards.push_back(figure_cost(study, i));

  ReportSection& numbers = report.add("Numbers");
  numbers.cards.push_back(level_table(study));
  Table table{
      .title = "Every setting", .columns = setting_columns(study), .rows = {}, .folded = true, .text_columns = 2};
  for (const MeasuredSetting& s : study.settings) table.rows.push_back(setting_row(study, s));
  numbers.cards.push_back(std::move(table));

  ReportSection& left_out = report.add("Left out");
  Table omissions{.title = "", .columns = {"what", "why"}, .rows = {}, .text_columns = 2};
  for (const Omission& o : study.omissions) omissions.rows.push_back({o.what, o.why});
  if (!omissions.rows.empty()) left_out.cards.push_back(std::move(omissions));
  left_out.cards.push_back(Text{
      .title = "How it was measured",
      .body = fmt::format(
          "Time is processor time of the integration with its peaks and cycles found, without samples for plots and "
          "without the energy audit: median of up to nine runs in one process. Tables of the work equation are made "
          "beforehand. Numerical errors are against the model's own reference, by two methods at a tolerance of "
          "{:.0e}; "
          "total errors against the reference of the {} model. The whole study took {:.3g} s.",
          full.tolerance, full.name, study.seconds)});
  return report;
}

}  // namespace

StudyOutput output_of(const AccuracyStudy& study) {
  const std::string conclusion = study.answers.empty()
                                     ? (study.findings.empty() ? study.diagnosis : study.findings.front())
                                     : study.answers.front();
  return {conclusion,
          table_text(study),
          json_text(study_json(study)),
          [&study] { return report_of(study); },
          {{"settings.csv", [&study] { return settings_csv(study); }}},
          study.complete,
          study.diagnosis};
}

}  // namespace kurbel
