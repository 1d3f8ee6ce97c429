// explain_command.cpp — kurbel explain: what a figure means, with its formula, and what it is not.
#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <utility>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "engine/scene/messages.h"
#include "engine/scene/units.h"
#include "studies/dictionary/dictionary.h"
#include "studies/report/theory.h"

namespace kurbel::app {
namespace {

// "theory 2.6: Reduction …" as a report cites it.
std::string place_of(const Definition& d) {
  std::string text;
  for (const std::string& note : theory_notes(fmt::format("theory {}", d.theory))) text += note;
  return text;
}

std::string explained(const Definition& d, const std::string& asked) {
  std::string text = fmt::format("{} — {}\n", d.form(), d.words);
  for (const auto& [prefix, whole] : {std::pair{"cycle_peak_", "one steady cycle"}, std::pair{"peak_", "a whole run"}})
    if (asked.starts_with(prefix) && !d.name.starts_with(prefix)) {
      text += fmt::format("  {} is its greatest magnitude in {}, with its sign\n", asked, whole);
      break;
    }
  const auto line = [&](const char* what, const std::string& told) {
    if (!told.empty()) text += fmt::format("  {:<11}{}\n", what, told);
  };
  line("is", std::string(d.is));
  line("formula", std::string(d.formula));
  line("unit", d.unit.empty() ? "a plain number" : pretty_unit(d.unit));
  line("is not", std::string(d.is_not));
  line("told by", d.verbs.empty() ? "no command" : std::string(d.verbs));
  line("more", place_of(d));
  return text;
}

// "did you mean mean_speed, speed?"
[[noreturn]] void refuse(const std::string& asked) {
  std::string near;
  for (const std::string& name : names_like(asked, 5)) near += fmt::format("{}\"{}\"", near.empty() ? "" : ", ", name);
  throw std::invalid_argument(fmt::format("no figure {}{}; all of them: kurbel explain", in_quotes(asked),
                                          near.empty() ? "" : fmt::format(" — did you mean {}?", near)));
}

int explain(const std::string& asked, bool names) {
  if (asked.empty()) {
    for (const Definition& d : dictionary())
      say(names ? fmt::format("{}\n", d.name) : fmt::format("{:<26} {}\n", d.name, d.words));
    return exit_done;
  }
  const Definition* found = meant_by(asked);
  if (!found) refuse(asked);
  say(explained(*found, asked));
  return exit_done;
}

void set_up(CLI::App& command, int& code) {
  const auto wanted = std::make_shared<std::pair<std::string, bool>>("", false);
  command.add_option("figure", wanted->first, "e.g. delta, delta.press, \"mean speed\" (default: all, a line each)");
  command.add_flag("--list", wanted->second, "only the names, a line each");
  command.callback([&code, wanted] { code = explain(wanted->first, wanted->second); });
}

const Verb verb{{.place = 135,
                 .name = "explain",
                 .arguments = "delta",
                 .help = "what a figure means: definition, formula, unit, what it is not",
                 .does =
                     "what a figure means: definition, formula, unit, what it is not, which commands tell it; without "
                     "a name all figures",
                 .set_up = set_up,
                 .of_scene = false}};

}  // namespace
}  // namespace kurbel::app
