// data_fault.h — faults of a mechanism's data with messages, and the checks shared by mechanisms.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/linkages/mechanism_bodies.h"

namespace kurbel {

struct DataFault {
  std::string key;   // of a scene
  std::string text;  // what, got, allowed, next step
};
using DataFaults = std::vector<DataFault>;

// Collects what is wrong with values together: of each alone the domain stands in its key (mechanisms/kinds).
class DataChecks {
 public:
  // Of mass, centre of mass and inertia together; keys are name_mass, name_com, name_inertia.
  void pivoted(const std::string& name, const LinkBody& link);                            // inertia about its bearing
  void floating(const std::string& name, const LinkBody& link, double carried_mass = 0);  // central inertia
  void add(const std::string& key, std::string text) { faults_.push_back({key, std::move(text)}); }

  bool valid() const { return faults_.empty(); }
  DataFaults take() { return std::move(faults_); }

 private:
  DataFaults faults_;
};

// Links of the loop crank – coupler – rocker – ground, and their keys in the scene.
struct CrankRockerLoop {
  double crank, coupler, rocker, ground;  // [m], > 0
  const char *crank_name, *coupler_name, *rocker_name, *ground_name;
};
// The crank turns fully and the rocker rocks (Grashof, 1883): crank + any other link < sum of the remaining two.
void check_crank_rocker(const CrankRockerLoop& loop, DataChecks& checks);
// The loop can be closed, and its lengths are not ambiguously near to those with a change point.
void check_loop_closes(const CrankRockerLoop& loop, DataChecks& checks);

// Throws std::invalid_argument with the first fault.
void throw_if_any(const std::string& mechanism, const DataFaults& faults);

// "12.5 mm"
std::string in_mm(double metres);

// Minimum and maximum sine of the angles from … to (from ≤ to).
struct Range {
  double least, greatest;
};
Range sine_range(double from, double to);

}  // namespace kurbel
