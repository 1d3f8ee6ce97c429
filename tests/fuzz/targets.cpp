// targets.cpp — reads, compiles, runs, and looks at every word and number that comes back.
#include "tests/fuzz/targets.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/numerics/deadline.h"
#include "engine/scene/scene.h"
#include "engine/tables/table_file.h"
#include "mechanisms/reduced/reduced_mechanism.h"
#include "studies/accuracy/accuracy.h"
#include "studies/advise/advise.h"
#include "studies/effects/effect_study.h"
#include "studies/forces/forces_findings.h"
#include "studies/gears/gears.h"
#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/run/run_findings.h"
#include "studies/scenes/kinds.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/formulas.h"
#include "tests/fuzz/random.h"
#include "tests/fuzz/seeds.h"

namespace kurbel::fuzz {
namespace {

std::vector<std::size_t> bytes_of_lines(const std::string& text) {
  std::vector<std::size_t> length(1, 0);
  for (const char c : text)
    if (c == '\n')
      length.push_back(0);
    else
      ++length.back();
  return length;
}

// A message says where, and the place exists: on a line of the file, at most one character behind its end.
std::string fault_of(const Message& m, const std::vector<std::size_t>& length, const std::string& file) {
  if (m.text.empty()) return "a message without words";
  if (m.at.line < 1 || m.at.column < 1)
    return fmt::format("a message without place ({}:{}): {}", m.at.line, m.at.column, m.text);
  if (m.file != file) return {};
  const auto line = static_cast<std::size_t>(m.at.line), column = static_cast<std::size_t>(m.at.column);
  if (line > length.size()) return fmt::format("a message at line {} of {}: {}", line, length.size(), m.text);
  if (column > length[line - 1] + 1)
    return fmt::format("a message at column {} of a line of {} bytes: {}", column, length[line - 1], m.text);
  return {};
}

std::string fault_of(const SceneError& error, const std::string& text, const std::string& file) {
  if (error.messages.empty()) return "a refusal without a message";
  const std::vector<std::size_t> length = bytes_of_lines(text);
  for (const Message& m : error.messages)
    if (std::string fault = fault_of(m, length, file); !fault.empty()) return fault;
  return {};
}

// Runs `ask`; every refusal must have a place, and nothing else may be thrown.
std::string judged(const std::string& text, const std::function<std::string()>& ask) {
  const std::string file = scene_path();
  try {
    return ask();
  } catch (const SceneError& error) {
    return fault_of(error, text, file);
  } catch (const OutOfTime&) {
    return {};
  } catch (const std::exception& error) {
    return fmt::format("an exception without place: {}", error.what());
  }
}

class RoughTables {
 public:
  RoughTables() { take_rough_tables(true); }
  ~RoughTables() { take_rough_tables(false); }
};

std::string not_finite_in(const std::vector<Figure>& figures) {
  for (const Figure& f : figures)
    if (!std::isfinite(f.value) || !std::isfinite(f.error.value_or(0)) || !std::isfinite(f.at.value_or(0)))
      return fmt::format("{} = {} (error {}, at {})", f.name, f.value, f.error.value_or(0), f.at.value_or(0));
  return {};
}

// JSON has no NaN: the library writes null in its place.
std::string null_value_in(const nlohmann::json& summary) {
  if (!summary.contains("figures")) return {};
  for (const auto& figure : summary["figures"])
    if (figure.is_object() && figure.contains("value") && figure["value"].is_null()) return figure.dump();
  return {};
}

bool names_no_number(const std::string& text, std::size_t at) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i]));
  };
  return !(at > 0 && letter(at - 1)) && !letter(at + 3);
}
bool prints_no_number(const std::string& text) {
  for (const char* word : {"nan", "inf"})
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at)
      if (names_no_number(text, at)) return true;
  return false;
}

// What a study hands out, whatever it found.
std::string fault_of(const StudyOutput& output) {
  if (output.conclusion().empty()) return "an output without a conclusion";
  if (!output.complete && output.diagnosis.empty()) return "incomplete, and no word why";
  if (!nlohmann::json::accept(output.json())) return "a summary that is no JSON";
  for (const NamedTable& named : output.tables) csv_text(named.table());
  output.report();
  if (output.complete && prints_no_number(output.text()))
    return "a number that is none in the table of a complete result";
  return {};
}

Scene short_scene(const std::string& text) {
  Scene scene = parse_scene(text, scene_path(), all_kinds());
  scene.run.budget = std::min(scene.run.budget, run_budget);
  scene.run.samples = std::min(scene.run.samples, 200);
  return scene;
}

std::uint64_t number_of(const std::string& text) { return Random(std::hash<std::string>()(text)).bits(); }

SimulateOptions without_errors() {
  SimulateOptions options;
  options.measure_error = false;
  return options;
}

// The answer outlives its output, which refers to it.
template <class Answer>
std::string fault_of_answer(const Answer& answer) {
  return fault_of(output_of(answer));
}

using Verb = std::string (*)(const Scene&);
const Verb verbs[] = {
    [](const Scene& s) { return fault_of_answer(reduce(s, {})); },
    [](const Scene& s) { return fault_of_answer(find_modes(s, s.effects, {})); },
    [](const Scene& s) { return fault_of_answer(find_gears(s, {})); },
    [](const Scene& s) { return fault_of_answer(find_forces(s, {})); },
    [](const Scene& s) {
      return fault_of_answer(steady(s, {Effects{}, s.effects}, {}));
    },
    [](const Scene& s) {
      SizeOptions options;
      options.delta = 0.05;
      options.simulation = without_errors();
      return fault_of_answer(size_flywheel(s, options));
    },
    [](const Scene& s) {
      return fault_of_answer(compare(s, {{}, s.effects, "rigid", "elastic"}, without_errors()));
    },
    [](const Scene& s) { return fault_of_answer(study_effects(s, without_errors())); },
    [](const Scene& s) {
      AdviseOptions options;
      options.simulate = without_errors();
      return fault_of_answer(advise(s, options));
    },
    [](const Scene& s) {
      AccuracyOptions options;
      options.tolerances = {1e-3, 1e-5};
      options.time = 0.5;
      options.multibody = false;
      return fault_of_answer(measure_accuracy(s, options));
    },
};

}  // namespace

std::string judge_reader(const std::string& text) {
  const RoughTables rough;
  return judged(text, [&] {
    parse_scene(text, scene_path(), all_kinds());
    return std::string();
  });
}

std::string judge_compile(const std::string& text) {
  const RoughTables rough;
  return judged(text, [&] {
    const Scene scene = parse_scene(text, scene_path(), all_kinds());
    const auto model = compile(scene, scene.effects);
    figure_list(*model);
    if (model->explain().empty()) return std::string("a model that explains nothing");
    return std::string();
  });
}

std::string judge_run(const std::string& text) {
  return judged(text, [&]() -> std::string {
    const Scene scene = short_scene(text);
    SimulateOptions options;
    options.measure_error = number_of(text) % 4 == 0;
    options.traces = number_of(text) % 16 < 4;
    const Result result = simulate(scene, scene.effects, "fuzzed", options);
    if (!result.complete && result.diagnosis.empty()) return "an incomplete run without a diagnosis";
    if (result.complete)
      if (std::string fault = not_finite_in(result.figures); !fault.empty()) return "complete, but " + fault;
    for (const auto& [name, state] : result.final_state)
      if (result.complete && !(std::isfinite(state.angle.value) && std::isfinite(state.speed.value)))
        return fmt::format("complete, but the final state of {} is not finite", name);
    const StudyOutput output = output_of(result);
    if (result.complete && nlohmann::json::accept(output.json()))
      if (std::string found = null_value_in(nlohmann::json::parse(output.json())); !found.empty())
        return "complete, but null in the summary: " + found;
    return fault_of(output);
  });
}

namespace {
// Refusals of a study are about its question, not about a line of the scene: std::invalid_argument in words.
std::string judge_verb(const std::string& text, Verb verb) {
  return judged(text, [&]() -> std::string {
    const Scene scene = short_scene(text);
    const Deadline deadline(20 * run_budget);
    try {
      return verb(scene);
    } catch (const SceneError&) {
      throw;
    } catch (const std::invalid_argument& refused) {
      return std::string(refused.what()).empty() ? "a refusal without words" : "";
    } catch (const std::runtime_error& failed) {
      return std::string(failed.what()).empty() ? "a failure without words" : "";
    }
  });
}
}  // namespace

std::string judge_study(const std::string& text) { return judge_verb(text, verbs[number_of(text) % std::size(verbs)]); }

std::string judge_every_study(const std::string& text) {
  for (const Verb verb : verbs)
    if (std::string fault = judge_verb(text, verb); !fault.empty()) return fault;
  return {};
}

std::string judge_csv(const std::string& text) {
  const int file = memfd_create("fuzzed.csv", 0);
  if (file < 0 || write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size())) return "no memory file";
  const std::string path = fmt::format("/proc/self/fd/{}", file);
  std::string fault = judged(text, [&]() -> std::string {
    Messages messages("scene.toml");
    const std::uint64_t number = number_of(text);
    const int x = 1 + static_cast<int>(number % 3), y = 1 + static_cast<int>(number / 3 % 3);
    const TableNumbers numbers = TableFile(path).numbers({x, y}, messages);
    const std::vector<double>&all_x = numbers.columns[0], &all_y = numbers.columns[1];
    if (all_x.size() != all_y.size() || all_x.size() != numbers.at.size()) return "columns of unequal length";
    for (std::size_t i = 0; i < all_x.size(); ++i)
      if (!std::isfinite(all_x[i]) || !std::isfinite(all_y[i])) return fmt::format("row {} is not finite", i);
    // As it is read: in UTF-8, whatever it was in.
    const std::vector<std::size_t> length = bytes_of_lines(read_table_text(path).text);
    for (const Message& m : messages.all())
      if (std::string wrong = fault_of(m, length, path); !wrong.empty()) return wrong;
    return {};
  });
  close(file);
  return fault;
}

const std::vector<Target>& targets() {
  static const std::vector<Target> list = {
      {"reader", "is every text read or refused with a place?", {0.3, 0.4, 6, true}, judge_reader, 2},
      {"compile",
       "is every scene that can be read compiled, or refused with a place?",
       {0.25, 0.03, 5, true},
       judge_compile,
       4},
      {"run",
       "does every machine run, or say why not, within its budget?",
       {0.15, 0.01, 4, false},
       judge_run,
       6 * run_budget + 4},
      {"study", "does every other verb answer or refuse?", {0.1, 0.01, 3, false}, judge_study, 20 * run_budget + 8},
      {"csv", "is every table read or refused with a place?", {}, judge_csv, 2, table_input, mutated_table},
      {"formula",
       "is every formula computed, or refused with a column?",
       {},
       judge_formula,
       3,
       formula_input,
       mutated_formula},
      {"xlsx", "is every workbook read or refused?", {}, judge_sheet, 3, workbook_input, mutated_file},
      {"mat", "is every MAT file read or refused?", {}, judge_sheet, 3, mat_input, mutated_file},
      {"sheet",
       "does every mass–elastic sheet become a scene that can be read, or is refused with a place?",
       {},
       judge_train_sheet,
       3,
       train_sheet_input,
       mutated_table},
      {"json",
       "is every checkpoint and every summary of settings used or refused?",
       {},
       judge_json,
       3,
       json_input,
       mutated_file},
  };
  return list;
}

const Target* target_named(const std::string& name) {
  for (const Target& target : targets())
    if (name == target.name) return &target;
  return nullptr;
}

}  // namespace kurbel::fuzz
