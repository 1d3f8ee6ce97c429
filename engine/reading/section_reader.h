// section_reader.h — reads one table of a scene file by the keys of its kind.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/keys.h"
#include "engine/values/data_files.h"

namespace kurbel {

// Reads the values of a table into a section of the given kind; faults go into `messages`. `what`: name of the table in
// messages: coupling "main_coupling". Keys in `passed_over` (such as `kind`) are skipped. Points of curves may be in files,
// of which only those `allowed` are read.
Section read_section(const DocumentValue& table, const Kind& kind, const std::string& name, const std::string& what,
                     Messages& messages, const std::vector<std::string>& passed_over = {},
                     DataFiles allowed = DataFiles::below_the_scene);

// The kind named by the table's `kind` key, or null with a message.
const Kind* read_kind(const DocumentValue& table, const std::vector<Kind>& kinds, const std::string& what, Location at,
                      Messages& messages);

}  // namespace kurbel
