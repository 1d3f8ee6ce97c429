// verb.h — a command says all of itself in its own file: name, purpose, options, action. Help, completion, manual page
// and docs/commands.md ask here.
//
//     const Verb modes{{.place = 70, .name = "modes", .arguments = "scene.toml",
//                       .help = "natural frequencies, …", .does = "natural frequencies, shapes, damping; …",
//                       .set_up = [](OptionList& command, int& code) { … }}};
#pragma once

#include <string>
#include <vector>

#include "app/command.h"

namespace kurbel::app {

struct VerbText {
  int place = 0;            // in lists, ascending
  std::string name;         // "modes"
  std::string arguments{};  // as in "kurbel modes scene.toml"
  std::string help;         // a line, in kurbel --help
  std::string does;         // for the manual page and docs/commands.md: Markdown without links
  // Adds options; the action leaves its exit code in `code`.
  void (*set_up)(OptionList& command, int& code) = nullptr;
  bool of_scene = true;             // has the options that every study has; else all of its options are its own
  std::vector<std::string> more{};  // further examples: "scene.toml --explain", with what they do behind " | "
};

// Registers it as long as the program runs.
class Verb {
 public:
  explicit Verb(VerbText text);
};
// All that are registered, by their places.
std::vector<VerbText> verbs();

// What stands between the marks in docs/kurbel.1, docs/commands.md and what completion asks for.
std::string verbs_as_manual();
std::string verbs_as_markdown();
std::string names_of_verbs();                          // a line each
std::string options_of_verb(const std::string& name);  // a line each; throws std::invalid_argument

}  // namespace kurbel::app
