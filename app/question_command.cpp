// question_command.cpp — a question as a command: its options on the command line, and its answer.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <stdexcept>

#include "app/command_line.h"
#include "app/verb.h"
#include "engine/scene/document.h"

namespace kurbel::app {
namespace {

struct Asked {
  struct Given {
    std::string name, one;
    std::vector<std::string> several;
  };
  StudyOptions study;
  std::deque<Given> options;
};

void add_options(OptionList& command, const std::vector<DeclaredOption>& options, Asked& asked) {
  for (const DeclaredOption& option : options) {
    const OptionText& text = option.text;
    const auto dashed = [](std::string name) {
      std::replace(name.begin(), name.end(), '_', '-');
      return "--" + name;
    };
    Asked::Given& given = asked.options.emplace_back(Asked::Given{text.name, {}, {}});
    const std::string name = text.by_place ? text.name : dashed(text.name);
    if (option.form == OptionForm::flag) {
      command.add_flag(
          name, [&given] { given.one = "true"; }, text.doc);
    } else if (option.form == OptionForm::one) {
      command.add_option(name, given.one, text.doc).required(text.required || text.by_place);
    } else {
      Option added = command.add_option(name, given.several, text.doc).required(text.required);
      if (text.count > 0)
        added.values(text.least > 0 ? text.least : text.count, text.count);
      else if (!text.words)  // a scene after it is not one of its values
        added.repeatable().one_value_each_time();
    }
  }
}

GivenOptions given_to(const Asked& asked) {
  GivenOptions all;
  for (const Asked::Given& given : asked.options) {
    if (!given.one.empty()) all.emplace_back(given.name, given.one);
    for (const std::string& value : given.several) all.emplace_back(given.name, value);
  }
  return all;
}

Inquiry inquiry_of(const Scene& scene, const StudyOptions& options, Progress& progress) {
  return {.scene = scene,
          .text = options.scene.empty() ? "" : read_text_file(options.scene, max_scene_bytes),
          .file = options.scene,
          .settings = options.set,
          .allowed = options.allow_files ? DataFiles::anywhere : DataFiles::below_the_scene,
          .watch = watch_of(options, progress),
          .page = !options.no_files,
          .author = options.author};
}

int answer(const Question& question, StudyOptions options, const GivenOptions& given) {
  for (const DeclaredOption& option : question.options)
    if (option.text.makes_a_file && options.no_files &&
        std::any_of(given.begin(), given.end(), [&](const auto& one) { return one.first == option.text.name; }))
      throw std::invalid_argument(
          fmt::format("--{0} with --no-files: the {0} is a file; omit one of the two", option.text.name));
  const Scene scene = options.scene.empty() ? Scene{} : read(options);
  Progress progress(options.quiet);
  const Inquiry inquiry = inquiry_of(scene, options, progress);
  if (options.scene.empty()) options.scene = question.alone;
  check_folder(options);
  return present(question.answer(inquiry, given), options);
}

}  // namespace

VerbText verb_of(const Question& question) {
  VerbText text{question};
  text.set_up = [&question](OptionList& command, int& code) {
    const auto asked = std::make_shared<Asked>();
    if (question.of_scene) {
      add_study_options(command, asked->study);
      command.option("scene").required(question.alone.empty());
    } else {
      asked->study.no_files = true;
    }
    add_options(command, question.options, *asked);
    command.action([&code, &question, asked] { code = answer(question, asked->study, given_to(*asked)); });
  };
  return text;
}

}  // namespace kurbel::app
