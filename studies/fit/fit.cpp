// fit.cpp — from start to values with errors; residuals.
#include "studies/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/history/spectrum.h"

namespace kurbel {
namespace {

// In double throughout: boost's constants in long double are set at every start of the program, and not under valgrind.
using StudentsT =
    boost::math::students_t_distribution<double,
                                         boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

const char* const without_interval = "without interval: the machine does not show what was measured";

class FitWork {
 public:
  explicit FitWork(const FitOptions& options)
      : options_(options), problem_(options.records, options.free, options.jobs, options.watch) {
    const Scene scene = VariedScene(options.records.front().scene, {}).at({});
    study_.is_of(scene), study_.scene_file = options.records.front().scene.file;
    study_.values = problem_.values_compared();
    for (const FitRecord& record : problem_.records())
      if (!record.gaps.empty()) study_.notes.push_back(record.gaps);
  }

  FitStudy run() {
    if (!problem_.choose_steps(problem_.given())) return without_fit();
    constexpr int roughly = 12;  // steps before the records are weighed
    state_.best = problem_.fit(problem_.given(), options_.records.size() > 1 ? roughly : 40);
    if (options_.starts > 1) try_starts(problem_, options_, state_, study_);
    if (state_.best.r.size() == 0 || state_.best.jacobian.size() == 0) return without_fit();
    weigh();
    say_residuals();
    say_values();
    if (options_.checks) {
      leave_records_out(problem_, state_, study_);
      try_off_effects(problem_, state_, study_);
    }
    predict(problem_, options_, state_, study_);
    study_.runs = problem_.runs();
    conclude();
    return std::move(study_);
  }

 private:
  FitStudy without_fit() {
    study_.break_off(problem_.failure());
    study_.conclusion = "No fit: the machine does not run with these values: " + problem_.failure();
    return std::move(study_);
  }

  // Each record counts by what it leaves when it is fitted by itself: what the machine lacks there must not draw unknowns
  // that others determine. Then all of them together, and errors. Of its values as many are spent as it determines unknowns
  // when all are fitted together: one that several share is not taken from each of them.
  void weigh() {
    const std::size_t count = problem_.records().size();
    std::vector<Eigen::VectorXd> alone(count, state_.best.u);
    std::vector<double> spent(count, 0);
    const Eigen::MatrixXd by_deviation = problem_.deviations().asDiagonal() * state_.best.jacobian;
    constexpr int rounds = 2, most_steps = 12;
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t r = 0; r < count; ++r) {
        problem_.active.assign(count, false), problem_.active[r] = true;
        const bool enough = static_cast<std::size_t>(problem_.comparisons()[r].size()) > problem_.unknowns_of(r);
        // Of one channel all weights change alike, and with them nothing of its fit.
        const bool changes = round == 0 ? count > 1 : problem_.records()[r].channels.size() > 1;
        if (enough && changes)
          if (const BoundedFit found = problem_.fit(alone[r], most_steps); found.r.size() > 0) alone[r] = found.u;
        if (problem_.residuals(alone[r])) problem_.weigh(r, alone[r], spent[r]);
      }
      const Eigen::VectorXd parts =
          leverage(problem_.deviations().cwiseInverse().asDiagonal() * by_deviation, state_.best.on_bound, floor());
      Eigen::Index begin = 0;
      for (std::size_t r = 0; r < count; begin += problem_.comparisons()[r++].size())
        spent[r] = parts.segment(begin, problem_.comparisons()[r].size()).sum();
    }
    problem_.active.assign(count, true);
    const int before = state_.best.steps;
    state_.best = problem_.fit(count > 1 ? state_.best.u : alone[0]);
    if (count > 1)
      if (const BoundedFit other = problem_.fit(together(alone));
          other.r.size() > 0 && other.cost() < state_.best.cost())
        state_.best = other;
    state_.best.steps += before;
    problem_.residuals(state_.best.u);
    study_.steps = state_.best.steps, study_.converged = state_.best.converged;
    determine();
  }

  // Unknowns of one record alone as that one finds them.
  Eigen::VectorXd together(const std::vector<Eigen::VectorXd>& alone) const {
    Eigen::VectorXd u = state_.best.u;
    for (std::size_t k = 0; k < problem_.unknowns().size(); ++k)
      if (const auto& record = problem_.unknowns()[k].record)
        u[static_cast<Eigen::Index>(k)] = alone[*record][static_cast<Eigen::Index>(k)];
    return u;
  }

  // Singular values below it are errors of the derivatives.
  double floor() const {
    constexpr double least = 1e-4, most = 1e-2;
    return std::clamp(3 * problem_.noise(), least, most);
  }

  void determine() {
    const Eigen::MatrixXd& j = state_.best.jacobian;
    std::vector<Eigen::MatrixXd> scores;
    double independent = 0, widened = 1;
    bool by_scatter = true;
    Eigen::Index begin = 0, rows = 0;
    for (const ComparedRecord& c : problem_.comparisons()) {
      Eigen::MatrixXd part = j.middleRows(begin, c.size());
      if (const auto n = static_cast<double>(c.cycles().rows()); n > 1) {
        const Eigen::MatrixXd deviations = c.cycles() * c.deviation().cwiseInverse().asDiagonal();
        part = (deviations * part * (c.widened() / std::sqrt(n * (n - 1)))).eval();
        cycles_ = std::max(cycles_, n);
      }
      independent += c.independent(), widened = std::max(widened, c.widened());
      by_scatter = by_scatter && c.of_scatter();
      begin += c.size(), rows += part.rows();
      scores.push_back(std::move(part));
    }
    Eigen::MatrixXd all(cycles_ > 0 ? rows : 0, problem_.size());
    if (Eigen::Index next = 0; cycles_ > 0)
      for (const Eigen::MatrixXd& part : scores) all.middleRows(next, part.rows()) = part, next += part.rows();
    state_.determined = determined_by(j, state_.best.on_bound, floor(), all);
    const double freedom = std::max(independent - static_cast<double>(problem_.size()), 1.0);
    const double reduced = state_.best.cost() / freedom;
    constexpr double below_machine_error = 0.5;  // of weights by the residuals it is 1
    study_.chi_squared = by_scatter ? reduced * widened * widened : 0;
    state_.covariance = state_.determined.covariance * std::max(1.0, reduced);
    const double known_by = cycles_ > 0 ? std::min(cycles_ - 1, freedom) : freedom;
    state_.interval = boost::math::quantile(StudentsT(known_by), 0.975);
    state_.has_errors = by_scatter || problem_.values_compared() > problem_.unknowns().size();
    study_.errors_from =
        !state_.has_errors ? ""
        : !by_scatter && reduced < below_machine_error
            ? "the machine's own error ([run] accuracy): the residual is smaller"
        : !by_scatter ? "the residual, as noise of its own correlation length"
        : study_.chi_squared > 1
            ? fmt::format(
                  "the scatter of cycles, times {:.3g}, as the residual over its {:.3g} degrees of freedom is "
                  "larger by that factor",
                  std::sqrt(study_.chi_squared), freedom)
            : "the scatter of cycles";
    constexpr double contradictory = 2;
    if (problem_.records().size() > 1 && reduced > contradictory)
      study_.notes.push_back(
          fmt::format("the records contradict each other: together they leave {:.2g} times what each leaves by itself, "
                      "and all errors are widened by that",
                      std::sqrt(reduced)));
  }

  void say_values() {
    const Eigen::VectorXd& u = state_.best.u;
    const Determination& d = state_.determined;
    study_.covariance = state_.covariance;
    for (std::size_t k = 0; k < problem_.unknowns().size(); ++k) {
      const auto c = static_cast<Eigen::Index>(k);
      const Unknown& unknown = problem_.unknowns()[k];
      const double range = unknown.range.high - unknown.range.low;
      study_.covariance.row(c) *= range, study_.covariance.col(c) *= range;
      FittedUnknown& reported = study_.unknowns.emplace_back(FittedUnknown{{unknown.at(u[c])}, unknown});
      if (std::count(d.no_trace.begin(), d.no_trace.end(), k)) {
        reported.remark = "without influence on what is compared";
      } else if (state_.best.on_bound[k] != 0) {
        reported.remark = state_.best.on_bound[k] < 0 ? "on its lower bound" : "on its upper bound";
      } else if (!d.known[k]) {
        reported.remark = "not determined: see what the data cannot separate";
      } else if (!state_.has_errors) {
        reported.remark = "error not assessed: as many unknowns as values, which have no scatter";
      } else if (misfit_) {
        reported.remark = without_interval;
      } else {
        reported.error = std::sqrt(state_.covariance(c, c)) * range;
        reported.low = reported.value - state_.interval * *reported.error,
        reported.high = reported.value + state_.interval * *reported.error;
        if (*reported.error > 0.5 * range)
          reported.remark = "the data hardly bound it: its error is over half of its range";
      }
      // Of fewer cycles than unknowns each has a correlation of 1 with others, whatever the machine.
      const bool correlated = state_.has_errors && (cycles_ == 0 || cycles_ > static_cast<double>(problem_.size()) + 1);
      for (std::size_t other = 0; other < k; ++other)
        if (const double value = d.correlation(other, k); correlated && value != 0)
          study_.correlations.push_back({other, k, value});
    }
    std::stable_sort(study_.correlations.begin(), study_.correlations.end(),
                     [](const Correlation& a, const Correlation& b) { return std::abs(a.value) > std::abs(b.value); });
    report_merged();
    for (std::size_t r = 0; r < problem_.records().size(); ++r)
      if (const auto& held = problem_.responses()[r].held)
        study_.held.push_back(fmt::format("{}: {} = {} keeps {}", problem_.records()[r].name, held->key,
                                          with_unit(held->value, held->unit, 5),
                                          study_.speed_unit.text(*problem_.requests()[r].mean_speed, 6)));
    const MachineQuestion& first = problem_.requests().front().scene;
    const std::vector<std::string> fitted =
        problem_.machines().front().settings_at(u, problem_.responses().front().held);
    std::vector<std::string> settings;
    for (const std::string& s : first.settings) {
      const std::string path = s.substr(0, s.find('=') + 1);
      if (std::none_of(fitted.begin(), fitted.end(), [&](const auto& f) { return f.starts_with(path); }))
        settings.push_back(s);
    }
    settings.insert(settings.end(), fitted.begin(), fitted.end());
    study_.written = SettledText(first.text, first.file, settings).text();
    for (const Unknown& unknown : problem_.unknowns())
      if (unknown.concerns(0) && unknown.moves_machine() && unknown.kind != Unknown::Kind::key)
        study_.notes.push_back(
            fmt::format("a fitted scene that is written (--write) has keys alone: not the {}", unknown.name));
  }

  void report_merged() {
    for (const SharedDirection& direction : state_.determined.undetermined) {
      std::string names, change;
      for (std::size_t i = 0; i < direction.unknowns.size(); ++i) {
        const std::size_t k = direction.unknowns[i];
        const Unknown& unknown = problem_.unknowns()[k];
        const double length = state_.best.jacobian.col(static_cast<Eigen::Index>(k)).norm();
        const double lead = state_.best.jacobian.col(static_cast<Eigen::Index>(direction.unknowns[0])).norm();
        const double by =
            direction.parts[i] / direction.parts[0] * lead / length * (unknown.range.high - unknown.range.low);
        names += (i == 0 ? "" : i + 1 == direction.unknowns.size() ? " and " : ", ") + unknown.name;
        change += fmt::format("{}{:+.3g}{} of {}", i ? ", " : "", by,
                              unknown.range.unit.empty() ? "" : " " + pretty_unit(unknown.range.unit), unknown.name);
      }
      study_.confounded.push_back(
          fmt::format("the data cannot separate {}: moved together ({}), nothing that is compared changes; hold one of "
                      "them, or give a record that shows it",
                      names, change));
    }
    constexpr double nearly = 0.95;
    for (const Correlation& c : study_.correlations)
      if (std::abs(c.value) > nearly)
        study_.confounded.push_back(fmt::format("{} and {} are hardly separable: correlation {:+.4f}",
                                                problem_.unknowns()[c.a].name, problem_.unknowns()[c.b].name, c.value));
  }

  void say_residuals() {
    for (std::size_t r = 0; r < problem_.records().size(); ++r) {
      const FitRecord& record = problem_.records()[r];
      const ComparedRecord& c = problem_.comparisons()[r];
      const Eigen::VectorXd points = c.points_of(problem_.responses()[r], problem_.unknowns(), state_.best.u);
      const Eigen::VectorXd left = c.compared(points) - c.data(), measured = c.measured_points();
      const auto count = static_cast<Eigen::Index>(record.at.size());
      for (std::size_t k = 0; k < record.channels.size(); ++k) {
        const RecordChannel& channel = record.channels[k];
        const auto rms = [&](const Eigen::VectorXd& all) {
          return std::sqrt(all.segment(c.begin(k), c.per_channel()).squaredNorm() /
                           static_cast<double>(c.per_channel()));
        };
        ChannelResidual& reported = study_.residuals.emplace_back(
            ChannelResidual{.record = record.name, .channel = channel.channel, .unit = channel.unit});
        reported.of = c.orders().empty() ? "points" : "orders";
        reported.count = static_cast<std::size_t>(c.per_channel());
        reported.rms = rms(left);
        const auto data = c.data().segment(c.begin(k), c.per_channel());
        const double size = c.orders().empty() ? data.maxCoeff() - data.minCoeff() : data.cwiseAbs().maxCoeff();
        if (size > 0) reported.range_part = reported.rms / size;
        const double varies = c.orders().empty() ? rms(c.data().array() - data.mean()) : size;
        if (varies > 0) reported.variation_part = reported.rms / varies;
        if (channel.has_scatter()) reported.scatter = rms(c.scatter());
        reported.correlation_length = c.length(k);
        const Eigen::VectorXd m = measured.segment(static_cast<Eigen::Index>(k) * count, count),
                              s = points.segment(static_cast<Eigen::Index>(k) * count, count);
        const Eigen::VectorXd dm = m.array() - m.mean(), ds = s.array() - s.mean();
        reported.alike = dm.dot(ds) / std::max(dm.norm() * ds.norm(), 1e-300);
        reported.peak = m.cwiseAbs().maxCoeff(), reported.peak_fitted = s.cwiseAbs().maxCoeff();
        study_.curves.push_back({.record = record.name,
                                 .channel = channel.channel,
                                 .unit = channel.unit,
                                 .over = record.over,
                                 .at = record.at,
                                 .measured = channel.mean,
                                 .shown = {s.begin(), s.end()},
                                 .orders = c.orders()});
        if (record.over == Over::time) say_bands(study_.curves.back());
      }
      if (record.over == Over::angle) say_orders(r, points);
    }
    misfit_ = std::all_of(problem_.records().begin(), problem_.records().end(), [&](const FitRecord& record) {
      return std::any_of(study_.residuals.begin(), study_.residuals.end(),
                         [&](const ChannelResidual& c) { return c.record == record.name && c.is_unexplained(); });
    });
  }

  // Octaves below half the mean rate of points.
  void say_bands(const Curve95& curve) {
    constexpr std::size_t fewest = 128;
    constexpr int most = 7;
    if (curve.at.size() < fewest) return;
    const auto count = static_cast<double>(curve.at.size());
    const double step = (curve.at.back() - curve.at.front()) / (count - 1), resolution = 1 / (count * step);
    std::vector<double> measured, fitted, left;
    const Signal m(curve.at, curve.measured), s(curve.at, curve.shown);
    for (std::size_t i = 0; i < curve.at.size(); ++i) {
      const double at = curve.at.front() + static_cast<double>(i) * step;
      measured.push_back(m.at(at)), fitted.push_back(s.at(at)), left.push_back(m.at(at) - s.at(at));
    }
    const std::vector<double> a = powers_of(measured), b = powers_of(fitted), c = powers_of(left);
    double to = 0.5 / step;
    for (int k = 0; k < most && to > 4 * resolution; ++k, to /= 2) {
      const double from = k + 1 < most && to > 8 * resolution ? to / 2 : 0;
      const auto rms = [&](const std::vector<double>& powers) {
        double sum = 0;
        for (std::size_t i = 1; i < powers.size(); ++i) {
          const double frequency = 0.5 * resolution * static_cast<double>(i);
          if (frequency > from && frequency <= to) sum += powers[i];
        }
        return std::sqrt(sum);
      };
      study_.bands.push_back({curve.record, curve.channel, curve.unit, from, to, rms(a), rms(b), rms(c)});
    }
  }

  void say_orders(std::size_t r, const Eigen::VectorXd& points) {
    const FitRecord& record = problem_.records()[r];
    const ComparedRecord by_order(record, reported_orders(problem_.requests()[r], record), r);
    const Eigen::VectorXd shown = by_order.compared(points);
    for (std::size_t k = 0; k < record.channels.size(); ++k)
      for (std::size_t o = 0; o < by_order.orders().size(); ++o) {
        const Eigen::Index i = by_order.begin(k) + 2 * static_cast<Eigen::Index>(o);
        OrderFigure& reported = study_.orders.emplace_back(
            OrderFigure{record.name, record.channels[k].channel, record.channels[k].unit, by_order.orders()[o]});
        reported.measured = order_part(by_order.data()[i], by_order.data()[i + 1]);
        reported.shown = order_part(shown[i], shown[i + 1]);
        reported.left = std::hypot(shown[i] - by_order.data()[i], shown[i + 1] - by_order.data()[i + 1]);
        if (record.channels[k].has_scatter())
          reported.scatter = std::hypot(by_order.scatter()[i], by_order.scatter()[i + 1]);
      }
  }

  // "in the orders compared (0.5, 1.5) "; empty: no record is compared by orders.
  std::string orders_compared() const {
    std::vector<double> orders;
    for (const ComparedRecord& c : problem_.comparisons())
      orders.insert(orders.end(), c.orders().begin(), c.orders().end());
    return orders.empty() ? "" : fmt::format("in the orders compared ({}) ", list_of_orders(std::move(orders)));
  }

  // What the machine does not show stands before any value.
  std::string doubt() const {
    constexpr const char* causes = "a unit or a fixed value is wrong, an effect is missing, or the record errs";
    std::string unexplained;
    double times = 0;
    for (const ChannelResidual& r : study_.residuals) {
      times = std::max(times, r.times().value_or(0));
      if (r.is_unexplained())
        unexplained += fmt::format("{}{} in {} ({:.2g} % of its {})", unexplained.empty() ? "" : ", ", r.channel,
                                   r.record, 100 * r.variation_part, r.of == "points" ? "deviation" : "amplitude");
    }
    if (!unexplained.empty())
      return fmt::format("The machine does not show what was measured: residual of {}; {}{}. ", unexplained, causes,
                         misfit_ ? ", and values have no interval" : "");
    constexpr double as_scatter = 2;
    return study_.chi_squared > as_scatter && times * times > as_scatter
               ? fmt::format("The residual is {:.3g} times the scatter of the mean: {}. ", times, causes)
               : "";
  }

  void conclude() {
    study_.conclusion = doubt();
    const std::string behind =
        study_.chi_squared > 0 && study_.conclusion.empty() ? ", as much as the scatter of cycles explains" : "";
    bool listed = false;
    for (const FittedUnknown& u : study_.unknowns) {
      if (u.unknown.kind != Unknown::Kind::key && study_.unknowns.size() > 3) continue;
      study_.conclusion += fmt::format("{}{} = {}{}", std::exchange(listed, true) ? ", " : "", u.unknown.name,
                                       with_error(u, u.unknown.range.unit),
                                       u.remark.empty() || u.remark == without_interval ? "" : " (" + u.remark + ")");
    }
    double worst = 0;
    bool of_points = false;
    for (const ChannelResidual& r : study_.residuals)
      worst = std::max(worst, r.range_part.value_or(0)), of_points = of_points || r.of == "points";
    study_.conclusion += fmt::format("; {}the RMS residual is {:.2g} % of the {}{}{}", orders_compared(), 100 * worst,
                                     of_points ? "measured range" : "greatest measured amplitude",
                                     study_.residuals.size() > 1 ? " in the worst channel" : "", behind);
    if (!study_.converged) study_.notes.push_back("the fit did not converge; give further starts (--starts 8)");
    double longest = 1;
    for (const ChannelResidual& r : study_.residuals) longest = std::max(longest, r.correlation_length);
    if (longest > ChannelResidual::noise)
      study_.notes.push_back(
          fmt::format("the residual is correlated over some {:.0f} points: it is no noise; an effect is missing, a "
                      "fixed value is wrong, or the record errs. Errors allow for that length, not for a value that is "
                      "wrong",
                      longest));
    if (!study_.confounded.empty()) study_.conclusion += "; " + study_.confounded.front();
  }

  const FitOptions& options_;
  FitProblem problem_;
  FitState state_;
  FitStudy study_;
  double cycles_ = 0;
  bool misfit_ = false;  // no record is explained
};

}  // namespace

std::string list_of_orders(std::vector<double> orders) {
  std::sort(orders.begin(), orders.end());
  orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
  return fmt::format("{:.4g}", fmt::join(orders, ", "));
}

std::vector<double> reported_orders(const RecordRequest& request, const FitRecord& record) {
  if (!request.orders.empty()) return request.orders;
  std::vector<double> orders;
  constexpr int most = 8;
  for (int k = 1; k <= most; ++k) orders.push_back(k * 2 * std::numbers::pi / record.period);
  return orders;
}

FitStudy fit_machine(const FitOptions& options) { return FitWork(options).run(); }

}  // namespace kurbel
