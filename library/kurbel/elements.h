// elements.h — user-defined elements: the law of a coupling, the motion of a mechanism. Scenes use them like kurbel's own.
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
// A formula is written once, for any type of number: kurbel evaluates it with numbers that carry derivatives, so that
// its Jacobians are exact. Formulas must be smooth: the solver does not locate kinks, its steps fail there.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <kurbel/dual.h>
#include <kurbel/taylor.h>

namespace kurbel {

// A key of the element in a scene, required unless it has a fallback, written as in the file.
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

// A coupling's torque and its derivatives, for the Jacobian of the solver.
struct CouplingTorque {
  double value = 0;     // τ [N·m]
  double by_twist = 0;  // ∂τ/∂θ [N·m/rad]
  double by_rate = 0;   // ∂τ/∂θ̇ [N·m·s/rad]
};
// τ(θ, θ̇) with τ(0, 0) = 0, positive if it drives the following shaft. At rest it must rise with θ.
class CouplingLaw {
 public:
  virtual ~CouplingLaw() = default;
  // At a twist θ [rad] and its rate θ̇ [rad/s].
  virtual CouplingTorque torque(double twist, double rate) const = 0;
};

// A law from a formula τ(θ, θ̇) in (twist, rate) for any type of number. It is evaluated with Dual<2>, so that its
// derivatives are exact. Dual provides + − · /, sin, cos, sqrt, exp, tanh, abs, pow(x, n).
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

// Makes a law from one component's parameters. Throws std::invalid_argument with the reason for parameters that are
// inconsistent.
using MakeCoupling = std::function<std::shared_ptr<const CouplingLaw>(const Parameters&)>;
// Registers `kind` for all scenes read from now on. The component has two shafts, `inertia_in` and `inertia_out` as
// in kurbel's couplings, and its elasticity is an effect. Throws std::invalid_argument for a kind that exists.
void add_coupling(const std::string& kind, const std::string& doc, const std::vector<Parameter>& parameters,
                  const MakeCoupling& make);

// --- a mechanism ---

// Sine of a series, term by term from s′ = c a′, c′ = −s a′.
inline Taylor sin(const Taylor& a) {
  Taylor s(std::sin(a.c[0])), c(std::cos(a.c[0]));
  for (int k = 1; k <= Taylor::order; ++k) {
    for (int j = 1; j <= k; ++j) s.c[k] += j * a.c[j] * c.c[k - j] / k, c.c[k] -= j * a.c[j] * s.c[k - j] / k;
  }
  return s;
}
// Cosine of a series, likewise.
inline Taylor cos(const Taylor& a) {
  Taylor s(std::sin(a.c[0])), c(std::cos(a.c[0]));
  for (int k = 1; k <= Taylor::order; ++k) {
    for (int j = 1; j <= k; ++j) s.c[k] += j * a.c[j] * c.c[k - j] / k, c.c[k] -= j * a.c[j] * s.c[k - j] / k;
  }
  return c;
}

// A link at crank angle φ: position of its centre of mass, and orientation.
struct Link {
  std::string name;    // for messages and drawings
  double mass = 0;     // [kg], ≥ 0
  double inertia = 0;  // about its centre of mass [kg·m²], ≥ 0
  Taylor x;            // of its centre of mass [m]; axes of the mechanism, φ counter-clockwise from +x
  Taylor y;            // of its centre of mass [m]
  Taylor angle;        // orientation [rad]
};
// All links at one crank angle.
struct LinkagePosition {
  std::vector<Link> links;  // the crank first; at most five
  Taylor output;            // x [m] that loads act along
};

// From the crank angle φ [rad] to the links: one degree of freedom, period 2π. Taylor provides + − · /, sin, cos, sqrt.
using MechanismMotion = std::function<LinkagePosition(const Taylor& phi)>;
// Makes the motion from one component's parameters. Throws std::invalid_argument with the reason for parameters that
// are inconsistent.
using MakeMechanism = std::function<MechanismMotion(const Parameters&)>;
// Registers `kind`, with `phase`, `gravity`, `stroke_angle` and `load` as in kurbel's mechanisms. Variable inertia,
// weight and loads follow from the motion (I_r = Σ m v′² + J ϑ′²). Joint reactions are unknown: the study "forces"
// refuses it. Throws std::invalid_argument for a kind that exists.
void add_mechanism(const std::string& kind, const std::string& doc, const std::vector<Parameter>& parameters,
                   const MakeMechanism& make);

}  // namespace kurbel
