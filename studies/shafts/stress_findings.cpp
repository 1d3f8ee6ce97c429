// stress_findings.cpp — words, tables and curves of shafts' stresses.
#include "studies/shafts/stress_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace kurbel {
namespace {

constexpr double megapascal = 1e6;
constexpr std::size_t orders_drawn = 2, orders_reported = 6, shafts_drawn = 12;

std::string stress_text(double stress) { return fmt::format("{:.4g} MPa", stress / megapascal); }

// "38.2 MPa at 92 rpm, 87 % of the limit for continuous running"
std::string peak_text(const StressPeak& p, const SpeedUnit& unit) {
  std::string text = fmt::format("{} at {}", stress_text(p.stress), unit.text(p.speed, 4));
  if (std::isfinite(p.allowed)) text += fmt::format(", {:.0f} % of the limit for continuous running", 100 * p.use());
  return text;
}

// For a stress beyond the limit for continuous operation in a barred range that is passed: the utilisation of the
// limit for passing. Empty: continuous operation applies.
std::optional<double> use_in_passing(const ShaftStresses& s, const StressPeak& p) {
  const LimitedJoint& joint = s.joints[p.joint];
  const bool barred = std::any_of(s.normal.barred.begin(), s.normal.barred.end(),
                                  [&](const BarredRange& b) { return b.from <= p.speed && p.speed <= b.to; });
  if (p.use() <= 1 || !barred || !joint.limits.shaft.is_of_propulsion() || joint.speed_ratio(p.speed) > 0.8) return {};
  return p.stress / joint.transient(p.speed);
}

// "136 %, barred": beyond the limit for continuous operation, in a range that may be passed.
std::string use_text(const ShaftStresses& s, const StressPeak& p) {
  if (!std::isfinite(p.allowed)) return "—";
  const bool barred = use_in_passing(s, p).value_or(HUGE_VAL) <= 1;
  return fmt::format("{:.0f} %{}", 100 * p.use(), barred ? ", barred" : p.use() > 1 ? " EXCEEDED" : "");
}

std::string passed_text(const ShaftStresses& s, const StressPeak& p) {
  const std::optional<double> use = use_in_passing(s, p);
  if (!use) return "";
  return fmt::format("; this speed lies in a barred range, whose passage uses {:.0f} % of its limit", 100 * *use);
}

// Sums of all orders, for each misfiring cylinder.
std::vector<StressPeak> misfire_peaks(const ShaftStresses& s) {
  std::vector<StressPeak> peaks;
  for (const Firing& firing : s.misfires)
    for (StressPeak& p : stress_peaks(s.joints, firing))
      if (p.order == 0) peaks.push_back(std::move(p));
  return peaks;
}

const StressPeak* worst_of_all(const std::vector<StressPeak>& peaks, const std::vector<std::size_t>& shafts) {
  const StressPeak* worst = nullptr;
  for (const std::size_t j : shafts) {
    const StressPeak* p = worst_sum(peaks, j);
    if (p && (!worst || p->use() > worst->use() || (p->use() == worst->use() && p->stress > worst->stress))) worst = p;
  }
  return worst;
}

Rows peak_table(const ShaftStresses& s, const char* key, const char* title, const char* heading,
                std::vector<StressPeak> peaks) {
  const SpeedUnit& unit = s.unit;
  const ReadAs stress{.factor = 1 / megapascal, .digits = 4}, speed{.factor = unit.of(1), .digits = 5};
  return table_of(key, title, std::move(peaks))
      .headed(heading)
      .text_in(3)
      .column("shaft", "shaft", &StressPeak::shaft)
      .column("misfires", "misfires", &StressPeak::misfires,
              [](const std::string& m) { return m.empty() ? std::string("none") : m; })
      .column("order", "of", &StressPeak::order,
              [](double order) { return order > 0 ? fmt::format("order {:.4g}", order) : std::string("all orders"); })
      .column("stress", "amplitude [MPa]", &StressPeak::stress, stress)
      .column("speed", fmt::format("at [{}]", unit.name), &StressPeak::speed, speed)
      .column("allowed", "allowed there [MPa]", &StressPeak::allowed, stress)
      .only_for_people("use", [&s](const StressPeak& p) { return use_text(s, p); });
}

// From one speed of the sweep to the next.
Series curve_of(const ShaftStresses& s, const Firing& firing, std::string name, Role role, const auto& value) {
  Series series{.name = std::move(name), .role = role};
  for (const SpeedResponse& at : firing.sweep) {
    const double y = at.kept ? value(at) / megapascal : HUGE_VAL;
    if (!std::isfinite(y)) continue;
    series.add(s.unit.of(at.speed), y);
  }
  return series;
}

void draw_limits(const ShaftStresses& s, std::size_t j, Plot& plot) {
  const LimitedJoint& joint = s.joints[j];
  const ShaftRating& shaft = joint.limits.shaft;
  const auto limit = [&](const char* name, Role role, const auto& value) {
    plot.series.push_back(dashed(curve_of(s, s.normal, name, role, value)));
  };
  if (shaft.vibratory)
    limit("allowed by its manufacturer", Role::vermillion, [&](const SpeedResponse&) { return *shaft.vibratory; });
  if (!shaft.is_of_propulsion()) return;
  limit("τ_C, continuous (UR M68)", Role::vermillion,
        [&](const SpeedResponse& r) { return joint.continuous(r.speed); });
  limit("τ_T, passing (UR M68)", Role::orange, [&](const SpeedResponse& r) {
    return joint.speed_ratio(r.speed) <= 0.8 ? joint.transient(r.speed) : HUGE_VAL;
  });
}

Plot stress_plot(const ShaftStresses& s, std::size_t j, const std::vector<StressPeak>& peaks,
                 const std::vector<StressPeak>& misfires) {
  const LimitedJoint& joint = s.joints[j];
  Plot plot{.title = fmt::format("Vibratory stress of {} over the speed", joint.name),
            .x = {"speed of " + s.link, s.unit.name},
            .y = {"amplitude", "MPa"},
            .wide = true};
  const auto sum = [&](const SpeedResponse& r) { return summed_stress(joint, r.joints[j]); };
  plot.series.push_back(curve_of(s, s.normal, "all orders", Role::elastic, sum));
  if (const StressPeak* worst = worst_sum(misfires, j))
    for (const Firing& firing : s.misfires)
      if (firing.misfires == worst->misfires)
        plot.series.push_back(curve_of(s, firing, worst->misfires + " misfires", Role::purple, sum));
  constexpr std::array<Role, orders_drawn> roles = {Role::green, Role::sky};
  std::size_t drawn = 0;
  for (const StressPeak& p : peaks) {
    if (p.joint != j || p.order == 0 || drawn == orders_drawn) continue;
    const auto r = static_cast<std::size_t>(std::lround(p.order / s.normal.fundamental));
    plot.series.push_back(curve_of(s, s.normal, fmt::format("order {:.4g}", p.order), roles[drawn++],
                                   [&](const SpeedResponse& at) { return order_stress(joint, at.orders[j][r]); }));
  }
  draw_limits(s, j, plot);
  for (const BarredRange& b : s.normal.barred)
    if (b.joint == j) plot.bands.push_back({s.unit.of(b.from), s.unit.of(b.to), "barred: " + b.reason});
  return plot;
}

// On the highest utilisation of some shafts; empty: nothing to report.
std::optional<Claim> claim_on(const ShaftStresses& s, const std::vector<std::size_t>& shafts,
                              const std::vector<StressPeak>& peaks, const std::vector<StressPeak>& other) {
  const StressPeak* worst = worst_of_all(peaks, shafts);
  if (!worst || !(worst->stress > 0)) return {};
  const bool limited = std::isfinite(worst->allowed);
  std::string text = fmt::format("vibratory stress {}in \"{}\": {}",
                                 shafts.size() == 1 ? ""
                                 : limited          ? "takes the largest share of its limit "
                                                    : "is greatest ",
                                 worst->shaft, peak_text(*worst, s.unit) + passed_text(s, *worst));
  if (const StressPeak* m = worst_of_all(other, shafts))
    text += fmt::format("; with {} misfiring {}{}", m->misfires,
                        m->shaft == worst->shaft ? "" : fmt::format("in \"{}\" ", m->shaft), peak_text(*m, s.unit));
  // The highest utilisation: in a barred range that may be passed, by the limit for passing.
  const StressPeak* most = worst;
  double use = 0;
  for (const auto* list : {&peaks, &other})
    for (const StressPeak& p : *list) {
      if (std::find(shafts.begin(), shafts.end(), p.joint) == shafts.end()) continue;
      const double passing = use_in_passing(s, p).value_or(HUGE_VAL), used = passing <= 1 ? passing : p.use();
      if (used > use) use = used, most = &p;
    }
  const bool judged = std::isfinite(most->allowed) && use > 0;
  std::optional<Claim> claim =
      claimed(use > 1  ? Predicate::limit_exceeded
              : judged ? Predicate::limit_held
                       : Predicate::figures_told,
              std::move(text), most->shaft,
              judged ? Evidence{.value = most->stress, .limit = most->stress / use, .unit = "Pa"} : Evidence{});
  if (claim) claim->load_case = most->misfires.empty() ? load_case::speed_range : misfire_of + most->misfires;
  return claim;
}

}  // namespace

Claims stress_claims(const ShaftStresses& s) {
  Claims claims;
  if (!s.any()) return claims;
  const std::vector<std::size_t> shafts = judged_shafts(s.joints);
  const std::vector<StressPeak> peaks = stress_peaks(s.joints, s.normal), other = misfire_peaks(s);
  const std::optional<Claim> worst = claim_on(s, shafts, peaks, other);
  add(claims, worst);
  for (const std::size_t j : shafts)
    if (std::optional<Claim> of = claim_on(s, {j}, peaks, other); of && of->is_bad() && of->of != worst->of)
      add(claims, std::move(of));
  return claims;
}

Rows stress_table(const ShaftStresses& s) {
  std::vector<StressPeak> peaks;
  if (s.any()) peaks = stress_peaks(s.joints, s.normal);
  std::vector<std::size_t> reported;
  std::size_t orders = 0;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    orders = peaks[i].order == 0 ? 0 : orders + 1;
    if (orders <= orders_reported) reported.push_back(i);
  }
  Rows table = peak_table(s, "shaft_stress", "Vibratory stress of shafts over the speeds",
                          "vibratory stress of shafts over the speeds", std::move(peaks));
  table.for_people = std::move(reported), table.whole_in_long_form = true;
  return table;
}

Rows misfire_table(const ShaftStresses& s) {
  std::vector<StressPeak> peaks = misfire_peaks(s);
  std::vector<std::size_t> worst;
  for (const std::size_t j : judged_shafts(s.joints))
    if (const StressPeak* p = worst_sum(peaks, j)) worst.push_back(static_cast<std::size_t>(p - peaks.data()));
  Rows table = peak_table(s, "misfires", "Vibratory stress of shafts with one cylinder misfiring, the worst of all",
                          "vibratory stress of shafts with one cylinder misfiring", std::move(peaks));
  table.for_people = std::move(worst), table.whole_in_long_form = true;
  return table;
}

std::vector<Plot> stress_plots(const ShaftStresses& s) {
  std::vector<Plot> plots;
  if (!s.any()) return plots;
  const std::vector<StressPeak> peaks = stress_peaks(s.joints, s.normal), other = misfire_peaks(s);
  for (const std::size_t j : judged_shafts(s.joints))
    if (plots.size() < shafts_drawn) plots.push_back(stress_plot(s, j, peaks, other));
  return plots;
}

DataTable stress_data(const ShaftStresses& s) {
  constexpr NumberFormat format{9};
  DataTable table{.columns = {{.name = "shaft", .words = true},
                              {.name = "misfires", .words = true},
                              {"speed", "rad/s", format},
                              {"amplitude", "Pa", format},
                              {"continuous limit", "Pa", format},
                              {"passing limit", "Pa", format}}};
  const std::size_t harmonics = s.normal.sweep.empty() ? 0 : s.normal.sweep.front().orders.front().size();
  for (std::size_t r = 1; r < harmonics; ++r)
    table.columns.push_back({fmt::format("order {:g}", s.normal.fundamental * static_cast<double>(r)), "Pa", format});
  table.each_row = [&s, harmonics](const std::function<void(DataRow)>& take) {
    const auto known = [](double value) { return std::isfinite(value) ? value : NAN; };
    std::vector<DataCell> cells;
    const auto rows_of = [&](const Firing& firing, std::size_t j) {
      const LimitedJoint& joint = s.joints[j];
      for (const SpeedResponse& at : firing.sweep) {
        if (!at.kept) continue;
        const bool may_pass = joint.limits.shaft.is_of_propulsion() && joint.speed_ratio(at.speed) <= 0.8;
        cells = {joint.name,
                 firing.misfires,
                 at.speed,
                 known(summed_stress(joint, at.joints[j])),
                 known(allowed_amplitude(joint, at.speed)),
                 may_pass ? known(joint.transient(at.speed)) : NAN};
        for (std::size_t r = 1; r < harmonics; ++r) {
          // The same order in a firing condition with a longer cycle.
          const double n = s.normal.fundamental / firing.fundamental * static_cast<double>(r);
          const auto k = static_cast<std::size_t>(std::lround(n));
          cells.emplace_back(k < at.orders[j].size() ? known(order_stress(joint, at.orders[j][k])) : NAN);
        }
        take(cells);
      }
    };
    for (const std::size_t j : judged_shafts(s.joints)) {
      rows_of(s.normal, j);
      for (const Firing& firing : s.misfires) rows_of(firing, j);
    }
  };
  return table;
}

}  // namespace kurbel
