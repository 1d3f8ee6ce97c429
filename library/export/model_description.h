// model_description.h — the description of a component for importers: modelDescription.xml of FMI 2.0 and 3.0.
#pragma once

#include <string>

#include "library/export/export_machine.h"

namespace kurbel {

// Throws std::invalid_argument for a unit that neither version can describe.
std::string model_description(const ExportedComponent& component, int fmi);

}  // namespace kurbel
