// slider_crank_dynamics.h — equations of motion of the slider-crank with clearance in its joints and a flexible rod.
//
//     A′ = r e(φ) + e       e  rod's big end from the crank pin            S = B + f    f  slider pin from the rod's
//     end B  = A′ + (l + U_e) e(β)                                             S_y = offset + y, θ tilt of the slider
//   coordinates z = (φ; e_x, e_y; f_x, f_y; y, θ; q); those of joints without clearance and of a rigid rod stay zero.
//   S_y = A′_y + (l + U_e) sin β + f_y gives β, so that all coordinates except φ are small, with small rounding errors.
//     M(z) z̈ + h(z, ż) = 0 for the free coordinates; for the others the left side is the joint's reaction.
// The rod has a floating frame from A′ towards B, with the shape functions of rod_flexibility.h; deviations of its mass
// distribution from that of a prismatic rod (centre of mass, inertia) move with the frame.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/enumerators.h"
#include "engine/numerics/dual.h"
#include "mechanisms/deforming/joint_contact.h"
#include "mechanisms/deforming/rod_flexibility.h"
#include "mechanisms/linkages/slider_crank.h"

namespace kurbel {

// Clearance in a joint of the slider-crank, by the scene.
struct JointClearance {
  enum class Joint { crank_pin, wrist_pin, guide };
  Joint joint = Joint::crank_pin;
  JointContact contact;
  double pin_radius = 0;      // of a pin, for its friction [m]
  double half_length = 0;     // of the slider in its guide, on each side of its pin [m]
  double half_height = 0;     // [m]
  double slider_inertia = 0;  // about its pin [kg·m²]
  std::string name() const { return enumerator_words<Joint::guide>(joint); }  // "crank pin"
};

// Coordinates and their rates, and the quantities that follow from them.
template <class T>
struct SliderCrankMotion {
  static constexpr std::size_t most = 7 + RodModes::most;
  using Coordinates = std::array<T, most>;
  Coordinates z{}, w{};  // coordinates and their rates
  T sin_phi, cos_phi, sin_beta, cos_beta, length, stretch_rate, beta_rate;
  Coordinates of_beta{}, of_x{};  // ∂β/∂z, ∂S_x/∂z
  T x, x_rate;                    // of the slider pin
  T beta_bias, x_bias;            // β̈, S̈_x at z̈ = 0
};

class SliderCrankDynamics {
 public:
  enum Coordinate : std::size_t { phi, e_x, e_y, f_x, f_y, y, tilt, first_amplitude };
  static constexpr std::size_t most = SliderCrankMotion<double>::most;
  static constexpr std::size_t most_contacts = 6;
  using Vector = std::array<double, most>;

  SliderCrankDynamics(const SliderCrankData& data, std::vector<JointClearance> clearances,
                      const std::optional<RodFlexibility>& rod, bool weightless);

  // The free coordinates, φ first.
  const std::vector<std::size_t>& free() const { return free_; }
  const RodModes& rod() const { return rod_; }
  const std::vector<JointClearance>& clearances() const { return clearances_; }
  const SliderCrankData& data() const { return data_; }

  // One contact of a joint: pins have one, the guide one per corner.
  struct ContactPlace {
    std::size_t clearance;
    int corner;  // of the guide: 0 … 3; −1: a pin
  };
  const std::vector<ContactPlace>& contacts() const { return contacts_; }
  struct Approach {
    double depth, rate;
  };
  Approach approach(std::size_t contact, const SliderCrankMotion<double>& m) const;

  template <class T>
  SliderCrankMotion<T> motion(const std::array<T, most>& z, const std::array<T, most>& w) const;

  // M z̈ + h over all coordinates; h includes the load on the slider, weight, elasticity and the contacts in these modes.
  template <class T>
  std::array<T, most> residual(const SliderCrankMotion<T>& m, const Vector& acceleration, const T& load,
                               const int* contact_mode) const;
  // A column of M.
  Vector inertia_column(const SliderCrankMotion<double>& m, std::size_t coordinate) const;

  double kinetic_energy(const SliderCrankMotion<double>& m) const;            // ½ żᵀ M ż
  double kinetic_energy_of_points(const SliderCrankMotion<double>& m) const;  // summed over points of the links
  double elastic_energy(const SliderCrankMotion<double>& m) const;
  double contact_energy(const SliderCrankMotion<double>& m, const int* contact_mode) const;
  double weight_power(const SliderCrankMotion<double>& m) const;
  double damping_power(const SliderCrankMotion<double>& m) const;                                // loss in the rod
  double contact_loss_power(const SliderCrankMotion<double>& m, const int* contact_mode) const;  // ≥ 0

  double acceleration_x(const SliderCrankMotion<double>& m, const Vector& acceleration) const;
  double contact_force(const SliderCrankMotion<double>& m, std::size_t contact, int mode) const;
  double deflection(const SliderCrankMotion<double>& m, double xi) const;  // w [m]
  double greatest_bending(const SliderCrankMotion<double>& m) const;       // |w″| over the rod [1/m]

 private:
  template <class T>
  struct BodyForce {
    T crank{}, rod_x{}, rod_y{}, rod_turn{}, slider_x{}, slider_y{}, slider_turn{};
    std::array<T, RodModes::most> amplitude{};
  };
  template <class T>
  struct BodyAcceleration {
    T a_x{}, a_y{}, beta{}, s_x{}, s_y{}, tilt{}, crank{};
    std::array<T, RodModes::most> amplitude{};
  };
  template <class T>
  void inertia_of_rod(const SliderCrankMotion<T>& m, const BodyAcceleration<T>& a, bool gyroscopic,
                      BodyForce<T>& f) const;
  template <class T>
  std::array<T, most> project(const SliderCrankMotion<T>& m, const BodyForce<T>& f) const;
  template <class T>
  void add_contact(const SliderCrankMotion<T>& m, std::size_t contact, int mode, BodyForce<T>& f,
                   std::array<T, most>& direct) const;
  template <class T>
  struct Touch {  // of a contact
    T depth, rate, sliding;
    T normal_x, normal_y;  // of a pin: direction of its eccentricity
    T arm_x, arm_y;        // of a corner: from the slider pin
  };
  template <class T>
  Touch<T> touch(const SliderCrankMotion<T>& m, std::size_t contact) const;
  int amplitudes() const { return rod_.count(); }

  SliderCrankData data_;
  std::vector<JointClearance> clearances_;
  RodModes rod_;
  double weight_x_ = 0, weight_y_ = 0;  // acceleration of gravity [m/s²]
  double slider_inertia_ = 0;
  std::vector<std::size_t> free_;
  std::vector<ContactPlace> contacts_;
};

// ---------------------------------------------------------------------------------------------------------------------

template <class T>
SliderCrankMotion<T> SliderCrankDynamics::motion(const std::array<T, most>& z, const std::array<T, most>& w) const {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const double r = data_.radius;
  const int end = rod_.end();
  const std::size_t stretch = end < 0 ? 0 : first_amplitude + static_cast<std::size_t>(end);
  SliderCrankMotion<T> m;
  m.z = z, m.w = w;
  m.sin_phi = sin(z[phi]), m.cos_phi = cos(z[phi]);
  m.length = T(data_.rod_length), m.stretch_rate = T(0.0);
  if (end >= 0) m.length = m.length + z[stretch], m.stretch_rate = w[stretch];
  const T rise = data_.offset + z[y] - z[f_y] - r * m.sin_phi - z[e_y];
  m.sin_beta = rise / m.length;
  // In diverging trial steps the rod may be too short; a minimum of 1e-6 for cos β keeps the results finite, and large
  // enough to be rejected by the step control.
  constexpr double least_cosine = 1e-6;
  const T across = (m.length - rise) * (m.length + rise);
  m.cos_beta =
      value_of(across) > std::pow(least_cosine * data_.rod_length, 2) ? sqrt(across) / m.length : T(least_cosine);
  const T lever = m.length * m.cos_beta;
  m.of_beta[phi] = -r * m.cos_phi / lever;
  m.of_beta[e_y] = m.of_beta[f_y] = -1.0 / lever;
  m.of_beta[y] = 1.0 / lever;
  if (end >= 0) m.of_beta[stretch] = -m.sin_beta / lever;
  for (const std::size_t k : {std::size_t{phi}, std::size_t{e_y}, std::size_t{f_y}, std::size_t{y}, stretch})
    m.of_x[k] = -rise * m.of_beta[k];
  m.of_x[phi] = m.of_x[phi] - r * m.sin_phi;
  m.of_x[e_x] = m.of_x[f_x] = T(1.0);
  if (end >= 0) m.of_x[stretch] = m.of_x[stretch] + m.cos_beta;
  m.beta_rate = T(0.0), m.x_rate = T(0.0);
  for (std::size_t k = 0; k < first_amplitude; ++k) {
    m.beta_rate = m.beta_rate + m.of_beta[k] * w[k];
    m.x_rate = m.x_rate + m.of_x[k] * w[k];
  }
  if (end >= 0) {
    m.beta_rate = m.beta_rate + m.of_beta[stretch] * w[stretch];
    m.x_rate = m.x_rate + m.of_x[stretch] * w[stretch];
  }
  m.x = r * m.cos_phi + z[e_x] + lever + z[f_x];
  // Accelerations while z̈ = 0.
  const T turning = m.beta_rate * m.beta_rate, crank_turning = w[phi] * w[phi];
  const T coriolis = 2.0 * m.stretch_rate * m.beta_rate;
  m.beta_bias = (r * m.sin_phi * crank_turning - coriolis * m.cos_beta + rise * turning) / lever;
  m.x_bias = -r * m.cos_phi * crank_turning - coriolis * m.sin_beta - lever * turning - rise * m.beta_bias;
  return m;
}

// ∫ μ p̈ · ∂p/∂(A′, β, q) ds in the rod's frame: p̈ = Ä + (ü − 2β̇ẇ − β̈w − β̇²(s + u)) e + (ẅ + 2β̇u̇ + β̈(s + u) − β̇²w) n
template <class T>
void SliderCrankDynamics::inertia_of_rod(const SliderCrankMotion<T>& m, const BodyAcceleration<T>& a, bool gyroscopic,
                                         BodyForce<T>& f) const {
  const double mu = rod_.mass_per_length, mass = data_.rod_mass;
  const auto n = static_cast<std::size_t>(amplitudes()), bending = static_cast<std::size_t>(rod_.bending);
  const T* const q = m.z.data() + first_amplitude;
  const T* const v = m.w.data() + first_amplitude;
  // First moments of mass along and across the rod, moment of inertia about A′, and their terms with rates.
  T s1(mass * data_.rod_com), s2(0.0), s1_rate(0.0), s2_rate(0.0), s1_acc(0.0), s2_acc(0.0);
  T inertia(data_.rod_inertia + mass * data_.rod_com * data_.rod_com), half_inertia_rate(0.0), turn(0.0);
  for (std::size_t i = 0; i < n; ++i) {
    s1 = s1 + mu * rod_.along[i] * q[i], s2 = s2 + mu * rod_.across[i] * q[i];
    s1_rate = s1_rate + mu * rod_.along[i] * v[i], s2_rate = s2_rate + mu * rod_.across[i] * v[i];
    s1_acc = s1_acc + mu * rod_.along[i] * a.amplitude[i], s2_acc = s2_acc + mu * rod_.across[i] * a.amplitude[i];
    inertia = inertia + 2 * mu * rod_.moment_along[i] * q[i];
    half_inertia_rate = half_inertia_rate + mu * rod_.moment_along[i] * v[i];
    turn = turn + mu * rod_.moment_across[i] * a.amplitude[i];
    for (std::size_t k = 0; k < n; ++k) {
      if (rod_.mass[i][k] == 0) continue;
      inertia = inertia + rod_.mass[i][k] * q[i] * q[k];
      half_inertia_rate = half_inertia_rate + rod_.mass[i][k] * q[i] * v[k];
    }
  }
  const T along = m.cos_beta * a.a_x + m.sin_beta * a.a_y, across = m.cos_beta * a.a_y - m.sin_beta * a.a_x;
  T force_along = mass * along + s1_acc - a.beta * s2, force_across = mass * across + s2_acc + a.beta * s1;
  turn = turn + s1 * across - s2 * along + inertia * a.beta;
  const T rate = m.beta_rate;
  if (gyroscopic) {
    force_along = force_along - rate * (2.0 * s2_rate + rate * s1);
    force_across = force_across + rate * (2.0 * s1_rate - rate * s2);
    turn = turn + 2.0 * rate * half_inertia_rate;
  }
  for (std::size_t i = 0; i < n; ++i) {
    T sum(0.0), still(0.0);
    for (std::size_t k = 0; k < n; ++k) {
      if (rod_.mass[i][k] == 0) continue;
      sum = sum + rod_.mass[i][k] * a.amplitude[k];
      still = still + rod_.mass[i][k] * q[k];
    }
    sum = sum + mu * (rod_.across[i] * across + rod_.along[i] * along) + mu * rod_.moment_across[i] * a.beta;
    if (gyroscopic) sum = sum - rate * rate * (still + mu * rod_.moment_along[i]);
    f.amplitude[i] = f.amplitude[i] + sum;
  }
  // Products of stretching and bending: ∫U_j W_i.
  for (std::size_t j = 0; bending + j < n; ++j)
    for (std::size_t i = 0; i < bending; ++i) {
      const double b = mu * rod_.product[j][i];
      const std::size_t u = bending + j;
      turn = turn + b * (q[u] * a.amplitude[i] - q[i] * a.amplitude[u]);
      f.amplitude[i] = f.amplitude[i] + b * a.beta * q[u];
      f.amplitude[u] = f.amplitude[u] - b * a.beta * q[i];
      if (!gyroscopic) continue;
      f.amplitude[i] = f.amplitude[i] + 2.0 * b * rate * v[u];
      f.amplitude[u] = f.amplitude[u] - 2.0 * b * rate * v[i];
    }
  f.rod_x = f.rod_x + m.cos_beta * force_along - m.sin_beta * force_across;
  f.rod_y = f.rod_y + m.sin_beta * force_along + m.cos_beta * force_across;
  f.rod_turn = f.rod_turn + turn;
}

template <class T>
std::array<T, SliderCrankDynamics::most> SliderCrankDynamics::project(const SliderCrankMotion<T>& m,
                                                                      const BodyForce<T>& f) const {
  std::array<T, most> sum{};
  for (std::size_t k = 0; k < first_amplitude + static_cast<std::size_t>(amplitudes()); ++k)
    sum[k] = m.of_beta[k] * f.rod_turn + m.of_x[k] * f.slider_x;
  const double r = data_.radius;
  sum[phi] = sum[phi] + f.crank + r * (m.cos_phi * f.rod_y - m.sin_phi * f.rod_x);
  sum[e_x] = sum[e_x] + f.rod_x;
  sum[e_y] = sum[e_y] + f.rod_y;
  sum[y] = sum[y] + f.slider_y;
  sum[tilt] = sum[tilt] + f.slider_turn;
  for (std::size_t i = 0; i < static_cast<std::size_t>(amplitudes()); ++i)
    sum[first_amplitude + i] = sum[first_amplitude + i] + f.amplitude[i];
  return sum;
}

template <class T>
SliderCrankDynamics::Touch<T> SliderCrankDynamics::touch(const SliderCrankMotion<T>& m, std::size_t contact) const {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const ContactPlace& place = contacts_[contact];
  const JointClearance& joint = clearances_[place.clearance];
  Touch<T> t{};
  if (place.corner >= 0) {
    const double across = place.corner < 2 ? 1 : -1;
    const double p = place.corner % 2 == 0 ? joint.half_length : -joint.half_length, q = across * joint.half_height;
    const T c = cos(m.z[tilt]), s = sin(m.z[tilt]);
    t.arm_x = p * c - q * s, t.arm_y = p * s + q * c;
    // Measured from the middle to avoid cancellation: p s + q (c − 1) + q.
    const T half = sin(0.5 * m.z[tilt]);
    t.depth = across * (m.z[y] + p * s - 2.0 * q * half * half) - joint.contact.gap;
    t.rate = across * (m.w[y] + t.arm_x * m.w[tilt]);
    t.sliding = m.x_rate - t.arm_y * m.w[tilt];
    return t;
  }
  const bool crank = joint.joint == JointClearance::Joint::crank_pin;
  const std::size_t first = crank ? e_x : f_x;
  const T &ex = m.z[first], &ey = m.z[first + 1];
  const T distance = value_of(ex) == 0 && value_of(ey) == 0 ? T(0.0) : sqrt(ex * ex + ey * ey);
  t.depth = distance - joint.contact.gap;
  if (value_of(distance) == 0) return t;
  t.normal_x = ex / distance, t.normal_y = ey / distance;
  t.rate = t.normal_x * m.w[first] + t.normal_y * m.w[first + 1];
  // Relative speed of the surfaces at the contact; the rod's surface rotates about the rod's end.
  t.sliding = t.normal_x * m.w[first + 1] - t.normal_y * m.w[first] +
              joint.pin_radius * (crank ? m.w[phi] : m.w[tilt]) - (joint.pin_radius + distance) * m.beta_rate;
  return t;
}

template <class T>
void SliderCrankDynamics::add_contact(const SliderCrankMotion<T>& m, std::size_t contact, int mode, BodyForce<T>& f,
                                      std::array<T, most>& direct) const {
  if (mode == JointContact::flight || mode == JointContact::parting) return;
  const ContactPlace& place = contacts_[contact];
  const JointClearance& joint = clearances_[place.clearance];
  const Touch<T> t = touch(m, contact);
  const T normal = joint.contact.normal(mode, t.depth, t.rate);
  const T drag = joint.contact.tangential(normal, t.sliding);
  if (place.corner >= 0) {
    const double across = place.corner < 2 ? 1 : -1;
    f.slider_y = f.slider_y + across * normal;
    f.slider_turn = f.slider_turn + across * normal * t.arm_x - drag * t.arm_y;
    f.slider_x = f.slider_x + drag;
    return;
  }
  const bool crank = joint.joint == JointClearance::Joint::crank_pin;
  const std::size_t first = crank ? e_x : f_x;
  direct[first] = direct[first] + normal * t.normal_x - drag * t.normal_y;
  direct[first + 1] = direct[first + 1] + normal * t.normal_y + drag * t.normal_x;
  f.rod_turn = f.rod_turn - (joint.pin_radius + joint.contact.gap + t.depth) * drag;
  T& journal = crank ? f.crank : f.slider_turn;
  journal = journal + joint.pin_radius * drag;
}

template <class T>
std::array<T, SliderCrankDynamics::most> SliderCrankDynamics::residual(const SliderCrankMotion<T>& m,
                                                                       const Vector& acceleration, const T& load,
                                                                       const int* contact_mode) const {
  const double r = data_.radius;
  const auto n = static_cast<std::size_t>(amplitudes());
  const T crank_turning = m.w[phi] * m.w[phi];
  // Accelerations minus that of gravity.
  BodyAcceleration<T> a;
  a.a_x = -r * (m.cos_phi * crank_turning + m.sin_phi * acceleration[phi]) + (acceleration[e_x] - weight_x_);
  a.a_y = -r * (m.sin_phi * crank_turning - m.cos_phi * acceleration[phi]) + (acceleration[e_y] - weight_y_);
  a.beta = m.beta_bias, a.s_x = m.x_bias - weight_x_;
  for (std::size_t k = 0; k < first_amplitude + n; ++k) {
    if (acceleration[k] == 0) continue;
    a.beta = a.beta + m.of_beta[k] * acceleration[k];
    a.s_x = a.s_x + m.of_x[k] * acceleration[k];
  }
  for (std::size_t i = 0; i < n; ++i) a.amplitude[i] = T(acceleration[first_amplitude + i]);
  BodyForce<T> f;
  inertia_of_rod(m, a, true, f);
  f.crank = data_.crank_inertia * acceleration[phi] -
            data_.crank_mass * data_.crank_com * (m.cos_phi * weight_y_ - m.sin_phi * weight_x_);
  f.slider_x = data_.slider_mass * a.s_x - load;
  f.slider_y = T(data_.slider_mass * (acceleration[y] - weight_y_));
  f.slider_turn = T(slider_inertia_ * acceleration[tilt]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      if (rod_.stiffness[i][k] != 0)
        f.amplitude[i] = f.amplitude[i] + rod_.stiffness[i][k] * m.z[first_amplitude + k] +
                         rod_.damping[i][k] * m.w[first_amplitude + k];
  std::array<T, most> direct{};
  for (std::size_t c = 0; c < contacts_.size(); ++c) add_contact(m, c, contact_mode[c], f, direct);
  std::array<T, most> sum = project(m, f);
  if (!contacts_.empty())
    for (std::size_t k = e_x; k <= f_y; ++k) sum[k] = sum[k] + direct[k];
  return sum;
}

}  // namespace kurbel
