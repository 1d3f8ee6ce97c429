// main.cpp — the command line, nothing else.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "engine/numerics/deadline.h"
#include "engine/scene/messages.h"
#include "engine/scene/units.h"

namespace {

// " — did you mean "--quiet"?" for the first option that the command does not know.
std::string option_meant(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || std::find(names.begin(), names.end(), word) != names.end()) continue;
    const auto near = kurbel::nearest(word, names);
    return near ? fmt::format(" — did you mean \"{}\"?", *near) : "";
  }
  return "";
}

// CLI11 says little about a mistyped command.
int refuse_command(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    const auto near = kurbel::nearest(argv[1], names);
    kurbel::app::complain(fmt::format("kurbel: unknown command \"{}\"{}; allowed: {}. See kurbel --help\n", argv[1],
                                      near ? fmt::format(" — did you mean \"{}\"?", *near) : "",
                                      kurbel::listed(names)));
  } else if (argc == 1) {
    kurbel::app::complain(
        fmt::format("kurbel: no command given; allowed: {}. Begin with kurbel new press, or see kurbel --help\n",
                    kurbel::listed(names)));
  } else {
    std::string meant;
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && argv[1][0] != '-')
      meant = option_meant(*app.get_subcommand(argv[1]), argc, argv);
    kurbel::app::complain(fmt::format("kurbel: {}{} See kurbel{} --help\n", error.what(), meant.empty() ? "." : meant,
                                      argv[1][0] == '-' ? "" : fmt::format(" {}", argv[1])));
  }
  return kurbel::app::exit_user_error;
}

// An option without its value is a mistake, as where a script's variable is empty.
void refuse_empty_values(CLI::App& app) {
  const CLI::Validator not_empty(
      [](std::string& value) { return value.empty() ? std::string("must not be empty") : std::string(); }, "");
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options())
      if (option->get_items_expected_max() > 0) option->check(not_empty);
}

int run(int argc, char** argv) {
  using namespace kurbel::app;
  CLI::App app{
      "kurbel — dynamics of machine units: is the rigid model good enough, and if not, how far is it off?\n"
      "begin with: kurbel new press\n"
      "exit codes: 0 done, 2 the input is wrong, 3 a run failed or did not reach the accuracy asked for, 130 "
      "interrupted"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "kurbel " KURBEL_VERSION);
  int code = exit_done;
  for (const VerbText& verb : verbs()) verb.set_up(*app.add_subcommand(verb.name, verb.help), code);
  refuse_empty_values(app);
  try {
    const kurbel::Deadline deadline(HUGE_VAL, &interrupted());  // whatever a command is at
    app.parse(argc, argv);
    return code;
  } catch (const CLI::Success& success) {
    std::ostringstream help;
    app.exit(success, help, help);
    say(help.str());
    return exit_done;
  } catch (const CLI::ParseError& error) {
    return refuse_command(app, error, argc, argv);
  }
}

// What went wrong, in words and as an exit code.
int run_and_tell(int argc, char** argv) {
  using namespace kurbel::app;
  try {
    return run(argc, argv);
  } catch (const kurbel::SceneError& error) {
    complain(fmt::format("{}\n", placed(error).what()));
    return exit_user_error;
  } catch (const std::invalid_argument& error) {
    complain(fmt::format("kurbel: {}\n", error.what()));
    return exit_user_error;
  } catch (const kurbel::OutOfTime& over) {
    if (over.interrupted()) {
      complain(fmt::format("kurbel: {}\n", over.what()));
      return exit_interrupted;
    }
    complain(fmt::format("kurbel: {}; raise `budget` in [run], or ask for less\n", over.what()));
    return exit_run_failed;
  } catch (const std::bad_alloc&) {
    complain("kurbel: the memory that is allowed does not suffice; raise the limit, or take a smaller scene\n");
    return exit_run_failed;
  } catch (const std::exception& error) {
    complain(fmt::format("kurbel: {}{}\n", interrupted() ? "interrupted; " : "", error.what()));
    return interrupted() ? exit_interrupted : exit_run_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kurbel::app;
  // First of all: Ctrl-C may come at any time. Before this, while the system loads the program, it ends it as any
  // other.
  catch_signals();
  open_standard_streams();
  const int code = run_and_tell(argc, argv);
  bool reader_left = false;
  const std::string unsaid = why_unsaid(reader_left);
  if (unsaid.empty()) return code;
  if (!reader_left) complain(fmt::format("kurbel: what there was to say could not be written: {}\n", unsaid));
  return code == exit_done ? exit_run_failed : code;
}
