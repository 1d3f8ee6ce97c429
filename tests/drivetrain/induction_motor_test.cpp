// induction_motor_test.cpp — the characteristic through catalogue points, and the ways of starting.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "drivetrain/induction/catalogue_motor.h"
#include "drivetrain/induction/kloss.h"
#include "drivetrain/induction/started_motor.h"
#include "tests/published/published.h"

namespace kurbel::induction_motor_test {
namespace {

using test::figure;
using test::run;

// M at any speed, whatever piece holds there.
double torque_at(const CatalogueMotor& motor, double speed) {
  ShaftState<double> x{0, 0, speed, 0, 1};
  x.mode = motor.first_mode(x);
  return motor.torque(x);
}
double slope_at(const CatalogueMotor& motor, double speed, int piece) {
  return motor.torque(ShaftState<Dual<1>>{0, Dual<1>(0.0), Dual<1>::input(speed, 0), piece, 1}).d[0];
}

// --- the points ---

// Over catalogues at random, with and without a pull-up dip.
class CataloguePointsAtRandom : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    const auto some = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double ws = some(50, 320), slip = some(0.005, 0.08), torque = some(5, 2000), nu = some(1.8, 3.5);
    points.synchronous_speed = ws;
    points.rated = {ws * (1 - slip), torque};
    points.breakdown = {ws * (1 - slip * some(3, 6)), nu * torque};
    if (GetParam() % 2 == 0) {
      points.pull_up = CataloguePoints::Point{ws * some(0.1, 0.4), torque * some(0.8, 1.4)};
      points.starting_torque = torque * some(1.5, 4);  // may be above breakdown
    } else {
      points.starting_torque = torque * some(0.5, 0.9 * nu);
    }
    motor = {points.curve(), ws, torque};
  }
  CataloguePoints points;
  CatalogueMotor motor;
};

TEST_P(CataloguePointsAtRandom, LieOnTheCurve) {
  EXPECT_EQ(torque_at(motor, 0), points.starting_torque);
  EXPECT_EQ(torque_at(motor, points.breakdown.speed), points.breakdown.torque);
  EXPECT_EQ(torque_at(motor, points.rated.speed), points.rated.torque);
  EXPECT_EQ(torque_at(motor, points.synchronous_speed), 0);
  if (points.pull_up) {
    EXPECT_EQ(torque_at(motor, points.pull_up->speed), points.pull_up->torque);
  }
}

TEST_P(CataloguePointsAtRandom, HaveTheOnlyExtremesAtPullUpAndBreakdown) {
  const double ws = points.synchronous_speed;
  const double least_at = points.pull_up ? points.pull_up->speed : 0, greatest_at = points.breakdown.speed;
  double before = torque_at(motor, 0);
  for (int i = 1; i <= 4000; ++i) {
    const double speed = i * ws / 4000, torque = torque_at(motor, speed), step = ws / 4000;
    if (speed <= least_at) {
      EXPECT_LE(torque, before) << speed;
    }
    if (speed - step >= least_at && speed <= greatest_at) {
      EXPECT_GE(torque, before) << speed;
    }
    if (speed - step >= greatest_at) {
      EXPECT_LE(torque, before) << speed;
    }
    before = torque;
  }
  for (const double extreme : {least_at, greatest_at}) {
    const int piece = motor.piece_at(extreme);
    EXPECT_NEAR(slope_at(motor, extreme, piece), 0, 1e-9 * points.breakdown.torque / ws);
  }
}

TEST_P(CataloguePointsAtRandom, AreJoinedWithoutAJumpOfTorqueOrSlope) {
  const double scale = points.breakdown.torque;
  const double steepest = scale / (points.synchronous_speed - points.rated.speed);
  for (std::size_t k = 0; k < motor.curve.x().size(); ++k) {
    const double speed = motor.curve.x()[k];
    const int right = motor.piece_at(speed), left = right - 1;
    EXPECT_NEAR(motor.torque_in(left, speed), motor.torque_in(right, speed), 1e-12 * scale);
    EXPECT_NEAR(slope_at(motor, speed, left), slope_at(motor, speed, right), 1e-11 * steepest) << k;
  }
}

// A generator returns what the motor takes; driven backwards, and beyond twice the synchronous speed, M_st is held.
TEST_P(CataloguePointsAtRandom, GoOnIntoGeneratingAndPlugging) {
  const double ws = points.synchronous_speed;
  for (int i = 1; i < 200; ++i) {
    const double off = i * 1.3 * ws / 200;
    EXPECT_NEAR(torque_at(motor, ws + off), -torque_at(motor, ws - off), 1e-12 * points.breakdown.torque);
  }
  EXPECT_EQ(torque_at(motor, -0.3 * ws), points.starting_torque);
  EXPECT_EQ(torque_at(motor, -7 * ws), points.starting_torque);
  EXPECT_EQ(torque_at(motor, 9 * ws), -points.starting_torque);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CataloguePointsAtRandom, ::testing::Range(1, 41));

// --- Kloss ---

// M_st = 2 M_b (1 + a s_b)/(1/s_b + s_b + 2 a s_b), at s = 1; all torques go with U² (theory 4.1).
TEST(InductionMotor, StartingTorqueIsThatOfKlossAndGoesWithTheSquareOfVoltage) {
  for (const double a : {0.0, 0.6, 1.0}) {
    const auto full = InductionMotor::from_catalogue(11e3, 152.4, 157.07963, 2.6, a, 1);
    const double sb = full.breakdown_slip, mb = 2.6 * 11e3 / 152.4;
    EXPECT_NEAR(full.torque(ShaftState<double>{}), 2 * mb * (1 + a * sb) / (1 / sb + sb + 2 * a * sb), 1e-12 * mb);
    for (const double u : {0.5, 0.9, 1.1}) {
      const auto at_u = InductionMotor::from_catalogue(11e3, 152.4, 157.07963, 2.6, a, u);
      for (const double w : {-40.0, 0.0, 60.0, 140.0, 155.0, 170.0}) {
        const ShaftState<double> x{0, 0, w, 0, 1};
        EXPECT_NEAR(at_u.torque(x), u * u * full.torque(x), 1e-13 * mb);
      }
    }
  }
}

// The breakdown torque is the greatest; with the term a s_b the generator's is (1 + a s_b)/(1 − a s_b) times as great.
TEST(InductionMotor, BreakdownIsGreaterGeneratingThanMotoringWithStatorResistance) {
  for (const double a : {0.0, 0.6, 1.0}) {
    const auto motor = InductionMotor::from_catalogue(11e3, 152.4, 157.07963, 2.6, a, 1);
    const double sb = motor.breakdown_slip, ws = motor.synchronous_speed, mb = 2.6 * 11e3 / 152.4;
    double greatest = 0, least = 0;
    for (int i = -100000; i <= 100000; ++i) {
      const double torque = motor.torque(ShaftState<double>{0, 0, ws * (1 - i * 1e-5), 0, 1});
      greatest = std::max(greatest, torque);
      least = std::min(least, torque);
    }
    EXPECT_NEAR(greatest, mb, 1e-7 * mb);
    EXPECT_NEAR(-least, mb * (1 + a * sb) / (1 - a * sb), 1e-7 * mb);
  }
}

// --- starting, against the closed form of Kloss with a = 0 and no load ---

// J dω/dt = f M_b 2/(s/s_b + s_b/s): from slip s₁ to s₂ the impulse ∫ f dt is
//     J ω_s/(2 M_b) · [ (s₁² − s₂²)/(2 s_b) + s_b ln(s₁/s₂) ].
struct KlossStart {
  double power = 15e3, rated_rpm = 1460, synchronous_rpm = 1500, nu = 2.8, inertia = 2;
  double ws = synchronous_rpm * test::two_pi / 60;
  double mb = nu * power / (rated_rpm * test::two_pi / 60);
  double sn = 1 - rated_rpm / synchronous_rpm;
  double sb = sn * (nu + std::sqrt(nu * nu - 1));

  double impulse(double s1, double s2) const {
    return inertia * ws / (2 * mb) * ((s1 * s1 - s2 * s2) / (2 * sb) + sb * std::log(s1 / s2));
  }
  // The slip reached after this impulse.
  double slip_after(double s1, double wanted) const {
    double low = 1e-9, high = s1;
    for (int i = 0; i < 200; ++i) (impulse(s1, 0.5 * (low + high)) > wanted ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }
  std::string scene(const std::string& start, double until, const std::string& more = "") const {
    return fmt::format(R"(
line = ["motor"]
[motor]
kind = "induction motor"
rated_power = "{} W"
rated_speed = "{} rpm"
synchronous_speed = "{} rpm"
breakdown_ratio = {}
inertia = "{} kg*m2"
{}
{}
[run]
until = "{:.17g} s"
samples = 401
accuracy = 1e-10
)",
                       power, rated_rpm, synchronous_rpm, nu, inertia, start, more, until);
  }
};

TEST(StarDelta, SwitchesAtTheSpeedAndTimeOfTheClosedForm) {
  const KlossStart k;
  const double s_switch = 1 - 1200.0 / 1500, pause = 0.08;
  const double t_star = 3 * k.impulse(1, s_switch), t_end = t_star + pause + k.impulse(s_switch, 0.05);
  const Result r = run(k.scene("starting = \"star-delta\"\nswitch_speed = \"1200 rpm\"\npause = \"80 ms\"", t_end));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_EQ(r.events[0].what, "star opened: no torque");
  EXPECT_NEAR(r.events[0].t, t_star, 1e-10 * t_star);
  EXPECT_EQ(r.events[1].what, "switched to delta");
  EXPECT_NEAR(r.events[1].t, t_star + pause, 6e-8 * t_star);  // when the pause began is remembered to 24 bits
  EXPECT_NEAR(figure(r, "final_speed.motor"), 0.95 * k.ws, 1e-6 * k.ws);
  EXPECT_LE(r.energy.relative, 1e-9);
  EXPECT_NEAR(r.energy.by_line.at("driving"), 0.5 * k.inertia * std::pow(figure(r, "final_speed.motor"), 2), 1e-5);
}

TEST(StarDelta, SwitchesAtTheTimeGiven) {
  const KlossStart k;
  const double t1 = 2, pause = 0.05, s1 = k.slip_after(1, t1 / 3), t2 = 0.4;
  const Result r = run(k.scene("starting = \"star-delta\"\nswitch_time = \"2 s\"\npause = \"50 ms\"", t1 + pause + t2));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_NEAR(r.events[0].t, t1, 1e-13);
  EXPECT_NEAR(r.events[1].t, t1 + pause, 1e-13);
  EXPECT_NEAR(figure(r, "final_speed.motor"), k.ws * (1 - k.slip_after(s1, t2)), 1e-9 * k.ws);
}

// Times count from when the motor is switched on.
TEST(StarDelta, CountsFromSwitchingOn) {
  const KlossStart k;
  const Result r = run(k.scene("start = \"0.7 s\"\nstarting = \"star-delta\"\nswitch_time = \"2 s\"\npause = \"50 ms\"",
                               0.7 + 2.05 + 0.4));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_speed.motor"), k.ws * (1 - k.slip_after(k.slip_after(1, 2.0 / 3), 0.4)), 1e-9 * k.ws);
}

// Off in the middle of star and on again: two seconds of star again, not what was left of them.
TEST(StarDelta, BeginsAnewWheneverItIsSwitchedOn) {
  const KlossStart k;
  const std::string scene =
      k.scene("starting = \"star-delta\"\nswitch_time = \"2 s\"\npause = \"50 ms\"", 1 + 2.05 + 0.4);
  const Result r = run(scene + R"([sequence]
steps = [{ at = "0.5 s", set = "motor", to = 0 }, { at = "1 s", set = "motor", to = 1 }]
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double star = k.slip_after(k.slip_after(1, 0.5 / 3), 2.0 / 3);
  EXPECT_NEAR(figure(r, "final_speed.motor"), k.ws * (1 - k.slip_after(star, 0.4)), 1e-9 * k.ws);
}

// Half speed of a fan in star: a third of the torque is all that the machine sees; no pause, no step in speed.
TEST(StarDelta, GivesAThirdOfTheTorqueInStarAndAllInDelta) {
  const InductionMotor motor = InductionMotor::from_catalogue(15e3, 152.9, 157.08, 2.8, 0, 1);
  const StartedMotor<InductionMotor, StarDelta> started{motor, {1, 0, 0.1}, HUGE_VAL};
  for (const double speed : {-20.0, 0.0, 100.0, 150.0, 170.0}) {
    const auto torque = [&](double t) {
      ShaftState<double> x{t, 0, speed, 0, 1};
      x.mode = started.first_mode(x);
      return started.torque(x);
    };
    const double all = motor.torque(ShaftState<double>{0, 0, speed, 0, 1});
    EXPECT_NEAR(torque(0.5), all / 3, 1e-12 * std::abs(all));
    EXPECT_EQ(torque(1.05), 0);
    EXPECT_EQ(torque(1.2), all);
  }
}

// ∫ u² dt over the ramp from u₀ to u is T (u³ − u₀³)/(3 (1 − u₀)).
TEST(SoftStart, RunsUpWithTheSquareOfTheRisingVoltage) {
  const KlossStart k;
  const double ramp = 4, u0 = 0.4;
  const Result r = run(k.scene("starting = \"soft start\"\nramp = \"4 s\"\ninitial_voltage = 0.4", 4.1));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.events[0].what, "full voltage");
  EXPECT_NEAR(r.events[0].t, ramp, 1e-13);
  const auto omega = test::series(r, "speed.motor");
  for (const std::size_t row : {40u, 120u, 200u, 250u}) {
    const double t = r.trajectory->time()[row], u = u0 + (1 - u0) * t / ramp;
    const double impulse = ramp * (u * u * u - u0 * u0 * u0) / (3 * (1 - u0));
    EXPECT_NEAR(omega[row], k.ws * (1 - k.slip_after(1, impulse)), 1e-8 * k.ws) << t;
  }
  EXPECT_LE(r.energy.relative, 1e-9);
}

// At the limit the torque is constant: J dω/dt = M_limit between the two events.
TEST(SoftStart, HoldsItsTorqueLimit) {
  const KlossStart k;
  const Result r = run(k.scene("starting = \"soft start\"\nramp = \"0.5 s\"\ntorque_limit = \"60 N*m\"", 6));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 3u);
  EXPECT_EQ(r.events[0].what, "at its torque limit");
  EXPECT_EQ(r.events[1].what, "full voltage");
  EXPECT_EQ(r.events[2].what, "below its torque limit");
  // Where M_Kloss comes down to the limit: s² − 2 (M_b/M) s_b s + s_b² = 0, the smaller root.
  const double q = k.mb / 60, slip = k.sb * (q - std::sqrt(q * q - 1));
  const double t0 = r.events[0].t, t1 = r.events[2].t;
  const auto omega = test::series(r, "speed.motor");
  const double at_limit_from = k.ws * (1 - slip) - 60 / k.inertia * (t1 - t0);
  double peak = 0;
  for (std::size_t row = 0; row < omega.size(); ++row) {
    const double t = r.trajectory->time()[row];
    if (t > t0 && t < t1) {
      EXPECT_NEAR(omega[row], at_limit_from + 60 / k.inertia * (t - t0), 1e-8 * k.ws) << t;
    }
    peak = std::max(peak, test::series(r, "torque.motor")[row]);
  }
  EXPECT_EQ(peak, 60);
}

// --- frequency converter ---

using Converted = StartedMotor<InductionMotor, FrequencyConverter>;

double converted_torque(const Converted& motor, double t, double speed) {
  ShaftState<double> x{t, 0, speed, 0, 1};
  x.mode = motor.first_mode(x);
  return motor.torque(x);
}

// Below rated frequency the same torque belongs to the same slip speed; above it the curve falls with (f_n/f)².
TEST(FrequencyConverter, ShiftsTheCurveAndWeakensItAboveRatedFrequency) {
  const InductionMotor motor = InductionMotor::from_catalogue(15e3, 152.9, 157.08, 2.8, 0, 1);
  const double ws = motor.synchronous_speed, slip_speed = ws * motor.breakdown_slip;
  const Converted started{motor, {10, 2.5 * ws, ws}, HUGE_VAL};
  for (const double f : {0.1, 0.4, 0.9}) {  // over the rated frequency
    const double t = 10 * f / 2.5;
    EXPECT_NEAR(converted_torque(started, t, f * ws - slip_speed), motor.breakdown_torque,
                1e-12 * motor.breakdown_torque);
    EXPECT_NEAR(converted_torque(started, t, f * ws), 0, 1e-12 * motor.breakdown_torque);
    EXPECT_NEAR(converted_torque(started, t, f * ws - 5), motor.torque(ShaftState<double>{0, 0, ws - 5, 0, 1}),
                1e-12 * motor.breakdown_torque);
  }
  for (const double f : {1.2, 2.0, 2.5}) {
    const double t = f == 2.5 ? 11 : 10 * f / 2.5;
    double greatest = 0, at = 0;
    for (int i = 0; i < 100000; ++i) {
      const double speed = f * ws * i * 1e-5, torque = converted_torque(started, t, speed);
      if (torque > greatest) greatest = torque, at = speed;
    }
    EXPECT_NEAR(greatest, motor.breakdown_torque / (f * f), 1e-8 * motor.breakdown_torque);
    EXPECT_NEAR(at, f * ws - slip_speed, 2e-5 * f * ws);
  }
}

// On a long ramp the motor follows the field at the slip speed of the torque J α + M: M_K(Δ) = J α, exactly once
// settled.
TEST(FrequencyConverter, RampAcceleratesAtItsOwnRateWithTheSlipOfThatTorque) {
  const KlossStart k;
  const Result r = run(k.scene("starting = \"frequency converter\"\nramp = \"10 s\"", 9));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double alpha = k.ws / 10, q = k.mb / (k.inertia * alpha), slip = k.sb * (q - std::sqrt(q * q - 1));
  EXPECT_NEAR(figure(r, "final_speed.motor"), alpha * 9 - slip * k.ws, 1e-8 * k.ws);
  EXPECT_LE(r.energy.relative, 1e-9);
}

TEST(FrequencyConverter, PassesTheKneeAndTheTargetAtTheirTimes) {
  const KlossStart k;
  const Result r = run(k.scene("starting = \"frequency converter\"\nramp = \"10 s\"\ntarget_speed = \"2000 rpm\"", 14));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_EQ(r.events[0].what, "field weakens");
  EXPECT_NEAR(r.events[0].t, 7.5, 1e-12);
  EXPECT_EQ(r.events[1].what, "frequency at its target");
  EXPECT_NEAR(r.events[1].t, 10, 1e-12);
  EXPECT_NEAR(figure(r, "final_speed.motor"), 2000 * test::two_pi / 60, 1e-6 * k.ws);
}

// A short ramp: the torque stays at the limit until the slip is small again; the limit holds in braking, too.
TEST(FrequencyConverter, ItsTorqueLimitHoldsInBothDirections) {
  const KlossStart k;
  const std::string drive = "starting = \"frequency converter\"\nramp = \"0.01 s\"\ntorque_limit = \"60 N*m\"";
  const Result r = run(k.scene(drive, 4));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto omega = test::series(r, "speed.motor");
  EXPECT_NEAR((omega[300] - omega[100]) / 2.0, 60 / k.inertia, 1e-9 * 60 / k.inertia);
  EXPECT_NEAR(figure(r, "final_speed.motor") / k.ws, 0.764, 0.01);
  const Result braking = run(test::with(k.scene(drive, 1.0), "[run]", "[run]\nstart = { speed = \"2500 rpm\" }"));
  ASSERT_TRUE(braking.complete) << braking.diagnosis;
  const auto slower = test::series(braking, "speed.motor");
  EXPECT_NEAR((slower[400] - slower[100]) / 0.75, -60 / k.inertia, 1e-9 * 60 / k.inertia);
}

// In a scene, too, the points' torques are those of the catalogue times the square of the voltage.
TEST(StartedMotors, ByCataloguePointsFollowTheVoltage) {
  const KlossStart k;
  for (const double u : {1.0, 0.9}) {
    const Result r = run(k.scene(fmt::format("starting_ratio = 2.2\nvoltage_factor = {}", u), 0.1));
    EXPECT_NEAR(test::series(r, "torque.motor")[0], u * u * 2.2 * k.mb / k.nu, 1e-12 * k.mb);
  }
}

// At any moment and speed the torque is finite and within its limit, and the modes that hold there say so.
template <class Motor, class Starter>
void expect_finite_within_limit(const Motor& motor, const Starter& starter, double limit) {
  const StartedMotor<Motor, Starter> started{motor, starter, limit};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> time(-1, 12), speed(-3, 5);
  for (int i = 0; i < 3000; ++i) {
    ShaftState<double> x{time(random), 0, speed(random) * motor.synchronous_speed, 0, 1};
    x.on_since = -0.5;
    x.mode = started.first_mode(x);
    const double torque = started.torque(x);
    EXPECT_TRUE(std::isfinite(torque)) << x.t << " s, " << x.rate;
    EXPECT_LE(std::abs(torque), limit * (1 + 1e-14));
    double g[5];
    started.guard(x, g);
    for (const double guard : g) EXPECT_GE(guard, 0) << x.t << " s, " << x.rate;
  }
}
TEST(StartedMotors, TorqueIsFiniteAndWithinItsLimitEverywhere) {
  const InductionMotor kloss = InductionMotor::from_catalogue(15e3, 152.9, 157.08, 2.8, 0.8, 1);
  const CataloguePoints points{
      .starting_torque = 210, .breakdown = {135, 290}, .rated = {153, 98}, .synchronous_speed = 157.08};
  const CatalogueMotor catalogue{points.curve(), 157.08, 98};
  for (const double limit : {70.0, HUGE_VAL}) {
    expect_finite_within_limit(kloss, StarDelta{4, 0, 0.3}, limit);
    expect_finite_within_limit(catalogue, StarDelta{-1, 120, 0.3}, limit);
    expect_finite_within_limit(catalogue, SoftStart{0, 5}, limit);
    expect_finite_within_limit(kloss, FrequencyConverter{5, 420, 157.08}, limit);
    expect_finite_within_limit(catalogue, FrequencyConverter{5, 80, 157.08}, limit);
  }
}

// The characteristic by points can be started in every way, too, and its corners cost no accuracy.
TEST(StartedMotors, ByCataloguePointsCloseTheEnergyBalance) {
  const KlossStart k;
  const std::string points = "starting_ratio = 2.2\npull_up_ratio = 1.7\npull_up_speed = \"350 rpm\"\n";
  const std::string fan = "[fan]\nkind = \"load\"\non = \"motor\"\nquadratic = \"0.002 N*m*s2/rad2\"";
  for (const std::string start :
       {"starting = \"direct\"", "starting = \"star-delta\"\nswitch_speed = \"1350 rpm\"\npause = \"60 ms\"",
        "starting = \"star-delta\"\nswitch_time = \"3 s\"", "starting = \"soft start\"\nramp = \"3 s\"",
        "starting = \"soft start\"\nramp = \"3 s\"\ntorque_limit = \"120 N*m\"",
        "starting = \"frequency converter\"\nramp = \"4 s\"\ntorque_limit = \"150 N*m\"\ntarget_speed = \"1800 "
        "rpm\""}) {
    const Result r = run(k.scene(points + start, 8, fan));
    ASSERT_TRUE(r.complete) << start << r.diagnosis;
    EXPECT_TRUE(r.accuracy_confirmed) << start;
    EXPECT_LE(r.energy.relative, 1e-9) << start;
  }
}

}  // namespace
}  // namespace kurbel::induction_motor_test
