// slider_crank_statics.h — reactions, balancing torque and joint friction of the slider-crank by d'Alembert's principle, in
// closed form: a source that shares nothing with mechanisms/reduced/newton_euler.h and mechanisms/friction.
//
//   y                A ← crank pin              All forces in the frame's axes: x along the stroke towards the extended
//   |      crank   .'  `-._    rod              end, y 90° ahead. Sense of the reactions:
//   |   main     .'        `-._                   main bearing  frame on crank      crank pin   crank on rod
//   |   bearing O              `-B ← slider pin   slider pin    rod on slider       guide       frame on slider
//   +----------------------------[==]--- x        torque        of the shaft on the crank, positive when it drives
//                                guide
// Inertia forces −m a_S and couples −I ε are put on every link, then each is in equilibrium (theory 9.6, first
// problem). All reactions are linear in ω², ε, gravity, the slider's force and the friction in the joints; `unit_cases`
// tabulates them so. Friction itself depends on the reactions:
//     revolute:  moment ρ |R| against the relative rotation, ρ = r sin(atan f): R is tangent to the friction circle
//     guide:     f Σ|N_i| + (k_r/R) Σ|N_i| against the slider's motion; Σ|N_i| = |N| while the reaction stays within
//                the guide's length L, else both edges carry and Σ|N_i| = 2 |M|/L, M the moment about its middle
// Both are solved together by Newton's method, led from the frictionless solution to the given coefficients.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "engine/base/enumerators.h"
#include "mechanisms/joints/reaction_table.h"
#include "mechanisms/linkages/slider_crank.h"
#include "mechanisms/reduced/newton_euler.h"

namespace kurbel {

struct RevoluteJoint {
  double radius = 0;  // of journal, pin, or bore of a rolling bearing [m], ≥ 0
  FrictionCoefficient friction;
};

// Surfaces at y = e ± width/2; length along x. The bodies' details that only reactions see stand here, too.
struct SliderGuide {
  FrictionCoefficient friction;
  double length = 0;         // L [m], ≥ 0; 0: takes moments without more friction
  double middle = 0;         // of the bearing length, from the slider pin along x [m]
  double width = 0;          // between the two surfaces (bore of a cylinder) [m], ≥ 0
  double rolling_arm = 0;    // k_r of rollers [m], ≥ 0
  double roller_radius = 0;  // R [m], > 0 where rolling_arm is
  double com_x = 0;          // slider's centre of mass from its pin along x [m]
  double force_offset = 0;   // line of the slider's force above the pin (+y) [m]
};

struct SliderCrankJoints {
  RevoluteJoint main_bearing, crank_pin, slider_pin;
  SliderGuide guide;

  bool frictionless() const {
    const auto slides = [](const RevoluteJoint& j) { return j.radius > 0 && !j.friction.none(); };
    return !slides(main_bearing) && !slides(crank_pin) && !slides(slider_pin) && guide.friction.none() &&
           guide.rolling_arm == 0;
  }
};

// Throws std::invalid_argument naming the first value outside its domain.
void validate(const SliderCrankJoints& joints);

// What the mechanism is asked at: position, motion, and the force on its slider.
struct CrankState {
  double phi = 0, omega = 0, alpha = 0;  // [rad, rad/s, rad/s²]
  double slider_force = 0;               // along +x, without weight [N]
  int direction = 0;                     // ±1: of the motion, whatever ω; 0: the sign of ω
  bool at_rest = false;                  // about to move that way: static coefficients
};

enum class Joint : std::size_t { main_bearing, crank_pin, slider_pin, guide };
inline constexpr std::size_t joint_count = 4;
inline const char* name_of(Joint joint) { return enumerator_words<Joint::guide>(joint); }

// Everything about one position.
struct SliderCrankForces {
  Force2 main_bearing, crank_pin, slider_pin;  // reactions, friction included [N]
  double guide = 0;                            // normal reaction N, along +y [N]
  double guide_moment = 0;                     // moment of the normal reactions about the slider pin [N·m]
  double guide_point = 0;   // where N acts, from the pin along x = guide_moment/N [m]; beyond every guide if N = 0
  bool both_edges = false;  // N acts beyond the guide: both ends of the slider carry
  double edge_front = 0, edge_back = 0;     // normal forces at the ends towards +x and −x, where both edges carry [N]
  double guide_friction = 0;                // along +x on the slider [N]
  std::array<double, 3> friction_torque{};  // in main bearing (on crank), crank pin (on rod), slider pin (on slider)
  std::array<double, joint_count> friction_power{};   // lost, ≥ 0 [W]
  double torque = 0;                                  // balancing torque M [N·m]
  Force2 crank_inertia, rod_inertia, slider_inertia;  // −m a_S [N]
  double rod_couple = 0, crank_couple = 0;            // −I ε, about their centres of mass [N·m]
  Force2 shaking_force;                               // of all inertia forces, on the frame [N]
  double shaking_moment = 0;                          // of all inertia forces and couples about O, on the frame [N·m]
  double residual = 0;  // of the friction laws, relative to the largest friction load they require
  int iterations = 0;   // of Newton's method

  double friction_loss() const;  // [W]
};

// The same as any mechanism's joints, in their order, and back.
inline MechanismJoints joints_of(const SliderCrankJoints& j) {
  const auto pin = [](const char* name, const RevoluteJoint& joint) {
    return RubbingJoint{.name = name, .friction = joint.friction, .radius = joint.radius};
  };
  const SliderGuide& g = j.guide;
  return {{pin("main bearing", j.main_bearing),
           pin("crank pin", j.crank_pin),
           pin("slider pin", j.slider_pin),
           {.name = "guide",
            .friction = g.friction,
            .length = g.length,
            .middle = g.middle,
            .width = g.width,
            .rolling_arm = g.rolling_arm,
            .roller_radius = g.roller_radius}},
          {.com = g.com_x, .load = g.force_offset}};
}
inline SliderCrankJoints slider_crank_joints(const MechanismJoints& given) {
  const auto pin = [&](std::size_t k) { return RevoluteJoint{given.joints[k].radius, given.joints[k].friction}; };
  const RubbingJoint& g = given.joints[3];
  return {pin(0),
          pin(1),
          pin(2),
          {g.friction, g.length, g.middle, g.width, g.rolling_arm, g.roller_radius, given.off.com, given.off.load}};
}

class SliderCrankStatics {
 public:
  // Rows and columns of the table of unit cases.
  enum Reaction : int { main_x, main_y, crank_x, crank_y, slider_x, slider_y, guide_n, guide_m, torque_m, reactions };
  enum Case : int {
    speed_case,         // ω² = 1
    acceleration_case,  // ε = 1
    gravity_case,       // weights
    force_case,         // slider force 1 N
    main_friction,      // 1 N·m on the crank
    crank_friction,     // 1 N·m on the rod, −1 on the crank
    slider_friction,    // 1 N·m on the slider, −1 on the rod
    guide_friction,     // 1 N on the slider along +x, in the line of its pin
    guide_couple,       // 1 N·m on the slider, from guide friction off that line
    cases
  };
  using Table = Eigen::Matrix<double, reactions, cases>;
  using Column = Eigen::Matrix<double, reactions, 1>;
  static constexpr int frictions = cases - main_friction;

  // Throws std::invalid_argument for data outside its domain.
  explicit SliderCrankStatics(const SliderCrankData& data, const SliderCrankJoints& joints = {});
  const SliderCrankData& data() const { return data_; }
  const SliderCrankJoints& joints() const { return joints_; }

  // Each column: all reactions to one unit load alone.
  Table unit_cases(double phi) const;

  // First problem: reactions and balancing torque for a given motion. Throws std::runtime_error with the numbers where
  // the joints jam (no finite reactions satisfy the friction laws).
  SliderCrankForces solve(const CrankState& state) const;
  // The same with every coefficient zero.
  SliderCrankForces solve_frictionless(const CrankState& state) const;

  // Second problem: angular acceleration under a given torque; state.alpha is not read. One scalar equation
  // M(ε) + J ε = torque, implicit through the friction. shaft_inertia J [kg·m²] ≥ 0 turns with the crank. Throws
  // std::invalid_argument where nothing has inertia; std::runtime_error where the joints jam.
  double acceleration(CrankState state, double torque, double shaft_inertia = 0) const;

  // Torques within which the mechanism rests under a slider force: low … high; static coefficients. −∞ or +∞ where it
  // locks itself against that direction.
  struct Range {
    double low, high;
  };
  Range resting_torque(double phi, double slider_force) const;

  // Sliding speeds of the three revolute joints and the guide are velocity × radius.
  struct Rates {
    double main_bearing, crank_pin, slider_pin;  // ω, β̇ − ω, −β̇: of the body that the friction torque is given for
    double slider;                               // v [m/s]
  };
  Rates rates(double phi, double omega) const;

 private:
  struct Law;  // coefficients and directions at one state
  struct Solution;
  Law law_at(const CrankState& state) const;
  Column load_column(const Table& unit, const CrankState& state) const;
  struct FrictionTorque;
  FrictionTorque torque_of(const Table& unit, const Solution& solution) const;
  Solution solve_friction(const Table& unit, const Column& base, const Law& law, double phi) const;
  void add_motion(const CrankState& state, SliderCrankForces& out) const;
  SliderCrankForces assemble(const Column& reaction, const Solution& solution, const CrankState& state) const;

  SliderCrankData data_;
  SliderCrankJoints joints_;
  bool changes_;  // passes change points
  Force2 down_;   // gravity [m/s²]
};

}  // namespace kurbel
