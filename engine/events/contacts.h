// contacts.h — sticking and slipping: guards of contacts, and the consistent set of modes.
//
// Every contact with zero slip speed may stick or slip in either direction. A set of modes is consistent if every stuck
// contact needs no more torque than it can hold, and every released one accelerates in its direction. First all stopped
// contacts stick; then the largest violation is changed until there is none; if this cycles, all sets of a few contacts
// are tried.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/equations/flow.h"
#include "engine/events/event.h"
#include "engine/events/event_words.h"

namespace kurbel {

class Contacts {
 public:
  // Changes the modes of this flow, which must outlive it.
  explicit Contacts(Flow& flow) : flow_(flow) {}

  // Two guards per contact, one per gear with losses.
  std::size_t guard_count() const { return 2 * list().size() + flow_.ties().lossy().size(); }
  // Positive while the modes hold, of order one. evaluated: the flow has been evaluated at this state. which: one of them;
  // beyond the last: all.
  void guards(double t, std::span<const double> y, bool evaluated, std::size_t which, double* g);
  // The contact, or the gear whose flanks change, of this guard.
  std::size_t contact_of(std::size_t guard) const;
  std::string owner(std::size_t guard) const { return list()[contact_of(guard)].name; }

  // Contacts that have stopped, and contacts that break away in a direction.
  struct Changes {
    std::vector<std::size_t> stopped;
    std::vector<std::pair<std::size_t, int>> released;
  };
  // Adds the change of a fired guard; flanks change at once.
  void take(std::size_t guard, double t, std::span<const double> y, Changes& changes);
  // Finds the consistent modes, and makes tied speeds equal.
  void settle(double t, std::span<double> y, const Changes& changes, EventLog* log);
  // Rows and shares at this state, without changes of modes.
  void tie(double t, std::span<const double> y);

  // If no set of modes continues the motion: the contacts that slip at these guards, or jammed last, stop at once by an
  // impact with the least loss of kinetic energy; parts joined by springs keep their speed, the lost energy is work of the
  // friction concerned. False: nothing there moves.
  bool stop_jam(double t, std::span<double> y, std::span<const std::size_t> guards, EventLog& log);
  // Gives the contact a law without events; returns a description, empty if there is none.
  std::string regularise(std::size_t guard);
  // Description of each holding contact: elements, acting torque, limits, and the torque missing to move it either way.
  std::vector<std::string> held(double t, std::span<const double> y);

 private:
  struct Misfit {
    double size = 0;
    std::size_t contact = 0;  // or relation + number of contacts
    int better = 0;
    double total = 0;  // of all
  };
  const std::vector<Contact>& list() const { return flow_.ties().contacts(); }
  Modes& modes() const { return flow_.changing_modes(); }
  int& sense(std::size_t contact) const { return sense_of(list()[contact], modes()); }
  bool is_open(std::size_t contact) const;
  bool is_given(std::size_t contact) const { return is_prescribed(list()[contact], flow_.model()); }
  double slip_speed(std::size_t contact, const Instant& now) const {
    return sum_over(list()[contact].motion, now.speed);
  }
  void find_capacities();
  void slip_as_given(double t, std::span<const double> y);
  void tie_speeds(double t, std::span<double> y);
  bool evaluate_sharing(double t, std::span<const double> y, const std::vector<std::size_t>& among, Misfit& jammed);
  Misfit worst_misfit(double t, std::span<const double> y, const std::vector<std::size_t>& among);
  void consider(Misfit& worst, double size, std::size_t which, int better) const;
  void consider_contact(Misfit& worst, std::size_t contact, double t);
  void push(std::size_t contact, double torque, double t, std::vector<double>& alpha);
  bool gives_way(std::size_t contact, int way, double t);
  bool change_worst(double t, std::span<const double> y, const std::vector<std::size_t>& among, int& changes);
  bool try_all(double t, std::span<const double> y, const std::vector<std::size_t>& among,
               const std::vector<std::size_t>& fixed);
  bool release_otherwise(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                         const std::vector<std::pair<std::size_t, int>>& released);
  std::vector<std::size_t> jammed_contacts(std::span<const std::size_t> guards) const;
  int account_of_friction(const Contact& contact) const;
  // words (contact_reports.cpp)
  void report(double t, const std::vector<std::size_t>& among, const std::vector<int>& before,
              const std::vector<std::size_t>& always, EventLog& log) const;
  Shares sharing(const Contact& contact) const;
  bool all_hold(std::size_t contact, double torque, double t);
  double missing(std::size_t contact, int way, double t);
  std::string holders(const Contact& contact) const;

  Flow& flow_;
};

}  // namespace kurbel
