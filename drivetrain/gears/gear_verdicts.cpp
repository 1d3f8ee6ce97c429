// gear_verdicts.cpp — what an engineer would say about a pair of wheels, in words and numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "drivetrain/gears/gear_pair.h"

namespace kurbel {
namespace {

constexpr double mm = 1e3;
// Customary least tip thickness in modules, of hardened teeth and of any.
constexpr double hardened_tip = 0.4, least_tip = 0.2;

class Verdicts {
 public:
  explicit Verdicts(const GearPair& pair) : p_(pair) {}
  std::vector<GearVerdict> found() {
    contact();
    for (const int i : {0, 1}) wheel(i);
    if (p_.internal()) internal_pair();
    play();
    wear();
    if (list_.empty() || list_.front().finding != Finding::fault) {
      bool valid = true;
      for (const GearVerdict& v : list_) valid = valid && v.finding < Finding::warning;
      if (valid) list_.insert(list_.begin(), {Finding::good, "No undercut, no interference, no pointed tips."});
    }
    return list_;
  }

 private:
  template <class... Args>
  void add(Finding finding, fmt::format_string<Args...> text, Args&&... args) {
    list_.push_back({finding, fmt::format(text, std::forward<Args>(args)...)});
  }

  void contact() {
    const double e = p_.contact_ratio;
    if (e < 1 && p_.total_contact_ratio() < 1)
      add(Finding::fault, "Contact ratio ε_α = {:.4f} < 1: the drive breaks off between two pairs of teeth.", e);
    else if (e < 1)
      add(Finding::warning, "ε_α = {:.4f} < 1: only the overlap ε_β = {:.4f} keeps the wheels in mesh.", e,
          p_.overlap_ratio);
    else if (e < 1.2)
      add(Finding::warning, "Contact ratio ε_α = {:.4g}; at least 1.2 is customary.", e);
    if (p_.data.helix != 0 && p_.overlap_ratio > 0 && p_.overlap_ratio < 1)
      add(Finding::note, "Overlap ε_β = {:.3f} < 1: a width of {:.1f} mm would make it 1.", p_.overlap_ratio,
          mm *
              std::min(p_.wheel[0].width > 0 ? p_.wheel[0].width : p_.wheel[1].width,
                       p_.wheel[1].width > 0 ? p_.wheel[1].width : p_.wheel[0].width) /
              p_.overlap_ratio);
  }

  void wheel(int i) {
    const MeshedWheel &w = p_.wheel[static_cast<std::size_t>(i)], &mate = p_.wheel[static_cast<std::size_t>(1 - i)];
    if (w.undercut)
      add(Finding::warning,
          "Wheel {} (z = {}) is undercut: x = {:.4f} is less than {:.4f}; its flank begins at {:.4f} mm.", i + 1,
          w.teeth, w.generating_shift, w.least_shift_generated(), mm * w.form_diameter);
    interfering(i, w, mate);
    const double tip = w.tip_thickness() / p_.data.module;
    if (tip <= 0)
      add(Finding::fault, "Wheel {} is pointed: its flanks meet at {:.4f} mm, inside the tip circle of {:.4f} mm.",
          i + 1, mm * w.pointed_diameter(), mm * w.tip_diameter);
    else if (tip < least_tip)
      add(Finding::warning,
          "Tips of wheel {} are nearly pointed: s_an = {:.3f} m_n; at least {:.1f} (hardened {:.1f}) is customary.",
          i + 1, tip, least_tip, hardened_tip);
    else if (tip < hardened_tip)
      add(Finding::note, "Tips of wheel {} have s_an = {:.3f} m_n, too thin for hardened teeth (0.4).", i + 1, tip);
    if (w.tip_clearance <= 0)
      add(Finding::fault, "The tip of wheel {} touches the root of wheel {}: clearance {:.4f} mm.", i + 1, 2 - i,
          mm * w.tip_clearance);
    else if (w.tip_clearance < 0.1 * p_.data.module)
      add(Finding::warning, "Clearance of the tip of wheel {} is only {:.3f} m_n.", i + 1,
          w.tip_clearance / p_.data.module);
  }

  // A verdict of its own: undercut may have made room for the tip, or not enough.
  void interfering(int i, const MeshedWheel& w, const MeshedWheel& mate) {
    const Interference found = interference(p_, i);
    if (!found.found()) return;
    if (w.undercut) {
      after_undercut(i, w, mate);
    } else if (found.beyond_base_circle) {
      add(Finding::fault,
          "Interference: the tip of wheel {} would touch wheel {} beyond the end of the line of action on its base "
          "circle; its tip diameter must be at {} {:.4f} mm.",
          2 - i, i + 1, mate.internal() ? "least" : "most", mm * mate.greatest_tip_diameter);
    } else {
      add(Finding::fault,
          "Interference: the tip of wheel {} reaches {:.4f} mm on wheel {}, whose flank ends in the fillet at {:.4f} "
          "mm.",
          2 - i, mm * w.reached_diameter, i + 1, mm * std::abs(w.form_diameter));
    }
  }
  void after_undercut(int i, const MeshedWheel& w, const MeshedWheel& mate) {
    const double room = root_room(p_, i), lost = i == 0 ? p_.start - p_.tip_start : p_.tip_end - p_.end;
    // The tip whose path of contact begins where this flank does.
    const double flank = 0.5 * std::sqrt(w.form_diameter * w.form_diameter - w.base_diameter * w.base_diameter);
    const double leg = std::abs(p_.centre_distance) * std::sin(p_.working_angle) + (mate.internal() ? flank : -flank);
    const std::string remedy =
        fmt::format("a tip diameter of at {} {:.4f} mm ends it", mate.internal() ? "least" : "most",
                    mm * 2 * std::hypot(0.5 * mate.base_diameter, std::max(0.0, leg)));
    if (room < 0)
      add(Finding::fault, "Interference: the tip of wheel {} cuts {:.4f} mm into the undercut root of wheel {}; {}.",
          2 - i, -mm * room, i + 1, remedy);
    else
      add(Finding::warning,
          "Interference: the tip of wheel {} goes {:.4f} mm past the start of the flank of wheel {} on the line of "
          "action. The undercut root has room for it{}, but that part of the path of contact is lost; {}.",
          2 - i, mm * lost, i + 1, std::isfinite(room) ? fmt::format(" ({:.4f} mm)", mm * room) : std::string(),
          remedy);
  }

  void internal_pair() {
    const double fouling = tip_fouling_margin(p_), assembly = radial_assembly_margin(p_);
    if (fouling < 0)
      add(Finding::fault,
          "Tip fouling: the tips overlap outside the path of contact (margin {:.4f} rad); take more difference of "
          "teeth or shorter tips.",
          fouling);
    if (assembly < 0)
      add(Finding::note, "Wheel 1 cannot be put in radially (margin {:.4f} rad): assemble along the axis.", assembly);
  }

  void play() {
    if (p_.backlash_arc < 0)
      add(Finding::fault, "The teeth do not fit: negative backlash j_bn = {:.4f} mm at a_w = {:.4f} mm.",
          mm * p_.backlash_normal, mm * std::abs(p_.centre_distance));
    else if (p_.backlash_arc == 0)
      add(Finding::note, "Without backlash: give an allowance, customary is 0.03 … 0.1 m_n.");
  }

  void wear() {
    if (std::gcd(p_.data.teeth[0], p_.data.teeth[1]) > 1)
      add(Finding::note,
          "Teeth {} and {} have the common divisor {}: the same teeth meet again every {} turns of wheel 1.",
          p_.data.teeth[0], std::abs(p_.data.teeth[1]), std::gcd(p_.data.teeth[0], p_.data.teeth[1]),
          std::lcm(p_.data.teeth[0], p_.data.teeth[1]) / p_.data.teeth[0]);
  }

  const GearPair& p_;
  std::vector<GearVerdict> list_;
};

}  // namespace

Interference interference(const GearPair& p, int i) {
  const MeshedWheel& w = p.wheel[static_cast<std::size_t>(i)];
  constexpr double nothing = 1e-4;  // of the module: less is no interference that a wheel would notice
  Interference found;
  found.beyond_base_circle = i == 0 ? p.tip_start < p.limit_start : !p.internal() && p.tip_end > p.limit_end;
  found.below_form_circle =
      (std::abs(w.form_diameter) - w.reached_diameter) * (w.internal() ? -1 : 1) > nothing * p.data.module;
  return found;
}

double root_room(const GearPair& p, int i) {
  const MeshedWheel &w = p.wheel[static_cast<std::size_t>(i)], &mate = p.wheel[static_cast<std::size_t>(1 - i)];
  const std::vector<FlankPoint> half = half_tooth(w, 200);
  const double pitch = 2 * std::numbers::pi / w.teeth, form = 0.5 * w.form_diameter;
  const double tip = 0.5 * std::abs(mate.tip_diameter),
               corner = std::max(0.0, 0.5 * mate.thickness(mate.tip_diameter)) / tip;
  double least = HUGE_VAL;
  constexpr int steps = 800;  // of two pitches of wheel 1, within which a tooth goes through the mesh
  for (int step = 0; step <= steps; ++step) {
    const MeshPlace place = mesh_place(p, 2 * std::numbers::pi / p.data.teeth[0] * (2.0 * step / steps - 1));
    const double own = i == 0 ? place.angle_1 : place.angle_2, other = i == 0 ? place.angle_2 : place.angle_1;
    const double centre = i == 0 ? p.centre_distance : -p.centre_distance;
    for (int tooth = -2; tooth <= 2; ++tooth)
      for (const int side : {-1, 1}) {
        const double angle = other + tooth * 2 * std::numbers::pi / std::abs(mate.teeth) + side * corner;
        const double x = centre + tip * std::cos(angle), y = tip * std::sin(angle), r = std::hypot(x, y);
        if (r >= form || r <= half.front().radius) continue;
        const auto above = std::lower_bound(half.begin(), half.end(), r,
                                            [](const FlankPoint& q, double radius) { return q.radius < radius; });
        const FlankPoint &b = *above, &a = above == half.begin() ? *above : *(above - 1);
        const double part = b.radius > a.radius ? (r - a.radius) / (b.radius - a.radius) : 0;
        const double from_tooth = std::abs(std::remainder(std::atan2(y, x) - own, pitch));
        least = std::min(least, r * (from_tooth - (a.angle + part * (b.angle - a.angle))));
      }
  }
  return least;
}

std::vector<GearVerdict> verdicts(const GearPair& pair) { return Verdicts(pair).found(); }

}  // namespace kurbel
