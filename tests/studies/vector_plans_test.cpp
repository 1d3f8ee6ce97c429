// vector_plans_test.cpp — plans of velocity and acceleration, polygons of forces: closed forms, closed chains, paper to scale.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <set>

#include "studies/worksheet/forces_sheet.h"
#include "studies/worksheet/motion_plans.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/support/scenes.h"
#include "tests/support/sheet_page.h"

namespace kurbel::vector_plans_test {
namespace {

// All kinds, sliding and rocking outputs, slides on links that move, groups of the third class, forces within.
const char* const scenes[] = {"scenes/crank_press.toml",       "scenes/shaper.toml",
                              "scenes/knuckle_press.toml",     "scenes/four_bar_rocker.toml",
                              "scenes/straight_line_saw.toml", "scenes/drag_link_feeder.toml",
                              "scenes/six_link_press.toml",    "scenes/stephenson.toml",
                              "scenes/scotch_yoke.toml",       "scenes/straight_line.toml",
                              "scenes/walking_leg.toml",       "tests/agreement/vibrations/inverted_crank_shaft.toml"};

// A spring from the yoke's point Y to F in the frame; joints rub.
const char* const sprung_yoke = R"(
line  = ["motor", "m"]
motor = { kind = "torque source", torque = "5 N*m", inertia = "0.1 kg*m2" }
[m]
kind   = "linkage"
unit   = "mm"
points = { O = [0, 0], A = [60, 0], Y = [300, 0], F = [500, 0] }
frame  = "O F"
slides = { block = { on = "yoke", along = "90 deg" }, yoke = "0 deg" }
joints = { A = { radius = "12 mm", friction = 0.09 }, block = { friction = 0.12 } }
links  = { crank = { points = "O A", mass = "1 kg", com = [0, 0], inertia = "0.5 kg*m2" }, block = "A", yoke = "Y" }
springs = { return = { between = "Y F", stiffness = "900 N/m", free_length = "180 mm" } }
[run]
start = { speed = "120 rpm" }
)";

ForcesSheet sheet_of_scene(const Scene& scene) {
  ForcesOptions options;
  options.simulate = false;
  return sheet_of(scene, options, {}, "");
}

double apart(PlanePoint a, PlanePoint b) { return std::hypot(a.x - b.x, a.y - b.y); }
double length(const VectorPlan::Arrow& a) { return apart(a.from, a.to); }
double largest_in(const VectorPlan& plan) {
  double largest = 0;
  for (const VectorPlan::Arrow& a : plan.arrows) largest = std::max(largest, length(a));
  return largest;
}
const VectorPlan::Arrow& arrow_in(const VectorPlan& plan, const std::string& name) {
  for (const VectorPlan::Arrow& a : plan.arrows)
    if (a.name == name) return a;
  throw std::runtime_error("no arrow " + name);
}
PlanePoint point_in(const VectorPlan& plan, const std::string& name) {
  for (const VectorPlan::Point& p : plan.points)
    if (p.name == name) return p.at;
  throw std::runtime_error("no point " + name);
}

// x = r cos φ + √(l² − (e − r sin φ)²), β of the rod.
TEST(VectorPlans, ASliderCranksAreTheClosedForm) {
  const ForcesSheet sheet = sheet_of_scene(test::scene_from(R"(
line  = ["motor", "press"]
motor = { kind = "torque source", torque = "30 N*m", inertia = "1 kg*m2" }
press = { kind = "slider-crank", radius = "50 mm", rod = "180 mm", offset = "12 mm", crank_inertia = "0.4 kg*m2", rod_mass = "12 kg", rod_com = "60 mm", rod_inertia = "0.06 kg*m2", slider_mass = "30 kg", load = { kind = "constant", force = "-100 N" } }
[run]
start = { speed = "60 rpm" }
)"));
  SliderCrankData data;
  data.radius = 0.05, data.rod_length = 0.18, data.offset = 0.012;
  const SliderCrankGeometry geometry(data);
  const MechanismOnSheet& m = sheet.mechanisms.front();
  for (const double alpha : {0.0, 7.0})
    for (const double phi : {0.1, 1.0, 2.5, 4.0, 6.0}) {
      const LinkAt at{phi, 2 * std::numbers::pi, alpha};
      const VectorPlan v = velocity_plan(m, at, ""), a = acceleration_plan(m, at, "");
      const auto x = geometry.slider(phi), beta = geometry.rod(phi);
      const double w = at.omega, rod_w = beta.slope * w, rod_e = beta.curvature * w * w + beta.slope * alpha;
      const double acceleration = x.curvature * w * w + x.slope * alpha, scale = 0.05 * w * w;
      EXPECT_NEAR(apart(point_in(v, "b"), {x.slope * w, 0}), 0, 1e-12 * 0.05 * w);
      EXPECT_NEAR(apart(point_in(v, "a"), {-0.05 * w * std::sin(phi), 0.05 * w * std::cos(phi)}), 0, 1e-12 * 0.05 * w);
      EXPECT_NEAR(length(arrow_in(v, "v_BA")), 0.18 * std::abs(rod_w), 1e-12 * 0.05 * w);
      EXPECT_NEAR(apart(point_in(a, "b′"), {acceleration, 0}), 0, 1e-12 * scale);
      EXPECT_NEAR(length(arrow_in(a, "aⁿ_A")), 0.05 * w * w, 1e-12 * scale);
      EXPECT_NEAR(length(arrow_in(a, "aⁿ_BA")), 0.18 * rod_w * rod_w, 1e-12 * scale);
      EXPECT_NEAR(length(arrow_in(a, "aᵗ_BA")), 0.18 * std::abs(rod_e), 1e-12 * scale);
      if (alpha != 0) {
        EXPECT_NEAR(length(arrow_in(a, "aᵗ_A")), 0.05 * alpha, 1e-12 * scale);
      }
    }
}

// The block at A on the slot of lever 3: L² = a² + r² − 2 a r cos φ, v = L′ ω, ω₃ = (r² − a r cos φ) ω/L², aᶜ = 2 ω₃ v.
TEST(VectorPlans, ASlidingBlockHasCoriolisAcceleration) {
  const ForcesSheet sheet = sheet_of_scene(test::scene_file("tests/agreement/vibrations/inverted_crank_shaft.toml"));
  const double r = 0.1, a = 0.3, w = 3;
  for (const double phi : {0.4, 1.7, 3.0, 5.0}) {
    const LinkAt at{phi, w, 0};
    const VectorPlan v = velocity_plan(sheet.mechanisms.front(), at, ""),
                     plan = acceleration_plan(sheet.mechanisms.front(), at, "");
    const double reach = std::sqrt(a * a + r * r - 2 * a * r * std::cos(phi)),
                 slide = a * r * std::sin(phi) / reach * w;
    const double lever = (r * r - a * r * std::cos(phi)) / (reach * reach) * w;
    EXPECT_NEAR(length(arrow_in(v, "v_AA3")), std::abs(slide), 1e-12 * r * w);
    EXPECT_NEAR(length(arrow_in(plan, "aᶜ_AA3")), std::abs(2 * lever * slide), 1e-12 * r * w * w);
    EXPECT_NEAR(length(arrow_in(plan, "aⁿ_A3")), lever * lever * reach, 1e-12 * r * w * w);
    EXPECT_NEAR(apart(arrow_in(plan, "aʳ_AA3").to, point_in(plan, "a′")), 0, 1e-12 * r * w * w);
  }
}

// Parts begin in a point of the plan or behind another part; the last of them ends in the point that it leads to.
TEST(VectorPlans, PartsOfEveryLinkageLeadFromPointToPoint) {
  for (const char* scene : scenes) {
    const ForcesSheet sheet = sheet_of_scene(test::scene_file(scene));
    int parts = 0;
    for (const LinkAt& at : sheet.motion.at) {
      const MechanismOnSheet& m = sheet.mechanisms.front();
      const MechanismMotionAt motion = motion_at(m, at.phi, at.omega, at.alpha);
      for (const VectorPlan& plan : {velocity_plan(m, at, ""), acceleration_plan(m, at, "")}) {
        const double dust = 1e-12 * largest_in(plan);
        const auto is_point = [&](PlanePoint p) {
          for (const VectorPlan::Point& known : plan.points)
            if (apart(known.at, p) <= dust) return true;
          return false;
        };
        std::set<std::string> names;
        for (std::size_t k = 0; k < plan.arrows.size(); ++k) {
          const VectorPlan::Arrow& a = plan.arrows[k];
          if (a.name.empty()) continue;
          EXPECT_TRUE(names.insert(a.name).second) << scene << ": " << a.name << " twice";
          EXPECT_TRUE(is_point(a.from) || apart(plan.arrows[k - 1].to, a.from) <= dust) << scene << ": " << a.name;
          const bool goes_on = k + 1 < plan.arrows.size() && apart(plan.arrows[k + 1].from, a.to) <= dust;
          EXPECT_TRUE(is_point(a.to) || goes_on) << scene << ": " << a.name;
          ++parts;
        }
      }
      const VectorPlan v = velocity_plan(m, at, "");
      const double dust = 1e-12 * largest_in(v);
      for (const JointMotion& pin : motion.pins) {
        std::string name;
        for (const char c : pin.name) name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        for (const VectorPlan::Point& p : v.points)
          EXPECT_TRUE(p.name != name || apart(p.at, pin.velocity) <= dust) << scene << " " << at.phi << ": " << name;
      }
    }
    EXPECT_GT(parts, 0) << scene;
  }
}

TEST(VectorPlans, PolygonsOfForcesAreClosedAndOfTheTablesForces) {
  std::vector<Scene> list = {test::scene_from(sprung_yoke)};
  for (const char* scene : scenes) list.push_back(test::scene_file(scene));
  std::set<std::string> names;
  for (const Scene& given : list) {
    const ForcesSheet sheet = sheet_of_scene(given);
    const std::string scene = given.heading();
    PlanarLinkage linkage = sheet.mechanisms.front().mechanism.data.linkage(0);
    if (sheet.weightless) linkage.gravity = 0;
    double greatest = 0;
    for (std::size_t k = 1; k < sheet.forces.also.size(); k += 3) {
      const LinkageForces& f = sheet.forces.also[k].forces;
      const std::vector<VectorPlan> plans = force_polygons(f, linkage, "");
      ASSERT_EQ(plans.size(), sheet.links.size());
      for (const VectorPlan& plan : plans) {
        if (plan.arrows.empty()) continue;
        EXPECT_LE(apart(plan.arrows.back().to, plan.arrows.front().from), 1e-12 * largest_in(plan))
            << scene << " " << k;
        greatest = std::max(greatest, largest_in(plan));
        for (const VectorPlan::Arrow& a : plan.arrows) names.insert(a.name);
      }
      for (std::size_t j = 0; j < sheet.joints.size(); ++j) {
        const std::string& symbol = sheet.joints[j].symbol;  // "R_12"
        const double force = f.joints[j].force.magnitude();
        if (force > 0) {
          EXPECT_NEAR(length(arrow_in(plans[static_cast<std::size_t>(symbol.back() - '1')], symbol)), force,
                      1e-12 * greatest)
              << scene << " " << symbol;
        }
      }
    }
    EXPECT_GT(greatest, 0) << scene;
  }
  for (const char* name : {"F", "F_a3", "T_23", "T_03", "G_2", "F_2"}) EXPECT_TRUE(names.contains(name)) << name;
}

// Every vector on paper is its value over the scale that its plan states.
TEST(VectorPlans, VectorsOnPaperAreTheirValuesOverTheScale) {
  const std::string html = sheet_of_scene(test::scene_file("scenes/shaper.toml")).html();
  static const std::regex plan(R"re(<g data-plan="([^"]*)" data-position="([^"]*)" data-per-mm="([^"]*)">)re"),
      vector(
          R"re(data-vector="([^"]*)" data-value="([^"]*)">\s*<line class="[^"]*" x1="([^"]*)" y1="([^"]*)" x2="([^"]*)" y2="([^"]*)")re");
  std::set<std::string> kinds, named;
  for (std::sregex_iterator i(html.begin(), html.end(), plan), end; i != end; ++i) {
    kinds.insert((*i)[1]);
    const auto from = static_cast<std::size_t>(i->position());
    const std::string text = html.substr(from, html.find("<g data-plan", from + 1) - from);
    for (std::sregex_iterator v(text.begin(), text.end(), vector); v != end; ++v) {
      named.insert((*v)[1]);
      const double drawn = std::hypot(std::stod((*v)[5]) - std::stod((*v)[3]), std::stod((*v)[6]) - std::stod((*v)[4]));
      EXPECT_NEAR(drawn, std::stod((*v)[2]) / std::stod((*i)[3]), 2e-3) << (*v)[1];
    }
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"μ_v", "μ_a", "μ_F"}));
  for (const char* name : {"v_AA2", "v_DC", "aⁿ_A", "aᶜ_AA2", "aʳ_AA2", "aᵗ_A2", "R_13", "R_05", "G_5", "F_5", "F"})
    EXPECT_TRUE(named.contains(name)) << name;
}

}  // namespace
}  // namespace kurbel::vector_plans_test
