// command.cpp — the command-line parser CLI11, and messages on mistyped commands.
#include "app/command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "app/terminal.h"
#include "engine/scene/keys.h"
#include "studies/question/range.h"

namespace kurbel::app {

Option& Option::required(bool is) {
  option_->required(is);
  return *this;
}
Option& Option::values(int least, int most) {
  option_->expected(least, most)->allow_extra_args(false);
  return *this;
}
Option& Option::repeatable() {
  option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}
Option& Option::one_value_each_time() {
  option_->allow_extra_args(false);
  return *this;
}
Option& Option::check(std::function<std::string(const std::string&)> fault) {
  option_->check(CLI::Validator([fault = std::move(fault)](std::string& value) { return fault(value); }, ""));
  return *this;
}

std::string OptionList::name() const { return app_.get_name(); }
Option OptionList::add_option(const std::string& name, std::string& value, const std::string& help) {
  return Option(app_.add_option(name, value, help));
}
Option OptionList::add_option(const std::string& name, std::vector<std::string>& value, const std::string& help) {
  return Option(app_.add_option(name, value, help));
}
Option OptionList::add_flag(const std::string& name, bool& value, const std::string& help) {
  return Option(app_.add_flag(name, value, help));
}
Option OptionList::add_flag(const std::string& name, std::function<void()> act, const std::string& help) {
  return Option(app_.add_flag_callback(name, std::move(act), help));
}
Option OptionList::option(const std::string& name) { return Option(app_.get_option(name)); }
void OptionList::action(std::function<void()> act) { app_.callback(std::move(act)); }

std::vector<OptionHelp> options_of(const std::function<void(OptionList&)>& set_up, const std::string& name) {
  CLI::App program;
  OptionList command(*program.add_subcommand(name));
  set_up(command);
  std::vector<OptionHelp> texts;
  for (const CLI::Option* option : program.get_subcommand(name)->get_options())
    texts.push_back({option->get_name(), option->get_description(), option->get_lnames(), option->get_positional()});
  return texts;
}

namespace {

// " — did you mean "--quiet"?" for the first unknown option.
std::string option_meant(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || std::find(names.begin(), names.end(), word) != names.end()) continue;
    return suggestion(word, names);
  }
  return "";
}

// Extends CLI11's short message on a mistyped command.
void refuse(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    complain(fmt::format("kurbel: unknown command \"{}\"{}; allowed: {}. See kurbel --help\n", argv[1],
                         suggestion(argv[1], names), listed(names)));
  } else if (argc == 1) {
    complain(fmt::format("kurbel: no command given; allowed: {}. Begin with kurbel new press, or see kurbel --help\n",
                         listed(names)));
  } else {
    std::string meant;
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && argv[1][0] != '-')
      meant = option_meant(*app.get_subcommand(argv[1]), argc, argv);
    complain(fmt::format("kurbel: {}{} See kurbel{} --help\n", error.what(), meant.empty() ? "." : meant,
                         argv[1][0] == '-' ? "" : fmt::format(" {}", argv[1])));
  }
}

// An option with an empty value is an error, for example an empty variable in a script.
void refuse_empty_values(CLI::App& app) {
  const CLI::Validator not_empty(
      [](std::string& value) { return value.empty() ? std::string("must not be empty") : std::string(); }, "");
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options())
      if (option->get_items_expected_max() > 0) option->check(not_empty);
}

// The words of the command line, the last one first; a range behind an option of two values is two: "20..200 rpm".
std::vector<std::string> words_of(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> words;
  const CLI::App* command = nullptr;  // the first word that names one
  const auto is_of_two = [&](const std::string& name) {
    const CLI::Option* const option = command ? command->get_option_no_throw(name) : nullptr;
    return option && option->get_items_expected_min() == 2;
  };
  bool of_two = false;  // the word before is such an option
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    if (!command) {
      const auto named = app.get_subcommands([&](const CLI::App* c) { return c->get_name() == word; });
      if (!named.empty()) command = named.front();
    }
    if (const std::size_t equals = word.find('='); word.starts_with("--") && equals != std::string::npos)
      if (const std::string name = word.substr(0, equals); is_of_two(name)) {
        words.push_back(name);
        word.erase(0, equals + 1), of_two = true;
      }
    if (const auto ends = of_two ? range_ends(word) : std::nullopt)
      words.insert(words.end(), ends->begin(), ends->end());
    else
      words.push_back(word);
    of_two = is_of_two(word);
  }
  std::reverse(words.begin(), words.end());
  return words;
}

}  // namespace

bool parse(int argc, char** argv, const std::string& about, const std::string& version,
           const std::vector<Subcommand>& commands) {
  CLI::App app{about, argv[0]};
  app.require_subcommand(1);
  app.set_version_flag("--version", version);
  for (const Subcommand& each : commands) {
    OptionList command(*app.add_subcommand(each.name, each.help));
    if (std::find(argv, argv + argc, each.name) != argv + argc) each.set_up(command);  // others have no use for options
  }
  refuse_empty_values(app);
  try {
    app.parse(words_of(app, argc, argv));
    return true;
  } catch (const CLI::Success& success) {
    std::ostringstream help;
    app.exit(success, help, help);
    say(help.str());
    return true;
  } catch (const CLI::ParseError& error) {
    refuse(app, error, argc, argv);
    return false;
  }
}

}  // namespace kurbel::app
