// model_description.cpp — attributes and elements in the order of the standards (2.0.4 section 2.2, 3.0 section 2.4).
#include "library/export/export_machine.h"

#include <fmt/format.h>

#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Role = ExportedVariable::Role;

// Display unit: value in it = factor · value in SI.
struct DisplayUnit {
  const char *unit, *display;
  double factor;
};
constexpr double pi = 3.14159265358979323846;
constexpr DisplayUnit display_units[] = {
    {"rad", "deg", 180 / pi}, {"rad/s", "rpm", 30 / pi}, {"N*m", "kN*m", 1e-3}, {"m", "mm", 1e3},
    {"N", "kN", 1e-3},        {"Pa", "bar", 1e-5},       {"W", "kW", 1e-3},     {"N*m/rad", "kN*m/rad", 1e-3}};

const DisplayUnit* display_of(const std::string& unit) {
  for (const DisplayUnit& one : display_units)
    if (unit == one.unit) return &one;
  return nullptr;
}
bool has_unit(const std::string& unit) { return !unit.empty() && unit != "1"; }

std::string number(double value) { return fmt::format("{}", value); }

class Description {
 public:
  Description(const ExportedComponent& component, int fmi)
      : c_(component), m_(component.machine), three_(fmi == 3), root_(document_.append_child("fmiModelDescription")) {}

  std::string text() {
    pugi::xml_node declaration = document_.prepend_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    write_root();
    if (m_.model_exchange) write_kind("ModelExchange");
    if (m_.co_simulation) write_kind("CoSimulation");
    write_units();
    pugi::xml_node categories = root_.append_child("LogCategories");
    for (const auto& [name, what] : {std::pair("logEvents", "events of the machine, with their times"),
                                     std::pair("logStatusError", "why a call was refused or failed")}) {
      pugi::xml_node category = categories.append_child("Category");
      category.append_attribute("name") = name;
      category.append_attribute("description") = what;
    }
    pugi::xml_node experiment = root_.append_child("DefaultExperiment");
    experiment.append_attribute("startTime") = "0";
    experiment.append_attribute("stopTime") = number(c_.until).c_str();
    experiment.append_attribute("tolerance") = number(c_.accuracy).c_str();
    experiment.append_attribute("stepSize") = number(c_.until / 1000).c_str();
    pugi::xml_node variables = root_.append_child("ModelVariables");
    for (std::size_t k = 0; k < c_.view.variables.size(); ++k)
      if (is_shown(c_.view.variables[k])) write_variable(variables, k);
    write_structure();
    std::ostringstream out;
    document_.save(out, "  ");
    return out.str();
  }

 private:
  // Version 2.0 has indicators by their number alone.
  bool is_shown(const ExportedVariable& v) const { return three_ || v.role != Role::indicator; }

  void write_root() {
    root_.append_attribute("fmiVersion") = three_ ? "3.0" : "2.0";
    root_.append_attribute("modelName") = (m_.title.empty() ? m_.name : m_.title).c_str();
    root_.append_attribute(three_ ? "instantiationToken" : "guid") = m_.token.c_str();
    root_.append_attribute("description") = fmt::format("kurbel: {}", m_.title.empty() ? m_.name : m_.title).c_str();
    root_.append_attribute("generationTool") = m_.version.c_str();
    root_.append_attribute("variableNamingConvention") = "flat";
    if (three_) return;
    std::size_t indicators = 0;
    for (const ExportedVariable& v : c_.view.variables) indicators += v.role == Role::indicator ? 1 : 0;
    root_.append_attribute("numberOfEventIndicators") = indicators;
  }

  void write_kind(const char* name) {
    const bool exchange = name[0] == 'M';
    pugi::xml_node kind = root_.append_child(name);
    const auto put = [&](const char* attribute, const char* value) { kind.append_attribute(attribute) = value; };
    put("modelIdentifier", m_.name.c_str());
    put("needsExecutionTool", "false");
    put("canBeInstantiatedOnlyOncePerProcess", "false");
    if (!three_) put("canNotUseMemoryManagementFunctions", "true");  // it takes none of the importer's
    put(three_ ? "canGetAndSetFMUState" : "canGetAndSetFMUstate", "true");
    put(three_ ? "canSerializeFMUState" : "canSerializeFMUstate", "true");
    put(three_ ? "providesDirectionalDerivatives" : "providesDirectionalDerivative", "true");
    if (three_) put("providesAdjointDerivatives", "true");
    if (exchange) {
      put(three_ ? "needsCompletedIntegratorStep" : "completedIntegratorStepNotNeeded", three_ ? "true" : "false");
      return;
    }
    put("canHandleVariableCommunicationStepSize", "true");
    put("maxOutputDerivativeOrder", "0");
    if (!three_) {
      put("canInterpolateInputs", "true");
      put("canRunAsynchronuously", "false");
      return;
    }
    put("providesIntermediateUpdate", "true");
    put("mightReturnEarlyFromDoStep", "false");
    put("canReturnEarlyAfterIntermediateUpdate", "true");
    put("hasEventMode", "false");
  }

  void write_units() {
    std::map<std::string, Dimension> units;
    for (const ExportedVariable& v : c_.view.variables) {
      if (!has_unit(v.unit)) continue;
      UnitError error;
      const std::optional<Unit> unit = parse_unit(v.unit, error);
      if (!unit || unit->factor != 1)
        throw std::invalid_argument(fmt::format("{} has the unit \"{}\", which is no SI unit", v.name, v.unit));
      units[v.unit] = unit->dimension;
    }
    if (units.empty()) return;
    pugi::xml_node definitions = root_.append_child("UnitDefinitions");
    for (const auto& [name, dimension] : units) {
      pugi::xml_node unit = definitions.append_child("Unit");
      unit.append_attribute("name") = name.c_str();
      pugi::xml_node base = unit.append_child("BaseUnit");
      constexpr const char* bases[] = {"kg", "m", "s", "rad", "A"};
      for (std::size_t k = 0; k < dimension.exponent.size(); ++k)
        if (dimension.exponent[k] != 0) base.append_attribute(bases[k]) = dimension.exponent[k];
      if (const DisplayUnit* display = display_of(name)) {
        pugi::xml_node shown = unit.append_child("DisplayUnit");
        shown.append_attribute("name") = display->display;
        shown.append_attribute("factor") = number(display->factor).c_str();
      }
    }
  }

  void write_variable(pugi::xml_node variables, std::size_t reference) {
    const ExportedVariable& v = c_.view.variables[reference];
    pugi::xml_node variable = variables.append_child(three_ ? "Float64" : "ScalarVariable");
    const auto put = [&](const char* name, const std::string& value) {
      variable.append_attribute(name) = value.c_str();
    };
    put("name", v.name);
    put("valueReference", std::to_string(reference));
    if (!v.description.empty()) put("description", v.description);
    const bool command = v.role == Role::input && m_.inputs[v.place].what == ExportedInput::What::command;
    const bool tunable = v.role == Role::parameter && m_.parameters[v.place].tunable;
    switch (v.role) {
      case Role::time:
        put("causality", "independent"), put("variability", "continuous");
        break;
      case Role::input:
        put("causality", "input"), put("variability", command ? "discrete" : "continuous");
        break;
      case Role::parameter:
        put("causality", "parameter"), put("variability", tunable ? "tunable" : "fixed"), put("initial", "exact");
        break;
      case Role::output:
        put("causality", "output"), put("variability", "continuous"), put("initial", "calculated");
        if (three_ && m_.co_simulation) put("intermediateUpdate", "true");
        break;
      case Role::peak:
        put("causality", "output"), put("variability", "discrete"), put("initial", "calculated");
        break;
      default:
        put("causality", "local"), put("variability", "continuous"), put("initial", "calculated");
    }
    pugi::xml_node real = three_ ? variable : variable.append_child("Real");
    if (has_unit(v.unit)) {
      real.append_attribute("unit") = v.unit.c_str();
      if (const DisplayUnit* display = display_of(v.unit)) real.append_attribute("displayUnit") = display->display;
    }
    if (v.role == Role::input) {
      const ExportedInput& input = m_.inputs[v.place];
      if (std::isfinite(input.low)) real.append_attribute("min") = number(input.low).c_str();
      if (std::isfinite(input.high)) real.append_attribute("max") = number(input.high).c_str();
      real.append_attribute("start") = number(input.start).c_str();
    }
    if (v.role == Role::parameter) real.append_attribute("start") = number(m_.parameters[v.place].start).c_str();
    if (v.role == Role::derivative) {
      const std::uint32_t state = c_.view.reference(Role::state, v.place);
      real.append_attribute("derivative") = three_ ? state : index_of(state);
    }
    // Events set speeds and subtract whole turns from angles.
    if (v.role == Role::state && m_.model_exchange) real.append_attribute("reinit") = "true";
  }

  // Version 2.0 counts variables from 1; the variables shown precede the hidden ones.
  static std::uint32_t index_of(std::uint32_t reference) { return reference + 1; }

  pugi::xml_node unknown(pugi::xml_node list, const char* name, std::uint32_t reference) {
    pugi::xml_node one = list.append_child(name);
    if (three_)
      one.append_attribute("valueReference") = reference;
    else
      one.append_attribute("index") = index_of(reference);
    return one;
  }
  // In the order of the variables: time, inputs, in version 3.0 tunable parameters, states. Without a statement all
  // knowns count.
  void write_dependencies(pugi::xml_node one, const ExportedDependency& on) {
    if (!on.known) return;
    std::vector<std::uint32_t> references;
    if (on.time) references.push_back(c_.view.reference(Role::time, 0));
    for (const std::size_t k : on.inputs) references.push_back(c_.view.reference(Role::input, k));
    for (std::size_t k = 0; three_ && k < m_.parameters.size(); ++k)
      if (m_.parameters[k].tunable) references.push_back(c_.view.reference(Role::parameter, k));
    for (const std::size_t k : on.states) references.push_back(c_.view.reference(Role::state, k));
    std::string text;
    for (const std::uint32_t reference : references)
      text += (text.empty() ? "" : " ") + std::to_string(three_ ? reference : index_of(reference));
    one.append_attribute("dependencies") = text.c_str();
  }

  void write_structure() {
    pugi::xml_node structure = root_.append_child("ModelStructure");
    const auto list = [&](const char* name) { return three_ ? structure : structure.append_child(name); };
    const auto each = [&](auto roles, const auto& act) {
      for (std::size_t k = 0; k < c_.view.variables.size(); ++k)
        if (roles(c_.view.variables[k].role)) act(static_cast<std::uint32_t>(k), c_.view.variables[k]);
    };
    const auto is_output = [](Role role) { return role == Role::output || role == Role::peak; };
    const auto is_derivative = [](Role role) { return role == Role::derivative; };
    if (three_ || !m_.outputs.empty() || !m_.peaks.empty()) {
      const pugi::xml_node outputs = list("Outputs");
      each(is_output, [&](std::uint32_t k, const ExportedVariable& v) {
        pugi::xml_node one = unknown(outputs, three_ ? "Output" : "Unknown", k);
        if (v.role == Role::output) write_dependencies(one, c_.dependencies.outputs[v.place]);
      });
    }
    if (three_ || !c_.dependencies.derivatives.empty()) {
      const pugi::xml_node derivatives = list("Derivatives");
      each(is_derivative, [&](std::uint32_t k, const ExportedVariable& v) {
        pugi::xml_node one = unknown(derivatives, three_ ? "ContinuousStateDerivative" : "Unknown", k);
        write_dependencies(one, c_.dependencies.derivatives[v.place]);
      });
    }
    const pugi::xml_node initial = list("InitialUnknowns");
    each([&](Role role) { return is_output(role) || is_derivative(role) || role == Role::state; },
         [&](std::uint32_t k, const ExportedVariable&) { unknown(initial, three_ ? "InitialUnknown" : "Unknown", k); });
    if (three_)
      each([](Role role) { return role == Role::indicator; },
           [&](std::uint32_t k, const ExportedVariable&) { unknown(structure, "EventIndicator", k); });
  }

  const ExportedComponent& c_;
  const ExportedMachine& m_;
  bool three_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace

std::string model_description(const ExportedComponent& component, int fmi) {
  return Description(component, fmi).text();
}

}  // namespace kurbel
