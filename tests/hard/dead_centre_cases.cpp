// dead_centre_cases.cpp — starts from rest on and beside the dead centres, with and without static friction.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "DeadCentre";
const Crank crank;

std::string crank_scene(const std::string& more, const std::string& load, double angle, double until,
                        const std::string& line = "\"crank\"") {
  return fmt::format("line = [{}]\ncrank = {{ {}{} }}\n{}run = {{ start = {{ angle = {} }}, until = {} }}\n", line,
                     crank.keys(), load.empty() ? "" : ", load = " + load, more, quantity(angle, "rad"),
                     quantity(until, "s"));
}

// --- beside the folded dead centre, where a force towards the extended end drives away from it ---
//     ½ I_r ω² = F (x(φ) − x(φ₀)), φ = π + ε cosh u: du/dt = √(2 F (x − x₀)/I_r)/(ε sinh u), regular from u = 0 on.
constexpr double force = 400;

long double gained(long double away, long double start) {  // x(π + away) − x(π + start), without cancellation
  const long double s = std::sin(0.5L * (away + start)), d = std::sin(0.5L * (away - start));
  const long double cosines = 2 * s * d;                                     // cos(start) − cos(away)
  const long double squares = cosines * (std::cos(start) + std::cos(away));  // sin² away − sin² start
  const long double roots = crank.root(away) + crank.root(start);
  return crank.radius * cosines - crank.radius * crank.radius * squares / roots;
}

struct Motion {
  double angle, speed;
};

Motion away_from_folded(double start, double t) {
  const long double e = start;
  const auto away = [&](long double u) { return e * std::cosh(u); };
  const auto speed = [&](long double u) {
    return std::sqrt(2 * force * gained(away(u), e) / crank.reduced_inertia(pi + away(u)));
  };
  const auto rate = [&](long double u) {
    if (u < 1e-6L) {
      const long double curvature = crank.radius - static_cast<long double>(crank.radius) * crank.radius / crank.rod;
      return std::sqrt(force * curvature / crank.inertia);
    }
    return speed(u) / (e * std::sinh(u));
  };
  const long double u = integrate_scalar(rate, 0.0L, static_cast<long double>(t), 20000);
  return {static_cast<double>(pi + away(u)), static_cast<double>(speed(u))};
}

HardCase beside_folded(double off) {
  const double until = 0.35 + 0.13 * std::log(0.1 / off);
  const auto at = [&](double t) {
    const Motion m = away_from_folded(off, t);
    return closed_form("½ I ω² = F Δx, and t = ∫dφ/ω with φ = π + ε cosh u",
                       {{"final_angle.crank", m.angle}, {"final_speed.crank", m.speed, 30}});
  };
  const auto scene = [&](double t) {
    return crank_scene("", fmt::format("{{ kind = \"constant\", force = {} }}", quantity(force, "N")), pi + off, t);
  };
  HardCase c{.family = family,
             .name = fmt::format("LeavesTheFoldedEndByItsForceFrom{:.0f}Digits", -std::log10(off)),
             .parameter = fmt::format("{:.0e} rad beside the dead centre", off),
             .scene = scene(until),
             .truths = {at(until)}};
  const Motion m = away_from_folded(off, until), shifted = away_from_folded(off * (1 + 1e-6), until);
  c.condition = pi * std::abs(shifted.angle - m.angle) / (1e-6 * off);
  c.condition_words = "the start angle π + ε holds its last digit only: ∂φ(T)/∂ε, measured on the closed form";
  HardCase shortened = c;
  const double short_time = 0.6 * until;
  shortened.scene = scene(short_time);
  shortened.truths = {at(short_time)};
  shortened.excluded.clear();
  if (off > 1e-3) c.variants["multibody"] = std::make_shared<HardCase>(std::move(shortened));
  return c;
}

// Exactly on a dead centre the force has no lever: a balance, which the program must say.
HardCase on_dead_centre(const std::string& end, double angle) {
  return {
      .family = family,
      .name = "OnThe" + end + "EndAForceHasNoLeverAndThatIsSaid",
      .parameter = fmt::format("{:.6g} rad", angle),
      .scene = crank_scene("", fmt::format("{{ kind = \"constant\", force = {} }}", quantity(force, "N")), angle, 1),
      .refusal = {"starts at rest where no torque moves it"}};
}

// --- a torque M against a force F that opposes motion: nothing holds on the dead centre itself, and beyond it the
// crank stalls where the work is used up, M (φ − φ₀) = F |x(φ) − x(φ₀)|, and is held there ---
HardCase stalls(double part, double start, const std::string& end) {
  const double torque = part * force * crank.radius;
  const auto balance = [&](long double away) {
    return torque * away - force * std::abs(crank.position(start + away) - crank.position(start));
  };
  const auto angle = static_cast<double>(start + bisect(balance, 1e-3L * part, 0.5L * pi));
  return {.family = family,
          .name = fmt::format("StallsBesideThe{}EndUnder{:.0f}PerMilleOfTheForce", end, 1000 * part),
          .parameter = fmt::format("M = {:g} F r", part),
          .scene =
              crank_scene(fmt::format("motor = {{ kind = \"torque source\", torque = {} }}\n", quantity(torque, "N*m")),
                          fmt::format("{{ kind = \"opposing\", force = {} }}", quantity(force, "N")), start, 3,
                          "\"motor\", \"crank\""),
          .truths = {
              closed_form("M (φ − φ₀) = F |x(φ) − x(φ₀)|", {{"final_angle.crank", angle}, {"final_speed.crank", 0}})}};
}

// --- static friction: a bearing that holds M_s and rubs with M_k; M = part · M_s ---
//     ½ I_r ω² = (M − M_k) (φ − φ₀) = (M − M_k) s², t = ∫ 2 √(I_r/(2 (M − M_k))) ds
HardCase with_bearing(double part, double start, const std::string& end) {
  const double holds = 20, rubs = 12, torque = part * holds, turned = 7.5;
  double until = 1, angle = start, speed = 0;
  if (part > 1) {
    const double net = torque - rubs;
    until = static_cast<double>(
        simpson([&](long double s) { return 2 * std::sqrt(crank.reduced_inertia(start + s * s) / (2 * net)); }, 0.0L,
                std::sqrt(static_cast<long double>(turned)), 4000));
    angle = start + turned;
    speed = static_cast<double>(std::sqrt(2 * net * turned / crank.reduced_inertia(angle)));
  }
  return {.family = family,
          .name = fmt::format("{}TheStaticFrictionOnThe{}End{}", part > 1 ? "Overcomes" : "IsHeldBy", end,
                              std::abs(part - 1) < 1e-5 ? "ByAMillionth" : ""),
          .parameter = fmt::format("M = {:.7g} M_s", part),
          .scene = crank_scene(
              fmt::format("motor = {{ kind = \"torque source\", torque = {} }}\nbearing = {{ kind = \"bearing\", on = "
                          "\"crank\", torque = {}, static_torque = {} }}\neffects = {{ bearing_friction = true }}\n",
                          quantity(torque, "N*m"), quantity(rubs, "N*m"), quantity(holds, "N*m")),
              "", start, until, "\"motor\", \"crank\""),
          .truths = {closed_form("½ I ω² = (M − M_k) Δφ, and t = ∫dφ/ω with φ = φ₀ + s²",
                                 {{"final_angle.crank", angle}, {"final_speed.crank", speed}})}};
}

// --- friction in the main bearing, loaded by the slider's force F alone: it holds M ≤ ρ F, ρ = r_b sin(atan f) ---
HardCase with_joint_friction(double part) {
  const double journal = 0.04, coefficient = 0.15;
  const double limit = journal * std::sin(std::atan(coefficient)) * force;
  const auto scene = crank_scene(
      fmt::format("motor = {{ kind = \"torque source\", torque = {} }}\neffects = {{ joint_friction = true }}\n",
                  quantity(part * limit, "N*m")),
      fmt::format("{{ kind = \"constant\", force = {} }}, main_bearing = {{ radius = {}, friction = 0.05, "
                  "static_friction = {} }}",
                  quantity(-force, "N"), quantity(journal, "m"), coefficient),
      0, 0.3, "\"motor\", \"crank\"");
  HardCase c{.family = family,
             .name = fmt::format("JointFriction{}OnTheExtendedEnd{}", part > 1 ? "IsOvercome" : "Holds",
                                 std::abs(part - 1) < 1e-5 ? "ByAMillionth" : ""),
             .parameter = fmt::format("M = {:.7g} ρ F", part),
             .scene = scene};
  if (part > 1) {
    c.truths = {converged(scene, {"final_angle.crank", "final_speed.crank"})};
  } else {
    c.truths = {closed_form("it does not move", {{"final_angle.crank", 0}, {"final_speed.crank", 0}})};
  }
  return c;
}

// No motor: a cylinder pushes the slider away from the end that it rests beside.
//     ½ (I + m x′²) ω² = p A (x(φ₀) − x(φ))
HardCase cylinder_pushes_off(double off) {
  const Crank crank;
  const double force = 1200, area = 0.25 * pi * 0.05 * 0.05;
  const std::string scene = fmt::format(
      "line = [\"crank\"]\ncrank = {{ {}, load = {{ kind = \"cylinder\", bore = \"50 mm\", outside_pressure = \"0 "
      "Pa\", "
      "pressure = {{ over = \"travel\", unit = [\"mm\", \"Pa\"], points = [[0, {:.17g}], [200, {:.17g}]] }} }} "
      "}}\nrun = {{ start = {{ angle = {} }}, until = \"{} s\" }}\n",
      crank.keys(), force / area, force / area, quantity(off, "rad"), off < 1e-4 ? 1.3 : 0.5);
  return {.family = family,
          .name = fmt::format("ACylinderPushesOffBesideTheEnd{}", off < 1e-4 ? "Close" : ""),
          .parameter = fmt::format("φ₀ = {:g} rad", off),
          .scene = scene,
          .truths = {residual("½ (I + m x′²) ω² = p A (x(φ₀) − x(φ)), over p A 2 r", [=](const Result& r) {
            const double phi = r.find("final_angle.crank")->value, omega = r.find("final_speed.crank")->value;
            if (std::abs(phi) < 0.5) return 1.0;  // it has left
            const auto inertia = crank.reduced_inertia(phi);
            const auto work = force * (crank.position(off) - crank.position(phi));
            return static_cast<double>(std::abs(0.5L * inertia * omega * omega - work) / (force * 2 * crank.radius));
          })}};
}

}  // namespace

std::vector<HardCase> dead_centre_cases() {
  std::vector<HardCase> cases;
  for (const double off : {1e-2, 1e-5, 1e-9}) cases.push_back(beside_folded(off));
  for (const double off : {1e-2, 1e-6}) cases.push_back(cylinder_pushes_off(off));
  cases.push_back(on_dead_centre("Extended", 0));
  cases.push_back(on_dead_centre("Folded", pi));
  for (const double part : {0.3, 0.01}) {
    cases.push_back(stalls(part, 0, "Extended"));
    cases.push_back(stalls(part, pi, "Folded"));
  }
  for (const double part : {1.2, 1 + 1e-6, 1 - 1e-6}) {
    cases.push_back(with_bearing(part, 0, "Extended"));
    cases.push_back(with_bearing(part, pi, "Folded"));
  }
  for (const double part : {1.2, 1 + 1e-6, 1 - 1e-6}) cases.push_back(with_joint_friction(part));
  return cases;
}

}  // namespace kurbel::hard
