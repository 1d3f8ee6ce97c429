// contact_words.cpp — contacts in words: what locks, slips and holds, who shares, and what is missing to move.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/events/contacts.h"
#include "engine/numerics/index.h"

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

std::string happening(const Contact& contact, int sense) {
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

}  // namespace

// "brake 62 %, bearing 38 %" where several elements hold one shaft.
std::string Contacts::sharing(const Contact& contact) const {
  if (contact.kind != Contact::Kind::frame) return {};
  const Model& m = flow_.model();
  std::map<std::string, double> capacity;
  double sum = 0;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e) {
    if (m.shaft_of_node[at(m.network.elements[e].node)] != contact.index) continue;
    const Hold& hold = flow_.ties().element_hold()[e];
    const double own =
        std::abs(m.gain_of_node[at(m.network.elements[e].node)]) * (hold.high - hold.low);  // on the merged shaft
    if (own <= 0) continue;
    capacity[m.network.elements[e].component] += own;
    sum += own;
  }
  if (capacity.size() < 2) return {};
  std::string text;
  for (const auto& [component, own] : capacity)
    text += fmt::format("{}{} {:.3g} %", text.empty() ? "" : ", ", component, 100 * own / sum);
  return text;
}

void Contacts::tell(double t, const std::vector<std::size_t>& among, const std::vector<int>& before,
                    const std::vector<std::size_t>& always, EventLog& log) const {
  for (const std::size_t c : among) {
    const Contact& contact = list()[c];
    const int now = sense(c);
    if (now == before[c] && !std::count(always.begin(), always.end(), c)) continue;
    log.push_back({.t = t,
                   .component = contact.name,
                   .what = happening(contact, now),
                   .from = mode_name(contact, before[c]),
                   .kind = kind_of(contact, now)});
    if (now != 0) continue;
    if (const std::string shares = sharing(contact); !shares.empty())
      log.push_back({.t = t,
                     .component = contact.name,
                     .what = "is held in proportion to capacity: " + shares,
                     .kind = EventKind::shares});
  }
}

// "press.load, bearing": what can hold there.
std::string Contacts::holders(const Contact& contact) const {
  if (contact.kind != Contact::Kind::frame) return contact.name;
  const Model& m = flow_.model();
  std::set<std::string> names;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e) {
    const Hold& hold = flow_.ties().element_hold()[e];
    if (m.shaft_of_node[at(m.network.elements[e].node)] == contact.index && hold.high - hold.low > 0)
      names.insert(m.network.elements[e].component);
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? contact.name : text;
}

std::vector<std::string> Contacts::held(double t, std::span<const double> y) {
  std::vector<std::string> words;
  bool any = false;
  for (std::size_t c = 0; c < list().size(); ++c)
    any = any || (list()[c].kind != Contact::Kind::connection && sense(c) == 0);
  if (!any) return words;
  try {
    flow_.evaluate(t, y);
  } catch (const Jam&) {  // at its very end: nothing can be said
    return words;
  }
  flow_.ties().find_holds(flow_.now());
  for (std::size_t c = 0; c < list().size(); ++c) {
    const Contact& contact = list()[c];
    if (!is_open(c) || contact.kind == Contact::Kind::connection) continue;
    const Hold hold = flow_.ties().limits(c);
    const double acts = flow_.ties().torque(c);
    const auto side = [&](double limit, const char* way) {
      return std::abs(limit) > Ties::most_capacity * contact.torque_scale
                 ? fmt::format("{}: it locks itself", way)
                 : fmt::format("{}: {:.4g} N·m are held, {:.4g} N·m are missing", way, limit, std::abs(limit - acts));
    };
    words.push_back(fmt::format("\"{}\" is held at the end by {}: {:.4g} N·m act; {}; {}", contact.name,
                                holders(contact), acts, side(hold.high, "forwards"), side(hold.low, "backwards")));
  }
  return words;
}

}  // namespace kurbel
