// second_extraction_test.cpp — the second extraction shares no error with the first: their difference is the second's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/model/model.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"
#include "tests/mechanisms/linkage_truth.h"
#include "tests/mechanisms/mechanism_examples.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/support/scenes.h"

namespace kurbel::second_extraction_test {
namespace {

using std::numbers::pi;
using test::RandomLinkage;
using Channel = ReducedMechanism::Channel;

std::shared_ptr<const Model> compiled(const Scene& scene, Extraction from) {
  return compile_network(extracted_from(build_network(scene), from), scene, scene.effects);
}

template <class Data>
void expect_closed_form(const Data& data, RandomLinkage& random) {
  double scale[channels] = {};
  for (int i = 0; i < 90; ++i) {
    const test::LinkageTruth truth = test::truth_of(data, 2 * pi * i / 90);
    for (int c = 0; c < channels; ++c) scale[c] = std::max(scale[c], static_cast<double>(std::fabs(truth.value[c])));
    scale[6] =
        std::max(scale[6], static_cast<double>(closed_form_of(linkage_of(data, 2 * pi * i / 90)).gravity_torque_scale));
  }
  scale[1] = std::max(scale[1], 0.01 * scale[0]), scale[2] = std::max(scale[2], 0.01 * scale[0]);
  scale[7] = std::max(scale[7], scale[6]);
  for (int i = 0; i < 20; ++i) {
    const double phi = random.uniform(-7, 20);
    const test::LinkageTruth truth = test::truth_of(data, phi);
    const ClosedForm f = closed_form_of(linkage_of(data, phi));
    const long double got[channels] = {f.inertia,         f.inertia_slope,         f.inertia_curvature,
                                       f.output_position, f.output_velocity_ratio, f.output_acceleration_ratio,
                                       f.gravity_torque,  f.gravity_torque_slope};
    for (int c = 0; c < channels; ++c)
      EXPECT_NEAR(static_cast<double>(got[c] - truth.value[c]), 0, 1e-14 * scale[c]) << "channel " << c << ", " << phi;
    EXPECT_NEAR(static_cast<double>(f.potential_energy), static_cast<double>(truth.potential_energy),
                1e-14 * (scale[6] + std::fabs(static_cast<double>(truth.potential_energy))));
  }
}

// Triangles by Heron and loops by Freudenstein are two ways to one motion.
TEST(ClosedForms, TrianglesAgreeWithFreudensteinsEquation) {
  RandomLinkage random(5);
  for (int i = 0; i < 40; ++i) {
    expect_closed_form(random.four_bar(), random);
    expect_closed_form(random.quick_return(), random);
    expect_closed_form(random.knuckle_press(), random);
  }
}

TEST(ClosedForms, FourBarAtAChangePointKeepsItsDigits) {
  // a + d = b + c − 1e-9: at φ = π coupler and rocker are nearly in line. The coupler's angle there by the half angle:
  // tan²(B/2) of the triangle with sides b, c and s, from the exact differences.
  FourBarData m;
  m.crank = 0.25, m.coupler = 0.5, m.rocker = 0.75, m.ground = 1 - 1e-9;
  const long double margin = static_cast<long double>(m.coupler) + m.rocker - m.crank - m.ground;
  const long double s = static_cast<long double>(m.crank) + m.ground;
  const long double half_sum = (m.coupler + m.rocker + s) / 2;
  // The angle at D between DA and DB: tan²(D/2) = (p − c)(p − s)/(p (p − b)), p − s = margin/2.
  const long double at_d =
      2 * std::atan(std::sqrt((half_sum - m.rocker) * (margin / 2) / (half_sum * (half_sum - m.coupler))));
  const long double got = std::numbers::pi_v<long double> - linkage_of(m, std::numbers::pi_v<long double>).output[0];
  EXPECT_NEAR(static_cast<double>(got / at_d), 1, 1e-14);
}

// At random angles, crowded where the rod is steepest.
double steep_angle(std::mt19937& random, double margin) {
  const double side = std::uniform_real_distribution<double>(-1, 1)(random);
  if (random() % 3 == 0) return pi * (1 + side);
  return (random() % 2 ? 0.5 : 1.5) * pi + side * std::pow(10.0, -3.0 * std::fabs(side)) * 30 * std::sqrt(margin);
}

class RodLongerThanCrankBy : public testing::TestWithParam<double> {};

// NUMERICS: two runs with one table of Simbody said 14 000 × too little here.
TEST_P(RodLongerThanCrankBy, DifferenceOfTheExtractionsIsTheSecondsError) {
  const double margin = GetParam();
  const SliderCrankData d = full_mechanism(1 + margin, 0);
  const SliderCrankGeometry geometry(d);
  const auto first = reduce_mechanism(d);
  const auto second = reduce_mechanism(d, table_tolerance, table_max_pieces, Extraction::second);
  EXPECT_TRUE(first->report().converged);
  EXPECT_EQ(reduce_mechanism(d, table_tolerance, table_max_pieces, Extraction::second), second);
  EXPECT_NE(first, second);
  std::mt19937 random(3);
  std::vector<Truth> truths;
  std::vector<double> angles;
  double scale[channels] = {};
  for (int i = 0; i < 2000; ++i) {
    angles.push_back(steep_angle(random, margin));
    truths.emplace_back(geometry, angles.back());
    for (int c = 0; c < channels; ++c)
      scale[c] = std::max(scale[c], static_cast<double>(std::fabs(truths.back().value[c])));
  }
  for (int c = 0; c < channels; ++c) {
    double of_first = 0, of_second = 0, difference = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const long double a = first->at(angles[i]).value(static_cast<Channel>(c)),
                        b = second->at(angles[i]).value(static_cast<Channel>(c)), t = truths[i].value[c];
      of_first = std::max(of_first, static_cast<double>(std::fabs(a - t)) / scale[c]);
      of_second = std::max(of_second, static_cast<double>(std::fabs(b - t)) / scale[c]);
      difference = std::max(difference, static_cast<double>(std::fabs(a - b)) / scale[c]);
    }
    EXPECT_LE(of_first, 4e-14) << "channel " << c;
    EXPECT_LE(of_second, difference + of_first) << "channel " << c;
    if (of_second > 1e-13) {
      EXPECT_GE(difference, 0.8 * of_second) << "channel " << c;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Margin, RodLongerThanCrankBy, testing::Values(1e-7, 1e-5, 1e-3, 2.5));

// A slider-crank whose loop equations have another rod than its bodies.
struct WrongLoop : SliderCrankData {
  double part = 0;  // by which the rod is too long
};
PlanarLinkage linkage_of(const WrongLoop& data, long double phi) {
  SliderCrankData longer = data;
  longer.rod_length *= 1 + data.part;
  return linkage_of(longer, phi);
}
std::unique_ptr<MechanismBodies> own_bodies(const WrongLoop& data) {
  return MechanismData(SliderCrankData(data)).make_bodies();
}

// What Simbody does not confirm it tabulates itself: the runs then differ by the error.
TEST(SecondExtraction, FindsLoopEquationsThatAreWrong) {
  for (const double part : {0.0, 1e-11, 1e-9, 1e-4}) {
    const WrongLoop wrong{full_mechanism(2.5, 0.03), part};
    const auto first = extract_mechanism(wrong);
    const auto second = extract_mechanism(wrong, table_tolerance, table_max_pieces, Extraction::second);
    const SliderCrankGeometry truth(wrong);
    double apart = 0, of_second = 0;
    for (double phi = 0.05; phi < 2 * pi; phi += 0.1) {
      const double x = second.output_position(phi).value;
      apart = std::max(apart, std::fabs(first.output_position(phi).value - x));
      of_second = std::max(of_second, std::fabs(x - static_cast<double>(truth.slider(phi).value)));
    }
    EXPECT_LE(of_second, 1e-12 * wrong.rod_length) << part;
    EXPECT_GE(apart, 0.9 * part * wrong.rod_length) << part;
    double stated = 0;
    for (const auto& channel : second.report().channels) stated = std::max(stated, channel.error);
    EXPECT_EQ(stated > table_tolerance, part > 0) << part;
  }
}

std::string free_crank(double margin) {
  return fmt::format(R"(
line = ["crank"]
crank = {{ kind = "slider-crank", radius = "0.1 m", rod = "{:.17g} m", crank_inertia = "0.55 kg*m2", rod_mass = "2 kg", rod_com = "0.04 m", rod_inertia = "0.02 kg*m2", slider_mass = "3 kg" }}
run = {{ start = {{ speed = "30 rad/s", angle = "40 deg" }}, until = "1 s", output = ["crank"] }}
)",
                     0.1 * (1 + margin));
}

double figure(const Result& r, const std::string& name) {
  const Figure* found = r.find(name);
  return found ? found->value : NAN;
}

// √(I(φ)/I(φ₀))/ω₀ integrated by Gauss–Legendre, halved where it bends: the time of a free crank's way.
long double time_between(const SliderCrankGeometry& g, long double from, long double to, long double scale, int depth) {
  constexpr long double x[] = {0.18343464249564980494L, 0.52553240991632898582L, 0.79666647741362673959L,
                               0.96028985649753623168L};
  constexpr long double w[] = {0.36268378337836198297L, 0.31370664587788728734L, 0.22238103445337447054L,
                               0.10122853629037625915L};
  const auto rule = [&](long double a, long double b) {
    long double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (const int side : {-1, 1})
        sum += w[i] * std::sqrt(g.inertia((a + b) / 2 + side * x[i] * (b - a) / 2).value * scale);
    return sum * (b - a) / 2;
  };
  const long double middle = (from + to) / 2, whole = rule(from, to);
  const long double halves = rule(from, middle) + rule(middle, to);
  if (std::fabs(halves - whole) < 1e-19L || depth == 0) return halves;
  return time_between(g, from, middle, scale, depth - 1) + time_between(g, middle, to, scale, depth - 1);
}

TEST(SecondExtraction, TwoRunsDifferByTheTrueErrorNearTheChangePoint) {
  for (const double margin : {1e-7, 1e-5, 1e-3}) {
    const Scene scene = test::scene_from(free_crank(margin));
    double angle[2], speed[2];
    SliderCrankData data;
    for (const Extraction from : {Extraction::first, Extraction::second}) {
      const auto model = compiled(scene, from);
      data = *mechanism_of(model->network.elements.front())->mechanism().data.as<SliderCrankData>();
      SimulateOptions options{.measure_error = false, .method = {}, .accuracy = {}, .until = {}};
      options.first_tolerance = 1e-14;
      const Result r = simulate(model, "free", options);
      ASSERT_TRUE(r.complete) << r.diagnosis;
      angle[static_cast<int>(from)] = figure(r, "final_angle.crank");
      speed[static_cast<int>(from)] = figure(r, "final_speed.crank");
    }
    const SliderCrankGeometry g(data);
    const long double start = 40 * std::numbers::pi_v<long double> / 180, end = angle[0];
    const long double scale = 1 / (30 * 30 * g.inertia(start).value);
    long double time = 0;  // in parts, so that halving finds the steep places
    const int parts = 2000;
    for (int i = 0; i < parts; ++i)
      time += time_between(g, start + (end - start) * i / parts, start + (end - start) * (i + 1) / parts, scale, 16);
    const auto true_speed = static_cast<double>(30 * std::sqrt(g.inertia(start).value / g.inertia(end).value));
    // The second run is off by its difference to the first, and by what the first is off: rounding.
    const double late = std::fabs(static_cast<double>(time - 1)) * std::fabs(true_speed);
    EXPECT_LE(late, 1e-12) << margin;
    EXPECT_LE(std::fabs(speed[0] - true_speed), 1e-12 * true_speed) << margin;
    EXPECT_LE(std::fabs(angle[0] - angle[1]), 1e-12) << margin;
    EXPECT_LE(std::fabs(speed[0] - speed[1]), 1e-12 * true_speed) << margin;
  }
}

// A constant crank with the mean of an inertia that bends within 10⁻⁴ rad.
TEST(SecondExtraction, MeanInertiaIsTheIntegralOfTheClosedForm) {
  for (const double margin : {1e-7, 1e-3, 2.5}) {
    const SliderCrankData d = full_mechanism(1 + margin, 0);
    const SliderCrankGeometry g(d);
    // Midpoints in u, φ = quarter + side · u⁵, which crowd at the quarter turns.
    long double sum = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const long double u = (i + 0.5L) / n, width = std::numbers::pi_v<long double> / 4;
      for (int quarter = 0; quarter < 4; ++quarter)
        for (const int side : {-1, 1})
          sum += g.inertia(2 * quarter * width + side * width * u * u * u * u * u).value * 5 * u * u * u * u / n / 8;
    }
    for (const Extraction from : {Extraction::first, Extraction::second}) {
      const auto table = reduce_mechanism(d, table_tolerance, table_max_pieces, from);
      EXPECT_NEAR(travel_of_turn(*table).mean_inertia, static_cast<double>(sum), 1e-8 * static_cast<double>(sum));
    }
  }
}

// Whatever a mechanism carries, the machine from the second extraction is the same machine.
TEST(SecondExtraction, CompilesToTheSameMachine) {
  for (const char* file : {"scenes/crank_press.toml", "scenes/compressor.toml", "scenes/four_bar_rocker.toml",
                           "scenes/shaper.toml", "scenes/knuckle_press.toml", "scenes/single_cylinder_engine.toml",
                           "scenes/worn_crank_pin.toml", "scenes/flexible_rod.toml", "scenes/piston_pump.toml"}) {
    const Scene scene = test::scene_file(file);
    EXPECT_TRUE(has_tables(build_network(scene))) << file;
    const auto a = compiled(scene, Extraction::first), b = compiled(scene, Extraction::second);
    EXPECT_EQ(a->state_count(), b->state_count()) << file;
    EXPECT_EQ(a->mode_slots, b->mode_slots) << file;
    const std::vector<Figure> figures = figure_list(*a), others = figure_list(*b);
    ASSERT_EQ(figures.size(), others.size()) << file;
    for (std::size_t i = 0; i < figures.size(); ++i) EXPECT_EQ(figures[i].name, others[i].name) << file;
    EXPECT_EQ(a->explain().find("Simbody"), std::string::npos) << file;
    EXPECT_NE(b->explain().find("Simbody"), std::string::npos) << file;
  }
  EXPECT_FALSE(has_tables(build_network(test::scene_file("scenes/dc_hoist.toml"))));
}

}  // namespace
}  // namespace kurbel::second_extraction_test
