// scene_commands.cpp — commands that help to write a scene: check, figures, new, keys, schema.
#include "app/command_line.h"
#include "app/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/model/model.h"
#include "engine/scene/keys.h"
#include "engine/scene/units.h"
#include "studies/files/whole_file.h"
#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"
#include "studies/scenes/schema.h"
#include "studies/scenes/templates.h"

namespace kurbel::app {
namespace {

namespace fs = std::filesystem;

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const auto near = nearest(word, names);
  return near ? fmt::format(" — did you mean \"{}\"?", *near) : "";
}

const SceneTemplate& template_named(const std::string& kind) {
  std::vector<std::string> names;
  for (const SceneTemplate& scene : scene_templates()) {
    if (scene.name == kind) return scene;
    names.push_back(scene.name);
  }
  if (kind.empty())
    throw std::invalid_argument(
        fmt::format("which kind of machine? Write e.g. kurbel new press; allowed: {}", listed(names)));
  throw std::invalid_argument(fmt::format("no scene {} to start from{}; allowed: {}", in_quotes(kind),
                                          did_you_mean(kind, names), listed(names)));
}

// The path as one word of a shell's line.
std::string as_word(const std::string& path) {
  const bool plain =
      path.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./") == std::string::npos;
  if (plain) return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// Writes a scene to start from and, for editors, the schema beside it; refuses to overwrite.
int new_scene(const std::string& kind, const std::string& file) {
  const SceneTemplate& scene = template_named(kind);
  const fs::path path = file.empty() ? fs::path(kind + ".toml") : fs::path(file);
  const fs::path schema = path.parent_path() / "scene.schema.json";
  const std::string_view body = scene.text.substr(scene.text.starts_with("#:schema") ? scene.text.find('\n') + 1 : 0);
  const bool taken = fs::exists(fs::symlink_status(path));
  if (taken || !write_whole(path, fmt::format("#:schema ./scene.schema.json\n{}", body), Existing::keep))
    throw std::invalid_argument(fmt::format(
        "{} exists already and is left as it is; name another file: kurbel new {} FILE", path.string(), kind));
  const bool fresh = !fs::exists(fs::symlink_status(schema)) && write_whole(schema, scene_schema(), Existing::keep);
  const std::string word = as_word(path.string());
  say(fmt::format("wrote {} — {}\n", path.string(), scene.doc));
  if (fresh) say(fmt::format("wrote {} — editors complete and check keys by it\n", schema.string()));
  say(
      fmt::format("next:\n"
                  "  kurbel compare {0}    the rigid against the elastic machine: is rigid good enough?\n"
                  "  kurbel run {0}        the machine as the scene says\n"
                  "  kurbel check {0}      after a change: is the scene sound?\n"
                  "  kurbel keys coupling{1}    what a component may hold; `kurbel keys` without a kind: everything\n",
                  word, std::string(word.size() > 5 ? word.size() - 5 : 0, ' ')));
  return exit_done;
}

// All keys as Markdown, or those of one kind as text for a terminal.
int print_keys(const std::string& kind, bool list_kinds) {
  if (list_kinds) {
    for (const std::string& name : names_of_keys()) say(fmt::format("{}\n", name));
    return exit_done;
  }
  if (kind.empty()) {
    say(keys_in_markdown());
    return exit_done;
  }
  const std::vector<std::string> names = names_of_keys();
  if (std::find(names.begin(), names.end(), kind) == names.end())
    throw std::invalid_argument(
        fmt::format("no kind {}{}; allowed: {}", in_quotes(kind), did_you_mean(kind, names), listed(names)));
  say(keys_of(kind));
  return exit_done;
}

int check(const std::string& file, bool allow_files, const std::vector<std::string>& set) {
  const Scene scene = read(file, allow_files, set);
  const auto model = compile(scene, scene.effects);
  const auto coordinates = model->free_shafts + model->twist_count();
  say(fmt::format("{}: sound; {} component{}, {} coordinate{} with effects: {}\n", file, scene.components.size(),
                  scene.components.size() == 1 ? "" : "s", coordinates, coordinates == 1 ? "" : "s",
                  scene.effects.describe()));
  return exit_done;
}

int figures(const std::string& file, bool allow_files, const std::vector<std::string>& set) {
  const Scene scene = read(file, allow_files, set);
  for (const Figure& f : figure_list(*compile(scene, scene.effects)))
    say(fmt::format("{}{}\n", f.name, f.unit.empty() ? "" : fmt::format(" [{}]", f.unit)));
  return exit_done;
}

}  // namespace

void add_scene_commands(CLI::App& app, int& code) {
  struct Words {
    std::string first, second;
    bool list = false, allow_files = false;
    std::vector<std::string> set;
  };
  const auto add = [&](const char* name, const char* what, int (*action)(const Words&)) {
    const auto words = std::make_shared<Words>();
    CLI::App* command = app.add_subcommand(name, what);
    command->callback([&code, words, action] { code = action(*words); });
    return std::pair{command, words};
  };
  const auto [check_command, checked] =
      add("check", "validate a scene", [](const Words& w) { return check(w.first, w.allow_files, w.set); });
  add_scene(*check_command, checked->first, checked->allow_files, checked->set);
  const auto [figures_command, listed_scene] =
      add("figures", "list the figures that runs of a scene yield",
          [](const Words& w) { return figures(w.first, w.allow_files, w.set); });
  add_scene(*figures_command, listed_scene->first, listed_scene->allow_files, listed_scene->set);
  const auto [new_command, made] =
      add("new", "write a commented scene to start from", [](const Words& w) { return new_scene(w.first, w.second); });
  std::string kinds;
  for (const SceneTemplate& scene : scene_templates())
    kinds += fmt::format("{}{}", kinds.empty() ? "" : ", ", scene.name);
  new_command->add_option("kind", made->first, kinds);
  new_command->add_option("file", made->second,
                          "file to write (default: KIND.toml); one that exists is never overwritten");
  const auto [keys_command, kind] = add("keys", "print the keys of one kind, or of a whole scene (Markdown)",
                                        [](const Words& w) { return print_keys(w.first, w.list); });
  keys_command->add_option("kind", kind->first, "e.g. coupling, \"induction motor\", run (default: all)");
  keys_command->add_flag("--list", kind->list, "only the names of the kinds, a line each");
  add("schema", "print the JSON Schema of a scene, for editors", [](const Words&) {
    say(scene_schema());
    return exit_done;
  });
}

}  // namespace kurbel::app
