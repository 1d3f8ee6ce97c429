// verb.h — a command is declared in its own file: name, purpose, options, action. Help, completion, manual page and
// docs/commands.md are generated from this.
//
//     const Verb check{{{.place = 120, .name = "check", .arguments = "scene.toml",
//                        .help = "validate a scene", .does = "validates only; …"},
//                       [](OptionList& command, int& code) { … }}};
//
// Every question is a command without further code (studies/question).
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
};

// Registers a command that is no question, for the lifetime of the program.
class Verb {
 public:
  explicit Verb(VerbText text);
};
// The command of a question, from its declaration; the question must outlive the program's commands.
VerbText verb_of(const Question& question);
// All registered commands and all questions, sorted by place.
std::vector<VerbText> verbs();

// Text between the marks in docs/kurbel.1, docs/commands.md and python/kurbel/__init__.pyi, and input of the
// completion.
std::string verbs_as_manual();
std::string verbs_as_markdown();
std::string questions_as_stubs();  // of the Python module: one function each, options with their types
std::string names_of_verbs();      // one per line
std::string options_of_verb(const std::string& name);  // one per line; throws std::invalid_argument

}  // namespace kurbel::app
