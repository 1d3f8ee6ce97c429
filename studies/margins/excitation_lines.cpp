// excitation_lines.cpp — collects lines from the model, its laws and [operation], each once.
#include "studies/margins/excitation_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "drivetrain/gears/gear_keys.h"
#include "drivetrain/induction/induction_law.h"
#include "engine/model/cycle_of.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/scene/text.h"

namespace kurbel {
namespace {

constexpr double least_strength = 1e-6;  // of the strongest harmonic of the same sort
constexpr double same = 1e-6;            // orders that differ by less are one
constexpr double most_teeth = 1000;      // of a wheel: more stand for a ratio
constexpr int harmonics_of_a_law = 12;   // where laws have no common period

// Shafts of equal speed.
struct SpeedGroup {
  double ratio = 1;  // of their speed over the reduction link's, > 0
  std::string name;  // of the heaviest part
  double inertia = -1;
};

// The reduction link's first.
std::vector<SpeedGroup> speed_groups(const Model& m) {
  std::vector<double> inertia(m.network.nodes.size());
  for (std::size_t n = 0; n < inertia.size(); ++n) inertia[n] = m.network.nodes[n].inertia;
  for (const Network::ShaftElement& e : m.network.elements) inertia[at(e.node)] += e.element->mean_inertia;
  std::vector<SpeedGroup> groups = {{1, m.node_label(m.reduction_node)}};
  for (std::size_t n = 0; n < inertia.size(); ++n) {
    const double ratio = std::abs(m.node_ratio[n]);
    if (!(ratio > 0)) continue;
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const SpeedGroup& g) { return std::abs(g.ratio - ratio) <= same * ratio; });
    if (group == groups.end()) group = groups.insert(groups.end(), SpeedGroup{ratio, {}});
    if (inertia[n] > group->inertia)
      group->inertia = inertia[n], group->name = as_words(m.node_label(static_cast<int>(n)));
  }
  return groups;
}

class LineList {
 public:
  LineList(const Model& model, const Excitations& excitations, double speed, const std::vector<std::string>& shafts,
           std::vector<std::string>& notes)
      : m_(model), x_(excitations), speed_(speed), shafts_(shafts), notes_(notes), groups_(speed_groups(model)) {}

  std::vector<ExcitationLine> all() {
    for (const SpeedGroup& group : groups_)
      for (const double k : {1.0, 2.0})
        add({.label = label(k, group), .source = "every shaft", .order = k * group.ratio});
    add_stated_orders();
    add_orders_of_laws();
    add_meshes();
    add_mains();
    add_converter();
    for (const FrequencySource& f : x_.by_frequency)
      add({.kind = ExcitationLine::Kind::frequency,
           .label = fmt::format("{:.4g} Hz", f.omega / turn),
           .source = as_words(f.component),
           .fixed = f.omega,
           .in_scene = true});
    return std::move(lines_);
  }

 private:
  // "3×" for the reduction link, and if all shafts have the same speed; else "3× pump".
  std::string label(double k, const SpeedGroup& group) const {
    const std::string times = fmt::format("{:.5g}×", k);
    return groups_.size() == 1 ? times : times + " " + group.name;
  }
  // For an order of the reduction link: by a shaft for which it is a half or whole multiple, the link first.
  std::string label_of_order(double order) const {
    for (const SpeedGroup& group : groups_) {
      const double k = order / group.ratio;
      if (k > 0.4 && std::abs(2 * k - std::round(2 * k)) <= same * k) return label(0.5 * std::round(2 * k), group);
    }
    return label(order, groups_.front());
  }

  // An existing line gets the further source.
  void add(ExcitationLine line) {
    for (ExcitationLine& there : lines_) {
      const double scale = std::max(there.at(speed_), line.at(speed_));
      if (std::abs(there.order - line.order) * std::abs(speed_) > same * scale ||
          std::abs(there.fixed - line.fixed) > same * scale)
        continue;
      if (there.source.find(line.source) == std::string::npos)
        there.source = there.source == "every shaft" ? line.source : there.source + ", " + line.source;
      if (line.harmonic) there.harmonic = line.harmonic;
      there.in_scene = there.in_scene || line.in_scene;
      return;
    }
    lines_.push_back(std::move(line));
  }

  void add_stated_orders() {
    for (const auto& [component, orders] : m_.scene.operation.orders) {
      const double ratio = std::abs(m_.node_ratio[at(m_.network.ports.at(component).in)]);
      if (!(ratio > 0)) {
        notes_.push_back(
            fmt::format("\"{}\" stands in the machine's usual motion: its orders excite nothing", component));
        continue;
      }
      for (const double k : orders)
        add({.label = label(k, {ratio, as_words(component)}),
             .source = fmt::format("orders of {}", as_words(component)),
             .order = k * ratio});
    }
  }

  void add_orders_of_laws() {
    if (x_.by_order.empty()) return;
    if (!cycle_of(m_).periodic) return add_orders_of_each_law();
    const std::vector<char> acting = acting_harmonics(x_, speed_);
    for (std::size_t r = 1; r <= x_.harmonics; ++r)
      if (acting[r])
        add({.label = label_of_order(x_.order(r)),
             .source = source_of(x_, r, speed_, shafts_),
             .order = x_.order(r),
             .harmonic = r,
             .in_scene = true});
  }
  // Laws without a common period would be spread over the link's own orders: each has the orders of its own period.
  void add_orders_of_each_law() {
    const auto add_law = [&](const std::string& component, double fundamental) {
      for (int k = 1; k <= harmonics_of_a_law; ++k)
        add({.label = label_of_order(k * fundamental), .source = as_words(component), .order = k * fundamental});
    };
    for (const Network::ShaftElement& e : m_.network.elements)
      if (e.element->is.uses_angle && e.element->angle_period > 0)
        add_law(e.component, turn / e.element->angle_period * m_.scale_ratio[at(e.node)]);
    for (const ElasticJoint& e : m_.elastic) {
      const Network::Joint& joint = m_.network.joints[at(e.joint)];
      if (joint.element->is.uses_angle) add_law(joint.component, m_.scale_ratio[at(joint.a)]);
    }
    notes_.push_back(
        fmt::format("the laws over angles have no common period: their first {} orders are listed, and the "
                    "response to them is not assessed",
                    harmonics_of_a_law));
  }

  void add_meshes() {
    std::size_t mesh = 0;
    for (const auto& [gearbox, gears] : m_.network.data.all<GearStages>())
      for (const GearStages::Stage& stage : gears.stages) {
        const GearMesh& reported = x_.meshes.at(mesh++);
        if (std::max(stage.teeth[0], stage.teeth[1]) > most_teeth)
          notes_.push_back(fmt::format("{}: so many stand for a ratio; its mesh is no excitation here", reported.name));
        else
          add({.kind = ExcitationLine::Kind::mesh,
               .label = "mesh " + as_words(gearbox),
               .source = as_words(reported.name),
               .order = reported.order});
      }
  }

  void add_mains() {
    std::map<double, std::string> supplies;  // by frequency
    if (m_.scene.operation.mains) supplies[*m_.scene.operation.mains] = "mains";
    for (const auto& [motor, data] : m_.network.data.all<InductionData>())
      if (!data.by_converter && !m_.scene.operation.mains && m_.scene.operation.motor != motor)
        supplies[data.mains] = "mains of " + as_words(motor);
    for (const auto& [frequency, source] : supplies)
      for (const double k : {1.0, 2.0})
        add({.kind = ExcitationLine::Kind::mains,
             .label = fmt::format("{:g}× mains", k),
             .source = source,
             .fixed = k * turn * frequency});
  }

  // a p Ω_motor + b ω_mains.
  void add_converter() {
    const Operation& o = m_.scene.operation;
    if (o.converter.empty()) return;
    const InductionData* data = m_.network.data.find<InductionData>(o.motor);
    const double pairs = o.pole_pairs ? *o.pole_pairs
                         : data       ? std::round(turn * data->mains / data->synchronous_speed)
                                      : 1;
    const double ratio = std::abs(m_.node_ratio[at(m_.network.ports.at(o.motor).in)]);
    for (const Operation::Harmonic& h : o.converter) {
      const double sign = h.output < 0 ? -1 : 1;  // |−x| = |x|
      add({.kind = ExcitationLine::Kind::converter,
           .label =
               h.text + (h.text.find_first_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos ? "× output" : ""),
           .source = "converter of " + as_words(o.motor),
           .order = sign * h.output * pairs * ratio,
           .fixed = sign * h.mains * turn * o.mains.value_or(0)});
    }
  }

  const Model& m_;
  const Excitations& x_;
  double speed_;
  const std::vector<std::string>& shafts_;
  std::vector<std::string>& notes_;
  std::vector<SpeedGroup> groups_;
  std::vector<ExcitationLine> lines_;
};

}  // namespace

std::vector<char> acting_harmonics(const Excitations& x, double speed) {
  std::map<LeftOver, std::vector<double>> strength;
  for (const OrderSource& source : x.at_speed(speed)) {
    std::vector<double>& of_kind = strength.try_emplace(source.kind, x.harmonics + 1, 0.0).first->second;
    for (std::size_t r = 1; r <= x.harmonics; ++r) of_kind[r] += std::abs(source.at(r, speed));
  }
  std::vector<char> acting(x.harmonics + 1, 0);
  for (const auto& [kind, of_kind] : strength) {
    const double strongest = *std::max_element(of_kind.begin(), of_kind.end());
    for (std::size_t r = 1; r <= x.harmonics; ++r)
      if (strongest > 0 && x.is_looked_at(r) && of_kind[r] >= least_strength * strongest) acting[r] = 1;
  }
  return acting;
}

std::string source_of(const Excitations& x, std::size_t harmonic, double speed,
                      const std::vector<std::string>& shafts) {
  std::map<std::string, double> strength;
  for (const OrderSource& s : x.at_speed(speed)) {
    const bool on_shaft = s.kind == LeftOver::torque && !shafts.empty() && s.index >= 0;
    if (on_shaft || s.kind == LeftOver::torque || s.kind == LeftOver::joint_torque)
      strength[on_shaft ? shafts[at(s.index)] : s.component] += std::abs(s.at(harmonic, speed));
  }
  std::string name;
  double most = 0;
  for (const auto& [component, sum] : strength)
    if (sum > most * (1 + 1e-9)) most = sum, name = component;
  const auto like =
      std::count_if(strength.begin(), strength.end(), [&](const auto& s) { return s.second > 0.5 * most; });
  if (name.empty() || like < 2) return as_words(name);
  // cylinder_1 … cylinder_4: "cylinder (4 alike)"; "4 × cylinder" would read as four times its speed
  const std::string stem = name.substr(0, name.find_last_not_of("0123456789") + 1);
  const bool alike = std::all_of(strength.begin(), strength.end(), [&](const auto& s) {
    return !(s.second > 0.5 * most) || s.first.substr(0, s.first.find_last_not_of("0123456789") + 1) == stem;
  });
  return alike && !stem.empty()
             ? fmt::format("{} ({} alike)", as_words(stem.substr(0, stem.find_last_not_of("_-") + 1)), like)
             : fmt::format("{} and {} more", as_words(name), like - 1);
}

std::vector<ExcitationLine> excitation_lines(const Model& model, const Excitations& excitations, double speed,
                                             const std::vector<std::string>& shafts, std::vector<std::string>& notes) {
  return LineList(model, excitations, speed, shafts, notes).all();
}

}  // namespace kurbel
