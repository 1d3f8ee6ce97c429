// contact_reports.cpp — reports of contacts: changes, shares of a holding torque, and the torque missing to move.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/events/contacts.h"
#include "engine/events/event_words.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double insignificant = 1e-9;  // of a further torque
constexpr int halvings = 60;

}  // namespace

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

// Whether all that hold together with this contact still hold with a further torque on it. The torques of ties are then
// those with it.
bool Contacts::all_hold(std::size_t c, double torque, double t) {
  const Ties& ties = flow_.ties();
  const std::vector<double> before = ties.torques().contact;
  std::vector<double> alpha = flow_.accelerations();
  push(c, torque, t, alpha);
  for (const std::size_t other : ties.contacts_in_rows()) {
    const double now = ties.torque(other);
    if (std::abs(now - before[other]) <= insignificant * std::abs(torque)) continue;  // elsewhere
    const Hold hold = ties.limits(other);
    if (now > hold.high || now < hold.low) return false;
  }
  return true;
}

// The further torque in this direction with which the first of them gives way; they share anew with every torque.
double Contacts::missing(std::size_t c, int way, double t) {
  const Ties::Torques known = flow_.ties().torques();
  const double scale = list()[c].torque_scale;
  const auto hold = [&](double torque) {
    flow_.ties().set_torques(known);
    return all_hold(c, way * torque, t);
  };
  double low = 0, high = scale;
  while (high <= 2 * Ties::most_capacity * scale && hold(high)) low = high, high *= 2;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (hold(middle) ? low : high) = middle;
  }
  flow_.ties().set_torques(known);
  return high;
}

#ifdef KURBEL_FMI_RUNTIME  // an exported component reports no notes
std::vector<std::string> Contacts::held(double, std::span<const double>) { return {}; }
#else
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
    const double acts = flow_.ties().torque(c);
    const Hold hold = flow_.ties().limits(c);
    const bool shared = flow_.ties().shares();
    if (shared && std::max(hold.high, -hold.low) <= 2 * Ties::least_capacity * contact.torque_scale) continue;
    words.push_back(words_of(contact, holders(contact),
                             {.acts = acts,
                              .backwards = hold.low,
                              .forwards = hold.high,
                              .missing_backwards = shared ? missing(c, -1, t) : acts - hold.low,
                              .missing_forwards = shared ? missing(c, 1, t) : hold.high - acts,
                              .unbounded = Ties::most_capacity * contact.torque_scale}));
  }
  return words;
}
#endif

}  // namespace kurbel
