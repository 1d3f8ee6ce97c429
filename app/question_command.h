// question_command.h — questions as commands, with the options that each question declares.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "studies/question/question.h"

namespace kurbel::app {

// Command-line options from their declarations.
class DeclaredOptions {
 public:
  // Adds them to the command and stores the values when it is parsed. Must outlive the parsing.
  void add_to(OptionList& command, const std::vector<DeclaredOption>& options);
  GivenOptions given() const;

 private:
  struct Storage {
    std::string name, one;
    std::vector<std::string> several;
  };
  std::deque<Storage> storage_;
};

// The inquiry for a question; `scene` and `progress` must outlive it.
Inquiry inquiry_of(const Scene& scene, const StudyOptions& options, Progress& progress);

// Answers the question and presents the result; returns the exit code.
int answer(const Question& question, StudyOptions options, const GivenOptions& given);

}  // namespace kurbel::app
