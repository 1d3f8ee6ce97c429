// advise_command.cpp — the cheapest set of effects that stays within a tolerance.
#include <fmt/format.h>

#include <memory>
#include <sstream>
#include <stdexcept>

#include "app/command_line.h"
#include "app/verb.h"
#include "studies/advise/advise.h"
#include "studies/files/whole_file.h"

namespace kurbel::app::advise_command {
namespace {

struct AdviseArguments {
  StudyOptions study;
  std::string within = "1 %", figures, write;
  bool no_held_out = false;
};

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  std::stringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');)
    if (!name.empty()) names.push_back(name);
  return names;
}

int run_advise(const AdviseArguments& arguments) {
  const Scene scene = read(arguments.study);
  check_folder(arguments.study);
  if (!arguments.write.empty())
    if (const std::string why = why_no_file_at(arguments.write); !why.empty())
      throw std::invalid_argument(fmt::format("--write {}: {}", arguments.write, why));
  Progress progress(arguments.study.quiet);
  AdviseOptions options;
  options.simulate = simulate_options(arguments.study, progress);
  options.within = quantity_of("--within", arguments.within, "a part > 0 and below 1", "1 %", {.low = 1e-9, .high = 1});
  options.figures = names_in(arguments.figures);
  options.held_out = !arguments.no_held_out;
  const Advice advice = advise(scene, options);
  if (!arguments.write.empty() && advice.complete && !interrupted()) write_whole(arguments.write, advice.lean_scene);
  return present(output_of(advice), arguments.study);
}

void set_up(OptionList& command, int& code) {
  const auto arguments = std::make_shared<AdviseArguments>();
  add_study_options(command, arguments->study);
  command.add_option("--within", arguments->within, "deviation allowed from the fullest model (default: 1 %)");
  command.add_option("--figures", arguments->figures,
                     "figures that count, joined by commas, e.g. delta,peak_torque.main_coupling (default: all)");
  command.add_option("--write", arguments->write, "writes the scene with the effects advised");
  command.add_flag("--no-held-out", arguments->no_held_out, "skips the check at other loads and speeds");
  command.action([&code, arguments] { code = run_advise(*arguments); });
}

const Verb verb{{.place = 100,
                 .name = "advise",
                 .arguments = "scene.toml --within 1%",
                 .help = "the cheapest set of effects whose figures stay within a tolerance",
                 .does = "the cheapest set of effects whose figures stay within a tolerance of the fullest model; "
                         "screened, then run; `--write lean.toml`",
                 .set_up = set_up}};

}  // namespace
}  // namespace kurbel::app::advise_command
