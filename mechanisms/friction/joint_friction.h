// joint_friction.h — friction in the joints of a linkage as a torque on the crank, solved together with the reactions.
//
// A pin has the reaction R_x, R_y of body `from` on body `on`; a slide has N across it and the moment M about its place.
// The reactions of all joints with friction are linear with coefficients over φ (theory 10.2):
//     R = ω² a + ε b + w + F c + Σ F_i c_i + U q
// w weights, F load on the output, F_i forces within the linkage, q friction loads, all on body `on`:
//     pin    q = −sgn(v) ρ |R|              couple [N·m]; ρ = r f/√(1 + f²), radius of the friction circle
//     slide  q = −sgn(v) (f + k_r/r_r) Σ|N| force along it [N]; Σ|N| = |N| if N acts within the guide's length L, else
//                            contact at both edges: Σ|N| = (|L N − 2 M| + |L N + 2 M|)/2L, M about the guide's middle
//            q = −sgn(v) (f + k_r/r_r) w/2 N  couple of the friction on two faces at the distance w, between which `on`
//                            lies; with `from` between them the opposite [N·m]
// v_j ω is the velocity of `on` relative to `from`: angular for a pin, along a slide. Torque on the crank by equal power:
//     M = Σ v_j q_j
// With ε = ε₀ + m M, where m is the acceleration per unit of torque on the crank, all unknowns are solved together:
//     q = law(R₀ + (U + m b vᵀ) q),   R₀ at ε₀                                                                      (1)
// by Newton's method. Of several solutions the valid one is reached continuously from the frictionless solution as the
// coefficients grow from zero: det(1 − ∂law/∂R (U + m b vᵀ)) stays positive. If this path ends, there is no solution: with
// given ε no reactions satisfy the laws (the joints jam); with free ε no acceleration does (Painlevé's inconsistency).
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/friction/friction.h"

namespace kurbel {

// Data of a joint in the scene.
struct RubbingJoint {
  std::string name;  // of the joint in the linkage
  FrictionCoefficient friction;
  double radius = 0;         // of a pin [m], ≥ 0
  double length = 0;         // L of a slide [m], ≥ 0; 0: moments add no friction
  double middle = 0;         // middle of that length, from the joint's place along the slide [m]
  double width = 0;          // between the two faces of a slide [m], ≥ 0
  double rolling_arm = 0;    // k_r of the rollers of a slide [m], ≥ 0
  double roller_radius = 0;  // r_r [m], > 0 if rolling_arm > 0
  // Of a pin's film, for `forces` alone, all ≥ 0: R_q of journal and bore [m], η [Pa·s], radial clearance and length [m].
  double roughness = 0, bore_roughness = 0, viscosity = 0, clearance = 0, film_length = 0;

  bool film() const { return roughness > 0 || viscosity > 0; }
  bool rubs(bool slides) const { return slides ? !friction.none() || rolling_arm > 0 : radius > 0 && !friction.none(); }
};

// Throws std::invalid_argument naming the first value outside its domain.
void validate(const RubbingJoint& joint);

// Coefficients of the reactions over φ, one column for each of a, b, w, c, then c_i of each force within, then U of each
// friction load; after all columns v of each friction load. In a column stands R_x or N of each joint with friction, then
// R_y or M of each.
struct ReactionPlaces {
  std::size_t joints = 0, loads = 0, applied = 0;
  enum Case : std::size_t { speed_case, acceleration_case, weight_case, load_case, cases };
  std::size_t reactions() const { return 2 * joints; }
  std::size_t reaction(std::size_t joint, std::size_t part) const { return part * joints + joint; }
  std::size_t friction(std::size_t load) const { return cases + applied + load; }  // number of its column
  std::size_t columns() const { return friction(loads); }
  std::size_t column(std::size_t number) const { return number * reactions(); }
  std::size_t ratio(std::size_t load) const { return column(columns()) + load; }
  std::size_t size() const { return ratio(loads); }
};
class ReactionTable {
 public:
  virtual ~ReactionTable() = default;
  virtual const ReactionPlaces& places() const = 0;
  virtual void read(double phi, double* values) const = 0;
  virtual void read(double phi, double* values, double* slopes) const = 0;    // and their derivatives by φ
  virtual void move(double phi, double* values) const { read(phi, values); }  // read at another angle before
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
    std::size_t load = 0;                 // its friction load; the n-th joint has the n-th
    std::optional<std::size_t> couple{};  // for a slide with two faces: index after the loads of all joints
    int between = 1;                      // 1: `on` lies between the two faces, −1: `from`
    // Sign of v: index of a changing sign, or the sign of the output's travel, or constant.
    static constexpr int of_travel = -1, constant = -2;
    int sign = constant;
    int sense = 1;               // factor on that sign
    std::size_t first_side = 0;  // for a slide: index among all sides
  };
  // A function of φ that changes its sign: the velocity ratio of this load, shared by joints with the same or opposite v.
  struct Turning {
    std::size_t load = 0;
    double scale = 1;  // its maximum
  };

  // `applied`: names of the forces within the linkage, in the order of the table.
  JointFriction(std::vector<Joint> joints, std::vector<Turning> turnings, std::shared_ptr<const ReactionTable> table,
                std::vector<std::string> applied = {});

  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<std::string>& applied() const { return applied_; }
  std::string describe() const { return table_->describe(); }
  // Modes: one for each changing sign, then the sides of the slides: two edges if the slide has a length, else one.
  int sign_count() const { return static_cast<int>(turnings_.size()); }
  int side_count() const { return sides_; }
  // v over its scale for a changing sign.
  ReactionTable::One turning(int which, double phi) const;

  struct State {
    double phi = 0, omega = 0, alpha = 0;  // [rad, rad/s, rad/s²]
    double load = 0;                       // F [N]; on a rocking output [N·m]
    const double* applied = nullptr;       // F_i [N], [N·m], in the order of applied(); null: all zero
    int direction = 0;                     // ±1: of the crank, independent of ω; 0: the sign of ω
    bool at_rest = false;                  // about to move in that direction: static coefficients
    bool weightless = false;
    int travel = 0;              // sign of the output's velocity; 0: by x′
    const int* modes = nullptr;  // ±1: fixed sign or side; other values and null: by the state
  };
  struct Torque {
    double torque = 0, slope = 0;  // M [N·m]; dM/dε at this state [kg·m²]
    double alpha = 0;              // ε + m M
  };
  // M at the acceleration ε + m M; response: m [1/(kg·m²)]; 0: at the given acceleration. Throws Jam with the angle and the
  // share of the friction coefficients beyond which there is no solution.
  Torque torque(const State& state, double response = 0) const;
  // The same with the table values at φ and the friction loads found kept in `place`.
  struct Place {
    double phi = std::numeric_limits<double>::quiet_NaN();
    double values[most_values], loads[most_loads];
    bool found = false;
  };
  Torque torque(const State& state, double response, Place& place) const;
  // ∂M/∂(φ, ω, F, F_i) at that ε.
  struct Slopes {
    double by_angle = 0, by_speed = 0, by_load = 0;  // [N·m], [N·m·s], [m] or [1]
    double by_applied[most_applied] = {};            // [m] or [1]
  };
  Slopes slopes(const State& state) const;
  // Signed, scaled contact force of every side; zero where the contact changes. place: that of the torque in this state.
  void sides(const State& state, double* side, Place& place) const;
  // All reactions and friction loads: per joint R_x, R_y or N, M; per load q.
  struct Solved {
    std::vector<double> reactions, loads;
    double torque = 0, residual = 0;  // M [N·m]; residual of the laws, relative to the largest load
  };
  Solved solve(const State& state) const;
  // Static friction torque −M against motion in this direction (±1) of the crank [N·m]; ∞: self-locking.
  double resting(double phi, double load, int direction, bool weightless, const double* applied = nullptr) const;

 private:
  struct Work;
  // What the laws need of a joint.
  struct Law {
    bool slides = false;
    double length = 0, middle = 0;
    std::optional<std::size_t> couple;
  };
  void prepare(const State& state, double response, const double* values, bool fold, Work& work) const;
  void find(const State& state, Work& work) const;
  void read(double phi, Place& place) const;
  void without_friction(const State& state, const double* values, double* sums) const;
  template <std::size_t N>
  void apply_laws(Work& work) const;
  template <std::size_t N>
  bool settle(double share, Work& work) const;
  bool settle_any(double share, Work& work) const;

  std::vector<Joint> joints_;
  std::vector<Law> laws_;
  std::vector<Turning> turnings_;
  std::shared_ptr<const ReactionTable> table_;
  ReactionPlaces places_;
  std::vector<std::string> applied_;
  int sides_ = 0;
};

// Friction in the joints of a mechanism; tables are made at the first request. `second`: a table with pieces independent
// of the first.
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
