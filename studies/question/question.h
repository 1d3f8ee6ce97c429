// question.h — a question that is put to a scene: its options, what is computed, what is said of it. Registered once
// (question.cpp); commands, library, Python, completion, manual page and documents are made of this list.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/reading/read_scene.h"
#include "engine/scene/scene.h"
#include "studies/findings/output.h"
#include "studies/findings/watch.h"
#include "studies/question/option.h"
#include "studies/run/simulate.h"

namespace kurbel {

// A scene as it is put to a question.
struct Inquiry {
  const Scene& scene;
  std::string text, file;             // as they were given, without the settings
  std::vector<std::string> settings;  // "main_coupling.stiffness=1 MN*m/rad"
  DataFiles allowed = DataFiles::below_the_scene;
  Watch watch = {};
  bool page = true;         // one is written: what it draws is followed
  std::string author = {};  // of a worksheet
  bool dashes = false;      // options are told as the command line has them

  SimulateOptions simulation() const {
    SimulateOptions options;
    options.traces = page, options.watch = watch;
    return options;
  }
};

struct QuestionText {
  int place = 0;                       // in lists, ascending
  std::string name;                    // "modes"
  std::string arguments = {};          // as in "kurbel modes scene.toml"
  std::string help;                    // a line, in kurbel --help
  std::string does;                    // for the manual page and docs/commands.md: Markdown without links
  std::vector<std::string> more = {};  // further examples: "scene.toml --explain", with what they do behind " | "
};

struct Question : QuestionText {
  std::vector<DeclaredOption> options;
  // Throws std::invalid_argument for options that are none, SceneError for faults of the scene.
  std::function<StudyOutput(const Inquiry&, const GivenOptions&)> answer;
};

template <class Asked>
Question make_question(QuestionText text, OptionsOf<Asked> options, StudyOutput (*answer)(const Inquiry&, Asked)) {
  Question question{std::move(text), options.declared(), {}};
  question.answer = [name = question.name, options = std::move(options), answer](const Inquiry& inquiry,
                                                                                 const GivenOptions& given) {
    return answer(inquiry, options.read(given, name, inquiry.scene, inquiry.dashes));
  };
  return question;
}

// All, by their places.
const std::vector<Question>& questions();
// Throws std::invalid_argument, with those that there are.
const Question& question_named(const std::string& name);

}  // namespace kurbel
