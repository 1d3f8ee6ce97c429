// build_component.cpp — the one place where a kind's builder is called.
#include "engine/model/build_component.h"

#include <fmt/format.h>

#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/scene/keys.h"
#include "engine/scene/messages.h"

namespace kurbel {

void build_component(const Section& section, Network& network, Messages& messages) {
  Deadline::check();
  const auto refuse = [&](const std::exception& why) {
    messages.add(section.at, fmt::format("{} \"{}\": its values do not fit together: {}; check them, and their units",
                                         section.kind->name, section.name, why.what()));
  };
  try {
    section.kind->build(section, network, messages);
  } catch (const std::invalid_argument& error) {
    refuse(error);
  } catch (const std::runtime_error& error) {
    refuse(error);
  }
}

}  // namespace kurbel
