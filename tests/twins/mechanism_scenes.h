// mechanism_scenes.h — every mechanism with weight, offset and phase, its loads and joints; the drive behind a gear.
//
// The mirrored twin of a mechanism is its image in a line through the crank's axis: the stroke's of a slider-crank, of
// a four-bar linkage its ground link, of a quick-return the one square to its stroke.
#pragma once

#include "tests/support/twins.h"

namespace kurbel::test {

inline TwinScene mechanism_scene(const std::string& name, const std::string& mechanism, int output_sign,
                                 const std::string& effects = "",
                                 const std::string& start = "speed = <w+ 9>, angle = <a+ 0.4>",
                                 const std::string& until = "1.1 s") {
  return {.name = name,
          .near = {"crank"},
          .far = {"link", "motor"},
          .rest = {},
          .near_text = "\n[crank]" + mechanism,
          .far_text = R"(
[link]
kind          = "coupling"
stiffness     = <k 1700>
damping_ratio = 0.05
inertia_in    = <J 0.1>
inertia_out   = <J 0.03>
[motor]
kind    = "motor"
torque  = <curve+ speed N*m: -60 190, -2 150, 5 130, 16 -10, 60 -90>
inertia = <J 1.2>
)",
          .end = "[effects]\nelasticity = true\n" + effects + "[run]\nstart = { " + start + " }\nuntil = \"" + until +
                 "\"\naccuracy = 1e-8\nsamples = 31\n",
          .output_sign = {{"crank", output_sign}},
          .gears = 2};
}

inline TwinScene dear(TwinScene scene) {
  scene.dear = true;
  return scene;
}

inline const char* const twin_slider_crank = R"(
kind          = "slider-crank"
radius        = "90 mm"
rod           = "310 mm"
offset        = <^0+ m 0.031>
crank_mass    = "14 kg"
crank_com     = "23 mm"
crank_inertia = "0.5 kg*m2"
rod_mass      = "6 kg"
rod_com       = "120 mm"
rod_inertia   = "0.05 kg*m2"
slider_mass   = "17 kg"
gravity       = "9.81 m/s2"
stroke_angle  = "<?-70|250> deg"
phase         = <a+ 0.3>
)";

inline std::vector<TwinScene> mechanism_scenes() {
  const std::string slider = twin_slider_crank;
  return {
      mechanism_scene("press with offset", slider + R"(
load = [
  { kind = "press", nominal_force = "2.6 kN", nominal_travel = "60 mm", rise = "15 mm", breakthrough = "20 mm", drop = "5 mm", working_end = "folded" },
  { kind = "opposing", force = "70 N", work = "harmful" },
  { kind = "medium", viscous = "30 N*s/m", quadratic = "12 N*s2/m2", work = "harmful" },
]
)",
                      1),
      mechanism_scene("pump by tables over travel and angle", slider + R"(
load = [
  { kind = "table", force = { over = "travel", unit = ["mm", "N"], points = [[0, 900], [50, 400], [185, 300]], return_points = [[0, -100], [100, 50], [185, 200]] } },
  { kind = "table", force = <curve+ angle N: 0 100, 1 700, 2.5 -200, 6.283185307179586 100>, working_end = "folded" },
  { kind = "constant", force = "130 N" },
]
)",
                      1),
      mechanism_scene("compressor", slider + R"(
load = { kind = "compressor", bore = "120 mm", suction_pressure = "0.9 bar", delivery_pressure = "3.5 bar", outside_pressure = "1.1 bar", clearance = 0.07, compression_exponent = 1.22, expansion_exponent = 1.35 }
)",
                      1),
      mechanism_scene("press without edges", slider + R"(
load = { kind = "press", nominal_force = "2.6 kN", nominal_travel = "60 mm", rise = "15 mm", breakthrough = "20 mm", drop = "5 mm", rounding = "4 mm" }
)",
                      1, "load_edges = false\n"),
      mechanism_scene("slider-crank with friction in its joints", slider + R"(
load = { kind = "press", nominal_force = "0.3 kN", nominal_travel = "50 mm", rise = "15 mm" }
main_bearing = { radius = "40 mm", friction = 0.06, static_friction = 0.11, stribeck_speed = "0.1 m/s" }
crank_pin    = { radius = "60 mm", friction = 0.05, viscous_friction = "0.01 s/m" }
slider_pin   = { radius = "25 mm", friction = 0.08 }
guide        = { friction = 0.07, length = "150 mm", middle = "20 mm", width = "110 mm", slider_com = "15 mm", force_offset = <^0+ m 0.02> }
)",
                      1, "joint_friction = true\n"),
      dear(mechanism_scene("slider-crank with a worn crank pin", slider + R"(
clearance = [
  { kind = "crank pin", gap = "0.4 mm", stiffness = "12 kN/mm", exponent = 1.3, damping = "0.9 s/m", friction = 0.05, radius = "30 mm" },
]
load = { kind = "medium", viscous = "60 N*s/m" }
)",
                           1, "", "speed = <w+ 9>, angle = <a+ 0.4>", "0.05 s")),
      dear(mechanism_scene("slider-crank with a flexible rod", slider + R"(
rod_flexibility = { modulus = "200 GPa", height = "9 mm", width = "30 mm", modes = 2, damping_ratio = 0.03 }
load = { kind = "medium", viscous = "60 N*s/m" }
)",
                           1, "", "speed = <w+ 9>, angle = <a+ 0.4>, equilibrium = true", "0.1 s")),
      mechanism_scene("four-bar linkage", R"(
kind            = "four-bar"
crank           = "80 mm"
coupler         = "390 mm"
rocker          = "170 mm"
ground          = "370 mm"
branch          = "<?open|crossed>"
crank_mass      = "12 kg"
crank_com       = "-17 mm"
crank_inertia   = "0.6 kg*m2"
coupler_mass    = "7 kg"
coupler_com     = "150 mm"
coupler_inertia = "0.08 kg*m2"
rocker_mass     = "22 kg"
rocker_com      = "90 mm"
rocker_inertia  = "0.7 kg*m2"
gravity         = "9.81 m/s2"
ground_angle    = "<?25|155> deg"
phase           = <a+ 0.4>
load = [
  { kind = "opposing", torque = "25 N*m" },
  { kind = "medium", viscous = "4 N*m*s/rad", quadratic = "2 N*m*s2/rad2", work = "harmful" },
  { kind = "constant", torque = <M+ 30> },
  { kind = "table", torque = { over = "swing", unit = ["rad", "N*m"], points = [[0, 40], [0.3, 10], [1.2, -5]] }, working_end = "<?least|greatest>" },
]
)",
                      -1),
      mechanism_scene("linkage drawn as a sketch", R"(
kind         = "linkage"
unit         = "mm"
points       = <?{ O = [0, 0], A = [103, 38], D = [0, -304], E = [161, 232], R = [-18, 236] }|{ O = [0, 0], A = [103, -38], D = [0, 304], E = [161, -232], R = [-18, -236] }>
frame        = "O D"
slides       = { block = { on = "lever", through = "D A" }, ram = "0 deg" }
lengths      = { OA = "110 mm", ER = "180 mm" }
sketch_angle = "<?-70|250> deg"
gravity      = "9.81 m/s2"
phase        = <a+ 0.4>
links = { arm = { points = "O A", mass = "9 kg", com = <?[12, 7]|[12, -7]>, inertia = "1.3 kg*m2" }, block = { points = "A", mass = "2.5 kg", inertia = "0.004 kg*m2" }, lever = { points = "D E", mass = "8 kg", inertia = "0.3 kg*m2" }, rod = { points = "E R", mass = "3 kg", inertia = "0.01 kg*m2" }, ram = { points = "R", mass = "40 kg" } }
load = [
  { kind = "opposing", force = "70 N" },
  { kind = "medium", viscous = "60 N*s/m", work = "harmful" },
]
)",
                      1),
      mechanism_scene("quick-return of a shaper", R"(
kind           = "quick-return"
radius         = "110 mm"
pivot_distance = "304 mm"
lever          = "560 mm"
lever_angle    = <a+ 0.05>
link           = "180 mm"
guide_height   = "540 mm"
branch         = "<?backward|forward>"
crank_mass     = "9 kg"
crank_com      = "20 mm"
crank_inertia  = "1.4 kg*m2"
lever_mass     = "8 kg"
lever_com      = "270 mm"
lever_inertia  = "0.9 kg*m2"
block_mass     = "2.5 kg"
block_inertia  = "0.004 kg*m2"
link_mass      = "4 kg"
link_com       = "70 mm"
link_inertia   = "0.014 kg*m2"
ram_mass       = "20 kg"
gravity        = "9.81 m/s2"
stroke_angle   = "<?20|-20> deg"
phase          = "<?0.4|2.741592653589793> rad"
load = [
  { kind = "press", working_end = "<?folded|extended>", nominal_force = "0.4 kN", nominal_travel = "300 mm", rise = "20 mm", breakthrough = "30 mm", drop = "10 mm" },
  { kind = "constant", force = <^0+ N 60> },
]
)",
                      -1),
      mechanism_scene("inverted slider-crank", R"(
kind          = "inverted slider-crank"
crank         = "90 mm"
ground        = "260 mm"
crank_mass    = "8 kg"
crank_com     = "-15 mm"
crank_inertia = "0.5 kg*m2"
lever_mass    = "6 kg"
lever_com     = "140 mm"
lever_inertia = "0.3 kg*m2"
block_mass    = "2 kg"
block_inertia = "0.003 kg*m2"
gravity       = "9.81 m/s2"
ground_angle  = "<?25|155> deg"
phase         = <a+ 0.4>
load = [
  { kind = "medium", viscous = "5 N*m*s/rad" },
  { kind = "constant", torque = <M+ 20> },
]
)",
                      -1),
      mechanism_scene("drag link", R"(
kind            = "four-bar"
crank           = "180 mm"
coupler         = "170 mm"
rocker          = "200 mm"
ground          = "60 mm"
branch          = "<?open|crossed>"
crank_mass      = "9 kg"
crank_inertia   = "0.4 kg*m2"
coupler_mass    = "4 kg"
coupler_com     = "80 mm"
coupler_inertia = "0.02 kg*m2"
rocker_mass     = "12 kg"
rocker_com      = "30 mm"
rocker_inertia  = "0.5 kg*m2"
gravity         = "9.81 m/s2"
ground_angle    = "<?25|155> deg"
phase           = <a+ 0.4>
load = { kind = "medium", viscous = "6 N*m*s/rad" }
)",
                      -1),
      mechanism_scene("knuckle press", R"(
kind          = "knuckle press"
radius        = "70 mm"
rod           = "500 mm"
bearing_x     = "-350 mm"
bearing_y     = <^0+ m 0.58>
upper         = "350 mm"
lower         = "340 mm"
guide         = <^0+ m 0.57>
branch        = "<?right|left>"
crank_mass    = "20 kg"
crank_com     = "20 mm"
crank_inertia = "0.9 kg*m2"
rod_mass      = "15 kg"
rod_com       = "200 mm"
rod_inertia   = "0.3 kg*m2"
upper_mass    = "10 kg"
upper_com     = "175 mm"
upper_inertia = "0.4 kg*m2"
lower_mass    = "12 kg"
lower_com     = "160 mm"
lower_inertia = "0.15 kg*m2"
ram_mass      = "38 kg"
gravity       = "9.81 m/s2"
stroke_angle  = "<?-80|260> deg"
phase         = <a+ 0.4>
load = { kind = "press", nominal_force = "3 kN", nominal_travel = "20 mm", rise = "5 mm" }
)",
                      1),
  };
}

// What depends on its shaft's angle keeps its place, and the rest is seen through the gear.
inline std::vector<TwinScene> angle_scenes() {
  const std::string drive = R"(
[sink]
kind      = "load"
torque    = <M 7>
damping   = <c 0.4>
quadratic = <q 0.003>
inertia   = <J 0.9>
[drive]
kind    = "motor"
torque  = <curve+ speed N*m: -90 75, 0 60, 40 45, 110 -5>
inertia = <J 0.3>
[flexible]
kind          = "coupling"
stiffness     = <k 700>
damping_ratio = 0.07
inertia_in    = <J 0.02>
)";
  const auto end = [](const std::string& until) {
    return "[effects]\nelasticity = true\n[run]\nstart = { speed = <w+ 14>, angle = <a+ 0.2> }\nuntil = \"" + until +
           "\"\naccuracy = 1e-8\nsamples = 31\n";
  };
  return {
      {.name = "universal joint",
       .near = {"flange", "joint"},
       .far = {"flexible", "drive", "sink"},
       .rest = {},
       .near_text = R"(
[flange]
kind    = "flywheel"
inertia = "0.4 kg*m2"
[joint]
kind      = "universal joint"
stiffness = "1.9 kN*m/rad"
angle     = "31 deg"
phase     = <a+ 0.35>
damping_ratio = 0.03
inertia_in    = "0.02 kg*m2"
inertia_out   = "0.07 kg*m2"
)",
       .far_text = drive,
       .end = end("0.6 s")},
      {.name = "gear mesh with varying stiffness and a gap",
       .near = {"flange", "mesh"},
       .far = {"flexible", "drive", "sink"},
       .rest = {},
       .near_text = R"(
[flange]
kind    = "load"
inertia = "0.4 kg*m2"
torque  = "11 N*m"
[mesh]
kind      = "gear mesh"
teeth     = [23, 41]
module    = "4 mm"
width     = "35 mm"
helix     = "12 deg"
shift     = [0.3, -0.1]
backlash  = "0.2 mm"
stiffness = "60 kN*m/rad"
mesh_variation = [0.3, 0.1]
mesh_phase     = [<a+ 0.4>, <a+ -0.9>]
damping_ratio  = 0.06
)",
       .far_text = drive,
       .end = end("0.15 s"),
       .dear = true},
      {.name = "engine by its indicator diagram",
       .near = {"engine"},
       .far = {"flexible", "drive", "sink"},
       .rest = {},
       .near_text = R"(
[engine]
kind             = "engine"
firing_order     = [1, 3, 2]
firing_intervals = [<?"200 deg", "250 deg", "270 deg"|"250 deg", "200 deg", "270 deg">]
phase            = "<?25|-475> deg"
zero             = "firing"
bore             = "60 mm"
radius           = "40 mm"
rod              = "130 mm"
outside_pressure = "0.9 bar"
pressure         = <curve+ angle Pa: 0 21e5, 0.3 24e5, 1.2 8e5, 2.6 3e5, 3.3 1.1e5, 6.3 1.0e5, 9.5 1.2e5, 11.2 4e5, 12.566370614359172 21e5>
inertia          = "0.4 kg*m2"
)",
       .far_text = drive,
       .end = end("0.6 s")},
      {.name = "two-stroke engine by its torque",
       .near = {"engine"},
       .far = {"flexible", "drive", "sink"},
       .rest = {},
       .near_text = R"(
[engine]
kind         = "engine"
firing_order = [1, 2]
strokes      = "two"
phase        = <a+ 0.4>
zero         = "firing"
torque       = <curve+ angle N*m: 0 20, 0.4 90, 1.2 40, 3 -4, 5.2 -30, 6.283185307179586 20>
inertia      = "0.4 kg*m2"
)",
       .far_text = drive,
       .end = end("0.6 s")},
  };
}

}  // namespace kurbel::test
