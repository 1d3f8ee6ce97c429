// effects.h — effects simulated in addition to the rigid machine. An effect that is off adds no cost.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace kurbel {

struct Scene;
struct Section;

// `elastic`: names of the components whose elasticity is on.
struct Effects {
  bool all_elastic = false;
  std::vector<std::string> elastic = {};
  bool joint_friction = false;    // in the mechanisms' joints
  bool backlash = false;          // gaps between flanks; off: they always touch
  bool mesh_variation = false;    // tooth stiffness over the mesh; off: its mean
  bool transients = false;        // circuits of motors; off: their static characteristic
  bool torque_lag = true;         // of induction motors on that, in machines with elasticity; off: none
  bool lags_rigid = false;        // … also without: for the rigid machine compared with an elastic one that has it
  bool relaxation = false;        // of rubber; off: its static stiffness and damping
  bool bearing_friction = false;  // off: none
  bool gear_losses = false;       // off: gears without losses
  bool gravity = true;            // weight of the mechanisms
  bool variable_inertia = true;   // I_r(φ) of the mechanisms; off: its mean
  bool load_edges = true;         // of forces over travel or angle, as events; off: rounded
  bool multibody = false;         // mechanisms evaluated by Simbody in the loop; off: by tables extracted from it
  bool joint_clearance = false;   // of the slider-crank; off: its joints are ideal
  bool flexible_rod = false;      // of the slider-crank; off: its rod is rigid
  bool locked = false;            // clutches count as locked: for studies of the rigid machine

  bool is_elastic(const std::string& component) const;
  std::string describe() const;  // "elasticity", "elasticity of main_coupling", "joint friction", "none"
};

// An effect that is either on or off for the whole machine.
struct EffectFlag {
  const char* name;  // in [effects] and --effects
  bool Effects::*flag;
  const char* words;  // "joint friction"
  enum class Default { off, where_given, with_elasticity, part_of_machine };
  Default by_default;      // default: off; on if the scene has parameters; on in elastic machines; always on
  const char* adds;        // what it simulates
  const char* parameters;  // parameters needed in a scene
  const char* states;      // additional states and events
  const char* matters;     // when it is relevant
  // A flexible body, or an effect of elastic connections only: switched off together with elasticity.
  bool of_elasticity = false;
  bool is_usual() const { return by_default >= Default::with_elasticity; }  // only its absence is reported
};
std::span<const EffectFlag> effect_flags();

// The same machine made rigid, which is the meaning of "rigid" in comparison with "elastic": only elasticity is removed, all
// else is kept. Elasticity is what allows relative motion of two ends of one body:
//   removed      couplings, shafts, belts, meshes of teeth, supports of housings: their ends are one;
//                the flexible rod of a slider-crank;
//                effects of elastic connections only: backlash (rigid flanks always touch; there is no law of rigid
//                impact), mesh variation, relaxation;
//   kept         friction of joints and bearings (LuGre's bristle is the friction's own memory), losses of gears and
//                their self-locking, slip of belts, clutches and fluid couplings, currents of motors; joint clearance (it
//                adds the motion of the journal within its gap, not compliance); and parts of every machine: gravity,
//                variable inertia, load edges. By default the torque lag of motors is on only with elasticity; a
//                comparison has it on both sides (rigid_twin in studies/run/compare.h).
Effects without_elasticity(const Effects& effects);

// The basic machine: only effects that are on by default, as they are in `effects`.
Effects bare_machine(const Effects& effects);

// Common effects of two models: effects on in both; of effects on by default, only those off in both are off.
Effects in_both(const Effects& a, const Effects& b);

// Whether a component's table in the scene has a key for this effect.
bool has_parameters(const Scene& scene, const EffectFlag& effect);
bool has_parameters(const Section& section, const EffectFlag& effect);

// "none", "all" (with parameters in the scene), or names separated by commas: "elasticity" or
// "elasticity:motor_coupling,main_coupling", and names of flags; "-name" removes an effect, at the beginning of the list
// from the effects of the scene. Throws std::invalid_argument.
Effects parse_effects(const std::string& text, const Scene& scene);

}  // namespace kurbel
