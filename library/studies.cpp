// studies.cpp — the questions by name: put to a machine, with their findings.
#include <algorithm>
#include <stdexcept>

#include "library/machine_parts.h"
#include "library/own_mechanism.h"
#include "studies/difference/difference.h"
#include "studies/question/question.h"
#include "studies/report/write_output.h"
#include "studies/tables/summary_tables.h"

namespace kurbel {

Inquiry inquiry_of(const MachineParts& machine, const Watcher& watcher) {
  return {.scene = machine.scene,
          .text = machine.text,
          .file = machine.file,
          .settings = machine.settings,
          .watch = watch_of(watcher)};
}

std::vector<std::string> study_names() {
  std::vector<std::string> names;
  for (const Question& question : questions()) names.push_back(question.name);
  return names;
}

std::vector<std::string> option_names(const std::string& study) {
  std::vector<std::string> names;
  for (const DeclaredOption& option : question_named(study).options) names.push_back(option.text.name);
  return names;
}

bool needs_machine(const std::string& study) {
  return question_named(study).of_scene && question_named(study).alone.empty();
}

Study study(const std::string& name, const Machine& machine, const Options& given, const Watcher& watcher) {
  const Question& question = question_named(name);
  return asked_of(machine.parts(), [&] {
    if (name == "forces") {
      const auto of = std::find_if(given.begin(), given.end(), [](const auto& o) { return o.first == "mechanism"; });
      refuse_forces_of_own(machine.parts().scene, of == given.end() ? "" : of->second);
    }
    return study_of(question.answer(inquiry_of(machine.parts(), watcher), given));
  });
}

Study study(const std::string& name, const Options& given, const Watcher& watcher) {
  return answered([&] {
    const Question& question = question_named(name);
    if (needs_machine(name)) throw std::invalid_argument(name + " needs a machine");
    const Scene none;
    return study_of(question.answer({.scene = none, .watch = watch_of(watcher)}, given));
  });
}

Study diff(const Machine& a, const Machine& b, const Options& given, const Watcher& watcher) {
  return answered([&] {  // an error of either scene is placed in its file
    const MachineRequest asked = machine_options().read(given, "diff", a.parts().scene);
    return study_of(output_of(difference_between(question_of(inquiry_of(a.parts(), watcher), asked),
                                                 question_of(inquiry_of(b.parts(), watcher), asked), asked.of)));
  });
}

std::vector<FigureValue> Study::figures() const {
  std::vector<FigureValue> all;
  for (FigureRow& row : summary_tables(summary_of(parts_->output)).figures)
    all.push_back({row, std::move(row.name), std::move(row.unit), row.at, std::move(row.of)});
  return all;
}

std::string Study::conclusion() const { return parts_->output.conclusion(); }
std::string Study::text() const { return parts_->output.text(); }
std::string Study::json() const { return parts_->output.json(); }
std::string Study::html() const { return html_of(parts_->output.report()); }
bool Study::complete() const { return parts_->output.complete; }
std::string Study::diagnosis() const { return parts_->output.diagnosis; }
std::string Study::unconfirmed() const { return parts_->output.unconfirmed; }

std::vector<std::pair<std::string, std::string>> Study::tables() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, table] : parts_->output.tables) all.emplace_back(name + ".csv", csv_text(table()));
  for (const auto& file : parts_->output.files)
    if (!file.first.ends_with(".fmu")) all.push_back(file);  // no text: write() alone has it
  return all;
}

void Study::write(const std::string& folder, const std::string& formats) const {
  write_output(parts_->output, folder, {.formats = table_formats(formats)});
}

}  // namespace kurbel
