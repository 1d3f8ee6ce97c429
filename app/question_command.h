// question_command.h — commands that are questions: their options from the list that declares them.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "studies/question/question.h"

namespace kurbel::app {

// Options of a command line, as their declarations say.
class DeclaredOptions {
 public:
  // Adds them to the command; what is given stands here when it has been parsed. Must outlive the parsing.
  void add_to(OptionList& command, const std::vector<DeclaredOption>& options);
  GivenOptions given() const;

 private:
  struct Storage {
    std::string name, one;
    std::vector<std::string> several;
  };
  std::deque<Storage> storage_;
};

// The scene as it is put to a question; `scene` and `progress` must outlive it.
Inquiry inquiry_of(const Scene& scene, const StudyOptions& options, Progress& progress);

// Asks, and presents what is found: the exit code.
int answer(const Question& question, const StudyOptions& options, const GivenOptions& given);

}  // namespace kurbel::app
