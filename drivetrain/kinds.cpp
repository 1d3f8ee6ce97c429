// kinds.cpp — from a component's keys to its shafts and elements.
#include "drivetrain/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivetrain/coupling.h"
#include "drivetrain/loads.h"
#include "drivetrain/motors.h"
#include "drivetrain/torque_source.h"
#include "engine/network.h"
#include "engine/units.h"

namespace kurbel {
namespace {

// --- keys that several kinds share ---

std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

const std::vector<Key>& window_keys() {
  static const std::vector<Key> keys = {
      {.name = "start", .unit = "s", .doc = "acts from this time on; default: always"},
      {.name = "stop", .unit = "s", .doc = "acts until this time; default: always"},
  };
  return keys;
}

const std::vector<Key>& damping_keys() {
  static const std::vector<Key> keys = {
      {.name = "damping",
       .unit = "N*m*s/rad",
       .domain = not_negative,
       .doc = "viscous damping c; one of the four forms"},
      {.name = "damping_ratio", .domain = not_negative, .doc = "ζ: c = 2 ζ k/ω_ref"},
      {.name = "relative_damping",
       .domain = not_negative,
       .doc = "ψ: energy lost in a cycle over greatest energy stored; c = ψ k/(2π ω_ref)"},
      {.name = "loss_factor", .domain = not_negative, .doc = "η: c = η k/ω_ref"},
      {.name = "damping_frequency",
       .unit = "Hz",
       .domain = positive,
       .doc = "ω_ref/2π of the three forms above; default: natural frequency of the two inertias joined"},
  };
  return keys;
}

Key inertia_key(const char* fallback, const char* doc) {
  return {.name = "inertia",
          .unit = "kg*m2",
          .fallback = fallback,
          .domain = not_negative,
          .doc = doc,
          .required = *fallback == 0};
}

// --- readings that several kinds share ---

Window window_of(const Section& s, Messages& messages) {
  Window window;
  window.start = s.number_or("start", window.start);
  window.stop = s.number_or("stop", window.stop);
  if (s.given("start") && s.given("stop") && window.stop <= window.start)
    messages.add(s.where("stop"), fmt::format("{} \"{}\": stop = {:g} s; must be later than start = {:g} s",
                                              s.kind->name, s.name, window.stop, window.start));
  return window;
}

Damping damping_of(const Section& s, Messages& messages) {
  static const std::pair<const char*, Damping::As> forms[] = {{"damping", Damping::As::viscous},
                                                              {"damping_ratio", Damping::As::ratio},
                                                              {"relative_damping", Damping::As::relative},
                                                              {"loss_factor", Damping::As::loss_factor}};
  Damping damping;
  const char* first = nullptr;
  for (const auto& [key, as] : forms) {
    if (!s.given(key)) continue;
    if (first)
      messages.add(s.where(key),
                   fmt::format("{} \"{}\": \"{}\" and \"{}\" both given; keep one", s.kind->name, s.name, first, key));
    first = key;
    damping.as = as;
    damping.value = s.number(key);
  }
  if (s.given("damping_frequency") && (!first || damping.as == Damping::As::viscous))
    messages.add(s.where("damping_frequency"),
                 fmt::format("{} \"{}\": \"damping_frequency\" belongs to \"damping_ratio\", \"relative_damping\" or "
                             "\"loss_factor\"; none is given",
                             s.kind->name, s.name));
  damping.frequency = 2 * std::numbers::pi * s.number_or("damping_frequency", 0);
  return damping;
}

Account account_of(const Section& s, Account fallback) {
  if (!s.has("work")) return fallback;
  const std::string& name = s.text("work");
  return name == "driving" ? Account::driving : name == "harmful" ? Account::harmful : Account::useful;
}

Curve curve_of(const CurveData& data) { return Curve(data.x, data.y, data.form, data.period); }

// A torque over time, angle or speed as the element that suits it.
void put_curve(Network& net, int node, const Section& s, const CurveData& data, double sign, Account account,
               Window window, Messages& messages) {
  const Curve curve = curve_of(data);
  const Location where = s.where(s.has("table") ? "table" : "torque");
  if (data.over == "time") {
    net.put(node, s.name, TorqueOverTime{account, curve, sign}, window);
  } else if (data.over == "speed") {
    if (data.period > 0)
      messages.add(where, fmt::format("{} \"{}\": a table over speed has no period", s.kind->name, s.name));
    net.put(node, s.name, TorqueOverSpeed{account, curve, sign}, window);
  } else {
    CurveData closed = data;
    if (closed.period == 0) closed.period = 2 * std::numbers::pi;
    const double span = data.x.back() - data.x.front();
    if (span > closed.period * (1 + 1e-9)) {
      messages.add(where, fmt::format("{} \"{}\": a table over the angle spans {:.6g} deg, more than its period of "
                                      "{:.6g} deg; give period = \"720 deg\" for two turns",
                                      s.kind->name, s.name, span * 180 / std::numbers::pi,
                                      closed.period * 180 / std::numbers::pi));
      return;
    }
    try {
      net.put(node, s.name, TorqueOverAngle{account, curve_of(closed), sign}, window);
    } catch (const std::invalid_argument& error) {
      messages.add(where, fmt::format("{} \"{}\": {}", s.kind->name, s.name, error.what()));
    }
  }
}

// One shaft that passes through.
int single_shaft(const Section& s, Network& net) {
  const int node = net.add_node(s.name, "", s.number_or("inertia", 0));
  net.ports[s.name] = {node, node};
  return node;
}

// --- inertia ---

void build_inertia(const Section& s, Network& net, Messages&) { single_shaft(s, net); }

// --- coupling and shaft ---

void build_coupling(const Section& s, Network& net, Messages& messages) {
  const int in = net.add_node(s.name, "in", s.number("inertia_in"));
  const int out = net.add_node(s.name, "out", s.number("inertia_out"));
  net.ports[s.name] = {in, out};
  net.connect(in, out, 1, s.name, CouplingData{s.number("stiffness"), damping_of(s, messages)});
}

// k = G J_p/L, J = ρ J_p L, J_p = π (D⁴ − d⁴)/32; cut into n equal springs with the inertia between and at the ends.
void build_shaft(const Section& s, Network& net, Messages& messages) {
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("shaft \"{}\": {}", s.name, text));
  };
  double stiffness = s.number_or("stiffness", 0), inertia = s.number_or("inertia", 0);
  if (s.given("stiffness") == s.given("length"))
    return refuse("stiffness", s.given("length") ? "\"stiffness\" and \"length\" both given; keep one"
                                                 : "\"stiffness\" is missing; give it, or \"length\" and \"diameter\"");
  if (s.given("stiffness"))
    for (const char* key : {"diameter", "bore"})
      if (s.given(key))
        return refuse(key, fmt::format("\"{}\" belongs to \"length\", which is not given; drop it", key));
  if (s.given("length")) {
    if (!s.given("diameter")) return refuse("length", "\"diameter\" is missing beside \"length\"");
    const double length = s.number("length"), outer = s.number("diameter"), bore = s.number("bore");
    if (bore >= outer)
      return refuse("bore", fmt::format("bore = {:g} mm; must be < diameter = {:g} mm", bore * 1e3, outer * 1e3));
    const double polar = std::numbers::pi / 32 * (std::pow(outer, 4) - std::pow(bore, 4));
    stiffness = s.number("shear_modulus") * polar / length;
    if (!s.given("inertia")) inertia = s.number("density") * polar * length;
  }
  const int segments = static_cast<int>(s.number("segments"));
  const Damping damping = damping_of(s, messages);
  // Springs and dampers in series: n of them, each n times as stiff and as damped.
  int before = net.add_node(s.name, "in", inertia / (2 * segments));
  net.ports[s.name].in = before;
  for (int i = 1; i <= segments; ++i) {
    const bool last = i == segments;
    const int node = net.add_node(s.name, last ? "out" : fmt::format("{}", i), inertia / segments * (last ? 0.5 : 1));
    Damping part = damping;
    if (part.as == Damping::As::viscous) part.value *= segments;
    net.connect(before, node, 1, s.name, CouplingData{stiffness * segments, part});
    before = node;
  }
  net.ports[s.name].out = before;
}

// --- gearbox ---

const std::vector<Kind>& stage_kinds() {
  static const std::vector<Kind> kinds = {{
      .name = "stage",
      .doc = "one pair of wheels",
      .placement = Placement::nested,
      .keys = {{.name = "teeth",
                .type = KeyType::integers,
                .domain = {.low = 1, .high = 100000},
                .doc = "teeth of the driving and of the driven wheel",
                .required = true},
               {.name = "inertia",
                .type = KeyType::quantities,
                .unit = "kg*m2",
                .domain = not_negative,
                .doc = "inertia of the driving and of the driven wheel, each on its own shaft"}},
  }};
  return kinds;
}

// Ideal stages; i = z₂/z₁. Each shaft counts its angle positive in its own direction of drive.
void build_gearbox(const Section& s, Network& net, Messages& messages) {
  const std::vector<Section>& stages = s["stages"].sections;
  if (stages.empty())
    messages.add(s.where("stages"),
                 fmt::format("gearbox \"{}\": stages = []; give one or more {{ teeth = [z1, z2] }}", s.name));
  int before = -1;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Section& stage = stages[k];
    if (!stage.sound) return;
    const std::vector<double>& teeth = stage["teeth"].numbers;
    const std::vector<double> inertia = stage.has("inertia") ? stage["inertia"].numbers : std::vector<double>{0, 0};
    if (teeth.size() != 2 || inertia.size() != 2) {
      const std::size_t count = teeth.size() != 2 ? teeth.size() : inertia.size();
      messages.add(stage.where(teeth.size() != 2 ? "teeth" : "inertia"),
                   fmt::format("gearbox \"{}\": stages[{}]: {} has {} value{}; must be two, driving wheel first",
                               s.name, k + 1, teeth.size() != 2 ? "teeth" : "inertia", count, count == 1 ? "" : "s"));
      return;
    }
    if (before < 0) {
      before = net.add_node(s.name, "in", inertia[0]);
      net.ports[s.name].in = before;
    } else {
      net.nodes[static_cast<std::size_t>(before)].inertia += inertia[0];
    }
    const bool last = k + 1 == stages.size();
    const int driven = net.add_node(s.name, last ? "out" : fmt::format("shaft{}", k + 1), inertia[1]);
    net.join(before, driven, teeth[1] / teeth[0], s.name);
    before = driven;
  }
  net.ports[s.name].out = before;
}

// --- resistances on a shaft ---

void build_drag(const Section& s, Network& net, Messages&) {
  net.put(single_shaft(s, net), s.name, SpeedLoad{Account::harmful, s.number("damping"), 0});
}

void build_load(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const Window window = window_of(s, messages);
  const Account account = account_of(s, Account::useful);
  const double torque = s.number_or("torque", 0), viscous = s.number("damping"), quadratic = s.number("quadratic");
  if (!s.given("torque") && !s.given("damping") && !s.given("quadratic") && !s.has("table"))
    messages.add(
        s.at,
        fmt::format("load \"{}\": nothing given; allowed: \"torque\", \"damping\", \"quadratic\", \"table\"", s.name));
  if (s.text("acts") == "always") {
    if (torque != 0) net.put(node, s.name, HarmonicTorque{account, -torque, 0, 0, 0}, window);
    if (viscous > 0 || quadratic > 0) net.put(node, s.name, SpeedLoad{account, viscous, quadratic}, window);
  } else if (torque > 0) {
    net.put(node, s.name, OpposingLoad{account, torque, viscous, quadratic, 0}, window);
  } else if (torque < 0) {
    messages.add(s.where("torque"), fmt::format("load \"{}\": torque = {:g} N·m; a load against the motion must be ≥ 0 "
                                                "(with acts = \"always\" it may be negative)",
                                                s.name, torque));
  } else if (viscous > 0 || quadratic > 0) {
    net.put(node, s.name, SpeedLoad{account, viscous, quadratic}, window);
  }
  if (s.has("table")) put_curve(net, node, s, s["table"].curve, -1, account, window, messages);
}

// --- sources ---

void build_torque_source(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  Window window = window_of(s, messages);
  const double torque = s.number("torque"), amplitude = s.number("amplitude"), frequency = s.number("frequency");
  if (!s.given("torque") && !s.given("amplitude") && !s.has("table"))
    messages.add(
        s.at,
        fmt::format(
            "torque source \"{}\": nothing given; allowed: \"torque\", \"amplitude\" with \"frequency\", \"table\"",
            s.name));
  if (amplitude != 0 && frequency == 0)
    messages.add(s.where("amplitude"),
                 fmt::format("torque source \"{}\": \"amplitude\" needs a \"frequency\" > 0, e.g. \"5 Hz\"", s.name));
  if (s.given("ramp") && !s.given("torque"))
    messages.add(s.where("ramp"),
                 fmt::format("torque source \"{}\": \"ramp\" needs \"torque\", the value it rises to", s.name));
  if (s.given("ramp")) {
    const double begin = s.given("start") ? window.start : 0;
    net.put(
        node, s.name,
        TorqueOverTime{Account::driving, Curve({begin, begin + s.number("ramp")}, {0, torque}, Curve::Form::linear), 1},
        window);
    if (amplitude != 0)
      net.put(node, s.name, HarmonicTorque{Account::driving, 0, amplitude, frequency, s.number("phase")}, window);
  } else if (torque != 0 || amplitude != 0) {
    net.put(node, s.name, HarmonicTorque{Account::driving, torque, amplitude, frequency, s.number("phase")}, window);
  }
  if (s.has("table")) put_curve(net, node, s, s["table"].curve, 1, Account::driving, window, messages);
}

void build_prescribed_speed(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  PrescribedSpeed given;
  if (s.has("table") == s.given("speed")) {
    if (s.has("table"))
      messages.add(s.where("table"),
                   fmt::format("prescribed speed \"{}\": \"speed\" and \"table\" both given; keep one", s.name));
    if (!s.has("table"))
      messages.add(s.at, fmt::format("prescribed speed \"{}\": \"speed\" is missing; give it, or \"table\"", s.name));
    return;
  }
  if (s.number("amplitude") != 0 && s.number("frequency") == 0)
    messages.add(
        s.where("amplitude"),
        fmt::format("prescribed speed \"{}\": \"amplitude\" needs a \"frequency\" > 0, e.g. \"5 Hz\"", s.name));
  if (s.given("ramp") && !s.given("speed"))
    messages.add(s.where("ramp"),
                 fmt::format("prescribed speed \"{}\": \"ramp\" needs \"speed\", the value it rises to", s.name));
  if (s.has("table")) {
    const CurveData& data = s["table"].curve;
    if (data.form == Curve::Form::smooth || data.period > 0)
      messages.add(s.where("table"),
                   fmt::format("prescribed speed \"{}\": only linear tables without a period are allowed", s.name));
    given.time = data.x;
    given.speed = data.y;
  } else if (s.given("ramp")) {
    given.time = {0, s.number("ramp")};
    given.speed = {0, s.number("speed")};
  } else {
    given.time = {0};
    given.speed = {s.number("speed")};
  }
  given.amplitude = s.number("amplitude");
  given.frequency = s.number("frequency");
  given.phase = s.number("phase");
  net.prescribe(node, given);
}

// --- motors ---

void build_dc_shunt(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  double stall = s.number_or("stall_torque", 0), no_load = s.number_or("no_load_speed", 0);
  const bool electrical = s.given("voltage") || s.given("resistance") || s.given("constant");
  if (electrical) {
    if (!s.given("voltage") || !s.given("resistance") || !s.given("constant") || s.given("stall_torque") ||
        s.given("no_load_speed")) {
      messages.add(
          s.at,
          fmt::format(
              "dc shunt motor \"{}\": give either stall_torque and no_load_speed, or voltage, resistance and constant",
              s.name));
      return;
    }
    stall = s.number("constant") * s.number("voltage") / s.number("resistance");
    no_load = s.number("voltage") / s.number("constant");
  } else if (!s.given("stall_torque") || !s.given("no_load_speed")) {
    const bool one = s.given("stall_torque") || s.given("no_load_speed");
    messages.add(s.at, one ? fmt::format("dc shunt motor \"{}\": \"{}\" is missing beside \"{}\"", s.name,
                                         s.given("stall_torque") ? "no_load_speed" : "stall_torque",
                                         s.given("stall_torque") ? "stall_torque" : "no_load_speed")
                           : fmt::format("dc shunt motor \"{}\": nothing given; give stall_torque and no_load_speed, "
                                         "or voltage, resistance and constant",
                                         s.name));
    return;
  }
  net.put(node, s.name, DcShuntMotor{stall, no_load, s.number_or("rated_torque", 0)}, window_of(s, messages));
}

void build_induction(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const double rated = s.number("rated_speed"), synchronous = s.number("synchronous_speed");
  if (synchronous <= rated) {
    messages.add(
        s.where("synchronous_speed"),
        fmt::format("induction motor \"{}\": synchronous_speed = {:.6g} rpm; must be above rated_speed = {:.6g} rpm",
                    s.name, synchronous * 30 / std::numbers::pi, rated * 30 / std::numbers::pi));
    return;
  }
  const auto motor =
      InductionMotor::from_catalogue(s.number("rated_power"), rated, synchronous, s.number("breakdown_ratio"),
                                     s.number("resistance_ratio"), s.number("voltage_factor"));
  if (!(motor.breakdown_slip > 0)) {
    messages.add(
        s.where("resistance_ratio"),
        fmt::format("induction motor \"{}\": no Kloss curve passes through these data; lower resistance_ratio = {}",
                    s.name, s.number("resistance_ratio")));
    return;
  }
  net.put(node, s.name, motor, window_of(s, messages));
}

void build_table_motor(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  put_curve(net, node, s, s["torque"].curve, 1, Account::driving, window_of(s, messages), messages);
}

}  // namespace

std::vector<Kind> drivetrain_kinds() {
  const std::vector<std::string> over_any = {"time", "angle", "speed"};
  const Key no_inertia = inertia_key("\"0 kg*m2\"", "inertia of its own shaft");
  return {
      {.name = "inertia",
       .doc = "rigid body on the shaft",
       .keys = {inertia_key("", "moment of inertia")},
       .build = build_inertia},
      {.name = "flywheel",
       .doc = "the same, by its usual name",
       .keys = {inertia_key("", "moment of inertia")},
       .build = build_inertia},
      {.name = "coupling",
       .doc = "spring and damper between two half inertias; rigid when its elasticity is off",
       .placement = Placement::inline_two,
       .keys = joined({{.name = "stiffness",
                        .unit = "N*m/rad",
                        .domain = positive,
                        .doc = "torsional stiffness k",
                        .required = true},
                       {.name = "inertia_in",
                        .unit = "kg*m2",
                        .fallback = "\"0 kg*m2\"",
                        .domain = not_negative,
                        .doc = "half on the driving side"},
                       {.name = "inertia_out",
                        .unit = "kg*m2",
                        .fallback = "\"0 kg*m2\"",
                        .domain = not_negative,
                        .doc = "half on the driven side"}},
                      damping_keys()),
       .build = build_coupling,
       .elastic = true},
      {.name = "shaft",
       .doc = "elastic shaft by stiffness, or by length, diameters and material",
       .placement = Placement::inline_two,
       .keys = joined(
           {{.name = "stiffness",
             .unit = "N*m/rad",
             .domain = positive,
             .doc = "torsional stiffness k of the whole shaft"},
            {.name = "length", .unit = "m", .domain = positive, .doc = "length, in place of the stiffness"},
            {.name = "diameter", .unit = "m", .domain = positive, .doc = "outer diameter"},
            {.name = "bore", .unit = "m", .fallback = "\"0 m\"", .domain = not_negative, .doc = "inner diameter"},
            {.name = "shear_modulus",
             .unit = "Pa",
             .fallback = "\"79.3 GPa\"",
             .domain = positive,
             .doc = "G; steel unless given"},
            {.name = "density",
             .unit = "kg/m3",
             .fallback = "\"7850 kg/m3\"",
             .domain = positive,
             .doc = "ρ; steel unless given"},
            {.name = "inertia",
             .unit = "kg*m2",
             .domain = not_negative,
             .doc = "of the whole shaft; default: from its dimensions, else 0"},
            {.name = "segments",
             .type = KeyType::integer,
             .fallback = "1",
             .domain = {.low = 1, .high = 100000},
             .doc = "number of equal springs that it is cut into"}},
           damping_keys()),
       .build = build_shaft,
       .elastic = true},
      {.name = "gearbox",
       .doc = "ideal gear stages by tooth numbers",
       .placement = Placement::inline_two,
       .keys = {{.name = "stages",
                 .type = KeyType::sections,
                 .doc = "stages from the driving side",
                 .required = true,
                 .nested = &stage_kinds()}},
       .build = build_gearbox},
      {.name = "induction motor",
       .doc = "induction motor after Kloss from catalogue data (THEORY 4.1)",
       .keys =
           joined({{.name = "rated_power", .unit = "W", .domain = positive, .doc = "shaft power P_n", .required = true},
                   {.name = "rated_speed",
                    .unit = "rad/s",
                    .domain = positive,
                    .doc = "speed ω_n at rated power",
                    .required = true},
                   {.name = "synchronous_speed",
                    .unit = "rad/s",
                    .domain = positive,
                    .doc = "ω_s, e.g. 1500 rpm",
                    .required = true},
                   {.name = "breakdown_ratio",
                    .domain = {.low = 1, .low_open = true},
                    .doc = "breakdown over rated torque ν",
                    .required = true},
                   {.name = "resistance_ratio",
                    .fallback = "0.0",
                    .domain = not_negative,
                    .doc = "a = R_s/R_r′ in Kloss' formula"},
                   {.name = "voltage_factor",
                    .fallback = "1.0",
                    .domain = positive,
                    .doc = "voltage over rated voltage; torque goes with its square"},
                   inertia_key("", "rotor inertia")},
                  window_keys()),
       .build = build_induction},
      {.name = "dc shunt motor",
       .doc = "straight characteristic M = M_stall (1 − ω/ω₀)",
       .keys = joined(
           {{.name = "stall_torque", .unit = "N*m", .domain = positive, .doc = "torque at standstill M_stall"},
            {.name = "no_load_speed", .unit = "rad/s", .domain = positive, .doc = "speed without torque ω₀"},
            {.name = "voltage",
             .unit = "V",
             .domain = positive,
             .doc = "armature voltage U, with resistance and constant in place of the two above"},
            {.name = "resistance", .unit = "Ohm", .domain = positive, .doc = "armature resistance R: M_stall = k U/R"},
            {.name = "constant", .unit = "N*m/A", .domain = positive, .doc = "motor constant k: ω₀ = U/k"},
            {.name = "rated_torque",
             .unit = "N*m",
             .domain = positive,
             .doc = "scale of errors; default: stall torque"},
            inertia_key("", "rotor inertia")},
           window_keys()),
       .build = build_dc_shunt},
      {.name = "motor",
       .doc = "motor, turbine or hydraulic drive by table M(ω)",
       .keys = joined({{.name = "torque",
                        .type = KeyType::curve,
                        .unit = "N*m",
                        .doc = "characteristic over speed",
                        .required = true,
                        .choices = {"speed"}},
                       inertia_key("", "rotor inertia")},
                      window_keys()),
       .build = build_table_motor},
      {.name = "torque source",
       .doc = "torque as constant, ramp, sine or table",
       .keys = joined(
           {{.name = "torque", .unit = "N*m", .fallback = "\"0 N*m\"", .doc = "constant part M₀"},
            {.name = "ramp", .unit = "s", .domain = positive, .doc = "time over which the constant part rises from 0"},
            {.name = "amplitude", .unit = "N*m", .fallback = "\"0 N*m\"", .doc = "of M₁ sin(2π f t + ψ)"},
            {.name = "frequency", .unit = "Hz", .fallback = "\"0 Hz\"", .domain = not_negative, .doc = "f"},
            {.name = "phase", .unit = "rad", .fallback = "\"0 rad\"", .doc = "ψ"},
            {.name = "table",
             .type = KeyType::curve,
             .unit = "N*m",
             .doc = "torque over time, angle or speed",
             .choices = over_any},
            no_inertia},
           window_keys()),
       .build = build_torque_source},
      {.name = "prescribed speed",
       .doc = "speed as constant, ramp, sine or table, whatever torque that takes",
       .keys =
           {{.name = "speed", .unit = "rad/s", .doc = "constant speed"},
            {.name = "ramp", .unit = "s", .domain = positive, .doc = "time over which it rises from 0"},
            {.name = "amplitude", .unit = "rad/s", .fallback = "\"0 rad/s\"", .doc = "of an added sine"},
            {.name = "frequency", .unit = "Hz", .fallback = "\"0 Hz\"", .domain = not_negative, .doc = "of the sine"},
            {.name = "phase", .unit = "rad", .fallback = "\"0 rad\"", .doc = "of the sine"},
            {.name = "table", .type = KeyType::curve, .unit = "rad/s", .doc = "speed over time", .choices = {"time"}},
            no_inertia},
       .build = build_prescribed_speed},
      {.name = "bearing drag",
       .doc = "viscous friction against the frame",
       .keys =
           {{.name = "damping", .unit = "N*m*s/rad", .domain = not_negative, .doc = "b in M = −b ω", .required = true},
            no_inertia},
       .build = build_drag},
      {.name = "load",
       .doc = "resistance on a shaft: constant, viscous, quadratic, table; several may be given",
       .keys = joined(
           {{.name = "torque", .unit = "N*m", .doc = "constant part M₀"},
            {.name = "acts",
             .type = KeyType::text,
             .fallback = "\"against motion\"",
             .doc = "the constant part opposes motion and holds at standstill, or acts always backwards (a weight)",
             .choices = {"against motion", "always"}},
            {.name = "damping",
             .unit = "N*m*s/rad",
             .fallback = "\"0 N*m*s/rad\"",
             .domain = not_negative,
             .doc = "b in b ω"},
            {.name = "quadratic",
             .unit = "N*m*s2/rad2",
             .fallback = "\"0 N*m*s2/rad2\"",
             .domain = not_negative,
             .doc = "q in q ω |ω|: fan, centrifugal pump"},
            {.name = "table",
             .type = KeyType::curve,
             .unit = "N*m",
             .doc = "resisting torque over time, angle or speed",
             .choices = over_any},
            {.name = "work",
             .type = KeyType::text,
             .fallback = "\"useful\"",
             .doc = "line of the energy balance",
             .choices = {"useful", "harmful", "driving"}},
            no_inertia},
           window_keys()),
       .build = build_load},
  };
}

}  // namespace kurbel
