// kinds.cpp — gathers the kinds and prints their keys.
#include "studies/scenes/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>

#include "drivetrain/kinds.h"
#include "engine/reading/sequence_reader.h"
#include "engine/scene/scene.h"
#include "engine/scene/text.h"
#include "engine/scene/units.h"
#include "mechanisms/kinds/kinds.h"
#include "studies/data/named.h"

namespace kurbel {
namespace {

std::string type_of(const Key& key) {
  switch (key.type) {
    case KeyType::quantity:
      return key.unit.empty() ? "number" : pretty_unit(key.unit);
    case KeyType::quantities:
      return fmt::format("list of {}", pretty_unit(key.unit));
    case KeyType::integers:
      return "list of whole numbers";
    case KeyType::integer:
      return "whole number";
    case KeyType::flag:
      return "true or false";
    case KeyType::text:
      return key.choices.empty() ? "text" : listed(key.choices);
    case KeyType::curve:
      return fmt::format("table over {} → {}", listed(key.choices), pretty_unit(key.unit));
    case KeyType::sections:
      return "table(s)";
    case KeyType::named:
      return "table of names";
  }
  return "";
}

std::string domain_of(const Key& key) {
  const bool number = key.type == KeyType::quantity || key.type == KeyType::quantities ||
                      key.type == KeyType::integer || key.type == KeyType::integers;
  return number ? key.domain.describe(key.unit == "rad" ? key.unit : "") : "";
}

std::string rows(const std::vector<Key>& keys) {
  std::string text = "| key | unit or values | default | domain | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : keys)
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, type_of(key),
                        key.required           ? "**required**"
                        : key.fallback.empty() ? "—"
                                               : fmt::format("`{}`", key.fallback),
                        domain_of(key), key.doc);
  return text;
}

// Kinds of its nested tables, each once.
std::vector<const std::vector<Kind>*> nested_in(const Kind& kind) {
  std::vector<const std::vector<Kind>*> lists;
  for (const Key& key : kind.keys)
    if (key.nested && std::find(lists.begin(), lists.end(), key.nested) == lists.end()) lists.push_back(key.nested);
  return lists;
}

// Tables already printed, with the kind.
using Printed = std::map<const std::vector<Kind>*, std::string>;

std::string chapter(const Kind& kind, const char* level, Printed& printed) {
  std::string text = fmt::format("{} `{}`\n\n{}.", level, kind.name, kind.doc);
  if (kind.elastic) text += " Its elasticity is an effect.";
  if (kind.placement == Placement::inline_two) text += " Two shafts: `.in` and `.out`.";
  text += fmt::format("\n\n{}\n", rows(kind.keys));
  for (const std::vector<Kind>* kinds : nested_in(kind)) {
    if (const auto [before, fresh] = printed.try_emplace(kinds, kind.name); !fresh) {
      text += fmt::format("Its tables are those of `{}` above.\n\n", before->second);
      continue;
    }
    for (const Kind& nested : *kinds) text += chapter(nested, "####", printed);
  }
  return text;
}

// Columns below each other.
std::string aligned(const std::vector<Key>& keys) {
  std::vector<std::vector<std::string>> cells = {{"key", "unit or values", "default", "domain", "meaning"}};
  for (const Key& key : keys)
    cells.push_back({key.name, type_of(key),
                     key.required           ? "required"
                     : key.fallback.empty() ? "—"
                                            : key.fallback,
                     domain_of(key), key.doc});
  constexpr std::size_t widest = 30;
  std::vector<std::size_t> widths(4, 0);
  for (const auto& row : cells)
    for (std::size_t k = 0; k < 4; ++k) widths[k] = std::max(widths[k], std::min(characters(row[k]), widest));
  std::string text;
  for (const auto& row : cells) {
    std::string line = "  ";
    std::size_t begin = 2;
    for (std::size_t k = 0; k < 5; ++k) {
      if (k > 0 && characters(line) + 2 > begin) {  // a long list of values has the line for itself
        text += line + "\n";
        line.clear();
      }
      line += std::string(begin - characters(line), ' ') + row[k];
      if (k == 4) break;
      begin += widths[k] + 2;
    }
    while (line.ends_with(' ')) line.pop_back();
    text += line + "\n";
  }
  return text;
}

void add_kinds(const std::vector<Kind>& kinds, std::vector<const Kind*>& list) {
  for (const Kind& kind : kinds) list.push_back(&kind);
  for (const Kind& kind : kinds)
    for (const std::vector<Kind>* nested : nested_in(kind)) add_kinds(*nested, list);
}

// Components first, then nested kinds.
std::vector<const Kind*> kinds_with_nested() {
  std::vector<const Kind*> list;
  add_kinds(all_kinds(), list);
  return list;
}

}  // namespace

std::vector<std::string> names_of_keys() {
  std::vector<std::string> names;
  for (const Kind* kind : kinds_with_nested())
    if (std::ranges::find(names, kind->name) == names.end()) names.push_back(kind->name);
  names.insert(names.end(), {"run", "operation", "figure"});
  return names;
}

std::string keys_of(const std::string& name) {
  check_name(names_of_keys(), name, "no kind {}{}; allowed: {}");
  if (name == "run") return "[run]: what is simulated, and how well.\n\n" + aligned(run_keys());
  if (name == "figure") return "[[figure]]: a functional of a channel over a window.\n\n" + aligned(figure_keys());
  if (name == "operation") return "[operation]: where the machine runs for long.\n\n" + aligned(operation_keys());
  std::vector<std::string> parts;  // a kind that stands in several components, once
  for (const Kind* kind : kinds_with_nested()) {
    if (kind->name != name) continue;
    const bool nested = kind->placement == Placement::nested;
    std::string text =
        fmt::format("{} — {}.{}{}\n\n", kind->name, kind->doc, kind->elastic ? " Its elasticity is an effect." : "",
                    nested                                     ? " Stands inside a component."
                    : kind->placement == Placement::inline_two ? " Two shafts: .in and .out."
                                                               : "");
    text += aligned(kind->keys);
    for (const Key& key : kind->keys)
      if (key.nested) {
        std::vector<std::string> names;
        for (const Kind& inner : *key.nested) names.push_back(inner.name);
        text += fmt::format("\n  {}: tables of kind {}; see kurbel keys {}\n", key.name, listed(names), names.front());
      }
    if (std::find(parts.begin(), parts.end(), text) == parts.end()) parts.push_back(std::move(text));
  }
  return fmt::format("{}", fmt::join(parts, "\n"));
}

std::string meanings_of_key(const std::string& name) {
  std::vector<std::pair<std::string, std::string>> meanings;  // and the kinds that have it
  const auto take = [&](const std::string& kind, const std::vector<Key>& keys) {
    for (const Key& key : keys) {
      if (key.name != name) continue;
      const std::string domain = domain_of(key);
      const std::string means = fmt::format("  {:<11}{}\n  {:<11}{}{}\n", "is", key.doc, "unit", type_of(key),
                                            domain.empty() ? "" : "; domain: " + domain);
      const auto same = std::find_if(meanings.begin(), meanings.end(), [&](const auto& m) { return m.first == means; });
      if (same == meanings.end())
        meanings.emplace_back(means, kind);
      else if ((", " + same->second + ",").find(", " + kind + ",") == std::string::npos)
        same->second += ", " + kind;
    }
  };
  for (const Kind* kind : kinds_with_nested()) take(kind->name, kind->keys);
  take("run", run_keys());
  take("operation", operation_keys());
  take("figure", figure_keys());
  std::string text;
  for (const auto& [means, kinds] : meanings) text += fmt::format("{}  {:<11}{}\n", means, "key of", kinds);
  return text;
}

namespace {

// Sections point into the list of kinds at reading, so that earlier lists are kept, to the end of the program.
struct KnownKinds {
  std::mutex mutex;
  std::deque<std::vector<Kind>> lists;
};

KnownKinds& known_kinds() {
  static KnownKinds& known = *new KnownKinds;
  if (const std::scoped_lock lock(known.mutex); known.lists.empty()) {
    std::vector<Kind> list = drivetrain_kinds();
    for (Kind& kind : mechanism_kinds()) list.push_back(std::move(kind));
    known.lists.push_back(std::move(list));
  }
  return known;
}

}  // namespace

const std::vector<Kind>& all_kinds() {
  KnownKinds& known = known_kinds();
  const std::scoped_lock lock(known.mutex);
  return known.lists.back();
}

void add_kind(Kind kind) {
  KnownKinds& known = known_kinds();
  const std::scoped_lock lock(known.mutex);
  std::vector<Kind> list = known.lists.back();
  for (const Kind& there : list)
    if (there.name == kind.name) throw std::invalid_argument(fmt::format("kind {} is known", in_quotes(kind.name)));
  list.push_back(std::move(kind));
  known.lists.push_back(std::move(list));
}

const char* unsaid_text(const EffectFlag& effect) {
  return effect.by_default == EffectFlag::Default::off           ? "off"
         : effect.by_default == EffectFlag::Default::where_given ? "on where the scene gives that"
         : effect.by_default == EffectFlag::Default::with_elasticity
             ? "on where anything is elastic"
             : "on, even in the rigid machine; off by name alone";
}

std::string keys_in_markdown() {
  std::string text =
      "# Keys of a scene\n\n"
      "Printed by `kurbel keys`, from the same table that the reader uses; a test holds this file against it.\n\n"
      "Quantities are texts with a unit (\"1500 rpm\", \"4 kN*m/rad\", \"12 mm\"); the angle is a dimension of its "
      "own. Plain\n"
      "numbers, fractions (\"1/80\") and percent stand only where a value has no unit. A speed in 1/min or Hz counts\n"
      "turns: \"60 1/min\" is 60 rpm, \"1 Hz\" is 1 rev/s; \"1/s\", turns or radians, is refused. A component's\n"
      "table may carry `on = \"component\"` in place of a position in a line. A characteristic (\"table over …\") is "
      "written\n"
      "`{ over = \"angle\", unit = [\"deg\", \"N*m\"], points = [[0, 0], [90, 12]] }` or with a file "
      "([below](#files-of-tables)),\n"
      "`interpolation = \"linear\"` (straight between the points) or `\"smooth\"` (a monotone cubic: no kinks,\n"
      "no overshoot), and `period` where it repeats. Two points at one x are a jump. `gain`, `offset` and `shift` "
      "correct it:\n"
      "gain · y + offset over x + shift.\n\n"
      "**Beyond its ends** (`beyond`; not of a table over an angle, which repeats): `\"hold\"`, its end values; "
      "`\"line\"`, its end slopes; `\"refuse\"`, a motion "
      "that gets\n"
      "there. The continuation then counts as data. Without it the end values hold; a drive continues along its last\n"
      "slope if that falls. If it does not fall, and the drive still drives at its last speed, a motion that gets "
      "there is "
      "refused.\n"
      "Of a drive whose table ends at torque 0, its no-load speed, that slope counts as data up to 5 % above it. A "
      "motion "
      "that\n"
      "leaves the table is reported, and figures that depend on it have no error bar.\n\n"
      "In place of points it may have a formula: `{ over = \"travel\", formula = \"p0*A*(s0/(s0 + x))^1.3\", range = "
      "[\"0 mm\", \"200 mm\"],\n"
      "with = { s0 = \"20 mm\" } }`; see [formulas.md](formulas.md). `use = \"table.gas\"` takes what is not given "
      "from `[table.gas]`. Any\n"
      "quantity may be a formula of `[constants]`: `stiffness = \"= G*pi*d^4/(32*l)/1 rad\"`, or have a tolerance, "
      "which `kurbel uncertainty` reads: `stiffness = { value = \"900 kN*m/rad\", tolerance = \"10 %\", distribution = "
      "\"normal\", k = 2 }`, or `from` and `to`; `\"uniform\"`, `\"triangular\"`.\n\n"
      "Values of SI units are 0 or of a size of 1e-30 … 1e30 (angles: at most 1e9 rad, without a lower limit), so that "
      "products of\nten of them are numbers. At most: 16 MB for a scene, 64 MB and 1000000 rows for a table, 100000 "
      "values in a list,\n1000000 shaft ends, and 1000 gears with losses, planetary gears and gears in housings.\n\n"
      "## Files of tables\n\n"
      "`file = \"data.csv\"` takes two columns of a `.csv` or `.xlsx` file (its first sheet, or `sheet = \"…\"`) or of "
      "the vectors of a `.mat` file: the first two,\n"
      "`columns = [1, 4]`, or by the names of the heading, `columns = [\"speed\", \"torque\"]`. Cells are separated by "
      "comma,\n"
      "semicolon or tab, whichever gives numbers in most lines; decimals have a point, or a comma where it can be "
      "nothing "
      "else (else\n"
      "`decimal = \",\"`). Lines with #, banners above the heading, a line of units below it, and empty columns are "
      "skipped.\n"
      "Units are those of the heading, `speed [rad/s]` or `speed (rad/s)`; `unit` may then be omitted, and is refused "
      "if "
      "it\n"
      "differs. Ambiguous input is refused with its line.\n\n"
      "## At the top\n\n"
      "| key | meaning |\n|---|---|\n"
      "| `title`, `description` | texts |\n"
      "| `line` | names of the components in the order of the drive |\n"
      "| `[[branch]]` | `from = \"component\"` (`\"gearbox.out\"`) and `line = [...]`; with `to = \"component\"` it "
      "ends there and closes a loop |\n"
      "| `[effects]` | `elasticity = true`, `false` or a list of components; the effects below, `true` or `false` |\n"
      "| `[constants]` | names with their values, which formulas may use: `p0 = \"1 bar\"` |\n"
      "| `[table.NAME]` | a table that others take by `use = \"table.NAME\"` |\n"
      "| `[sequence]` | `steps = [...]`, each waiting for the one before it; `repeat = true`, or by the clock: "
      "`every`, `rate` |\n"
      "| `[operation]` | where the machine runs for long; separation margins of `kurbel modes` |\n"
      "| `[[case]]` | a named variant, as a damper out of order: `name = \"…\"`, `set = [\"damper.damping=0 "
      "N*m*s/rad\"]` as `--set` takes them; `kurbel modes` and `kurbel report` give each its own forced response and "
      "margins |\n"
      "| `[[figure]]` | a further figure of runs or of the steady cycle: a functional of a channel over a window |\n\n"
      "## `[effects]`\n\n"
      "| effect | what it adds | needs | states, events | matters | unless mentioned |\n|---|---|---|---|---|---|\n"
      "| `elasticity` | couplings and shafts twist | a stiffness | a twist and a speed each | where an excitation "
      "meets a "
      "mode; starts and shocks | off |\n";
  for (const EffectFlag& effect : effect_flags())
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", effect.name, effect.adds, effect.parameters,
                        effect.states, effect.matters, unsaid_text(effect));
  text +=
      "\n## Steps of `[sequence]`\n\n`steps = [{ at = \"0.2 s\", set = [\"clutch\", \"brake\"], to = 0, over = \"40 "
      "ms\" }, { angle = \"130 deg\", of = \"press\", set = \"brake\" }]`. `set` names the components: clutches, "
      "brakes and motors take any value of `to`, everything else (motors on a starter, too, which begin their start "
      "anew) is on or off, at once; of a mechanism its loads are, while its links move on (valves held open at a "
      "start; a press that strikes every third time: three steps at one angle, to = 1, 0, 0, and `repeat`); one of "
      "several loads by its number, `set = \"press.load2\"`: it acts where neither the mechanism nor itself has the "
      "command 0. With `law` in place of `to` and `over` a command follows a table or a formula of the time since its "
      "step.\n\n";
  text += rows(sequence_step_keys());
  text +=
      "\n## `[sequence]`\n\nThe steps, and when they begin again: with `every`, a repetition that takes longer delays "
      "the next one, and the events say so.\n\n" +
      rows(sequence_keys());
  text += "\n## `[run]`\n\n" + rows(run_keys());
  text +=
      "| `output` | list of names | all | | components in trajectory.csv |\n"
      "| `start` | \"rest\", \"equilibrium\" or a table | `\"rest\"` | | see below |\n\n"
      "`start = { speed = \"300 rpm\", angle = \"0 deg\", on = \"motor\", equilibrium = true, press = { speed = \"3 "
      "rad/s\" }, main_coupling = { twist = \"0.1 deg\" } }`: `speed` and `angle` belong to the reduction link (the "
      "first mechanism's crank, else the first shaft of the line) or to the component named by `on`; the rest of the "
      "machine follows rigidly unless components say otherwise. `equilibrium` gives each elastic element the twist "
      "that carries the torque which the rigid machine would transmit there at that moment. Of a slider or rocker, "
      "too, a machine may start: `start = { on = \"press.slider\", position = \"430 mm\", velocity = \"-0.2 m/s\", "
      "towards = \"folded\" }`, the position from the crank's axis as in `position.press`; `towards` says on which "
      "stroke it stands as the crank turns forwards (`\"extended\"`, `\"folded\"`; of a rocker `\"greatest\"`, "
      "`\"least\"`), by default the one along its velocity, at rest the one towards the folded end.\n\n"
      "## `[operation]`\n\n" +
      rows(operation_keys()) +
      "| `converter` | list of texts | — | | harmonics of the frequency converter that feeds `motor`: \"6\" of its "
      "output frequency, \"2 mains\", \"6 output - 6 mains\" |\n\n"
      "What excites, for the separation margins of `kurbel modes`, besides the scene's own laws: 1× and 2× of every "
      "shaft, meshing teeth, the mains, and `orders = [5]` in a component's table: blades or teeth, of the turn of its "
      "shaft (of one with two shafts, `.in`).\n\n"
      "## `[[figure]]`\n\nNamed by its parts, `time_above_torque.40kN*m.main_coupling`, `step_mean_speed.2.motor`, "
      "`run_up_rms_torque.motor`, and then swept, compared and explained as every figure. Its error is measured by the "
      "other runs, and crossings of a level are located on the solution within the steps.\n\n" +
      rows(figure_keys()) + "\n## Components\n\n";
  Printed printed;
  for (const Kind& kind : all_kinds()) text += chapter(kind, "###", printed);
  return text;
}

}  // namespace kurbel
