// machine_view.cpp — frames of the animated machine from the traces of one or two runs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/numerics/index.h"
#include "mechanisms/deforming/deforming_mechanism.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/findings/trace.h"
#include "studies/run/compare.h"
#include "studies/run/run_findings.h"

namespace kurbel {
namespace {

constexpr double frames_per_turn = 240, fewest_per_turn = 60;
constexpr int fewest_frames = 400, most_frames = 3000;
constexpr double turns_shown = most_frames / fewest_per_turn;
constexpr std::size_t most_parts = 60;
constexpr int places_of_turn = 240;  // straight between them: 1e-4 of the crank's radius
constexpr std::ptrdiff_t ends_shown = 7;
constexpr double shown_twist = 1.1;  // of the largest one after enlargement [rad]
constexpr double shown_bend = 0.12;  // of the rod's length

std::vector<double> sampled(const Trace* trace, const std::vector<double>& time) {
  return trace && !trace->x.empty() ? trace->at(time) : std::vector<double>();
}

// 1, 2 or 5 times a power of ten, not above x.
double round_down(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  const double lead = x / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

// Components in the order of the lines, each line a row.
void add_parts(MachineView& view, const Model& model) {
  const auto add = [&](const std::string& name, int row) {
    if (!model.network.ports.contains(name)) return;
    MachineView::Part part{.name = name, .kind = model.network.kind_of(name), .row = row};
    if (part.kind.empty()) part.kind = "inertia";
    const Network::Ports& ports = model.network.ports.at(name);
    part.ratio_in = model.node_ratio[at(ports.in)];
    part.ratio_out = model.node_ratio[at(ports.out)];
    for (const Network::ShaftElement& element : model.network.elements)
      part.crank = part.crank || (element.component == name && mechanism_of(element));
    for (const ElasticJoint& joint : model.elastic) {
      if (model.network.joints[at(joint.joint)].component != name) continue;
      (joint.slips || joint.springless ? part.slips : part.elastic) = true;
    }
    view.parts.push_back(std::move(part));
  };
  if (model.scene.lines.empty())
    for (const std::string& name : model.network.components) add(name, 0);
  for (std::size_t row = 0; row < model.scene.lines.size(); ++row)
    for (const std::string& name : model.scene.lines[row].names) add(name, static_cast<int>(row));
  // Both ends of a long machine.
  if (view.parts.size() > most_parts) {
    view.parts.erase(view.parts.begin() + ends_shown, view.parts.end() - ends_shown);
    view.parts.insert(view.parts.begin() + ends_shown,
                      MachineView::Part{.name = "…", .kind = "gap", .row = view.parts.front().row});
  }
}

// "gearbox.out" names a shaft of a part.
void add_ties(MachineView& view, const Model& model) {
  const auto add = [&](const std::string& place, std::size_t row, bool at_end) {
    const std::string name = place.substr(0, place.find('.')), port = place.substr(std::min(place.size(), name.size()));
    for (std::size_t k = 0; k < view.parts.size(); ++k)
      if (view.parts[k].name == name)
        view.ties.push_back({static_cast<int>(row), at_end, static_cast<int>(k), port != ".in"});
  };
  for (std::size_t row = 1; row < model.scene.lines.size(); ++row) {
    const Line& line = model.scene.lines[row];
    add(line.from, row, false);
    if (!line.to.empty()) add(line.to, row, true);
  }
}

// Symbol for the first load of a mechanism.
std::string drawn_load(const Mechanism& mechanism) {
  if (mechanism.loads.empty()) return "";
  const auto& law = mechanism.loads.front().law;
  if (std::holds_alternative<PressForce>(law) || std::holds_alternative<RoundedPressForce>(law)) return "press";
  const bool gas = std::holds_alternative<CompressorForce>(law) || std::holds_alternative<ChamberOverTravel>(law) ||
                   std::holds_alternative<ChamberOverAngle>(law);
  return gas ? "cylinder" : "";
}

MachineView::Linkage linkage_of(const Mechanism& mechanism, const Model& model, int node) {
  const LinkageDrawing drawing = mechanism.data.drawing();
  MachineView::Linkage linkage{.name = mechanism.name,
                               .load = drawn_load(mechanism),
                               .ratio = model.node_ratio[at(node)],
                               .direction = drawing.direction,
                               .x = {},
                               .y = {},
                               .links = {},
                               .fixed = drawing.fixed,
                               .output = drawing.output,
                               .gaps = {}};
  for (const JointClearance& c : deformation_of(mechanism).clearances)
    if (c.joint != JointClearance::Joint::guide) linkage.gaps.push_back({c.name(), c.contact.gap});
  for (const auto& [shape, joints] : drawing.links) linkage.links.push_back({shape, joints});
  const auto slides_there = [&](const MachineView::Linkage::Link& link) {
    return (link.shape == "slider" || link.shape == "point") && link.joints.front() == drawing.output;
  };
  if (!drawing.rocks && std::none_of(linkage.links.begin(), linkage.links.end(), slides_there))
    linkage.links.push_back({"point", {drawing.output}});
  for (int i = 0; i <= places_of_turn * mechanism.reduced->cycle().turns(); ++i) {
    const double angle = 2 * std::numbers::pi * i / places_of_turn;
    const std::vector<PlanePoint> joints =
        mechanism.data.places(mechanism.reduced->cycle().within(angle + mechanism.phase));
    linkage.x.resize(joints.size()), linkage.y.resize(joints.size());
    for (std::size_t k = 0; k < joints.size(); ++k)
      linkage.x[k].push_back(joints[k].x), linkage.y[k].push_back(joints[k].y);
  }
  return linkage;
}

// Every mechanism of the machine, the reduction link's first.
void add_linkages(MachineView& view, const Model& model) {
  constexpr std::size_t most = 6;
  const auto add = [&](const Network::ShaftElement& e) {
    if (const auto* element = mechanism_of(e); element && view.linkages.size() < most)
      view.linkages.push_back(linkage_of(element->mechanism(), model, e.node));
  };
  if (model.reduction_element >= 0) add(model.network.elements[at(model.reduction_element)]);
  for (std::size_t e = 0; e < model.network.elements.size(); ++e)
    if (static_cast<int>(e) != model.reduction_element) add(model.network.elements[e]);
}

// Slip is no twist to enlarge: along each line, from its begin, the rotations between the two shafts of slipping
// parts are subtracted from the twists and stored separately; at the link they are zero.
void distinguish_slips(MachineView::Motion& motion, const MachineView& view) {
  if (std::none_of(view.parts.begin(), view.parts.end(), [](const MachineView::Part& p) { return p.slips; })) return;
  const std::size_t frames = view.time.size();
  const std::vector<double> none(frames, 0.0);
  motion.slip_in.assign(view.parts.size(), none), motion.slip_out.assign(view.parts.size(), none);
  int row = -1;
  std::vector<double> so_far = none;
  for (std::size_t k = 0; k < view.parts.size(); ++k) {
    const MachineView::Part& part = view.parts[k];
    if (part.row != row) {
      row = part.row, so_far = none;
      for (const MachineView::Tie& tie : view.ties)
        if (tie.row == row && !tie.at_end && at(tie.part) < k)
          so_far = (tie.out ? motion.slip_out : motion.slip_in)[at(tie.part)];
    }
    const auto &in = motion.twist_in[k], &out = motion.twist_out[k];
    motion.slip_in[k] = so_far;
    if (part.slips && in.size() == frames && out.size() == frames)
      for (std::size_t i = 0; i < frames; ++i) so_far[i] += out[i] - in[i];
    motion.slip_out[k] = so_far;
  }
  std::size_t link = 0;
  while (link + 1 < view.parts.size() && view.parts[link].name != view.link) ++link;
  const std::vector<double> there = motion.slip_in[link];
  for (std::size_t k = 0; k < view.parts.size(); ++k)
    for (const auto& [slip, twist] :
         {std::pair(&motion.slip_in[k], &motion.twist_in[k]), std::pair(&motion.slip_out[k], &motion.twist_out[k])})
      for (std::size_t i = 0; i < frames; ++i) {
        (*slip)[i] -= there[i];
        if (twist->size() == frames) (*twist)[i] -= (*slip)[i];
      }
}

MachineView::Motion motion_of(const Result& r, const MachineView& view, Role role) {
  const Model& model = *r.model;
  const Traces& traces = *r.traces;
  MachineView::Motion motion{.label = r.label,
                             .role = role,
                             .angle = sampled(traces.find("angle"), view.time),
                             .twist_in = {},
                             .twist_out = {},
                             .slip_in = {},
                             .slip_out = {},
                             .torque = {},
                             .force = {},
                             .bend = {},
                             .shift = {}};
  for (const MachineView::Part& part : view.parts) {
    if (part.kind == "gap") {
      for (auto* lists : {&motion.twist_in, &motion.twist_out, &motion.torque}) lists->emplace_back();
      continue;
    }
    const Network::Ports& ports = model.network.ports.at(part.name);
    motion.twist_in.push_back(sampled(traces.find(Traces::node_key(ports.in)), view.time));
    motion.twist_out.push_back(ports.in == ports.out ? motion.twist_in.back()
                                                     : sampled(traces.find(Traces::node_key(ports.out)), view.time));
    motion.torque.push_back(sampled(traces.find("torque." + part.name), view.time));
  }
  distinguish_slips(motion, view);
  bool any_twist = false;
  for (const auto* side : {&motion.twist_in, &motion.twist_out})
    for (const auto& twists : *side)
      for (const double twist : twists) any_twist = any_twist || std::abs(twist) > 1e-12;
  for (const MachineView::Linkage& linkage : view.linkages) {
    motion.force.emplace_back();
    for (const char* load : {"force.", "load_torque."})
      if (const Trace* trace = traces.find(load + linkage.name)) motion.force.back() = sampled(trace, view.time);
  }
  for (const MachineView::Linkage& linkage : view.linkages) {
    motion.bend.push_back(sampled(traces.find("rod_deflection." + linkage.name), view.time));
    for (const MachineView::Linkage::Gap& gap : linkage.gaps)
      for (const char* axis : {"x", "y"}) {
        std::string joint = gap.joint;
        std::replace(joint.begin(), joint.end(), ' ', '_');
        motion.shift.push_back(
            sampled(traces.find(fmt::format("{}_shift_{}.{}", joint, axis, linkage.name)), view.time));
      }
  }
  if (!any_twist || model.elastic.empty()) motion.twist_in.clear(), motion.twist_out.clear();
  return motion;
}

// The largest deflection is drawn as a tenth of the rod.
void enlarge_bends(MachineView& view, const Model& model) {
  for (std::size_t k = 0; k < view.linkages.size(); ++k) {
    MachineView::Linkage& linkage = view.linkages[k];
    double largest = 0, length = 0;
    for (const MachineView::Motion& motion : view.motions)
      for (const double bend : motion.bend[k]) largest = std::max(largest, std::abs(bend));
    if (const Mechanism* mechanism = find_mechanism(model.network, linkage.name))
      if (const auto* data = mechanism->data.as<SliderCrankData>()) length = data->rod_length;
    if (largest > 0) linkage.bend_enlargement = round_down(std::max(1.0, shown_bend * length / largest));
  }
}

}  // namespace

MachineView machine_view(const std::vector<const Result*>& results) {
  const Result& front = *results.back();
  const Model& model = *front.model;
  MachineView view;
  view.link = model.network.nodes[at(model.reduction_node)].component;
  view.title = "The machine in motion";
  add_parts(view, model);
  add_ties(view, model);
  view.cycle = model.cycle;
  add_linkages(view, model);
  // Frames: the whole run, or the last turns of a long one.
  double end = HUGE_VAL;
  for (const Result* r : results) end = std::min(end, r->traces->find("angle")->x.back());
  const Trace& angle = *front.traces->find("angle");
  const double turns = std::abs(angle.at(end) - angle.y.front()) / (2 * std::numbers::pi);
  double begin = angle.x.front();
  if (turns > turns_shown)
    for (std::size_t i = 0;
         i < angle.x.size() && std::abs(angle.at(end) - angle.y[i]) > 2 * std::numbers::pi * turns_shown; ++i)
      begin = angle.x[i];
  const int frames = static_cast<int>(
      std::clamp(frames_per_turn * turns, 1.0 * fewest_frames, 1.0 * most_frames));  // of 1e12 turns, too
  for (int i = 0; i < frames; ++i) view.time.push_back(begin + (end - begin) * i / (frames - 1));
  for (const Result* r : results)
    view.motions.push_back(motion_of(*r, view, !is_elastic(*r->model) ? Role::rigid : Role::elastic));
  double largest = 0;
  for (const MachineView::Motion& motion : view.motions)
    for (const auto* side : {&motion.twist_in, &motion.twist_out})
      for (const auto& twists : *side)
        for (const double twist : twists) largest = std::max(largest, std::abs(twist));
  enlarge_bends(view, model);
  view.enlargement = largest > 0 ? round_down(std::max(1.0, shown_twist / largest)) : 1;
  return view;
}

}  // namespace kurbel
