// verb.h — a command says all of itself in its own file: name, purpose, options, action. Help, completion, manual page
// and docs/commands.md ask here.
//
//     const Verb check{{{.place = 120, .name = "check", .arguments = "scene.toml",
//                        .help = "validate a scene", .does = "validates only; …"},
//                       [](OptionList& command, int& code) { … }}};
//
// Questions are commands without more (studies/question): one of the same name here stands in the question's place.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/command.h"
#include "studies/question/question.h"

namespace kurbel::app {

struct VerbText : QuestionText {
  // Adds options; the action leaves its exit code in `code`.
  std::function<void(OptionList& command, int& code)> set_up = nullptr;
  bool of_scene = true;  // has the options that every study has; else all of its options are its own
};

// Registers it as long as the program runs.
class Verb {
 public:
  explicit Verb(VerbText text);
};
// Of a question, as its declaration says; it must outlive the program's commands.
VerbText verb_of(const Question& question);
// All that are registered, and all questions, by their places.
std::vector<VerbText> verbs();

// What stands between the marks in docs/kurbel.1, docs/commands.md and python/kurbel/__init__.pyi, and what completion asks
// for.
std::string verbs_as_manual();
std::string verbs_as_markdown();
std::string questions_as_stubs();  // of the Python module: a function each, options with their types
std::string names_of_verbs();      // a line each
std::string options_of_verb(const std::string& name);  // a line each; throws std::invalid_argument

}  // namespace kurbel::app
