// explain_command.cpp — kurbel explain: what a figure means, with its formula, and what it is not.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "library/words.h"
#include "studies/claims/claim.h"
#include "studies/dictionary/dictionary.h"

namespace kurbel::app::explain_command {
namespace {

int explain(const std::string& asked, bool names, bool claims) {
  if (claims) {
    say(claims_in_markdown());
    return exit_done;
  }
  if (asked.empty()) {
    for (const Definition& d : dictionary())
      say(names ? fmt::format("{}\n", d.name) : fmt::format("{:<26} {}\n", d.name, d.words));
    return exit_done;
  }
  say(explained(asked));
  return exit_done;
}

void set_up(OptionList& command, int& code) {
  struct Wanted {
    std::string figure;
    bool names = false, claims = false;
  };
  const auto wanted = std::make_shared<Wanted>();
  command.add_option("figure", wanted->figure, "e.g. delta, delta.press, \"mean speed\" (default: all, a line each)");
  command.add_flag("--list", wanted->names, "only the names, a line each");
  command.add_flag("--claims", wanted->claims, "what a conclusion may claim, when, and by what evidence (Markdown)");
  command.action([&code, wanted] { code = explain(wanted->figure, wanted->names, wanted->claims); });
}

const Verb verb{{{.place = 135,
                  .name = "explain",
                  .arguments = "delta",
                  .help = "what a figure means: definition, formula, unit, what it is not",
                  .does = "what a figure means: definition, formula, unit, what it is not, which commands give it; "
                          "without a name all figures"},
                 set_up}};

}  // namespace
}  // namespace kurbel::app::explain_command
