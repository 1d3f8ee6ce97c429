// holders.h — what holds a machine at the end of a run (brakes, gears locked by their losses, what opposes motion), and
// what drives it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// By shaft: which ones gears, and those elastic joints for which it is true, join to this one.
std::vector<char> shafts_joined_to(const Model& model, std::size_t shaft,
                                   const std::function<bool(std::size_t)>& joins);

// Σ ω_e/ω_link τ_e over the drives joined to `shaft` without slip, and over the joints that slip between it and further
// drives, with what these transmit [N·m on the reduction link]. `now`: of `equations` in their modes.
double driving_torque(const Equations& equations, const Snapshot& now, std::size_t shaft);

class Holders {
 public:
  // Of what gears, springs, belts and closed clutches join to this shaft. `equations`: in the modes at the run's end `t`,
  // evaluated there last; they must outlive it.
  Holders(const Equations& equations, double t, std::size_t shaft);

  // An applied brake, by command or always, whose shaft stands; null: none. `put_on`: only of those off at the start.
  const std::string* brake(bool put_on = false) const;
  // A brake that is on, whose shaft still turns; null: none.
  const std::string* slipping_brake() const;
  // Relations whose losses hold what they join.
  std::vector<std::size_t> gears() const;
  // "gear", "bearing": the brakes, else components that oppose motion on standing shafts and gears locked by their losses.
  std::string components() const;
  // `load`, if one is among those that hold, or nothing is known; else their names.
  std::string beside(const char* load) const;
  // Whether any shaft among them stands.
  bool any() const;
  // What acts on those components, reduced to the link: the torque of their contacts, as in the notes on what is held [N·m].
  double torque() const;

 private:
  double command_of(const std::string& component) const;  // in force at the end; 1 if there is none
  bool stands(int node) const;
  std::vector<const Network::ShaftElement*> brakes_on() const;  // applied, whether their shafts stand or turn

  const Equations& equations_;
  const Model& m_;
  double end_;
  std::vector<char> joined_;    // by shaft
  std::vector<double> torque_;  // by contact, at the end [N·m]
};

}  // namespace kurbel
