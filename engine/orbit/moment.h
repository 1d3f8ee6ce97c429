// moment.h — a machine as it is at another moment than at the end of all switching: from then on nothing is switched.
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

// The scene with steps of its sequence that come later left waiting for ever. Of a time the run itself tells how many
// steps come before. Throws std::invalid_argument in words where there is no such step.
Scene as_of(const Scene& scene, const Effects& effects, const Moment& moment);
// Its network, whose windows stay open or shut as they are at that time; laws over time themselves go on.
Network network_as_of(const Scene& scene, const Moment& moment);

}  // namespace kurbel
