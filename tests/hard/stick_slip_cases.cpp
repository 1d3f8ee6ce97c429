// stick_slip_cases.cpp — stops that last, breakaway at the limit, stops on a knife's edge, several stuck elements,
// friction near self-locking.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "StickSlip";
constexpr double inertia = 2, rubs = 12;  // [kg·m²], [N·m]

std::string wheel(const std::string& source, double holds, double speed, double until, const std::string& more = "") {
  return fmt::format(
      "line = [\"source\", \"wheel\"]\nsource = {{ {} }}\nwheel = {{ kind = \"flywheel\", inertia = {} }}\nbearing = "
      "{{ kind = "
      "\"bearing\", on = \"wheel\", torque = {}, static_torque = {} }}\n{}effects = {{ bearing_friction = true }}\nrun "
      "= {{ "
      "start = {{ speed = {} }}, until = {} }}\n",
      source, quantity(inertia, "kg*m2"), quantity(rubs, "N*m"), quantity(holds, "N*m"), more, quantity(speed, "rad/s"),
      quantity(until, "s"));
}

std::string constant(double torque) {
  return fmt::format("kind = \"torque source\", torque = {}", quantity(torque, "N*m"));
}
// M from t = 0 on at `begin`, rising by `rate`, as a table over time.
std::string ramp(double begin, double rate, double until) {
  return fmt::format(
      "kind = \"torque source\", table = {{ over = \"time\", unit = [\"s\", \"N*m\"], points = [[0, {:.17g}], "
      "[{:.17g}, "
      "{:.17g}]] }}",
      begin, until, begin + rate * until);
}

// What the program chooses itself needs a tenth of what low orders need at fine tolerances.
Truth few_steps(std::int64_t by_choice, std::int64_t at_all) {
  return residual(fmt::format("no steps wasted: at most {}, or {} by a method asked for", by_choice, at_all),
                  [=](const Result& r) {
                    const bool asked = r.statistics.reason == "requested";
                    return r.statistics.stepper.steps > (asked ? at_all : by_choice) ? HUGE_VAL : 0.0;
                  });
}

// Runs down against M_k − M, and then stands for 1e4 s under M < M_s: ω₀²/2 = (M_k − M)/J · φ.
HardCase stays_stopped(double part) {
  const double speed = 20, torque = part * rubs, deceleration = (rubs - torque) / inertia;
  return {.family = family,
          .name = fmt::format("StopsAndStandsForTenThousandSecondsUnder{:.0f}PerMilleOfItsFriction", 1000 * part),
          .parameter = fmt::format("M = {:g} M_k", part),
          .scene = wheel(constant(torque), 1.2 * rubs, speed, 1e4),
          .truths = {closed_form(
                         "φ = ½ J ω₀²/(M_k − M), then rest",
                         {{"final_angle.wheel", 0.5 * speed * speed / deceleration}, {"final_speed.wheel", 0, 1e-9}}),
                     few_steps(200 + static_cast<std::int64_t>(0.5 * speed * speed / deceleration),
                               2000 + static_cast<std::int64_t>(5 * speed * speed / deceleration))},
          .condition = 0.5 * speed * speed / deceleration,
          .condition_words = "the last digit of the angle"};
}

// A torque that rises slowly breaks away exactly when it exceeds M_s.
//     t* = M_s/s; J ω = ∫(s t − M_k) dt = ½ s τ² + (M_s − M_k) τ, τ = t − t*
HardCase breakaway(double excess) {
  const double holds = rubs * (1 + excess), rate = 5, start = holds / rate, after = 0.8, until = start + after;
  return {
      .family = family,
      .name = fmt::format("BreaksAwayAtItsLimit{:.0f}PerMilleAboveSliding", 1000 * excess),
      .parameter = fmt::format("M_s = {:g} M_k, torque rises by 5 N·m/s", 1 + excess),
      .scene = wheel(ramp(0, rate, until), holds, 0, until),
      .truths = {closed_form("J ω = ½ s τ² + (M_s − M_k) τ from s t = M_s on",
                             {{"final_speed.wheel", (0.5 * rate * after * after + (holds - rubs) * after) / inertia},
                              {"final_angle.wheel",
                               (rate * after * after * after / 6 + 0.5 * (holds - rubs) * after * after) / inertia}})}};
}

// A constant torque at the limit itself: held at M ≤ M_s, loose beyond.
HardCase at_limit(double part, const std::string& name) {
  const double holds = 15, torque = holds * (1 + part), until = 2;
  const double acceleration = part > 0 ? (torque - rubs) / inertia : 0;
  return {.family = family,
          .name = name,
          .parameter = fmt::format("M = M_s (1 {} {:.0e})", part < 0 ? "−" : "+", std::abs(part)),
          .scene = wheel(constant(torque), holds, 0, until),
          .truths = {closed_form(part > 0 ? "ω = (M − M_k) t/J" : "rest",
                                 {{"final_speed.wheel", acceleration * until},
                                  {"final_angle.wheel", 0.5 * acceleration * until * until}})}};
}

// Slowing down under a torque that rises again: ω = ω₀ − d t + ½ s t², least ω₀ − d²/(2 s). Above zero it goes on;
// below, it stands from the zero until s t = d, M_s = M_k, and leaves with the parabola.
HardCase knife_edge(double part) {
  const double fall = 2, rise = 1, speed = 0.5 * fall * fall / rise * (1 + part), until = 4;  // [rad/s²], [rad/s³]
  const auto parabola = [&](double t) { return speed - fall * t + 0.5 * rise * t * t; };
  double end = parabola(until), angle = speed * until - 0.5 * fall * until * until + rise * until * until * until / 6;
  if (part < 0) {
    const double stop = (fall - std::sqrt(fall * fall - 2 * rise * speed)) / rise, leave = fall / rise;
    end = 0.5 * rise * (until - leave) * (until - leave);
    angle =
        speed * stop - 0.5 * fall * stop * stop + rise * stop * stop * stop / 6 + rise * std::pow(until - leave, 3) / 6;
  }
  return {.family = family,
          .name = fmt::format("SlowsDown{}1em{:.0f}OfItsSpeed", part < 0 ? "ToAStopBeyond" : "AndTurnsBeforeAStopBy",
                              -std::log10(std::abs(part))),
          .parameter = fmt::format("ω₀ = d²/2s (1 {} {:.0e})", part < 0 ? "−" : "+", std::abs(part)),
          .scene = wheel(ramp(rubs - inertia * fall, inertia * rise, until), rubs, speed, until),
          .truths = {closed_form("ω = ω₀ − d t + ½ s t², rest between its zero and s t = d",
                                 {{"final_speed.wheel", end}, {"final_angle.wheel", angle}})}};
}

// A second bearing on the same shaft: they hold while M ≤ Σ M_s.
HardCase two_bearings(double part) {
  const double holds = 15, more_rubs = 5, more_holds = 9, torque = part * (holds + more_holds), until = 1.5;
  const double acceleration = part > 1 ? (torque - rubs - more_rubs) / inertia : 0;
  return {
      .family = family,
      .name = fmt::format("TwoStuckBearings{}", part > 1 ? "BreakAwayTogether" : "HoldTogether"),
      .parameter = fmt::format("M = {:.9g} Σ M_s", part),
      .scene = wheel(constant(torque), holds, 0, until,
                     fmt::format("second = {{ kind = \"bearing\", on = \"wheel\", torque = {}, static_torque = {} }}\n",
                                 quantity(more_rubs, "N*m"), quantity(more_holds, "N*m"))),
      .truths = {closed_form(
          "rest, or ω = (M − Σ M_k) t/J",
          {{"final_speed.wheel", acceleration * until}, {"final_angle.wheel", 0.5 * acceleration * until * until}})}};
}

// A slide that sticks and slips on the spring of its drive.
HardCase stick_slip(double ratio) {
  const std::string scene = fmt::format(
      "line = [\"drive\", \"spring\", \"table\"]\ndrive = {{ kind = \"prescribed speed\", speed = \"0.05 rad/s\" "
      "}}\nspring = "
      "{{ kind = \"coupling\", stiffness = \"900 N*m/rad\", damping_ratio = 0.02 }}\ntable = {{ kind = \"flywheel\", "
      "inertia "
      "= \"12 kg*m2\" }}\nguide = {{ kind = \"bearing\", on = \"table\", torque = \"30 N*m\", static_torque = {} "
      "}}\neffects "
      "= {{ elasticity = true, bearing_friction = true }}\nrun = {{ until = \"5 s\" }}\n",
      quantity(30 * ratio, "N*m"));
  return {.family = family,
          .name = fmt::format("ASlideSticksAndSlipsAtAStaticFrictionOf{:.0f}PerMille", 1000 * ratio),
          .parameter = fmt::format("M_s = {:g} M_k", ratio),
          .scene = scene,
          .truths = {converged(scene, {"final_angle.table", "final_speed.table", "rms_spring_torque.spring"})}};
}

// A prescribed speed that reverses takes the bearing along: its work is −M_k ∫|ω| dt.
//     ω = ω₁ sin(2π f t) over n whole periods: ∫|ω| dt = n 2 ω₁/(π f)
HardCase prescribed(double mean) {
  const double amplitude = 3, hertz = 2, until = 3, f = 2 * pi * hertz;
  const double turn = std::asin(mean / amplitude);  // ω = mean + A sin x < 0 for x in (π + turn, 2π − turn)
  const double backwards = 2 * amplitude * std::cos(turn) - mean * (pi - 2 * turn);
  const double path = (mean * 2 * pi + 2 * backwards) / f * hertz * until;
  const std::string scene = fmt::format(
      "line = [\"drive\", \"wheel\"]\ndrive = {{ kind = \"prescribed speed\", speed = {}, amplitude = {}, frequency = "
      "{} }}\n"
      "wheel = {{ kind = \"flywheel\", inertia = \"2 kg*m2\" }}\nbearing = {{ kind = \"bearing\", on = \"wheel\", "
      "torque = {}, "
      "static_torque = \"15 N*m\" }}\neffects = {{ bearing_friction = true }}\nrun = {{ until = {} }}\n",
      quantity(mean, "rad/s"), quantity(amplitude, "rad/s"), quantity(hertz, "Hz"), quantity(rubs, "N*m"),
      quantity(until, "s"));
  return {.family = family,
          .name = fmt::format("APrescribedSpeedThatReversesTakesFrictionAlongAtMean{:.0f}Tenths", 10 * mean),
          .parameter = fmt::format("ω = {:g} + 3 sin 4πt", mean),
          .scene = scene,
          .truths = {
              closed_form("A = −M_k ∫|ω| dt", {{"work.harmful", -rubs * path}, {"final_angle.wheel", mean * until}})}};
}

// Friction in the mechanism's joints: a rod that is short against the crank pushes its slider against the guide; near
// the limit of self-locking no torque on the slider's side moves the crank.
HardCase joint_friction(double guide, double force, const std::string& name) {
  const Crank crank{.rod = 0.2, .inertia = 0.5};
  const std::string scene = fmt::format(
      "line = [\"motor\", \"crank\"]\nmotor = {{ kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = "
      "\"12 "
      "rad/s\", inertia = \"0.1 kg*m2\" }}\ncrank = {{ {}, load = {{ kind = \"opposing\", force = {} }}, main_bearing "
      "= {{ "
      "radius = \"20 mm\", friction = 0.05, static_friction = 0.1 }}, guide = {{ friction = {}, static_friction = {} "
      "}} }}\n"
      "effects = {{ joint_friction = true }}\nrun = {{ start = {{ angle = \"0.4 rad\" }}, until = \"1 s\" }}\n",
      crank.keys(), quantity(force, "N"), guide, 1.05 * guide);
  return {.family = family,
          .name = name,
          .parameter = fmt::format("μ of the guide {:g}, load {:g} N", guide, force),
          .scene = scene,
          .truths = {converged(scene, {"final_angle.crank", "final_speed.crank"})}};
}

// A guide alone that rubs, a rod without mass: with S along the stroke from rod to slider, N = S tan β,
//     m (x′ α + x″ ω²) = S (1 ∓ μ tan β) − F sgn v,  I α = M(ω) − S x′
// A DC motor's torque at standstill is less than F |x′|/(1 − μ tan β): it stalls on the way, and stays.
struct RubbingGuide {
  Crank crank;
  double friction = 0, force = 0, stall = 60, no_load = 12, rotor = 0.1, start = 0.4;

  using Real = long double;
  Real acceleration(Real phi, Real omega) const {
    constexpr Real small = 1e-5L;
    const Real slope = crank.slope(phi),
               curvature = (crank.slope(phi + small) - crank.slope(phi - small)) / (2 * small);
    const Real inertia = static_cast<Real>(crank.inertia) + rotor, motor = stall * (1 - omega / no_load);
    const Real tangent = std::abs(crank.radius * std::sin(phi)) / crank.root(phi), forwards = slope > 0 ? 1 : -1;
    for (const Real along : {1.0L, -1.0L}) {  // the rod pushes the slider on, or holds it back
      const Real axial =
          (crank.mass * (slope * motor / inertia + curvature * omega * omega) + forwards * static_cast<Real>(force)) /
          (1 - along * friction * tangent + crank.mass * slope * slope / inertia);
      if (axial * forwards * along >= 0) return (motor - axial * slope) / inertia;
    }
    return 0;
  }
  // The angle at which it comes to rest: the classical Runge–Kutta method, its last step by bisection.
  double stalls_at() const {
    Real phi = start, omega = 0;
    const auto step = [this](Real& p, Real& w, Real h) {
      const Real a1 = acceleration(p, w), v2 = w + h / 2 * a1, a2 = acceleration(p + h / 2 * w, v2),
                 v3 = w + h / 2 * a2, a3 = acceleration(p + h / 2 * v2, v3), v4 = w + h * a3,
                 a4 = acceleration(p + h * v3, v4);
      p += h / 6 * (w + 2 * v2 + 2 * v3 + v4);
      w += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    };
    constexpr Real h = 2e-4L;
    for (int i = 0; i < 10000; ++i) {
      Real p = phi, w = omega;
      step(p, w, h);
      if (i > 0 && w <= 0) break;
      phi = p, omega = w;
    }
    const Real last = bisect(
        [&](Real part) {
          Real p = phi, w = omega;
          step(p, w, part);
          return w;
        },
        0, h);
    step(phi, omega, last);
    return static_cast<double>(phi);
  }
};

HardCase stalls_by_its_guide(double rod, double friction, double force) {
  const RubbingGuide machine{.crank = {.rod = rod}, .friction = friction, .force = force};
  const std::string scene = fmt::format(
      "line = [\"motor\", \"crank\"]\nmotor = {{ kind = \"dc shunt motor\", stall_torque = {}, no_load_speed = {}, "
      "inertia = {} }}\ncrank = {{ {}, load = {{ kind = \"opposing\", force = {} }}, guide = {{ friction = {}, "
      "static_friction = {} }} }}\neffects = {{ joint_friction = true }}\nrun = {{ start = {{ angle = {} }}, until = "
      "\"1 s\" }}\n",
      quantity(machine.stall, "N*m"), quantity(machine.no_load, "rad/s"), quantity(machine.rotor, "kg*m2"),
      machine.crank.keys(), quantity(force, "N"), friction, 1.05 * friction, quantity(machine.start, "rad"));
  return {.family = family,
          .name = fmt::format("GuideOfFriction{:.0f}TenthsStallsARodOf{:.0f}MmUnder{:.0f}Newton", 10 * friction,
                              1e3 * rod, force),
          .parameter = fmt::format("l/r = {:g}, μ = {:g}, {:g} N", rod / machine.crank.radius, friction, force),
          .scene = scene,
          .truths = {closed_form("two equations for α and the rod's force, integrated in long double",
                                 {{"final_angle.crank", machine.stalls_at()}, {"final_speed.crank", 0}})}};
}

// A crank at a given speed over whole turns: the guide takes ∮ μ S tan β |dx|, S = (F + |m x″ ω²| by its sign)/(1 − μ
// tan β), the load F four times the radius.
HardCase prescribed_crank(double friction) {
  const Crank crank{.rod = 0.2};
  const double omega = 8, force = 200, turns = 3;
  using Real = long double;
  const auto rubbed = [&](Real phi) {
    constexpr Real small = 1e-5L;
    const Real slope = crank.slope(phi),
               curvature = (crank.slope(phi + small) - crank.slope(phi - small)) / (2 * small);
    const Real tangent = std::abs(crank.radius * std::sin(phi)) / crank.root(phi),
               forwards = std::sin(phi) < 0 ? 1 : -1;
    const Real axial = (force + forwards * crank.mass * curvature * omega * omega) / (1 - friction * tangent);
    return friction * axial * tangent * std::abs(slope);
  };
  constexpr Real half = std::numbers::pi_v<Real>;
  const auto heat = static_cast<double>(simpson(rubbed, 0, half, 2000) + simpson(rubbed, half, 2 * half, 2000));
  const std::string scene = fmt::format(
      "line = [\"drive\", \"crank\"]\ndrive = {{ kind = \"prescribed speed\", speed = {} }}\ncrank = {{ {}, load = {{ "
      "kind = \"opposing\", force = {} }}, guide = {{ friction = {} }} }}\neffects = {{ joint_friction = true }}\nrun "
      "= "
      "{{ until = {} }}\n",
      quantity(omega, "rad/s"), crank.keys(), quantity(force, "N"), friction, quantity(2 * pi * turns / omega, "s"));
  return {.family = family,
          .name = fmt::format("ACrankAtAGivenSpeedRubsItsGuideAt{:.0f}Tenths", 10 * friction),
          .parameter = fmt::format("μ tan β up to {:.2g}", friction * 0.1 / std::sqrt(0.03)),
          .scene = scene,
          .truths = {closed_form("∮ μ S tan β |dx|, 4 r F a turn",
                                 {{"work.harmful", -turns * heat}, {"work.useful", -turns * force * 0.4}})}};
}

}  // namespace

std::vector<HardCase> stick_slip_cases() {
  std::vector<HardCase> cases;
  for (const double part : {0.0, 0.5, 0.999}) cases.push_back(stays_stopped(part));
  for (const double excess : {0.5, 0.01, 0.0}) cases.push_back(breakaway(excess));
  cases.push_back(at_limit(-1e-12, "HoldsATrillionthBelowItsLimit"));
  cases.push_back(at_limit(0, "HoldsAtItsLimit"));
  cases.push_back(at_limit(1e-12, "LetsGoATrillionthAboveItsLimit"));
  for (const double part : {-1e-3, -1e-6, -1e-9, 1e-3, 1e-6, 1e-9}) cases.push_back(knife_edge(part));
  for (const double part : {1 - 1e-9, 1 + 1e-9}) cases.push_back(two_bearings(part));
  for (const double ratio : {1.05, 1.5}) cases.push_back(stick_slip(ratio));
  for (const double mean : {0.0, 1.0}) cases.push_back(prescribed(mean));
  cases.push_back(joint_friction(0.1, 100, "JointFrictionOfASmoothGuide"));
  cases.push_back(joint_friction(0.5, 100, "JointFrictionOfARoughGuide"));
  cases.push_back(joint_friction(1.2, 20, "JointFrictionNearSelfLocking"));
  for (const double friction : {0.3, 1.2, 1.6}) cases.push_back(prescribed_crank(friction));
  cases.push_back(stalls_by_its_guide(0.35, 0.5, 500));
  cases.push_back(stalls_by_its_guide(0.35, 0.7, 500));
  cases.push_back(stalls_by_its_guide(0.2, 0.9, 300));
  cases.push_back(stalls_by_its_guide(0.2, 1.2, 300));
  cases.push_back(stalls_by_its_guide(0.11, 1.0, 100));  // μ tan β = 0.96: locks itself nearly
  return cases;
}

}  // namespace kurbel::hard
