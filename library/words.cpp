// words.cpp — what figures mean, keys of kinds, scenes to start from.
#include "library/words.h"

#include <fmt/format.h>
#include <kurbel/figures.h>
#include <kurbel/scene.h>

#include <stdexcept>
#include <utility>

#include "engine/scene/messages.h"
#include "engine/scene/units.h"
#include "studies/data/named.h"
#include "studies/dictionary/dictionary.h"
#include "studies/dictionary/page_words.h"
#include "studies/report/theory.h"
#include "studies/scenes/kinds.h"
#include "studies/scenes/schema.h"
#include "studies/scenes/templates.h"

namespace kurbel {
namespace {

// "theory 2.6: Reduction …" as a report cites it.
std::string place_of(const Definition& d) {
  std::string text;
  for (const std::string& note : theory_notes(fmt::format("theory {}", d.theory))) text += note;
  return text;
}

std::string sentences_on(const Definition& d, const std::string& asked) {
  std::string text = fmt::format("{} — {}\n", d.words == word_of_pages ? asked : d.form(), d.words);
  if (const std::string says = said_of_channel(asked); !says.empty()) text += fmt::format("  {} is {}\n", asked, says);
  const auto line = [&](const char* what, const std::string& reported) {
    if (!reported.empty()) text += fmt::format("  {:<11}{}\n", what, reported);
  };
  line("is", std::string(d.is));
  line("formula", std::string(d.formula));
  if (d.words != word_of_pages) line("unit", d.unit.empty() ? "a plain number" : pretty_unit(d.unit));
  line("is not", std::string(d.is_not));
  line("given by", d.verbs.empty() ? "no command" : std::string(d.verbs));
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

}  // namespace

std::string explained(const std::string& figure) {
  const Definition* const found = meant_by(figure);
  if (!found) {
    // A fit's or sweep's unknown is a key of the scene: "rotor.inertia".
    const std::string keys = meanings_of_key(figure.substr(figure.rfind('.') + 1));
    if (keys.empty()) refuse(figure);
    return fmt::format("{} — key of a scene; all keys of a kind: kurbel keys KIND\n{}", figure, keys);
  }
  return sentences_on(*found, figure);
}

std::string explain(const std::string& figure) { return explained(figure); }

std::vector<std::string> explained_figures() {
  std::vector<std::string> names;
  for (const Definition& definition : dictionary()) names.emplace_back(definition.name);
  return names;
}

std::vector<std::string> kinds() { return names_of_keys(); }
std::string keys(const std::string& kind) { return keys_of(kind); }
std::string schema() { return scene_schema(); }

std::vector<std::string> example_scenes() {
  std::vector<std::string> names;
  for (const SceneTemplate& scene : scene_templates()) names.push_back(scene.name);
  return names;
}

std::string example_scene(const std::string& name) {
  return std::string(named(scene_templates(), &SceneTemplate::name, name, "no example scene {}{}; allowed: {}").text);
}

}  // namespace kurbel
