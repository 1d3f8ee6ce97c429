// forced_response.cpp — one complex solution per order; the sum is synthesised over the cycle and its peak located.
#include "studies/response/forced_response.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "engine/linear/eigen_modes.h"
#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

using Eigen::Index;

constexpr Index small_drive = 24;  // coordinates: dense

// Value, slope and curvature of Re Σ x_r e^{irs}.
struct Local {
  double value = 0, slope = 0, curvature = 0;
};
Local sum_at(const std::vector<Complex>& x, double s) {
  Local sum;
  const Complex turn = std::polar(1.0, s);
  Complex phase = turn;  // e^{irs}, to r times the rounding of one
  for (std::size_t r = 1; r < x.size(); ++r, phase *= turn) {
    const double n = static_cast<double>(r);
    const Complex term = x[r] * phase;
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
    if (std::abs(move) < 1e-9 * step) break;  // the value is off by the square of it
  }
  return sum_at(x, s).value;
}

}  // namespace

// (K + iω C − ω² M) [q; z] = right, over coordinates and internal states together.
struct FrequencyResponse::Solver : QuadraticPencil {
  Eigen::MatrixXcd dense_stiffness, dense_damping, dense_mass;
  ComplexSparseLu lu;

  Eigen::VectorXcd solve(double omega, const Eigen::VectorXcd& right) {
    const Complex iw(0, omega);
    if (right.size() <= small_drive)
      return ComplexLu(dense_stiffness + iw * dense_damping - omega * omega * dense_mass).solve(right);
    ComplexSparseMatrix a = stiffness + iw * damping - omega * omega * mass;
    a.makeCompressed();
    if (!lu.factorise(a)) return Eigen::VectorXcd::Constant(right.size(), Complex(HUGE_VAL, 0));
    return lu.solve(right);
  }
};

FrequencyResponse::FrequencyResponse(const LinearDrive& drive) : drive_(drive), solver_(std::make_shared<Solver>()) {
  static_cast<QuadraticPencil&>(*solver_) = pencil_of(drive);
  if (drive.size() + drive.internal_states() > small_drive) return;
  solver_->dense_stiffness = solver_->stiffness, solver_->dense_damping = solver_->damping;
  solver_->dense_mass = solver_->mass;
}

std::optional<LinearDrive> as_if_rigid(LinearDrive drive) {
  constexpr double stiffer = 1e6;
  const bool springs_alone = std::all_of(drive.joints.begin(), drive.joints.end(), [](const LinearDrive::Joint& joint) {
    return joint.state == LinearDrive::Joint::State::spring && joint.stiffness > 0;
  });
  if (!springs_alone || drive.other_stiffness.nonZeros() > 0 || drive.internal_by_twist.nonZeros() > 0) return {};
  drive.stiffen(stiffer);
  return drive;
}

Forcing Forcing::none(const LinearDrive& drive) {
  const auto joints = static_cast<Index>(drive.joints.size());
  return {Eigen::VectorXcd::Zero(drive.size()), Eigen::VectorXcd::Zero(drive.internal_states()),
          Eigen::VectorXcd::Zero(joints), Eigen::VectorXcd::Zero(joints)};
}

void Forcing::add(LeftOver kind, int index, Complex amplitude) {
  Eigen::VectorXcd& to = kind == LeftOver::torque          ? torque
                         : kind == LeftOver::internal_rate ? own
                         : kind == LeftOver::twist         ? twist
                                                           : joint_torque;
  to[index] += amplitude;
}

FrequencyResponse::Motion FrequencyResponse::motion(double omega, const Forcing& f) {
  const Index n = drive_.size(), z = drive_.internal_states();
  Eigen::VectorXcd right(n + z);
  right << f.torque + drive_.torque_by_twist * f.twist, f.own;
  if (z > 0) right.tail(z) += drive_.internal_by_twist * f.twist;
  const Eigen::VectorXcd x = solver_->solve(omega, right);
  return {x.head(n), x.tail(z)};
}

std::vector<FrequencyResponse::JointVibration> FrequencyResponse::vibrations(double omega, const Forcing& f) {
  return vibrations(omega, f, motion(omega, f));
}

std::vector<FrequencyResponse::JointVibration> FrequencyResponse::vibrations(double omega, const Forcing& f,
                                                                             const Motion& x) const {
  const Eigen::VectorXcd twist = drive_.twists * x.q + f.twist;
  Eigen::VectorXcd torque = f.joint_torque + Complex(0, omega) * (drive_.joint_by_speed * x.q);
  if (x.own.size() > 0) torque += drive_.joint_by_internal * x.own;
  torque += drive_.spring_torques(twist);
  std::vector<JointVibration> all;
  for (Index j = 0; j < twist.size(); ++j) all.push_back({torque[j], twist[j]});
  for (const TorqueJoint& joint : drive_.model->torque_joints)
    if (joint.elastic >= 0) all[at(joint.elastic)].torque = joint.reported(torque.data(), joint.elastic);
  return all;
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
  for (const Complex& here : sum)
    found = {std::max(found.greatest, scale * here.real()), std::min(found.least, scale * here.real())};
  // Eight samples a wave of the highest order or more: beside a sample that is a crest the sum is nearly a parabola, and
  // rises by an eighth of the second difference at most; of a single wave by a seventh. A half is on the safe side.
  for (std::size_t k = 0; k < n; ++k) {
    const double before = sum[(k + n - 1) % n].real(), here = sum[k].real(), after = sum[(k + 1) % n].real();
    const double rise = 0.5 * std::abs(2 * here - before - after);
    const bool top = here >= before && here >= after && scale * (here + rise) >= found.greatest,
               bottom = here <= before && here <= after && scale * (here - rise) <= found.least;
    if (!top && !bottom) continue;
    Deadline::check();
    const double value = polished(x, step * static_cast<double>(k), step);
    if (top) found.greatest = std::max(found.greatest, value);
    if (bottom) found.least = std::min(found.least, value);
  }
  return found;
}

namespace {

// Dissipation of joints at one frequency: by their damping, or with internal states by their total work.
std::vector<double> dissipated(const LinearDrive& drive,
                               const std::vector<FrequencyResponse::JointVibration>& vibrations, double omega) {
  Eigen::VectorXcd rate(static_cast<Index>(vibrations.size()));
  for (std::size_t j = 0; j < vibrations.size(); ++j)
    rate[static_cast<Index>(j)] = Complex(0, omega) * vibrations[j].twist;
  const Eigen::VectorXcd damper = drive.damper_torques(rate);
  std::vector<double> power;
  for (std::size_t j = 0; j < vibrations.size(); ++j) {
    const auto i = static_cast<Index>(j);
    const bool states = drive.internal_states() > 0 && drive.joint_by_internal.row(i).norm() > 0;
    power.push_back(0.5 * ((states ? vibrations[j].torque : damper[i]) * std::conj(rate[i])).real());
  }
  return power;
}

// Adds the contribution of one frequency to one joint.
void count(JointResponse& joint, const FrequencyResponse::JointVibration& vibration, double power, double omega,
           std::size_t harmonic) {
  const double amplitude = std::abs(vibration.torque);
  joint.amplitude_sum += amplitude;
  joint.rms += 0.5 * amplitude * amplitude;
  joint.power += power;
  if (amplitude <= joint.dominant_amplitude) return;
  joint.dominant_amplitude = amplitude;
  joint.dominant = harmonic;
  joint.dominant_omega = omega;
}

// The reduction link's speed as a row of the coordinates' speeds; empty if it is prescribed.
Eigen::VectorXcd row_of_link(const LinearDrive& drive) {
  const Model& m = *drive.model;
  const int link = m.shaft_of_node[static_cast<std::size_t>(m.reduction_node)];
  const auto found = std::find(drive.shaft.begin(), drive.shaft.end(), link);
  if (found == drive.shaft.end()) return {};
  const auto row = static_cast<Index>(found - drive.shaft.begin());
  const double ratio = drive.ratio[static_cast<std::size_t>(row)];
  Eigen::VectorXcd link_row = Eigen::VectorXd(drive.motion.row(row).transpose()).cast<Complex>();
  return ratio != 0 ? Eigen::VectorXcd(link_row / ratio) : link_row;
}

// A joint without mean torque, such as a damper's ring, has only rounding errors of the others' torques.
void clear_noise(SpeedResponse& response) {
  constexpr double noise = 1e-10;
  double largest = 0;
  for (const JointResponse& joint : response.joints) largest = std::max({largest, std::abs(joint.mean), joint.peak});
  for (JointResponse& joint : response.joints)
    if (std::abs(joint.mean) <= noise * largest) joint.mean = 0;
}

}  // namespace

SpeedResponse respond(const LinearDrive& drive, const Excitations& excitations) {
  FrequencyResponse response(drive);
  SpeedResponse result;
  result.speed = drive.at.speed;
  const double speed = std::abs(drive.at.speed);
  const std::vector<OrderSource>& by_order = excitations.at_speed(drive.at.speed);
  result.joints.resize(drive.joints.size());
  result.orders.assign(drive.joints.size(), std::vector<Complex>(excitations.harmonics + 1));
  const Eigen::VectorXcd link = row_of_link(drive);
  std::vector<Complex> speeds(excitations.harmonics + 1);
  for (std::size_t r = 1; r <= excitations.harmonics && !by_order.empty() && speed > 0; ++r) {
    if (!excitations.is_looked_at(r)) continue;
    Deadline::check();
    Forcing forcing = Forcing::none(drive);
    for (const OrderSource& source : by_order) forcing.add(source.kind, source.index, source.at(r, drive.at.speed));
    const double omega = excitations.order(r) * speed;
    const FrequencyResponse::Motion motion = response.motion(omega, forcing);
    if (link.size() > 0) speeds[r] = Complex(0, omega) * link.conjugate().dot(motion.q);
    const auto vibrations = response.vibrations(omega, forcing, motion);
    const std::vector<double> power = dissipated(drive, vibrations, omega);
    for (std::size_t j = 0; j < vibrations.size(); ++j) {
      result.orders[j][r] = vibrations[j].torque;
      count(result.joints[j], vibrations[j], power[j], omega, r);
    }
  }
  if (const Extremes vibration = extremes_of_sum(speeds); std::isfinite(vibration.greatest))
    result.speed_amplitude = std::max(vibration.greatest, -vibration.least);
  else
    result.speed_amplitude = HUGE_VAL;
  std::vector<double> beside(drive.joints.size(), 0.0);
  // Excitations of one frequency keep their phases.
  std::vector<FrequencySource> sources = excitations.by_frequency;
  std::sort(sources.begin(), sources.end(),
            [](const FrequencySource& a, const FrequencySource& b) { return a.omega < b.omega; });
  for (std::size_t i = 0; i < sources.size();) {
    Forcing forcing = Forcing::none(drive);
    const double omega = sources[i].omega;
    for (; i < sources.size() && sources[i].omega == omega; ++i)
      forcing.add(sources[i].kind, sources[i].index, sources[i].amplitude);
    const auto vibrations = response.vibrations(omega, forcing);
    const std::vector<double> power = dissipated(drive, vibrations, omega);
    for (std::size_t j = 0; j < vibrations.size(); ++j) {
      count(result.joints[j], vibrations[j], power[j], omega, 0);
      beside[j] += std::abs(vibrations[j].torque);
    }
  }
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    JointResponse& joint = result.joints[j];
    const Extremes vibration = extremes_of_sum(result.orders[j]);
    joint.mean = drive.joints[j].torque;
    joint.upper = joint.mean + vibration.greatest + beside[j];
    joint.lower = joint.mean + vibration.least - beside[j];
    joint.peak = std::max(vibration.greatest, -vibration.least) + beside[j];
    joint.rms = std::sqrt(joint.rms);
  }
  clear_noise(result);
  return result;
}

SpeedResponse response_of_samples(const std::vector<std::vector<double>>& torques, double speed, double round) {
  SpeedResponse result;
  result.speed = speed;
  for (const std::vector<double>& samples : torques) {
    JointResponse joint;
    const std::vector<Complex> orders = harmonics_of(samples);
    joint.mean = orders.front().real();
    joint.upper = *std::max_element(samples.begin(), samples.end());
    joint.lower = *std::min_element(samples.begin(), samples.end());
    joint.peak = std::max(joint.upper - joint.mean, joint.mean - joint.lower);
    double square = 0;
    for (const double v : samples) square += (v - joint.mean) * (v - joint.mean);
    joint.rms = std::sqrt(square / static_cast<double>(samples.size()));
    for (std::size_t r = 1; r < orders.size(); ++r) {
      const double amplitude = std::abs(orders[r]);
      joint.amplitude_sum += amplitude;
      if (amplitude <= joint.dominant_amplitude) continue;
      joint.dominant_amplitude = amplitude;
      joint.dominant = r;
      joint.dominant_omega = 2 * std::numbers::pi * static_cast<double>(r) / round;
    }
    result.joints.push_back(joint);
    result.orders.push_back(orders);
  }
  clear_noise(result);
  return result;
}

}  // namespace kurbel
