// fit_predictions.cpp — records of other machines and loads, with what the fitted values leave open.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/messages.h"
#include "studies/fit/fit.h"

namespace kurbel {
namespace {

// RMS of a − b, or of its deviation from its mean.
double rms_between(const std::vector<double>& a, const std::vector<double>& b, bool about_mean = false) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] - b[i], squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(std::max(0.0, squares / n - (about_mean ? sum * sum / (n * n) : 0)));
}

template <class Values>
double fluctuation(const Values& speed) {
  const auto [least, greatest] = std::minmax_element(speed.begin(), speed.end());
  return 2 * (*greatest - *least) / std::abs(*greatest + *least);
}

class Predicting {
 public:
  Predicting(FitProblem& problem, const PredictionRequest& asked, const FitState& state, FitStudy& study)
      : problem_(problem),
        asked_(asked),
        state_(state),
        study_(study),
        like_(problem.records()[asked.like]),
        record_(like_),
        request_(problem.requests()[asked.like]) {
    request_.scene = asked.scene;
    if (asked.mean_speed) request_.mean_speed = asked.mean_speed;
    reported_.given = asked.given;
    if (asked.against.empty()) return;
    request_.file = asked.against;
    record_ = read_record(request_);
    record_.name = like_.name;
  }

  void run() {
    // Keys that are of this record alone may be none of the other machine.
    RecordMachine machine(request_, record_, asked_.like, problem_.unknowns());
    const Eigen::VectorXd& u = state_.best.u;
    std::vector<Eigen::VectorXd> at = {u};
    std::vector<std::size_t> moved;
    for (std::size_t k = 0; k < problem_.unknowns().size(); ++k)
      if (state_.covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) > 0 &&
          problem_.unknowns()[k].concerns(asked_.like)) {
        const auto [below, above] = problem_.around(u, k, problem_.step_of(k));
        moved.push_back(k), at.push_back(below), at.push_back(above);
      }
    const std::vector<Response> responses = problem_.responses_of(machine, at);
    for (const Response& r : responses)
      if (!r.failed.empty()) {
        reported_.failed = r.failed;
        study_.predictions.push_back(reported_);
        return;
      }
    reported_.held = responses.front().held;
    const ComparedRecord by_points(record_, {}, asked_.like);
    for (std::size_t i = 0; i < at.size(); ++i)
      points_.push_back(by_points.points_of(responses[i], problem_.unknowns(), at[i]));
    at_ = std::move(at), moved_ = std::move(moved);
    curves();
    if (record_.over == Over::angle) by_order(ComparedRecord(record_, reported_orders(request_, record_), asked_.like));
    delta();
    study_.predictions.push_back(reported_);
  }

 private:
  // What is made of points, and half of its 95 %: by the unknowns' covariance, and by what the fit has left of the same;
  // without the latter where the unknowns have no errors.
  template <class Of>
  std::pair<Eigen::VectorXd, std::optional<Eigen::VectorXd>> interval_of(const Of& of,
                                                                         const Eigen::VectorXd& left) const {
    const Eigen::VectorXd value = of(points_.front());
    if (!state_.has_errors) return {value, {}};
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(value.size(), state_.best.u.size());
    for (std::size_t m = 0; m < moved_.size(); ++m) {
      const auto c = static_cast<Eigen::Index>(moved_[m]);
      const std::size_t below = 2 * m + 1, above = below + 1;
      j.col(c) = (of(points_[above]) - of(points_[below])) / (at_[above][c] - at_[below][c]);
    }
    const Eigen::VectorXd squares = (j * state_.covariance).cwiseProduct(j).rowwise().sum().cwiseMax(0);
    return {value, state_.interval * (squares + left.cwiseAbs2()).cwiseSqrt()};
  }

  // What the fit has left of the record that this one is like: no parameter says it, and it will be left here, too.
  double left_of(std::size_t channel) const {
    const Curve95* const curve = fitted_curve(channel);
    return curve ? rms_between(curve->shown, curve->measured) : 0;
  }
  const Curve95* fitted_curve(std::size_t channel) const {
    for (const Curve95& c : study_.curves)
      if (c.record == like_.name && c.channel == record_.channels[channel].channel) return &c;
    return nullptr;
  }

  void curves() {
    const std::size_t n = record_.at.size();
    Eigen::VectorXd left(points_.front().size());
    for (std::size_t c = 0; c < record_.channels.size(); ++c)
      left.segment(static_cast<Eigen::Index>(c * n), static_cast<Eigen::Index>(n)).setConstant(left_of(c));
    const auto [shown, half] = interval_of([](const Eigen::VectorXd& p) { return p; }, left);
    for (std::size_t c = 0; c < record_.channels.size(); ++c) {
      const RecordChannel& channel = record_.channels[c];
      Curve95& curve = study_.predicted_curves.emplace_back(Curve95{.record = asked_.given,
                                                                    .channel = channel.channel,
                                                                    .unit = channel.unit,
                                                                    .over = record_.over,
                                                                    .at = record_.at,
                                                                    .measured = {},
                                                                    .shown = {}});
      std::size_t inside = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const auto k = static_cast<Eigen::Index>(c * n + i);
        curve.shown.push_back(shown[k]);
        if (!half) continue;
        curve.low.push_back(shown[k] - (*half)[k]), curve.high.push_back(shown[k] + (*half)[k]);
        inside += std::abs(channel.mean[i] - shown[k]) <= (*half)[k];
      }
      if (asked_.against.empty()) continue;
      curve.measured = channel.mean;
      if (c > 0) continue;
      // A cycle's mean is held, not predicted.
      const bool about_mean = record_.over == Over::angle;
      reported_.rms = rms_between(curve.shown, curve.measured, about_mean);
      if (half) reported_.inside = static_cast<double>(inside) / static_cast<double>(n);
      if (like_.at.size() == n)
        reported_.rms_of_fitted_record = rms_between(like_.channels[c].mean, curve.measured, about_mean);
    }
  }

  void by_order(const ComparedRecord& orders) {
    for (std::size_t c = 0; c < record_.channels.size(); ++c)
      for (std::size_t o = 0; o < orders.orders().size(); ++o) {
        const Eigen::Index i = orders.begin(c) + 2 * static_cast<Eigen::Index>(o);
        OrderFigure& reported = study_.predicted_orders.emplace_back(
            OrderFigure{asked_.given, record_.channels[c].channel, record_.channels[c].unit, orders.orders()[o]});
        const Eigen::VectorXd first = orders.compared(points_.front());
        reported.shown = order_part(first[i], first[i + 1]);
        double left = 0;
        for (const OrderFigure& r : study_.orders)
          if (r.record == like_.name && r.channel == reported.channel && r.order == reported.order)
            left = *r.left / std::sqrt(2.0);
        // Along the phasor and across it.
        const double cosine = std::cos(reported.shown.phase.value), sine = std::sin(reported.shown.phase.value);
        const auto parts = [&](const Eigen::VectorXd& points) -> Eigen::VectorXd {
          const Eigen::VectorXd z = orders.compared(points);
          return Eigen::Vector2d(cosine * z[i] + sine * z[i + 1], cosine * z[i + 1] - sine * z[i]);
        };
        if (const auto half = interval_of(parts, Eigen::Vector2d(left, left)).second)
          reported.shown.amplitude.error = (*half)[0],
          reported.shown.phase.error = (*half)[1] / std::max(reported.shown.amplitude.value, 1e-300);
        if (asked_.against.empty()) continue;
        reported.measured = order_part(orders.data()[i], orders.data()[i + 1]);
        reported.left = std::hypot(first[i] - orders.data()[i], first[i + 1] - orders.data()[i + 1]);
      }
  }

  void delta() {
    std::size_t c = 0;
    while (c < record_.channels.size() && !record_.channels[c].channel.starts_with("speed.")) ++c;
    if (record_.over != Over::angle || c == record_.channels.size()) return;
    const auto n = static_cast<Eigen::Index>(record_.at.size());
    const auto of = [&](const Eigen::VectorXd& points) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, fluctuation(points.segment(static_cast<Eigen::Index>(c) * n, n)));
    };
    double left = 0;
    if (const Curve95* const curve = fitted_curve(c)) left = fluctuation(curve->shown) - fluctuation(curve->measured);
    const auto [value, half] = interval_of(of, Eigen::VectorXd::Constant(1, left));
    reported_.delta = Estimate{value[0], half ? std::optional((*half)[0]) : std::nullopt};
    if (!asked_.against.empty()) reported_.measured_delta = fluctuation(record_.channels[c].mean);
  }

  FitProblem& problem_;
  const PredictionRequest& asked_;
  const FitState& state_;
  FitStudy& study_;
  const FitRecord& like_;
  FitRecord record_;
  RecordRequest request_;
  Prediction reported_;
  std::vector<Eigen::VectorXd> at_,
      points_;  // u: of the fit, then below and above by each that is moved; what is shown
  std::vector<std::size_t> moved_;
};

}  // namespace

void predict(FitProblem& problem, const FitOptions& options, const FitState& state, FitStudy& study) {
  for (const PredictionRequest& asked : options.predictions) Predicting(problem, asked, state, study).run();
}

}  // namespace kurbel
