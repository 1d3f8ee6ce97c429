// joint_friction.h — friction in the joints of a linkage: by their reactions, which it changes, a torque on the crank.
//
// A pin has the reaction R_x, R_y of body `from` on body `on`; a slide has N across it and the moment M about its place.
// Of all joints that rub these are linear, with coefficients that are functions of φ (theory 10.2):
//     R = ω² a + ε b + w + F c + Σ F_i c_i + U q
// w weights, F the load on the output, F_i what acts within the linkage, q the friction loads, all on body `on`:
//     pin    q = −sgn(v) ρ |R|              couple [N·m]; ρ = r f/√(1 + f²), radius of the friction circle
//     slide  q = −sgn(v) (f + k_r/r_r) Σ|N| force along it [N]; Σ|N| = |N| within the guide's length L, else both edges
//                                           bear: Σ|N| = (|L N − 2 M| + |L N + 2 M|)/2L, M about the guide's middle
//            q = −sgn(v) (f + k_r/r_r) w/2 N  couple of the friction on two faces at the distance w [N·m]
// v_j ω is the velocity of `on` against `from`: of a pin an angle's, of a slide along it. On the crank acts, by the power,
//     M = Σ v_j q_j
// With ε = ε₀ + m M, where m is what a unit of torque on the crank adds to ε, all is found at once:
//     q = law(R₀ + (U + m b vᵀ) q),   R₀ at ε₀                                                                      (1)
// by Newton's method. Of several solutions the one is meant that the frictionless one leads to as the coefficients grow
// from zero: the determinant of 1 − ∂law/∂R (U + m b vᵀ) stays positive on that way. Where it ends there is none: at a
// given ε no reactions satisfy the laws (the joints jam); with ε free no acceleration does (Painlevé's inconsistency).
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/friction/friction.h"

namespace kurbel {

// What a scene says of a joint.
struct RubbingJoint {
  std::string name;  // of the joint in the linkage
  FrictionCoefficient friction;
  double radius = 0;         // of a pin [m], ≥ 0
  double length = 0;         // L of a slide [m], ≥ 0; 0: takes moments without more friction
  double middle = 0;         // of that length, from the joint's place along the slide [m]
  double width = 0;          // between the two faces of a slide [m], ≥ 0
  double rolling_arm = 0;    // k_r of the rollers of a slide [m], ≥ 0
  double roller_radius = 0;  // r_r [m], > 0 where there is a rolling_arm

  bool rubs(bool slides) const { return slides ? !friction.none() || rolling_arm > 0 : radius > 0 && !friction.none(); }
};

// Throws std::invalid_argument naming the first value outside its domain.
void validate(const RubbingJoint& joint);

// Coefficients of the reactions over φ. Values in rows, one of each reaction, two reactions a joint that rubs:
//     a, b, w, c, then c_i by what acts within, U by friction load;      behind all rows v by friction load.
struct ReactionPlaces {
  std::size_t joints = 0, loads = 0, applied = 0;
  enum Case : std::size_t { speed_case, acceleration_case, weight_case, load_case, cases };
  std::size_t friction(std::size_t load) const { return cases + applied + load; }  // in a row
  std::size_t stride() const { return friction(loads); }
  std::size_t reactions() const { return 2 * joints; }
  std::size_t ratio(std::size_t load) const { return reactions() * stride() + load; }
  std::size_t size() const { return reactions() * stride() + loads; }
};
class ReactionTable {
 public:
  virtual ~ReactionTable() = default;
  virtual const ReactionPlaces& places() const = 0;
  virtual void read(double phi, double* values) const = 0;
  virtual void read(double phi, double* values, double* slopes) const = 0;  // and their derivatives by φ
  struct One {
    double value, slope;
  };
  virtual One read_one(double phi, std::size_t place) const = 0;
  virtual std::string describe() const = 0;  // pieces, samples, errors
};

class JointFriction {
 public:
  static constexpr std::size_t most_joints = 24, most_loads = 32, most_applied = 8;
  static constexpr std::size_t most_values =
      2 * most_joints * (ReactionPlaces::cases + most_applied + most_loads) + most_loads;

  struct Joint {
    RubbingJoint data;
    bool slides = false;
    std::size_t load = 0;                 // its friction load: of the n-th joint the n-th
    std::optional<std::size_t> couple{};  // of a slide with two faces, behind the loads of all joints
    // Sign of v: a sign of its own among those that change, the sign of the output's travel, or always the same.
    static constexpr int of_travel = -1, constant = -2;
    int sign = constant;
    int sense = 1;               // times that sign
    std::size_t first_side = 0;  // of a slide, among all sides
  };
  // A function of φ whose sign turns: the ratio of this load, which joints of the same or the opposite share.
  struct Turning {
    std::size_t load = 0;
    double scale = 1;  // of its greatest value
  };

  // `applied`: names of what acts within the linkage, in the order of the table.
  JointFriction(std::vector<Joint> joints, std::vector<Turning> turnings, std::shared_ptr<const ReactionTable> table,
                std::vector<std::string> applied = {});

  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<std::string>& applied() const { return applied_; }
  std::string describe() const { return table_->describe(); }
  // Modes: one a turning sign, then the sides of the slides: two edges of one with length, else one.
  int sign_count() const { return static_cast<int>(turnings_.size()); }
  int side_count() const { return sides_; }
  // v over its scale, of a turning sign.
  ReactionTable::One turning(int which, double phi) const;

  struct State {
    double phi = 0, omega = 0, alpha = 0;  // [rad, rad/s, rad/s²]
    double load = 0;                       // F [N]; of an output that rocks [N·m]
    const double* applied = nullptr;       // F_i [N], [N·m], in the order of applied(); null: none acts
    int direction = 0;                     // ±1: of the crank, whatever ω; 0: the sign of ω
    bool at_rest = false;                  // about to move that way: static coefficients
    bool weightless = false;
    int travel = 0;              // sign of the output's x′; 0: as it comes
    const int* modes = nullptr;  // ±1: the sign, the side that is held; others and null: as it comes
  };
  struct Torque {
    double torque = 0, slope = 0;  // M [N·m]; dM/dε at this state [kg·m²]
    double alpha = 0;              // ε + m M
  };
  // M at the acceleration ε + m M: response m [1/(kg·m²)]; 0: at the acceleration given. Throws Jam with the angle and the
  // share of the coefficients from which on there is no solution.
  Torque torque(const State& state, double response = 0) const;
  // The same at a place that was read before, for who asks again and again there.
  struct Place {
    double phi = std::numeric_limits<double>::quiet_NaN();
    double values[most_values];
  };
  Torque torque(const State& state, double response, Place& place) const;
  // ∂M/∂(φ, ω, F, F_i) at that ε.
  struct Slopes {
    double by_angle = 0, by_speed = 0, by_load = 0;  // [N·m], [N·m·s], [m] or [1]
    double by_applied[most_applied] = {};            // [m] or [1]
  };
  Slopes slopes(const State& state) const;
  // How far all sides are from bearing nothing, with their signs; of order one.
  void sides(const State& state, double* side) const;
  // Reactions and friction loads in full: per joint R_x, R_y or N, M; per load q.
  struct Solved {
    std::vector<double> reactions, loads;
    double torque = 0, residual = 0;  // of the laws, relative to the largest load
  };
  Solved solve(const State& state) const;
  // What friction holds at rest the way the crank is about to move, direction ±1: −M, ∞ where it locks itself [N·m].
  double resting(double phi, double load, int direction, bool weightless, const double* applied = nullptr) const;

 private:
  struct Work;
  void prepare(const State& state, double response, const double* values, bool fold, Work& work) const;
  void find(const State& state, Work& work) const;
  double without_friction(const State& state, const double* row) const;
  template <std::size_t N>
  double apply_laws(Work& work) const;
  template <std::size_t N>
  bool settle(double share, Work& work) const;
  bool settle_any(double share, Work& work) const;

  std::vector<Joint> joints_;
  std::vector<Turning> turnings_;
  std::shared_ptr<const ReactionTable> table_;
  ReactionPlaces places_;
  std::vector<std::string> applied_;
  int sides_ = 0;
};

// Joints that rub, as a mechanism has them: a table is made when somebody asks for it first. `second`: from pieces that
// have nothing in common with the first's.
class JointFrictionSource {
 public:
  using Make = std::function<std::shared_ptr<const JointFriction>(bool second)>;
  explicit JointFrictionSource(Make make);
  ~JointFrictionSource();
  std::shared_ptr<const JointFriction> get(bool second) const;

 private:
  struct Kept;
  Make make_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace kurbel
