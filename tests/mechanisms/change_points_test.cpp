// change_points_test.cpp — links that pass through one line, and outputs that rotate, against loops followed by
// Newton's method with a predictor, in long double.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "mechanisms/reduced/mechanism.h"
#include "mechanisms/reduced/newton_euler.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/published/published.h"

namespace kurbel::change_points_test {
namespace {

using std::numbers::pi;
using Real = long double;

FourBarData four_bar(double crank, double coupler, double rocker, double ground) {
  FourBarData d;
  d.crank = crank, d.coupler = coupler, d.rocker = rocker, d.ground = ground;
  d.crank_body.inertia = 0.05;
  d.coupler_body = {1.5, 0.4 * coupler, 0.004};
  d.rocker_body = {2, 0.3 * rocker, 0.03 + 2 * 0.09 * rocker * rocker};
  d.gravity = 9.81, d.ground_angle = 0.4;
  return d;
}

// Coupler's angle β and rocker's ψ by Newton's method on the two closures, led from position to position by their first
// and second derivatives; over a change point in one stride.
class FollowedFourBar {
 public:
  FollowedFourBar(const FourBarData& data, Real beta, Real psi, Real phi)
      : d_(data), beta_(beta), psi_(psi), phi_(phi) {
    solve(0);
  }
  // Steps of the bounded size, longer where the links stand nearly in one line at their end.
  void go_to(Real phi) {
    while (phi_ < phi - 1e-12L) {
      Real step = std::min<Real>(0.05L, phi - phi_);
      while (step < 0.6L && std::fabs(sine_after(step)) < 0.12L && phi_ + step < phi) step += 0.05L;
      advance(std::min(step, phi - phi_));
    }
  }
  Real beta() const { return beta_; }
  Real psi() const { return psi_; }
  Real sine() const { return std::sin(psi_ - beta_); }
  std::pair<Real, Real> rates() const {  // β′, ψ′
    const Real a = d_.crank, b = d_.coupler, c = d_.rocker;
    return {a * std::sin(phi_ - psi_) / (b * std::sin(psi_ - beta_)), a * std::sin(phi_ - beta_) / (c * sine())};
  }
  Real inertia() const {
    const auto [coupler_rate, rocker_rate] = rates();
    const Real a = d_.crank, k = d_.coupler_body.com;
    const Real vx = -a * std::sin(phi_) - k * coupler_rate * std::sin(beta_);
    const Real vy = a * std::cos(phi_) + k * coupler_rate * std::cos(beta_);
    return d_.crank_body.inertia + d_.coupler_body.mass * (vx * vx + vy * vy) +
           d_.coupler_body.inertia * coupler_rate * coupler_rate + d_.rocker_body.inertia * rocker_rate * rocker_rate;
  }

 private:
  Real sine_after(Real step) const {
    const auto [b1, p1] = rates();
    return std::sin(psi_ + p1 * step - beta_ - b1 * step);
  }
  void advance(Real step) {
    const auto [b1, p1] = rates();
    FollowedFourBar beside = *this;  // second derivatives by a small step back
    const Real h = 1e-5L;
    beside.beta_ -= h * b1, beside.psi_ -= h * p1, beside.phi_ -= h;
    beside.solve(0);
    const auto [b0, p0] = beside.rates();
    beta_ += step * b1 + step * step / 2 * (b1 - b0) / h;
    psi_ += step * p1 + step * step / 2 * (p1 - p0) / h;
    solve(step);
  }
  void solve(Real step) {
    phi_ += step;
    for (int i = 0; i < 50; ++i) {
      const Real a = d_.crank, b = d_.coupler, c = d_.rocker;
      const Real ex = a * std::cos(phi_) + b * std::cos(beta_) - d_.ground - c * std::cos(psi_);
      const Real ey = a * std::sin(phi_) + b * std::sin(beta_) - c * std::sin(psi_);
      const Real s = std::sin(psi_ - beta_);
      beta_ += (ex * std::cos(psi_) + ey * std::sin(psi_)) / (-b * s);
      psi_ += (ex * std::cos(beta_) + ey * std::sin(beta_)) / (-c * s);
      if (std::fabs(ex) + std::fabs(ey) < 1e-17L) return;
    }
  }
  FourBarData d_;
  Real beta_, psi_, phi_;
};

// Both extractions against the followed loop over two turns.
void expect_followed(const FourBarData& d, int turns, double wound) {
  ASSERT_TRUE(faults_of(d).empty()) << faults_of(d)[0].text;
  const Mechanism m("bars", d), second = m.extracted_from(Extraction::second);
  EXPECT_TRUE(m.reduced->report().converged) << MechanismElement(m).describe();
  EXPECT_TRUE(second.reduced->report().converged);
  EXPECT_EQ(m.reduced->cycle().turns(), turns);
  EXPECT_EQ(m.travel.winding, wound);
  const double begin = 1;
  const ReducedSample s = m.bodies->sample(begin);
  const std::vector<PlanePoint> joints = m.data.places(begin);
  FollowedFourBar loop(d, std::atan2(joints[2].y - joints[1].y, joints[2].x - joints[1].x), s.output_position, begin);
  double inertia_scale = m.travel.mean_inertia;
  for (double phi = begin; phi < begin + 4 * pi; phi += 0.2391) {
    loop.go_to(phi);
    if (std::fabs(loop.sine()) < 0.05L) continue;
    SCOPED_TRACE(phi);
    const auto x = m.reduced->output_position(phi), y = second.reduced->output_position(phi);
    EXPECT_NEAR(std::remainder(x.value - static_cast<double>(loop.psi()), 2 * pi), 0, 1e-11);
    EXPECT_NEAR(y.value, x.value, 1e-11);
    EXPECT_NEAR(x.slope, static_cast<double>(loop.rates().second), 1e-10);
    EXPECT_NEAR(m.reduced->inertia(phi).value, static_cast<double>(loop.inertia()), 1e-10 * inertia_scale);
    EXPECT_NEAR(second.reduced->inertia(phi).value, static_cast<double>(loop.inertia()), 1e-10 * inertia_scale);
    EXPECT_NEAR(m.bodies->kinetic_energy(phi, 3), static_cast<double>(loop.inertia()) * 4.5, 1e-10 * inertia_scale);
    EXPECT_GT(m.bodies->sample(phi).closure_determinant, 0);
  }
}

TEST(DragLink, CrankAndRockerRotateTogether) {
  expect_followed(four_bar(0.14, 0.16, 0.15, 0.05), 1, 1);
  FourBarData crossed = four_bar(0.14, 0.16, 0.15, 0.05);
  crossed.crossed = true;
  expect_followed(crossed, 1, 1);
}

TEST(ChangePoint, ParallelogramTurnsItsRockerLikeItsCrank) {
  const FourBarData d = four_bar(0.1, 0.3, 0.1, 0.3);
  expect_followed(d, 1, 1);
  const Mechanism m("bars", d);
  ASSERT_EQ(m.reduced->cycle().change_points().size(), 2u);
  EXPECT_NEAR(m.reduced->cycle().change_points()[0], 0, 1e-12);
  EXPECT_NEAR(m.reduced->cycle().change_points()[1], pi, 1e-12);
  for (double phi = 0; phi < 2 * pi; phi += pi / 8) {  // the change points, too
    EXPECT_NEAR(m.bodies->sample(phi).output_velocity_ratio, 1, 1e-13);
    EXPECT_NEAR(m.reduced->output_position(phi).value, phi, 1e-12);
  }
}

TEST(ChangePoint, AntiparallelogramTurnsItsRockerAgainstItsCrank) {
  FourBarData d = four_bar(0.1, 0.3, 0.1, 0.3);
  d.crossed = true;
  expect_followed(d, 1, -1);
  d = four_bar(0.3, 0.1, 0.3, 0.1);  // its short links are coupler and ground: both rotate in one sense
  expect_followed(d, 1, 1);
  d.crossed = true;
  expect_followed(d, 1, 1);
}

// Over ten turns, to both sides, with a phase: after eight a run takes whole turns out of its angle.
TEST(WholeTurns, OfAnOutputThatRotatesAreInItsPosition) {
  const auto bars = [](const FourBarData& d, double speed) {
    return test::run(test::scene_from(
        fmt::format("line = [\"wheel\", \"bars\"]\nwheel = {{ kind = \"flywheel\", inertia = \"5 kg*m2\" }}\n[bars]\n"
                    "kind = \"four-bar\"\ncrank = \"{} m\"\ncoupler = \"{} m\"\nrocker = \"{} m\"\nground = \"{} m\"\n"
                    "rocker_inertia = \"0.1 kg*m2\"\nbranch = \"{}\"\nphase = \"20 deg\"\n[run]\n"
                    "start = {{ speed = \"{} rpm\" }}\nuntil = \"10.4 s\"\n",
                    d.crank, d.coupler, d.rocker, d.ground, d.crossed ? "crossed" : "open", speed)));
  };
  for (const double speed : {60.0, -60.0}) {
    const Result run = bars(four_bar(0.1, 0.3, 0.1, 0.3), speed);
    const std::vector<double> angle = test::series(run, "angle.bars"), position = test::series(run, "position.bars");
    ASSERT_GT(std::fabs(angle.back()), 18 * pi);
    for (std::size_t i = 0; i < angle.size(); ++i) EXPECT_NEAR(position[i], angle[i] + pi / 9, 1e-11) << angle[i];
  }
  FourBarData against = four_bar(0.1, 0.3, 0.1, 0.3);
  against.crossed = true;
  for (const FourBarData& d : {four_bar(0.14, 0.16, 0.15, 0.05), against, four_bar(0.1, 0.25, 0.25, 0.1)}) {
    const Result run = bars(d, 60);
    const std::vector<double> angle = test::series(run, "angle.bars"), position = test::series(run, "position.bars");
    ASSERT_GT(angle.back(), 18 * pi);
    const double coupler = std::atan2(d.rocker * std::sin(position[0]) - d.crank * std::sin(pi / 9),
                                      d.ground + d.rocker * std::cos(position[0]) - d.crank * std::cos(pi / 9));
    FollowedFourBar loop(d, coupler, position[0], pi / 9);
    for (std::size_t i = 1; i < angle.size(); ++i) {
      loop.go_to(angle[i] + pi / 9);
      if (std::fabs(loop.sine()) < 0.05L) continue;
      EXPECT_NEAR(position[i], static_cast<double>(loop.psi()), 1e-10) << angle[i];
    }
  }
}

// B mirrors O in the line A D; or coupler and rocker lie on crank and ground for good.
TEST(ChangePoint, KiteOfEqualCrankAndCouplerRocksOrFolds) {
  FourBarData d = four_bar(0.1, 0.1, 0.25, 0.25);
  expect_followed(d, 1, 0);
  d.crossed = true;
  const Mechanism folded("bars", d);
  EXPECT_NEAR(std::fabs(folded.reduced->output_position(1).value), pi, 1e-12);
  EXPECT_NEAR(folded.bodies->sample(1).output_velocity_ratio, 0, 1e-13);
}

// With crank = ground its pin passes over the rocker's bearing, and B is on the half angle's ray: two turns.
TEST(ChangePoint, KiteOfEqualCrankAndGroundComesBackAfterTwoTurns) {
  const FourBarData d = four_bar(0.1, 0.25, 0.25, 0.1);
  expect_followed(d, 2, 0.5);
  const Mechanism m("bars", d);
  for (Real phi = 0; phi < 4 * pi; phi += 0.31L) {
    const Real rho = 0.1L * std::cos(phi / 2) + std::sqrt(0.0625L - 0.01L * std::sin(phi / 2) * std::sin(phi / 2));
    const Real psi = std::atan2(rho * std::sin(phi / 2), rho * std::cos(phi / 2) - 0.1L);
    EXPECT_NEAR(std::remainder(m.reduced->output_position(double(phi)).value - double(psi), 2 * pi), 0, 1e-11);
  }
}

TEST(ChangePoint, OneLineOnceATurnMakesACycleOfTwo) {
  expect_followed(four_bar(0.1, 0.25, 0.2, 0.35), 2, 0);  // crank + ground = coupler + rocker
  expect_followed(four_bar(0.1, 0.35, 0.2, 0.25), 2, 0);  // crank + coupler = rocker + ground
  expect_followed(four_bar(0.2, 0.25, 0.35, 0.1), 2, 1);  // the ground is the shortest
}

TEST(FourBar, LoopThatCannotBeClosedIsReported) {
  const DataFaults faults = faults_of(four_bar(0.2, 0.15, 0.1, 0.48));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].text.find("must be < 450 mm, the three other links together"), std::string::npos)
      << faults[0].text;
  EXPECT_TRUE(faults_of(four_bar(0.2, 0.15, 0.1, 0.18)).empty());  // it rocks
}

// --- slider-crank ---

SliderCrankData slider_crank(double offset, bool folds) {
  SliderCrankData d;
  d.radius = 0.1, d.offset = offset, d.rod_length = 0.1 + std::fabs(offset);
  d.crank_inertia = 0.3, d.rod_mass = 2, d.rod_com = 0.06, d.rod_inertia = 0.01, d.slider_mass = 3;
  d.gravity = 9.81, d.stroke_angle = 0.5, d.folds = folds;
  return d;
}

TEST(ChangePoint, RodAsLongAsTheCrankGoesFourRadiiOrFolds) {
  const Mechanism follows("crank", slider_crank(0, false)), folds("crank", slider_crank(0, true));
  EXPECT_NEAR(follows.stroke(), 0.4, 1e-13);
  EXPECT_EQ(folds.stroke(), 0);
  const Mechanism* const all[] = {&follows, &folds};
  for (double phi = 0; phi < 4 * pi; phi += pi / 16)
    for (const Mechanism* m : all) {
      SCOPED_TRACE(phi);
      const double c = std::cos(phi), s = std::sin(phi), sum = 0.16, part = 0.04;
      const double inertia = m == &follows
                                 ? 0.3 + 2 * (sum * sum * s * s + part * part * c * c) + 0.01 + 3 * 0.04 * s * s
                                 : 0.3 + 2 * part * part + 0.01;
      EXPECT_NEAR(m->reduced->inertia(phi).value, inertia, 1e-13);
      EXPECT_NEAR(m->bodies->kinetic_energy(phi, 2), 2 * inertia, 1e-12);
      EXPECT_NEAR(m->reduced->output_position(phi).value, m == &follows ? 0.2 * c : 0, 1e-13);
      EXPECT_NEAR(m->bodies->sample(phi).output_velocity_ratio, m == &follows ? -0.2 * s : 0, 1e-13);
    }
}

// cos β changes its sign with sin(φ/2 + π/4); derivatives by differences.
TEST(ChangePoint, OffsetAtItsLimitMakesACycleOfTwoTurns) {
  for (const double e : {0.04, -0.07})
    for (const bool folds : {false, true}) {
      const SliderCrankData d = slider_crank(e, folds);
      const Mechanism m("crank", d), second = m.extracted_from(Extraction::second);
      EXPECT_TRUE(m.reduced->report().converged) << MechanismElement(m).describe();
      EXPECT_EQ(m.reduced->cycle().turns(), 2);
      ASSERT_EQ(m.reduced->cycle().change_points().size(), 2u);
      const auto x = [&](Real phi) {
        const Real h = 0.1L * std::sin(phi) - Real(e), l = 0.1L + std::fabs(Real(e)), half = phi / 2 + Real(pi) / 4;
        const Real side = (e > 0 ? std::sin(half) : std::cos(half)) * (folds ? -1 : 1);
        return 0.1L * std::cos(phi) + std::copysign(std::sqrt((l - h) * (l + h)), side);
      };
      for (Real phi = 0.1L; phi < 4 * Real(pi); phi += 0.1L) {
        SCOPED_TRACE(double(phi));
        const Real k = 1e-4L, slope = (8 * (x(phi + k) - x(phi - k)) - x(phi + 2 * k) + x(phi - 2 * k)) / (12 * k);
        const auto at = m.reduced->output_position(double(phi));
        EXPECT_NEAR(at.value, double(x(phi)), 1e-11);
        EXPECT_NEAR(at.slope, double(slope), 1e-9);
        EXPECT_NEAR(second.reduced->output_position(double(phi)).slope, at.slope, 1e-11);
        EXPECT_NEAR(second.reduced->inertia_derivative(double(phi)).slope,
                    m.reduced->inertia_derivative(double(phi)).slope, 1e-10);
      }
      EXPECT_NEAR(m.travel.greatest, SliderCrankGeometry(d).x_max(), 1e-12);
      EXPECT_NEAR(m.travel.least, SliderCrankGeometry(d).x_min(), 1e-12);
      EXPECT_NEAR(m.reduced->output_position(SliderCrankGeometry(d).folded_angle()).value, m.travel.least, 1e-12);
    }
}

// --- inverted slider-crank: tan ψ = r sin φ/(r cos φ − d) ---

SlottedLeverData slotted_lever(double crank, double ground) {
  SlottedLeverData d;
  d.crank = crank, d.ground = ground;
  d.crank_body.inertia = 0.05, d.block_mass = 1.2, d.block_inertia = 0.002;
  d.lever_body = {2, 0.1, 0.06};
  d.gravity = 9.81, d.ground_angle = -0.4;
  return d;
}

TEST(SlottedLever, RocksRotatesOrTakesTwoTurns) {
  const struct {
    double crank, ground;
    int turns;
    double winding;
  } cases[] = {{0.1, 0.25, 1, 0}, {0.25, 0.1, 1, 1}, {0.1, 0.1, 2, 0.5}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.ground);
    const SlottedLeverData d = slotted_lever(c.crank, c.ground);
    const Mechanism m("lever", d), second = m.extracted_from(Extraction::second);
    EXPECT_TRUE(m.reduced->report().converged) << MechanismElement(m).describe();
    EXPECT_EQ(m.reduced->cycle().turns(), c.turns);
    EXPECT_EQ(m.travel.winding, c.winding);
    if (c.winding == 0) {
      EXPECT_NEAR(m.stroke(), 2 * std::asin(c.crank / c.ground), 1e-12);
    }
    for (double phi = 0.2; phi < 4 * pi; phi += 0.3) {
      const Real x = c.crank * std::cos(Real(phi)) - c.ground, y = c.crank * std::sin(Real(phi));
      const Real rate = c.crank == c.ground
                            ? 0.5L
                            : (x * c.crank * std::cos(Real(phi)) + y * c.crank * std::sin(Real(phi))) / (x * x + y * y);
      const Real inertia = 0.05L + 1.2L * c.crank * c.crank + (0.002L + 0.06L) * rate * rate;
      const Real psi = c.crank == c.ground ? Real(phi) / 2 + Real(pi) / 2 : std::atan2(y, x);
      for (const Mechanism* k : {&m, &second}) {
        EXPECT_NEAR(std::remainder(k->reduced->output_position(phi).value - double(psi), 2 * pi), 0, 1e-11);
        EXPECT_NEAR(k->reduced->output_position(phi).slope, double(rate), 1e-11);
        EXPECT_NEAR(k->reduced->inertia(phi).value, double(inertia), 1e-11);
      }
      EXPECT_NEAR(m.bodies->kinetic_energy(phi, 2), 2 * double(inertia), 1e-11);
    }
    EXPECT_NEAR(m.bodies->sample(0).inertia, second.reduced->inertia(0).value, 1e-11);  // over the bearing
  }
}

// Statics at any regular position: the crank's torque times its speed is what the energy takes; beside a change point
// reactions grow with the inverse of the distance.
TEST(ChangePoint, ReactionsGrowWithTheInverseOfTheDistance) {
  const MechanismData d = four_bar(0.1, 0.25, 0.2, 0.35);
  const auto pin = [&](double beside) {
    const LinkageForces f = forces_in(d.linkage(pi + beside), {pi + beside, 5, 1, 20});
    EXPECT_NEAR(f.torque * 5 + f.weight_power + f.load_power - f.kinetic_rate, 0,
                1e-8 * (1 + std::fabs(f.kinetic_rate)));
    return f.joints[2].force.magnitude();
  };
  EXPECT_NEAR(pin(1e-4) / pin(1e-3), 10, 0.2);
  EXPECT_NEAR(pin(1e-5) / pin(1e-4), 10, 0.02);
  const UnboundedReactions unbounded = unbounded_reactions(d, [](double phi) { return LinkageState{phi, 5, 1, 20}; });
  const std::string& words = unbounded.words;
  ASSERT_EQ(unbounded.at.size(), 2u);
  EXPECT_NEAR(unbounded.at.front(), pi, 1e-9);
  EXPECT_GE(unbounded.greatest, pin(1e-2));  // the greatest of all joints at both places
  EXPECT_LT(unbounded.greatest, 1.01 * pin(1e-2));
  EXPECT_NE(words.find("at the change points φ = 180°, 540° reactions have no bound"), std::string::npos) << words;
  double near = pi, far = 1;
  EXPECT_NEAR(static_cast<double>(std::fabs(linkage_beside(d, near).sine)), 1e-3, 1e-6);
  linkage_beside(d, far);
  EXPECT_NE(near, pi);
  EXPECT_EQ(far, 1);
}

}  // namespace
}  // namespace kurbel::change_points_test
