// slider_crank_dynamics.cpp — what is free, energies and powers, and the outputs of the slider-crank that deforms.
#include "mechanisms/deforming/slider_crank_dynamics.h"

#include <algorithm>
#include <utility>

#include "engine/base/gauss.h"

namespace kurbel {

SliderCrankDynamics::SliderCrankDynamics(const SliderCrankData& data, std::vector<JointClearance> clearances,
                                         const std::optional<RodFlexibility>& rod, bool weightless)
    : data_(data), clearances_(std::move(clearances)) {
  if (rod) rod_ = RodModes(*rod, data.rod_length, data.rod_mass);
  if (!weightless) {
    weight_x_ = -data.gravity * std::sin(data.stroke_angle);
    weight_y_ = -data.gravity * std::cos(data.stroke_angle);
  }
  free_.push_back(phi);
  const auto add = [&](Coordinate first) {
    free_.push_back(first);
    free_.push_back(first + 1);
  };
  for (std::size_t k = 0; k < clearances_.size(); ++k) {
    const JointClearance& c = clearances_[k];
    switch (c.joint) {
      case JointClearance::Joint::crank_pin:
        add(e_x);
        break;
      case JointClearance::Joint::wrist_pin:
        add(f_x);
        break;
      case JointClearance::Joint::guide:
        add(y);
        slider_inertia_ = c.slider_inertia;
    }
    if (c.joint != JointClearance::Joint::guide)
      contacts_.push_back({k, -1});
    else
      for (int corner = 0; corner < 4; ++corner) contacts_.push_back({k, corner});
  }
  for (int i = 0; i < rod_.count(); ++i) free_.push_back(first_amplitude + static_cast<std::size_t>(i));
}

SliderCrankDynamics::Approach SliderCrankDynamics::approach(std::size_t contact,
                                                            const SliderCrankMotion<double>& m) const {
  const Touch<double> t = touch(m, contact);
  return {t.depth, t.rate};
}

SliderCrankDynamics::Vector SliderCrankDynamics::inertia_column(const SliderCrankMotion<double>& m,
                                                                std::size_t coordinate) const {
  BodyAcceleration<double> a;
  if (coordinate == phi) a.a_x = -data_.radius * m.sin_phi, a.a_y = data_.radius * m.cos_phi;
  if (coordinate == e_x) a.a_x = 1;
  if (coordinate == e_y) a.a_y = 1;
  a.beta = m.of_beta[coordinate];
  if (coordinate >= first_amplitude) a.amplitude[coordinate - first_amplitude] = 1;
  BodyForce<double> f;
  inertia_of_rod(m, a, false, f);
  if (coordinate == phi) f.crank = data_.crank_inertia;
  f.slider_x = data_.slider_mass * m.of_x[coordinate];
  if (coordinate == y) f.slider_y = data_.slider_mass;
  if (coordinate == tilt) f.slider_turn = slider_inertia_;
  return project(m, f);
}

double SliderCrankDynamics::kinetic_energy(const SliderCrankMotion<double>& m) const {
  double sum = 0;
  for (const std::size_t k : free_) {
    if (m.w[k] == 0) continue;
    const Vector column = inertia_column(m, k);
    for (const std::size_t i : free_) sum += 0.5 * m.w[i] * column[i] * m.w[k];
  }
  return sum;
}

// The rod by Gauss's rule over pieces, from the velocities of its points; what is not prismatic as a rigid body.
double SliderCrankDynamics::kinetic_energy_of_points(const SliderCrankMotion<double>& m) const {
  constexpr int pieces = 8;
  const double l = data_.rod_length, r = data_.radius;
  const double vx = -r * m.sin_phi * m.w[phi] + m.w[e_x], vy = r * m.cos_phi * m.w[phi] + m.w[e_y];
  const double along = m.cos_beta * vx + m.sin_beta * vy, across = m.cos_beta * vy - m.sin_beta * vx;
  double prismatic = 0;
  if (amplitudes() > 0)
    for (int piece = 0; piece < pieces; ++piece)
      gauss<6>.over(static_cast<double>(piece) / pieces, 1.0 / pieces, [&](double xi, double weight) {
        double u = 0, w = 0, u_rate = 0, w_rate = 0;
        for (int i = 0; i < amplitudes(); ++i) {
          const std::size_t at = first_amplitude + static_cast<std::size_t>(i);
          (i < rod_.bending ? w : u) += rod_.shape(i, xi) * m.z[at];
          (i < rod_.bending ? w_rate : u_rate) += rod_.shape(i, xi) * m.w[at];
        }
        const double p = along + u_rate - m.beta_rate * w, q = across + w_rate + m.beta_rate * (xi * l + u);
        prismatic += 0.5 * weight * l * rod_.mass_per_length * (p * p + q * q);
      });
  const double counted = amplitudes() > 0 ? data_.rod_mass : 0;
  const double mass = data_.rod_mass - counted, moment = data_.rod_mass * data_.rod_com - counted * l / 2;
  const double inertia = data_.rod_inertia + data_.rod_mass * data_.rod_com * data_.rod_com - counted * l * l / 3;
  const double turn = m.beta_rate;
  double sum = prismatic + 0.5 * mass * (vx * vx + vy * vy) + moment * turn * across + 0.5 * inertia * turn * turn;
  sum += 0.5 * data_.crank_inertia * m.w[phi] * m.w[phi];
  sum += 0.5 * data_.slider_mass * (m.x_rate * m.x_rate + m.w[y] * m.w[y]);
  return sum + 0.5 * slider_inertia_ * m.w[tilt] * m.w[tilt];
}

double SliderCrankDynamics::elastic_energy(const SliderCrankMotion<double>& m) const {
  const auto n = static_cast<std::size_t>(amplitudes());
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      sum += 0.5 * m.z[first_amplitude + i] * rod_.stiffness[i][k] * m.z[first_amplitude + k];
  return sum;
}

double SliderCrankDynamics::damping_power(const SliderCrankMotion<double>& m) const {
  const auto n = static_cast<std::size_t>(amplitudes());
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) sum += m.w[first_amplitude + i] * rod_.damping[i][k] * m.w[first_amplitude + k];
  return sum;
}

double SliderCrankDynamics::contact_energy(const SliderCrankMotion<double>& m, const int* contact_mode) const {
  double sum = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (contact_mode[c] != JointContact::flight)
      sum += clearances_[contacts_[c].clearance].contact.stored(contact_mode[c], touch(m, c).depth);
  return sum;
}

double SliderCrankDynamics::contact_loss_power(const SliderCrankMotion<double>& m, const int* contact_mode) const {
  double sum = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (contact_mode[c] == JointContact::flight) continue;
    const JointContact& law = clearances_[contacts_[c].clearance].contact;
    const Touch<double> t = touch(m, c);
    const double normal = law.normal(contact_mode[c], t.depth, t.rate);
    const double elastic = t.depth > 0 ? law.elastic(t.depth) : 0;
    sum += (normal - elastic) * t.rate + law.tangential(normal, t.sliding) * t.sliding;
  }
  return sum;
}

double SliderCrankDynamics::weight_power(const SliderCrankMotion<double>& m) const {
  const double r = data_.radius, mass = data_.rod_mass, mu = rod_.mass_per_length;
  double s1 = mass * data_.rod_com, s2 = 0, s1_rate = 0, s2_rate = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(amplitudes()); ++i) {
    s1 += mu * rod_.along[i] * m.z[first_amplitude + i], s2 += mu * rod_.across[i] * m.z[first_amplitude + i];
    s1_rate += mu * rod_.along[i] * m.w[first_amplitude + i];
    s2_rate += mu * rod_.across[i] * m.w[first_amplitude + i];
  }
  const double along = s1_rate - m.beta_rate * s2, across = s2_rate + m.beta_rate * s1;
  const double crank = data_.crank_mass * data_.crank_com;
  const double px = mass * (-r * m.sin_phi * m.w[phi] + m.w[e_x]) + m.cos_beta * along - m.sin_beta * across +
                    data_.slider_mass * m.x_rate - crank * m.sin_phi * m.w[phi];
  const double py = mass * (r * m.cos_phi * m.w[phi] + m.w[e_y]) + m.sin_beta * along + m.cos_beta * across +
                    data_.slider_mass * m.w[y] + crank * m.cos_phi * m.w[phi];
  return weight_x_ * px + weight_y_ * py;
}

double SliderCrankDynamics::acceleration_x(const SliderCrankMotion<double>& m, const Vector& acceleration) const {
  double sum = m.x_bias;
  for (const std::size_t k : free_) sum += m.of_x[k] * acceleration[k];
  return sum;
}

double SliderCrankDynamics::contact_force(const SliderCrankMotion<double>& m, std::size_t contact, int mode) const {
  const Touch<double> t = touch(m, contact);
  return clearances_[contacts_[contact].clearance].contact.normal(mode, t.depth, t.rate);
}

double SliderCrankDynamics::deflection(const SliderCrankMotion<double>& m, double xi) const {
  double sum = 0;
  for (int i = 0; i < rod_.bending; ++i) sum += rod_.shape(i, xi) * m.z[first_amplitude + static_cast<std::size_t>(i)];
  return sum;
}

double SliderCrankDynamics::greatest_bending(const SliderCrankMotion<double>& m) const {
  constexpr int points = 32;
  double most_bent = 0;
  for (int p = 1; p < points; ++p) {
    double sum = 0;
    for (int i = 0; i < rod_.bending; ++i)
      sum += rod_.curvature(i, static_cast<double>(p) / points) * m.z[first_amplitude + static_cast<std::size_t>(i)];
    most_bent = std::max(most_bent, std::abs(sum));
  }
  return most_bent;
}

}  // namespace kurbel
