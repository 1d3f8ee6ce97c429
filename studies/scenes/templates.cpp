// templates.cpp — includes the scenes by the assembler.
#include "studies/scenes/templates.h"

#define KURBEL_SCENE(name, file)                       \
  asm(".section .rodata\n"                             \
      ".global kurbel_scene_" #name                    \
      "_begin\n"                                       \
      ".global kurbel_scene_" #name                    \
      "_end\n"                                         \
      "kurbel_scene_" #name                            \
      "_begin:\n"                                      \
      ".incbin \"" KURBEL_SCENES_FOLDER "/" file       \
      "\"\n"                                           \
      "kurbel_scene_" #name                            \
      "_end:\n"                                        \
      ".byte 0\n"                                      \
      ".previous\n");                                  \
  extern "C" const char kurbel_scene_##name##_begin[]; \
  extern "C" const char kurbel_scene_##name##_end[];   \
  static std::string_view name() { return {kurbel_scene_##name##_begin, kurbel_scene_##name##_end}; }

KURBEL_SCENE(press, "crank_press.toml")
KURBEL_SCENE(pump, "piston_pump.toml")
KURBEL_SCENE(engine, "single_cylinder_engine.toml")
KURBEL_SCENE(compressor, "compressor.toml")
KURBEL_SCENE(shaper, "shaper.toml")
KURBEL_SCENE(knuckle, "knuckle_press.toml")
KURBEL_SCENE(linkage, "six_link_press.toml")
KURBEL_SCENE(rocker, "four_bar_rocker.toml")
KURBEL_SCENE(feeder, "drag_link_feeder.toml")
KURBEL_SCENE(saw, "straight_line_saw.toml")
KURBEL_SCENE(chain, "six_inertia_chain.toml")
KURBEL_SCENE(fan, "fan_star_delta.toml")
KURBEL_SCENE(centrifugal, "centrifugal_pump.toml")
KURBEL_SCENE(conveyor, "belt_conveyor.toml")
KURBEL_SCENE(crane, "series_motor_crane.toml")
KURBEL_SCENE(winch, "hydraulic_winch.toml")
KURBEL_SCENE(mixer, "air_motor_mixer.toml")
KURBEL_SCENE(diesel, "six_cylinder_engine.toml")
KURBEL_SCENE(drive, "press_drive.toml")
KURBEL_SCENE(hoist, "worm_hoist.toml")
KURBEL_SCENE(brake, "planetary_brake.toml")
KURBEL_SCENE(mill, "belt_mill.toml")
KURBEL_SCENE(genset, "diesel_generator.toml")
KURBEL_SCENE(elevator, "inclined_conveyor.toml")
KURBEL_SCENE(axle, "drive_axle.toml")
KURBEL_SCENE(gears, "gear_test_rig.toml")
KURBEL_SCENE(rig, "back_to_back_rig.toml")
KURBEL_SCENE(screw, "screw_press.toml")
KURBEL_SCENE(jack, "screw_jack.toml")
KURBEL_SCENE(steam, "steam_engine.toml")
KURBEL_SCENE(unloader, "unloaded_compressor.toml")

namespace kurbel {

const std::vector<SceneTemplate>& scene_templates() {
  static const std::vector<SceneTemplate> templates = {
      {"press", "crank press: motor, gearbox, flywheel, press force before the lower end", press()},
      {"pump", "triplex plunger pump: motor, gearbox, indicator diagrams over travel", pump()},
      {"engine", "single-cylinder four-stroke engine with generator: gas force over 720 deg", engine()},
      {"compressor", "reciprocating compressor: polytropic indicator diagram, flywheel", compressor()},
      {"shaper", "shaper: crank and slotted lever with quick return, cutting force on the slow stroke", shaper()},
      {"knuckle", "knuckle-joint press: toggle links fall into line at the lower end", knuckle()},
      {"linkage", "six-link drawing press: any linkage by a sketch of its points", linkage()},
      {"rocker", "shaking screen: crank–rocker four-bar, loads on the rocker", rocker()},
      {"feeder", "drum feeder: drag link, whose output rotates unevenly", feeder()},
      {"saw", "reciprocating saw: rod as long as the crank, through its change points", saw()},
      {"chain", "six inertias on couplings: start of a fan", chain()},
      {"fan", "fan started star–delta: cage motor by its catalogue's points", fan()},
      {"centrifugal", "centrifugal pump switched on directly: cage motor by its nameplate", centrifugal()},
      {"conveyor", "belt conveyor on a frequency converter with a torque limit", conveyor()},
      {"crane", "crane hoist with a DC series motor", crane()},
      {"winch", "hydraulic winch: constant flow, relief valve", winch()},
      {"mixer", "mixer with an air motor", mixer()},
      {"diesel", "six-cylinder engine by indicator diagram and firing order, with generator", diesel()},
      {"drive", "press drive as built: clutch and brake, single stroke, overload protection", drive()},
      {"hoist", "hoist with a worm gear that locks itself", hoist()},
      {"brake", "planetary gear with a brake on its ring", brake()},
      {"mill", "mill with a belt that slips at the start", mill()},
      {"genset", "diesel generator: damper, rubber coupling, speed governor, load switched on", genset()},
      {"elevator", "inclined conveyor: fluid coupling, one-way clutch, inching drive, progressive coupling",
       elevator()},
      {"axle", "driven axle: cardan shaft at an angle, differential", axle()},
      {"gears", "spur gears with varying tooth stiffness, run up through resonance", gears()},
      {"rig", "back-to-back gear rig: a closed loop of shafts with locked-in torque", rig()},
      {"screw", "screw press: flywheel on the spindle, a stroke that spends its energy", screw()},
      {"jack", "screw jack whose thread locks itself", jack()},
      {"steam", "double-acting steam engine: a cylinder drives the slider, no motor turns", steam()},
      {"unloader", "double-acting compressor: started unloaded, its ends loaded one by one, emergency stop",
       unloader()},
  };
  return templates;
}

}  // namespace kurbel
