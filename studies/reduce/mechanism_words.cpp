// mechanism_words.cpp — figures of the output's travel over the driving link's angle.
#include "studies/reduce/mechanism_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {
namespace {

// Of a driving link that turns and an output that turns round twice in a cycle.
std::string time_ratio(const Mechanism& m) {
  const std::vector<double>& ends = m.travel.reversals;
  if (ends.size() != 2 || m.arc()) return {};
  const double one = ends[1] - ends[0], other = m.cycle() - one, slow = std::max(one, other),
               quick = std::min(one, other);
  return fmt::format("; one stroke takes {:.5g}°, the other {:.5g}°: time ratio {:.4g}", slow / degree, quick / degree,
                     slow / quick);
}

std::string travel(const Mechanism& m) {
  if (m.arc()) return "its " + words_of_arc(m);
  if (m.travel.winding != 0) return fmt::format("its output goes round {:g} times as often as it", m.travel.winding);
  const char* unit = m.rocks() ? "deg" : "m";
  std::string centres;
  for (const double phi : m.travel.reversals)
    centres += fmt::format("{}{:.5g}°", centres.empty() ? "" : ", ", phi / degree);
  return fmt::format("{} {}, dead centres at φ = {}{}", m.rocks() ? "swing" : "stroke",
                     m.rocks() ? fmt::format("{:.6g}°", m.stroke() / degree) : with_unit(m.stroke(), unit, 6), centres,
                     time_ratio(m));
}

}  // namespace

std::vector<std::string> mechanism_words(const Model& model) {
  std::vector<std::string> words;
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    if (!element) continue;
    const std::vector<std::string> about = element->mechanism().data.about();
    for (const std::string& line : about) words.push_back(element->mechanism().name + ": " + line);
    if (!about.empty()) words.push_back(element->mechanism().name + ": " + travel(element->mechanism()));
  }
  return words;
}

}  // namespace kurbel
