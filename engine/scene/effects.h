// effects.h — what is simulated beyond the rigid machine. What is off costs nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace kurbel {

struct Scene;
struct Section;

// Every name in `elastic` is a component whose elasticity is on.
struct Effects {
  bool all_elastic = false;
  std::vector<std::string> elastic = {};
  bool joint_friction = false;    // in the mechanisms' joints
  bool backlash = false;          // gaps between flanks; off: they always touch
  bool mesh_variation = false;    // tooth stiffness over the mesh; off: its mean
  bool transients = false;        // circuits of motors; off: their static characteristic
  bool torque_lag = true;         // of induction motors on that, where anything is elastic; off: none
  bool lags_rigid = false;        // … and where nothing is: the rigid machine beside an elastic one that has it
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
  enum class Unsaid { off, where_given, with_elasticity, part_of_machine };
  Unsaid unsaid;     // off; on where the scene has parameters for it; on in any elastic machine; in the rigid one, too
  const char* adds;  // what it simulates
  const char* parameters;  // what a scene needs for it
  const char* states;      // what it adds to the state and to the events
  const char* matters;     // when it matters
  // A body that gives way, or what only an elastic connection has: it goes where elasticity goes.
  bool of_elasticity = false;
  bool is_usual() const { return unsaid >= Unsaid::with_elasticity; }  // only where it is off that is worth a word
};
std::span<const EffectFlag> effect_flags();

// The same machine made rigid, which is what "rigid" means wherever it stands beside "elastic": elasticity alone is taken
// away, everything else stays. Elasticity is whatever lets two ends of one body turn or move against each other:
//   taken away   couplings, shafts, belts, meshes of teeth, supports of housings: their ends are one;
//                the flexible rod of a slider-crank;
//                what only an elastic connection has: backlash (rigid flanks always touch, there is no law of rigid
//                impact here), mesh variation, relaxation;
//   kept         friction of joints and bearings (LuGre's bristle is the friction's own memory), losses of gears and
//                their self-locking, slip of belts, clutches and fluid couplings, currents of motors; joint clearance (the
//                journal's way within its gap, not the bodies' compliance, is what it adds); and what is part of the
//                machine: gravity, variable inertia, load edges. The torque lag of motors is on by itself only where
//                something is elastic; a comparison keeps it on both sides (rigid_twin in studies/run/compare.h).
Effects without_elasticity(const Effects& effects);

// The bare machine: no effect at all but what is on by itself, as it is in `effects`.
Effects bare_machine(const Effects& effects);

// What two models share: effects that are on in both; of what is on by itself, what is off in both.
Effects in_both(const Effects& a, const Effects& b);

// A key that this effect needs stands somewhere in the scene, in a component's table.
bool has_parameters(const Scene& scene, const EffectFlag& effect);
bool has_parameters(const Section& section, const EffectFlag& effect);

// "none", "all" (that the scene has parameters for), or names joined by commas: "elasticity" or
// "elasticity:motor_coupling,main_coupling", and names of flags; "-name" takes one away, at the beginning of the list
// from those of the scene. Throws std::invalid_argument.
Effects parse_effects(const std::string& text, const Scene& scene);

}  // namespace kurbel
