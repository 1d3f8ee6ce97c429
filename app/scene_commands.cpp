// scene_commands.cpp — a new scene, its keys.
#include "app/scene_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "engine/keys.h"
#include "engine/units.h"
#include "studies/kinds.h"
#include "studies/schema.h"
#include "studies/templates/templates.h"

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

void write_new(const fs::path& path, std::string_view text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out)
    throw std::invalid_argument(
        fmt::format("cannot write {}: is there such a folder, room and permission?", path.string()));
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

}  // namespace

int new_scene(const std::string& kind, const std::string& file) {
  const SceneTemplate& scene = template_named(kind);
  const fs::path path = file.empty() ? fs::path(kind + ".toml") : fs::path(file);
  const fs::path schema = path.parent_path() / "scene.schema.json";
  if (fs::exists(fs::symlink_status(path)))
    throw std::invalid_argument(fmt::format(
        "{} exists already and is left as it is; name another file: kurbel new {} FILE", path.string(), kind));
  const std::string_view body = scene.text.substr(scene.text.starts_with("#:schema") ? scene.text.find('\n') + 1 : 0);
  write_new(path, fmt::format("#:schema ./scene.schema.json\n{}", body));
  const bool fresh = !fs::exists(fs::symlink_status(schema));
  if (fresh) write_new(schema, scene_schema());
  const std::string word = as_word(path.string());
  fmt::print("wrote {} — {}\n", path.string(), scene.doc);
  if (fresh) fmt::print("wrote {} — editors complete and check keys by it\n", schema.string());
  fmt::print(
      "next:\n"
      "  kurbel compare {0}    the rigid against the elastic machine: is rigid good enough?\n"
      "  kurbel run {0}        the machine as the scene says\n"
      "  kurbel check {0}      after a change: is the scene sound?\n"
      "  kurbel keys coupling{1}    what a component may hold; `kurbel keys` without a kind: everything\n",
      word, std::string(word.size() > 5 ? word.size() - 5 : 0, ' '));
  return 0;
}

int print_keys(const std::string& kind) {
  if (kind.empty()) {
    fmt::print("{}", keys_in_markdown());
    return 0;
  }
  const std::vector<std::string> names = names_of_keys();
  if (std::find(names.begin(), names.end(), kind) == names.end())
    throw std::invalid_argument(
        fmt::format("no kind {}{}; allowed: {}", in_quotes(kind), did_you_mean(kind, names), listed(names)));
  fmt::print("{}", keys_of(kind));
  return 0;
}

}  // namespace kurbel::app
