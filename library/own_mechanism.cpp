// own_mechanism.cpp — reduced functions, drawing and keys of a mechanism defined by the user as a motion of links.
#include "library/own_mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "engine/scene/scene.h"
#include "library/own_elements.h"
#include "mechanisms/kinds/kinds.h"
#include "mechanisms/kinds/mechanism_keys.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

// Replaces Simbody's bodies by sums over the links.
class OwnBodies final : public MechanismBodies {
 public:
  explicit OwnBodies(OwnMechanismData data) : data_(std::move(data)) {}
  ReducedSample sample(double phi) override { return rounded(form(phi)); }
  ReducedSample sample_from(double phi, const std::vector<double>&) override { return sample(phi); }
  // Link by link, of its velocities.
  double kinetic_energy(double phi, double omega) override {
    long double energy = 0;
    for (const Link& link : data_.motion(Taylor::variable(phi)).links) {
      const long double vx = link.x.slope() * omega, vy = link.y.slope() * omega, rate = link.angle.slope() * omega;
      energy += 0.5L * (link.mass * (vx * vx + vy * vy) + link.inertia * rate * rate);
    }
    return static_cast<double>(energy);
  }
  double potential_energy(double phi) override { return static_cast<double>(form(phi).potential_energy); }

 private:
  ClosedForm form(double phi) const { return closed_form_of(linkage_of(data_, phi)); }
  OwnMechanismData data_;
};

struct OwnMechanismKind {
  std::vector<Parameter> parameters;
  MakeMechanism make;
  double number = 0;
};
std::mutex own_mechanisms_mutex;
std::map<std::string, OwnMechanismKind>& own_mechanisms() {
  static std::map<std::string, OwnMechanismKind> kinds;
  return kinds;
}

Fields<OwnMechanismData> position_fields() {
  return Fields<OwnMechanismData>()
      .add(gravity_key(), &OwnMechanismData::gravity)
      .add({.name = "stroke_angle",
            .unit = "rad",
            .fallback = "\"0 deg\"",
            .doc = "direction of x above the horizontal; -90 deg: the output works downwards"},
           &OwnMechanismData::elevation);
}

const Fields<Mounted<OwnMechanismData>>& own_mechanism_fields() {
  static const auto made =
      mounted(position_fields(), mounting("force on the output, or a list of them", slider_loads()));
  return made;
}

// A motion that is not periodic over one turn, or not finite, is refused before it is tabulated.
void check_motion(const OwnMechanismData& data) {
  for (const long double phi : {0.3L, 2.1L, 4.4L}) {
    const LinkagePosition at = data.motion(Taylor::variable(phi));
    if (at.links.empty() || at.links.size() > PlanarLinkage::most_bodies)
      throw std::invalid_argument(
          fmt::format("has {} links; must be 1 … {}", at.links.size(), +PlanarLinkage::most_bodies));
    for (const Link& link : at.links)
      if (!(link.mass >= 0 && link.inertia >= 0))
        throw std::invalid_argument(fmt::format("link \"{}\" has a negative mass or inertia", link.name));
    const ClosedForm form = closed_form_of(linkage_of(data, phi));
    if (!std::isfinite(form.inertia_curvature) || !std::isfinite(form.output_acceleration_ratio))
      throw std::invalid_argument(
          fmt::format("its motion is no number at φ = {:.0f}°", static_cast<double>(phi) * 180 / M_PI));
  }
}

void build_own_mechanism(const Section& section, Network& net, Messages& messages) {
  const OwnMechanismKind kind = [&] {
    const std::scoped_lock lock(own_mechanisms_mutex);
    return own_mechanisms().at(section.kind->name);
  }();
  const auto read = own_mechanism_fields().read(section, messages);
  const Parameters parameters = parameters_of(section, kind.parameters);
  OwnMechanismData data = read.linkage;
  data.kind = section.kind->name, data.number = kind.number, data.values = parameters.values();
  data.motion = kind.make(parameters);
  check_motion(data);
  build_mechanism(section, MechanismData(std::move(data)), read.mounting, {}, net, messages);
}

}  // namespace

std::vector<double> values_of(const OwnMechanismData& data) {
  std::vector<double> values = {data.number, data.gravity, data.elevation};
  values.insert(values.end(), data.values.begin(), data.values.end());
  return values;
}

LinkageDrawing drawing_of(const OwnMechanismData& data) {
  const int output = static_cast<int>(data.motion(Taylor::variable(0)).links.size()) + 1;
  return {.name = data.kind,
          .direction = data.elevation,
          .links = {{"crank", {0, 1}}, {"slider", {output}}},
          .fixed = {0},
          .output = output};
}

std::unique_ptr<MechanismBodies> own_bodies(const OwnMechanismData& data) { return std::make_unique<OwnBodies>(data); }

// The crank's axis, the centres of mass, the output.
std::vector<PlanePoint> places_of(const OwnMechanismData& data, double phi) {
  const LinkagePosition at = data.motion(Taylor::variable(phi));
  std::vector<PlanePoint> points = {{0, 0}};
  for (const Link& link : at.links)
    points.push_back({static_cast<double>(link.x.value()), static_cast<double>(link.y.value())});
  points.push_back({static_cast<double>(at.output.value()), 0});
  return points;
}

// Joints are unknown: two points replace them, by which the closing of a cycle is checked.
PlanarLinkage linkage_of(const OwnMechanismData& data, long double phi) {
  const LinkagePosition at = data.motion(Taylor::variable(phi));
  PlanarLinkage l;
  l.gravity = data.gravity, l.elevation = data.elevation;
  for (const Link& link : at.links)
    l.add({"link", link.mass, link.inertia, {link.x, link.y}, {cos(link.angle), sin(link.angle)}});
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"output", PlanarLinkage::frame, 0, {at.output, Taylor(1)}});
  l.load_at = {at.output, Taylor()};
  l.output[0] = at.output.value(), l.output[1] = at.output.slope(), l.output[2] = at.output.curvature();
  return l;
}

void refuse_forces_of_own(const Scene& scene, const std::string& wanted) {
  std::vector<std::string> known;
  for (const Kind& kind : mechanism_kinds()) known.push_back(kind.name);
  const std::scoped_lock lock(own_mechanisms_mutex);
  const Section* own = nullptr;
  for (const Section& section : scene.components) {
    const std::string& kind = section.kind->name;
    if (wanted.empty() && std::find(known.begin(), known.end(), kind) != known.end()) return;
    if (own_mechanisms().contains(kind) && (wanted.empty() ? own == nullptr : section.name == wanted)) own = &section;
  }
  if (!own) return;
  throw std::invalid_argument(
      fmt::format("{}: {} is a {}, a kind of its user's own, of which the motion of the links is known and no joint, "
                  "so that reactions have no place; ask run, steady or reduce, or describe it by one of {}",
                  scene.file, in_quotes(own->name), in_quotes(own->kind->name), listed(known)));
}

void add_mechanism(const std::string& kind, const std::string& doc, const std::vector<Parameter>& parameters,
                   const MakeMechanism& make) {
  std::vector<Key> keys = keys_of_parameters(kind, parameters, own_mechanism_fields().keys());
  const std::scoped_lock lock(own_mechanisms_mutex);
  if (own_mechanisms().contains(kind)) throw std::invalid_argument(fmt::format("kind {} is known", in_quotes(kind)));
  add_kind(on_a_shaft(kind, doc, std::move(keys), build_own_mechanism));
  const double number = static_cast<double>(own_mechanisms().size());
  own_mechanisms()[kind] = {parameters, make, number};
}

}  // namespace kurbel
