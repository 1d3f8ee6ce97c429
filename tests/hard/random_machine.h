// random_machine.h — drives thrown by dice from fixed seeds, their scenes in any units, and the shrinking of one that
// fails to the smallest that still does.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/support/thorough.h"

namespace kurbel::test {

struct Joint {
  enum class Kind {
    coupling,
    gap,
    clutch,
    one_way,
    gear,
    lossy_gear,
    worm,
    belt,
    rubber,
    limiter,
    planetary,
    hooke,
    progressive
  };
  static constexpr int kinds = 13;
  Kind kind = Kind::coupling;
  double stiffness = 0, damping_ratio = 0;  // of what is elastic
  double torque = 0, excess = 1;            // of what slips: kinetic torque, static over kinetic
  int z1 = 20, z2 = 40;
  double part = 0.5;  // of the range of whatever else the kind has
};
struct Part {  // on a shaft
  enum class Kind { shunt, induction, series, dry, always, drag, fan, shaking, brake, bearing };
  static constexpr int motors = 3, kinds = 10;
  Kind kind = Kind::shunt;
  int shaft = 0;
  double torque = 0, speed = 0, part = 0.5;
};
struct Crank {  // on the last shaft
  enum class Load { none, constant, opposing, medium, press, compressor };
  static constexpr int loads = 6;
  double radius = 0.05, rod_over_radius = 4, offset = 0, slider_mass = 1, force = 0;
  bool gravity = false;
  Load load = Load::none;
};
struct Machine {
  std::vector<double> inertia;
  std::vector<Joint> joints;  // between neighbours
  std::vector<Part> parts;
  std::vector<Crank> cranks;  // none or one
  double start = 0;           // [rad/s]
  double until = 0.4;         // [s]
  bool conservative = false;
};

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double over_decades(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

 private:
  std::mt19937 random_;
};

// Torques 1 … 10⁴ N·m, speeds 5 … 300 rad/s, inertias over five decades about what such a motor runs up in a fifth of a
// second, springs of 2 … 600 Hz, damping ratios 0.1 … 30 %.
inline Machine some_machine(unsigned seed, bool conservative) {
  Dice dice(seed);
  Machine m;
  m.conservative = conservative;
  const double torque = dice.over_decades(1, 1e4), speed = dice.over_decades(5, 300);
  const double usual_inertia = torque * 0.2 / speed;
  const int shafts = dice.number(2, 6);
  for (int i = 0; i < shafts; ++i) m.inertia.push_back(usual_inertia * dice.over_decades(1e-3, 1e2));
  for (int i = 1; i < shafts; ++i) {
    using Kind = Joint::Kind;
    constexpr Kind without_losses[] = {Kind::coupling, Kind::coupling,    Kind::gear,
                                       Kind::hooke,    Kind::progressive, Kind::planetary};
    Joint j;
    j.kind = conservative ? without_losses[dice.number(0, 5)] : static_cast<Kind>(dice.number(0, Joint::kinds - 1));
    const double hertz = 2 * M_PI * dice.over_decades(2, 600);
    j.stiffness =
        hertz * hertz * std::min(m.inertia[static_cast<std::size_t>(i)], m.inertia[static_cast<std::size_t>(i - 1)]);
    j.damping_ratio = conservative ? 0 : dice.over_decades(0.001, 0.3);
    j.torque = torque * dice.over_decades(0.1, 3);
    j.excess = dice.uniform(1, 1.5);
    j.z1 = dice.number(17, 60);
    j.z2 = dice.number(17, 90);
    j.part = dice.uniform(0, 1);
    m.joints.push_back(j);
  }
  if (dice.number(0, 2) == 0) {
    Crank c;
    c.radius = dice.over_decades(0.01, 0.3);
    c.rod_over_radius = dice.over_decades(1.3, 8);
    c.offset = dice.number(0, 1) * dice.uniform(-0.4, 0.4) * (c.rod_over_radius - 1) * c.radius;
    c.slider_mass = dice.over_decades(0.01, 1) * m.inertia.back() / (c.radius * c.radius);
    c.force = torque / c.radius * dice.over_decades(0.05, 1);
    c.load = static_cast<Crank::Load>(dice.number(0, conservative ? 1 : Crank::loads - 1));
    c.gravity = dice.number(0, 1) == 1;
    m.cranks.push_back(c);
  }
  m.start = dice.uniform(0, 1) < 0.15 && !conservative ? 0 : speed * dice.uniform(0.05, 1);
  if (conservative) return m;
  m.parts.push_back({static_cast<Part::Kind>(dice.number(0, Part::motors - 1)), 0, torque, speed, 0.5});
  const int more = dice.number(1, 4);
  for (int i = 0; i < more; ++i)
    m.parts.push_back({static_cast<Part::Kind>(dice.number(Part::motors, Part::kinds - 1)), dice.number(0, shafts - 1),
                       torque * dice.over_decades(0.01, 0.5), speed, dice.uniform(0, 1)});
  return m;
}

// Units of mass and time other than kg and s; angles and lengths stay. Powers of two leave every mantissa as it is.
struct Units {
  double mass = 1, time = 1;
  double torque() const { return mass / (time * time); }
};

inline std::string quantity(double value, const char* unit) { return fmt::format("\"{:.17g} {}\"", value, unit); }

inline std::string text_of(const Joint& j, const Units& u) {
  const std::string spring = fmt::format("stiffness = {}, damping_ratio = {:.17g}",
                                         quantity(u.torque() * j.stiffness, "N*m/rad"), j.damping_ratio);
  const std::string friction = fmt::format("torque = {}, static_torque = {}", quantity(u.torque() * j.torque, "N*m"),
                                           quantity(u.torque() * j.torque * j.excess, "N*m"));
  switch (j.kind) {
    case Joint::Kind::coupling:
      return "kind = \"coupling\", " + spring;
    case Joint::Kind::gap:
      return fmt::format("kind = \"coupling\", {}, backlash = {}, contact = \"{}\"", spring,
                         quantity(0.02 + 2 * j.part, "deg"), j.z1 % 2 ? "no pulling" : "clipped");
    case Joint::Kind::clutch:
      return "kind = \"clutch\", " + friction;
    case Joint::Kind::one_way:
      return "kind = \"one-way clutch\"";
    case Joint::Kind::gear:
      return fmt::format("kind = \"gearbox\", stages = [{{ teeth = [{}, {}] }}]", j.z1, j.z2);
    case Joint::Kind::lossy_gear:
      return fmt::format("kind = \"gearbox\", stages = [{{ teeth = [{}, {}] }}], efficiency = {:.17g}", j.z1, j.z2,
                         0.8 + 0.19 * j.part);
    case Joint::Kind::worm:
      return fmt::format(
          "kind = \"worm gear\", starts = 1, teeth = {}, lead_angle = {}, friction_coefficient = {:.17g}", j.z2,
          quantity(3 + 20 * j.part, "deg"), j.excess - 0.98 > 0.25 ? 0.12 : 0.04);
    case Joint::Kind::belt:
      return fmt::format(
          "kind = \"belt\", diameter_in = \"200 mm\", diameter_out = {}, pretension = {}, friction_coefficient = 0.4, "
          "wrap_angle = \"160 deg\", {}",
          quantity(100 + 300 * j.part, "mm"), quantity(20 * u.torque() * j.torque, "N"), spring);
    case Joint::Kind::rubber:
      return fmt::format("kind = \"rubber coupling\", {}, branches = [{{ stiffness = {}, relaxation_time = {} }}]",
                         spring, quantity(u.torque() * j.stiffness * j.part, "N*m/rad"),
                         quantity(u.time * 0.02 * j.excess, "s"));
    case Joint::Kind::limiter:
      return fmt::format("kind = \"torque limiter\", torque = {}, slipping_part = {:.17g}",
                         quantity(u.torque() * j.torque, "N*m"), 0.3 + 0.7 * j.part);
    case Joint::Kind::planetary:
      return fmt::format("kind = \"planetary gear\", sun = {}, ring = {}, fixed = \"{}\", ring_inertia = {}", j.z1,
                         j.z1 + 2 * j.z2, j.part < 0.5 ? "ring" : "none",
                         quantity(u.mass * j.stiffness / std::pow(2 * M_PI * 30, 2), "kg*m2"));
    case Joint::Kind::hooke:
      return fmt::format("kind = \"universal joint\", {}, angle = {}", spring, quantity(40 * j.part, "deg"));
    case Joint::Kind::progressive: {
      const double soft = u.torque() * j.stiffness;
      return fmt::format(
          "kind = \"progressive coupling\", damping_ratio = {:.17g}, table = {{ over = \"twist\", unit = [\"rad\", "
          "\"N*m\"], points = [[0, 0], [0.02, {:.17g}], [0.06, {:.17g}]] }}",
          j.damping_ratio, 0.02 * soft, 0.02 * soft + 0.04 * soft * (1 + 3 * j.part));
    }
  }
  return {};
}

inline std::string text_of(const Part& p, const Units& u) {
  const double torque = u.torque() * p.torque, speed = p.speed / u.time;
  switch (p.kind) {
    case Part::Kind::shunt:
      return fmt::format("kind = \"dc shunt motor\", stall_torque = {}, no_load_speed = {}, inertia = \"0 kg*m2\"",
                         quantity(torque, "N*m"), quantity(speed, "rad/s"));
    case Part::Kind::induction:
      return fmt::format(
          "kind = \"induction motor\", rated_power = {}, rated_speed = {}, poles = 2, mains = {}, breakdown_ratio = "
          "2.5, "
          "inertia = \"0 kg*m2\"",
          quantity(0.4 * torque * 0.96 * speed, "W"), quantity(0.96 * speed, "rad/s"),
          quantity(speed / (2 * std::numbers::pi), "Hz"));
    case Part::Kind::series: {  // 8 A at standstill; a quarter of the torque at half the speed
      const double constant = torque / 64, resistance = 0.5 * constant * speed;
      return fmt::format(
          "kind = \"dc series motor\", voltage = {}, resistance = {}, constant = {}, max_speed = {}, inertia = \"0 "
          "kg*m2\"",
          quantity(8 * resistance, "V"), quantity(resistance, "Ohm"), quantity(constant, "N*m/A2"),
          quantity(1e3 * speed, "rad/s"));
    }
    case Part::Kind::dry:
      return fmt::format("kind = \"load\", torque = {}", quantity(torque, "N*m"));
    case Part::Kind::always:
      return fmt::format("kind = \"load\", torque = {}, acts = \"always\"", quantity(0.5 * torque, "N*m"));
    case Part::Kind::drag:
      return fmt::format("kind = \"bearing drag\", damping = {}", quantity(torque / speed, "N*m*s/rad"));
    case Part::Kind::fan:
      return fmt::format("kind = \"load\", quadratic = {}", quantity(torque / (speed * speed), "N*m*s2/rad2"));
    case Part::Kind::shaking:
      return fmt::format("kind = \"torque source\", amplitude = {}, frequency = {}", quantity(torque, "N*m"),
                         quantity((1 + 11 * p.part) / u.time, "Hz"));
    case Part::Kind::brake:
      return fmt::format("kind = \"brake\", torque = {}, static_torque = {}, start = {}", quantity(torque, "N*m"),
                         quantity((1 + 0.5 * p.part) * torque, "N*m"), quantity(0.2 * u.time, "s"));
    case Part::Kind::bearing:
      return fmt::format("kind = \"bearing\", torque = {}, static_torque = {}, stribeck_speed = {}, damping = {}",
                         quantity(0.2 * torque, "N*m"), quantity(0.2 * (1 + p.part) * torque, "N*m"),
                         quantity(0.05 * speed, "rad/s"), quantity(0.1 * torque / speed, "N*m*s/rad"));
  }
  return {};
}

inline std::string text_of(const Crank& c, const Units& u) {
  const double force = u.torque() * c.force;
  std::string load;
  switch (c.load) {
    case Crank::Load::none:
      break;
    case Crank::Load::constant:
      load = fmt::format("{{ kind = \"constant\", force = {} }}", quantity(force, "N"));
      break;
    case Crank::Load::opposing:
      load = fmt::format("{{ kind = \"opposing\", force = {} }}", quantity(force, "N"));
      break;
    case Crank::Load::medium:
      load = fmt::format("{{ kind = \"medium\", viscous = {} }}", quantity(0.1 * force * u.time / c.radius, "N*s/m"));
      break;
    case Crank::Load::press:
      load = fmt::format("{{ kind = \"press\", nominal_force = {}, nominal_travel = {} }}", quantity(force, "N"),
                         quantity(0.3 * c.radius, "m"));
      break;
    case Crank::Load::compressor:
      load = fmt::format(
          "{{ kind = \"compressor\", bore = \"100 mm\", suction_pressure = {}, delivery_pressure = {}, clearance = "
          "0.05 }}",
          quantity(force / 0.00785 / 5, "Pa"), quantity(force / 0.00785, "Pa"));
      break;
  }
  return fmt::format("kind = \"slider-crank\", radius = {}, rod = {}, offset = {}, slider_mass = {}, gravity = {}{}{}",
                     quantity(c.radius, "m"), quantity(c.radius * c.rod_over_radius, "m"), quantity(c.offset, "m"),
                     quantity(u.mass * c.slider_mass, "kg"),
                     quantity(c.gravity ? 9.8125 / (u.time * u.time) : 0, "m/s2"),
                     load.empty() ? "" : ", load = ", load);
}

// Tables in an order of their own, so that a file can be shuffled. split: this shaft is cut in two, −1: none.
inline std::vector<std::string> tables_of(const Machine& m, const Units& u = {}, int split = -1) {
  std::vector<std::string> tables;
  for (std::size_t i = 0; i < m.inertia.size(); ++i) {
    const bool cut = split == static_cast<int>(i);
    tables.push_back(fmt::format("s{} = {{ kind = \"inertia\", inertia = {} }}\n", i,
                                 quantity(u.mass * m.inertia[i] * (cut ? 0.25 : 1), "kg*m2")));
    if (cut)
      tables.push_back(fmt::format("rest = {{ kind = \"inertia\", inertia = {} }}\n",
                                   quantity(u.mass * 0.75 * m.inertia[i], "kg*m2")));
  }
  for (std::size_t i = 0; i < m.joints.size(); ++i)
    tables.push_back(fmt::format("j{} = {{ {} }}\n", i, text_of(m.joints[i], u)));
  for (std::size_t i = 0; i < m.parts.size(); ++i)
    tables.push_back(fmt::format("p{} = {{ on = \"s{}\", {} }}\n", i, m.parts[i].shaft, text_of(m.parts[i], u)));
  for (const Crank& c : m.cranks) tables.push_back(fmt::format("crank = {{ {} }}\n", text_of(c, u)));
  return tables;
}

inline std::string text_of(const Machine& m, const std::vector<std::string>& tables, const Units& u = {},
                           int split = -1) {
  std::string line = "line = [";
  for (std::size_t i = 0; i < m.inertia.size(); ++i) {
    line += fmt::format("{}\"s{}\"", i > 0 ? fmt::format(", \"j{}\", ", i - 1) : "", i);
    if (split == static_cast<int>(i)) line += ", \"rest\"";
  }
  if (!m.cranks.empty()) line += ", \"crank\"";
  std::string text = line + "]\n";
  for (const std::string& table : tables) text += table;
  return text +
         fmt::format(
             "effects = {{ elasticity = true }}\nrun = {{ until = {}, start = {{ speed = {}, on = \"s0\" }} }}\n",
             quantity(u.time * m.until, "s"), quantity(m.start / u.time, "rad/s"));
}
inline std::string text_of(const Machine& m) { return text_of(m, tables_of(m)); }

using Fault = std::function<std::string(const Machine&)>;  // what is wrong; empty: nothing

// Machines that lack one thing, the larger things first.
inline std::vector<Machine> smaller(const Machine& m) {
  std::vector<Machine> list;
  const auto but = [&](auto&& change) {
    list.push_back(m);
    change(list.back());
  };
  if (m.inertia.size() > 2) {
    but([](Machine& less) {
      less.inertia.pop_back();
      less.joints.pop_back();
      for (Part& p : less.parts) p.shaft = std::min(p.shaft, static_cast<int>(less.inertia.size()) - 1);
    });
    but([](Machine& less) {
      less.inertia.erase(less.inertia.begin());
      less.joints.erase(less.joints.begin());
      for (Part& p : less.parts) p.shaft = std::max(p.shaft - 1, 0);
    });
  }
  if (!m.cranks.empty()) but([](Machine& less) { less.cranks.clear(); });
  for (std::size_t i = 0; i < m.parts.size(); ++i)
    but([&](Machine& less) { less.parts.erase(less.parts.begin() + static_cast<std::ptrdiff_t>(i)); });
  for (std::size_t i = 0; i < m.joints.size(); ++i)
    if (m.joints[i].kind != Joint::Kind::coupling)
      but([&](Machine& less) { less.joints[i].kind = Joint::Kind::coupling; });
  if (!m.cranks.empty() && m.cranks[0].load != Crank::Load::none)
    but([](Machine& less) { less.cranks[0].load = Crank::Load::none; });
  if (!m.cranks.empty() && m.cranks[0].gravity) but([](Machine& less) { less.cranks[0].gravity = false; });
  if (m.until > 0.01) but([](Machine& less) { less.until *= 0.5; });
  return list;
}

// How many machines, over those of the thorough tests: KURBEL_MACHINES=2 takes `count`, 20 ten times as many.
inline double machines_over_tests() {
  const char* text = std::getenv("KURBEL_MACHINES");
  return text ? std::max(0.1, std::atof(text)) : thorough() ? 1 : 0.5;
}

// Prints the smallest machine found that still fails. The tests take the first quarter of `count`, in the thorough form half.
inline void expect_for_all(unsigned first, int count, bool conservative, const Fault& may_throw) {
  count = static_cast<int>(count * machines_over_tests() / 2);
  const Fault fault = [&](const Machine& m) -> std::string {
    try {
      return may_throw(m);
    } catch (const std::exception& error) {
      return std::string("thrown: ") + error.what();
    }
  };
  int failed = 0;
  for (int k = 0; k < count; ++k) {
    Machine m = some_machine(first + static_cast<unsigned>(k), conservative);
    std::string wrong = fault(m);
    if (wrong.empty()) continue;
    for (bool shrunk = true; shrunk;) {
      shrunk = false;
      for (const Machine& less : smaller(m)) {
        const std::string still = fault(less);
        if (still.empty() || still.starts_with("thrown: ") != wrong.starts_with("thrown: ")) continue;
        m = less;
        wrong = still;
        shrunk = true;
        break;
      }
    }
    ADD_FAILURE() << "seed " << first + static_cast<unsigned>(k) << ": " << wrong << "\n" << text_of(m);
    if (++failed == 3) return;
  }
}

}  // namespace kurbel::test
