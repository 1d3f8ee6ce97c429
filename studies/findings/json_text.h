// json_text.h — JSON as it is written and printed: what is no UTF-8 is replaced, and no terminal obeys it.
#pragma once

#include <string>

#include "engine/scene/printable.h"

namespace kurbel {

template <class Json>
std::string json_text(const Json& json) {
  return printable_json(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace kurbel
