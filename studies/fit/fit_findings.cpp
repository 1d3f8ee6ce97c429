// fit_findings.cpp — values with errors, residuals, predictions, each said once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/plots.h"
#include "studies/fit/fit.h"

namespace kurbel {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

// Speeds in the scene's unit, all else in SI.
double shown_in(const FitStudy& s, const std::string& unit, double value) {
  return unit == "rad/s" ? s.speed_unit.of(value) : value;
}
std::string unit_shown(const FitStudy& s, const std::string& unit) {
  return pretty_unit(unit == "rad/s" ? s.speed_unit.name : unit);
}
// Of a column for people: a speed in its unit.
template <class Row>
auto in_unit(const FitStudy& s, double Row::*member) {
  return [&s, member](const Row& r) { return shown_in(s, r.unit, r.*member); };
}

Rows value_table(const FitStudy& s) {
  using F = FittedUnknown;
  return table_of("unknowns", "Fitted values", s.unknowns)
      .column("name", "unknown", [](const F& f) { return f.unknown.name; })
      .only_for_programs("value", [](const F& f) { return f.value; })
      .only_for_programs("error", [](const F& f) { return f.error; })
      .value_and_error(
          "value", [](const F& f, int digits) { return figure_text(f, digits); }, "standard error")
      .column("low", "95 % from", [](const F& f) { return f.low; }, {.digits = 5})
      .column("high", "to", [](const F& f) { return f.high; }, {.digits = 5})
      .column(
          "unit", "unit", [](const F& f) { return f.unknown.range.unit; }, pretty_unit)
      .only_for_programs("lower_bound", [](const F& f) { return f.unknown.range.low; })
      .only_for_programs("upper_bound", [](const F& f) { return f.unknown.range.high; })
      .column("remark", "", [](const F& f) { return f.remark; });
}

Rows correlation_table(const FitStudy& s) {
  constexpr std::size_t most = 12;
  return table_of("correlations", "Correlations", s.correlations)
      .text_in(2)
      .column("a", "unknown", [&s](const Correlation& c) { return s.unknowns[c.a].unknown.name; })
      .column("b", "and", [&s](const Correlation& c) { return s.unknowns[c.b].unknown.name; })
      .column("correlation", "correlation", &Correlation::value, {.digits = 4})
      .people_see_first(most);
}

Rows residual_table(const FitStudy& s) {
  using R = ChannelResidual;
  return table_of("residuals", "Residuals", s.residuals)
      .text_in(3)
      .column("record", "record", &R::record)
      .column("channel", "channel", &R::channel)
      .column("of", "of", &R::of)
      .column("count", "values", &R::count)
      .only_for_programs("rms", &R::rms)
      .only_for_people("RMS", in_unit(s, &R::rms), ReadAs{.digits = 3})
      .column("part", "of the range [%]", &R::range_part, {.factor = 100, .digits = 3})
      .only_for_programs("scatter", &R::scatter)
      .column("times", "over the scatter", [](const R& r) { return r.times(); }, {.digits = 3})
      .column("together", "correlation length", &R::correlation_length, {.digits = 2})
      .column("correlation", "correlation", &R::alike, {.digits = 3})
      .only_for_programs("peak", &R::peak)
      .only_for_programs("peak_fitted", &R::peak_fitted)
      .only_for_people("peak", in_unit(s, &R::peak), ReadAs{.digits = 4})
      .only_for_people("fitted", in_unit(s, &R::peak_fitted), ReadAs{.digits = 4})
      .only_for_programs("unit", &R::unit)
      .only_for_people("unit", [&s](const R& r) { return unit_shown(s, r.unit); });
}

Rows order_table(const FitStudy& s, const char* key, const char* title, const std::vector<OrderFigure>& rows) {
  using R = OrderFigure;
  const bool predicted = key != std::string("orders");
  const auto part = [&s](std::optional<OrderPart> p, const R& r) {
    return p ? std::optional(shown_in(s, r.unit, p->amplitude.value)) : std::nullopt;
  };
  const auto speed = [&s](std::optional<double> R::*member) {
    return [&s, member](const R& r) {
      return r.*member ? std::optional(shown_in(s, r.unit, *(r.*member))) : std::nullopt;
    };
  };
  auto table = table_of(key, title, rows);
  table.text_in(2)
      .column("record", predicted ? "scene" : "record", &R::record)
      .column("channel", "channel", &R::channel)
      .column("order", "order", &R::order)
      .column("measured", "measured", [part](const R& r) { return part(r.measured, r); }, {.digits = 4})
      .only_for_programs("shown", [part](const R& r) { return part(r.shown, r); });
  const auto amplitude_error = [&s](const R& r) {
    const std::optional<double>& error = r.shown.amplitude.error;
    return error ? std::optional(shown_in(s, r.unit, *error)) : std::nullopt;
  };
  if (predicted) table.only_for_programs("amplitude_error", amplitude_error);
  // With its error, if it has one.
  const auto with_its_error = [&](std::string heading, auto value, auto error) {
    if (!predicted)
      table.only_for_people(heading, value, ReadAs{.digits = 4});
    else
      table.value_and_error(
          heading,
          [=](const R& r, int) {
            return figure_text({value(r), error(r)}, 4);
          },
          "±");
  };
  with_its_error(
      predicted ? "predicted" : "fitted", [part](const R& r) { return *part(r.shown, r); }, amplitude_error);
  table
      .column("measured_phase", "phase [deg]",
              [](const R& r) { return r.measured ? std::optional(r.measured->phase.value) : std::nullopt; },
              {.factor = degrees, .digits = 4})
      .only_for_programs("shown_phase", [](const R& r) { return r.shown.phase.value; });
  if (predicted) table.only_for_programs("phase_error", [](const R& r) { return r.shown.phase.error; });
  with_its_error(
      predicted ? "predicted [deg]" : "fitted [deg]", [](const R& r) { return degrees * r.shown.phase.value; },
      [](const R& r) { return (degrees * r.shown.phase).error; });
  table.column("left", "left", speed(&R::left), {.digits = 3});
  if (!predicted) table.column("scatter", "scatter of the mean", speed(&R::scatter), {.digits = 2});
  return table.column(
      "unit", "unit", [&s](const R& r) { return r.unit == "rad/s" ? s.speed_unit.name : r.unit; }, pretty_unit);
}

Rows band_table(const FitStudy& s) {
  using B = BandResidual;
  return table_of("bands", "By frequency, RMS", s.bands)
      .text_in(2)
      .column("record", "record", &B::record)
      .column("channel", "channel", &B::channel)
      .column("from", "from [Hz]", &B::from, {.digits = 3})
      .column("to", "to [Hz]", &B::to, {.digits = 3})
      .column("measured", "measured", in_unit(s, &B::measured), {.digits = 3})
      .column("fitted", "fitted", in_unit(s, &B::fitted), {.digits = 3})
      .column("left", "left", in_unit(s, &B::left), {.digits = 3})
      .column(
          "unit", "unit", [&s](const B& r) { return r.unit == "rad/s" ? s.speed_unit.name : r.unit; }, pretty_unit);
}

Rows effect_table(const FitStudy& s) {
  using E = EffectTried;
  return table_of("effects", "Effects that are off, each refitted", s.effects)
      .column("effect", "effect", &E::words)
      .column("reduction", "takes off the sum of squares [%]", &E::reduction, {.factor = 100, .digits = 3})
      .column("failed", "", &E::failed);
}

Rows omitted_table(const FitStudy& s) {
  using R = WithoutRecord;
  return table_of("left_out", "Without each record", s.omitted)
      .text_in(2)
      .column("record", "without", &R::record)
      .column("name", "unknown", &R::name)
      .column("value", "value", &R::value, {.digits = 5})
      .column("fitted", "of all", &R::fitted, {.digits = 5})
      .column("errors", "apart [standard errors]", &R::errors, {.digits = 2})
      .column("unit", "unit", &R::unit, pretty_unit)
      .column("rms", "record omitted, over its deviations", &R::rms, {.digits = 3})
      .column("rms_fitted", "fitted", &R::rms_fitted, {.digits = 3});
}

Rows prediction_table(const FitStudy& s) {
  using P = Prediction;
  return table_of("predictions", "Predictions", s.predictions)
      .column("prediction", "scene", &P::given)
      .only_for_programs("delta", [](const P& p) { return p.delta ? std::optional(p.delta->value) : std::nullopt; })
      .only_for_programs("delta_error", [](const P& p) { return p.delta ? p.delta->error : std::nullopt; })
      .value_and_error(
          "δ",
          [](const P& p, int) {
            return p.delta ? figure_text(*p.delta, 4) : FigureText{"—", ""};
          },
          "± (95 %)")
      .column("measured_delta", "measured", &P::measured_delta, {.digits = 4})
      .column("held", "held",
              [](const P& p) {
                return p.held ? fmt::format("{} = {}", p.held->key, with_unit(p.held->value, p.held->unit, 5))
                              : std::string();
              })
      .column("rms", "left, RMS (SI)", &P::rms, {.digits = 3})
      .column("rms_of_fitted_record", "by the fitted record", &P::rms_of_fitted_record, {.digits = 3})
      .column("inside", "points within 95 % [%]", &P::inside, {.factor = 100, .digits = 3})
      .column("failed", "", &P::failed);
}

Plot frame(const FitStudy& s, const Curve95& c, const std::string& title) {
  Plot plot{.title = title, .x = {}, .y = {c.channel, unit_shown(s, c.unit)}};
  plot.x = c.over == Over::time    ? Axis{"time", "s"}
           : c.over == Over::angle ? Axis{"angle of the link", "deg"}
                                   : Axis{"mode"};
  return plot;
}
Series line_of(const FitStudy& s, const Curve95& c, const std::string& name, Role role,
               const std::vector<double>& values) {
  Series series{.name = name, .role = role};
  for (std::size_t i = 0; i < values.size(); ++i)
    series.add(c.at[i] * (c.over == Over::angle ? degrees : 1), shown_in(s, c.unit, values[i]));
  return series;
}

std::vector<Plot> overlays(const FitStudy& s, const std::vector<Curve95>& curves, bool predicted) {
  std::vector<Plot> plots;
  for (const Curve95& c : curves) {
    const std::string name = predicted ? "predicted" : "fitted";
    Plot over = frame(s, c, fmt::format("{} of {}: {}", c.channel, c.record, predicted ? name : "measured and fitted"));
    if (!c.measured.empty()) over.series.push_back(marks(line_of(s, c, "measured", Role::reference, c.measured)));
    const Series line = line_of(s, c, name, Role::elastic, c.shown);
    over.series.push_back(c.over == Over::mode ? marks(line) : line);
    if (!c.low.empty()) {
      over.series.push_back(dashed(line_of(s, c, "95 %, lower end", Role::sky, c.low)));
      over.series.push_back(dashed(line_of(s, c, "95 %, upper end", Role::sky, c.high)));
    }
    plots.push_back(std::move(over));
    if (predicted) continue;
    Plot left = frame(s, c, fmt::format("Residual of {} of {}", c.channel, c.record));
    std::vector<double> difference;
    for (std::size_t i = 0; i < c.shown.size(); ++i) difference.push_back(c.measured[i] - c.shown[i]);
    left.series = {line_of(s, c, "measured − fitted", Role::vermillion, difference)};
    if (!c.orders.empty())
      left.note =
          fmt::format("It contains the orders that were not compared; compared were {}.", list_of_orders(c.orders));
    plots.push_back(std::move(left));
  }
  return plots;
}

// Ellipses Δχ² = 2.30 and 5.99 of the most correlated pairs.
std::vector<Plot> contours(const FitStudy& s) {
  std::vector<Plot> plots;
  constexpr std::size_t most = 4;
  constexpr int points = 72;
  for (const Correlation& c : s.correlations) {
    if (plots.size() >= most) break;
    const FittedUnknown &a = s.unknowns[c.a], &b = s.unknowns[c.b];
    if (!a.error || !b.error) continue;
    Plot plot{.title = fmt::format("{} and {}: correlation {:+.3f}", a.unknown.name, b.unknown.name, c.value),
              .x = {a.unknown.name, pretty_unit(a.unknown.range.unit)},
              .y = {b.unknown.name, pretty_unit(b.unknown.range.unit)},
              .note = "Where the machine is straight in its unknowns about the fit; both at once."};
    for (const auto& [name, size, role] :
         {std::tuple{"68 %", 2.30, Role::elastic}, std::tuple{"95 %", 5.99, Role::sky}}) {
      Series ellipse{.name = name, .role = role};
      for (int i = 0; i <= points; ++i) {
        const double angle = 2 * std::numbers::pi * i / points;
        const double x = std::cos(angle), y = c.value * x + std::sqrt(1 - c.value * c.value) * std::sin(angle);
        ellipse.add(a.value + std::sqrt(size) * *a.error * x, b.value + std::sqrt(size) * *b.error * y);
      }
      plot.series.push_back(std::move(ellipse));
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace

Findings findings_of(const FitStudy& s) {
  Findings f = Findings::of(s, "Fit to measured records");
  f.conclude(s.complete, s.conclusion);
  for (const FittedUnknown& u : s.unknowns)
    if (f.figures.size() < 4)
      f.figures.push_back({u, u.unknown.name, u.unknown.range.unit, u.remark.empty() ? "standard error" : u.remark});
  const Chapter values = f.chapter("Values"), left = f.chapter("Residuals"), checks = f.chapter("Checks"),
                predictions = f.chapter("Predictions");
  f.say(values, value_table(s));
  if (!s.errors_from.empty())
    f.say(values, Sentences{.lines = {"standard errors by " + s.errors_from}, .title = "", .indent = "  "});
  f.say(
      values,
      Sentences{.lines = s.confounded, .title = "What the data cannot separate", .indent = "  ", .key = "confounded"});
  f.say(values, Sentences{.lines = s.held, .title = "What keeps the speed", .indent = "  ", .key = "held"});
  f.say(values, correlation_table(s));
  f.draw(values, [&s] { return contours(s); });
  f.say(left, residual_table(s));
  f.say(left, order_table(s, "orders", "By order of the link's turns", s.orders));
  f.say(left, band_table(s));
  f.draw(left, [&s] { return overlays(s, s.curves, false); });
  f.say(checks, effect_table(s));
  f.say(checks, omitted_table(s));
  f.say(predictions, prediction_table(s));
  f.say(predictions, order_table(s, "predicted_orders", "Predicted orders, with 95 %", s.predicted_orders));
  f.draw(predictions, [&s] { return overlays(s, s.predicted_curves, true); });
  f.record("errors_from", s.errors_from);
  f.record("chi_squared", s.chi_squared);
  f.record("values", s.values);
  f.record("runs", s.runs);
  f.record("converged", s.converged);
  f.note(checks, s.notes);
  f.show_scene(s.scene_file, s.scene_text);
  return f;
}

}  // namespace kurbel
