// newton.cpp — steps halved until they reduce the residual, derivatives reused while they are good enough.
#include "engine/return_map/family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/matrices/linear_algebra.h"

namespace kurbel {
namespace {

constexpr int most_periods = 60, most_derivatives = 12;
constexpr int most_run_on = 8;
constexpr double residual_floor = 30;  // times the required residual is accepted if round-off stops the descent

class Newton {
 public:
  Newton(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough,
         std::function<double()> uncertain = {})
      : system_(system), uncertain_(std::move(uncertain)), x_(guess), enough_(enough) {}

  NewtonOutcome run() {
    if (evaluate(x_, true)) iterate();
    return std::move(out_);
  }

 private:
  enum class Progress { made, floor, ended };

  bool evaluate(const Eigen::VectorXd& x, bool with_derivative) {
    ++out_.evaluations;
    if (with_derivative) ++out_.derivatives;
    last_ = x;
    last_with_derivative_ = with_derivative;
    Eigen::MatrixXd derivative;
    valid_ = system_.evaluate(x, residual_, with_derivative ? &derivative : nullptr);
    if (!valid_) return false;
    out_.residual = norm_ = residual_.cwiseAbs().maxCoeff();
    if (with_derivative) {
      at_ = x;
      factorise(derivative);
    }
    return true;
  }

  // If r has a family and does not leave its member, the member is kept: [A Q; Qᵀ 0].
  void factorise(const Eigen::MatrixXd& derivative) {
    const Eigen::Index n = derivative.rows();
    const std::optional<Family> family = uncertain_ ? family_of(derivative, uncertain_()) : std::optional<Family>();
    const Eigen::MatrixXd kept =
        family ? family->kept(residual_, std::max(enough_, norm_ * norm_)).quantity : Eigen::MatrixXd(n, 0);
    kept_ = kept.cols();
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + kept_, n + kept_);
    bordered.topLeftCorner(n, n) = derivative;
    bordered.topRightCorner(n, kept_) = kept;
    bordered.bottomLeftCorner(kept_, n) = kept.transpose();
    solver_ = Lu(bordered);
  }
  Eigen::VectorXd correction(const Eigen::VectorXd& residual) const {
    Eigen::VectorXd bordered = Eigen::VectorXd::Zero(residual.size() + kept_);
    bordered.head(residual.size()) = residual;
    return solver_.solve(bordered).head(residual.size());
  }

  void iterate() {
    while ((norm_ > enough_ || correction(residual_).cwiseAbs().maxCoeff() > enough_) &&
           out_.evaluations < most_periods && out_.derivatives < most_derivatives) {
      const Progress progress = advance(-correction(residual_));
      if (progress == Progress::ended) return;
      if (progress == Progress::floor) break;
    }
    out_.residual = norm_;
    if (norm_ <= residual_floor * enough_) return finish();
    out_.why = fmt::format(
        "the search failed, which does not say that there is none: Newton's iteration does not settle (residual {:.1e} "
        "of the rated values after {} cycles)",
        norm_, out_.evaluations);
  }

  // Large steps lead to other states: changes are limited to half of the largest value.
  Eigen::VectorXd limited(Eigen::VectorXd step) const {
    const double longest = 0.5 * std::max(system_.magnitude, x_.cwiseAbs().maxCoeff()),
                 length = step.cwiseAbs().maxCoeff();
    if (!(length < HUGE_VAL)) return residual_;
    if (length > longest) step *= longest / length;
    return step;
  }

  // One step, halved until it is accepted; with a reused derivative only the whole step is tried. The criterion is the next
  // correction with the same derivative, not the residual, which has no common scale of soft and stiff directions (natural
  // monotonicity: Deuflhard, Newton Methods for Nonlinear Problems, 2011).
  Progress advance(const Eigen::VectorXd& whole) {
    const Eigen::VectorXd from = x_, residual_from = residual_, step = limited(whole);
    const double norm_from = norm_, wanted = whole.cwiseAbs().maxCoeff();
    const double length = std::isfinite(wanted) ? wanted : step.cwiseAbs().maxCoeff();
    const double taken = step.cwiseAbs().maxCoeff() / length;  // of what Newton would have
    const bool fresh = at_ == x_;
    for (double part = 1; part > 0.02; part *= 0.5) {
      const Eigen::VectorXd trial = from + part * step;
      if (evaluate(trial, false)) {
        const double contraction = correction(residual_).cwiseAbs().maxCoeff() / length;
        if (contraction < 1 - 0.25 * part * taken) {
          x_ = trial;
          if (norm_ <= enough_ || keep_derivative(contraction)) return Progress::made;
          return evaluate(x_, true) ? Progress::made : Progress::ended;
        }
      }
      if (system_.stopped && system_.stopped()) return Progress::ended;
      if (out_.evaluations >= most_periods) break;
      if (!fresh || norm_from <= residual_floor * enough_) break;
    }
    x_ = from;
    residual_ = residual_from;
    norm_ = norm_from;
    if (norm_ <= residual_floor * enough_) return Progress::floor;  // round-off: nothing shrinks any more
    if (fresh) {                                                    // no descent by Newton: integrate further
      if (!system_.run_on || ++run_on_ > most_run_on) return Progress::floor;
      x_ = from + residual_from;
    }
    return evaluate(x_, true) ? Progress::made : Progress::ended;
  }

  // Reused while the remaining iterations with it cost less than a new one.
  bool keep_derivative(double contraction) const {
    if (contraction >= 0.9) return false;
    return std::log(std::max(norm_ / enough_, 1.0)) / -std::log(contraction) <= system_.derivative_cost + 1;
  }

  // The derivative at the solution, for the multipliers; the last trial may have been elsewhere.
  void finish() {
    if (at_ != x_) {
      x_ += limited(-correction(residual_));
      if (!evaluate(x_, true)) return;
    } else if (!last_with_derivative_ || last_ != x_) {
      if (!evaluate(x_, true)) return;
    }
    out_.found = true;
    out_.x = x_;
    out_.residual = norm_;
  }

  const NewtonSystem& system_;
  std::function<double()> uncertain_;  // entries of the derivative; empty: no family is looked for
  Eigen::VectorXd x_, at_, residual_, last_;
  Lu solver_;
  NewtonOutcome out_;
  double enough_, norm_ = 0;
  int run_on_ = 0;
  Eigen::Index kept_ = 0;  // quantities of a family
  bool valid_ = false, last_with_derivative_ = false;
};

}  // namespace

NewtonOutcome solve(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough) {
  return Newton(system, guess, enough).run();
}

NewtonOutcome solve_in_family(const NewtonSystem& system, const Eigen::VectorXd& guess, double enough,
                              std::function<double()> uncertain) {
  return Newton(system, guess, enough, std::move(uncertain)).run();
}

}  // namespace kurbel
