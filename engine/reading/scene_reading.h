// scene_reading.h — the steps of reading a scene, one file each, and their common data.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/scene.h"
#include "engine/values/data_files.h"

namespace kurbel {

// A start given for the output of a mechanism, in the document.
struct OutputStart {
  const DocumentEntry *on = nullptr, *position = nullptr, *velocity = nullptr, *towards = nullptr;
};

// A scene while it is read from the document.
struct SceneReading {
  const std::vector<Kind>& kinds;
  Messages messages;
  DataFiles allowed;
  DocumentValue document;
  Scene scene = {};
  std::map<std::string, std::size_t> index = {};  // of each component in scene.components
  std::set<std::string> unreadable = {};          // keys and tables rejected as a whole
  const DocumentEntry* misplaced_line = nullptr;  // a `line` within a table
  OutputStart output_start = {};
  bool lines_valid = true;  // false: missing connections are a consequence of a reported error

  void refuse(Location at, const std::string& text) { messages.add(at, text); }
  std::vector<std::string> component_names() const;
  const Section* find(const std::string& name) const;
  // Only the first messages are shown: expensive explanations are omitted from the others.
  bool explains() const;
  std::string no_component(const std::string& name, const std::vector<std::string>& names) const;
};

// preparation.cpp: constants, formulas of them, tables used by name
void prepare_document(SceneReading& r);
bool is_table_of_tables(const DocumentValue& value);  // [table.gas], and no component named "table"

void read_components(SceneReading& r);         // component_reader.cpp
void read_lines(SceneReading& r);              // lines.cpp
void check_connections(SceneReading& r);       // also: every name exists, and is used once
void put_in_canonical_order(SceneReading& r);  // of lines and components, whatever their order in the file
void read_effects(SceneReading& r);            // effects_reader.cpp
void read_run(SceneReading& r);                // run_reader.cpp
void read_operation(SceneReading& r);          // in the same file
void read_figures(SceneReading& r);            // likewise: after the sequence
void read_cases(SceneReading& r);              // cases.cpp: only for scenes without other faults
void place_by_output(SceneReading& r);         // output_start.cpp: crank angle and speed from those of the output

}  // namespace kurbel
