// output_start.cpp — a start given for a mechanism's output: angle and speed of its crank.
//
//     x(φ) = position on the given stroke,   ω = v/x′(φ)
// A stroke is named by its end as the crank turns forwards. Default: for a moving slider the stroke of a crank turning
// forwards, at rest the one towards the folded end, or the minimum angle.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/model/model.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/reading/scene_reading.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

// x and x′ of a mechanism over the angle of its shaft, from a model of it alone.
class Output {
 public:
  Output(const Section& section, const std::string& file, Messages& messages) {
    Network net;
    build_component(section, net, messages);
    const auto ports = net.ports.find(section.name);
    if (!messages.empty() || net.elements.empty() || ports == net.ports.end()) return;
    net.components = {section.name};
    net.nodes[at(ports->second.in)].inertia += 1;  // kg·m²; no influence on displacements
    cycle_ = net.elements.front().element->cycle;
    Scene bare;
    bare.file = file;
    try {
      model_ = compile_network(std::move(net), bare, Effects{});
    } catch (const SceneError& error) {  // dimensions for which an inertia of 1 kg·m² is negligible
      for (const Message& message : error.messages) messages.add(section.at, message.text);
      return;
    }
    for (const Channel& channel : model_->pool_channels) {
      if (channel.name.what == quantities::position) position_ = &channel;
      if (channel.name.what == quantities::velocity) velocity_ = &channel;
    }
  }
  // A slide moved by a shaft, such as a screw, is no output: its position depends on full turns and travel as well.
  bool found() const { return position_ && velocity_ && cycle_ != 0; }
  bool turns() const { return std::isfinite(cycle_); }
  double cycle() const { return cycle_; }
  bool rocks() const { return position_->unit == "rad"; }
  double x(double phi) const { return stated(*position_, phi); }
  double slope(double phi) const { return stated(*velocity_, phi); }  // at ω = 1

 private:
  double stated(const Channel& channel, double phi) const {
    const std::vector<double> angle(model_->angles.size(), phi), node_angle(model_->network.nodes.size(), phi),
        speed(model_->shafts.size(), 1.0);
    Snapshot s{};
    s.now.angle = angle.data(), s.now.speed = speed.data(), s.node_angle = node_angle.data();
    return channel.value(s);
  }
  std::shared_ptr<const Model> model_;
  const Channel *position_ = nullptr, *velocity_ = nullptr;
  double cycle_ = 0;
};

// A cycle of the crank in pieces within which x is monotone.
struct Way {
  std::vector<double> knots;  // angles, turning points among them [rad]
  double least = HUGE_VAL, greatest = -HUGE_VAL;
};

Way way_of(const Output& output) {
  constexpr int cells_of_turn = 360;
  constexpr double shift = 0.37;  // no symmetric angle is a knot
  const int cells = cells_of_turn * static_cast<int>(std::lround(output.cycle() / turn));
  Way way{.knots = {0}};
  for (int i = 0; i <= cells; ++i) {
    const double end = std::min(output.cycle(), turn * (i + shift) / cells_of_turn), begin = way.knots.back();
    const double a = output.slope(begin), b = output.slope(end);
    if (a * b < 0) way.knots.push_back(find_root([&](double phi) { return output.slope(phi); }, begin, a, end, b));
    way.knots.push_back(end);
  }
  for (const double phi : way.knots)
    way.least = std::min(way.least, output.x(phi)), way.greatest = std::max(way.greatest, output.x(phi));
  return way;
}

// Crank angle with the output at x on the stroke to the maximum or minimum position as the crank turns forwards; at the
// ends both strokes meet.
std::vector<double> angles_at(const Output& output, const Way& way, double x, bool rising) {
  const double length = way.greatest - way.least;
  std::vector<double> places;
  const auto add = [&](double phi) {
    const auto near = [&](double known) { return std::abs(std::remainder(phi - known, output.cycle())) < 1e-5; };
    if (std::none_of(places.begin(), places.end(), near)) places.push_back(phi);
  };
  for (std::size_t i = 0; i + 1 < way.knots.size(); ++i) {
    const double from = way.knots[i], to = way.knots[i + 1], a = output.x(from) - x, b = output.x(to) - x;
    const bool turns = std::abs(output.slope(from)) <= 1e-6 * length;
    if ((turns && std::abs(a) <= 1e-12 * length) || (a == 0 && (b > a) == rising)) add(from);
    if ((b > a) == rising && a * b < 0) add(find_root([&](double phi) { return output.x(phi) - x; }, from, a, to, b));
  }
  return places;
}

struct StatedMotion {
  double position = 0, velocity = 0;
  bool rising = false;
};

std::optional<StatedMotion> read_motion(SceneReading& r, bool rocks) {
  const OutputStart& given = r.output_start;
  StatedMotion stated;
  const char* const ends[] = {rocks ? "least" : "folded", rocks ? "greatest" : "extended"};
  bool valid = read_quantity(given.position->value, rocks ? "rad" : "m", any_number, "start: position", r.messages,
                             stated.position);
  if (given.velocity)
    valid = read_quantity(given.velocity->value, rocks ? "rad/s" : "m/s", any_number, "start: velocity", r.messages,
                          stated.velocity) &&
            valid;
  stated.rising = stated.velocity > 0;
  if (given.towards) {
    const std::string& end = given.towards->value.text;
    stated.rising = end == ends[1];
    if (end != ends[0] && end != ends[1]) {
      r.refuse(given.towards->value.at, fmt::format("start: towards = {}; allowed: \"{}\" or \"{}\"",
                                                    given.towards->value.describe(), ends[1], ends[0]));
      valid = false;
    }
  }
  if (!valid) return {};
  return stated;
}

}  // namespace

void place_by_output(SceneReading& r) {
  const OutputStart& given = r.output_start;
  if (!given.on) return;
  StartSettings& start = r.scene.run.start;
  const auto refuse = [&](Location at, const std::string& text) {
    r.refuse(at, fmt::format("start: on = {}: {}", given.on->value.describe(), text));
  };
  const Output output(*r.find(start.on), r.scene.file, r.messages);
  if (!r.messages.empty()) return;
  const bool said_to_rock = given.on->value.text.ends_with(".rocker");
  if (!output.found() || output.rocks() != said_to_rock)
    return refuse(given.on->value.at, fmt::format("\"{0}\" has no {1}; allowed: {2}\"{0}\", its shaft", start.on,
                                                  said_to_rock ? "rocker" : "slider",
                                                  !output.found()  ? ""
                                                  : output.rocks() ? fmt::format("\"{}.rocker\" or ", start.on)
                                                                   : fmt::format("\"{}.slider\" or ", start.on)));
  if (!output.turns())
    return refuse(
        given.on->value.at,
        fmt::format("the crank of \"{}\" cannot turn; give the angle of the crank within its arc, on = \"{}\"",
                    start.on, start.on));
  const std::optional<StatedMotion> stated = read_motion(r, output.rocks());
  if (!stated) return;
  const Way way = way_of(output);
  double x = stated->position;
  if (output.rocks()) x += turn * std::round((0.5 * (way.least + way.greatest) - x) / turn);
  const std::vector<double> places = angles_at(output, way, x, stated->rising);
  const std::string said = given.position->value.describe();
  if (places.empty()) {
    const double unit = output.rocks() ? degree : 1e-3;
    return refuse(given.position->value.at,
                  fmt::format("position = {} lies beyond its way, {:.6g} … {:.6g} {}", said, way.least / unit,
                              way.greatest / unit, output.rocks() ? "deg" : "mm from the crank's axis"));
  }
  if (places.size() > 1)
    return refuse(given.position->value.at, fmt::format("it passes position = {} {} times on such strokes in a cycle "
                                                        "of the crank; give angle and speed of the crank, on = \"{}\"",
                                                        said, places.size(), start.on));
  start.angle = places.front();
  if (stated->velocity == 0) return;
  const double slope = output.slope(start.angle);
  if (std::abs(slope) <= 1e-6 * (way.greatest - way.least))
    return refuse(given.velocity->value.at,
                  fmt::format("velocity = {}: there it stands at a dead centre whatever the crank does (v = x' ω with "
                              "x' = 0); leave it out, or give angle and speed of the crank, on = \"{}\"",
                              given.velocity->value.describe(), start.on));
  start.speed = stated->velocity / slope;
}

}  // namespace kurbel
