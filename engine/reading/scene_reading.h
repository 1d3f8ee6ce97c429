// scene_reading.h — the parts of reading a scene, a file each, and what they share.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/scene.h"
#include "engine/values/data_files.h"

namespace kurbel {

// A start told for the output of a mechanism, as it stands in the document.
struct OutputStart {
  const DocumentEntry *on = nullptr, *position = nullptr, *velocity = nullptr, *towards = nullptr;
};

// A scene on its way from the document.
struct SceneReading {
  const std::vector<Kind>& kinds;
  Messages messages;
  DataFiles allowed;
  DocumentValue document;
  Scene scene = {};
  std::map<std::string, std::size_t> index = {};  // of each component in scene.components
  std::set<std::string> unreadable = {};          // keys and tables that were refused as a whole
  const DocumentEntry* misplaced_line = nullptr;  // a `line` within a table
  OutputStart output_start = {};
  bool lines_sound = true;  // false: what is not connected follows from an error that was named

  void refuse(Location at, const std::string& text) { messages.add(at, text); }
  std::vector<std::string> component_names() const;
  const Section* find(const std::string& name) const;
  // Of so many messages only the first are shown: what costs time to explain is left out of the rest.
  bool explains() const;
  std::string no_component(const std::string& name, const std::vector<std::string>& names) const;
};

// preparation.cpp: constants, formulas of them, tables used by name
void prepare_document(SceneReading& r);
bool is_table_of_tables(const DocumentValue& value);  // [table.gas], and no component named "table"

void read_components(SceneReading& r);         // component_reader.cpp
void read_lines(SceneReading& r);              // lines.cpp
void check_connections(SceneReading& r);       // and: every name exists, and stands in one place
void put_in_canonical_order(SceneReading& r);  // of lines and components, whatever their order in the file
void read_effects(SceneReading& r);            // effects_reader.cpp
void read_run(SceneReading& r);                // run_reader.cpp
void read_operation(SceneReading& r);          // of the same file
void read_cases(SceneReading& r);              // cases.cpp: of a scene that has no fault else
void place_by_output(SceneReading& r);  // output_start.cpp: angle and speed of the crank from those of its output

}  // namespace kurbel
