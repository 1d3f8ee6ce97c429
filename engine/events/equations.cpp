// equations.cpp — guards, and the modes that change when they fire: pieces of laws, contacts, steps of the sequence.
#include "engine/events/equations.h"

#include <set>

#include "engine/events/event_words.h"
#include "engine/events/reaction_sides.h"
#include "engine/numerics/fp_traps.h"

namespace kurbel {

Equations::Equations(std::shared_ptr<const Model> model, bool audit)
    : Flow(std::move(model), audit), contacts_(*this), switching_(*this), start_(*this, contacts_, switching_) {
  for (const auto& pool : this->model().pools) {
    guard_begin_.push_back(guard_count_);
    guard_count_ += static_cast<std::size_t>(pool->guard_count());
  }
  contact_guards_ = guard_count_;
  sequence_guard_ = contact_guards_ + contacts_.guard_count();
  guard_count_ = sequence_guard_ + (switching_.has_sequence() ? 1 : 0);
}

void Equations::modes_at(double t, std::span<const double> y) {
  for (const auto& pool : model().pools) pool->first_modes(instant(t, y), changing_modes().piece.data());
  OpenSides(*this).settle(t, y);
}

// ---------------------------------------------------------------------------------------------------------------------
// Guards

void Equations::guards(double t, std::span<const double> y, std::span<double> g) {
  [[maybe_unused]] const FpTraps traps(y);
  const Model& m = model();
  const Instant now = instant(t, y);
  for (std::size_t p = 0; p < m.pools.size(); ++p) m.pools[p]->guards(now, g.data() + guard_begin_[p]);
  const bool evaluated = guard_reactions(*this, t, y, guard_begin_, g);
  if (contact_guards_ < sequence_guard_)
    contacts_.guards(t, y, evaluated, contacts_.guard_count(), g.data() + contact_guards_);
  if (switching_.has_sequence()) g[sequence_guard_] = switching_.guard(y, now.speed);
}

double Equations::guard(double t, std::span<const double> y, std::size_t which, std::span<double> g) {
  [[maybe_unused]] const FpTraps traps(y);
  const Instant now = instant(t, y);
  if (which >= sequence_guard_) return switching_.guard(y, now.speed);
  if (which >= contact_guards_) {
    contacts_.guards(t, y, false, which - contact_guards_, g.data() + contact_guards_);
    return g[which];
  }
  const auto [p, local] = pool_guard(which);
  model().pools[p]->guards(now, g.data() + guard_begin_[p]);
  if (is_side(*model().pools[p], local)) guard_reactions(*this, t, y, guard_begin_, g);
  return g[which];
}

Equations::PoolGuard Equations::pool_guard(std::size_t guard) const {
  std::size_t p = model().pools.size() - 1;
  while (guard_begin_[p] > guard) --p;
  return {p, static_cast<int>(guard - guard_begin_[p])};
}

std::string Equations::guard_owner(std::size_t guard) const {
  if (guard >= sequence_guard_) return "sequence";
  if (guard >= contact_guards_) return contacts_.owner(guard - contact_guards_);
  return label(pool_guard(guard)).component;
}

bool Equations::is_knot(std::size_t guard) const {
  if (guard >= contact_guards_) return false;
  const PoolGuard of = pool_guard(guard);
  return !model().pools[of.pool]->reacts() && label(of).what.empty();
}

GuardLabel Equations::label(const PoolGuard& guard) const {
  Instant modes_alone;
  modes_alone.mode = modes().piece.data();
  modes_alone.direction = modes().direction.data();
  return model().pools[guard.pool]->label(guard.local, modes_alone);
}

std::string Equations::regularise(const std::vector<std::size_t>& guards) {
  std::set<std::string> changed;
  for (const std::size_t guard : guards) {
    std::string what;
    if (guard >= contact_guards_) {
      what = contacts_.regularise(guard - contact_guards_);
    } else if (const PoolGuard of = pool_guard(guard);
               model().pools[of.pool]->regularise(of.local, changing_modes().piece.data())) {
      what = guard_owner(guard);
    }
    if (!what.empty()) changed.insert(what);
  }
  ties().make_rows();
  std::string text;
  for (const std::string& name : changed) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// ---------------------------------------------------------------------------------------------------------------------
// Events and edges

// Gear losses of the present torques are needed next; they must not depend on the last evaluation.
void Equations::look_at_losses(double t, std::span<const double> y) {
  if (ties().lossy().empty()) return;
  try {
    evaluate(t, y);
  } catch (const Jam&) {  // which is why these modes change
  }
}

void Equations::fire(double t, std::span<double> y, const std::vector<std::size_t>& fired, EventLog& log) {
  look_at_losses(t, y);
  Contacts::Changes changes;
  for (const std::size_t guard : fired) {
    if (guard >= sequence_guard_) {
      switching_.take_steps(t, y, &log);
    } else if (guard >= contact_guards_) {
      contacts_.take(guard - contact_guards_, t, y, changes);
    } else {
      fire_piece(pool_guard(guard), t, y, log);
    }
  }
  OpenSides sides(*this);
  contacts_.settle(t, y, changes, &log);
  for (const auto& pool : model().pools) pool->follow_directions(instant(t, y), changing_modes().piece.data());
  sides.settle(t, y);
}

// Edges over the angle are named as such; elsewhere a label names the mode.
void Equations::fire_piece(const PoolGuard& guard, double t, std::span<const double> y, EventLog& log) {
  const ElementPool& pool = *model().pools[guard.pool];
  const GuardLabel before = pool.label(guard.local, instant(t, y));
  pool.fire(instant(t, y), guard.local, changing_modes().piece.data());
  const GuardLabel label = pool.label(guard.local, instant(t, y));
  const bool edge = pool.guards_are_of_angle();
  if (label.what.empty() || (!edge && label.what == before.what)) return;
  log.push_back(law_event(t, before, label, edge));
}

void Equations::pass_edge(double t, std::span<double> y, EventLog& log) {
  look_at_losses(t, y);
  switching_.pass_edge(t, y, log);
  OpenSides sides(*this);
  contacts_.settle(t, y, {}, &log);
  sides.settle(t, y);
}

bool Equations::stop_jam(double t, std::span<double> y, const std::vector<std::size_t>& guards, EventLog& log) {
  std::vector<std::size_t> of_contacts;  // other guards get numbers beyond the contacts
  for (const std::size_t guard : guards)
    of_contacts.push_back(guard < contact_guards_ ? contacts_.guard_count() : guard - contact_guards_);
  OpenSides sides(*this);
  const bool stopped = contacts_.stop_jam(t, y, of_contacts, log);
  sides.settle(t, y);
  return stopped;
}

}  // namespace kurbel
