// Steady motion as a fixed point of the return map, against closed forms and against waiting for it.
#include "engine/return_map.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "tests/published/published.h"

namespace kurbel::test {
namespace {

constexpr double pi = std::numbers::pi;

SteadyPoint steady_of(const std::shared_ptr<const Model>& model, double link_speed, double tolerance = 1e-12) {
  ReturnMap map(model, {.tolerance = tolerance});
  const ReturnMap::Image guess = map.approach(link_speed);
  EXPECT_EQ(guess.end, ReturnMap::End::returned) << guess.why;
  const SteadyPoint point = find_steady(map, guess.z);
  EXPECT_TRUE(point.found) << point.why;
  EXPECT_LE(point.cost, 6 * (static_cast<double>(map.size()) + 1));
  return point;
}

std::shared_ptr<const Model> model_of(const std::string& file, bool elastic) {
  const Scene scene = scene_file("scenes/" + file + ".toml");
  return compile(scene, elastic ? scene.effects : Effects{});
}

TEST(Probe, Print) {
  for (const char* name : {"crank_press", "compressor", "single_cylinder_engine", "driven_slider_crank", "piston_pump",
                           "six_inertia_chain", "four_cylinder_engine"})
    for (const bool elastic : {false, true}) {
      const auto model = model_of(name, elastic);
      ReturnMap map(model, {});
      const ReturnMap::Image guess = map.approach(0.95 * model->speed_scale);
      std::printf("%s %s: n=%zu guess end %d %s section %g cost %g\n", name, elastic ? "elastic" : "rigid", map.size(),
                  (int)guess.end, guess.why.c_str(), map.section(), map.cost());
      if (guess.end != ReturnMap::End::returned) continue;
      const SteadyPoint p = find_steady(map, guess.z);
      std::printf("  found %d %s residual %.2e rounds %d derivatives %d cost %g of %g; T %.12g\n  mu:", p.found,
                  p.why.c_str(), p.residual, p.rounds, p.derivatives, p.cost, 6.0 * ((double)map.size() + 1), p.time);
      for (auto m : p.multipliers) std::printf(" %.10f%+.10fi", m.real(), m.imag());
      std::printf("\n");
    }
}

}  // namespace
}  // namespace kurbel::test

namespace kurbel::test { namespace {
TEST(Probe, Derivative) {
  for (const char* name : {"six_inertia_chain","four_cylinder_engine","crank_press","single_cylinder_engine"}) {
  const auto model = model_of(name, true);
  ReturnMap map(model, {});
  const ReturnMap::Image guess = map.approach(0.7 * model->speed_scale);
  const auto im = map.image(guess.z, true);
  Eigen::MatrixXd d(map.size(), map.size());
  for (int j = 0; j < (int)map.size(); ++j) {
    Eigen::VectorXd a = guess.z, b = guess.z; a[j] += 1e-5; b[j] -= 1e-5;
    d.col(j) = (map.image(a, false).z - map.image(b, false).z) / 2e-5;
  }
  std::printf("%s: derivative %g difference %g\n", name, d.cwiseAbs().maxCoeff(), (d - im.derivative).cwiseAbs().maxCoeff());
  Eigen::VectorXd z = guess.z;
  for (int k = 0; k < 8; ++k) {
    const auto i = map.image(z, true);
    Eigen::VectorXd r = i.z - z;
    Eigen::VectorXd st = (Eigen::MatrixXd::Identity(r.size(), r.size()) - i.derivative).lu().solve(r);
    std::printf("   %d residual %.3e step %.3e max %g\n", k, r.cwiseAbs().maxCoeff(), st.cwiseAbs().maxCoeff(), z.cwiseAbs().maxCoeff());
    z += st;
  }
  }
}
}}
