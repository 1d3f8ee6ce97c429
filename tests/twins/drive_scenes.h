// drive_scenes.h — couplings, clutches, brakes, gears, bearings: each with every value away from its neutral one.
#pragma once

#include "tests/support/twins.h"

namespace kurbel::test {

// A motor that pushes and a load that resists in every way; the motor's line crosses zero speed.
inline const char* const twin_drive = R"(
[drive]
kind    = "motor"
torque  = <curve+ speed N*m: -90 75, 0 60, 40 45, 110 -5, 200 -30>
inertia = <J 0.3>
)";
inline const char* const twin_sink = R"(
[sink]
kind      = "load"
torque    = <M 7>
damping   = <c 0.11>
quadratic = <q 0.003>
inertia   = <J 0.9>
work      = "useful"
)";

inline std::vector<TwinScene> drive_scenes() {
  const std::string drive = twin_drive, sink = twin_sink;
  const std::string shaking = R"(
[shaking]
kind = "torque source"
on   = "drive"
torque    = <M+ -6>
amplitude = <M+ 55>
frequency = "6.3 Hz"
phase     = "0.4 rad"
)";
  return {
      {.name = "couplings by all forms of damping",
       .near = {"drive", "first"},
       .far = {"second", "wheel", "third", "rotor", "fourth"},
       .rest = {"sink"},
       .near_text = drive + sink + R"(
[first]
kind          = "coupling"
stiffness     = <k 900>
damping_ratio = 0.07
inertia_in    = <J 0.02>
inertia_out   = <J 0.05>
nominal_torque = <M 80>
maximum_torque = <M 240>
vibratory_torque = <M 30>
dissipated_power = "40 W"
application_factor = 1.3
)",
       .far_text = R"(
[second]
kind             = "coupling"
stiffness        = <k 2500>
relative_damping = 0.6
inertia_in       = <J 0.11>
inertia_out      = <J 0.07>
nominal_torque = <M 70>
vibratory_torque = <M 20>
[wheel]
kind    = "flywheel"
inertia = <J 0.4>
[third]
kind        = "shaft"
stiffness   = <k 4100>
inertia     = <J 0.3>
segments    = 3
loss_factor = 0.03
[rotor]
kind    = "inertia"
inertia = <J 0.2>
[fourth]
kind              = "coupling"
stiffness         = <k 1500>
damping_ratio     = 0.05
damping_frequency = "9 Hz"
inertia_out       = <J 0.03>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 20>, angle = <a+ 0.3>, second = { twist = <F:a+ 0.01> }, first = { twist = <a+ -0.02> } }
until = "0.5 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "rubber and progressive couplings",
       .near = {"drive"},
       .far = {"rubber", "wheel", "progressive"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[rubber]
kind      = "rubber coupling"
stiffness = <k 800>
branches  = [{ stiffness = <k 500>, relaxation_time = "20 ms" }, { stiffness = <k 300>, relaxation_time = "3 ms" }]
damping   = <c 0.6>
inertia_in  = <J 0.04>
inertia_out = <J 0.06>
[wheel]
kind    = "flywheel"
inertia = <J 0.2>
[progressive]
kind  = "progressive coupling"
table = <curve+ twist N*m: -0.1 -160, -0.02 -20, 0 0, 0.03 18, 0.12 170>
damping_ratio = 0.08
inertia_in    = <J 0.03>
inertia_out   = <J 0.02>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 15>, equilibrium = true }
until = "0.5 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "gaps between flanks",
       .near = {"drive"},
       .far = {"jaws", "wheel", "mesh"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[jaws]
kind              = "coupling"
stiffness         = <^-3.2 N*m/rad 60000>
backlash          = <a 0.02>
contact           = "Hunt-Crossley"
contact_exponent  = 2.2
contact_damping   = <^-1 s/rad 0.4>
inertia_in        = <J 0.05>
inertia_out       = <J 0.04>
[wheel]
kind    = "flywheel"
inertia = <J 0.1>
[mesh]
kind      = "gear mesh"
teeth     = [23, 41]
stiffness = <k 5200>
damping   = <c 1.5>
inertia   = [<J 0.01>, <J 0.05>]
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 12>, jaws = { twist = <F:a+ 0.01> } }
until = "0.3 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "clutch with static friction, engaged and released",
       .near = {"drive"},
       .far = {"clutch", "hub"},
       .rest = {"sink"},
       .near_text = drive + sink,
       .far_text = R"(
[clutch]
kind          = "clutch"
torque        = <M 90>
static_torque = <M 130>
slope         = <c -0.4>
inertia_in    = <J 0.03>
inertia_out   = <J 0.08>
[hub]
kind    = "inertia"
inertia = <J 0.05>
)",
       .end = R"(
[effects]
elasticity = true
[sequence]
steps = [
  { at = "0 s", set = "clutch", to = 0 },
  { at = "0.05 s", set = "clutch", to = 1, over = "0.2 s" },
  { <?speed_above|speed_below> = <w+ 39>, of = "sink", set = "clutch", to = 0.1 },
]
[run]
start = { speed = <w+ 30>, sink = { speed = <w+ 4> } }
until = "1.5 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "clutch by plates behind a gear, overloaded while locked",
       .near = {"drive"},
       .far = {"clutch"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[clutch]
kind          = "clutch"
force         = <^-1 N 900>
plates        = 3
friction_coefficient = 0.12
static_friction_coefficient = 0.17
outer_radius  = "0.12 m"
inner_radius  = "0.07 m"
inertia_out   = <J 0.1>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 30> }
until = "0.6 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "torque limiter",
       .near = {"drive"},
       .far = {"limiter", "hub"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[limiter]
kind          = "torque limiter"
torque        = <M 38>
slipping_part = 0.6
inertia_in    = <J 0.03>
inertia_out   = <J 0.08>
[hub]
kind    = "load"
torque  = <M+ 6>
acts    = "always"
inertia = <J 0.05>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 25> }
until = "0.6 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "freewheel that is overrun and pushed within its drag",
       .near = {"drive"},
       .far = {"freewheel"},
       .rest = {"sink"},
       .near_text = sink + R"(
[drive]
kind    = "torque source"
table   = <curve+ time N*m: 0 60, 0.15 60, 0.2 -8, 0.5 -8, 0.6 -60, 0.8 70, 1.1 70>
inertia = <J 0.3>
)",
       .far_text = R"(
[freewheel]
kind        = "one-way clutch"
drag        = <M 3>
inertia_in  = <J 0.03>
inertia_out = <J 0.08>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 5> }
until = "1.1 s"
accuracy = 1e-8
samples = 31
)",
       .reversible = false},
      {.name = "brakes with windows, that stop and hold",
       .near = {"drive"},
       .far = {"brake", "bearing", "slow"},
       .rest = {"sink"},
       .near_text = sink + R"(
[drive]
kind    = "torque source"
table   = <curve+ time N*m: 0 40, 0.3 40, 0.5 -90, 0.9 -90, 1 70, 1.4 160>
inertia = <J 0.3>
)",
       .far_text = R"(
[brake]
kind          = "brake"
torque        = <M 20>
static_torque = <M 33>
slope         = <c 0.2>
inertia       = <J 0.02>
start         = "0.1 s"
[bearing]
kind              = "bearing"
torque            = <M 9>
static_torque     = <M 16>
stribeck_speed    = <w 1.7>
stribeck_exponent = 1.3
damping           = <c 0.05>
inertia           = <J 0.01>
[slow]
kind         = "brake"
force        = <^-1 N 50>
plates       = 1
friction_coefficient = 0.2
static_friction_coefficient = 0.3
outer_radius = "0.2 m"
inner_radius = "0.1 m"
stop         = "0.7 s"
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 3> }
until = "1.4 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "bearings with smooth laws",
       .near = {"drive"},
       .far = {"creeping", "drag", "link", "bristles"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[creeping]
kind           = "bearing"
torque         = <M 5>
static_torque  = <M 8>
stribeck_speed = <w 2>
stribeck_exponent = 2.7
damping        = <c 0.02>
model          = "regularised"
creep_speed    = <w 0.5>
inertia        = <J 0.05>
[drag]
kind    = "bearing drag"
damping = <c 0.3>
inertia = <J 0.02>
[link]
kind      = "coupling"
stiffness = <k 600>
damping   = <c 0.9>
[bristles]
kind              = "bearing"
torque            = <M 6>
static_torque     = <M 9>
stribeck_speed    = <w 1.2>
stribeck_exponent = 1.6
damping           = <c 0.03>
model             = "LuGre"
bristle_stiffness = <k 3000>
bristle_damping   = <c 3>
inertia           = <J 0.2>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ -2> }
until = "0.4 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "belt that slips and grips",
       .near = {"drive"},
       .far = {"belt"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[belt]
kind                 = "belt"
diameter_in          = "160 mm"
diameter_out         = "280 mm"
pretension           = <^-1 N 260>
friction_coefficient = 0.3
centre_distance      = "0.7 m"
groove_angle         = "60 deg"
axial_stiffness      = <^-2 N 90000>
damping_ratio        = 0.06
inertia_in           = <J 0.02>
inertia_out          = <J 0.09>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 20> }
until = "0.5 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "fluid coupling and viscous damper",
       .near = {"drive"},
       .far = {"fluid", "damper"},
       .rest = {"sink"},
       .near_text = drive + sink,
       .far_text = R"(
[fluid]
kind     = "fluid coupling"
diameter = "0.42 m"
density  = <^-3 kg/m3 850>
lambda   = <curve ratio 1: 0 0.0022, 0.6 0.0018, 0.9 0.0009, 1 0>
inertia_in  = <J 0.1>
inertia_out = <J 0.2>
[damper]
kind         = "viscous damper"
ring_inertia = <J 0.3>
damping      = <c 2.2>
inertia      = <J 0.05>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 60>, sink = { speed = <w+ 8> } }
until = "0.8 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "gearbox with losses and elastic flanks",
       .near = {"drive"},
       .far = {"gearbox", "hub"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[gearbox]
kind   = "gearbox"
stages = [
  { teeth = [19, 57], inertia = [<J 0.02>, <J 0.2>], efficiency_forwards = 0.97, efficiency_backwards = 0.93, bearing_torque = <M 1.1>, bearing_torque_backwards = <M 0.7> },
  { teeth = [23, 31], inertia = [<J 0.03>, <J 0.4>], mesh_stiffness = <k 24000>, mesh_damping_ratio = 0.08, mesh_backlash = <a 0.004> },
]
[hub]
kind    = "inertia"
inertia = <J 3>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 22> }
until = "0.3 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "gearbox on an elastic support",
       .near = {"drive"},
       .far = {"gearbox", "hub"},
       .rest = {"sink"},
       .near_text = drive + sink + shaking,
       .far_text = R"(
[gearbox]
kind   = "gearbox"
stages = [{ teeth = [19, 57], inertia = [<J 0.02>, <J 0.2>] }, { teeth = [23, 31], inertia = [<J 0.03>, <J 0.4>] }]
support_stiffness = <k 9000>
support_damping   = <c 12>
housing_inertia   = <J 0.5>
reversing         = true
[hub]
kind    = "inertia"
inertia = <J 3>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 22> }
until = "0.3 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "planetary gear with three free shafts",
       .near = {"drive"},
       .far = {"gear", "hub"},
       .rest = {},
       .far_besides = {"brake"},
       .near_text = drive,
       .far_text = R"(
[gear]
kind            = "planetary gear"
sun             = 24
ring            = 72
planet          = 20
second_planet   = 28
in              = "carrier"
out             = "sun"
planets         = 4
sun_inertia     = <J 0.03>
ring_inertia    = <J 0.6>
carrier_inertia = <J 0.25>
planet_inertia  = <J 0.015>
efficiency      = 0.95
[hub]
kind      = "load"
torque    = <M 5>
quadratic = <q 0.02>
inertia   = <J 0.7>
[brake]
kind          = "brake"
torque        = <M 25>
static_torque = <M 31>
inertia       = <J 0.05>
)",
       .end = R"(
[[branch]]
from = "gear.ring"
line = ["brake"]
[effects]
elasticity = true
[run]
start = { speed = <w+ 11> }
until = "0.6 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "differential on unequal loads",
       .near = {"drive"},
       .far = {"axle", "left"},
       .rest = {},
       .far_besides = {"right"},
       .near_text = drive,
       .far_text = R"(
[axle]
kind           = "differential"
ratio          = 3.7
efficiency     = 0.9
inertia_in     = <J 0.02>
cage_inertia   = <J 0.3>
output_inertia = <J 0.1>
[left]
kind    = "load"
torque  = <M 40>
damping = <c 2>
inertia = <J 4>
[right]
kind    = "load"
damping = <c 3>
inertia = <J 7>
)",
       .end = R"(
[[branch]]
from = "axle.second"
line = ["right"]
[effects]
elasticity = true
[run]
start = { speed = <w+ 11> }
until = "0.6 s"
accuracy = 1e-8
samples = 31
)"},
      {.name = "screw, wedge and slide driven from either side",
       .near = {"drive"},
       .far = {"spindle", "lift", "car", "hub"},
       .rest = {},
       .near_text = drive + shaking,
       .far_text = R"(
[spindle]
kind                 = "screw"
lead                 = <^-1 m 0.11>
mean_diameter        = <^-1 m 0.09>
thread_angle         = "28 deg"
friction_coefficient = 0.05
collar_diameter      = <^-1 m 0.07>
collar_friction      = 0.03
bearing_torque       = <M 0.4>
inertia              = <J 0.2>
mass                 = "35 kg"
inclination          = <^0+ rad 0.4>
gravity              = "9.7 m/s2"
guide_friction       = 0.04
force                = "55 N"
damping              = "21 N*s/m"
quadratic            = "3 N*s2/m2"
work                 = "harmful"
[lift]
kind                 = "wedge"
wedge_angle          = "25 deg"
radius               = <^-1 m 0.08>
friction_coefficient = 0.04
base_friction        = 0.03
side_friction        = 0.06
inertia              = <J 0.15>
wedge_mass           = "6 kg"
mass                 = "40 kg"
inclination          = <^0+ rad 1.1>
force                = <^0+ N 70>
acts                 = "always"
damping              = "11 N*s/m"
[car]
kind           = "slide"
radius         = <^-1 m 0.12>
inertia        = <J 0.1>
mass           = "25 kg"
inclination    = <^0+ rad -0.3>
guide_friction = 0.05
start_travel   = <^0+ m 0.2>
[hub]
kind    = "load"
damping = <c 5>
inertia = <J 8>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 14> }
until = "0.4 s"
accuracy = 1e-8
samples = 31
)",
       .travels = {"spindle", "lift", "car"}},
      {.name = "worm gear driven from either side",
       .near = {"drive"},
       .far = {"worm", "hub"},
       .rest = {},
       .near_text = drive + shaking,
       .far_text = R"(
[worm]
kind                 = "worm gear"
starts               = 4
teeth                = 38
lead_angle           = "17 deg"
friction_coefficient = 0.05
pressure_angle       = "22 deg"
bearing_torque       = <M 0.8>
inertia_in           = <J 0.03>
inertia_out          = <J 0.3>
[hub]
kind    = "load"
damping = <c 5>
torque  = <M+ 30>
acts    = "always"
inertia = <J 30>
)",
       .end = R"(
[effects]
elasticity = true
[run]
start = { speed = <w+ 14> }
until = "0.4 s"
accuracy = 1e-8
samples = 31
)"},
  };
}

}  // namespace kurbel::test
