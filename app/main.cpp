// main.cpp — the command line, nothing else.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "engine/deadline.h"
#include "engine/messages.h"
#include "engine/units.h"

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
    fmt::print(stderr, "kurbel: unknown command \"{}\"{}; allowed: {}. See kurbel --help\n", argv[1],
               near ? fmt::format(" — did you mean \"{}\"?", *near) : "", kurbel::listed(names));
  } else if (argc == 1) {
    fmt::print(stderr, "kurbel: no command given; allowed: {}. Begin with kurbel new press, or see kurbel --help\n",
               kurbel::listed(names));
  } else {
    std::string meant;
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && argv[1][0] != '-')
      meant = option_meant(*app.get_subcommand(argv[1]), argc, argv);
    fmt::print(stderr, "kurbel: {}{} See kurbel{} --help\n", error.what(), meant.empty() ? "." : meant,
               argv[1][0] == '-' ? "" : fmt::format(" {}", argv[1]));
  }
  return kurbel::app::exit_user_error;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kurbel::app;
  CLI::App app{
      "kurbel — dynamics of machine units: is the rigid model good enough, and if not, how far is it off?\n"
      "begin with: kurbel new press\n"
      "exit codes: 0 done, 2 the input is wrong, 3 a run failed or did not reach the accuracy asked for, 130 "
      "interrupted"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "kurbel 0.1.0");
  int code = exit_done;
  add_run_commands(app, code);
  add_reduce_command(app, code);
  add_size_command(app, code);
  add_forces_command(app, code);
  add_gears_command(app, code);
  add_modes_command(app, code);
  add_steady_command(app, code);
  add_effects_command(app, code);
  add_advise_command(app, code);
  add_accuracy_command(app, code);
  add_scene_commands(app, code);
  catch_interrupts();
  try {
    const kurbel::Deadline deadline(HUGE_VAL, &interrupted());  // whatever a command is at
    app.parse(argc, argv);
    return code;
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return refuse_command(app, error, argc, argv);
  } catch (const kurbel::SceneError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_user_error;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "kurbel: {}\n", error.what());
    return exit_user_error;
  } catch (const kurbel::OutOfTime& over) {
    fmt::print(stderr, "kurbel: {}\n", over.what());
    return exit_interrupted;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "kurbel: the memory is not enough; ask for fewer samples or output components, or a smaller scene\n");
    return exit_run_failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "kurbel: {}\n", error.what());
    return exit_run_failed;
  }
}
