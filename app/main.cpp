// main.cpp — the command line, nothing else.
#include <fmt/format.h>

#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "engine/numerics/deadline.h"
#include "engine/scene/messages.h"

namespace {

int run(int argc, char** argv) {
  using namespace kurbel::app;
  int code = exit_done;
  std::vector<Subcommand> commands;
  for (const VerbText& verb : verbs())
    commands.push_back({verb.name, verb.help, [&verb_code = code, set_up = verb.set_up](OptionList& command) {
                          set_up(command, verb_code);
                        }});
  const kurbel::Deadline deadline(HUGE_VAL, &interrupted());  // whatever a command is at
  const bool right =
      parse(argc, argv,
            "kurbel — dynamics of machine units: is the rigid model sufficient, and if not, how large is its error?\n"
            "begin with: kurbel new press\n"
            "exit codes: 0 done, 2 the input is wrong, 3 a run failed or did not reach the requested accuracy, 130 "
            "interrupted",
            "kurbel " KURBEL_VERSION, commands);
  return right ? code : exit_user_error;
}

// Runs the command; reports errors as a message and an exit code.
int run_and_report(int argc, char** argv) {
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
    complain(fmt::format("kurbel: {}; raise `budget` in [run], or reduce the task\n", over.what()));
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
  // First of all, since Ctrl-C may come at any time. Before this, while the system loads the program, it ends the
  // program as usual.
  catch_signals();
  open_standard_streams();
  const int code = run_and_report(argc, argv);
  bool reader_left = false;
  const std::string unwritten = why_unsaid(reader_left);
  if (unwritten.empty()) return code;
  if (!reader_left) complain(fmt::format("kurbel: what there was to say could not be written: {}\n", unwritten));
  return code == exit_done ? exit_run_failed : code;
}
