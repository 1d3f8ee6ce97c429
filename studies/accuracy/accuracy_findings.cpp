// accuracy_findings.cpp — words and tables of the study of accuracy.
#include "studies/accuracy/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/units.h"
#include "studies/accuracy/accuracy_plots.h"
#include "studies/accuracy/known_accuracy.h"
#include "studies/accuracy/machine_info.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

std::string error_number(double error) { return std::isnan(error) ? "—" : fmt::format("{:.1e}", error); }
std::string tolerance_text(double tolerance) { return tolerance > 0 ? fmt::format("{:.0e}", tolerance) : "—"; }
std::string milliseconds(double seconds) { return fmt::format("{:.3g}", 1e3 * seconds); }
// "± 4 %": half the range over the median.
std::string spread(const MeasuredSetting& s) {
  return s.repetitions < 2 ? "" : fmt::format("± {:.0f} %", 50 * (s.slowest - s.fastest) / s.seconds);
}

std::string front_text(const MeasuredSetting& s) {
  return std::string(s.on_front ? "all" : "") + (s.on_front && s.on_level_front ? ", " : "") +
         (s.on_level_front ? "model" : "");
}

// --- tables ---

Rows settings_table(const AccuracyStudy& study) {
  using S = const MeasuredSetting&;
  auto table = table_of("settings", "Every setting", study.settings).not_on_terminal().fold().text_in(2).always();
  table.column("model", "model", [&](S s) { return study.levels[s.level].name; })
      .in_file("model", {}, [&](S s) { return fmt::format("\"{}\"", study.levels[s.level].name); })
      .column("method", "method", &MeasuredSetting::method)
      .also_in_file()
      .only_for_programs("tolerance", [](S s) { return s.tolerance > 0 ? Value(s.tolerance) : Value(); })
      .in_file("tolerance", {}, &MeasuredSetting::tolerance, 6)
      .only_for_people("tolerance", &MeasuredSetting::tolerance, tolerance_text)
      .column("trajectory_error", "error of motion", &MeasuredSetting::trajectory_error, error_number)
      .also_in_file({}, 6);
  for (std::size_t i = 0; i < study.figures.size(); ++i) {
    const std::string& name = study.figures[i].name;
    table.only_for_people("error of " + name, [i](S s) { return error_number(s.numerical_error[i]); });
    table.in_file(
        "numerical_error." + name, {}, [i](S s) { return s.numerical_error[i]; }, 6);
    table.in_file(
        "total_error." + name, {}, [i](S s) { return s.total_error[i]; }, 6);
  }
  return table
      .only_for_people("total error",
                       [&](S s) { return s.total_error.empty() ? "—" : error_number(s.total_error[study.key]); })
      .only_for_people("time [ms]", &MeasuredSetting::seconds, milliseconds)
      .only_for_people("spread", spread)
      .only_for_programs("seconds",
                         [](S s) {
                           return Record{{"median", s.seconds}, {"fastest", s.fastest}, {"slowest", s.slowest}};
                         })
      .in_file("seconds", {}, &MeasuredSetting::seconds, 6)
      .in_file("fastest", {}, &MeasuredSetting::fastest, 6)
      .in_file("slowest", {}, &MeasuredSetting::slowest, 6)
      .only_for_programs("repetitions", &MeasuredSetting::repetitions)
      .also_in_file()
      .column("steps", "steps", &MeasuredSetting::steps)
      .also_in_file()
      .only_for_programs("rejected", &MeasuredSetting::rejected)
      .also_in_file()
      .column("right_hand_sides", "right-hand sides", &MeasuredSetting::flow_calls)
      .also_in_file()
      .column("jacobians", "Jacobians", &MeasuredSetting::jacobian_calls)
      .also_in_file()
      .column("events", "events", &MeasuredSetting::events)
      .also_in_file()
      .column("energy_drift", "energy drift", &MeasuredSetting::energy_drift, error_number)
      .also_in_file({}, 6)
      .only_for_programs("on_front", &MeasuredSetting::on_front)
      .also_in_file()
      .only_for_programs("on_front_of_model", &MeasuredSetting::on_level_front)
      .only_for_people("front", front_text)
      .only_for_programs("figures", [&](S s) {
        return each(numbers_below(study.figures.size()), [&](std::size_t i) {
          return Record{{"name", study.figures[i].name},
                        {"numerical_error", s.numerical_error[i]},
                        {"total_error", s.total_error[i]}};
        });
      });
}

// On a terminal only the fronts, with the key figure; all settings are in the files.
Rows front_table(const AccuracyStudy& study) {
  std::vector<const MeasuredSetting*> shown;
  for (const MeasuredSetting& s : study.settings)
    if (s.on_front || s.on_level_front) shown.push_back(&s);
  std::stable_sort(shown.begin(), shown.end(), [](const MeasuredSetting* a, const MeasuredSetting* b) {
    return a->level != b->level ? a->level < b->level : a->seconds < b->seconds;
  });
  using S = const MeasuredSetting*;
  return table_of("", "", std::move(shown))
      .headed(fmt::format("errors of {} are relative; settings that no other beats in error and time:",
                          study.figures[study.key].name))
      .text_in(2)
      .always()
      .not_on_page()
      .only_for_people("model", [&](S s) { return study.levels[s->level].name; })
      .only_for_people("method", &MeasuredSetting::method)
      .only_for_people("tolerance", &MeasuredSetting::tolerance, tolerance_text)
      .only_for_people("time [ms]", &MeasuredSetting::seconds, milliseconds)
      .only_for_people("error of motion", &MeasuredSetting::trajectory_error, error_number)
      .only_for_people("numerical error", [&](S s) { return error_number(s->numerical_error[study.key]); })
      .only_for_people("total error", [&](S s) { return error_number(s->total_error[study.key]); })
      .only_for_people("front", [](S s) { return s->on_front ? "cheapest of all at its error" : "of its model"; });
}

std::string rung_time(const ModelLevel& m) { return std::isnan(m.seconds) ? "—" : milliseconds(m.seconds); }

// On a terminal the series of models with error and cost of each.
Rows rung_table(const AccuracyStudy& study) {
  using L = const ModelLevel&;
  const std::size_t rungs = std::min(study.fullest + 1, study.levels.size());
  return table_of("", "", std::vector<ModelLevel>(study.levels.begin(), study.levels.begin() + std::ptrdiff_t(rungs)))
      .headed(fmt::format("models, each with one effect more; error of {} against the last, time of the cheapest "
                          "run within {:g} % of its own:",
                          study.figures[study.key].name, 100 * close_enough))
      .text_in(2)
      .always()
      .not_on_page()
      .only_for_people("model", &ModelLevel::name)
      .only_for_people("effects", &ModelLevel::effects)
      .only_for_people("error",
                       [&](L m) {
                         const double error = m.model_error[study.key];
                         return std::isnan(error) ? "—" : fmt::format("{:.2g} %", 100 * error);
                       })
      .only_for_people("time [ms]", rung_time);
}

Rows level_table(const AccuracyStudy& study) {
  using L = const ModelLevel&;
  auto table = table_of("models", "Models and their references", study.levels).not_on_terminal().text_in(3).always();
  table.column("name", "model", &ModelLevel::name)
      .column("effects", "effects", &ModelLevel::effects)
      .only_for_people("reference by", [](L m) { return fmt::format("{}, {}", m.first, m.second); })
      .column("coordinates", "coordinates", &ModelLevel::coordinates)
      .only_for_people("agreement of motion", &ModelLevel::agreement, error_number)
      .only_for_programs("reference",
                         [](L m) {
                           return Record{{"methods", List{m.first, m.second}},
                                         {"tolerance", m.tolerance},
                                         {"agreement_of_motion", m.agreement}};
                         })
      .only_for_people("time [ms]", rung_time)
      .only_for_programs("seconds", &ModelLevel::seconds)
      .only_for_programs("figures", [&](L m) {
        return each(numbers_below(study.figures.size()), [&](std::size_t i) {
          return Record{{"name", study.figures[i].name},
                        {"value", m.value[i]},
                        {"unit", study.figures[i].unit},
                        {"agreement", m.floor[i]},
                        {"model_error", m.model_error[i]}};
        });
      });
  for (std::size_t i = 0; i < study.figures.size(); ++i) {
    const std::string& si = study.figures[i].unit;
    const auto cells = [&study, &si, i](L m) {
      return figure_cells({m.value[i], m.floor[i] * std::abs(m.value[i])}, si, study.speed_unit);
    };
    const std::string unit = si == "rad/s" ? study.speed_unit.name : pretty_unit(si);
    table
        .only_for_people(study.figures[i].name + (unit.empty() ? "" : fmt::format(" [{}]", unit)),
                         [i, &cells](L m) { return std::isnan(m.value[i]) ? "—" : cells(m).value; })
        .only_for_people("model error", [i](L m) {
          return std::isnan(m.model_error[i]) ? "—" : fmt::format("{:.2g} %", 100 * m.model_error[i]);
        });
  }
  return table;
}

Rows omission_table(const AccuracyStudy& study) {
  return table_of("omissions", "", study.omissions)
      .not_on_terminal()
      .text_in(2)
      .column("what", "what", &Omission::what)
      .column("why", "why", &Omission::why);
}

// --- all of it ---

void add_key_figures(Findings& f, const AccuracyStudy& study) {
  const ModelLevel& full = study.levels[study.fullest];
  for (std::size_t i = 0; i < std::min<std::size_t>(study.figures.size(), 3); ++i) {
    const FollowedFigure& figure = study.figures[i];
    const bool speed = figure.unit == "rad/s";
    const double value = speed ? study.speed_unit.of(full.value[i]) : full.value[i];
    f.figures.push_back({Estimate{value, full.floor[i] * std::abs(value)},
                         fmt::format("{}, {}", figure.name, full.name), speed ? study.speed_unit.name : figure.unit, "",
                         0, figure.name});
  }
  const auto fastest =
      std::min_element(study.settings.begin(), study.settings.end(),
                       [](const MeasuredSetting& a, const MeasuredSetting& b) { return a.seconds < b.seconds; });
  f.key("settings measured", {static_cast<double>(study.settings.size())}, "settings_measured",
        fmt::format("the fastest: {}", study.name_of(*fastest)), 4);
}

const std::string& conclusion_of(const AccuracyStudy& study) {
  return !study.answers.empty()    ? study.answers.front()
         : !study.findings.empty() ? study.findings.front()
                                   : study.diagnosis;
}

Text how_measured(const AccuracyStudy& study) {
  const ModelLevel& full = study.levels[study.fullest];
  return {
      .title = "How it was measured",
      .body = fmt::format(
          "Time is processor time of the integration with its peaks and cycles found, without samples for plots and "
          "without the energy audit: median of up to nine runs in one process. Tables of the work equation are made "
          "beforehand. Numerical errors are against the model's own reference, by two methods at a tolerance of "
          "{:.0e}; total errors against the reference of the {}. A model's time is that of its cheapest setting whose "
          "numbers are within {:g} % of its own {}. Models between the rigid one, those elastic, and the scene's own "
          "are run by the methods of their references alone, unless methods are named. The whole study took {:.3g} s.",
          full.tolerance, full.called, 100 * close_enough, study.figures[study.key].name, study.seconds)};
}

// Plots and tables of the measured settings on the page.
void show_measured(Findings& f, const AccuracyStudy& study) {
  const Chapter words = f.chapter("What it means"), plane = f.chapter("Model and numbers"),
                motion = f.chapter("The motion"), figures = f.chapter("The figures"), numbers = f.chapter("Numbers"),
                omitted = f.chapter("Omitted");
  std::vector<std::string> sentences;
  for (const auto* list : {&study.findings, &study.answers})
    for (const std::string& sentence : *list)
      if (sentence != conclusion_of(study)) sentences.push_back(sentence + ".");
  f.say(words, Sentences{.lines = sentences, .terminal = false});
  f.draw(plane, [&study] { return total_plots(study); });
  f.draw(motion, [&study] { return motion_cost_plots(study); });
  f.draw(figures, [&study] { return figure_cost_plots(study); });
  f.say(numbers, level_table(study));
  f.say(numbers, settings_table(study));
  f.say(omitted, omission_table(study));
  f.show(omitted, how_measured(study));
}

}  // namespace

Findings findings_of(const AccuracyStudy& study) {
  Findings f = Findings::of(study, "What accuracy costs: methods, tolerances and models against converged references");
  f.opening = Findings::Opening::title_and_conclusion, f.footer = machine_info() + " · " + report_footer();
  f.conclude(study.complete, conclusion_of(study));
  const bool measured = !study.settings.empty() && !study.figures.empty();
  const Chapter terminal = f.chapter("");  // nothing of it on the page
  const auto say = [&](Sentences words) {
    words.page = false;
    f.say(terminal, std::move(words));
  };
  f.record("fingerprint", fingerprint(study.scene_text));
  for (const auto& [list, key] : {std::pair(&study.findings, "findings"), std::pair(&study.answers, "answers")}) {
    std::vector<std::string> further;  // the conclusion has been said
    for (const std::string& sentence : *list)
      if (sentence != conclusion_of(study)) further.push_back(sentence);
    say({.lines = std::move(further), .indent = "  "});
    f.record(key, *list);
  }
  f.record("key_figure", study.figures.empty() ? Value() : Value(study.figures[study.key].name));
  if (measured) {
    f.say(terminal, rung_table(study));
    f.say(terminal, front_table(study));
    say({.lines = {""}});
    add_key_figures(f, study);
    show_measured(f, study);
  } else {
    f.record("models", level_table(study).list());
    f.record("settings", settings_table(study).list());
    f.record("omissions", omission_table(study).list());
  }
  for (auto o = study.omissions.begin(); o != study.omissions.end();) {  // those of one reason together
    const auto other = std::find_if(o, study.omissions.end(), [&](const Omission& next) { return next.why != o->why; });
    std::string what = o->what;
    for (++o; o != other; ++o) what += "; " + o->what;
    say({.lines = {fmt::format("omitted: {}: {}", what, std::prev(other)->why)}, .indent = "  "});
  }
  say({.lines = {fmt::format("{} settings in {:.3g} s of processor time; {}", study.settings.size(), study.seconds,
                             machine_info())},
       .indent = "  "});
  f.say(f.chapter("Notes"), Sentences{.lines = study.notes, .indent = "  note: ", .key = "notes"});
  f.record("machine", machine_info());
  f.record("processor_seconds", study.seconds);
  f.tables = {{"settings", [&study] { return settings_table(study).data(); }}};
  return f;
}

}  // namespace kurbel
