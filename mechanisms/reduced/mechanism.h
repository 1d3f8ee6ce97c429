// mechanism.h — a mechanism of one degree of freedom as an element: variable inertia, weight and loads on its output,
// reduced to its crank.
//     M = −½ I_r′ ω² + M_g(φ) + Σ F x′(φ),   and I_r(φ) adds to the shaft's inertia            (theory 2.1, 2.2, 2.4)
// The output slides (x [m], loads in N) or rocks (x is its angle [rad], loads in N·m).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/elements/any_shaft_element.h"
#include "engine/elements/reacting_pool.h"
#include "engine/model/network.h"
#include "mechanisms/friction/joint_friction.h"
#include "mechanisms/loads/slider_loads.h"
#include "mechanisms/reduced/reduced_mechanism.h"

namespace kurbel {

// Figures of a cycle of the crank (one or two turns) from the tables.
struct TravelOfTurn {
  double least = 0, greatest = 0;              // of the output's position [m] or [rad]
  std::vector<double> reversals;               // crank angles at which the output reverses, ascending [rad]
  double mean_inertia = 0, least_inertia = 0;  // of I_r [kg·m²]
  double weight = 0;                           // greatest |M_g| [N·m]
  double winding = 0;                          // turns of the output per turn of the crank; 0: it slides or rocks
};
TravelOfTurn travel_of_turn(const ReducedMechanism& reduced);

struct Mechanism;
// Parts of a mechanism that deform, by the scene: what it does beyond its one degree of freedom (mechanisms/deforming).
class DeformingParts {
 public:
  virtual ~DeformingParts() = default;
  // What these effects leave of them; null: nothing.
  virtual std::shared_ptr<const DeformingParts> under(const Effects& effects) const = 0;
  // The mechanism with them, as an element.
  virtual ShaftForm form(Mechanism mechanism) const = 0;
};

struct Mechanism {
  // Extracts the tables and finds the ends of the output's travel. Throws as make_bodies and MechanismBodies do.
  Mechanism(std::string component, const MechanismData& what, Extraction from = Extraction::first);

  std::string name;
  MechanismData data;
  Extraction extraction = Extraction::first;
  std::shared_ptr<const ReducedMechanism> reduced;
  std::shared_ptr<MechanismBodies> bodies;  // for the independent kinetic energy
  TravelOfTurn travel;
  std::vector<SliderLoad> loads;
  double phase = 0;                                             // added to the shaft's angle [rad]
  std::shared_ptr<const JointFrictionSource> joints = nullptr;  // null: no friction in joints
  std::shared_ptr<const JointFriction> friction = nullptr;      // null: the effect joint friction is off
  bool weightless = false;                                      // the effect gravity is off
  bool mean_inertia = false;                                    // I_r is constant: the effect variable inertia is off
  bool in_the_loop = false;  // the bodies are evaluated at every step: the effect multibody is on
  std::shared_ptr<const DeformingParts> deforming = nullptr;  // null: its links are rigid, its joints ideal

  bool rocks() const { return data.rocks(); }  // the output is an angle
  // A force within a linkage: the output is the travel of a spring, force or couple; no inertia, no weight.
  bool is_force() const { return data.is_travel(); }
  bool has_weight() const;
  double stroke() const { return travel.greatest - travel.least; }
  bool stands_still() const { return stroke() == 0 && travel.winding == 0; }  // of a path it is not known
  // Scale of x′: half the stroke; 1 if the output turns fully or never moves.
  double output_scale() const { return travel.winding != 0 || stroke() == 0 ? 1 : 0.5 * stroke(); }
  double cycle() const { return reduced->cycle().angle(); }  // crank angle of a cycle [rad]
  // Range of a rocking crank; else null.
  const CrankArc* arc() const { return reduced->cycle().arc() ? &*reduced->cycle().arc() : nullptr; }

  // Some load depends on the direction of travel.
  bool watches_travel() const;
  // Sign of x′; at a dead centre the sign after it in this direction of the crank.
  int growth(double angle, int direction) const;
  // Σ F of the loads on the output [N], for a rocking output [N·m], at a crank angle [rad] and speed [rad/s]; at an edge of
  // a law by the piece that begins there. `acting`: whether each load acts, in their order; empty: all act. Throws as
  // require_on_arc.
  double load(double angle, double speed, const std::vector<bool>& acting = {}) const;

  // A copy with tables, travel and the ends of the loads from this extraction.
  Mechanism extracted_from(Extraction from) const;
};

// A network with all mechanisms from this extraction, for a run that confirms another:
//     compile_network(extracted_from(build_network(scene), Extraction::second), scene, effects)
// has the same coordinates, states, modes, channels and figures as compile(scene, effects), but no table errors in
// common with it. Takes 1 … 20 ms per mechanism, once for equal data.
Network extracted_from(Network network, Extraction from);

// Whether some mechanism uses tables; without tables a second extraction confirms nothing.
bool has_tables(const Network& network);

// For a rocking crank: "crank rocks between φ = 30° and 120°, where coupler and rocker lie in one line".
std::string words_of_arc(const Mechanism& mechanism);
// Message: why a motion ends at this end of the arc (−1 or 1), and the remedy.
std::string limit_reached(const Mechanism& mechanism, int end);
// Throws std::runtime_error if the crank cannot reach this angle.
void require_on_arc(const Mechanism& mechanism, double phi);

class MechanismElement : public AnyShaftElement {
 public:
  explicit MechanismElement(Mechanism mechanism);
  const Mechanism& mechanism() const { return mechanism_; }
  virtual bool deforms() const { return false; }

  InertiaAt inertia_at(double angle) const override {
    if (mechanism_.mean_inertia) return {mechanism_.travel.mean_inertia, 0};
    const auto [value, slope] = mechanism_.reduced->inertia(angle);
    return {value, slope};
  }
  std::string describe() const override;
  ShaftForm form_under(const Effects& effects) const override;
  void place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel& label) const override;

 private:
  Mechanism mechanism_;
};

// Null for elements of other kinds, and for forces within a linkage.
const MechanismElement* mechanism_of(const Network::ShaftElement& element);
// From a network by the scene, or of a model, by its effects. Null: no mechanism has this name.
const Mechanism* find_mechanism(const Network& network, const std::string& component);

// Modes of each mechanism: the sign of x′, then the piece of each load; with joint friction then the changing signs of the
// joint velocities and the sides of the slides.
class MechanismPool final : public ReactingPool {
 public:
  void place(Mechanism mechanism, ShaftPorts at);

  void add(const Instant& now, Sums& sums) const override;
  void register_jacobian(JacobianPattern& pattern) override;
  void add_jacobian(const Instant& now, const double* alpha, double* slots) const override;
  bool reacts() const override { return reacts_; }
  std::unique_ptr<Memory> make_memory() const override;
  void add_reactions(const Instant& now, const double* alpha, Reactions& sums, Memory* memory) const override;
  int guard_count() const override { return guards_; }
  const std::vector<int>& side_modes() const override { return side_modes_; }
  const std::vector<int>& side_guards() const override { return side_guards_; }
  void find_sides(const Instant& now, const double* alpha, double* side, Memory* memory) const override;
  // The guards depend on travel or crank angle, not on the speed, except those of the sides of reactions.
  bool guards_are_of_angle() const override { return true; }
  const std::vector<int>& reacting_shafts() const override { return reacting_shafts_; }
  void add_answered(const Instant& now, double alpha, double response, Reactions& sums, Memory* memory) const override;
  void guards(const Instant& now, double* g) const override;
  void fire(const Instant& now, int guard, int* mode) const override;
  GuardLabel label(int guard, const Instant& now) const override;
  bool regularise(int guard, int* mode) const override;
  // An operating sequence may switch off the loads; the links continue to move.
  void set_timed_modes(double t, int* mode, char* active) const override;
  void first_modes(const Instant& now, int* mode) const override;
  void follow_directions(const Instant& now, int* mode) const override;
  void add_holds(const Instant& now, Hold* shaft, Hold* element) const override;
  double kinetic_energy_of_bodies(const Instant& now) const override;
  void add_channels(std::vector<Channel>& channels) const override;

 private:
  struct Placed {
    Mechanism mechanism;
    ShaftPorts at;
    int slot_angle = 0, slot_rate = 0;
    bool has_weight = false;
    double output_scale = 1;      // of x′
    bool watches_travel = false;  // some load depends on the direction of travel
    // With joint friction: indices of the forces within, in the order of JointFriction::applied(); −1: not placed.
    std::vector<int> within = {};
    int load_account = 0;  // of the first load: after that of the weight, which forces within a linkage do not have
  };
  struct GuardOwner {
    std::size_t placed;
    int load;  // or one of: sign of x′, sign of a joint velocity, side of a slide, limit of the arc
    int which;
    static constexpr int travel = -1, turning = -2, side = -3, limit = -4;
  };
  // Reduced functions at an angle, from the tables or from the bodies.
  struct Reduced {
    double inertia, inertia_slope, position, ratio, weight;
  };
  static double angle_of(const ShaftPorts& at, const Instant& now) { return now.angle[at.angle] + at.phase; }
  static Reduced reduced_at(const Placed& p, double phi);
  SliderState<double> slider(const Placed& p, const Instant& now, std::size_t load) const;
  static bool is_loaded(const Placed& p, const Instant& now) {
    return !p.mechanism.loads.empty() && now.active[p.at.id];
  }
  double load_force(const Placed& p, const Instant& now) const;
  Dual<2> load_slopes(const Placed& p, const Instant& now) const;  // by crank angle and crank speed
  // Forces on the joints: the load on the output, forces within.
  struct Acting {
    double load = 0, applied[JointFriction::most_applied] = {};
  };
  Acting acting(const Placed& p, const Instant& now) const;
  struct FrictionMemory;
  static JointFriction::Torque friction_torque(const Placed& p, const JointFriction::State& state, double response,
                                               JointFriction::Place& place);
  // The state refers to `forces`, which must outlive it.
  JointFriction::State crank_state(const Placed& p, const Instant& now, double alpha, const Acting& forces) const;
  void add_friction(const Placed& p, const JointFriction::State& state, const JointFriction::Torque& friction,
                    Reactions& sums) const;
  void add_friction_jacobian(const Placed& p, const Instant& now, const double* alpha, double* slots) const;
  static int turning_mode(const Placed& p, int which) {
    return p.at.mode + 1 + static_cast<int>(p.mechanism.loads.size()) + which;
  }
  static int side_mode(const Placed& p, int side) { return turning_mode(p, p.mechanism.friction->sign_count() + side); }
  void take_first_signs(const Placed& p, const Instant& now, int* mode) const;
  Hold load_hold(const Placed& p, const Instant& now) const;
  Hold friction_hold(const Placed& p, const Instant& now) const;

  std::vector<Placed> placed_;
  std::vector<GuardOwner> owners_;
  std::vector<int> side_modes_, side_guards_, reacting_shafts_;
  int guards_ = 0;
  bool reacts_ = false;
};

}  // namespace kurbel
