// bevel_worm.cpp — tables, formulas and words of bevel and worm pairs.
#include "studies/gears/bevel_worm.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "engine/numerics/angles.h"
#include "studies/gears/figure_errors.h"

namespace kurbel {
namespace {

std::string number(double v) { return std::isfinite(v) ? fmt::format("{:.6g}", v) : "∞"; }

Findings made(std::string conclusion, Rows table, const FormulaCard& formula) {
  Findings f{.title = "",
             .subtitle = "Basic relations (theory 6)",
             .page_title = table.title,
             .reports_complete = false,
             .footer = report_footer()};
  f.conclude(true, std::move(conclusion));
  const Chapter in = f.chapter("Geometry");
  f.say(in, std::move(table));
  f.show(in, formula);
  return f;
}

// Errors of a bevel pair's figures. δ₂ is the difference of the shaft angle and δ₁, and the rounding error of an
// angle is multiplied by its tangent in z_v.
struct BevelErrors {
  explicit BevelErrors(const BevelPair& b) {
    const Moved<BevelPair> near = moved(b);
    for (const int i : {0, 1}) {
      const std::size_t k = static_cast<std::size_t>(i);
      const double angle = b.cone_angle(i);
      cone_angle[k] = error_by_rounding(
          b, near, [i](const BevelPair& p) { return p.cone_angle(i); }, b.shaft_angle);
      virtual_teeth[k] = error_by_rounding(
          b, near, [i](const BevelPair& p) { return p.virtual_teeth(i); },
          std::abs(b.virtual_teeth(i) * std::tan(angle)) * b.shaft_angle);
    }
    reference_diameter = units_of_rounding * b.reference_diameter(1);
    cone_distance = error_by_rounding(b, near, &BevelPair::cone_distance);
  }
  std::array<double, 2> cone_angle{}, virtual_teeth{};
  double reference_diameter = 0, cone_distance = 0;
};

// Efficiency of both directions over the coefficient of friction.
Plot efficiency_plot(const WormPair& pair) {
  Plot plot{.title = "Efficiency falls with friction; where the wheel cannot drive, the pair is self-locking",
            .x = {"coefficient of friction μ", ""},
            .y = {"efficiency η", ""},
            .series = {{.name = "worm drives", .role = Role::elastic}, {.name = "wheel drives", .role = Role::orange}}};
  WormPair p = pair;
  for (int i = 0; i <= 200; ++i) {
    p.friction = 0.2 * i / 200;
    plot.series[0].add(p.friction, p.efficiency());
    if (p.self_locking()) continue;
    plot.series[1].add(p.friction, p.efficiency_back());
  }
  plot.marks = {{pair.friction, "this pair"}};
  return plot;
}

}  // namespace

Findings findings_of(const BevelPair& b) {
  check(b);
  const BevelErrors e(b);
  const Lines lines = {
      {"teeth", "z", std::to_string(b.teeth[0]), std::to_string(b.teeth[1]), "0", ""},
      {"pitch cone angle", "δ", number(b.cone_angle(0) / degree), number(b.cone_angle(1) / degree),
       error_text(largest_error(e.cone_angle) / degree), "°"},
      {"reference diameter, outer end", "d_e", number(in_millimetres * b.reference_diameter(0)),
       number(in_millimetres * b.reference_diameter(1)), error_text(in_millimetres * e.reference_diameter), "mm"},
      {"cone distance, outer end", "R_e", number(in_millimetres * b.cone_distance()),
       number(in_millimetres * b.cone_distance()), error_text(in_millimetres * e.cone_distance), "mm"},
      {"virtual spur teeth (Tredgold)", "z_v", number(b.virtual_teeth(0)), number(b.virtual_teeth(1)),
       error_text(largest_error(e.virtual_teeth)), ""}};
  const FormulaCard cones{
      .title = "Pitch cones (theory 6.14)",
      .symbols = "tan δ₁ = sin Σ/(u + cos Σ),   δ₂ = Σ − δ₁",
      .numbers = fmt::format("δ₁ = atan({:.6g}/({:.6g} + {:.6g})) = {:.5f}°,   δ₂ = {:.5f}°", std::sin(b.shaft_angle),
                             b.ratio(), std::cos(b.shaft_angle), b.cone_angle(0) / degree, b.cone_angle(1) / degree)};
  Rows table = words_table("Bevel pair", {"of the wheels", "symbol", "1", "2", "numerical error", "unit"}, lines);
  table.text_columns = table.text_columns_on_terminal = 2;
  Findings f = made(
      fmt::format("Bevel pair {}/{} at {:g}°: pitch cones {:.4f}° and {:.4f}°, R_e = {:.4f} mm; its teeth are "
                  "those of spur wheels with {:.1f} and {:.1f} teeth.",
                  b.teeth[0], b.teeth[1], b.shaft_angle / degree, b.cone_angle(0) / degree, b.cone_angle(1) / degree,
                  in_millimetres * b.cone_distance(), b.virtual_teeth(0), b.virtual_teeth(1)),
      std::move(table), cones);
  f.record("ratio", Estimate{b.ratio(), units_of_rounding * b.ratio()});
  f.record("cone_angle", std::array{b.cone_angle(0), b.cone_angle(1)});
  f.record("cone_angle_error", e.cone_angle);
  f.record("cone_distance", Estimate{b.cone_distance(), e.cone_distance});
  f.record("virtual_teeth", std::array{b.virtual_teeth(0), b.virtual_teeth(1)});
  f.record("virtual_teeth_error", e.virtual_teeth);
  return f;
}

Findings findings_of(const WormPair& w, std::optional<double> speed) {
  check(w);
  using W = const WormPair&;
  const Moved<WormPair> near = moved(w);
  const auto by_rounding = [&](std::size_t, const std::function<double(W)>& get) {
    return error_by_rounding(w, near, get);
  };
  const auto angle = [](double v) { return number(v / degree); };
  const auto length = [](double v) { return number(in_millimetres * v); };
  MeasuredQuantities<WormPair> q("Worm pair", {"of the pair", "symbol", "value", "unit"}, std::span(&w, 1),
                                 by_rounding);
  q.quantity("", "starts of the worm, teeth of the wheel", "z", "",
             [](W p) { return fmt::format("{}/{}", p.starts, p.teeth); })
      .quantity("ratio", "ratio", "u", "", &WormPair::ratio, number)
      .quantity("lead_angle", "lead angle", "γ", "°", &WormPair::lead_angle, angle)
      .quantity("centre_distance", "centre distance", "a", "mm", &WormPair::centre_distance, length)
      .quantity("friction_angle", "friction angle", "ρ′", "°", &WormPair::friction_angle, angle)
      .quantity("efficiency", "efficiency, worm drives", "η", "", &WormPair::efficiency, number)
      .quantity("efficiency_back", "efficiency, wheel drives", "η′", "", &WormPair::efficiency_back,
                [&](double v) { return w.self_locking() ? "locks" : number(v); })
      .only_for_programs("self_locking", &WormPair::self_locking);
  if (speed)
    q.quantity(
        "sliding_speed", "sliding speed", "v_g", "m/s", [&](W p) { return p.sliding_speed(std::abs(*speed)); }, number);
  const FormulaCard efficiency{
      .title = "Efficiency in both directions (theory 6.15)",
      .symbols = "η = tan γ/tan(γ + ρ′),   η′ = tan(γ − ρ′)/tan γ,   tan γ = z₁ m/d₁,   tan ρ′ = μ/cos α_n",
      .numbers = fmt::format("γ = {:.4f}°, ρ′ = {:.4f}°:   η = {:.5f},   η′ = {:.5f}", w.lead_angle() / degree,
                             w.friction_angle() / degree, w.efficiency(), w.efficiency_back())};
  const char* const ideal = w.friction == 0 ? " without friction (--friction gives some)" : "";
  Findings f =
      made(fmt::format("Worm pair {}/{}: γ = {:.3f}°, ρ′ = {:.3f}°, η = {:.4f}{} with the worm driving; the wheel {}.",
                       w.starts, w.teeth, w.lead_angle() / degree, w.friction_angle() / degree, w.efficiency(), ideal,
                       w.self_locking() ? "cannot drive: self-locking (γ ≤ ρ′)"
                                        : fmt::format("can drive with η′ = {:.4f}", w.efficiency_back())),
           q.rows(), efficiency);
  f.draw(static_cast<Chapter>(0), [w] { return efficiency_plot(w); });
  for (const Field& field : q.records().front()) f.record(field.key, field.value);
  return f;
}

}  // namespace kurbel
