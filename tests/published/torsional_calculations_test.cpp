// torsional_calculations_test.cpp — published torsional vibration calculations followed number by number: a marine
// turbine set and a diesel engine's crankshaft with their forced response, and Holzer's table of a chain
// (tests/cases/tv01 … tv03).
#include <fmt/format.h>

#include "studies/modes/modes.h"
#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/validation.h"

namespace kurbel::torsional_calculations_test {
namespace {

using fmt::format;
using test::Against;
using test::published_series;
using test::PublishedSeries;
using test::two_pi;
using test::Validation;

constexpr double rpm = two_pi / 60;
constexpr double lbf_in = 4.4482216152605 * 0.0254;  // [N·m]

double amplitude_in(const ModesStudy& study, const std::string& joint) {
  for (std::size_t j = 0; j < study.joint_names.size(); ++j)
    if (study.joint_names[j] == joint) return study.here.joints[j].amplitude_sum;
  throw std::runtime_error("no joint " + joint);
}

// Amplitude of a shaft in a mode's shape, over that of another; each in its own speed.
double shape_ratio(const ModesStudy& study, std::size_t mode, const std::string& shaft, const std::string& reference) {
  const auto of = [&](const std::string& name) {
    for (std::size_t i = 0; i < study.shaft_names.size(); ++i)
      if (study.shaft_names[i] == name) return study.modes[mode].shape[static_cast<Eigen::Index>(i)];
    throw std::runtime_error("no shaft " + name);
  };
  return of(shaft) / of(reference);
}

// --- TV01: two turbines through two stages of gears on one propeller (Gunter and Chen, ex. 8.1) ---

// The propeller's torque oscillates with its five blades by a tenth of what it takes at 85 rpm. The modal damping ratio
// of the source stands as viscous damping of every shaft, of that ratio at the first mode.
std::string marine_turbines(double amplitude) {
  const auto inertia = [](const std::string& name, double j) {
    return format("[{}]\nkind = \"inertia\"\ninertia = \"{} lbf*in*s2\"\n", name, j);
  };
  const auto shaft = [](const std::string& name, double k) {
    return format(
        "[{}]\nkind = \"coupling\"\nstiffness = \"{} lbf*in/rad\"\ndamping_ratio = 0.00398\n"
        "damping_frequency = \"2.961852525 Hz\"\n",
        name, k);
  };
  const auto drag = [](const std::string& of, double c) {
    return format("[{0}_damping]\nkind = \"bearing drag\"\ndamping = \"{1} lbf*in*s/rad\"\non = \"{0}\"\n", of, c);
  };
  const auto gear = [](const std::string& name, const std::string& teeth, double bull) {
    return format(
        "[{}]\nkind = \"gearbox\"\nstages = [{{ teeth = [{}], inertia = [\"{} lbf*in*s2\", \"0 lbf*in*s2\"] }}]\n",
        name, teeth, bull);
  };
  std::string wave =
      "[blades]\nkind = \"torque source\"\non = \"propeller\"\n[blades.table]\nover = \"angle\"\n"
      "unit = [\"deg\", \"lbf*in\"]\ninterpolation = \"smooth\"\nperiod = \"72 deg\"\npoints = [";
  for (int k = 0; k < 72; ++k)
    wave += format("{}[{}, {:.17g}]", k ? ", " : "", k, amplitude * std::sin(two_pi * k / 72));
  return "line = [\"propeller\", \"propeller_shaft\", \"lp_first\", \"lp_quill\", \"lp_intermediate\", \"lp_second\", "
         "\"lp_shaft\", \"lp_turbine\"]\n[[branch]]\nfrom = \"lp_first.in\"\nline = [\"hp_first\", \"hp_quill\", "
         "\"hp_intermediate\", \"hp_second\", \"hp_shaft\", \"hp_turbine\"]\n" +
         inertia("propeller", 2.454e6) + drag("propeller", 3.86e6) + shaft("propeller_shaft", 826e6) +
         gear("lp_first", "94094, 10000", 0.826e6) + shaft("lp_quill", 203.94e6) + inertia("lp_intermediate", 1.283e4) +
         gear("lp_second", "91231, 21438", 0) + shaft("lp_shaft", 30.51e6) + inertia("lp_turbine", 1.509e4) +
         drag("lp_turbine", 108.77) + gear("hp_first", "94094, 10000", 0) + shaft("hp_quill", 24.17e6) +
         inertia("hp_intermediate", 2.723e4) + gear("hp_second", "58361, 7019", 0) + shaft("hp_shaft", 14.26e6) +
         inertia("hp_turbine", 261.2) + drag("hp_turbine", 42.738) + wave +
         "]\n[effects]\nelasticity = true\n[run]\nstart = { speed = \"85 rpm\" }\n";
}

constexpr double blade_torque_at_85_rpm = 2.224e6;  // a tenth of the propeller's torque [lbf·in]

ModesStudy marine_study() {
  const Scene scene = test::scene_from(marine_turbines(blade_torque_at_85_rpm));
  return find_modes(scene, scene.effects, {.slowest = 14 * rpm, .fastest = 98 * rpm});
}

// Vibratory torque of the propeller's shaft [lbf·in]: linear in the excitation, which goes with the square of the speed.
std::vector<std::pair<double, double>> marine_curve(const ModesStudy& study) {
  std::vector<std::pair<double, double>> curve;
  for (const SpeedResponse& s : study.sweep) {
    const double n = s.speed / rpm;
    for (std::size_t j = 0; j < study.joint_names.size(); ++j)
      if (study.joint_names[j] == "propeller_shaft")
        curve.emplace_back(n, s.joints[j].amplitude_sum / lbf_in * std::pow(n / 85, 2));
  }
  return curve;
}

TEST(MarineTurbineSet, FrequenciesAreThePublishedOnes) {
  const Validation is(Against::published,
                      "Gunter, Chen: marine turbines, two stages of gears, one propeller, ex. 8.1 (case tv01)");
  const ModesStudy study = marine_study();
  ASSERT_EQ(study.modes.size(), 5u);
  const double printed[] = {177.7, 220.2, 1282.6};  // one decimal
  for (std::size_t i = 0; i < 3; ++i)
    is.near(format("natural frequency {}, as printed", i + 1), "1/min", study.modes[i].omega / rpm, printed[i], 0.05);
  const double own[] = {177.71115153, 220.17628309, 1282.5845570, 2496.8671891, 2883.3823815};
  for (std::size_t i = 0; i < 5; ++i)
    is.close(format("natural frequency {}, recomputed", i + 1), "1/min", study.modes[i].omega / rpm, own[i], 1e-8);
}

// Holzer's way from the propeller to both turbines, at the frequency found.
TEST(MarineTurbineSet, FirstModeMovesThePropellerAgainstAllElse) {
  const Validation is(Against::closed_form,
                      "Marine turbines: first mode by Holzer's way from the propeller to both turbines");
  const ModesStudy study = marine_study();
  const double w2 = std::pow(177.71115153 * rpm, 2), first = 9.4094, lp = 40.0424 / first, hp = 78.2365 / first;
  const double bull = 1 - w2 * 2.454e6 / 826e6;
  // Each branch from its turbine inwards, in units of the turbine's angle.
  const auto branch = [&](double turbine, double k_turbine, double ratio, double intermediate, double k_quill) {
    const double torque = w2 * turbine, at_gear = 1 - torque / k_turbine;  // angle of the second pinion
    const double wheel = at_gear / ratio, inner = torque * ratio + w2 * intermediate * wheel;
    return std::pair(wheel - inner / k_quill, wheel);  // quill at the bull gear, intermediate wheel
  };
  const auto [lp_quill, lp_wheel] = branch(1.509e4, 30.51e6, lp, 1.283e4, 203.94e6);
  const auto [hp_quill, hp_wheel] = branch(261.2, 14.26e6, hp, 2.723e4, 24.17e6);
  const double lp_turbine = first * bull / lp_quill, hp_turbine = first * bull / hp_quill;
  is.near("LP turbine over propeller", "", shape_ratio(study, 0, "lp_turbine", "propeller"), lp_turbine,
          1e-8 * std::abs(lp_turbine));
  is.near("LP intermediate wheel over propeller", "", shape_ratio(study, 0, "lp_intermediate", "propeller"),
          lp_turbine * lp_wheel, 1e-7);
  is.near("HP turbine over propeller", "", shape_ratio(study, 0, "hp_turbine", "propeller"), hp_turbine,
          1e-8 * std::abs(hp_turbine));
  is.near("HP intermediate wheel over propeller", "", shape_ratio(study, 0, "hp_intermediate", "propeller"),
          hp_turbine * hp_wheel, 1e-7);
  EXPECT_LT(bull, 0);
}

TEST(MarineTurbineSet, FifthOrderIsCriticalWhereTheCurveHasItsPeak) {
  const Validation is(Against::published,
                      "Gunter, Chen: marine turbines, two stages of gears, one propeller, ex. 8.1 (case tv01)");
  const ModesStudy study = marine_study();
  ASSERT_EQ(study.critical.size(), 2u);  // both modes below 98 rpm · 5
  EXPECT_EQ(study.critical[0].order, 5);
  is.near("critical speed of the fifth order, first mode", "rpm", study.critical[0].speed / rpm, 177.71115153 / 5,
          1e-7);
  is.near("critical speed of the fifth order, second mode", "rpm", study.critical[1].speed / rpm, 220.17628309 / 5,
          1e-7);
  const auto curve = marine_curve(study);
  const auto top =
      *std::max_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  is.near("speed of the greatest torque, read off the figure", "rpm", top.first, 35.46, 0.3);  // as read off the figure
  is.near("greatest torque of the propeller shaft, read off the figure", "lbf·in", top.second, 4.149e6,
          60e3);  // the same
  const Scene scene = test::scene_from(marine_turbines(blade_torque_at_85_rpm * std::pow(35.6 / 85, 2)));
  const ModesStudy there = find_modes(scene, scene.effects, {.speed = 35.6 * rpm});
  // k |θ| of the full matrices; here the shaft's damper counts, too, and the wave is a spline through 72 points.
  const double damper = 2 * 0.00398 * 5 * 35.6 / 177.71115153;
  is.near("torque of the propeller shaft at 35.6 rpm by full matrices", "lbf·in",
          amplitude_in(there, "propeller_shaft") / lbf_in, 4.174976e6 * std::hypot(1, damper), 10);
  EXPECT_NEAR(study.modes[0].ratio, 0.0391 + 0.00398, 2e-4);  // propeller's damping in the mode, and the modal one
}

// A point of the figure is met where the curve passes within its reading: 0.3 rpm to either side, 60e3 lbf·in or 5 %.
TEST(MarineTurbineSet, PropellerShaftFollowsThePublishedCurve) {
  const auto curve = marine_curve(marine_study());
  const PublishedSeries published = published_series("tv01_propeller_shaft.csv", 1, 2);
  ASSERT_EQ(published.x.size(), 55u);
  for (std::size_t i = 0; i < published.x.size(); ++i) {
    double low = HUGE_VAL, high = 0;
    for (const auto& [n, torque] : curve)
      if (std::abs(n - published.x[i]) <= 0.4) low = std::min(low, torque), high = std::max(high, torque);
    const double reading = std::max(60e3, 0.05 * published.y[i]);
    EXPECT_GE(published.y[i], low - reading) << published.x[i] << " rpm";
    EXPECT_LE(published.y[i], high + reading) << published.x[i] << " rpm";
  }
}

// --- TV02: crankshaft of a six-cylinder diesel engine (Mendes, Meirelles, Zampieri 2008) ---

struct Crankshaft {
  std::vector<double> j{0.0170, 0.0090, 0.0467, 0.0327, 0.0467, 0.0467, 0.0327, 0.0487, 2.0750};
  std::vector<double> k{1.106e6, 1.631e6, 1.253e6, 1.253e6, 1.678e6, 1.253e6, 1.253e6, 1.976e6};
  double radius = 0.137 / 2, rod = 0.207, bore = 0.105, oscillating = 2.521, drag = 2, loss = 0.035;
  double fires_at[6] = {360, 120, 600, 240, 480, 0};  // 1-5-3-6-2-4, here from the sixth cylinder [deg]
  PublishedSeries shape = published_series("tv02_cylinder_pressure.csv", 1, 2),
                  peak = published_series("tv02_peak_pressure.csv", 1, 2);

  static double between(const PublishedSeries& c, double x) {
    const auto after = std::upper_bound(c.x.begin() + 1, c.x.end() - 1, x) - c.x.begin();
    const auto b = static_cast<std::size_t>(after), a = b - 1;
    return c.y[a] + (c.y[b] - c.y[a]) * (x - c.x[a]) / (c.x[b] - c.x[a]);
  }
  // [Pa] at a crank angle after the top dead centre of firing [deg, 0 … 720]
  double pressure(double angle, double n) const {
    return between(shape, std::fmod(angle + 360, 720)) / 15.2 * between(peak, n) * 1e6;
  }
  double lever(double phi) const {  // tangential over axial force, times the radius
    const double beta = std::asin(radius / rod * std::sin(phi));
    return radius * std::sin(phi + beta) / std::cos(beta);
  }
  // Of one piston and its share of the rod, by the source's series [N·m].
  double inertia_torque(double phi, double n) const {
    const double l = radius / rod;
    return -oscillating * radius * std::pow(n * rpm, 2) * lever(phi) *
           (std::cos(phi) + l * std::cos(2 * phi) - std::pow(l, 3) / 4 * std::cos(4 * phi) +
            9 * std::pow(l, 5) / 128 * std::cos(6 * phi));
  }

  std::string cylinder(int i, double n) const;
  std::string scene(double n) const;
  std::vector<double> sums_of_amplitudes(double n) const;
};

std::string Crankshaft::cylinder(int i, double n) const {
  std::string text = format(
      "[cylinder{0}]\nkind = \"engine\"\nfiring_order = [1]\nphase = \"{1} deg\"\nbore = \"{2} m\"\nradius = \"{3} "
      "m\"\n"
      "rod = \"{4} m\"\noutside_pressure = \"0 bar\"\ninertia = \"{5} kg*m2\"\n[cylinder{0}.pressure]\nover = "
      "\"angle\"\nunit = [\"deg\", \"Pa\"]\npoints = [[0, {6:.17g}]",
      i, fires_at[i - 1], bore, radius, rod, j[static_cast<std::size_t>(i) + 1], pressure(0, n));
  for (std::size_t p = 0; p < shape.x.size(); ++p)  // the diagram begins at top dead centre without fire
    if (shape.x[p] > 360) text += format(", [{:.17g}, {:.17g}]", shape.x[p] - 360, pressure(shape.x[p] - 360, n));
  for (std::size_t p = 1; p < shape.x.size(); ++p)
    if (shape.x[p] < 360) text += format(", [{:.17g}, {:.17g}]", shape.x[p] + 360, pressure(shape.x[p] + 360, n));
  text += format(", [720, {:.17g}]]\n[piston{}]\nkind = \"torque source\"\non = \"cylinder{}\"\n[piston{}.table]\n",
                 pressure(0, n), i, i, i);
  text += "over = \"angle\"\nunit = [\"deg\", \"N*m\"]\ninterpolation = \"smooth\"\nperiod = \"360 deg\"\npoints = [";
  for (int p = 0; p < 180; ++p)
    text +=
        format("{}[{}, {:.17g}]", p ? ", " : "", 2 * p, inertia_torque((2 * p - fires_at[i - 1]) * two_pi / 360, n));
  return text +
         format("]\n[drag{0}]\nkind = \"bearing drag\"\ndamping = \"{1} N*m*s/rad\"\non = \"cylinder{0}\"\n", i, drag);
}

// At a speed [rpm]. The loss factor stands as viscous damping that is the same at the first mode.
std::string Crankshaft::scene(double n) const {
  std::string line = "\"pulley\", \"k1\", \"gears\"", tables;
  for (std::size_t s = 0; s < k.size(); ++s)
    tables += format(
        "[k{}]\nkind = \"coupling\"\nstiffness = \"{} N*m/rad\"\nloss_factor = {}\ndamping_frequency = \"216.58 Hz\"\n",
        s + 1, k[s], loss);
  for (int i = 1; i <= 6; ++i) {
    line += format(", \"k{}\", \"cylinder{}\"", i + 1, i);
    tables += cylinder(i, n);
  }
  for (const auto& [name, i] : {std::pair{"pulley", 0}, {"gears", 1}, {"flywheel", 8}})
    tables += format("[{}]\nkind = \"inertia\"\ninertia = \"{} kg*m2\"\n", name, j[static_cast<std::size_t>(i)]);
  return format(
      "line = [{}, \"k8\", \"flywheel\"]\n{}[effects]\nelasticity = true\n[run]\nstart = {{ speed = \"{} rpm\" }}\n",
      line, tables, n);
}

// The source's own way: orders ½ … 12 of one cylinder's torque with the phases of the firing order, the damping of each
// shaft η k/ω at each order's frequency. Σ |torque| of each shaft [N·m].
std::vector<double> Crankshaft::sums_of_amplitudes(double n) const {
  constexpr int samples = 4096;
  const Eigen::Index size = 9;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index s = 0; s < 8; ++s) {
    const double value = k[static_cast<std::size_t>(s)];
    stiffness(s, s) += value, stiffness(s + 1, s + 1) += value, stiffness(s, s + 1) -= value,
        stiffness(s + 1, s) -= value;
  }
  std::vector<double> torque(samples), sums(8, 0.0);
  for (int p = 0; p < samples; ++p) {
    const double angle = 720.0 * p / samples, phi = angle * two_pi / 360;
    torque[static_cast<std::size_t>(p)] =
        pressure(angle, n) * two_pi / 8 * bore * bore * lever(phi) + inertia_torque(phi, n);
  }
  for (int h = 1; h <= 24; ++h) {
    std::complex<double> amplitude = 0;
    for (int p = 0; p < samples; ++p)
      amplitude += torque[static_cast<std::size_t>(p)] * std::polar(2.0 / samples, -two_pi * h * p / samples);
    const double w = 0.5 * h * n * rpm;
    Eigen::VectorXcd force = Eigen::VectorXcd::Zero(size);
    Eigen::MatrixXcd dynamic = stiffness.cast<std::complex<double>>() * std::complex<double>(1, loss);
    for (Eigen::Index i = 0; i < size; ++i) {
      const bool fires = i >= 2 && i < 8;
      dynamic(i, i) += std::complex<double>(-w * w * j[static_cast<std::size_t>(i)], fires ? w * drag : 0);
      if (fires) force[i] = amplitude * std::polar(1.0, -0.5 * h * fires_at[i - 2] * two_pi / 360);
    }
    const Eigen::VectorXcd q = test::solved_complex(dynamic, force);
    for (Eigen::Index s = 0; s < 8; ++s)
      sums[static_cast<std::size_t>(s)] += k[static_cast<std::size_t>(s)] * std::abs(q[s + 1] - q[s]);
  }
  return sums;
}

ModesStudy crankshaft_study(const Crankshaft& shaft, double n) {
  const Scene scene = test::scene_from(shaft.scene(n));
  return find_modes(scene, scene.effects,
                    {.speed = n * rpm, .slowest = 0.999 * n * rpm, .fastest = 1.001 * n * rpm, .orders = 12});
}

class DieselCrankshaft : public ::testing::TestWithParam<double> {};

// The source's figures are followed where its indicator diagram holds; what is left is reading and, in the small torque
// of the pulley, the diagram's finer orders. Against the source's own procedure with the same data the difference is
// that of viscous and hysteretic damping away from the first mode's frequency.
TEST_P(DieselCrankshaft, OscillatesByThePublishedTorques) {
  const Validation is(Against::published,
                      "Mendes, Meirelles, Zampieri (2008): crankshaft of a six-cylinder diesel engine (case tv02)");
  const double n = GetParam();
  const Crankshaft shaft;
  const ModesStudy study = crankshaft_study(shaft, n);
  const double flywheel = amplitude_in(study, "k8"), pulley = amplitude_in(study, "k1");
  const std::vector<double> exact = shaft.sums_of_amplitudes(n);
  EXPECT_NEAR(flywheel, exact[7], 0.0065 * exact[7]);
  EXPECT_NEAR(pulley, exact[0], 0.0065 * exact[0]);
  const double printed_flywheel = Crankshaft::between(published_series("tv02_flywheel_torque.csv", 1, 2), n),
               printed_pulley = Crankshaft::between(published_series("tv02_pulley_torque.csv", 1, 2), n);
  is.close(format("{} rpm: torque at the flywheel, read off the figure", n), "N·m", flywheel, printed_flywheel, 0.045);
  is.close(format("{} rpm: torque at the pulley, read off the figure", n), "N·m", pulley, printed_pulley,
           (n < 1940 ? 0.18 : 0.08));
}
INSTANTIATE_TEST_SUITE_P(ThroughTheSixthOrder, DieselCrankshaft,
                         ::testing::Values(1850.4, 2049.7, 2149.3, 2249.8, 2324.1),
                         [](const auto& info) { return format("At{:.0f}Rpm", info.param); });

TEST(DieselCrankshaftCriticals, SixthOrderAndItsNeighboursMeetTheFirstModeWhereTheFiguresPeak) {
  const Validation is(Against::published,
                      "Mendes, Meirelles, Zampieri (2008): crankshaft of a six-cylinder diesel engine (case tv02)");
  const Crankshaft shaft;
  const Scene scene = test::scene_from(shaft.scene(2149.3));
  const ModesStudy study =
      find_modes(scene, scene.effects, {.slowest = 1000 * rpm, .fastest = 2550 * rpm, .orders = 12});
  is.near("first natural frequency", "Hz", study.modes[0].omega / two_pi, 216.58, 0.006);
  const auto critical = [&](double order) {
    for (const CriticalSpeed& c : study.critical)
      if (c.mode == 1 && c.order == order) return c.speed / rpm;
    return 0.0;
  };
  is.near("critical speed of the sixth order", "rpm", critical(6), 216.583605 * 60 / 6, 0.01);
  // Highest points of both figures: 2149 and 2148 rpm, and 1749 rpm in the pulley's.
  is.near("critical speed of the sixth order, read off the figure", "rpm", critical(6), 2149, 25);
  is.near("critical speed of order 7½, read off the figure", "rpm", critical(7.5), 1749, 25);
}

// --- TV03: Holzer's table (Thomson, ex. 12.4-1) ---

const char* const three_discs = R"(
line = ["a", "k1", "b", "k2", "c"]
a = { kind = "inertia", inertia = "5 kg*m2" }
k1 = { kind = "coupling", stiffness = "0.10e6 N*m/rad" }
b = { kind = "inertia", inertia = "11 kg*m2" }
k2 = { kind = "coupling", stiffness = "0.20e6 N*m/rad" }
c = { kind = "torque source", inertia = "22 kg*m2", amplitude = "AMPLITUDE N*m", frequency = "FREQUENCY Hz" }
effects = { elasticity = true }
)";

// The table's last line is the torque that must be taken off the last disc so that the first one vibrates by 1 rad: the
// forced undamped chain answers to it with the table's angles and torques.
TEST(HolzerTable, TorqueLeftOverForcesTheTablesMotion) {
  const Validation is(Against::published, "Thomson: Theory of Vibration, ex. 12.4-1, Holzer's table (case tv03)");
  struct Row {
    double omega, torque1, torque2, torque3;
    double half1, half2, half3;  // units in the last printed place, half of them
  };
  for (const Row& row : {Row{20, 2.0e3, 6.312e3, 14.66e3, 50, 0.5, 5}, Row{40, 8.0e3, 24.19e3, 52.32e3, 50, 5, 5}}) {
    std::string text = test::with(three_discs, "AMPLITUDE", test::digits(row.torque3));
    text = test::with(text, "FREQUENCY", test::digits(row.omega / two_pi));
    const Scene scene = test::scene_from(text);
    const ModesStudy study = find_modes(scene, scene.effects, {});
    const double given = row.half3 / row.torque3;  // the torque that forces is itself rounded
    is.close(format("{} rad/s: torque after disc 1", row.omega), "N·m", amplitude_in(study, "k1"), row.torque1,
             row.half1 + given);
    is.close(format("{} rad/s: torque after disc 2", row.omega), "N·m", amplitude_in(study, "k2"), row.torque2,
             row.half2 + given);
  }
}

TEST(HolzerTable, NaturalFrequenciesLeaveNoTorqueOverAndShapesAreTheTables) {
  const Validation is(Against::closed_form, "Holzer's table of three discs at its natural frequencies (case tv03)");
  std::string text = test::with(three_discs, "AMPLITUDE", "1");
  const Scene scene = test::scene_from(test::with(text, "FREQUENCY", "1"));
  const ModesStudy study = find_modes(scene, scene.effects, {});
  ASSERT_EQ(study.modes.size(), 2u);
  const double own[] = {123.665800, 202.658349};
  for (std::size_t i = 0; i < 2; ++i) {
    const double w = study.modes[i].omega, w2 = w * w;
    is.near(format("natural frequency {}", i + 1), "rad/s", w, own[i], 6e-7);
    const double second = 1 - w2 * 5 / 0.10e6, third = second - w2 * (5 + 11 * second) / 0.20e6;
    EXPECT_NEAR(w2 * (5 + 11 * second + 22 * third), 0, 1e-9 * w2 * 22);
    is.near(format("mode {}: second disc over the first", i + 1), "", shape_ratio(study, i, "b", "a"), second, 1e-11);
    is.near(format("mode {}: third disc over the first", i + 1), "", shape_ratio(study, i, "c", "a"), third, 1e-11);
  }
}

}  // namespace
}  // namespace kurbel::torsional_calculations_test
