// sequence_reader.cpp — steps of an operating sequence: when, what, to which value.
#include "engine/reading/sequence_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "engine/reading/section_reader.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

std::vector<std::string> names_in(const DocumentValue& value) {
  if (value.type == Type::text) return {value.text};
  std::vector<std::string> names;
  if (value.type == Type::list)
    for (const DocumentValue& item : value.items)
      if (item.type == Type::text) names.push_back(item.text);
  return names;
}

class StepReader {
 public:
  StepReader(const std::vector<std::string>& components, const std::function<bool(const std::string&)>& is_component,
             Messages& messages)
      : components_(components), is_component_(is_component), messages_(messages) {}

  SequenceStep read(const DocumentValue& table, const std::string& what) {
    static const Kind kind{.name = "step", .keys = sequence_step_keys()};
    const Section section = read_section(table, kind, "", what, messages_, {"set"});
    SequenceStep step;
    step.to = section.number("to");
    step.over = section.number("over");
    read_law(section, step, what);
    step.at = table.at;
    read_trigger(section, step, what);
    const DocumentEntry* set = table.find("set");
    if (!set) {
      messages_.add(table.at,
                    fmt::format("{}: \"set\" is missing; name the component or components that it sets", what));
      return step;
    }
    step.set = names_in(set->value);
    if (step.set.empty())
      messages_.add(set->value.at, fmt::format("{}: set = {}; must be a component or a list of components", what,
                                               set->value.describe()));
    for (const std::string& name : step.set) check_set(name, set->value.at, what + ": set");
    return step;
  }

 private:
  void read_law(const Section& section, SequenceStep& step, const std::string& what) {
    if (!section.given("law") || !section.valid) return;
    const auto refuse = [&](const std::string& text) { messages_.add(section.where("law"), what + ": law: " + text); };
    for (const char* key : {"to", "over"})
      if (section.given(key)) return refuse(fmt::format("\"law\" and \"{}\" both given; keep one", key));
    try {
      step.law = section["law"].curve.curve();
    } catch (const std::invalid_argument& error) {
      return refuse(error.what());
    }
    if (step.law.beyond_first() == Beyond::line || step.law.beyond_last() == Beyond::line)
      return refuse(
          "beyond = \"line\" would leave −1 … 10, within which a command lies; allowed: \"hold\" or \"refuse\"");
    double least = std::min(step.law.before(), step.law.y().back());
    for (std::size_t i = 0; i + 1 < step.law.x().size(); ++i)
      for (int k = 0; k <= 100; ++k)
        least = std::min(least, step.law.value_in(static_cast<int>(i),
                                                  step.law.x()[i] + (step.law.x()[i + 1] - step.law.x()[i]) * k / 100));
    step.to = least;  // the value it must accept
    if (step.law.max_abs() > 10 || least < -1) refuse("its values must lie within −1 … 10");
  }
  // A component, or a part of it, which is checked when it is built.
  void check_set(const std::string& name, Location at, const std::string& what) {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos || !is_component_(name.substr(0, dot))) check(name, at, what);
  }
  void check(const std::string& name, Location at, const std::string& what) {
    if (!is_component_(name))
      messages_.add(at, fmt::format("{}: \"{}\" is no component{}; allowed: {}", what, name,
                                    suggestion(name, components_), shortened_list(components_)));
  }
  void read_trigger(const Section& section, SequenceStep& step, const std::string& what) {
    using When = SequenceStep::When;
    const std::pair<const char*, When> triggers[] = {{"at", When::at},
                                                     {"after", When::after},
                                                     {"angle", When::angle},
                                                     {"speed_above", When::speed_above},
                                                     {"speed_below", When::speed_below}};
    int given = 0;
    for (const auto& [key, when] : triggers) {
      if (!section.given(key)) continue;
      step.when = when;
      step.value = section.number(key);
      ++given;
    }
    if (given > 1)
      messages_.add(step.at, fmt::format("{}: waits for {} things; keep one of \"at\", \"after\", \"angle\", "
                                         "\"speed_above\", \"speed_below\"",
                                         what, given));
    const bool watches = given == 1 && step.when != When::at && step.when != When::after;
    if (section.given("of")) {
      step.of = section.text("of");
      check(step.of, section.where("of"), what + ": of");
    }
    if (given <= 1 && watches == step.of.empty())
      messages_.add(step.at,
                    watches ? fmt::format("{}: \"of\" is missing: whose angle or speed?", what)
                            : fmt::format("{}: \"of\" belongs to \"angle\", \"speed_above\" or \"speed_below\"", what));
  }

  const std::vector<std::string>& components_;
  const std::function<bool(const std::string&)>& is_component_;
  Messages& messages_;
};

void read_steps(const DocumentValue& list, StepReader& reader, Messages& messages, Sequence& sequence) {
  if (list.type != Type::list)
    return messages.add(list.at, fmt::format("[sequence]: steps = {}; must be a list of tables, e.g. [{{ at = \"1 s\", "
                                             "set = \"clutch\", to = 0 }}]",
                                             list.describe()));
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const DocumentValue& item = list.items[i];
    const std::string what = fmt::format("[sequence]: steps[{}]", i + 1);
    if (item.type == Type::table)
      sequence.steps.push_back(reader.read(item, what));
    else
      messages.add(item.at, fmt::format("{} = {}; must be a table", what, item.describe()));
  }
}

// The begin of the next repetition: by its first step, or by time.
void read_repetition(const Section& section, Location table, Messages& messages, Sequence& sequence) {
  using When = SequenceStep::When;
  const SequenceStep& first = sequence.steps.front();
  const bool by_rate = section.has("rate"), clocked = by_rate || section.has("every");
  const char* key = by_rate ? "rate" : "every";
  const auto refuse = [&](const char* at, const std::string& text) {
    messages.add(section.where(at), fmt::format("[sequence]: {}: {}", at, text));
  };
  if (by_rate && section.has("every")) return refuse("rate", "both \"every\" and \"rate\" given; keep one");
  if (clocked && section.given("repeat") && !sequence.repeat)
    return refuse("repeat",
                  fmt::format("repeat = false, but \"{}\" says when the next repetition begins; keep one", key));
  if (clocked && first.when != When::at && !(first.when == When::after && first.value == 0))
    return refuse(key,
                  "the clock begins each repetition, but its first step waits for something else; give that step "
                  "\"at\", for the first repetition, or nothing, and move the condition to a later step");
  if (clocked) sequence.repeat = true, sequence.every = by_rate ? 1 / section.number("rate") : section.number("every");
  const auto waits = [](const SequenceStep& step) {
    return step.when != When::at && !(step.when == When::after && step.value == 0);
  };
  if (sequence.repeats_freely() && std::none_of(sequence.steps.begin(), sequence.steps.end(), waits))
    messages.add(table,
                 "[sequence]: repeat = true, but no step waits for anything in a repetition; give "
                 "one an \"after\" > 0 s, an angle or a speed, or the sequence \"every\"");
}

}  // namespace

const std::vector<Key>& sequence_keys() {
  static const std::vector<Key> keys = {
      flag("repeat", "false", "after the last step the sequence begins again"),
      quantity("every", "s", positive,
               "time from the start of a repetition to the start of the next one; the sequence repeats"),
      quantity("rate", "1/s", positive, "the same as repetitions per time: strokes per minute as \"30 1/min\""),
  };
  return keys;
}

const std::vector<Key>& sequence_step_keys() {
  static const std::vector<Key> keys = {
      quantity("at", "s", not_negative, "at this time, or as soon as the steps before it are done"),
      quantity("after", "s", not_negative, "this long after the step before it"),
      quantity("angle", "rad", any_number, "when the component `of` next passes this angle, whatever the turn"),
      quantity("speed_above", "rad/s", any_number, "when the component `of` is faster than this"),
      quantity("speed_below", "rad/s", any_number, "when the component `of` is slower than this"),
      {.name = "of", .type = KeyType::text, .doc = "the component that is watched"},
      defaulted("to", "", "1", {.low = -1, .high = 10},
                "1 on, 0 off, between them part (pressure of a clutch, voltage of a motor), −1 a motor reversed"),
      {.name = "law",
       .type = KeyType::curve,
       .unit = "1",
       .doc = "in place of to and over: the value over the time since the step, as clutch pressure over rated pressure",
       .choices = {"time"}},
      defaulted("over", "s", "0 s", not_negative, "ramp from the value before"),
  };
  return keys;
}

Sequence read_sequence(const DocumentValue& table, const std::vector<std::string>& components,
                       const std::function<bool(const std::string&)>& is_component, Messages& messages) {
  Sequence sequence;
  if (table.type != Type::table) {
    messages.add(table.at, fmt::format("sequence = {}; must be a table with \"steps\"", table.describe()));
    return sequence;
  }
  static const Kind kind{.name = "sequence", .keys = sequence_keys()};
  const Section section = read_section(table, kind, "", "[sequence]", messages, {"steps"});
  sequence.repeat = section.has("repeat") && section["repeat"].flag;
  StepReader reader(components, is_component, messages);
  if (const DocumentEntry* steps = table.find("steps"))
    read_steps(steps->value, reader, messages, sequence);
  else
    messages.add(table.at, "[sequence]: \"steps\" is missing");
  if (section.valid && !sequence.steps.empty()) read_repetition(section, table.at, messages, sequence);
  return sequence;
}

}  // namespace kurbel
