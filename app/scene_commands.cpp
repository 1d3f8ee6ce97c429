// scene_commands.cpp — commands that help to write a scene, or to find commands: check, figures, new, keys, schema, commands.
#include "app/command_line.h"
#include "app/terminal.h"
#include "app/verb.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/events/equations.h"
#include "engine/model/model.h"
#include "engine/scene/keys.h"
#include "engine/scene/units.h"
#include "studies/data/named.h"
#include "studies/files/whole_file.h"
#include "studies/run/run_findings.h"
#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"
#include "studies/scenes/schema.h"
#include "studies/scenes/templates.h"
#include "studies/scenes/train_sheet.h"

namespace kurbel::app::scene_commands {
namespace {

namespace fs = std::filesystem;

// "press, pump, …"
std::string names_of_templates() {
  std::string names;
  for (const SceneTemplate& scene : scene_templates())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", scene.name);
  return names;
}

const SceneTemplate& template_named(const std::string& kind) {
  if (kind.empty())
    throw std::invalid_argument(
        fmt::format("which kind of machine? Write e.g. kurbel new press; allowed: {}", names_of_templates()));
  return named(scene_templates(), &SceneTemplate::name, kind, "no scene {} to start from{}; allowed: {}");
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

// Writes a scene to start from, with the schema for editors beside it; refuses to overwrite. `again`: the command for
// another file name.
int write_scene(std::string_view text, const std::string& doc, const fs::path& path, const std::string& again,
                const std::string& first = "") {
  const fs::path schema = path.parent_path() / "scene.schema.json";
  const std::string_view body = text.substr(text.starts_with("#:schema") ? text.find('\n') + 1 : 0);
  const bool taken = fs::exists(fs::symlink_status(path));
  if (taken || !write_whole(path, fmt::format("#:schema ./scene.schema.json\n{}", body), Existing::keep))
    throw std::invalid_argument(fmt::format(
        "{} exists already and is left as it is; name another file: kurbel new {} FILE", path.string(), again));
  const bool fresh = !fs::exists(fs::symlink_status(schema)) && write_whole(schema, scene_schema(), Existing::keep);
  const std::string word = as_word(path.string());
  say(fmt::format("wrote {} — {}\n", path.string(), doc));
  if (fresh) say(fmt::format("wrote {} — editors complete and check keys by it\n", schema.string()));
  say(fmt::format(
      "next:\n{2}  kurbel compare {0}    the rigid against the elastic machine: is the rigid model sufficient?\n"
      "  kurbel run {0}        the machine as the scene says\n"
      "  kurbel check {0}      after a change: is the scene valid?\n"
      "  kurbel keys coupling{1}    what a component may hold; `kurbel keys` without a kind: everything\n",
      word, std::string(word.size() > 5 ? word.size() - 5 : 0, ' '),
      first.empty() ? "" : fmt::format("  kurbel modes {}    {}\n", word, first)));
  return exit_done;
}

int new_scene(const std::string& kind, const std::string& file) {
  const SceneTemplate& scene = template_named(kind);
  return write_scene(scene.text, scene.doc, file.empty() ? fs::path(kind + ".toml") : fs::path(file), kind);
}

// From a mass–elastic sheet; errors of the scene reader and compiler are reported before anything is written.
int new_from_sheet(const std::string& sheet, const std::string& file) {
  const std::string text = scene_of_sheet(sheet);
  const fs::path path = file.empty() ? fs::path(sheet).filename().replace_extension(".toml") : fs::path(file);
  const Scene scene = parse_scene(text, path.string(), all_kinds());
  compile(scene, scene.effects);
  return write_scene(text, "the train of " + sheet, path, "--from " + as_word(sheet),
                     "natural frequencies, and separation margins once [operation] says where it runs");
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
  say(keys_of(kind));
  return exit_done;
}

int check(const std::string& file, bool allow_files, const std::vector<std::string>& set) {
  const Scene scene = read(file, allow_files, set);
  const auto model = compile(scene, scene.effects);
  if (!scene.figures.empty()) figure_list(*model);  // refuses a channel that the machine does not have
  Equations(model, false).start(0);                 // refuses a start that the machine cannot have
  const auto coordinates = model->free_shafts + model->twist_count();
  say(fmt::format("{}: valid; {} component{}, {} coordinate{} with effects: {}\n", file, scene.components.size(),
                  scene.components.size() == 1 ? "" : "s", coordinates, coordinates == 1 ? "" : "s",
                  scene.effects.describe()));
  for (const std::string& note : notes_on_arcs(*model)) say(fmt::format("note: {}\n", note));
  return exit_done;
}

int figures(const std::string& file, bool allow_files, const std::vector<std::string>& set) {
  const Scene scene = read(file, allow_files, set);
  for (const Figure& f : figure_list(*compile(scene, scene.effects)))
    say(fmt::format("{}{}\n", f.name, f.unit.empty() ? "" : fmt::format(" [{}]", f.unit)));
  return exit_done;
}

// A scene and its settings.
struct SceneArguments {
  std::string file;
  bool allow_files = false;
  std::vector<std::string> set;
};
template <int (*action)(const std::string&, bool, const std::vector<std::string>&)>
void set_up_with_scene(OptionList& command, int& code) {
  const auto scene = std::make_shared<SceneArguments>();
  add_scene(command, scene->file, scene->allow_files, scene->set);
  command.action([&code, scene] { code = action(scene->file, scene->allow_files, scene->set); });
}

void set_up_new(OptionList& command, int& code) {
  struct Wanted {
    std::string kind, file, sheet;
    bool list = false;
  };
  const auto wanted = std::make_shared<Wanted>();
  command.add_option("kind", wanted->kind, names_of_templates());
  command.add_option("file", wanted->file, "file to write (default: KIND.toml); one that exists is never overwritten");
  command.add_flag("--list", wanted->list, "only the names of the kinds, a line each");
  command.add_option("--from", wanted->sheet,
                     "mass–elastic sheet of a train, .csv or .xlsx: station, inertia, stiffness, speed ratio, "
                     "diameter; a list of discs and shafts with a column \"to\". In place of the kind");
  command.action([&code, wanted] {
    code = exit_done;
    if (!wanted->sheet.empty() && !wanted->file.empty())
      throw std::invalid_argument("--from makes the scene of the sheet: leave the kind out");
    if (!wanted->sheet.empty())
      code = new_from_sheet(wanted->sheet, wanted->kind);
    else if (!wanted->list)
      code = new_scene(wanted->kind, wanted->file);
    else
      for (const SceneTemplate& scene : scene_templates()) say(fmt::format("{}\n", scene.name));
  });
}

void set_up_keys(OptionList& command, int& code) {
  const auto wanted = std::make_shared<std::pair<std::string, bool>>("", false);
  command.add_option("kind", wanted->first, "e.g. coupling, \"induction motor\", run (default: all)");
  command.add_flag("--list", wanted->second, "only the names of the kinds, a line each");
  command.action([&code, wanted] { code = print_keys(wanted->first, wanted->second); });
}

void set_up_schema(OptionList& command, int& code) {
  command.action([&code] {
    say(scene_schema());
    code = exit_done;
  });
}

// Input for completion, manual page, docs/commands.md and the Python module's stub.
void set_up_commands(OptionList& command, int& code) {
  struct Wanted {
    std::string name;
    bool manual = false, markdown = false, stubs = false;
  };
  const auto wanted = std::make_shared<Wanted>();
  command.add_option("command", wanted->name, "its options, a line each (default: the commands, a line each)");
  command.add_flag("--manual", wanted->manual, "all commands with their options, for the manual page (roff)");
  command.add_flag("--markdown", wanted->markdown, "all commands as a table (Markdown)");
  command.add_flag("--stubs", wanted->stubs, "questions as functions of the Python module, for its stub");
  command.action([&code, wanted] {
    say(wanted->manual         ? verbs_as_manual()
        : wanted->markdown     ? verbs_as_markdown()
        : wanted->stubs        ? questions_as_stubs()
        : wanted->name.empty() ? names_of_verbs()
                               : options_of_verb(wanted->name));
    code = exit_done;
  });
}

const Verb check_verb{{{.place = 120,
                        .name = "check",
                        .arguments = "scene.toml",
                        .help = "validate a scene",
                        .does = "validates only; all errors at once as `file:line:col: what, got, allowed, next step`"},
                       set_up_with_scene<check>}};
const Verb figures_verb{{{.place = 130,
                          .name = "figures",
                          .arguments = "scene.toml",
                          .help = "list the figures that runs of a scene yield",
                          .does = "names of the figures that runs of the scene yield"},
                         set_up_with_scene<figures>}};
const Verb new_verb{{{.place = 140,
                      .name = "new",
                      .arguments = "press",
                      .help = "write a commented scene to start from",
                      .does = "writes a commented scene to start from: " + names_of_templates() +
                              "; or the train of a manufacturer's mass–elastic sheet (`--from`); a file that exists is "
                              "never overwritten. Beside "
                              "it, where there is none, the schema by "
                              "which editors complete and check keys"},
                     set_up_new}};
const Verb keys_verb{
    {{.place = 150,
      .name = "keys",
      .arguments = "coupling",
      .help = "print the keys of one kind, or of a whole scene (Markdown)",
      .does = "keys of one kind, for the terminal; without a kind every key of a scene with unit, default "
              "and domain (docs/keys.md)"},
     set_up_keys}};
const Verb schema_verb{{{.place = 160,
                         .name = "schema",
                         .help = "print the JSON Schema of a scene, for editors",
                         .does = "JSON Schema of a scene (docs/scene.schema.json): editors complete and check by its "
                                 "`#:schema` line"},
                        set_up_schema}};
const Verb commands_verb{{{.place = 170,
                           .name = "commands",
                           .arguments = "run",
                           .help = "list the commands, or the options of one, for completion and manual",
                           .does = "options of a command, a line each, as completion uses them; without a name the "
                                   "commands"},
                          set_up_commands}};

}  // namespace
}  // namespace kurbel::app::scene_commands
