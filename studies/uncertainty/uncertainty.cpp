// uncertainty.cpp — gradients with steps above the noise, samples, biases by trials.
#include "studies/uncertainty/uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "engine/scene/units.h"
#include "studies/claims/ranges.h"
#include "studies/run/simulate.h"
#include "studies/trials/trials.h"

namespace kurbel {
namespace {

constexpr std::size_t enough_for_ends = 40;  // so that one of the samples lies beyond each end of 95 %

// Of the deviation: a central difference over ± 0.2 u has an error of 0.04/6 u² y''', small compared with that of the
// linear law itself. If the measured errors exceeded 2 % of the difference, it is taken over ± u.
constexpr double short_step = 0.2, long_step = 1, most_noise = 0.02;

class UncertaintyWork {
 public:
  UncertaintyWork(const MachineQuestion& question, const UncertaintyOptions& options)
      : question_(question), options_(options), scene_(VariedScene(question, {}).at({})) {
    study_.is_of(scene_), study_.scene_file = question.file;
    study_.parameters = tolerated_parameters(scene_);
    for (const Tolerated& t : study_.parameters) swept_.push_back(t.swept());
    varied_.emplace(question_, swept_);
    figures_ = chosen(figures_of(question_), options.figures);
    for (const std::string& limit : options.limits) limits_.push_back(parse_limit(limit, figures_));
  }

  UncertaintyStudy run() {
    const SweepRow nominal = compute({nominal_values()}).at(0);
    if (nominal.state == RowState::failed) {
      study_.break_off(nominal.diagnosis);
      study_.conclusion = "The machine as it is given does not run: " + nominal.diagnosis;
      return std::move(study_);
    }
    for (std::size_t k = 0; k < figures_.size(); ++k)
      if (std::isfinite(value_in(nominal, k))) numbers_.push_back(k);
    for (const std::size_t k : numbers_) study_.figures.push_back({figure_in(nominal, k), figures_[k]});
    gradients();
    report_noise();
    samples();
    report_nonlinearities();
    if (options_.biases && question_.of == SweepStudy::run) biases();
    conclude();
    return std::move(study_);
  }

 private:
  std::vector<double> nominal_values() const {
    std::vector<double> values;
    for (const Tolerated& t : study_.parameters) values.push_back(t.given().value);
    return values;
  }

  std::vector<SweepRow> compute(const std::vector<std::vector<double>>& values) {
    std::vector<SweepRow> rows = rows_of(question_, *varied_, figures_, values, options_.jobs);
    options_.watch.at("uncertainty", 1);
    return rows;
  }

  // A step that leaves the domain ends at its border, and the difference is over the actual step.
  std::vector<std::vector<double>> about_nominal(double step) const {
    std::vector<std::vector<double>> points;
    for (std::size_t p = 0; p < swept_.size(); ++p)
      for (const double sign : {-1.0, 1.0}) {
        std::vector<double> x = nominal_values();
        const Tolerated& t = study_.parameters[p];
        x[p] = std::clamp(x[p] + sign * step * t.deviation(), t.low(), t.high());
        points.push_back(std::move(x));
      }
    return points;
  }

  void gradients() {
    const std::vector<SweepRow> near = compute(about_nominal(short_step));
    std::vector<SweepRow> far;
    for (std::size_t f = 0; f < numbers_.size(); ++f) {
      FigureUncertainty& figure = study_.figures[f];
      double squares = 0;
      for (std::size_t p = 0; p < swept_.size(); ++p) {
        ToleranceShare share = share_of(f, p, near, short_step);
        if (!(share.deviation.error.value_or(0) <= most_noise * share.deviation.value)) {
          if (far.empty()) far = compute(about_nominal(long_step));
          share = share_of(f, p, far, long_step);
        }
        if (!std::isfinite(share.deviation.value)) {
          study_.notes.push_back(
              fmt::format("{}: no gradient by {}: at a value beside it the figure does not exist; it counts as none",
                          figure.figure.name, swept_[p].path));
          share.gradient = 0, share.deviation = {};
        }
        constexpr double rounding = 1e-10;  // of the figure
        if (share.deviation.value <= rounding * std::abs(figure.value)) share.gradient = 0, share.deviation.value = 0;
        squares += share.deviation.value * share.deviation.value;
        figure.shares.push_back(share);
      }
      figure.by_gradients.value = std::sqrt(squares);
      report_noise(figure);
      for (ToleranceShare& s : figure.shares) {
        const double rest = squares - s.deviation.value * s.deviation.value;
        s.without = {std::sqrt(std::max(0.0, rest)), figure.by_gradients.error};
        if (squares > 0) s.share = s.deviation / figure.by_gradients, s.share = s.share * s.share;
      }
      std::stable_sort(figure.shares.begin(), figure.shares.end(),
                       [](const ToleranceShare& a, const ToleranceShare& b) { return a.share.value > b.share.value; });
    }
  }

  // Uncertainty that the runs' errors alone may cause; gradients within it are noted.
  void report_noise(FigureUncertainty& figure) {
    std::string names;
    std::size_t within = 0;
    for (const ToleranceShare& s : figure.shares) {
      const std::optional<double>& noise = s.deviation.error;
      if (!noise) continue;
      figure.by_gradients.error = std::hypot(figure.by_gradients.error.value_or(0), *noise);
      if (*noise > 0 && s.deviation.value <= *noise) names += (within++ ? ", " : "") + swept_[s.parameter].path;
    }
    if (within > 0)
      below_noise_.push_back(figure.figure.name +
                             (within < figure.shares.size() ? fmt::format(" (by {})", names) : std::string()));
  }

  void report_noise() {
    if (below_noise_.empty()) return;
    constexpr std::size_t most_named = 4;
    std::string list;
    for (std::size_t i = 0; i < below_noise_.size() && i < most_named; ++i) list += (i ? ", " : "") + below_noise_[i];
    if (below_noise_.size() > most_named) list += fmt::format(" and {} more", below_noise_.size() - most_named);
    study_.notes.push_back(
        fmt::format("what lies below the noise floor, the errors of the runs on both sides, is not significant: {} "
                    "(a smaller accuracy in [run] lowers the floor)",
                    list));
  }

  ToleranceShare share_of(std::size_t f, std::size_t p, const std::vector<SweepRow>& rows, double step) const {
    const SweepRow &below = rows[2 * p], &above = rows[2 * p + 1];
    const std::size_t k = numbers_[f];
    const double over = above.parameters[p] - below.parameters[p], u = study_.parameters[p].deviation();
    ToleranceShare share{.parameter = p, .step = step};
    share.gradient = (value_in(above, k) - value_in(below, k)) / over;
    share.deviation.value = std::abs(share.gradient) * u;
    const auto e_above = figure_in(above, k).error, e_below = figure_in(below, k).error;
    if (e_above && e_below) share.deviation.error = (*e_above + *e_below) / over * u;
    return share;
  }

  void samples() {
    const Design design(fmt::format("random:{}", options_.samples), swept_, options_.seed);
    std::vector<std::vector<double>> points;
    for (std::size_t i = 0; i < design.rows(); ++i) points.push_back(design.row(i));
    const std::vector<SweepRow> rows = compute(points);
    study_.drawn = rows.size();
    study_.failed = static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const SweepRow& r) { return r.state == RowState::failed; }));
    name_failures(rows);
    for (std::size_t f = 0; f < numbers_.size(); ++f) {
      std::vector<double> y;
      double error = 0;
      for (const SweepRow& r : rows)
        if (const Estimate v = figure_in(r, numbers_[f]); std::isfinite(v.value))
          y.push_back(v.value), error = std::max(error, v.error.value_or(0));
      spread(study_.figures[f], std::move(y), error);
    }
    if (rows.size() < enough_for_ends)
      study_.notes.push_back(
          fmt::format("{} samples do not give an interval of 95 % of the machines: that takes {} and more", rows.size(),
                      enough_for_ends));
    for (const FigureLimit& limit : limits_) {
      LimitCount& count = study_.limits.emplace_back(LimitCount{.limit = limit.given});
      for (const SweepRow& r : rows) count.take_up(side_of(limit, r));
      count.end(rows.size());
    }
  }

  // Reasons of failed samples, a note for each, with the values of the first one.
  void name_failures(const std::vector<SweepRow>& rows) {
    std::map<std::string, std::pair<std::size_t, const SweepRow*>> reasons;
    for (const SweepRow& r : rows)
      if (r.state == RowState::failed) {
        auto& [count, first] = reasons[r.diagnosis.substr(0, r.diagnosis.find('\n'))];
        if (count++ == 0) first = &r;
      }
    for (const auto& [reason, found] : reasons) {
      std::string values;
      for (std::size_t p = 0; p < swept_.size(); ++p)
        values += fmt::format("{}{} = {}{}{}", p ? ", " : "", swept_[p].path,
                              rounded_number(found.second->parameters[p], digits_in_tables),
                              swept_[p].unit.empty() ? "" : " ", pretty_unit(swept_[p].unit));
      study_.notes.push_back(fmt::format("{} of {} machines drawn failed, and hold no limit: {}; the first with {}",
                                         found.first, rows.size(), reason, values));
    }
  }

  // `error`: the largest of a run.
  static void spread(FigureUncertainty& figure, std::vector<double> y, double error) {
    figure.samples = y.size();
    if (y.size() < 2) return;
    const auto n = static_cast<double>(y.size());
    double mean = 0, squares = 0, fourth = 0;
    for (const double v : y) mean += v / n;
    for (const double v : y) squares += (v - mean) * (v - mean), fourth += std::pow(v - mean, 4);
    const double s = std::sqrt(squares / (n - 1));
    figure.mean = {mean, 2 * s / std::sqrt(n) + error};
    figure.by_samples = {s, error};  // s scatters by √((m₄ − s⁴)/n)/(2 s)
    if (s > 0) figure.by_samples.widen(std::sqrt(std::max(0.0, fourth / n - std::pow(s, 4)) / n) / s);
    std::sort(y.begin(), y.end());
    const auto at = [&](double share) {
      const double place = std::clamp(share, 0.0, 1.0) * (n - 1);
      const auto i = static_cast<std::size_t>(place);
      return i + 1 < y.size() ? std::lerp(y[i], y[i + 1], place - static_cast<double>(i)) : y.back();
    };
    // The number of samples below a quantile is binomial.
    const auto end = [&](double share) {
      const double scatter = 2 * std::sqrt(share * (1 - share) / n);
      return Estimate{at(share), 0.5 * (at(share + scatter) - at(share - scatter)) + error};
    };
    if (y.size() >= enough_for_ends) figure.low = end(0.025), figure.high = end(0.975);
  }

  // Each effect that is off and has data, tried by itself.
  void biases() {
    SimulateOptions options;
    options.watch = options_.watch;
    options.watch.progress = {};
    const Result run = simulate(scene_, scene_.effects, "", options);
    std::vector<std::string> names;
    for (const FigureUncertainty& f : study_.figures) names.push_back(f.figure.name);
    const Trials trials = try_effects(run, names, options);
    for (const Trial& trial : trials.tried) {
      if (!trial.failed.empty())
        study_.notes.push_back(fmt::format("{}: not known what it would shift ({})", trial.effect.words, trial.failed));
      for (FigureUncertainty& f : study_.figures)
        for (const TrialChange& c : trial.changes)
          if (c.change.figure == f.figure.name && !c.gone && c.change.reported())
            f.biases.push_back({{c.change.without - c.change.full, c.error_on}, trial.effect.words});
    }
    for (const NotTried& n : trials.not_tried)
      study_.notes.push_back(fmt::format("{}: not tried ({})", n.words, n.because));
  }

  // If gradients are not valid over the tolerances, their deviation and shares apply to small tolerances only.
  void report_nonlinearities() {
    constexpr std::size_t most_reported = 4;
    std::size_t found = 0;
    for (const FigureUncertainty& f : study_.figures) {
      if (f.is_linear() || f.by_gradients.value <= 0 || ++found > most_reported) continue;
      study_.notes.push_back(fmt::format(
          "{} does not follow its gradients over these tolerances: the samples have a deviation of {} about {}, "
          "gradients say {} about {}; the samples are right, and shares by gradients are of small tolerances only "
          "(kurbel sweep --design saltelli:N shares out what is not linear)",
          f.figure.name, reported(f, f.by_samples, 3), reported(f, f.mean), reported(f, f.by_gradients, 3),
          reported(f, f)));
    }
    if (found > most_reported)
      study_.notes.push_back(fmt::format("so do {} more figures: compare the two columns", found - most_reported));
  }

  std::string reported(const FigureUncertainty& f, const Estimate& x, int most_digits = headline_digits) const {
    const FigureCells cells = figure_cells(x, f.figure.unit, study_.speed_unit, most_digits);
    return cells.unit.empty() ? cells.value : cells.value + " " + cells.unit;
  }

  void conclude() {
    std::string& text = study_.conclusion;
    for (const LimitCount& c : study_.limits)
      text += fmt::format("{}{} holds in {} % of such machines ({} of {} drawn{})", text.empty() ? "" : "; ",
                          limit_in_words(c.limit),
                          range_text(100 * c.interval.low, 100 * c.interval.high, c.interval.high > 0.9995 ? 4 : 3),
                          c.holds, study_.drawn, c.undecided ? fmt::format(", {} undecided", c.undecided) : "");
    const auto figure = std::find_if(study_.figures.begin(), study_.figures.end(), [&](const FigureUncertainty& f) {
      return f.by_gradients.value > 0 && (limits_.empty() || f.figure.name == figures_[limits_.front().figure].name);
    });
    if (figure != study_.figures.end()) {
      const ToleranceShare& most = figure->shares.front();
      text += fmt::format(
          "{}{} is {} for the values as given{}, with a standard deviation of {} due to the tolerances",
          text.empty() ? "" : "; ", figure->figure.name, reported(*figure, *figure),
          figure->samples > 1 ? " and " + reported(*figure, figure->mean) + " on average over the machines drawn" : "",
          reported(*figure, figure->deviation(), 2));
      text += figure->is_linear()
                  ? fmt::format("; {} contributes most: without its tolerance the deviation would be {}",
                                swept_[most.parameter].path, reported(*figure, most.without, 2))
                  : fmt::format(", not in proportion to them; it depends most on small changes of {}",
                                swept_[most.parameter].path);
    }
    if (text.empty()) text = "No figure depends on the tolerances that are given";
    if (study_.failed > 0)
      text += fmt::format("; {} of {} machines drawn failed, as the notes say", study_.failed, study_.drawn);
  }

  MachineQuestion question_;
  const UncertaintyOptions& options_;
  Scene scene_;
  UncertaintyStudy study_;
  std::vector<SweptParameter> swept_;
  std::optional<VariedScene> varied_;
  std::vector<SweptFigure> figures_;
  std::vector<FigureLimit> limits_;
  std::vector<std::string> below_noise_;  // figures, and by which tolerances
  std::vector<std::size_t> numbers_;      // of the figures that the machine as given has
};

}  // namespace

bool FigureUncertainty::is_linear() const {
  constexpr std::size_t fewest = 30;
  constexpr double of_deviation = 0.1, of_mean = 0.2, by_chance = 4;
  if (samples < fewest) return true;
  const double root = std::sqrt(static_cast<double>(samples));
  const double s = by_samples.value, u = by_gradients.value;
  return std::abs(s - u) <= of_deviation * u + by_chance * s / (1.4142 * root) &&
         std::abs(mean.value - value) <= (of_mean + by_chance / root) * s;
}

UncertaintyStudy study_uncertainty(const MachineQuestion& question, const UncertaintyOptions& options) {
  return UncertaintyWork(question, options).run();
}

}  // namespace kurbel
