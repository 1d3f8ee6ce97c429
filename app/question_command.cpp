// question_command.cpp — a question's options on the command line, and its answer.
#include "app/question_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "app/verb.h"
#include "engine/scene/document.h"

namespace kurbel::app {

void DeclaredOptions::add_to(OptionList& command, const std::vector<DeclaredOption>& options) {
  for (const DeclaredOption& option : options) {
    const OptionText& text = option.text;
    const auto dashed = [](std::string name) {
      std::replace(name.begin(), name.end(), '_', '-');
      return "--" + name;
    };
    Storage& storage = storage_.emplace_back(Storage{text.name, {}, {}});
    const std::string name = text.by_place ? text.name : dashed(text.name);
    if (option.form == OptionForm::flag) {
      command.add_flag(
          name, [&storage] { storage.one = "true"; }, text.doc);
    } else if (option.form == OptionForm::one) {
      command.add_option(name, storage.one, text.doc).required(text.by_place);
    } else {
      Option added = command.add_option(name, storage.several, text.doc);
      if (text.count > 0)
        added.values(text.least > 0 ? text.least : text.count, text.count);
      else if (!text.words)  // a scene after it is not one of its values
        added.repeatable().one_value_each_time();
    }
  }
}

GivenOptions DeclaredOptions::given() const {
  GivenOptions given;
  for (const Storage& storage : storage_) {
    if (!storage.one.empty()) given.emplace_back(storage.name, storage.one);
    for (const std::string& value : storage.several) given.emplace_back(storage.name, value);
  }
  return given;
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

VerbText verb_of(const Question& question) {
  VerbText text{question};
  text.set_up = [&question](OptionList& command, int& code) {
    struct Asked {
      StudyOptions study;
      DeclaredOptions declared;
    };
    const auto asked = std::make_shared<Asked>();
    add_study_options(command, asked->study);
    command.option("scene").required(question.alone.empty());
    asked->declared.add_to(command, question.options);
    command.action([&code, &question, asked] { code = answer(question, asked->study, asked->declared.given()); });
  };
  return text;
}

}  // namespace kurbel::app
