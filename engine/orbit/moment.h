// moment.h — a machine at an earlier moment than the end of all switching; after this moment nothing is switched.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/model/model.h"

namespace kurbel {

struct Moment {
  std::optional<std::size_t> after_step;  // of the operating sequence, counted from 1
  std::optional<double> time;             // [s]
  bool any() const { return after_step || time; }
  std::string describe() const;  // "after step 2", "before step 1"; empty: none
};

// The scene without the later steps of its sequence, which wait forever. For a time, a run gives the number of steps before
// it. Throws std::invalid_argument if there is no such step.
Scene as_of(const Scene& scene, const Effects& effects, const Moment& moment);
// Its network, with the windows open or closed as at that time; laws over time continue.
Network network_as_of(const Scene& scene, const Moment& moment);

}  // namespace kurbel
