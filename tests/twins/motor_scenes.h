// motor_scenes.h — every kind of drive behind a gear, with every value away from its neutral one. What a catalogue's
// motor cannot do backwards is left to run forwards.
#pragma once

#include "tests/support/twins.h"

namespace kurbel::test {

// The load first: it stays as it is, and the motor is seen through the gear.
inline TwinScene motor_scene(const std::string& name, const std::string& motor, bool reversible,
                             const std::string& start = "speed = <w+ 4>", const std::string& until = "0.6 s") {
  TwinScene scene{.name = name,
                  .near = {"sink"},
                  .far = {"link", "motor"},
                  .rest = {},
                  .near_text = R"(
[sink]
kind      = "load"
torque    = <M 7>
damping   = <c 0.11>
quadratic = <q 0.003>
inertia   = <J 0.9>
)",
                  .far_text = R"(
[link]
kind          = "coupling"
stiffness     = <k 700>
damping_ratio = 0.05
inertia_in    = <J 0.02>
inertia_out   = <J 0.03>
[motor]
)" + motor,
                  .end = "[effects]\nelasticity = true\n[run]\nstart = { " + start + " }\nuntil = \"" + until +
                         "\"\naccuracy = 1e-8\nsamples = 31\n"};
  scene.reversible = reversible;
  return scene;
}

inline const char* const reversed_by_sequence =
    "<F:?|[sequence]\nsteps = [{ at = \"0 s\", set = \"motor\", to = -1 }]\n>";

inline std::vector<TwinScene> motor_scenes() {
  const auto reversed = [](TwinScene scene) {
    scene.end = reversed_by_sequence + scene.end;
    return scene;
  };
  std::vector<TwinScene> scenes = {
      reversed(motor_scene("induction motor after Kloss", R"(
kind              = "induction motor"
rated_power       = "2.3 kW"
rated_speed       = <w 47>
synchronous_speed = <w 50>
breakdown_ratio   = 2.6
resistance_ratio  = 0.7
voltage_factor    = 0.9
inertia           = <J 0.2>
start             = "0.02 s"
stop              = "0.5 s"
)",
                           true)),
      motor_scene("induction motor through its points, star and delta by speed", R"(
kind              = "induction motor"
rated_power       = "2.3 kW"
rated_speed       = <w 47>
synchronous_speed = <w 50>
breakdown_ratio   = 2.6
breakdown_speed   = <w 41>
starting_ratio    = 2.1
pull_up_ratio     = 1.7
pull_up_speed     = <w 9>
starting          = "star-delta"
switch_speed      = <w 21>
pause             = "30 ms"
inertia           = <J 0.2>
)",
                  false),
      motor_scene("induction motor, star and delta by time", R"(
kind              = "induction motor"
rated_power       = "2.3 kW"
rated_speed       = <w 47>
synchronous_speed = <w 50>
breakdown_ratio   = 2.6
starting          = "star-delta"
switch_time       = "0.2013 s"
pause             = "30 ms"
inertia           = <J 0.2>
)",
                  false),
      motor_scene("induction motor with a soft start", R"(
kind              = "induction motor"
rated_power       = "2.3 kW"
rated_speed       = <w 47>
synchronous_speed = <w 50>
breakdown_ratio   = 2.6
starting          = "soft start"
ramp              = "0.3 s"
initial_voltage   = 0.4
torque_limit      = <M 60>
inertia           = <J 0.2>
)",
                  false),
      motor_scene("induction motor on a frequency converter with field weakening", R"(
kind              = "induction motor"
rated_power       = "2.3 kW"
rated_speed       = <w 47>
synchronous_speed = <w 50>
breakdown_ratio   = 2.6
starting          = "frequency converter"
ramp              = "0.4 s"
target_speed      = <w 66>
torque_limit      = <M 90>
inertia           = <J 0.2>
)",
                  false),
      reversed(motor_scene("dc shunt motor by torque and speed", R"(
kind          = "dc shunt motor"
stall_torque  = <M 140>
no_load_speed = <w 60>
rated_torque  = <M 35>
inertia       = <J 0.2>
)",
                           true)),
      reversed(motor_scene("dc shunt motor with its current", R"(
kind            = "dc shunt motor"
voltage         = "110 V"
resistance      = "0.8 Ohm"
constant        = <^-1 N*m/A 1.7>
inductance      = "12 mH"
initial_current = "3 A"
inertia         = <J 0.2>
)",
                           false)),
      motor_scene("dc series motor", R"(
kind        = "dc series motor"
voltage     = "220 V"
resistance  = "1.4 Ohm"
constant    = <^-1 N*m/A2 0.03>
rated_speed = <w 45>
max_speed   = <w 400>
inertia     = <J 0.2>
)",
                  false),
      motor_scene("dc series motor with its current", R"(
kind        = "dc series motor"
voltage     = "220 V"
resistance  = "1.4 Ohm"
constant    = <^-1 N*m/A2 0.03>
rated_speed = <w 45>
inductance  = "20 mH"
initial_current = "9 A"
inertia     = <J 0.2>
)",
                  false),
      motor_scene("hydraulic motor", R"(
kind                = "hydraulic motor"
displacement        = <^-1 m3/rad 1.1e-5>
pressure_difference = "80 bar"
flow                = "30 l/min"
volumetric_efficiency      = 0.92
hydromechanical_efficiency = 0.87
relief_rise         = "12 bar"
inertia             = <J 0.2>
)",
                  false),
      motor_scene("pneumatic motor", R"(
kind         = "pneumatic motor"
max_power    = "1.6 kW"
free_speed   = <w 80>
stall_torque = <M 88>
inertia      = <J 0.2>
)",
                  false),
      motor_scene("governor with both limits", R"(
kind              = "governor"
speed             = <w+ 30>
proportional_gain = <c 6>
integral_gain     = <k 40>
droop             = <^2 rad/s/N/m 0.02>
<?max|min>_torque = <M+ 75>
<?min|max>_torque = <M+ -20>
tracking_time     = "0.15 s"
initial_torque    = <M+ 12>
inertia           = <J 0.2>
)",
                  true, "speed = <w+ 11>"),
      motor_scene("torque source of all kinds", R"(
kind      = "torque source"
torque    = <M+ 50>
ramp      = "0.15 s"
amplitude = <M+ 12>
frequency = "4 Hz"
phase     = "0.7 rad"
table     = <curve+ angle N*m: -0.5 10, 0.4 -14, 1.2 33, 2 10; period 2.5132741228718345>
inertia   = <J 0.2>
start     = "0.05 s"
)",
                  true),
      motor_scene("motor and load by smooth tables", R"(
kind    = "motor"
torque  = <curve+ speed N*m: -200 160, -10 120, 20 90, 60 -5, 200 -90; interpolation = "smooth">
inertia = <J 0.2>
[weight]
kind   = "load"
on     = "motor"
torque = <M+ 9>
acts   = "always"
table  = <curve+ speed N*m: -200 -50, 0 -2, 15 6, 200 45>
[profile]
kind   = "load"
on     = "motor"
table  = <curve+ time N*m: 0 3, 0.2 20, 0.25 -4, 1 8>
work   = "harmful"
)",
                  true),
      motor_scene("speed that is prescribed", R"(
kind      = "prescribed speed"
speed     = <w+ 21>
ramp      = "0.3 s"
amplitude = <w+ 3>
frequency = "5 Hz"
phase     = "0.5 rad"
inertia   = <J 0.2>
)",
                  true, "speed = <w+ 0>"),
      motor_scene("speed that is prescribed by a table, through zero", R"(
kind      = "prescribed speed"
table     = <curve+ time rad/s: 0 4, 0.2 14, 0.35 -6, 0.7 -9>
inertia   = <J 0.2>
)",
                  true),
  };
  for (TwinScene& scene : scenes) {
    if (scene.name.find("smooth tables") != std::string::npos) scene.far_besides = {"weight", "profile"};
    if (scene.name == "torque source of all kinds") scene.gears = 2;
  }
  return scenes;
}

}  // namespace kurbel::test
