// templates.cpp — the scenes with their names.
#include "studies/scenes/templates.h"

#include "studies/files/built_in.h"

#define KURBEL_TEMPLATES(X)                                                                                          \
  X(press, "crank_press.toml", "crank press: motor, gearbox, flywheel, press force before the lower end")            \
  X(pump, "piston_pump.toml", "triplex plunger pump: motor, gearbox, indicator diagrams over travel")                \
  X(engine, "single_cylinder_engine.toml",                                                                           \
    "single-cylinder four-stroke engine with generator: gas force over 720 deg")                                     \
  X(compressor, "compressor.toml", "reciprocating compressor: polytropic indicator diagram, flywheel")               \
  X(shaper, "shaper.toml", "shaper: crank and slotted lever with quick return, cutting force on the slow stroke")    \
  X(knuckle, "knuckle_press.toml", "knuckle-joint press: toggle links fall into line at the lower end")              \
  X(linkage, "six_link_press.toml", "six-link drawing press: any linkage by a sketch of its points")                 \
  X(rocker, "four_bar_rocker.toml", "shaking screen: crank–rocker four-bar, loads on the rocker")                    \
  X(feeder, "drag_link_feeder.toml", "drum feeder: drag link, whose output rotates unevenly")                        \
  X(saw, "straight_line_saw.toml", "reciprocating saw: rod as long as the crank, through its change points")         \
  X(chain, "six_inertia_chain.toml", "six inertias on couplings: start of a fan")                                    \
  X(fan, "fan_star_delta.toml", "fan started star–delta: cage motor by its catalogue's points")                      \
  X(centrifugal, "centrifugal_pump.toml", "centrifugal pump switched on directly: cage motor by its nameplate")      \
  X(conveyor, "belt_conveyor.toml", "belt conveyor on a frequency converter with a torque limit")                    \
  X(crane, "series_motor_crane.toml", "crane hoist with a DC series motor")                                          \
  X(winch, "hydraulic_winch.toml", "hydraulic winch: constant flow, relief valve")                                   \
  X(mixer, "air_motor_mixer.toml", "mixer with an air motor")                                                        \
  X(diesel, "six_cylinder_engine.toml", "six-cylinder engine by indicator diagram and firing order, with generator") \
  X(drive, "press_drive.toml", "press drive as built: clutch and brake, single stroke, overload protection")         \
  X(hoist, "worm_hoist.toml", "hoist with a self-locking worm gear")                                                 \
  X(brake, "planetary_brake.toml", "planetary gear with a brake on its ring")                                        \
  X(mill, "belt_mill.toml", "mill with a belt that slips at the start")                                              \
  X(genset, "diesel_generator.toml", "diesel generator: damper, rubber coupling, speed governor, load switched on")  \
  X(elevator, "inclined_conveyor.toml",                                                                              \
    "inclined conveyor: fluid coupling, one-way clutch, inching drive, progressive coupling")                        \
  X(axle, "drive_axle.toml", "driven axle: cardan shaft at an angle, differential")                                  \
  X(gears, "gear_test_rig.toml", "spur gears with varying tooth stiffness, run up through resonance")                \
  X(rig, "back_to_back_rig.toml", "back-to-back gear rig: a closed loop of shafts with locked-in torque")            \
  X(screw, "screw_press.toml", "screw press: flywheel on the spindle, a stroke that spends its energy")              \
  X(jack, "screw_jack.toml", "screw jack with a self-locking thread")                                                \
  X(steam, "steam_engine.toml", "double-acting steam engine: a cylinder drives the slider, no motor turns")          \
  X(unloader, "unloaded_compressor.toml",                                                                            \
    "double-acting compressor: started unloaded, its ends loaded one by one, emergency stop")

#define KURBEL_SCENE(name, file, doc) KURBEL_BUILT_IN(name, KURBEL_SCENES_FOLDER "/" file)
KURBEL_TEMPLATES(KURBEL_SCENE)

namespace kurbel {

const std::vector<SceneTemplate>& scene_templates() {
#define KURBEL_TEMPLATE(name, file, doc) {#name, doc, name()},
  static const std::vector<SceneTemplate> templates = {KURBEL_TEMPLATES(KURBEL_TEMPLATE)};
  return templates;
}

}  // namespace kurbel
