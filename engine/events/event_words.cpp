// event_words.cpp — events in English.
#include "engine/events/event_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

std::string mode_name(const Contact& contact, int sense) {
  const bool frame = contact.kind != Contact::Kind::connection;
  if (sense == 0) return frame ? "at rest" : "locked";
  if (frame) return sense > 0 ? "moving forwards" : "moving backwards";
  return sense > 0 ? "slipping forwards" : "slipping backwards";
}

EventKind kind_of(const Contact& contact, int sense) {
  if (contact.kind == Contact::Kind::connection) return sense == 0 ? EventKind::lock : EventKind::slip;
  if (sense != 0) return EventKind::motion;
  return contact.kind == Contact::Kind::frame ? EventKind::rest : EventKind::held;
}

std::string change_of(const Contact& contact, int sense) {
  switch (contact.kind) {
    case Contact::Kind::connection:
      return sense == 0 ? "locks" : sense > 0 ? "slips forwards" : "slips backwards";
    case Contact::Kind::loss:
      if (sense == 0) return "is held by its losses";
      break;
    case Contact::Kind::frame:
      if (sense == 0) return "comes to rest and is held";
      break;
  }
  return sense > 0 ? "moves forwards" : "moves backwards";
}

// Four digits, however large or small the number is.
std::string without_exponent(double value) {
  value += 0.0;  // no −0
  const int before = value == 0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  std::string text = fmt::format("{:.{}f}", value, std::max(0, 4 - before));
  if (before < 4) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string command_text(double to) { return to == 0 ? "off" : to == 1 ? "on" : fmt::format("{:.4g}", to); }

}  // namespace

Event law_event(double t, const GuardLabel& before, const GuardLabel& now, bool edge_over_angle) {
  const bool impact = now.kind == EventKind::touch && before.kind == EventKind::flight;
  return {.t = t,
          .component = now.component,
          .what = now.what,
          .from = edge_over_angle ? "" : before.what,
          .kind = impact ? EventKind::impact : now.kind,
          .value = now.value};
}

Event contact_event(double t, const Contact& contact, int before, int now) {
  return {.t = t,
          .component = contact.name,
          .what = change_of(contact, now),
          .from = mode_name(contact, before),
          .kind = kind_of(contact, now),
          .value = now};
}

Event shares_event(double t, const Contact& contact, const Shares& shares) {
  std::string text;
  for (const auto& [component, share] : shares)
    text += fmt::format("{}{} {:.3g} %", text.empty() ? "" : ", ", component, 100 * share);
  return {.t = t,
          .component = contact.name,
          .what = "is held in proportion to capacity: " + text,
          .kind = EventKind::shares};
}

Event jam_event(double t, const Contact& contact) {
  return {.t = t,
          .component = contact.name,
          .what = "jams: no acceleration satisfies its friction; it stops at once",
          .kind = EventKind::jam};
}

Event command_event(double t, const std::string& component, double before, double to, double over) {
  return {.t = t,
          .component = component,
          .what = over > 0 ? fmt::format("goes to {} within {:.4g} s", command_text(to), over)
                           : fmt::format("is set {}", command_text(to)),
          .from = command_text(before),
          .kind = EventKind::command,
          .value = to};
}

Event late_cycle_event(double t, double took, double every) {
  return {.t = t,
          .component = "sequence",
          .what = fmt::format("begins a repetition late: the one before took {:.5g} s, every = {:.5g} s", took, every),
          .kind = EventKind::note,
          .value = took};
}

Event window_event(double t, const std::string& component, bool on) {
  return {.t = t,
          .component = component,
          .what = on ? "on" : "off",
          .from = on ? "off" : "on",
          .kind = EventKind::window,
          .value = on};
}

Event modes_event(double t, std::size_t contacts, bool fits, int changes) {
  return {.t = t,
          .component = "modes",
          .what = fmt::format("{} contacts at once; {} after {} change{}", contacts,
                              fits ? "a set that fits was found" : "no set fits, the nearest was taken", changes,
                              changes == 1 ? "" : "s")};
}

Event restless_event(double t, const std::string& owners, std::size_t events, double within) {
  return {.t = t,
          .component = owners,
          .what = fmt::format("{} events within {:.2g} s: the contact chatters; a law without events from here on",
                              events, within)};
}

std::string words_of(const Contact& contact, const std::string& holders, const Holding& holding) {
  constexpr double rounding = 1e-8;  // of what is held, or usual: nothing acts
  const double least = rounding * std::max({std::abs(holding.backwards), holding.forwards, contact.torque_scale});
  const double acts = std::abs(holding.acts) <= least ? 0 : holding.acts;
  constexpr double near = 0.9;  // what already acts counts towards it
  const auto side = [&](double limit, double missing, const char* way) {
    return std::max(std::abs(limit), missing) > near * holding.unbounded ? fmt::format("{}: it is self-locking", way)
           : missing <= least
               ? fmt::format("{}: any torque would move it", way)
               : fmt::format("{}: up to {} N·m are held, {} N·m more would move it{}", way,
                             without_exponent(std::abs(limit) <= least ? 0 : limit), without_exponent(missing),
                             std::abs(std::abs(limit - acts) - missing) <= least ? "" : ", for others hold with it");
  };
  const std::string held = fmt::format("\"{}\" is held at the end by {}: ", contact.name, holders);
  if (acts == 0 && holding.forwards <= least && holding.backwards >= -least)
    return held + "no torque acts, and any torque would move it";
  return fmt::format("{}the acting torque is {} N·m; {}; {}", held, without_exponent(acts),
                     side(holding.forwards, holding.missing_forwards, "forwards"),
                     side(holding.backwards, holding.missing_backwards, "backwards"));
}

}  // namespace kurbel
