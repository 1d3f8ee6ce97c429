// gear_pair.cpp — the mesh of two involute wheels.
#include "drivetrain/gears/gear_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

double transverse_angle_of(const GearPairData& d) {
  return std::atan(std::tan(d.rack.pressure_angle) / std::cos(d.helix));
}
double reference_distance_of(const GearPairData& d) {
  return 0.5 * d.module / std::cos(d.helix) * (d.teeth[0] + d.teeth[1]);
}

// Of both wheels; of the one that is known.
double common_width(const GearPairData& d) {
  return d.width[0] > 0 && d.width[1] > 0 ? std::min(d.width[0], d.width[1]) : std::max(d.width[0], d.width[1]);
}

void check(const GearPairData& d) {
  const auto refuse = [](const std::string& text) { throw std::invalid_argument(text); };
  if (!(d.module > 0) || !std::isfinite(d.module)) refuse(fmt::format("module = {:g} mm; must be > 0", 1e3 * d.module));
  if (d.teeth[0] < 5)
    refuse(
        fmt::format("teeth = [{}, {}]; wheel 1 must have 5 teeth or more; of an internal pair the internal wheel "
                    "stands second, with negative teeth",
                    d.teeth[0], d.teeth[1]));
  if (std::abs(d.teeth[1]) < 5 || (d.teeth[1] < 0 && -d.teeth[1] <= d.teeth[0]))
    refuse(
        fmt::format("teeth = [{}, {}]; wheel 2 must have 5 teeth or more, an internal one (negative) more than wheel 1",
                    d.teeth[0], d.teeth[1]));
  if (!(std::abs(d.helix) <= pi / 3)) refuse(fmt::format("helix = {:g} deg; must be −60 … 60 deg", d.helix / degree));
  if (!(d.rack.pressure_angle >= 10 * degree && d.rack.pressure_angle <= 35 * degree))
    refuse(fmt::format("pressure_angle = {:g} deg; must be 10 … 35 deg", d.rack.pressure_angle / degree));
  if (!(d.backlash >= 0 && d.backlash <= d.module))
    refuse(fmt::format("backlash = {:g} mm; must be 0 … one module", 1e3 * d.backlash));
  for (const int i : {0, 1}) {
    if (!(d.width[at(i)] >= 0 && std::isfinite(d.width[at(i)])))
      refuse(fmt::format("width = {:g} mm; must be > 0", 1e3 * d.width[at(i)]));
    if (d.shift[at(i)] && !(std::abs(*d.shift[at(i)]) <= 3))
      refuse(fmt::format("shift = {:g}; must be −3 … 3 (in modules)", *d.shift[at(i)]));
    if (d.tip_diameter[at(i)] && !(*d.tip_diameter[at(i)] > 0))
      refuse(fmt::format("tip diameter = {:g} mm; must be > 0", 1e3 * *d.tip_diameter[at(i)]));
  }
}

// Both shifts; what was not given follows from the centre distance, or is 0.
std::array<double, 2> shifts_of(const GearPairData& d, double mating_sum) {
  if (!d.centre_distance) return {d.shift[0].value_or(0), d.shift[1].value_or(0)};
  if (d.shift[0] && d.shift[1]) return {*d.shift[0], *d.shift[1]};
  if (d.shift[0]) return {*d.shift[0], mating_sum - *d.shift[0]};
  if (d.shift[1]) return {mating_sum - *d.shift[1], *d.shift[1]};
  return {0.5 * mating_sum, 0.5 * mating_sum};
}

// inv α_wt = inv α_t + 2 tan α_n Σx/(z₁ + z₂) (theory 6.5).
double working_angle_by_shift(const GearPairData& d, double sum) {
  const double value =
      involute(transverse_angle_of(d)) + 2 * std::tan(d.rack.pressure_angle) * sum / (d.teeth[0] + d.teeth[1]);
  if (value < 0)
    throw std::invalid_argument(fmt::format(
        "shift: x1 + x2 = {:.4g} leaves no working pressure angle (inv = {:.3g} < 0); it must be {} {:.4g}", sum, value,
        d.teeth[1] < 0 ? "below" : "above",
        -involute(transverse_angle_of(d)) * (d.teeth[0] + d.teeth[1]) / (2 * std::tan(d.rack.pressure_angle))));
  return involute_angle(value);
}

MeshedWheel wheel_of(const GearPair& p, int i, double shift) {
  const GearPairData& d = p.data;
  GearWheel w;
  w.teeth = d.teeth[at(i)];
  w.module = d.module;
  w.helix = d.helix;
  w.rack = d.rack;
  w.shift = shift;
  w.generating_shift = shift - d.backlash / (4 * d.module * std::sin(d.rack.pressure_angle));
  const double reference = d.module / std::cos(d.helix) * w.teeth;
  w.tip_diameter = reference + 2 * d.module * (d.rack.addendum + shift + p.tip_shortening);
  if (d.tip_diameter[at(i)]) w.tip_diameter = w.internal() ? -*d.tip_diameter[at(i)] : *d.tip_diameter[at(i)];
  MeshedWheel meshed;
  static_cast<GearWheel&>(meshed) = finish(w);
  meshed.width = d.width[at(i)];
  return meshed;
}

// Half the length of the tangent from the tip to the base circle, without its sign.
double tip_tangent(const GearWheel& w) {
  return 0.5 * std::sqrt(std::max(0.0, squared(w.tip_diameter) - squared(w.base_diameter)));
}

void add_path(GearPair& p) {
  const MeshedWheel &one = p.wheel[0], &two = p.wheel[1];
  const double tangent = std::tan(p.working_angle), sign = two.internal() ? -1 : 1;
  p.limit_start = -0.5 * one.base_diameter * tangent;
  p.limit_end = 0.5 * two.base_diameter * tangent;  // behind C for an internal wheel
  p.end = p.tip_end = tip_tangent(one) + p.limit_start;
  p.start = p.tip_start = p.limit_end - sign * tip_tangent(two);
  // Undercut flanks begin later.
  const auto form = [](const GearWheel& w) {
    return 0.5 * std::sqrt(std::max(0.0, squared(w.form_diameter) - squared(w.base_diameter)));
  };
  if (one.undercut) p.start = std::max(p.start, p.limit_start + form(one));
  if (two.undercut) p.end = std::min(p.end, p.limit_end - form(two));
  p.contact_ratio = (p.end - p.start) / p.base_pitch;
  if (!(p.contact_ratio > 0))
    throw std::invalid_argument(
        fmt::format("the wheels do not reach each other at a_w = {:.4f} mm: the path of contact has no length; take a "
                    "smaller centre distance or longer addenda",
                    1e3 * std::abs(p.centre_distance)));
}

void add_backlash(GearPair& p) {
  const double pitch = pi * p.wheel[0].working_diameter / p.data.teeth[0];
  p.backlash_arc =
      pitch - p.wheel[0].thickness(p.wheel[0].working_diameter) - p.wheel[1].thickness(p.wheel[1].working_diameter);
  if (std::abs(p.backlash_arc) < 1e-12 * p.data.module) p.backlash_arc = 0;  // rounding
  p.backlash_normal = p.backlash_arc * std::cos(p.working_angle) * std::cos(p.wheel[0].base_helix);
}

void add_wheels_in_mesh(GearPair& p) {
  const double long_leg = std::abs(p.centre_distance) * std::sin(p.working_angle);
  for (const int i : {0, 1}) {
    MeshedWheel& w = p.wheel[at(i)];
    const MeshedWheel& mate = p.wheel[at(1 - i)];
    w.tip_clearance = p.centre_distance - 0.5 * (w.tip_diameter + mate.root_diameter);
    // The tip of an internal wheel lies inwards: its limit is the base circle of wheel 1 seen from its own centre.
    w.greatest_tip_diameter = i == 0 && p.internal() ? std::numeric_limits<double>::infinity()
                                                     : 2 * std::hypot(0.5 * w.base_diameter, long_leg);
    w.bore = p.data.bore[at(i)];
    if (w.internal() && w.bore == 0) w.bore = -w.root_diameter + 2 * 3.5 * p.data.module;
    if (w.internal() ? !(w.bore > -w.root_diameter) : !(w.bore >= 0 && w.bore < w.root_diameter))
      throw std::invalid_argument(fmt::format(
          "bore = {:g} mm of the wheel with z = {}; must be {} its root diameter, {:.4f} mm", 1e3 * w.bore, w.teeth,
          w.internal() ? "(as the rim's outer diameter) above" : "below", 1e3 * std::abs(w.root_diameter)));
    w.inertia = w.width > 0 ? wheel_inertia(w, w.width, p.data.density, w.bore) : 0;
  }
  p.wheel[0].reached_diameter = 2 * p.radius(std::max(p.tip_start, p.limit_start))[0];
  p.wheel[1].reached_diameter = 2 * p.radius(p.internal() ? p.tip_end : std::min(p.tip_end, p.limit_end))[1];
  // Never below the base circle.
  p.wheel[0].active_diameter = 2 * p.radius(std::max(p.start, p.limit_start))[0];
  p.wheel[1].active_diameter = p.internal() ? -2 * p.radius(p.end)[1] : 2 * p.radius(std::min(p.end, p.limit_end))[1];
}

}  // namespace

double working_angle_of(double reference_distance, double transverse_angle, double centre_distance) {
  const double cosine = reference_distance * std::cos(transverse_angle) / centre_distance;
  if (!(cosine > 0 && cosine <= 1))
    throw std::invalid_argument(
        fmt::format("centre_distance = {:.6g} mm; must be more than {:.6g} mm, where the base circles touch",
                    1e3 * std::abs(centre_distance), 1e3 * std::abs(reference_distance * std::cos(transverse_angle))));
  return std::acos(cosine);
}

double shift_sum_of(const GearPairData& d, double working_angle) {
  return (d.teeth[0] + d.teeth[1]) * (involute(working_angle) - involute(transverse_angle_of(d))) /
         (2 * std::tan(d.rack.pressure_angle));
}

GearPair solve_gear_pair(const GearPairData& data) {
  check(data);
  GearPair p;
  p.data = data;
  p.ratio = static_cast<double>(data.teeth[1]) / data.teeth[0];
  p.reference_centre_distance = reference_distance_of(data);
  if (data.centre_distance) {
    p.centre_distance = (p.internal() ? -1 : 1) * *data.centre_distance;
    p.working_angle = working_angle_of(p.reference_centre_distance, transverse_angle_of(data), p.centre_distance);
    p.mating_shift_sum = shift_sum_of(data, p.working_angle);
  }
  const std::array<double, 2> shift = shifts_of(data, p.mating_shift_sum);
  p.shift_sum = shift[0] + shift[1];
  if (!data.centre_distance) {
    p.working_angle = working_angle_by_shift(data, p.shift_sum);
    p.centre_distance = p.reference_centre_distance * std::cos(transverse_angle_of(data)) / std::cos(p.working_angle);
    p.mating_shift_sum = p.shift_sum;
  }
  // k = (a_w − a)/m_n − Σx keeps the clearance; tips are never lengthened, and what rounding leaves is none.
  constexpr double rounding = 1e-12;
  const double kept = (p.centre_distance - p.reference_centre_distance) / data.module - p.mating_shift_sum;
  if (data.shorten_tips && !p.internal() && kept < -rounding) p.tip_shortening = kept;
  for (const int i : {0, 1}) {
    p.wheel[at(i)] = wheel_of(p, i, shift[at(i)]);
    p.wheel[at(i)].working_diameter = p.wheel[at(i)].base_diameter / std::cos(p.working_angle);
  }
  p.base_pitch = pi * p.wheel[0].transverse_module * std::cos(p.wheel[0].transverse_angle);
  add_path(p);
  const double common = common_width(data);
  p.overlap_ratio = common * std::sin(std::abs(data.helix)) / (pi * data.module);
  add_backlash(p);
  add_wheels_in_mesh(p);
  return p;
}

double GearPair::point(char name) const {
  switch (name) {
    case 'A':
      return start;
    case 'B':
      return end - base_pitch;
    case 'D':
      return start + base_pitch;
    case 'E':
      return end;
    default:
      return 0;
  }
}

std::array<double, 2> GearPair::curvature(double g) const { return {g - limit_start, limit_end - g}; }

std::array<double, 2> GearPair::radius(double g) const {
  const std::array<double, 2> rho = curvature(g);
  return {std::hypot(0.5 * wheel[0].base_diameter, rho[0]), std::hypot(0.5 * wheel[1].base_diameter, rho[1])};
}

double GearPair::sliding_speed(double g, double omega_1) const { return omega_1 * (1 + 1 / ratio) * g; }

std::array<double, 2> GearPair::specific_sliding(double g) const {
  const std::array<double, 2> rho = curvature(g);
  const double infinite = -std::numeric_limits<double>::infinity();
  return {rho[0] > 0 ? 1 - rho[1] / (ratio * rho[0]) : infinite,
          rho[1] * ratio > 0 ? 1 - ratio * rho[0] / rho[1] : infinite};
}

double GearPair::backlash_angle(int i) const { return 2 * backlash_arc / std::abs(wheel[at(i)].working_diameter); }

double GearPair::mesh_frequency(double omega_1) const { return std::abs(omega_1) * data.teeth[0] / (2 * pi); }

double tip_fouling_margin(const GearPair& p) {
  const double r1 = 0.5 * p.wheel[0].tip_diameter, r2 = -0.5 * p.wheel[1].tip_diameter, a = -p.centre_distance;
  const double inv_w = involute(p.working_angle);
  const double cos_1 = (r2 * r2 - r1 * r1 - a * a) / (2 * a * r1), cos_2 = (a * a + r2 * r2 - r1 * r1) / (2 * a * r2);
  if (std::abs(cos_1) >= 1 || std::abs(cos_2) >= 1) return pi;  // the tip circles do not meet
  const double inv_1 = involute(p.wheel[0].profile_angle(p.wheel[0].tip_diameter));
  const double inv_2 = involute(p.wheel[1].profile_angle(p.wheel[1].tip_diameter));
  return (std::acos(cos_1) + inv_1 - inv_w) / -p.ratio + inv_w - inv_2 - std::acos(cos_2);
}

double radial_assembly_margin(const GearPair& p) {
  const double u = -p.ratio;
  const double tip_1 = p.wheel[0].profile_angle(p.wheel[0].tip_diameter);
  const double tip_2 = p.wheel[1].profile_angle(p.wheel[1].tip_diameter);
  const double c = std::cos(tip_1) / std::cos(tip_2);
  const double sine_1 = (1 - c * c) / (1 - 1 / (u * u)), sine_2 = (1 / (c * c) - 1) / (u * u - 1);
  if (!(sine_1 >= 0 && sine_1 <= 1 && sine_2 >= 0 && sine_2 <= 1)) return pi;  // the tips never pass each other
  const double inv_w = involute(p.working_angle);
  return std::asin(std::sqrt(sine_1)) + involute(tip_1) - inv_w -
         u * (std::asin(std::sqrt(sine_2)) + involute(tip_2) - inv_w);
}

MeshStiffness mesh_stiffness(const GearPair& p) {
  const double cos_helix = std::cos(p.data.helix);
  // Virtual teeth z_n = z/(cos² β_b cos β); an internal wheel counts as a rack.
  const auto reciprocal = [&](int i) {
    const MeshedWheel& w = p.wheel[at(i)];
    return w.internal() ? 0.0 : squared(std::cos(w.base_helix)) * cos_helix / w.teeth;
  };
  const double v1 = reciprocal(0), v2 = reciprocal(1), x1 = p.wheel[0].shift, x2 = p.wheel[1].shift;
  const double q = 0.04723 + 0.15551 * v1 + 0.25791 * v2 - 0.00635 * x1 - 0.11654 * x1 * v1 - 0.00193 * x2 -
                   0.24188 * x2 * v2 + 0.00529 * x1 * x1 + 0.00182 * x2 * x2;  // mm·µm/N
  const double rack =
      (1 + 0.5 * (1.2 - p.data.rack.dedendum())) * (1 - 0.02 * (20 - p.data.rack.pressure_angle / degree));
  MeshStiffness s;
  s.single = 1e9 / q * 0.8 * rack * cos_helix * p.data.young / 206e9;
  s.mean = s.single * (0.75 * p.contact_ratio + 0.25);
  const double width = common_width(p.data);
  s.torsional = s.mean * width * squared(0.5 * p.wheel[0].base_diameter);
  s.torsional_single = s.single * width * squared(0.5 * p.wheel[0].base_diameter);
  s.within = x1 >= x2 - 1e-12 && p.shift_sum >= -0.5 && p.shift_sum <= 2 && p.contact_ratio > 1.2 &&
             p.contact_ratio < 2.5 && q > 0;
  return s;
}

double contact_at(const GearPair& p, double angle_1) {
  const MeshedWheel& w = p.wheel[0];
  return 0.5 * w.base_diameter * (angle_1 + w.thickness(w.working_diameter) / w.working_diameter);
}

MeshPlace mesh_place(const GearPair& p, double angle_1) {
  // When the leading flank of wheel 1 is in C, the flank of wheel 2 that it pushes is there too.
  const MeshedWheel& w = p.wheel[1];
  const double half = w.thickness(w.working_diameter) / std::abs(w.working_diameter);
  const double turned = contact_at(p, angle_1) / (0.5 * p.wheel[0].base_diameter);
  return {angle_1, (p.internal() ? half : pi - half) - turned / p.ratio};
}

}  // namespace kurbel
