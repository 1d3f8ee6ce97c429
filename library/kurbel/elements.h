// elements.h — elements of one's own: a coupling's law, a mechanism's motion. Scenes then name them like kurbel's.
//
//     kurbel::add_coupling("cubic coupling", "k θ + κ θ³ + c θ̇",
//                          {{"stiffness", "N*m/rad"}, {"cubic", "N*m/rad3"}, {"damping", "N*m*s/rad"}},
//                          [](const kurbel::Parameters& p) {
//                            return kurbel::coupling_law([k = p["stiffness"], q = p["cubic"], c = p["damping"]](
//                                                            auto twist, auto rate) {
//                              return k * twist + q * twist * twist * twist + c * rate;
//                            });
//                          });
//
// Formulas are written once, for any type of number: kurbel asks them with numbers that carry their derivatives, so that
// its Jacobians are exact. They must be smooth; of kinks the solver would only see that steps fail.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <kurbel/dual.h>
#include <kurbel/taylor.h>

namespace kurbel {

// A key that the element has in a scene. Every key is required unless it has a fallback as it would stand in the file.
struct Parameter {
  std::string name;           // of the key: "stiffness"
  std::string unit;           // SI: "N*m/rad"; empty: a plain number
  std::string fallback = {};  // "\"0 N*m*s/rad\""; empty: the key is required
  std::string doc = {};       // for kurbel keys
};
// The values of one component's keys, in SI.
class Parameters {
 public:
  explicit Parameters(std::vector<std::pair<std::string, double>> all) : all_(std::move(all)) {}  // for kurbel itself
  double operator[](const std::string& name) const;  // throws std::out_of_range for a key that was not declared
  std::vector<double> values() const;                // in the order of their declaration

 private:
  std::vector<std::pair<std::string, double>> all_;
};

// --- a coupling ---

// A coupling's torque with its derivatives, which the solver's Jacobian is made of.
struct CouplingTorque {
  double value = 0;     // τ [N·m]
  double by_twist = 0;  // ∂τ/∂θ [N·m/rad]
  double by_rate = 0;   // ∂τ/∂θ̇ [N·m·s/rad]
};
// τ(θ, θ̇) with τ(0, 0) = 0, positive driving what stands behind in the line. At rest it must rise with θ.
class CouplingLaw {
 public:
  virtual ~CouplingLaw() = default;
  // At a twist θ [rad] and its rate θ̇ [rad/s].
  virtual CouplingTorque torque(double twist, double rate) const = 0;
};

// A law of a formula τ(θ, θ̇) in (twist, rate) for any type of number: it is asked with Dual<2>, so that its derivatives are
// exact. What a Dual knows: + − · /, sin, cos, sqrt, exp, tanh, abs, pow(x, n).
template <class F>
std::shared_ptr<const CouplingLaw> coupling_law(F formula) {
  struct Law final : CouplingLaw {
    F formula;
    explicit Law(F given) : formula(std::move(given)) {}
    CouplingTorque torque(double twist, double rate) const override {
      const Dual<2> t = formula(Dual<2>::input(twist, 0), Dual<2>::input(rate, 1));
      return {t.value, t.d[0], t.d[1]};
    }
  };
  return std::make_shared<const Law>(std::move(formula));
}

// From one component's parameters to its law. Throws std::invalid_argument in words for parameters that do not go
// together.
using MakeCoupling = std::function<std::shared_ptr<const CouplingLaw>(const Parameters&)>;
// Makes `kind` known to all scenes that are read from now on. The component has two shafts, with `inertia_in` and
// `inertia_out` as kurbel's couplings, and its elasticity is an effect. Throws std::invalid_argument for a kind that is
// known.
void add_coupling(const std::string& kind, const std::string& doc, const std::vector<Parameter>& parameters,
                  const MakeCoupling& make);

// --- a mechanism ---

// Of a series, term by term from s′ = c a′, c′ = −s a′.
inline Taylor sin(const Taylor& a) {
  Taylor s(std::sin(a.c[0])), c(std::cos(a.c[0]));
  for (int k = 1; k <= Taylor::order; ++k) {
    for (int j = 1; j <= k; ++j) s.c[k] += j * a.c[j] * c.c[k - j] / k, c.c[k] -= j * a.c[j] * s.c[k - j] / k;
  }
  return s;
}
// Likewise.
inline Taylor cos(const Taylor& a) {
  Taylor s(std::sin(a.c[0])), c(std::cos(a.c[0]));
  for (int k = 1; k <= Taylor::order; ++k) {
    for (int j = 1; j <= k; ++j) s.c[k] += j * a.c[j] * c.c[k - j] / k, c.c[k] -= j * a.c[j] * s.c[k - j] / k;
  }
  return c;
}

// A link at the crank's angle φ: where its centre of mass is, and which way it points.
struct Link {
  std::string name;    // for messages and drawings
  double mass = 0;     // [kg], ≥ 0
  double inertia = 0;  // about its centre of mass [kg·m²], ≥ 0
  Taylor x;            // of its centre of mass [m]; axes of the mechanism, φ counter-clockwise from +x
  Taylor y;            // of its centre of mass [m]
  Taylor angle;        // which way it points [rad]
};
// All links at one angle of the crank.
struct LinkagePosition {
  std::vector<Link> links;  // the crank first; at most five
  Taylor output;            // x [m] that loads act along
};

// From the crank's angle φ [rad] to the links: one degree of freedom, period 2π. A formula of Taylor: + − · /, sin, cos, sqrt.
using MechanismMotion = std::function<LinkagePosition(const Taylor& phi)>;
// From one component's parameters to its motion. Throws std::invalid_argument in words for parameters that do not go
// together.
using MakeMechanism = std::function<MechanismMotion(const Parameters&)>;
// Makes `kind` known, with `phase`, `gravity`, `stroke_angle` and `load` as kurbel's mechanisms have. Variable inertia,
// weight and loads follow from the motion (I_r = Σ m v′² + J ϑ′²). Reactions in joints are not known of it: the study
// "forces" refuses it. Throws std::invalid_argument for a kind that is known.
void add_mechanism(const std::string& kind, const std::string& doc, const std::vector<Parameter>& parameters,
                   const MakeMechanism& make);

}  // namespace kurbel
