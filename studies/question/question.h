// question.h — a question about a scene: its options, computation and findings. Registered once (question.cpp);
// commands, library, Python, completion, manual page and documents are generated from this list.
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

// A scene and the settings under which a question is asked; of a question without a scene an empty one.
struct Inquiry {
  const Scene& scene;
  std::string text = {}, file = {};        // as given, without the settings
  std::vector<std::string> settings = {};  // "main_coupling.stiffness=1 MN*m/rad"
  DataFiles allowed = DataFiles::below_the_scene;
  Watch watch = {};
  bool page = true;         // a page is written: data for its plots are recorded
  std::string author = {};  // for a worksheet

  bool without_scene() const { return text.empty(); }
  SimulateOptions simulation() const {
    SimulateOptions options;
    options.traces = page, options.watch = watch;
    return options;
  }
};

struct QuestionText {
  int place = 0;                       // sort key in lists
  std::string name;                    // "modes"
  std::string arguments = {};          // as in "kurbel modes scene.toml"
  std::string help;                    // one line, in kurbel --help
  std::string does;                    // for the manual page and docs/commands.md: Markdown without links
  std::string alone = {};              // not empty: may be asked without a scene; the name of such results
  bool of_scene = true;                // otherwise it has its own options alone, no scene and no results folder
  std::vector<std::string> more = {};  // further examples: "scene.toml --explain", followed by " | " and their purpose
};

struct Question : QuestionText {
  std::vector<DeclaredOption> options;
  // Reads options without an answer. Throws std::invalid_argument for invalid ones.
  std::function<void(const GivenOptions&, const Scene&)> check;
  // Throws std::invalid_argument for invalid options, SceneError for errors of the scene.
  std::function<StudyOutput(const Inquiry&, const GivenOptions&)> answer;
};

template <class Asked>
Question make_question(QuestionText text, OptionsOf<Asked> options, StudyOutput (*answer)(const Inquiry&, Asked)) {
  Question question{std::move(text), options.declared(), {}, {}};
  question.check = [name = question.name, options](const GivenOptions& given, const Scene& scene) {
    options.read(given, name, scene);
  };
  question.answer = [name = question.name, options = std::move(options), answer](const Inquiry& inquiry,
                                                                                 const GivenOptions& given) {
    return answer(inquiry, options.read(given, name, inquiry.scene));
  };
  return question;
}

// All questions, sorted by place.
const std::vector<Question>& questions();
// Throws std::invalid_argument that lists the available ones.
const Question& question_named(const std::string& name);

}  // namespace kurbel
