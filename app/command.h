// command.h — the options of one command, declared without CLI11. Its header adds seconds to every source that
// includes it and is included in command.cpp alone.
//
//     command.add_option("--until", until, "end of the simulated time, e.g. \"3 s\"");
//     command.add_flag("--no-error", no_error, "skip the second run that measures the errors");
//     command.action([&code, arguments] { code = run(*arguments); });
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace kurbel::app {

// A declared option, for further settings.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required(bool is = true);
  Option& values(int least, int most);  // number of words that follow the option
  Option& repeatable();                 // one value each time it is given
  Option& one_value_each_time();        // further words are not values of the option
  // `fault` returns why a value is not accepted; empty: it is accepted.
  Option& check(std::function<std::string(const std::string&)> fault);

 private:
  CLI::Option* option_;
};

class OptionList {
 public:
  explicit OptionList(CLI::App& app) : app_(app) {}
  std::string name() const;

  // The value is unchanged if the option is not given. A name without dashes is a positional argument.
  Option add_option(const std::string& name, std::string& value, const std::string& help = "");
  Option add_option(const std::string& name, std::vector<std::string>& value, const std::string& help);
  Option add_flag(const std::string& name, bool& value, const std::string& help);
  Option add_flag(const std::string& name, std::function<void()> act, const std::string& help);
  Option option(const std::string& name);  // one declared before
  void action(std::function<void()> act);

 private:
  CLI::App& app_;
};

// An option as help, manual page and completion show it.
struct OptionHelp {
  std::string name, help;               // "--until"
  std::vector<std::string> long_names;  // "until"
  bool by_place = false;
};
// The options that a command declares.
std::vector<OptionHelp> options_of(const std::function<void(OptionList&)>& set_up, const std::string& name);

struct Subcommand {
  std::string name, help;
  std::function<void(OptionList&)> set_up;
};
// Executes the command line: the action of its command, help, or an error message. False: the command line is wrong,
// and the message has been printed.
bool parse(int argc, char** argv, const std::string& about, const std::string& version,
           const std::vector<Subcommand>& commands);

}  // namespace kurbel::app
