// forced_response.cpp — one complex solve an order; the sum synthesised over the cycle and its peak located.
#include "studies/modes/forced_response.h"

#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace kurbel {
namespace {

using Eigen::Index;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

constexpr Index small_drive = 24;  // coordinates: dense

// Value, slope and curvature of Re Σ x_r e^{irs}.
struct Local {
  double value = 0, slope = 0, curvature = 0;
};
Local sum_at(const std::vector<Complex>& x, double s) {
  Local sum;
  for (std::size_t r = 1; r < x.size(); ++r) {
    const double n = static_cast<double>(r);
    const Complex term = x[r] * std::polar(1.0, n * s);
    sum.value += term.real();
    sum.slope -= n * term.imag();
    sum.curvature -= n * n * term.real();
  }
  return sum;
}

// Newton on the slope, kept within the sample's neighbours.
double polished(const std::vector<Complex>& x, double begin, double step) {
  double s = begin;
  for (int i = 0; i < 20; ++i) {
    const Local here = sum_at(x, s);
    if (here.curvature == 0) break;
    const double move = -here.slope / here.curvature;
    if (!(std::abs(s + move - begin) <= step)) break;
    s += move;
    if (std::abs(move) < 1e-14) break;
  }
  return sum_at(x, s).value;
}

}  // namespace

struct FrequencyResponse::Solver {
  Eigen::MatrixXcd dense_stiffness, dense_damping;
  ComplexSparse stiffness, damping, mass;
  Eigen::SparseLU<ComplexSparse> lu;
  bool analysed = false;
};

FrequencyResponse::FrequencyResponse(const LinearDrive& drive) : drive_(drive), solver_(std::make_shared<Solver>()) {
  const Index n = drive.size();
  SparseMatrix k = drive.stiffness;
  if (drive.angle_stiffness.nonZeros() > 0) k += drive.angle_stiffness;
  if (n <= small_drive) {
    solver_->dense_stiffness = Eigen::MatrixXd(k).cast<Complex>();
    solver_->dense_damping = Eigen::MatrixXd(drive.damping).cast<Complex>();
    return;
  }
  solver_->stiffness = k.cast<Complex>();
  solver_->damping = drive.damping.cast<Complex>();
  solver_->mass = ComplexSparse(n, n);
  solver_->mass.setIdentity();
  for (Index i = 0; i < n; ++i) solver_->mass.coeffRef(i, i) = drive.inertia[i];
}

Eigen::VectorXcd FrequencyResponse::motion(double omega, const Eigen::VectorXcd& force) {
  Solver& s = *solver_;
  const Complex iw(0, omega);
  if (drive_.size() <= small_drive) {
    Eigen::MatrixXcd a = s.dense_stiffness + iw * s.dense_damping;
    a.diagonal() -= omega * omega * drive_.inertia.cast<Complex>();
    return a.partialPivLu().solve(force);
  }
  ComplexSparse a = s.stiffness + iw * s.damping;
  a -= omega * omega * s.mass;
  a.makeCompressed();
  if (!s.analysed) s.lu.analyzePattern(a);
  s.analysed = true;
  s.lu.factorize(a);
  if (s.lu.info() != Eigen::Success) return Eigen::VectorXcd::Constant(drive_.size(), Complex(HUGE_VAL, 0));
  return s.lu.solve(force);
}

std::vector<Complex> FrequencyResponse::torques(double omega, const Eigen::VectorXcd& force) {
  const Eigen::VectorXcd q = motion(omega, force);
  std::vector<Complex> tau;
  for (const LinearDrive::Joint& j : drive_.joints) {
    const Complex theta = (j.a >= 0 ? j.gain_a * q[j.a] : 0.0) - (j.b >= 0 ? j.gain_b * q[j.b] : 0.0);
    tau.push_back(Complex(j.stiffness, omega * j.damping) * theta);
  }
  return tau;
}

Extremes extremes_of_sum(const std::vector<Complex>& x) {
  for (const Complex& c : x)
    if (!std::isfinite(c.real()) || !std::isfinite(c.imag())) return {HUGE_VAL, -HUGE_VAL};
  std::size_t n = 64;
  while (n < 8 * x.size()) n *= 2;
  // Re Σ x_r e^{2πi rk/n}
  std::vector<Complex> spectrum(n, Complex{}), sum;
  for (std::size_t r = 1; r < x.size(); ++r) spectrum[r] = x[r];
  Eigen::FFT<double> fft;
  fft.inv(sum, spectrum);
  const double scale = static_cast<double>(n), step = 2 * std::numbers::pi / scale;
  Extremes found;
  for (std::size_t k = 0; k < n; ++k) {
    const double before = sum[(k + n - 1) % n].real(), here = sum[k].real(), after = sum[(k + 1) % n].real();
    const double value = scale * here, margin = 0.25 * std::abs(value);
    const bool top = here >= before && here >= after, bottom = here <= before && here <= after;
    if (top && value + margin >= found.greatest)
      found.greatest = std::max({found.greatest, value, polished(x, step * static_cast<double>(k), step)});
    if (bottom && value - margin <= found.least)
      found.least = std::min({found.least, value, polished(x, step * static_cast<double>(k), step)});
  }
  return found;
}

SpeedResponse respond(const LinearDrive& drive, const Excitations& excitations) {
  FrequencyResponse response(drive);
  SpeedResponse result;
  result.speed = drive.at.speed;
  const double speed = std::abs(drive.at.speed);
  result.joints.resize(drive.joints.size());
  result.orders.assign(drive.joints.size(), std::vector<Complex>(excitations.harmonics + 1));
  const auto count = [&](std::size_t j, Complex tau, double omega, std::size_t harmonic) {
    JointResponse& joint = result.joints[j];
    const double amplitude = std::abs(tau);
    joint.amplitude_sum += amplitude;
    joint.rms += 0.5 * amplitude * amplitude;
    const LinearDrive::Joint& data = drive.joints[j];
    const double twist = amplitude / std::abs(Complex(data.stiffness, omega * data.damping));
    joint.power += 0.5 * data.damping * std::pow(omega * twist, 2);
    if (amplitude <= joint.dominant_amplitude) return;
    joint.dominant_amplitude = amplitude;
    joint.dominant = harmonic;
    joint.dominant_omega = omega;
  };
  for (std::size_t r = 1; r <= excitations.harmonics && !excitations.by_order.empty(); ++r) {
    Eigen::VectorXcd force = Eigen::VectorXcd::Zero(drive.size());
    for (const OrderSource& source : excitations.by_order) force[source.coordinate] += source.at(r, drive.at.speed);
    const double omega = excitations.order(r) * speed;
    const std::vector<Complex> tau = response.torques(omega, force);
    for (std::size_t j = 0; j < tau.size(); ++j) count(j, result.orders[j][r] = tau[j], omega, r);
  }
  std::vector<double> beside(drive.joints.size(), 0.0);
  // Torques of one frequency keep their phases.
  std::vector<FrequencySource> sources = excitations.by_frequency;
  std::sort(sources.begin(), sources.end(),
            [](const FrequencySource& a, const FrequencySource& b) { return a.omega < b.omega; });
  for (std::size_t i = 0; i < sources.size();) {
    Eigen::VectorXcd force = Eigen::VectorXcd::Zero(drive.size());
    const double omega = sources[i].omega;
    for (; i < sources.size() && sources[i].omega == omega; ++i) force[sources[i].coordinate] += sources[i].amplitude;
    const std::vector<Complex> tau = response.torques(omega, force);
    for (std::size_t j = 0; j < tau.size(); ++j) {
      count(j, tau[j], omega, 0);
      beside[j] += std::abs(tau[j]);
    }
  }
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    JointResponse& joint = result.joints[j];
    const Extremes swing = extremes_of_sum(result.orders[j]);
    joint.mean = drive.joints[j].torque;
    joint.upper = joint.mean + swing.greatest + beside[j];
    joint.lower = joint.mean + swing.least - beside[j];
    joint.peak = std::max(swing.greatest, -swing.least) + beside[j];
    joint.rms = std::sqrt(joint.rms);
  }
  return result;
}

}  // namespace kurbel
