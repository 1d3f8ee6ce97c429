// make_stepper.cpp — from the name of a method to the integrator.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "engine/base/enumerators.h"
#include "engine/steppers/butcher_tables.h"
#include "engine/steppers/explicit_runge_kutta.h"
#include "engine/steppers/stepper.h"
#include "engine/steppers/sundials_stepper.h"

namespace kurbel {
namespace {

constexpr std::pair<std::string_view, Method> methods[] = {
    {"work", Method::work_equation},    {"dopri5", Method::dormand_prince_54},
    {"verner6", Method::verner_65},     {"dop853", Method::dormand_prince_853},
    {"fehlberg8", Method::fehlberg_87}, {"adams", Method::adams},
    {"esdirk3", Method::esdirk_32},     {"esdirk", Method::esdirk_43},
    {"esdirk5", Method::esdirk_54},     {"bdf", Method::bdf}};

void check(const OdeSystem& system, const ErrorControl& control) {
  if (!(control.tolerance > 0) || !std::isfinite(control.tolerance))
    throw std::invalid_argument(fmt::format("error control: tolerance = {}; must be > 0", control.tolerance));
  if (control.scale.size() != system.size())
    throw std::invalid_argument(
        fmt::format("error control: {} scales for {} states; must be one each", control.scale.size(), system.size()));
  for (std::size_t i = 0; i < control.scale.size(); ++i) {
    if (!(control.scale[i] >= 0) || !std::isfinite(control.scale[i]))
      throw std::invalid_argument(
          fmt::format("error control: scale of state {} = {}; must be ≥ 0 and finite", i, control.scale[i]));
  }
}

}  // namespace

Method method_named(const std::string& name) {
  if (name == "auto") return Method::dormand_prince_853;
  std::string allowed = "auto";
  for (const auto& [known, method] : methods) {
    if (name == known) return method;
    allowed += fmt::format(", {}", known);
  }
  throw std::invalid_argument(fmt::format("method \"{}\" integrates no reduced model; allowed: {}", name, allowed));
}

std::string_view name_of(Method method) { return enumerator_name<Method::work_equation>(method); }

std::unique_ptr<Stepper> make_stepper(Method method, OdeSystem& system, ErrorControl control) {
  check(system, control);
  switch (method) {
    case Method::dormand_prince_54:
      return std::make_unique<ExplicitRungeKutta>(dormand_prince_54(), system, control);
    case Method::dormand_prince_853:
      return std::make_unique<ExplicitRungeKutta>(dormand_prince_853(), system, control);
    case Method::verner_65:
      return std::make_unique<ExplicitRungeKutta>(verner_65(), system, control);
    case Method::fehlberg_87:
      return std::make_unique<ExplicitRungeKutta>(fehlberg_87(), system, control);
    case Method::esdirk_32:
      return make_esdirk_stepper(3, system, control);
    case Method::esdirk_43:
      return make_esdirk_stepper(4, system, control);
    case Method::esdirk_54:
      return make_esdirk_stepper(5, system, control);
    case Method::bdf:
      return make_bdf_stepper(system, control);
    case Method::adams:
      return make_adams_stepper(system, control);
    case Method::work_equation:
      throw std::invalid_argument("the work equation is that of a machine; a WorkStepper integrates it");
  }
  throw std::invalid_argument(fmt::format("method {} is unknown", static_cast<int>(method)));
}

}  // namespace kurbel
