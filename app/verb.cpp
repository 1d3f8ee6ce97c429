// verb.cpp — the list of commands, and their texts in help, manual page and completion.
#include "app/verb.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "app/command_line.h"
#include "engine/scene/messages.h"

namespace kurbel::app {
namespace {

std::vector<VerbText>& registered() {
  static std::vector<VerbText> list;  // made on first use
  return list;
}

std::vector<OptionHelp> declared_by(const VerbText& verb) {
  return options_of(
      [&verb](OptionList& command) {
        int code = 0;
        verb.set_up(command, code);
      },
      verb.name);
}

std::set<std::string> shared_options() {
  StudyOptions options;
  std::set<std::string> names;
  for (const OptionHelp& option :
       options_of([&](OptionList& command) { add_study_options(command, options); }, "study"))
    names.insert(option.name);
  return names;
}

// roff: protects hyphens, and lines that would begin with a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '`') continue;
    if (c == '\\')
      out += "\\e";
    else if (c == '"')
      out += "\\(dq";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += std::string("\\&") + c;
    else
      out += c;
  }
  return out;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

Verb::Verb(VerbText text) {
  text.of_scene = false;
  registered().push_back(std::move(text));
}

std::vector<VerbText> verbs() {
  std::vector<VerbText> list = registered();
  for (const Question& question : questions()) list.push_back(verb_of(question));
  std::sort(list.begin(), list.end(), [](const VerbText& a, const VerbText& b) { return a.place < b.place; });
  return list;
}

std::string verbs_as_manual() {
  const std::set<std::string> shared = shared_options();
  std::string text;
  for (const VerbText& verb : verbs()) {
    text += fmt::format(".SS kurbel {} {}\n{}.\n", verb.name, roff(verb.arguments), roff(capitalised(verb.does)));
    for (const std::string& more : verb.more) {
      const std::size_t bar = more.find(" | ");
      text += fmt::format(".TP\n.B kurbel {} {}\n{}.\n", verb.name, roff(more.substr(0, bar)),
                          roff(capitalised(more.substr(bar + 3))));
    }
    for (const OptionHelp& option : declared_by(verb)) {
      if (option.name == "--help" || (verb.of_scene && shared.count(option.name))) continue;
      if (option.by_place) continue;
      text += fmt::format(".TP\n.B {}\n{}\n", roff(option.name), roff(option.help));
    }
  }
  return text;
}

std::string verbs_as_markdown() {
  std::string text = "| command | what it does |\n|---|---|\n";
  for (const VerbText& verb : verbs()) {
    text += fmt::format("| `kurbel {}{}` | {} |\n", verb.name, verb.arguments.empty() ? "" : " " + verb.arguments,
                        verb.does);
    for (const std::string& more : verb.more) {
      const std::size_t bar = more.find(" | ");
      text += fmt::format("| `kurbel {} {}` | {} |\n", verb.name, more.substr(0, bar), more.substr(bar + 3));
    }
  }
  return text;
}

// A flag, one value, or several: as the module takes them.
std::string questions_as_stubs() {
  constexpr std::size_t width = 119;
  const std::set<std::string> by_hand{"diff", "run", "sweep", "merge"};  // they return more, or are asked otherwise
  std::string text;
  for (const Question& question : questions()) {
    if (by_hand.contains(question.name)) continue;
    const std::string begin = fmt::format("def {}(", question.name);
    std::string line =
        begin + (question.alone.empty() ? "scene: _Scene" : "scene: _Scene | None = ...") + ", *, set: _Settings = ...";
    for (const DeclaredOption& option : question.options) {
      const bool list =
          option.form == OptionForm::several || option.text.name == "effects" || option.text.name == "against";
      const std::string next = fmt::format("{}: {} = ...", option.text.name,
                                           option.form == OptionForm::flag ? "_Flag"
                                           : list                          ? "_Values"
                                                                           : "_Value");
      if (line.size() + next.size() + 3 > width) {
        text += line + ",\n";
        line = std::string(begin.size(), ' ') + next;
      } else {
        line += ", " + next;
      }
    }
    text += line + (line.size() + 16 > width ? "\n" + std::string(begin.size(), ' ') : "") + ") -> Study: ...\n";
  }
  return text;
}

std::string names_of_verbs() {
  std::string text;
  for (const VerbText& verb : verbs()) text += verb.name + "\n";
  return text;
}

std::string options_of_verb(const std::string& name) {
  std::vector<std::string> names;
  for (const VerbText& verb : verbs()) {
    names.push_back(verb.name);
    if (verb.name != name) continue;
    std::string text;
    for (const OptionHelp& option : declared_by(verb))
      for (const std::string& word : option.long_names) text += "--" + word + "\n";
    return text;
  }
  throw std::invalid_argument(fmt::format("no command \"{}\"; allowed: {}", name, listed(names)));
}

}  // namespace kurbel::app
