// event_cases.cpp — events that coincide, that accumulate, that come by the hundred thousand, at the start and the end.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "Events";

// Four things at one instant: a source off, another on, a load on, a brake on.
HardCase four_at_once() {
  // 0.3 s at 6 N·m, then −9 N·m until it stands: 2 + 1 − 5 − 7, at rest held by 5 + 7 against 3
  const double inertia = 0.5, speed = 6 * 0.3 / inertia, stop = speed * inertia / 9;
  const char* scene =
      "line = [\"disc\"]\ndisc = { kind = \"inertia\", inertia = \"0.5 kg*m2\" }\n"
      "a = { on = \"disc\", kind = \"torque source\", torque = \"4 N*m\", stop = \"0.3 s\" }\n"
      "b = { on = \"disc\", kind = \"torque source\", torque = \"1 N*m\", start = \"0.3 s\" }\n"
      "always = { on = \"disc\", kind = \"torque source\", torque = \"2 N*m\" }\n"
      "load = { on = \"disc\", kind = \"load\", torque = \"5 N*m\", start = \"0.3 s\" }\n"
      "brake = { on = \"disc\", kind = \"brake\", torque = \"7 N*m\", start = \"0.3 s\" }\n"
      "run = { until = \"2 s\" }\n";
  return {.family = family,
          .name = "FourAtOneInstant",
          .parameter = "source off, source, load and brake on at 0.3 s",
          .scene = scene,
          .truths = {closed_form("constant torques", {{"final_angle.disc", 0.5 * speed * 0.3 + 0.5 * speed * stop},
                                                      {"final_speed.disc", 0}})}};
}

// Equal shafts under equal friction, springs without twist between them: all stop at one instant.
HardCase equal_shafts_stop_together(int shafts) {
  const double inertia = 0.2, speed = 30, torque = 12;
  std::string line, tables;
  for (int i = 0; i < shafts; ++i) {
    line += fmt::format("{}\"s{}\"", i > 0 ? fmt::format(", \"c{}\", ", i) : "", i);
    tables += fmt::format(
        "s{0} = {{ kind = \"inertia\", inertia = {1} }}\nf{0} = {{ on = \"s{0}\", kind = \"load\", torque "
        "= {2} }}\n",
        i, quantity(inertia, "kg*m2"), quantity(torque, "N*m"));
    if (i > 0) tables += fmt::format("c{} = {{ kind = \"coupling\", stiffness = \"1 kN*m/rad\" }}\n", i);
  }
  const double stop = inertia * speed / torque;
  return {
      .family = family,
      .name = fmt::format("{}EqualShaftsStopTogether", shafts),
      .parameter = fmt::format("{} at one instant", shafts),
      .scene = fmt::format("line = [{}]\n{}effects = {{ elasticity = true }}\nrun = {{ start = {{ speed = {} }}, until "
                           "= \"1 s\" }}\n",
                           line, tables, quantity(speed, "rad/s")),
      .truths = {closed_form("φ = ½ ω₀ t_s of each", {{"final_angle.s0", 0.5 * speed * stop},
                                                      {fmt::format("final_angle.s{}", shafts - 1), 0.5 * speed * stop},
                                                      {"final_speed.s0", 0}})}};
}

// A mass driven through a gap onto a damped flank bounces ever less: infinitely many bounces in finite time.
//     J₁ ω₁ + J₂ ω₂ = M t; at rest in the flank both turn alike
HardCase bounces_to_rest(double damping_ratio) {
  const double j1 = 0.1, j2 = 1, torque = 5, until = 1.5;
  return {
      .family = family,
      .name = fmt::format("BouncesInItsBacklashDieAway{:.0f}PerMille", damping_ratio * 1e3),
      .parameter = fmt::format("ζ of the flanks = {:g}", damping_ratio),
      .scene = fmt::format(
          "line = [\"a\", \"gap\", \"b\"]\na = {{ kind = \"inertia\", inertia = {} }}\nb = {{ kind = \"inertia\", "
          "inertia "
          "= {} }}\ngap = {{ kind = \"coupling\", stiffness = \"50 kN*m/rad\", damping_ratio = {:.17g}, backlash = \"1 "
          "deg\" }}\ndrive = {{ on = \"a\", kind = \"torque source\", torque = {} }}\n"
          "effects = {{ elasticity = true, backlash = true }}\nrun = {{ until = {} }}\n",
          quantity(j1, "kg*m2"), quantity(j2, "kg*m2"), damping_ratio, quantity(torque, "N*m"), quantity(until, "s")),
      .truths = {closed_form("both turn with M t/(J₁ + J₂)", {{"final_speed.a", torque * until / (j1 + j2)},
                                                              {"final_speed.b", torque * until / (j1 + j2)}})}};
}

// From edge to edge by the closed form, but in plain double arithmetic with angles counted on, as every run has them:
// how far it is off at the end [rad], at worst of ten speeds about ω₀.
double rounding_over_edges(int events, double inertia, double torque, double start) {
  constexpr double piece = pi / 5;
  double worst = 0;
  for (int sample = 0; sample < 10; ++sample) {
    const double begin = start * (1 + 1e-3 * (sample - 5));
    const double high = std::sqrt(begin * begin + 2 * torque * piece / inertia);
    double angle = 0, speed = begin, t = 0;
    for (int k = 0; k < events / 2; ++k) {
      const double edge = (k + 1) * piece, travel = edge - angle;
      const double next = std::sqrt(speed * speed + (k % 2 == 0 ? 2 : -2) * torque * travel / inertia);
      t += 2 * travel / (speed + next);
      angle = edge;
      speed = next;
    }
    worst = std::max(worst, begin * std::abs(t - events / 2 * (2 * piece / (begin + high))));
  }
  return worst;
}

// Load edges over the angle: M = ±M₀ over every 36°, no work in a turn; an edge is a ramp of 10⁻⁶°, two events.
//     T = Σ 2 Δφ/(ω_in + ω_out) a turn
HardCase edges(int events) {
  const double inertia = 0.2, speed = 100, torque = 20, piece = pi / 5, half_ramp = 0.5e-6;
  // Half a ramp of h at either end of a piece does M₀ h/2 instead of M₀ h.
  const double low = std::sqrt(speed * speed - torque * half_ramp * pi / 180 / inertia);
  const double high = std::sqrt(low * low + 2 * torque * piece / inertia);
  const int turns = events / 20;
  const double turn = 10 * 2 * piece / (low + high);
  std::string points = "[0, 0]";
  for (int k = 0; k < 10; ++k) {
    const double m = k % 2 == 0 ? torque : -torque;
    points += fmt::format(", [{:.10g}, {}], [{:.10g}, {}]", 36 * k + half_ramp, m, 36 * (k + 1) - half_ramp, m);
  }
  points += ", [360, 0]";
  return {
      .family = family,
      .name = fmt::format("{}LoadEdgesOverTheAngle", events),
      .parameter = fmt::format("{} edges", events),
      .scene = fmt::format(
          "line = [\"disc\"]\ndisc = {{ kind = \"inertia\", inertia = {} }}\npush = {{ on = \"disc\", kind = \"torque "
          "source\", table = {{ over = \"angle\", unit = [\"deg\", \"N*m\"], period = \"360 deg\", points = [{}] }} "
          "}}\nrun = {{ start = {{ speed = {} }}, until = {} }}\n",
          quantity(inertia, "kg*m2"), points, quantity(speed, "rad/s"), quantity(turns * turn, "s")),
      .truths = {closed_form("T = Σ 2 Δφ/(ω_in + ω_out)",
                             {{"final_angle.disc", turns * 2 * pi}, {"final_speed.disc", speed}})},
      .condition = rounding_over_edges(events, inertia, torque, speed) / 2.2e-16,
      .condition_words = "what rounding makes of the closed form itself from edge to edge"};
}
HardCase a_hundred_thousand_edges() {
  HardCase c = edges(100000);
  c.heavy = true;
  const auto shortened = std::make_shared<const HardCase>(edges(2000));
  for (const std::string& method : all_methods())
    if (method != "auto" && method != "work" && method != "dop853" && method != "multibody")
      c.variants[method] = shortened;
  return c;
}

// Something switches on at t = 0, and something else at the very end: neither is missed, neither acts beyond.
HardCase at_both_ends() {
  return {.family = family,
          .name = "AtTheStartAndAtTheEnd",
          .parameter = "on at t = 0, brake at t = until",
          .scene =
              "line = [\"disc\"]\ndisc = { kind = \"inertia\", inertia = \"0.5 kg*m2\" }\n"
              "a = { on = \"disc\", kind = \"torque source\", torque = \"4 N*m\", start = \"0 s\", stop = \"1 s\" }\n"
              "brake = { on = \"disc\", kind = \"brake\", torque = \"7 kN*m\", start = \"1 s\" }\n"
              "run = { until = \"1 s\" }\n",
          .truths = {closed_form("ω = M t/J", {{"final_speed.disc", 8}, {"final_angle.disc", 4}})}};
}

// The speed comes to rest exactly where the run ends.
HardCase stops_at_the_end() {
  return {.family = family,
          .name = "StopsAtTheVeryEnd",
          .parameter = "J ω₀/M = until",
          .scene =
              "line = [\"disc\"]\ndisc = { kind = \"inertia\", inertia = \"0.5 kg*m2\" }\n"
              "friction = { on = \"disc\", kind = \"load\", torque = \"5 N*m\" }\n"
              "run = { start = { speed = \"10 rad/s\" }, until = \"1 s\" }\n",
          .truths = {closed_form("φ = ½ ω₀ t", {{"final_speed.disc", 0}, {"final_angle.disc", 5}})}};
}

}  // namespace

std::vector<HardCase> event_cases() {
  std::vector<HardCase> cases = {four_at_once(), equal_shafts_stop_together(2), equal_shafts_stop_together(4)};
  for (const double damping : {0.05, 0.2, 0.6}) cases.push_back(bounces_to_rest(damping));
  cases.push_back(edges(2000));
  cases.push_back(a_hundred_thousand_edges());
  cases.push_back(at_both_ends());
  cases.push_back(stops_at_the_end());
  for (HardCase& c : cases) c.budget = c.name.starts_with("100000") ? 20 : 2;
  return cases;
}

}  // namespace kurbel::hard
