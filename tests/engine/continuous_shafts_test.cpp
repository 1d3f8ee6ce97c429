// continuous_shafts_test.cpp — shafts by their dimensions against the wave equation: modes, responses, end torques.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/linear/shaft_waves.h"
#include "engine/model/continuous_shafts.h"
#include "engine/numerics/lobatto_element.h"
#include "studies/modes/modes.h"
#include "studies/run/compare.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"

namespace kurbel::continuous_shafts_test {
namespace {

using test::figure;
using test::run;

constexpr double shear = 79.3e9, density = 7850;

// A solid steel shaft, its inertia and its exact 2 × 2 transfer of (φ, M) along it.
struct Steel {
  double length, diameter;
  double polar() const { return M_PI / 32 * std::pow(diameter, 4); }
  double inertia() const { return density * polar() * length; }
  double stiffness() const { return shear * polar() / length; }
};

struct State {
  double angle = 1, torque = 0;  // torque that it passes on
  void past(double inertia, double omega) { torque += inertia * omega * omega * angle; }
  void along(const Steel& s, double omega) {
    const double beta = omega * std::sqrt(density / shear), x = beta * s.length, gib = shear * s.polar() * beta;
    const double phi = angle * std::cos(x) - torque * std::sin(x) / gib;
    torque = angle * gib * std::sin(x) + torque * std::cos(x);
    angle = phi;
  }
  // To a shaft that turns 1/i as fast.
  void through(double ratio) { angle /= ratio, torque *= ratio; }
};

// The free train: inertia, shaft, ratio, inertia, …: what is left at its end vanishes at its frequencies.
struct Train {
  std::vector<double> inertia;
  std::vector<Steel> shaft;
  std::vector<double> ratio;  // of a gear behind each shaft, 1: none
  double rest(double omega) const {
    State s;
    s.past(inertia[0], omega);
    for (std::size_t k = 0; k < shaft.size(); ++k) {
      s.along(shaft[k], omega);
      s.through(ratio[k]);
      s.past(inertia[k + 1], omega);
    }
    return s.torque;
  }
  std::vector<double> roots(double highest) const {
    std::vector<double> found;
    const double step = highest / 20000;
    for (double w = step; w < highest; w += step) {
      double low = w, high = w + step;
      if (rest(low) * rest(high) > 0) continue;
      for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (rest(low) * rest(middle) <= 0 ? high : low) = middle;
      }
      found.push_back(0.5 * (low + high));
    }
    return found;
  }
  std::string scene() const {
    std::string line = "\"j0\"",
                text = fmt::format("j0 = {{ kind = \"inertia\", inertia = \"{:.17g} kg*m2\" }}\n", inertia[0]);
    for (std::size_t k = 0; k < shaft.size(); ++k) {
      line += fmt::format(", \"s{}\"", k);
      text += fmt::format("s{} = {{ kind = \"shaft\", length = \"{:.17g} m\", diameter = \"{:.17g} m\" }}\n", k,
                          shaft[k].length, shaft[k].diameter);
      if (ratio[k] != 1) {
        line += fmt::format(", \"g{}\"", k);
        text +=
            fmt::format("g{} = {{ kind = \"gearbox\", stages = [{{ teeth = [40, {:.0f}] }}] }}\n", k, 40 * ratio[k]);
      }
      line += fmt::format(", \"j{}\"", k + 1);
      text += fmt::format("j{} = {{ kind = \"inertia\", inertia = \"{:.17g} kg*m2\" }}\n", k + 1, inertia[k + 1]);
    }
    return fmt::format("line = [{}]\n{}effects = {{ elasticity = true }}\n", line, text);
  }
};

ModesStudy modes_of(const std::string& text, int count = 6) {
  const Scene scene = test::scene_from(text);
  ModesOptions options;
  options.count = count;
  options.speed = 0;
  return find_modes(scene, scene.effects, options);
}

TEST(LobattoElement, keeps_inertia_and_static_stiffness) {
  for (int p = 1; p <= highest_lobatto_degree; ++p) {
    const LobattoElement& e = lobatto_element(p);
    double inertia = 0;
    for (const double w : e.weight) {
      EXPECT_GT(w, 0);
      inertia += w;
    }
    EXPECT_NEAR(inertia, 1, 1e-14);
    for (int k = 0; k < p; ++k) {  // of equal torques each part twists by its share
      double twist = 0;
      for (int l = 0; l < p; ++l) twist += e.compliance[static_cast<std::size_t>(k * p + l)];
      EXPECT_NEAR(twist, e.share(k), 1e-12) << p;
    }
    EXPECT_NEAR(element_stiffness(p, 1e-9).against, 2, 1e-12);
  }
}

// Where d_element(ω) lets the ends of the case vibrate, against tan βL: degree 4 misses the first mode by 8e-7, 6 the
// second by 2e-6 (theory 5.20), and the bound is one.
TEST(LobattoElement, converges_as_known) {
  const Steel shaft{40, 0.4};
  const double a = 800 / shaft.inertia(), b = 300 / shaft.inertia();
  const auto root = [&](auto&& ends, double low, double high) {
    const auto rest = [&](double x) {
      const EndStiffness d = ends(x);
      const double own = 0.5 * (d.together + d.against), other = 0.5 * (d.together - d.against);
      return (own - a * x * x) * (own - b * x * x) - other * other;
    };
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (rest(low) * rest(middle) <= 0 ? high : low) = middle;
    }
    return low;
  };
  const double first = root(exact_stiffness, 1, 2), second = root(exact_stiffness, 3.5, 4.5);
  EXPECT_NEAR(first * std::sqrt(shear / density) / 40 / (2 * M_PI), 20.0461, 1e-4);
  const auto off = [&](int p, double x, double low, double high) {
    return std::abs(root([p](double at) { return element_stiffness(p, at); }, low, high) / x - 1);
  };
  EXPECT_NEAR(off(4, first, 1, 2), 8.2e-7, 0.5e-7);
  EXPECT_NEAR(off(6, second, 3.5, 4.5), 1.9e-6, 0.1e-6);
  for (const int p : {1, 2, 3, 4, 5}) EXPECT_LT(off(p, first, 1, 2), 1.5 * dispersion(p, first)) << p;
}

TEST(ContinuousShaft, modes_of_the_case_lie_within_their_errors) {
  const Scene scene = test::scene_file("tests/cases/reports/shaft_by_dimensions.toml");
  const ModesStudy study = find_modes(scene, scene.effects, {});
  const Train exact{{800, 300}, {{40, 0.4}}, {1}};
  const std::vector<double> roots = exact.roots(700);
  ASSERT_GE(study.modes.size(), 2u);
  const double worst[] = {1e-6, 1e-3};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LE(std::abs(study.modes[k].omega - roots[k]), study.modes[k].error) << k;
    EXPECT_LE(study.modes[k].error, worst[k] * roots[k]) << k;
  }
  EXPECT_NEAR(study.modes[0].omega / (2 * M_PI), 20.0461, 1e-4);
}

// Random trains, stepped and geared, some without an inertia between: every mode that is listed is one, within its error,
// and none below the last one is missing.
TEST(ContinuousShaft, modes_of_random_trains_are_those_of_transfer_matrices) {
  std::mt19937 random(5);
  const auto some = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>()(random));
  };
  for (int repeat = 0; repeat < 20; ++repeat) {
    Train train{{some(1, 500)}, {}, {}};
    for (int k = 0; k < 1 + repeat % 3; ++k) {
      train.shaft.push_back({some(0.3, 30), some(0.08, 0.4)});
      train.ratio.push_back(repeat % 4 == 1 ? std::round(40 * some(0.5, 4)) / 40 : 1);
      train.inertia.push_back(repeat % 5 == 2 && k == 0 && repeat % 3 > 0 ? 0 : some(1, 500));
    }
    SCOPED_TRACE(train.scene());
    const ModesStudy study = modes_of(train.scene(), 3);
    ASSERT_GE(study.modes.size(), train.shaft.size());
    const double last = study.modes.back().omega + 2 * study.modes.back().error;
    const std::vector<double> roots = train.roots(1.3 * last);
    for (const Mode& mode : study.modes) {
      double nearest = HUGE_VAL;
      for (const double root : roots) nearest = std::min(nearest, std::abs(root - mode.omega));
      EXPECT_LE(nearest, 1.2 * mode.error + 1e-9 * mode.omega) << mode.omega;
    }
    const double above = study.modes.back().omega * 1.0001 + study.modes.back().error;
    const auto below = std::count_if(roots.begin(), roots.end(), [&](double w) { return w < above; });
    EXPECT_EQ(continuous_modes_below(study.drive, above), below + 1);
    const bool reported = std::any_of(study.notes.begin(), study.notes.end(), [](const std::string& note) {
      return note.find("continuous shafts have") != std::string::npos;
    });
    EXPECT_TRUE(reported || static_cast<std::size_t>(below) == study.modes.size());
  }
}

// Torques at the ends are those of a free body: what the inertias on either side take as all accelerate together.
TEST(ContinuousShaft, end_torques_are_those_of_a_free_body) {
  const Steel shaft{40, 0.4};
  const double total = 800 + 300 + shaft.inertia(), torque = 1000;
  for (const char* elasticity : {"true", "false"}) {
    const Result r = run(fmt::format(R"(
line = ["engine", "shaft", "propeller"]
engine = {{ kind = "inertia", inertia = "800 kg*m2" }}
drive = {{ kind = "torque source", torque = "1 kN*m", on = "engine" }}
shaft = {{ kind = "shaft", length = "40 m", diameter = "400 mm", damping_ratio = 0.02 }}
propeller = {{ kind = "inertia", inertia = "300 kg*m2" }}
effects = {{ elasticity = {} }}
run = {{ start = "equilibrium", until = "0.2 s" }}
)",
                                     elasticity));
    EXPECT_NEAR(figure(r, "peak_torque.shaft.in"), torque * (1 - 800 / total), 1e-5);
    EXPECT_NEAR(figure(r, "peak_torque.shaft"), torque * (300 + shaft.inertia() / 2) / total, 1e-5);
    EXPECT_NEAR(figure(r, "peak_torque.shaft.out"), torque * 300 / total, 1e-5);
  }
}

// A sudden torque on the engine of the case, without damping: rigid motion and all modes of the wave equation,
//     ω(L, t) = M t/ΣJ + Σ φ_n(0) φ_n(L) M sin(ω_n t)/(ω_n m_n)
TEST(ContinuousShaft, long_run_is_the_sum_of_the_modes) {
  const Steel shaft{40, 0.4};
  const Train train{{800, 300}, {shaft}, {1}};
  const double torque = 1000, until = 2, total = 1100 + shaft.inertia();
  double speed = torque * until / total;
  for (const double w : train.roots(6e3)) {
    const double beta = w * std::sqrt(density / shear), length = 40,
                 s = 800 * w / std::sqrt(shear * density) / shaft.polar();
    // φ = cos βx − s sin βx from GI φ′ = −J₁ ω² φ at the engine; ∫ φ² by its closed form.
    const auto at = [&](double x) { return std::cos(beta * x) - s * std::sin(beta * x); };
    const double square = length / 2 * (1 + s * s) + (1 - s * s) * std::sin(2 * beta * length) / (4 * beta) -
                          s * std::pow(std::sin(beta * length), 2) / beta;
    const double mass = 800 + 300 * std::pow(at(length), 2) + density * shaft.polar() * square;
    speed += torque * at(length) * std::sin(w * until) / (w * mass);
  }
  const Result r = run(R"(
line = ["engine", "shaft", "propeller"]
engine = { kind = "inertia", inertia = "800 kg*m2" }
drive = { kind = "torque source", torque = "1 kN*m", on = "engine" }
shaft = { kind = "shaft", length = "40 m", diameter = "400 mm" }
propeller = { kind = "inertia", inertia = "300 kg*m2" }
effects = { elasticity = true }
run = { until = "2 s" }
)");
  const Figure* found = r.find("final_speed.propeller");
  ASSERT_NE(found, nullptr);
  EXPECT_LE(std::abs(found->value - speed), found->error.value());
  EXPECT_LE(found->error.value(), 0.02 * std::abs(speed));
}

// Forced response: with both ends' inertias driven at one end, what passes the middle by the wave equation. The free body of
// half the element's points would stand for the half shaft's inertia to 0.33 % at degree 5 and 0.6 of the first frequency;
// the slope of the polynomial through them gives it to 2e-7.
TEST(ContinuousShaft, forced_response_is_that_of_the_waves) {
  const Scene scene = test::scene_from(R"(
line = ["engine", "shaft", "propeller"]
engine = { kind = "inertia", inertia = "800 kg*m2" }
shake = { kind = "torque source", amplitude = "1 kN*m", frequency = "12 Hz", on = "engine" }
shaft = { kind = "shaft", length = "40 m", diameter = "400 mm" }
propeller = { kind = "inertia", inertia = "300 kg*m2" }
effects = { elasticity = true }
)");
  ModesOptions options;
  options.speed = 10;
  const ModesStudy study = find_modes(scene, scene.effects, options);
  const double omega = 2 * M_PI * 12;
  const Steel half{20, 0.4}, whole{40, 0.4};
  // From the free end at the propeller back to the engine.
  State s;
  s.past(300, omega);
  s.along(half, omega);
  const double middle = s.torque;
  s = {};
  s.past(300, omega);
  s.along(whole, omega);
  s.past(800, omega);
  const double scale = 1000 / std::abs(s.torque);
  const auto shaft = std::find(study.joint_names.begin(), study.joint_names.end(), "shaft");
  ASSERT_NE(shaft, study.joint_names.end());
  EXPECT_NEAR(study.here.joints[static_cast<std::size_t>(shaft - study.joint_names.begin())].peak,
              scale * std::abs(middle), 1e-6 * scale * std::abs(middle));
}

// The same by `run`, from rest: 19 lumps have within 7e-4 what the waves have in the middle, the free body of half of a few
// points 5e-3 more than they.
TEST(ContinuousShaft, middle_torque_of_a_run_is_that_of_many_lumps) {
  const std::string text = R"(
line = ["engine", "shaft", "propeller"]
engine = { kind = "inertia", inertia = "800 kg*m2" }
shake = { kind = "torque source", amplitude = "1 kN*m", frequency = "12 Hz", on = "engine" }
shaft = { kind = "shaft", length = "40 m", diameter = "400 mm", damping_ratio = 0.05CUT }
propeller = { kind = "inertia", inertia = "300 kg*m2" }
effects = { elasticity = true }
run = { until = "1 s" }
)";
  const auto with_cut = [&](const std::string& cut) {
    std::string one = text;
    one.replace(one.find("CUT"), 3, cut);
    return run(one);
  };
  const Result element = with_cut(""), lumps = with_cut(", segments = 19");
  for (const char* what : {"peak_torque", "peak_spring_torque", "rms_torque"}) {
    const double right = figure(lumps, std::string(what) + ".shaft.10"),
                 reported = figure(element, std::string(what) + ".shaft");
    EXPECT_NEAR(reported, right, 1.5e-3 * std::abs(right)) << what;
  }
}

// A polynomial of the element's degree has its own slope in the middle; of equal torques it is theirs.
TEST(LobattoElement, middle_torque_is_the_slope_of_the_polynomial) {
  for (int p = 3; p <= highest_lobatto_degree; p += 2) {
    const LobattoElement& e = lobatto_element(p);
    ASSERT_EQ(e.middle.size(), static_cast<std::size_t>(p));
    double sum = 0;
    for (const double w : e.middle) sum += w;
    EXPECT_NEAR(sum, 1, 1e-11) << p;
    for (int n = 1; n <= p; ++n) {
      std::vector<double> twist;  // of φ = −(s − 0.3)ⁿ
      for (int k = 0; k < p; ++k)
        twist.push_back(std::pow(e.place[static_cast<std::size_t>(k + 1)] - 0.3, n) -
                        std::pow(e.place[static_cast<std::size_t>(k)] - 0.3, n));
      double torque = 0;
      for (int k = 0; k < p; ++k)
        for (int l = 0; l < p; ++l)
          torque += e.middle[static_cast<std::size_t>(k)] * e.stiffness[static_cast<std::size_t>(k * p + l)] *
                    twist[static_cast<std::size_t>(l)];
      EXPECT_NEAR(torque, n * std::pow(0.2, n - 1), 1e-10) << p << " " << n;
    }
  }
}

// Its damping is that of the shaft as a whole, by the inertias that it joins, however it is cut.
TEST(ContinuousShaft, damping_does_not_depend_on_the_cut) {
  const std::string text = R"(
line = ["a", "s", "b"]
a = { kind = "inertia", inertia = "2 kg*m2" }
s = { kind = "shaft", length = "3 m", diameter = "40 mm", damping_ratio = 0.03CUT }
b = { kind = "inertia", inertia = "1 kg*m2" }
effects = { elasticity = true }
)";
  std::vector<double> damping;
  for (const char* cut : {"", ", segments = 1", ", segments = 7"}) {
    std::string one = text;
    one.replace(one.find("CUT"), 3, cut);
    const auto model = compile(test::scene_from(one), Effects{true, {}});
    double softness = 0;
    for (const ElasticJoint& e : model->elastic)
      softness += 1 / model->network.joints[static_cast<std::size_t>(e.joint)].element->damping;
    damping.push_back(1 / softness);
  }
  const Steel s{3, 0.04};
  const double reduced = 1 / (1 / (2 + s.inertia() / 2) + 1 / (1 + s.inertia() / 2));
  for (const double c : damping) EXPECT_NEAR(c / (2 * 0.03 * std::sqrt(s.stiffness() * reduced)), 1, 1e-9);
}

// Rigid it is one shaft with its neighbours, as ever.
TEST(ContinuousShaft, costs_nothing_while_it_is_rigid) {
  const Scene scene = test::scene_file("tests/cases/reports/shaft_by_dimensions.toml");
  const auto model = compile(scene, Effects{});
  EXPECT_EQ(model->shafts.size(), 1u);
  EXPECT_TRUE(model->elastic.empty());
  EXPECT_TRUE(model->internal_states.empty());
  EXPECT_NEAR(model->shafts[0].inertia, 1100 + (Steel{40, 0.4}.inertia()), 1e-9);
}

// The parts of a divided shaft and the places between them have names of their own, each once.
TEST(ContinuousShaft, SegmentsAndStationsAreNamedApart) {
  const auto study = [](const std::string& shaft) {
    const Scene scene = test::scene_from(R"(
line = ["a", "shaft", "b"]
a = { kind = "inertia", inertia = "2 kg*m2" }
shaft = { kind = "shaft", )" + shaft + R"( }
b = { kind = "inertia", inertia = "3 kg*m2" }
effects = { elasticity = true }
)");
    return find_modes(scene, scene.effects, {.speed = 10.0});
  };
  const ModesStudy even = study(R"(length = "2 m", diameter = "60 mm", segments = 4)");
  EXPECT_EQ(even.joint_names,
            (std::vector<std::string>{"shaft, segment 1", "shaft, segment 2", "shaft, segment 3", "shaft, segment 4"}));
  for (const char* station : {"shaft, station at 0.5 m", "shaft, station at 1 m", "shaft, station at 1.5 m"})
    EXPECT_EQ(std::count(even.shaft_names.begin(), even.shaft_names.end(), station), 1) << station;
  const ModesStudy stiff = study(R"(stiffness = "60 kN*m/rad", inertia = "0.1 kg*m2", segments = 2)");
  EXPECT_EQ(std::count(stiff.shaft_names.begin(), stiff.shaft_names.end(), "shaft, station at 50 % of its length"), 1);
  const ModesStudy whole = study(R"(length = "2 m", diameter = "60 mm")");
  const std::size_t parts = whole.joint_names.size();
  EXPECT_EQ(std::count(whole.joint_names.begin(), whole.joint_names.end(), "shaft"), 1);  // the middle
  for (int i = 1; i < static_cast<int>(parts); ++i) {
    const double place = lobatto_element(static_cast<int>(parts)).place[static_cast<std::size_t>(i)];
    const std::string station = fmt::format("shaft, station at {:.4g} m", 2 * place);
    EXPECT_EQ(std::count(whole.shaft_names.begin(), whole.shaft_names.end(), station), 1) << station;
  }
  for (const LimitedJoint& joint : whole.limited) EXPECT_EQ(joint.beside_middle, joint.name != "shaft");
}

}  // namespace
}  // namespace kurbel::continuous_shafts_test
