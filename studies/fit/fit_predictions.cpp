// fit_predictions.cpp — records of other machines and loads, with what the fitted values leave open.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/messages.h"
#include "studies/fit/fit.h"

namespace kurbel {
namespace {

double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

double fluctuation(const Eigen::VectorXd& speed) {
  return 2 * (speed.maxCoeff() - speed.minCoeff()) / std::abs(speed.maxCoeff() + speed.minCoeff());
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
    told_.given = asked.given;
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
        const auto [below, above] = problem_.around(u, k);
        moved.push_back(k), at.push_back(below), at.push_back(above);
      }
    const std::vector<Response> responses = problem_.responses_of(machine, at);
    for (const Response& r : responses)
      if (!r.failed.empty()) {
        told_.failed = r.failed;
        study_.predictions.push_back(told_);
        return;
      }
    told_.held = responses.front().held;
    const ComparedRecord by_points(record_, {}, asked_.like);
    std::vector<Eigen::VectorXd> points;
    for (std::size_t i = 0; i < at.size(); ++i)
      points.push_back(by_points.points_of(responses[i], problem_.unknowns(), at[i]));
    const auto gradient = [&](const auto& of) {
      const Eigen::VectorXd first = of(points.front());
      Eigen::MatrixXd j = Eigen::MatrixXd::Zero(first.size(), u.size());
      for (std::size_t m = 0; m < moved.size(); ++m) {
        const auto c = static_cast<Eigen::Index>(moved[m]);
        j.col(c) = (of(points[2 * m + 2]) - of(points[2 * m + 1])) / (at[2 * m + 2][c] - at[2 * m + 1][c]);
      }
      return j;
    };
    curves(points.front(), gradient([](const Eigen::VectorXd& p) { return p; }));
    if (record_.over == Over::angle) {
      const ComparedRecord orders(record_, told_orders(request_, record_), asked_.like);
      by_order(orders, points.front(), gradient([&](const Eigen::VectorXd& p) { return orders.compared(p); }));
    }
    deltas(points.front(), gradient([&](const Eigen::VectorXd& p) { return delta_of(p); }));
    study_.predictions.push_back(told_);
  }

 private:
  Eigen::VectorXd deviations(const Eigen::MatrixXd& j) const {
    return (j * state_.covariance).cwiseProduct(j).rowwise().sum().cwiseMax(0).cwiseSqrt();
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

  void curves(const Eigen::VectorXd& points, const Eigen::MatrixXd& j) {
    const Eigen::VectorXd deviation = deviations(j);
    const std::size_t n = record_.at.size();
    for (std::size_t c = 0; c < record_.channels.size(); ++c) {
      const RecordChannel& channel = record_.channels[c];
      Curve95& curve = study_.predicted_curves.emplace_back(Curve95{.record = asked_.given,
                                                                    .channel = channel.channel,
                                                                    .unit = channel.unit,
                                                                    .over = record_.over,
                                                                    .at = record_.at,
                                                                    .measured = {},
                                                                    .shown = {}});
      const double left = left_of(c);
      std::size_t inside = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const auto k = static_cast<Eigen::Index>(c * n + i);
        const double half = state_.interval * std::hypot(deviation[k], left);
        curve.shown.push_back(points[k]);
        curve.low.push_back(points[k] - half), curve.high.push_back(points[k] + half);
        inside += std::abs(channel.mean[i] - points[k]) <= half;
      }
      if (asked_.against.empty()) continue;
      curve.measured = channel.mean;
      if (c > 0) continue;
      told_.rms = rms_between(curve.shown, curve.measured);
      told_.inside = static_cast<double>(inside) / static_cast<double>(n);
      if (like_.at.size() == n) told_.rms_of_fitted_record = rms_between(like_.channels[c].mean, curve.measured);
    }
  }

  void by_order(const ComparedRecord& orders, const Eigen::VectorXd& points, const Eigen::MatrixXd& j) {
    const Eigen::VectorXd shown = orders.compared(points);
    for (std::size_t c = 0; c < record_.channels.size(); ++c)
      for (std::size_t o = 0; o < orders.orders().size(); ++o) {
        const Eigen::Index i = orders.begin(c) + 2 * static_cast<Eigen::Index>(o);
        PredictedOrder& told =
            study_.predicted_orders.emplace_back(PredictedOrder{.prediction = asked_.given,
                                                                .channel = record_.channels[c].channel,
                                                                .unit = record_.channels[c].unit,
                                                                .order = orders.orders()[o],
                                                                .value = {}});
        told.value = order_part(shown[i], shown[i + 1]);
        double left = 0;
        for (const OrderResidual& r : study_.orders)
          if (r.record == like_.name && r.channel == told.channel && r.order == told.order)
            left = r.left / std::sqrt(2.0);
        const double cosine = std::cos(told.value.phase), sine = std::sin(told.value.phase);
        const Eigen::RowVectorXd along = cosine * j.row(i) + sine * j.row(i + 1);
        const Eigen::RowVectorXd across = cosine * j.row(i + 1) - sine * j.row(i);
        const auto half = [&](const Eigen::RowVectorXd& row) {
          return state_.interval *
                 std::sqrt(std::max(0.0, (row * state_.covariance * row.transpose())(0, 0)) + left * left);
        };
        told.amplitude_error = half(along);
        told.phase_error = half(across) / std::max(told.value.amplitude, 1e-300);
        if (!asked_.against.empty()) told.measured = order_part(orders.data()[i], orders.data()[i + 1]);
      }
  }

  std::optional<std::size_t> speed() const {
    for (std::size_t c = 0; c < record_.channels.size(); ++c)
      if (record_.over == Over::angle && record_.channels[c].channel.starts_with("speed.")) return c;
    return {};
  }
  Eigen::VectorXd part(const Eigen::VectorXd& points, std::size_t channel) const {
    const auto n = static_cast<Eigen::Index>(record_.at.size());
    return points.segment(static_cast<Eigen::Index>(channel) * n, n);
  }
  Eigen::VectorXd delta_of(const Eigen::VectorXd& points) const {
    return Eigen::VectorXd::Constant(1, speed() ? fluctuation(part(points, *speed())) : 0);
  }
  // With what the fit has left of δ of the record that it is like.
  void deltas(const Eigen::VectorXd& points, const Eigen::MatrixXd& j) {
    if (!speed()) return;
    double left = 0;
    if (const Curve95* const curve = fitted_curve(*speed()))
      left = fluctuation(Eigen::Map<const Eigen::VectorXd>(curve->shown.data(),
                                                           static_cast<Eigen::Index>(curve->shown.size()))) -
             fluctuation(Eigen::Map<const Eigen::VectorXd>(curve->measured.data(),
                                                           static_cast<Eigen::Index>(curve->measured.size())));
    told_.delta = Estimate{delta_of(points)[0], state_.interval * std::hypot(deviations(j)[0], left)};
    if (asked_.against.empty()) return;
    const std::vector<double>& mean = record_.channels[*speed()].mean;
    told_.measured_delta =
        fluctuation(Eigen::Map<const Eigen::VectorXd>(mean.data(), static_cast<Eigen::Index>(mean.size())));
  }

  FitProblem& problem_;
  const PredictionRequest& asked_;
  const FitState& state_;
  FitStudy& study_;
  const FitRecord& like_;
  FitRecord record_;
  RecordRequest request_;
  Prediction told_;
};

}  // namespace

void predict(FitProblem& problem, const FitOptions& options, const FitState& state, FitStudy& study) {
  for (const PredictionRequest& asked : options.predictions) Predicting(problem, asked, state, study).run();
}

}  // namespace kurbel
