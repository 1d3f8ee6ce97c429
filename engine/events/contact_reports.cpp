// contact_reports.cpp — reports of contacts: changes, shares of a holding torque, and the torque missing to move.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/events/contacts.h"
#include "engine/events/event_words.h"
#include "engine/numerics/index.h"

namespace kurbel {

// Shares of the capacity if several elements hold a shaft.
Shares Contacts::sharing(const Contact& contact) const {
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
  Shares shares;
  for (const auto& [component, own] : capacity) shares.emplace_back(component, own / sum);
  return shares;
}

void Contacts::report(double t, const std::vector<std::size_t>& among, const std::vector<int>& before,
                      const std::vector<std::size_t>& always, EventLog& log) const {
  for (const std::size_t c : among) {
    const Contact& contact = list()[c];
    const int now = sense(c);
    if (now == before[c] && !std::count(always.begin(), always.end(), c)) continue;
    log.push_back(contact_event(t, contact, before[c], now));
    if (now != 0) continue;
    if (const Shares shares = sharing(contact); !shares.empty()) log.push_back(shares_event(t, contact, shares));
  }
}

// "press.load, bearing": the elements that can hold there.
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
    words.push_back(words_of(contact, holders(contact),
                             {.acts = flow_.ties().torque(c),
                              .backwards = hold.low,
                              .forwards = hold.high,
                              .unbounded = Ties::most_capacity * contact.torque_scale}));
  }
  return words;
}

}  // namespace kurbel
