// held_speeds.cpp — Newton's method on the return map and the given speeds together.
#include "engine/orbit/held_speeds.h"

#include <fmt/format.h>

#include "engine/numerics/deadline.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class HeldSearch {
 public:
  HeldSearch(const HeldSpeeds& held, const ReturnMap& like, const OrbitOptions& options, HeldMotion& out)
      : held_(held), like_(like), options_(map_options(options)), n_(static_cast<Index>(like.size())), out_(out) {}

  void run(const VectorXd& guess) {
    const Index beside = guess.size() - first_beside();
    NewtonSystem system;
    system.evaluate = [this](const VectorXd& x, VectorXd& residual, MatrixXd* derivative) {
      return derivative ? round_with_derivative(x, residual, *derivative) : round(x, false, residual);
    };
    system.stopped = [this] { return out_.last.end == ReturnMap::End::interrupted; };
    system.derivative_cost = static_cast<double>(beside) + (held_.by_differences ? 1.0 : like_.derivative_cost());
    system.magnitude = held_.magnitude;
    out_.newton = solve(system, guess, held_.enough);
    conclude();
  }

 private:
  // Difference quotients for all unknowns from this one on.
  Index first_beside() const { return held_.slope ? n_ : 0; }

  bool round(const VectorXd& x, bool with_derivative, VectorXd& residual) {
    Deadline::check();
    ReturnMap::Image& last = out_.last;
    if (out_.cost > held_.most_cost) {
      last.end = ReturnMap::End::interrupted;
      last.why = fmt::format("no cycle was found within {:.0f} cycles of simulation", out_.cost);
      return false;
    }
    ReturnMap map(held_.machine(x.tail(x.size() - n_)), options_);
    map.follow(like_);
    if (effort_ > 0) map.limit_effort(effort_);
    last = map.image(x.head(n_), with_derivative, {held_.record(map.model())});
    if (last.end == ReturnMap::End::returned) effort_ = map.effort();
    out_.cost += map.cost();
    if (last.end != ReturnMap::End::returned) {
      Deadline::check();  // which may also have ended the period
      if (last.end != ReturnMap::End::failed) out_.broken = last.why;
      return false;
    }
    residual.resize(x.size());
    residual << last.z - x.head(n_), held_.miss(last);
    return true;
  }

  bool round_with_derivative(const VectorXd& x, VectorXd& residual, MatrixXd& derivative) {
    constexpr double step = 1e-5;  // of unknowns of order one
    MatrixXd beside(x.size(), x.size());
    for (Index j = first_beside(); j < x.size(); ++j) {
      VectorXd value;
      if (!round(x + step * VectorXd::Unit(x.size(), j), false, value)) return false;
      beside.col(j) = value;
    }
    if (!round(x, !held_.by_differences, residual)) return false;
    derivative = (beside.colwise() - residual) / step;
    if (!held_.by_differences) derivative.topLeftCorner(n_, n_) = out_.last.derivative - MatrixXd::Identity(n_, n_);
    if (held_.slope) derivative.bottomLeftCorner(x.size() - n_, n_) = held_.slope(out_.last);
    out_.derivative = derivative;
    return true;
  }

  void conclude() {
    Orbit& orbit = out_.orbit = {};
    const NewtonOutcome& newton = out_.newton;
    orbit.cost = out_.cost;
    orbit.point.periods = newton.evaluations;
    orbit.point.derivatives = newton.derivatives;
    orbit.point.residual = newton.residual;
    orbit.words = out_.last.end != ReturnMap::End::returned ? out_.last.why : newton.why;
    if (!newton.found) {
      if (out_.last.end == ReturnMap::End::interrupted) orbit.kind = Orbit::Kind::interrupted;
      return;
    }
    orbit.point.take(newton.x.head(n_), out_.last);
    if (!orbit.point.found) {
      orbit.words = orbit.point.why;
      return;
    }
    orbit.kind = Orbit::Kind::cycle;
    orbit.polished = true;
    out_.by = newton.x.tail(newton.x.size() - n_);
    orbit.map = std::make_shared<ReturnMap>(held_.machine(out_.by), options_);
    orbit.map->follow(like_);
  }

  const HeldSpeeds& held_;
  const ReturnMap& like_;
  std::int64_t effort_ = 0;  // evaluations in a trial at most, by those that returned; 0: none has
  ReturnMapOptions options_;
  Index n_;  // of z
  HeldMotion& out_;
};

}  // namespace

void find_held_orbit(const HeldSpeeds& held, const ReturnMap& like, const VectorXd& guess, const OrbitOptions& options,
                     HeldMotion& motion) {
  HeldSearch(held, like, options, motion).run(guess);
}

}  // namespace kurbel
