// sources.h — the driving elements of a machine, and whether they are active.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/model/model.h"

namespace kurbel {

class Sources {
 public:
  explicit Sources(const Model& m) {
    for (std::size_t e = 0; e < m.network.elements.size(); ++e)
      if (m.network.elements[e].element->account == Account::driving) elements_.push_back(e);
    for (const Network::Node& n : m.network.nodes)
      if (n.prescribed >= 0 && !m.network.prescribed[static_cast<std::size_t>(n.prescribed)].is_nothing())
        prescribed_ = true;
  }
  bool none() const { return elements_.empty() && !prescribed_; }
  // Whether something drives; `active` per element: within its window of time and switched on. A prescribed shaft always
  // drives.
  bool drive(const std::vector<char>& active) const {
    return prescribed_ ||
           std::any_of(elements_.begin(), elements_.end(), [&](std::size_t e) { return active[e] != 0; });
  }

 private:
  std::vector<std::size_t> elements_;
  bool prescribed_ = false;
};

}  // namespace kurbel
