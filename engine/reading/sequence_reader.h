// sequence_reader.h — the operating sequence of a scene file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/scene.h"

namespace kurbel {

// Reads [sequence]; faults go into `messages`.
Sequence read_sequence(const DocumentValue& table, const std::vector<std::string>& components,
                       const std::function<bool(const std::string&)>& is_component, Messages& messages);

// Keys of [sequence] without its steps, and of a step; for the docs.
const std::vector<Key>& sequence_keys();
const std::vector<Key>& sequence_step_keys();

}  // namespace kurbel
