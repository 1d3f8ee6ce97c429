// section_reader.h — one table of a scene file against the table of keys of its kind.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/data_files.h"
#include "engine/scene/document.h"
#include "engine/scene/keys.h"
#include "engine/scene/units.h"

namespace kurbel {

// Reads a table's values into a section of the given kind; whatever is wrong goes into `messages`.
// `what` names the table in messages: coupling "main_coupling". Keys in `passed_over` (such as `kind`) are read by
// somebody else. Curves may have their points in files, of which those `allowed` are read.
Section read_section(const DocumentValue& table, const Kind& kind, const std::string& name, const std::string& what,
                     Messages& messages, const std::vector<std::string>& passed_over = {},
                     DataFiles allowed = DataFiles::below_the_scene);

// The kind named by the table's `kind` key, or null with a message.
const Kind* read_kind(const DocumentValue& table, const std::vector<Kind>& kinds, const std::string& what, Location at,
                      Messages& messages);

// What must hold of a value in SI besides its domain, for its use to neither over- nor underflow; empty: it does.
std::string size_allowed(double value, const Dimension& dimension, const Domain& domain);

// Value in SI of a text such as "4 kN*m"; false with a message if it is none or has another dimension than `unit`.
bool read_quantity(const DocumentValue& value, const std::string& unit, const Domain& domain, const std::string& what,
                   Messages& messages, double& result);

}  // namespace kurbel
