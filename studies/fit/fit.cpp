// fit.cpp — from start to values with errors; what is left.
#include "studies/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

// Values that go together: 1 + 2 Σ ρ_k up to the first that is not positive.
double correlation_length(const Eigen::VectorXd& r) {
  const Eigen::Index n = r.size();
  const double power = r.squaredNorm();
  if (n < 8 || !(power > 0)) return 1;
  double sum = 1;
  for (Eigen::Index k = 1; k < n / 2; ++k) {
    const double rho = r.head(n - k).dot(r.tail(n - k)) / power;
    if (rho <= 0) break;
    sum += 2 * rho;
  }
  return std::min(sum, static_cast<double>(n) / 4);
}

class FitWork {
 public:
  explicit FitWork(const FitOptions& options)
      : options_(options), problem_(options.records, options.free, options.jobs, options.watch) {
    const Scene scene = VariedScene(options.records.front().scene, {}).at({});
    study_.title = scene.heading(), study_.scene_file = options.records.front().scene.file;
    study_.scene_text = scene.text, study_.speed_unit = scene.speed_unit;
    study_.values = problem_.values_compared();
  }

  FitStudy run() {
    if (!problem_.choose_steps(problem_.given())) return without_fit();
    state_.best = problem_.fit(problem_.given());
    if (options_.starts > 1) try_starts(problem_, options_, state_, study_);
    if (state_.best.r.size() == 0 || state_.best.jacobian.size() == 0) return without_fit();
    weigh();
    say_values();
    say_residuals();
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
    study_.complete = false, study_.diagnosis = problem_.failure();
    study_.conclusion = "No fit: the machine does not run with these values: " + problem_.failure();
    return std::move(study_);
  }

  bool all_of_scatter() const {
    return std::all_of(problem_.comparisons().begin(), problem_.comparisons().end(),
                       [](const ComparedRecord& c) { return c.of_scatter(); });
  }

  // Relative weights become those of what is left; then errors.
  void weigh() {
    if (!all_of_scatter())
      for (int k = 0; k < 2; ++k) {
        problem_.residuals(state_.best.u);
        problem_.weigh_by_residuals(state_.best.u);
        const int before = state_.best.steps;
        state_.best = problem_.fit(state_.best.u, 10);
        state_.best.steps += before;
      }
    problem_.residuals(state_.best.u);
    study_.steps = state_.best.steps, study_.converged = state_.best.converged;
    determine();
  }

  // Rows over √τ of their channel, so that values which go together count as one.
  void determine() {
    Eigen::MatrixXd j = state_.best.jacobian;
    Eigen::VectorXd r = state_.best.r;
    double effective = 0;
    Eigen::Index begin = 0;
    std::vector<Eigen::MatrixXd> scores;
    Eigen::Index rows = 0;
    for (std::size_t k = 0; k < problem_.records().size(); ++k) {
      const ComparedRecord& c = problem_.comparisons()[k];
      const bool one_by_one = c.cycles().rows() > 1;
      for (std::size_t channel = 0; channel < problem_.records()[k].channels.size(); ++channel) {
        const Eigen::Index at = begin + c.begin(channel);
        const bool points = c.orders().empty() && problem_.records()[k].over != Over::mode;
        const double tau = points ? correlation_length(r.segment(at, c.per_channel())) : 1;
        lengths_.push_back(tau);
        effective += static_cast<double>(c.per_channel()) / tau;
        if (!one_by_one) j.middleRows(at, c.per_channel()) /= std::sqrt(tau);
        r.segment(at, c.per_channel()) /= std::sqrt(tau);
      }
      Eigen::MatrixXd part = j.middleRows(begin, c.size());
      if (one_by_one) {
        const auto n = static_cast<double>(c.cycles().rows());
        Eigen::MatrixXd deviations = c.cycles();
        for (Eigen::Index i = 0; i < deviations.cols(); ++i) deviations.col(i) /= c.deviation()[i];
        part = (deviations * part / std::sqrt(n * (n - 1))).eval();
        cycles_ = std::max(cycles_, n);
      }
      rows += part.rows();
      scores.push_back(std::move(part));
      begin += c.size();
    }
    Eigen::MatrixXd all;
    if (cycles_ > 0) {
      all.resize(rows, problem_.size());
      Eigen::Index next = 0;
      for (const Eigen::MatrixXd& part : scores) all.middleRows(next, part.rows()) = part, next += part.rows();
    }
    constexpr double least_floor = 1e-4, most_floor = 1e-2;
    const double floor = std::clamp(3 * problem_.noise(), least_floor, most_floor);
    state_.determined = determined_by(j, state_.best.on_bound, floor, all);
    const double freedom = std::max(effective - static_cast<double>(problem_.size()), 1.0);
    const double reduced = r.squaredNorm() / freedom;
    const bool by_scatter = all_of_scatter();
    constexpr double below_machine_error = 0.5;  // of weights by what is left it is 1
    study_.chi_squared = by_scatter ? reduced : 0;
    state_.covariance = state_.determined.covariance * std::max(1.0, reduced);
    const double degrees = by_scatter && reduced <= 1 && cycles_ > 1 ? cycles_ - 1 : freedom;
    state_.interval = boost::math::quantile(boost::math::students_t(degrees), 0.975);
    study_.errors_from =
        !by_scatter && reduced < below_machine_error
            ? "the machine's own error ([run] accuracy): what is left is smaller"
        : !by_scatter ? "what is left between record and machine, as noise of its own correlation length"
        : reduced > 1
            ? fmt::format("the scatter of cycles, times {:.3g}: so much larger is what is left", std::sqrt(reduced))
            : "the scatter of cycles";
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
      FittedUnknown& told = study_.unknowns.emplace_back(FittedUnknown{.unknown = unknown, .value = unknown.at(u[c])});
      if (std::count(d.no_trace.begin(), d.no_trace.end(), k)) {
        told.remark = "without influence on what is compared";
      } else if (state_.best.on_bound[k] != 0) {
        told.remark = state_.best.on_bound[k] < 0 ? "on its lower bound" : "on its upper bound";
      } else if (!d.known[k]) {
        told.remark = "not determined: see what the data cannot tell apart";
      } else {
        told.error = std::sqrt(state_.covariance(c, c)) * range;
        told.low = told.value - state_.interval * *told.error, told.high = told.value + state_.interval * *told.error;
        if (*told.error > 0.5 * range) told.remark = "the data hardly bound it: its error is over half of its range";
      }
      for (std::size_t other = 0; other < k; ++other)
        if (const double value = d.correlation(other, k); value != 0) study_.correlations.push_back({other, k, value});
    }
    std::stable_sort(study_.correlations.begin(), study_.correlations.end(),
                     [](const Correlation& a, const Correlation& b) { return std::abs(a.value) > std::abs(b.value); });
    say_what_is_joined();
    for (std::size_t r = 0; r < problem_.records().size(); ++r)
      if (const auto& held = problem_.responses()[r].held)
        study_.held.push_back(fmt::format("{}: {} = {} keeps {}", problem_.records()[r].name, held->key,
                                          with_unit(held->value, held->unit, 5),
                                          study_.speed_unit.text(*problem_.requests()[r].mean_speed, 6)));
    study_.settings = problem_.machines().front().settings_at(u, problem_.responses().front().held);
    const MachineQuestion& first = problem_.requests().front().scene;
    std::vector<std::string> settings;
    for (const std::string& s : first.settings) {
      const std::string path = s.substr(0, s.find('=') + 1);
      if (std::none_of(study_.settings.begin(), study_.settings.end(),
                       [&](const auto& f) { return f.starts_with(path); }))
        settings.push_back(s);
    }
    settings.insert(settings.end(), study_.settings.begin(), study_.settings.end());
    study_.written = SettledText(first.text, first.file, settings).text();
  }

  void say_what_is_joined() {
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
      study_.confounded.push_back(fmt::format(
          "the data cannot tell apart {}: moved together ({}), nothing that is compared changes; hold one of "
          "them, or give a record that shows it",
          names, change));
    }
    constexpr double nearly = 0.95;
    for (const Correlation& c : study_.correlations)
      if (std::abs(c.value) > nearly)
        study_.confounded.push_back(fmt::format("{} and {} are hardly told apart: correlation {:+.4f}",
                                                problem_.unknowns()[c.a].name, problem_.unknowns()[c.b].name, c.value));
  }

  void say_residuals() {
    std::size_t number = 0;
    for (std::size_t r = 0; r < problem_.records().size(); ++r) {
      const FitRecord& record = problem_.records()[r];
      const ComparedRecord& c = problem_.comparisons()[r];
      const Eigen::VectorXd points = c.points_of(problem_.responses()[r], problem_.unknowns(), state_.best.u);
      const Eigen::VectorXd shown = c.compared(points), left = shown - c.data();
      const auto count = static_cast<Eigen::Index>(record.at.size());
      for (std::size_t k = 0; k < record.channels.size(); ++k) {
        const RecordChannel& channel = record.channels[k];
        const auto part = left.segment(c.begin(k), c.per_channel());
        const auto data = c.data().segment(c.begin(k), c.per_channel());
        ChannelResidual& told = study_.residuals.emplace_back(
            ChannelResidual{.record = record.name, .channel = channel.channel, .unit = channel.unit});
        told.of = c.orders().empty() ? "points" : "orders";
        told.count = static_cast<std::size_t>(c.per_channel());
        told.rms = std::sqrt(part.squaredNorm() / static_cast<double>(c.per_channel()));
        const double size = c.orders().empty() ? data.maxCoeff() - data.minCoeff() : data.cwiseAbs().maxCoeff();
        if (size > 0) told.range_part = told.rms / size;
        if (channel.has_scatter())
          told.scatter = std::sqrt(c.deviation().segment(c.begin(k), c.per_channel()).squaredNorm() /
                                   static_cast<double>(c.per_channel()));
        told.correlation_length = lengths_[number++];
        Curve95& curve = study_.curves.emplace_back(Curve95{.record = record.name,
                                                            .channel = channel.channel,
                                                            .unit = channel.unit,
                                                            .over = record.over,
                                                            .at = record.at,
                                                            .measured = channel.mean,
                                                            .shown = {}});
        for (Eigen::Index i = 0; i < count; ++i)
          curve.shown.push_back(points[static_cast<Eigen::Index>(k) * count + i]);
      }
      if (record.over == Over::angle) say_orders(r, points);
    }
  }

  void say_orders(std::size_t r, const Eigen::VectorXd& points) {
    const FitRecord& record = problem_.records()[r];
    const ComparedRecord by_order(record, told_orders(problem_.requests()[r], record), r);
    const Eigen::VectorXd shown = by_order.compared(points);
    for (std::size_t k = 0; k < record.channels.size(); ++k)
      for (std::size_t o = 0; o < by_order.orders().size(); ++o) {
        const Eigen::Index i = by_order.begin(k) + 2 * static_cast<Eigen::Index>(o);
        OrderResidual& told = study_.orders.emplace_back(OrderResidual{.record = record.name,
                                                                       .channel = record.channels[k].channel,
                                                                       .unit = record.channels[k].unit,
                                                                       .order = by_order.orders()[o],
                                                                       .measured = {},
                                                                       .fitted = {}});
        told.measured = order_part(by_order.data()[i], by_order.data()[i + 1]);
        told.fitted = order_part(shown[i], shown[i + 1]);
        told.left = std::hypot(shown[i] - by_order.data()[i], shown[i + 1] - by_order.data()[i + 1]);
        if (record.channels[k].has_scatter())
          told.scatter = std::hypot(by_order.deviation()[i], by_order.deviation()[i + 1]);
      }
  }

  void conclude() {
    for (const FittedUnknown& u : study_.unknowns) {
      if (u.unknown.kind != Unknown::Kind::key && study_.unknowns.size() > 3) continue;
      study_.conclusion += fmt::format("{}{} = {}{}", study_.conclusion.empty() ? "" : ", ", u.unknown.name,
                                       with_error({u.value, u.error}, u.unknown.range.unit),
                                       u.remark.empty() ? "" : " (" + u.remark + ")");
    }
    double worst = 0;
    for (const ChannelResidual& r : study_.residuals) worst = std::max(worst, r.range_part.value_or(0));
    study_.conclusion += fmt::format("; what is left is {:.2g} % of the measured range at most", 100 * worst);
    if (study_.chi_squared > 0)
      study_.conclusion += study_.chi_squared > 2 ? fmt::format(
                                                        ", {:.2g} times what the scatter of cycles explains: the "
                                                        "machine lacks an effect, or the record errs",
                                                        std::sqrt(study_.chi_squared))
                                                  : ", as much as the scatter of cycles explains";
    if (!study_.converged) study_.notes.push_back("the fit has not come to its end; give further starts (--starts 8)");
    double longest = 1;
    for (const ChannelResidual& r : study_.residuals) longest = std::max(longest, r.correlation_length);
    if (longest > 3)
      study_.notes.push_back(
          fmt::format("what is left goes together over some {:.0f} points: it is no noise; an effect is "
                      "missing, or the record errs. Errors allow for that length",
                      longest));
    if (!study_.confounded.empty()) study_.conclusion += "; " + study_.confounded.front();
  }

  const FitOptions& options_;
  FitProblem problem_;
  FitState state_;
  FitStudy study_;
  std::vector<double> lengths_;
  double cycles_ = 0;
};

}  // namespace

std::vector<double> told_orders(const RecordRequest& request, const FitRecord& record) {
  if (!request.orders.empty()) return request.orders;
  std::vector<double> orders;
  constexpr int most = 8;
  for (int k = 1; k <= most; ++k) orders.push_back(k * 2 * std::numbers::pi / record.period);
  return orders;
}

FitStudy fit_machine(const FitOptions& options) { return FitWork(options).run(); }

}  // namespace kurbel
