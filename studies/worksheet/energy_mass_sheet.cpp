// energy_mass_sheet.cpp — the projection of three diagrams, tangents and what follows from their angles.
#include "studies/worksheet/energy_mass_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "studies/sheet/diagram.h"

namespace kurbel {
namespace {

constexpr double numbers_height = diagram_foot, title_height = diagram_head;

class EnergyMassDrawer {
 public:
  EnergyMassDrawer(Sheets& sheets, const ReduceSheet& sheet)
      : sheet_(sheet),
        w_(*sheet.works),
        d_(w_.sizing.diagram),
        inertia_(w_.sizing.cycle.mechanism.value),
        positions_(sheet.motion.positions),
        origin_(d_.excess.value(sheet.study_way(0))),
        c_(sheets.add("Energy–mass curve and the flywheel")) {
    const Box room = sheets.room();
    const double left = 0.46 * room.width, upper = 0.6 * room.height;
    over_phi_ = {room.x, room.y, left, upper};
    curve_ = {room.x + left + 12, room.y, room.width - left - 12, upper};
    rolled_ = {curve_.x, room.y + upper + 2, curve_.width, room.height - upper - 2};
    words_ = {room.x, room.y + upper + 4, left, room.height - upper - 4};
    choose_scales();
  }

  void draw(const Box& foot) {
    draw_over_phi();
    draw_curve();
    draw_tangent(w_.exact.upper, "ψ_max", Pen::load);
    draw_tangent(w_.exact.lower, "ψ_min", Pen::accent);
    draw_rolled();
    add_lines(c_, words_, result(), 3.1);
    add_lines(c_, foot, scales());
  }

 private:
  double excess(double way) const { return sheet_.from_origin(d_.excess, way); }
  double inertia(double way) const { return inertia_.value(sheet_.study_way(way)); }
  double intercept(const Tangent& t) const { return t.intercept() - origin_; }

  // One scale of energy for ΔT(φ) and the curve. The intercepts are on the paper where they leave the curve a third of it.
  void choose_scales() {
    for (const double way : sheet_.motion.way) {
      low_ = std::min(low_, excess(way)), high_ = std::max(high_, excess(way));
      most_inertia_ = std::max(most_inertia_, inertia(way)), least_inertia_ = std::min(least_inertia_, inertia(way));
    }
    const double fluctuation = high_ - low_;
    const double low = std::min(low_, intercept(w_.exact.lower)), high = std::max(high_, intercept(w_.exact.upper));
    with_intercepts_ = high - low < 3 * fluctuation && least_inertia_ < 0.9 * most_inertia_;
    if (with_intercepts_) low_ = low, high_ = high;
    energy_ = scale_for("μ_T", "J", high_ - low_, curve_.height - numbers_height - title_height - 4);
    zero_ = curve_.bottom() - numbers_height - 1 + energy_.mm(low_);
    from_inertia_ = with_intercepts_ || least_inertia_ < 0.5 * most_inertia_ ? 0 : least_inertia_;
    mass_ = scale_for("μ_I", "kg·m²", std::max(most_inertia_ - from_inertia_, 1e-3 * most_inertia_), curve_.width - 26);
    axis_x_ = curve_.x + 6;
  }
  double x(double inertia) const { return axis_x_ + mass_.mm(inertia - from_inertia_); }
  double y(double energy) const { return zero_ - energy_.mm(energy); }

  void draw_over_phi() {
    const AngleAxis axis = angle_axis(sheet_.reduction.cycle, over_phi_.x + 6, over_phi_.width - 16);
    c_.symbols({axis.left, over_phi_.y + 3}, "ΔT = A_d − A_c, " + energy_.words(), {.size = 3, .bold = true});
    const double bottom = over_phi_.bottom() - numbers_height;
    draw_ordinates(c_, {over_phi_.x, over_phi_.y, over_phi_.width, over_phi_.height}, axis, positions_);
    c_.arrow({axis.left, bottom}, {axis.left, over_phi_.y + title_height - 2}, Pen::body);
    c_.arrow({axis.left, zero_}, {axis.right() + 7, zero_}, Pen::body);
    c_.words({axis.right() + 4, zero_ - 1.5}, "φ", {.size = 3});
    std::vector<Spot> spots;
    for (const double way : sheet_.motion.way) spots.push_back({axis.x(way), y(excess(way))});
    c_.begin_group(
        fmt::format("data-diagram=\"ΔT\" data-per-mm=\"{:.12g}\" data-zero=\"{:.6f}\"", energy_.per_mm, zero_));
    c_.curve(spots, Pen::main);
    for (const SheetPosition& p : positions_) mark("ΔT", p, {axis.x(p.way), y(excess(p.way))}, excess(p.way));
    c_.end_group();
    phi_words_ = axis.words();
  }
  void mark(const char* of, const SheetPosition& p, Spot at, double value) {
    c_.mark(at, p.numbered ? Pen::main : Pen::load,
            fmt::format("data-of=\"{}\" data-position=\"{}\" data-value=\"{:.12g}\"", of, p.label, value));
  }

  void draw_curve() {
    c_.symbols({axis_x_, curve_.y + 3}, "ΔT(I_em), " + mass_.words(), {.size = 3, .bold = true});
    c_.arrow({axis_x_, curve_.bottom() - numbers_height}, {axis_x_, curve_.y + title_height - 2}, Pen::body);
    c_.arrow({axis_x_, zero_}, {curve_.right(), zero_}, Pen::body);
    c_.symbols({curve_.right() - 8, zero_ - 1.5}, "I_em", {.size = 3});
    c_.words({axis_x_ - 1.4, zero_ + 3.4}, from_inertia_ == 0 ? "0" : fmt::format("{:.4g}", from_inertia_),
             {.size = 2.6, .at = "end"});
    std::vector<Spot> spots;
    for (const double way : sheet_.motion.way) spots.push_back({x(inertia(way)), y(excess(way))});
    c_.curve(spots, Pen::main);
    Spot middle;
    for (const Spot& s : spots)
      middle.x += s.x / static_cast<double>(spots.size()), middle.y += s.y / static_cast<double>(spots.size());
    std::vector<Spot> taken;
    for (const SheetPosition& p : positions_) {
      const Spot at = {x(inertia(p.way)), y(excess(p.way))};
      mark("ΔT(I)", p, at, excess(p.way));
      number_beside(at, middle, p, taken);
    }
  }
  // Outside of the closed curve, where nothing is written yet.
  void number_beside(Spot at, Spot middle, const SheetPosition& p, std::vector<Spot>& taken) {
    const double length = std::max(1e-6, std::hypot(at.x - middle.x, at.y - middle.y));
    Spot place;
    for (int i = 0; i < 6; ++i) {
      const double far = 2.8 + 2.4 * i;
      place = {at.x + far * (at.x - middle.x) / length, at.y + far * (at.y - middle.y) / length};
      if (std::none_of(taken.begin(), taken.end(),
                       [&](const Spot& t) { return std::hypot(t.x - place.x, t.y - place.y) < 2.5; }))
        break;
    }
    taken.push_back(place);
    c_.words(
        {place.x, place.y + 0.9}, p.label,
        {.size = 2.6, .at = "middle", .bold = !p.numbered, .pen = p.numbered ? Pen::body : Pen::load, .ground = true});
  }

  // Through its touching point, as far as the box goes.
  void draw_tangent(const Tangent& t, const char* name, Pen pen) {
    const double slope = std::tan(on_paper(t, origin_, energy_, mass_).psi);  // up over right, on paper
    const Spot at = {x(t.inertia), y(t.excess - origin_)};
    const auto along = [&](double dx) { return Spot{at.x + dx, at.y - slope * dx}; };
    const double top = curve_.y + title_height, bottom = curve_.bottom() - numbers_height;
    const double up = std::min(curve_.right() - 4 - at.x, slope > 0 ? (at.y - top) / slope : HUGE_VAL);
    const double down = std::min(at.x - axis_x_, slope > 0 ? (bottom - at.y) / slope : HUGE_VAL);
    c_.line(along(-down), along(up), pen);
    c_.circle(at, 0.9, pen);
    const Spot end = along(up);
    const bool beside = end.x + 26 < curve_.right();  // the line ends at the box's upper edge
    c_.symbols(beside ? Spot{end.x + 1.5, end.y + 2}
                      : Spot{curve_.right() - 1, std::max(end.y, top) + (pen == Pen::load ? -1.5 : 5)},
               fmt::format("{} = {:.4g}°", name, std::atan(slope) * in_degrees),
               {.size = 2.8, .at = beside ? "start" : "end", .pen = pen, .ground = true});
    if (!with_intercepts_) return;
    const Spot meets = {axis_x_, y(intercept(t))};
    c_.circle(meets, 0.9, pen);
    c_.words({meets.x - 1.8, meets.y + 1}, pen == Pen::load ? "k" : "l",
             {.size = 3.2, .at = "end", .bold = true, .pen = pen});
  }

  // I_em over φ, φ downwards, so that every point stands below its own on the curve.
  void draw_rolled() {
    const double height = rolled_.height - 8, step = round_degrees(sheet_.reduction.cycle, height);
    const auto down = [&](double way) { return rolled_.y + 3 + way * in_degrees / step; };
    const double end = down(sheet_.reduction.cycle);
    c_.arrow({axis_x_, rolled_.y + 3}, {axis_x_, std::min(end + 5, rolled_.bottom())}, Pen::body);
    c_.arrow({axis_x_, rolled_.y + 3}, {rolled_.right(), rolled_.y + 3}, Pen::body);
    c_.symbols({rolled_.right() - 8, rolled_.y + 1.6}, "I_em", {.size = 3});
    c_.symbols({axis_x_ + 1.5, std::min(end + 4.6, rolled_.bottom())}, fmt::format("φ, {:g}°/mm", step), {.size = 2.8});
    std::vector<Spot> spots;
    for (const double way : sheet_.motion.way) spots.push_back({x(inertia(way)), down(way)});
    c_.curve(spots, Pen::main);
    double last = -1e9;
    for (const SheetPosition& p : positions_) {
      const Spot at = {x(inertia(p.way)), down(p.way)};
      c_.line({axis_x_, at.y}, at, p.numbered ? Pen::grid : Pen::letter);
      mark("I_em", p, at, inertia(p.way));
      if (!p.numbered) last = std::max(at.y, last + 2.4);
      c_.words({axis_x_ - (p.numbered ? 1.2 : 5.4), (p.numbered ? at.y : last) + 0.9}, p.label,
               {.size = 2.6, .at = "end", .bold = !p.numbered, .pen = p.numbered ? Pen::body : Pen::load});
    }
    c_.words({axis_x_ - 1.2, end + 0.9}, "0", {.size = 2.6, .at = "end"});
  }

  std::string scales() const {
    return fmt::format(
        "{}; {}; {}. Numbers and letters as in the plan: a point of the curve stands level with ΔT and "
        "below it I_em of its position.",
        phi_words_, energy_.words(), mass_.words());
  }

  std::string result() const {
    const Sizing& s = w_.sizing;
    const double mid = s.mid_speed, delta = w_.delta;
    const TangentOnPaper upper = on_paper(w_.exact.upper, origin_, energy_, mass_),
                         lower = on_paper(w_.exact.lower, origin_, energy_, mass_);
    std::string text =
        fmt::format("ω_mid = {:.6g} rad/s, δ = {:.5g} ({})\n", mid, delta,
                    w_.demanded ? "demanded" : "that the machine has with its own inertia; --delta demands another");
    text += fmt::format("ω_max, ω_min = ω_mid (1 ± δ/2) = {:.6g}, {:.6g} rad/s\n", mid * (1 + delta / 2),
                        mid * (1 - delta / 2));
    text += fmt::format("tan ψ_max = ½ ω_max² μ_I/μ_T = {:.5g}, ψ_max = {:.5g}°\n", std::tan(upper.psi),
                        upper.psi * in_degrees);
    text += fmt::format("tan ψ_min = ½ ω_min² μ_I/μ_T = {:.5g}, ψ_min = {:.5g}°\n", std::tan(lower.psi),
                        lower.psi * in_degrees);
    const double kl = upper.intercept - lower.intercept;
    text += fmt::format("on the axis I_em = 0{}: kl = {:.5g} mm\n",
                        with_intercepts_ ? "" : " (beyond the paper, by calculation)", kl);
    text += fmt::format("I_0 = kl μ_T/(ω_mid² δ) = {:.6g} kg·m², of all that turns at a constant ratio, on {}\n",
                        w_.exact.inertia, sheet_.reduction.link);
    if (w_.demanded) return text + flywheel();
    text += fmt::format("In the scene it is {:.6g} kg·m²", sheet_.reduction.constant_inertia);
    if (s.flywheel_added) return text + "; it has no flywheel.";
    return text + fmt::format("; of it the flywheel “{}” {:.6g} kg·m² on its own shaft.", s.flywheel, s.flywheel_now);
  }
  std::string flywheel() const {
    const Sizing& s = w_.sizing;
    if (!s.needed) return "No flywheel is needed: what turns is enough.";
    const double others = s.motor_inertia + s.gearbox_inertia + s.other_inertia;
    return fmt::format(
        "On its own shaft (i = {:.5g}) {:.6g}, less {:.6g} kg·m² of all others:\nI_F = {:.6g} kg·m² of “{}”{}.",
        s.flywheel_ratio, w_.exact.inertia / (s.flywheel_ratio * s.flywheel_ratio), others,
        s.methods.front().flywheel.value, s.flywheel,
        s.flywheel_added ? "" : fmt::format(" (now {:.5g})", s.flywheel_now));
  }

  const ReduceSheet& sheet_;
  const WorksOnSheet& w_;
  const WorkDiagram& d_;
  const Piecewise& inertia_;
  const std::vector<SheetPosition>& positions_;
  double origin_;  // ΔT of the study at position 0
  Canvas& c_;
  Box over_phi_, curve_, rolled_, words_;
  double low_ = 0, high_ = 0, most_inertia_ = 0, least_inertia_ = HUGE_VAL, from_inertia_ = 0;
  bool with_intercepts_ = true;
  Scale energy_, mass_;
  double zero_ = 0, axis_x_ = 0;
  std::string phi_words_;
};

}  // namespace

TangentOnPaper on_paper(const Tangent& t, double energy_of_origin, const Scale& energy, const Scale& inertia) {
  return {std::atan(t.slope * inertia.per_mm / energy.per_mm), energy.mm(t.intercept() - energy_of_origin)};
}

void add_energy_mass(Sheets& sheets, const ReduceSheet& sheet) {
  const Box foot = sheets.foot();
  EnergyMassDrawer(sheets, sheet).draw(foot);
}

}  // namespace kurbel
