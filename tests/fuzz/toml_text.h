// toml_text.h — a tree of values written as TOML again, one line for each entry of the top.
#pragma once

#include <string>

#include "engine/scene/document.h"

namespace kurbel::fuzz {

std::string toml_text(const DocumentValue& value);
// Of a whole document.
std::string toml_document(const DocumentValue& table);

}  // namespace kurbel::fuzz
