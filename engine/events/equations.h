// equations.h — a compiled machine in motion: its flow, and the changes of modes at starts, events and edges.
//
//   start ──▶ (t, y, modes) ──flow──▶ … ──guard falls through zero, or edge──▶ fire, pass_edge ──▶ (t, y, modes′)
//
// Order of the guards: pieces of elements' laws, contacts, the operating sequence.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/equations/flow.h"
#include "engine/events/contacts.h"
#include "engine/events/event.h"
#include "engine/events/start.h"
#include "engine/events/switching.h"

namespace kurbel {

class Equations final : public Flow {
 public:
  // With an audit, the work of every account and the squares of the torques are integrated as well.
  Equations(std::shared_ptr<const Model> model, bool audit);

  // --- starts: a state and all its modes (start.h) ---
  std::vector<double> start(double t) { return start(t, model().scene.run.start); }
  std::vector<double> start(double t, const StartSettings& settings) { return start_.at(t, settings); }
  std::vector<double> state_of(double t, double link_angle, std::span<const double> twists,
                               std::span<const double> speeds) {
    return start_.with(t, link_angle, twists, speeds);
  }
  std::vector<double> modes_from_scratch(double t, double link_angle, double link_speed) {
    return start_.rigid(t, link_angle, link_speed);
  }
  // Sets the pieces of laws for this state; directions of motion are kept.
  void modes_at(double t, std::span<const double> y);

  // --- events ---
  std::size_t guard_count() const { return guard_count_; }
  // Positive while the modes hold, of order one.
  void guards(double t, std::span<const double> y, std::span<double> g);
  // One of them alone, without what others cost; g: memory for all.
  double guard(double t, std::span<const double> y, std::size_t which, std::span<double> g);
  // Changes the modes whose guards fired (y may be set exactly onto the event). Appends to `log`.
  void fire(double t, std::span<double> y, const std::vector<std::size_t>& fired, EventLog& log);
  double next_edge(double t) const { return switching_.next_edge(t); }
  void pass_edge(double t, std::span<double> y, EventLog& log);
  bool at_standstill(std::size_t shaft) const { return modes().direction[shaft] == 0; }
  // Gives the owners of these guards a law without events, permanently. Returns a description; empty: none has such a law.
  std::string regularise(const std::vector<std::size_t>& guards);
  std::string guard_owner(std::size_t guard) const;
  // A point between two pieces of a law, as of a table or a formula, that no event reports.
  bool is_knot(std::size_t guard) const;
  // For a motion that cannot continue (Contacts::stop_jam). False: nothing there moves.
  bool stop_jam(double t, std::span<double> y, const std::vector<std::size_t>& guards, EventLog& log);
  std::vector<std::string> held(double t, std::span<const double> y) { return contacts_.held(t, y); }

  // --- angles ---
  // Angles start from 4π · first (usually 0); a run that confirms another evaluates all laws at other angles.
  void keep_angles_from(double first) { changing_modes().first_two_turns = first; }
  bool wrap(std::span<double> y) { return kurbel::wrap(changing_modes(), y); }
  bool needs_wrap(std::span<const double> y) const { return kurbel::needs_wrap(modes(), y); }

 private:
  struct PoolGuard {
    std::size_t pool;
    int local;
  };
  PoolGuard pool_guard(std::size_t guard) const;
  GuardLabel label(const PoolGuard& guard) const;
  void fire_piece(const PoolGuard& guard, double t, std::span<const double> y, EventLog& log);
  void look_at_losses(double t, std::span<const double> y);

  Contacts contacts_;
  Switching switching_;
  Start start_;
  std::vector<std::size_t> guard_begin_;  // per pool
  std::size_t contact_guards_ = 0;        // index of the first guard of contacts
  std::size_t sequence_guard_ = 0;        // index of the guard of the sequence, if any
  std::size_t guard_count_ = 0;
};

}  // namespace kurbel
