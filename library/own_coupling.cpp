// own_coupling.cpp — a coupling with a user-defined law: an element like any other. Also what such elements share.
#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <map>
#include <mutex>
#include <stdexcept>

#include "drivetrain/couplings/coupling_keys.h"
#include "engine/model/network.h"
#include "engine/numerics/roots.h"
#include "engine/scene/units.h"
#include "library/own_elements.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

//     τ = τ(θ, θ̇),   spring torque τ(θ, 0),   E = ∫ τ(θ, 0) dθ from 0 to θ
class OwnCoupling {
 public:
  static constexpr ConnectionTraits is{};

  OwnCoupling() = default;
  explicit OwnCoupling(std::shared_ptr<const CouplingLaw> law) : law_(std::move(law)) {
    const CouplingTorque rest = law_->torque(0, 0);
    if (rest.value != 0)
      throw std::invalid_argument(fmt::format("its torque untwisted and at rest is {:g} N·m; must be 0", rest.value));
    if (!(rest.by_twist > 0))
      throw std::invalid_argument(fmt::format("its stiffness at rest is {:g} N·m/rad; must be > 0", rest.by_twist));
  }

  template <class T>
  T torque(const Twist<T>& x) const {
    const CouplingTorque t = law_->torque(value_of(x.angle), value_of(x.rate));
    if constexpr (std::is_same_v<T, double>)
      return t.value;
    else
      return t.value + t.by_twist * (x.angle - value_of(x.angle)) + t.by_rate * (x.rate - value_of(x.rate));
  }
  double spring_torque(double twist) const { return law_->torque(twist, 0).value; }
  double stiffness_at_rest() const { return law_->torque(0, 0).by_twist; }
  double energy(double twist) const {
    const auto spring = [&](double at) { return spring_torque(at); };
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(spring, 0, twist, 8, 1e-13);
  }
  // Outwards from rest until the law reaches this torque.
  double twist_at(double torque) const {
    if (torque == 0) return 0;
    const auto missing = [&](double twist) { return spring_torque(twist) - torque; };
    double near = 0, far = torque / stiffness_at_rest();
    for (int i = 0; i < 60; ++i, near = far, far *= 2)
      if ((missing(far) >= 0) == (torque > 0)) return find_root(missing, near, missing(near), far, missing(far));
    throw std::runtime_error(fmt::format("a coupling's own law transmits no torque of {:g} N·m", torque));
  }

 private:
  std::shared_ptr<const CouplingLaw> law_;
};

struct OwnCouplingKind {
  std::vector<Parameter> parameters;
  MakeCoupling make;
};
std::mutex own_couplings_mutex;
std::map<std::string, OwnCouplingKind>& own_couplings() {
  static std::map<std::string, OwnCouplingKind> kinds;
  return kinds;
}

void build_own_coupling(const Section& section, Network& net, Messages& messages) {
  const OwnCouplingKind kind = [&] {
    const std::scoped_lock lock(own_couplings_mutex);
    return own_couplings().at(section.kind->name);
  }();
  const SideInertias inertia = side_inertia_fields().read(section, messages);
  const auto [in, out] = two_shafts(section, inertia, net);
  net.connect(in, out, 1, section.name, OwnCoupling(kind.make(parameters_of(section, kind.parameters))));
}

}  // namespace

std::vector<Key> keys_of_parameters(const std::string& kind, const std::vector<Parameter>& parameters,
                                    const std::vector<Key>& others) {
  std::vector<Key> keys;
  for (const Parameter& p : parameters) {
    const auto is_this = [&](const Key& key) { return key.name == p.name; };
    if (std::any_of(keys.begin(), keys.end(), is_this) || std::any_of(others.begin(), others.end(), is_this))
      throw std::invalid_argument(fmt::format("kind {}: key {} stands twice", in_quotes(kind), in_quotes(p.name)));
    UnitError error;
    if (!p.unit.empty() && !parse_quantity("1 " + p.unit, error))
      throw std::invalid_argument(fmt::format("kind {}: key {}: {}", in_quotes(kind), p.name, error.text));
    keys.push_back(
        {.name = p.name, .unit = p.unit, .fallback = p.fallback, .doc = p.doc, .required = p.fallback.empty()});
  }
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

Parameters parameters_of(const Section& section, const std::vector<Parameter>& declared) {
  std::vector<std::pair<std::string, double>> all;
  for (const Parameter& p : declared) all.emplace_back(p.name, section.number_or(p.name, 0));
  return Parameters(std::move(all));
}

double Parameters::operator[](const std::string& name) const {
  for (const auto& [key, value] : all_)
    if (key == name) return value;
  throw std::out_of_range(fmt::format("no parameter {} was declared", in_quotes(name)));
}

std::vector<double> Parameters::values() const {
  std::vector<double> values;
  for (const auto& [key, value] : all_) values.push_back(value);
  return values;
}

void add_coupling(const std::string& kind, const std::string& doc, const std::vector<Parameter>& parameters,
                  const MakeCoupling& make) {
  std::vector<Key> keys = keys_of_parameters(kind, parameters, side_inertia_fields().keys());
  const std::scoped_lock lock(own_couplings_mutex);
  if (own_couplings().contains(kind)) throw std::invalid_argument(fmt::format("kind {} is known", in_quotes(kind)));
  add_kind(elastic_between_shafts(kind, doc, std::move(keys), build_own_coupling));
  own_couplings()[kind] = {parameters, make};
}

}  // namespace kurbel
