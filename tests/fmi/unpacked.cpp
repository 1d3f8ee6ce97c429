// unpacked.cpp — the archive and its description, read without favour; libraries and their functions.
#include <dlfcn.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "tests/fmi/importer.h"

namespace importer {
namespace fs = std::filesystem;

std::string folder_of_its_own() {
  std::string pattern = (fs::temp_directory_path() / "kurbel_fmi_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no folder for the component: " + pattern);
  return pattern;
}

Unpacked::Unpacked(const fs::path& archive) {
  folder = folder_of_its_own();
  int error = 0;
  zip_t* const zip = zip_open(archive.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &error);
  if (!zip) throw std::runtime_error("no archive: " + archive.string());
  for (zip_int64_t k = 0; k < zip_get_num_entries(zip, 0); ++k) {
    const std::string name = zip_get_name(zip, static_cast<zip_uint64_t>(k), 0);
    complain_unless(name.find("..") == std::string::npos && name.front() != '/', "2.3/2.5: paths are relative");
    fs::create_directories((fs::path(folder) / name).parent_path());
    zip_file_t* const file = zip_fopen_index(zip, static_cast<zip_uint64_t>(k), 0);
    std::ofstream out(fs::path(folder) / name, std::ios::binary);
    char bytes[65536];
    for (zip_int64_t got; (got = zip_fread(file, bytes, sizeof bytes)) > 0;) out.write(bytes, got);
    zip_fclose(file);
  }
  zip_close(zip);
  read_description();
}

Unpacked::~Unpacked() { fs::remove_all(folder); }

std::string Unpacked::library() const {
  return folder + (fmi == 3 ? "/binaries/x86_64-linux/" : "/binaries/linux64/") + identifier + ".so";
}

const Variable& Unpacked::operator[](const std::string& name) const {
  const auto found = std::find_if(variables.begin(), variables.end(), [&](const auto& v) { return v.name == name; });
  if (found == variables.end()) throw std::runtime_error("no variable " + name);
  return *found;
}

namespace {

std::vector<unsigned> numbers(const char* text) {
  std::istringstream stream(text);
  std::vector<unsigned> all;
  for (unsigned n; stream >> n;) all.push_back(n);
  return all;
}

}  // namespace

void Unpacked::read_description() {
  pugi::xml_document document;
  if (!document.load_file((folder + "/modelDescription.xml").c_str())) throw std::runtime_error("no description");
  const pugi::xml_node root = document.document_element();
  complain_unless(std::string(root.name()) == "fmiModelDescription", "2.2.1: the root element");
  const std::string version = root.attribute("fmiVersion").value();
  complain_unless(version == "2.0" || version == "3.0", "2.2.1: fmiVersion");
  fmi = version == "3.0" ? 3 : 2;
  const bool three = fmi == 3;
  token = root.attribute(three ? "instantiationToken" : "guid").value();
  complain_unless(!token.empty() && root.attribute("modelName"), "2.2.1: token and model's name are required");
  // The order of elements is the schema's.
  const std::vector<std::string> order = {"ModelExchange",   "CoSimulation",  "ScheduledExecution", "UnitDefinitions",
                                          "TypeDefinitions", "LogCategories", "DefaultExperiment",  "VendorAnnotations",
                                          "ModelVariables",  "ModelStructure"};
  std::size_t last = 0;
  for (const pugi::xml_node element : root.children()) {
    const auto place = std::find(order.begin(), order.end(), element.name());
    complain_unless(place != order.end(), std::string("2.2.1: no such element ") + element.name());
    const auto at = static_cast<std::size_t>(place - order.begin());
    complain_unless(at >= last, std::string("2.2.1: order of elements, ") + element.name());
    last = at;
  }
  for (const char* kind : {"ModelExchange", "CoSimulation"})
    if (const pugi::xml_node node = root.child(kind)) {
      (kind[0] == 'M' ? model_exchange : co_simulation) = true;
      identifier = node.attribute("modelIdentifier").value();
      complain_unless(
          !identifier.empty() && identifier.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRST"
                                                              "UVWXYZ0123456789_") == std::string::npos,
          "2.1.1/2.2.2: modelIdentifier is a name of C");
      const std::set<std::string> known = three ? std::set<std::string>{"modelIdentifier",
                                                                        "needsExecutionTool",
                                                                        "canBeInstantiatedOnlyOncePerProcess",
                                                                        "canGetAndSetFMUState",
                                                                        "canSerializeFMUState",
                                                                        "providesDirectionalDerivatives",
                                                                        "providesAdjointDerivatives",
                                                                        "providesPerElementDependencies",
                                                                        "needsCompletedIntegratorStep",
                                                                        "providesEvaluateDiscreteStates",
                                                                        "canHandleVariableCommunicationStepSize",
                                                                        "maxOutputDerivativeOrder",
                                                                        "providesIntermediateUpdate",
                                                                        "mightReturnEarlyFromDoStep",
                                                                        "canReturnEarlyAfterIntermediateUpdate",
                                                                        "hasEventMode",
                                                                        "fixedInternalStepSize",
                                                                        "recommendedIntermediateInputSmoothness"}
                                                : std::set<std::string>{"modelIdentifier",
                                                                        "needsExecutionTool",
                                                                        "canBeInstantiatedOnlyOncePerProcess",
                                                                        "canNotUseMemoryManagementFunctions",
                                                                        "canGetAndSetFMUstate",
                                                                        "canSerializeFMUstate",
                                                                        "providesDirectionalDerivative",
                                                                        "completedIntegratorStepNotNeeded",
                                                                        "canHandleVariableCommunicationStepSize",
                                                                        "canInterpolateInputs",
                                                                        "maxOutputDerivativeOrder",
                                                                        "canRunAsynchronuously"};
      complain_unless(three || node.attribute("canNotUseMemoryManagementFunctions").as_bool(),
                      "3.3.1/4.3.1: the importer's memory is not taken, and that is not said");
      for (const pugi::xml_attribute a : node.attributes())
        complain_unless(known.count(a.name()) > 0, std::string("3.3/4.3: no such capability ") + a.name());
    }
  std::set<std::string> units, displays;
  for (const pugi::xml_node unit : root.child("UnitDefinitions").children("Unit")) {
    complain_unless(units.insert(unit.attribute("name").value()).second, "2.2.2: units have unique names");
    complain_unless(bool(unit.child("BaseUnit")), "2.2.2: a unit without definition");
    for (const pugi::xml_attribute exponent : unit.child("BaseUnit").attributes())
      this->units[unit.attribute("name").value()][exponent.name()] = exponent.as_int();
    for (const pugi::xml_node display : unit.children("DisplayUnit")) {
      displays.insert(display.attribute("name").value());
      complain_unless(display.attribute("factor").as_double() > 0, "2.2.2: a display unit without factor");
    }
  }
  std::set<std::string> names;
  std::set<unsigned> references;
  std::vector<pugi::xml_node> typed;
  for (const pugi::xml_node node : root.child("ModelVariables").children()) {
    const pugi::xml_node real = three ? node : node.child("Real");
    complain_unless(std::string(node.name()) == (three ? "Float64" : "ScalarVariable") && real, "2.2.7: type");
    Variable v;
    v.name = node.attribute("name").value();
    v.reference = node.attribute("valueReference").as_uint();
    v.causality = node.attribute("causality").value(), v.variability = node.attribute("variability").value();
    v.initial = node.attribute("initial").value(), v.unit = real.attribute("unit").value();
    if (real.attribute("start")) v.start = real.attribute("start").as_double();
    complain_unless(!v.name.empty() && names.insert(v.name).second, "2.2.7: unique names: " + v.name);
    complain_unless(node.attribute("valueReference") && references.insert(v.reference).second,
                    "2.2.7: value references: " + v.name);
    complain_unless(v.unit.empty() || units.count(v.unit), "2.2.7: a unit without definition: " + v.unit);
    const std::string display = real.attribute("displayUnit").value();
    complain_unless(display.empty() || displays.count(display), "2.2.7: a display unit without definition: " + display);
    const bool must_start = v.causality == "input" || v.causality == "parameter" || v.initial == "exact";
    complain_unless(v.start.has_value() == must_start, "2.2.7: start where it is required and only there: " + v.name);
    complain_unless(v.causality != "parameter" || v.variability == "fixed" || v.variability == "tunable",
                    "2.2.7: a parameter is fixed or tunable: " + v.name);
    complain_unless((v.causality != "input" && v.causality != "independent") || v.initial.empty(),
                    "2.2.7: no initial for inputs and time: " + v.name);
    complain_unless(v.causality != "output" || v.initial == "calculated" || v.initial == "approx",
                    "2.2.7: initial of an output: " + v.name);
    for (const char* limit : {"min", "max"})
      if (v.start && real.attribute(limit))
        complain_unless(limit[1] == 'i' ? *v.start >= real.attribute(limit).as_double()
                                        : *v.start <= real.attribute(limit).as_double(),
                        "2.2.7: start within its limits: " + v.name);
    variables.push_back(v);
    typed.push_back(real);
  }
  complain_unless(std::count_if(variables.begin(), variables.end(),
                                [](const Variable& v) { return v.causality == "independent"; }) <= 1,
                  "2.2.7: one time");
  complain_unless(!three || std::any_of(variables.begin(), variables.end(),
                                        [](const Variable& v) { return v.causality == "independent"; }),
                  "2.4.7: a time");
  if (three && co_simulation)
    for (std::size_t k = 0; k < variables.size(); ++k)
      complain_unless(variables[k].causality != "output" || variables[k].variability != "continuous" ||
                          typed[k].attribute("intermediateUpdate").as_bool(),
                      "2.4.7: an output that no onlooker may get: " + variables[k].name);
  const auto reference_by = [&](unsigned said) -> unsigned {
    if (three) {
      complain_unless(references.count(said) > 0, "2.2.8: no such value reference");
      return said;
    }
    complain_unless(said >= 1 && said <= variables.size(), "2.2.8: no such index");
    return variables[std::clamp<std::size_t>(said, 1, variables.size()) - 1].reference;
  };
  for (std::size_t k = 0; k < variables.size(); ++k)
    if (const pugi::xml_attribute of = typed[k].attribute("derivative"))
      variables[k].derivative_of = reference_by(of.as_uint());
  const auto find = [&](unsigned reference) {
    return *std::find_if(variables.begin(), variables.end(), [&](const auto& v) { return v.reference == reference; });
  };
  const pugi::xml_node structure = root.child("ModelStructure");
  std::set<unsigned> initial_unknowns, listed_outputs;
  const auto each = [&](const char* two, const char* name, const auto& act) {
    for (const pugi::xml_node node : three ? structure.children(name) : structure.child(two).children("Unknown"))
      act(reference_by(node.attribute(three ? "valueReference" : "index").as_uint()), node);
  };
  const auto read_dependencies = [&](unsigned reference, pugi::xml_node node) {
    if (!node.attribute("dependencies")) return;
    dependencies[reference] = {};
    std::size_t before = 0;
    for (const unsigned on : numbers(node.attribute("dependencies").value())) {
      const Variable known = find(reference_by(on));
      const bool is_state = std::any_of(variables.begin(), variables.end(),
                                        [&](const Variable& d) { return d.derivative_of == known.reference; });
      const bool tunable = three && known.causality == "parameter" && known.variability == "tunable";
      complain_unless(known.causality == "input" || known.causality == "independent" || tunable || is_state,
                      "2.2.8: a dependency that is not known: " + known.name);
      complain_unless(dependencies[reference].empty() || on > before, "2.2.8: dependencies in the order of variables");
      before = on;
      dependencies[reference].push_back(known.reference);
    }
  };
  each("Outputs", "Output", [&](unsigned reference, pugi::xml_node node) {
    read_dependencies(reference, node);
    complain_unless(find(reference).causality == "output", "2.2.8: what is no output");
    complain_unless(listed_outputs.insert(reference).second, "2.2.8: an output twice");
    outputs.push_back(reference);
  });
  each("Derivatives", "ContinuousStateDerivative", [&](unsigned reference, pugi::xml_node node) {
    const Variable v = find(reference);
    complain_unless(v.derivative_of.has_value(), "2.2.8: what is no derivative: " + v.name);
    derivatives.push_back(reference);
    states.push_back(v.derivative_of.value_or(0));
    read_dependencies(reference, node);
  });
  each("InitialUnknowns", "InitialUnknown", [&](unsigned reference, pugi::xml_node) {
    complain_unless(initial_unknowns.insert(reference).second, "2.2.8: an initial unknown twice");
  });
  std::set<unsigned> expected;
  for (const Variable& v : variables) {
    const bool state = std::find(states.begin(), states.end(), v.reference) != states.end();
    if (v.initial == "calculated" && (v.causality == "output" || state || v.derivative_of))
      expected.insert(v.reference);
    complain_unless(v.causality != "output" || listed_outputs.count(v.reference), "2.2.8: an output is not listed");
    complain_unless(!v.derivative_of || std::count(derivatives.begin(), derivatives.end(), v.reference) == 1,
                    "2.2.8: a derivative is not listed");
  }
  complain_unless(initial_unknowns == expected, "2.2.8: initial unknowns are outputs, states and derivatives");
  if (three)
    each("", "EventIndicator", [&](unsigned reference, pugi::xml_node) {
      complain_unless(find(reference).variability == "continuous", "2.4.8: an indicator is continuous");
      ++indicators;
    });
  else
    indicators = root.attribute("numberOfEventIndicators").as_uint();
  complain_unless(fs::exists(library()), "2.5/2.3: the binary has the identifier's name");
  for (const char* file : {"index.html", "licenses/license.txt"})
    complain_unless(fs::exists(folder + "/documentation/" + file), std::string("2.3/2.5.1: documentation/") + file);
}

// KURBEL_FMI_LIBRARY: one that is instrumented, in place of what the component holds (scripts/sanitize-components).
Library::Library(const std::string& path) {
  const char* const instrumented = std::getenv("KURBEL_FMI_LIBRARY");
  handle_ = dlopen(instrumented ? instrumented : path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) throw std::runtime_error(dlerror());
}
Library::~Library() { dlclose(handle_); }
void* Library::find(const std::string& function) const { return dlsym(handle_, function.c_str()); }

const std::vector<std::string>& functions_of(int fmi) {
  static const auto with = [](const char* prefix, const char* all) {
    std::istringstream stream(all);
    std::vector<std::string> names;
    for (std::string name; stream >> name;) names.push_back(prefix + name);
    return names;
  };
  static const std::vector<std::string> two = with(
      "fmi2",
      "GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment EnterInitializationMode "
      "ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean "
      "SetString GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate "
      "GetDirectionalDerivative EnterEventMode NewDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep "
      "SetTime "
      "SetContinuousStates GetDerivatives GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates "
      "SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep GetStatus GetRealStatus GetIntegerStatus "
      "GetBooleanStatus GetStringStatus");
  static const std::vector<std::string> three = with(
      "fmi3",
      "GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution "
      "FreeInstance EnterInitializationMode ExitInitializationMode EnterEventMode Terminate Reset GetFloat32 "
      "GetFloat64 "
      "GetInt8 GetUInt8 GetInt16 GetUInt16 GetInt32 GetUInt32 GetInt64 GetUInt64 GetBoolean GetString GetBinary "
      "GetClock "
      "SetFloat32 SetFloat64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 SetUInt64 SetBoolean "
      "SetString SetBinary SetClock GetNumberOfVariableDependencies GetVariableDependencies GetFMUState SetFMUState "
      "FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState GetDirectionalDerivative "
      "GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal GetIntervalFraction "
      "GetShiftDecimal GetShiftFraction SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction "
      "EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep SetTime "
      "SetContinuousStates GetContinuousStateDerivatives GetEventIndicators GetContinuousStates "
      "GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode "
      "GetOutputDerivatives DoStep ActivateModelPartition");
  return fmi == 3 ? three : two;
}

}  // namespace importer
