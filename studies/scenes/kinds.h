// kinds.h — every kind of component that a scene may contain, for code that reads scenes.
#pragma once

#include <string>
#include <vector>

#include "engine/reading/read_scene.h"
#include "engine/scene/keys.h"

namespace kurbel {

// Drive first, mechanisms last.
const std::vector<Kind>& all_kinds();

// The table of all keys in Markdown, as docs/keys.md shows it.
std::string keys_in_markdown();

// Names accepted by keys_of: every kind of component, its nested sections, and "run".
std::vector<std::string> names_of_keys();

// The keys of one kind as aligned text. Throws std::invalid_argument for another name.
std::string keys_of(const std::string& kind);

// What holds for an effect that a scene does not mention: "off".
const char* unsaid_text(const EffectFlag& effect);

// What a scene's key of this name means, with the kinds that have it; each meaning once. Empty: no kind has such a key.
std::string meanings_of_key(const std::string& key);

// Registers a kind for all scenes read from now on; scenes read before are unaffected. Throws std::invalid_argument
// if a kind of this name exists. Safe to call from several threads.
void add_kind(Kind kind);

}  // namespace kurbel
