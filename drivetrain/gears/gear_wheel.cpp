// gear_wheel.cpp — generation of one wheel by its basic rack.
#include "drivetrain/gears/gear_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/numerics/roots.h"

namespace kurbel {
namespace {

// The rack's tooth in the transverse plane, its rounding, and the curve that it cuts.
class RackTip {
 public:
  explicit RackTip(const GearWheel& w)
      : pitch_radius_(0.5 * w.reference_diameter),
        cos_helix_(std::cos(w.helix)),
        alpha_(w.rack.pressure_angle),
        rounding_(w.rack.root_radius * w.module),
        centre_depth_((w.rack.dedendum() - w.generating_shift) * w.module - rounding_),
        half_width_(w.module * (pi / 4 - (w.rack.dedendum() - w.rack.root_radius) * std::tan(alpha_) -
                                w.rack.root_radius / std::cos(alpha_))) {}

  // Point cut by the rounding where its normal is inclined by ψ, α_n (end of the flank) … π/2 (tip): radius, and angle
  // from the middle of the space. The normal passes through the pitch point when it cuts (law of gearing).
  FlankPoint cut(double psi) const {
    const double along = (half_width_ + rounding_ * std::cos(psi)) / cos_helix_;
    const double out = -(centre_depth_ + rounding_ * std::sin(psi));
    const double travel = -along - out * cos_helix_ * std::cos(psi) / std::sin(psi);
    return {std::hypot(along + travel, pitch_radius_ + out),
            std::atan2(along + travel, pitch_radius_ + out) - travel / pitch_radius_};
  }
  double first() const { return alpha_; }

 private:
  double pitch_radius_, cos_helix_, alpha_, rounding_, centre_depth_, half_width_;
};

// Root of a falling or rising function between two places where its signs differ.
template <class F>
double bisected(double low, double high, F&& f) {
  const bool rising = f(high) > 0;
  return halved({low, high}, 200, [&](double middle) { return (f(middle) > 0) != rising; }).middle();
}

double half_angle(const GearWheel& w, double radius) {
  const double diameter = w.internal() ? -2 * radius : 2 * radius;
  return w.thickness(diameter) / (2 * radius);
}

// Where trochoid and involute cross: ψ of the rounding. Beyond it the rack has cut the involute away.
double undercut_crossing(const GearWheel& w) {
  const RackTip tip(w);
  const double base = 0.5 * w.base_diameter;
  const double at_base = bisected(tip.first(), pi / 2, [&](double psi) { return tip.cut(psi).radius - base; });
  return bisected(tip.first(), at_base, [&](double psi) {
    const FlankPoint p = tip.cut(psi);
    return p.angle - (pi / w.teeth - half_angle(w, std::max(p.radius, base)));
  });
}

// Fillet of an internal wheel: a circle that touches involute and root circle. Offsets of involutes are involutes.
struct InternalFillet {
  double radius = 0, centre_radius = 0, centre_angle = 0;  // angle from the middle of the space
  double touch_radius = 0;                                 // on the involute
};

InternalFillet fillet_of(const GearWheel& w, double rounding) {
  const double base = -0.5 * w.base_diameter, root = -0.5 * w.root_diameter;
  InternalFillet f{.radius = rounding, .centre_radius = root - rounding};
  const double alpha = std::acos(std::min(1.0, base / f.centre_radius));
  const double at_base = pi / -w.teeth - half_angle(w, base);
  f.centre_angle = at_base - rounding / base - involute(alpha);
  f.touch_radius = std::hypot(std::sqrt(std::max(0.0, squared(f.centre_radius) - squared(base))) + rounding, base);
  return f;
}

// The requested rounding, or the largest that fits the space.
InternalFillet internal_fillet(const GearWheel& w) {
  const double base = -0.5 * w.base_diameter, root = -0.5 * w.root_diameter, tip = -0.5 * w.tip_diameter;
  const auto fits = [&](double rounding) {
    const InternalFillet f = fillet_of(w, rounding);
    return f.centre_angle >= 0 && f.centre_radius > base && f.touch_radius > tip && f.touch_radius <= root;
  };
  double rounding = w.rack.root_radius * w.module;
  if (!fits(rounding)) rounding = bisected(0, rounding, [&](double r) { return fits(r) ? -1.0 : 1.0; });
  return fillet_of(w, rounding);
}

void append_involute(std::vector<FlankPoint>& flank, const GearWheel& w, double from, double to, int n) {
  const double base = 0.5 * std::abs(w.base_diameter);
  const auto roll = [&](double r) { return std::sqrt(std::max(0.0, squared(r / base) - 1)); };
  const double first = roll(from), last = roll(to);
  for (int i = 0; i <= n; ++i) {
    const double r = i == n ? to : base * std::hypot(1, first + (last - first) * i / n);
    flank.push_back({r, half_angle(w, r)});
  }
}

void append_tip(std::vector<FlankPoint>& flank, int n) {
  const FlankPoint corner = flank.back();
  for (int i = 1; i <= n; ++i) flank.push_back({corner.radius, corner.angle * (n - i) / n});
}

std::vector<FlankPoint> half_external(const GearWheel& w, int n) {
  const RackTip rack(w);
  const double pitch = pi / w.teeth, end = w.undercut ? undercut_crossing(w) : rack.first();
  std::vector<FlankPoint> flank;
  const FlankPoint bottom = rack.cut(pi / 2);
  for (int i = 0; i < n; ++i) flank.push_back({bottom.radius, pitch - bottom.angle * i / n});
  for (int i = 0; i < n; ++i) {
    const FlankPoint p = rack.cut(pi / 2 + (end - pi / 2) * i / n);
    flank.push_back({p.radius, pitch - p.angle});
  }
  append_involute(flank, w, 0.5 * w.form_diameter, 0.5 * std::min(w.tip_diameter, w.pointed_diameter()), n);
  append_tip(flank, n);
  return flank;
}

std::vector<FlankPoint> half_internal(const GearWheel& w, int n) {
  const InternalFillet f = internal_fillet(w);
  const double pitch = pi / -w.teeth, root = -0.5 * w.root_diameter, base = -0.5 * w.base_diameter;
  std::vector<FlankPoint> flank;
  for (int i = 0; i < n; ++i) flank.push_back({root, pitch - f.centre_angle * i / n});
  // From straight outwards to the normal of the involute, which is a tangent of the base circle.
  const double swept = pi / 2 - std::acos(std::min(1.0, base / f.centre_radius));
  for (int i = 0; i < n; ++i) {
    const double turn = swept * i / n;  // from the radius through the centre
    const double x = f.centre_radius + f.radius * std::cos(turn), y = f.radius * std::sin(turn);
    flank.push_back({std::hypot(x, y), pitch - f.centre_angle - std::atan2(y, x)});
  }
  append_involute(flank, w, 0.5 * -w.form_diameter, -0.5 * w.tip_diameter, n);
  append_tip(flank, n);
  return flank;
}

void check(const GearWheel& w) {
  const auto refuse = [](const std::string& text) { throw std::invalid_argument(text); };
  if (!(w.module > 0) || !std::isfinite(w.module)) refuse(fmt::format("module = {:g} mm; must be > 0", 1e3 * w.module));
  if (std::abs(w.teeth) < 5)
    refuse(fmt::format("teeth = {}; must be 5 or more (negative for an internal wheel)", w.teeth));
  if (!(std::abs(w.helix) <= pi / 3)) refuse(fmt::format("helix = {:g} deg; must be −60 … 60 deg", w.helix * 180 / pi));
  if (!(w.rack.pressure_angle >= pi / 18 && w.rack.pressure_angle <= 35 * pi / 180))
    refuse(fmt::format("pressure_angle = {:g} deg; must be 10 … 35 deg", w.rack.pressure_angle * 180 / pi));
  if (!(w.rack.addendum > 0 && w.rack.addendum <= 2 && w.rack.clearance >= 0 && w.rack.clearance <= 1))
    refuse(fmt::format("basic rack: addendum = {:g}, clearance = {:g}; must be > 0 … 2 and 0 … 1 (in modules)",
                       w.rack.addendum, w.rack.clearance));
  if (!(w.rack.root_radius >= 0) || w.rack.root_radius > w.rack.greatest_root_radius() + 1e-12)
    refuse(fmt::format("basic rack: root_radius = {:g}; must be 0 … {:.4f}: the rack's tip has no room for more",
                       w.rack.root_radius, w.rack.greatest_root_radius()));
  if (!(std::abs(w.shift) <= 3) || !(std::abs(w.generating_shift) <= 4))
    refuse(fmt::format("shift = {:g}; must be −3 … 3 (in modules)", w.shift));
}

void check_diameters(const GearWheel& w) {
  const char* which = w.internal() ? "internal wheel" : "wheel";
  if (!(w.internal() ? w.root_diameter < w.tip_diameter : w.root_diameter > 0 && w.root_diameter < w.tip_diameter))
    throw std::invalid_argument(
        fmt::format("{} with z = {}: root diameter {:.4f} mm and tip diameter {:.4f} mm leave no tooth; change shift, "
                    "addendum or tip diameter",
                    which, w.teeth, 1e3 * w.root_diameter, 1e3 * w.tip_diameter));
  if (w.internal() && w.tip_diameter > w.base_diameter)
    throw std::invalid_argument(fmt::format(
        "internal wheel with z = {}: its tip circle {:.4f} mm lies inside the base circle {:.4f} mm, where there is no "
        "involute; take more teeth, a more negative shift or a shorter addendum",
        w.teeth, -1e3 * w.tip_diameter, -1e3 * w.base_diameter));
  if (w.internal() && !(half_angle(w, -0.5 * w.tip_diameter) > 0))
    throw std::invalid_argument(
        fmt::format("internal wheel with z = {}: no thickness is left at the tip; take a larger shift", w.teeth));
}

}  // namespace

double involute_angle(double value) {
  if (!(value >= 0) || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("no angle has the involute {:g}; it must be ≥ 0", value));
  if (value == 0) return 0;
  // u − atan u = value for u = tan α is convex: Newton's steps come down to the root from the second one on.
  double u = std::cbrt(3 * value);
  for (int i = 0; i < 100; ++i) {
    const double step = (u - std::atan(u) - value) * (1 + u * u) / (u * u);
    u -= step;
    if (std::abs(step) <= 1e-16 * u) break;
  }
  return std::atan(u);
}

double BasicRack::greatest_root_radius() const {
  const double t = std::tan(pressure_angle), room = (std::numbers::pi / 4 - dedendum() * t);
  const double by_width = room / (1 / std::cos(pressure_angle) - t);
  return std::max(0.0, std::min(by_width, dedendum() / (1 - std::sin(pressure_angle))));
}

double least_teeth(const BasicRack& rack, double helix, double shift) {
  const double transverse = std::atan(std::tan(rack.pressure_angle) / std::cos(helix));
  return 2 * (rack.addendum - shift) * std::cos(helix) / squared(std::sin(transverse));
}

double GearWheel::profile_angle(double diameter) const {
  const double cosine = base_diameter / diameter;
  return cosine < 1 ? std::acos(cosine) : 0.0;
}

double GearWheel::thickness(double diameter) const {
  const double at_reference = (pi + 4 * generating_shift * std::tan(rack.pressure_angle)) / (2 * teeth);
  return diameter * (at_reference + involute(transverse_angle) - involute(profile_angle(diameter)));
}

double GearWheel::thickness_normal(double diameter) const {
  const double helix_there = std::atan(std::tan(helix) * diameter / reference_diameter);
  return thickness(diameter) * std::cos(helix_there);
}

double GearWheel::pointed_diameter() const {
  if (internal()) return std::numeric_limits<double>::infinity();
  const double at_reference = (pi + 4 * generating_shift * std::tan(rack.pressure_angle)) / (2 * teeth);
  return base_diameter / std::cos(involute_angle(std::max(0.0, at_reference + involute(transverse_angle))));
}

double GearWheel::least_shift_generated() const {
  if (internal()) return -std::numeric_limits<double>::infinity();
  return rack.straight_depth() - teeth * squared(std::sin(transverse_angle)) / (2 * std::cos(helix));
}

GearWheel finish(GearWheel w) {
  check(w);
  w.transverse_module = w.module / std::cos(w.helix);
  w.transverse_angle = std::atan(std::tan(w.rack.pressure_angle) / std::cos(w.helix));
  w.base_helix = std::asin(std::sin(w.helix) * std::cos(w.rack.pressure_angle));
  w.reference_diameter = w.transverse_module * w.teeth;
  w.base_diameter = w.reference_diameter * std::cos(w.transverse_angle);
  w.root_diameter = w.reference_diameter - 2 * w.module * (w.rack.dedendum() - w.generating_shift);
  check_diameters(w);
  if (w.internal()) {
    w.form_diameter = -2 * internal_fillet(w).touch_radius;
    return w;
  }
  w.undercut = w.generating_shift < w.least_shift_generated() - 1e-12;
  const RackTip rack(w);
  w.form_diameter = 2 * rack.cut(w.undercut ? undercut_crossing(w) : rack.first()).radius;
  if (w.form_diameter >= std::min(w.tip_diameter, w.pointed_diameter()))
    throw std::invalid_argument(fmt::format("wheel with z = {}: the rack cuts the whole involute away; take x ≥ {:.3f}",
                                            w.teeth, w.least_shift_generated()));
  return w;
}

std::vector<FlankPoint> half_tooth(const GearWheel& wheel, int n) {
  return wheel.internal() ? half_internal(wheel, n) : half_external(wheel, n);
}

std::vector<OutlinePoint> tooth_outline(const GearWheel& wheel, int n) {
  const std::vector<FlankPoint> half = half_tooth(wheel, n);
  std::vector<OutlinePoint> outline;
  for (const FlankPoint& p : half) outline.push_back({p.radius * std::cos(p.angle), -p.radius * std::sin(p.angle)});
  for (auto p = half.rbegin() + 1; p != half.rend() - 1; ++p)  // the last is the first of the next pitch
    outline.push_back({p->radius * std::cos(p->angle), p->radius * std::sin(p->angle)});
  return outline;
}

std::vector<OutlinePoint> wheel_outline(const GearWheel& wheel, int n) {
  const std::vector<OutlinePoint> tooth = tooth_outline(wheel, n);
  const int count = std::abs(wheel.teeth);
  std::vector<OutlinePoint> outline;
  for (int k = 0; k < count; ++k) {
    const double c = std::cos(2 * pi * k / count), s = std::sin(2 * pi * k / count);
    for (const OutlinePoint& p : tooth) outline.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
  }
  return outline;
}

double wheel_inertia(const GearWheel& wheel, double width, double density, double bore_or_rim, int points) {
  // ∫ r² dA of the sector under each straight piece of one pitch.
  std::vector<OutlinePoint> p = tooth_outline(wheel, points);
  const double turn = 2 * pi / std::abs(wheel.teeth);
  p.push_back({std::cos(turn) * p[0].x - std::sin(turn) * p[0].y, std::sin(turn) * p[0].x + std::cos(turn) * p[0].y});
  double sum = 0;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const OutlinePoint &a = p[i], &b = p[i + 1];
    sum += (a.x * b.y - b.x * a.y) * (a.x * a.x + a.x * b.x + b.x * b.x + a.y * a.y + a.y * b.y + b.y * b.y) / 12;
  }
  sum *= std::abs(wheel.teeth);
  const double disc = pi / 32 * squared(squared(bore_or_rim));
  return density * width * (wheel.internal() ? disc - sum : sum - disc);
}

}  // namespace kurbel
