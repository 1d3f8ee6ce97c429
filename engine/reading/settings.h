// settings.h — values given in addition to a scene, such as `--set` on a command line: main_coupling.stiffness=1 MN*m/rad.
//
//   PATH=VALUE   PATH: component.key, run.accuracy, press.load.nominal_force, gearbox.stages[2].module
//                VALUE: as in a scene, quotes may be omitted; empty: the key is removed, its default applies
//
// They are inserted into the scene's text, so that the scene read, shown, stored or compared is the one that ran. Faults
// in inserted text are located in the setting, others in the original file.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/messages.h"

namespace kurbel {

class SettledText {
 public:
  // A text without settings.
  SettledText(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}
  // Throws SceneError for a text that is not TOML, a setting without "=", an unknown path (with the nearest name), a path
  // within another.
  SettledText(const std::string& text, const std::string& file, const std::vector<std::string>& settings);

  const std::string& text() const { return text_; }
  const std::string& file() const { return file_; }
  const std::vector<std::string>& settings() const { return settings_; }
  // A fault of the settled text, located in the original file or in the setting.
  SceneError placed(const SceneError& error) const;

 private:
  struct Edit {
    std::size_t setting = 0;
    std::size_t begin = 0, length = 0;  // replaced, in the file's text
    std::string by = {};                // the new text: before, key, between, value, behind
    std::size_t value = 0;              // begin of the value in `by`
    std::size_t key = 0;                // begin of its key in the setting
    std::size_t settled_begin = 0;      // in the settled text
    bool quoted = false;                // quotes were added to the value
  };
  struct Segment {
    std::string name;
    std::size_t place = 0;  // in the setting, from 0
    int item = 0;           // of a list, from 1; 0: none
    bool operator<(const Segment& other) const { return name != other.name ? name < other.name : item < other.item; }
  };
  std::vector<Segment> path_of(std::size_t setting) const;
  Edit edit_of(std::size_t setting);
  const DocumentValue& item_of(std::size_t setting, const Segment& segment, const DocumentValue& value) const;
  Edit brought_in(std::size_t setting, const std::vector<Segment>& missing, const DocumentValue& document,
                  const DocumentValue& table, const std::string& value);
  void check_section(std::size_t setting, const Segment& first, const DocumentValue& document) const;
  Edit replaced(std::size_t setting, const Segment& segment, const DocumentValue& found,
                const std::string& value) const;
  Edit taken_away(std::size_t setting, const Segment& segment, const DocumentEntry& entry,
                  const DocumentValue* table) const;
  [[noreturn]] void refuse(std::size_t setting, std::size_t place, const std::string& why) const;
  Message in_setting(std::size_t setting, std::size_t place, const std::string& text) const;
  Message placed(const Message& message) const;

  std::string text_, file_, before_;  // before_: the file's own text
  std::vector<std::string> settings_;
  std::vector<Edit> edits_;      // along the text
  std::set<std::string> begun_;  // new sections and empty tables filled by an edit
};

}  // namespace kurbel
