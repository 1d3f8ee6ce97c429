// mutator.cpp — one change at a time; which ones, the random numbers say.
#include "tests/fuzz/mutator.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/reading/sequence_reader.h"
#include "engine/scene/effects.h"
#include "engine/scene/scene.h"
#include "engine/scene/units.h"
#include "studies/scenes/kinds.h"
#include "tests/fuzz/key_values.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/toml_text.h"

namespace kurbel::fuzz {
namespace {

using Type = DocumentValue::Type;

constexpr std::size_t longest = 100'000;

// --- bytes, words, lines ---

const std::vector<std::string>& words() {
  static const std::vector<std::string> list = {"\"",          "'",       "\"\"\"",  "[",        "]",
                                                "[[",          "]]",      "{",       "}",        "=",
                                                ",",           ".",       "#",       "\n",       "\r\n",
                                                "\t",          "-",       "+",       "_",        "e",
                                                "1e999",       "nan",     "inf",     "0x1F",     "1979-05-27",
                                                "true",        "kind",    "line",    "[run]",    "[effects]",
                                                "[[branch]]",  "from",    "points",  "file",     "period",
                                                "over",        "unit",    "until",   "\xC2\xB2", "\xE2\x88\x92",
                                                "\xFF",        "\x1B[2J", "\\u0000", "\\",       std::string(1, '\0'),
                                                "5",           "9",       "0",       "formula",  "= 2*c0",
                                                "[constants]", "use",     "table.a", "abs(",     "^1.3"};
  return list;
}

std::size_t line_start(const std::string& text, std::size_t at) {
  const std::size_t newline = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return newline == std::string::npos ? 0 : newline + 1;
}

// --- the tree ---

// A table with its keys, where they are known.
struct KnownTable {
  DocumentValue* table;
  const std::vector<Key>* keys;
};

const Kind* kind_of(const DocumentValue& table, const std::vector<Kind>& kinds) {
  const DocumentEntry* kind = table.find("kind");
  for (const Kind& k : kinds)
    if (kind && k.name == kind->value.text) return &k;
  return nullptr;
}

void collect(DocumentValue& table, const std::vector<Key>& keys, std::vector<KnownTable>& found) {
  found.push_back({&table, &keys});
  for (const Key& key : keys) {
    const bool named = key.type == KeyType::named;
    DocumentEntry* entry = named || key.type == KeyType::sections ? find(table, key.name) : nullptr;
    if (!entry) continue;
    if (named) {
      for (DocumentEntry& one : entry->value.entries)
        if (one.value.type == Type::table) collect(one.value, key.nested->front().keys, found);
      continue;
    }
    const auto visit = [&](DocumentValue& value) {
      if (value.type != Type::table) return;
      const Kind* kind = key.nested->size() == 1 ? &key.nested->front() : kind_of(value, *key.nested);
      if (kind) collect(value, kind->keys, found);
    };
    visit(entry->value);
    for (DocumentValue& item : entry->value.items) visit(item);
  }
}

std::vector<KnownTable> known_tables(DocumentValue& scene) {
  std::vector<KnownTable> found;
  for (DocumentEntry& entry : scene.entries) {
    if (entry.value.type != Type::table) continue;
    if (entry.key == "run") collect(entry.value, run_keys(), found);
    if (const Kind* kind = kind_of(entry.value, all_kinds())) collect(entry.value, kind->keys, found);
    if (entry.key != "sequence") continue;
    if (DocumentEntry* steps = find(entry.value, "steps"))
      for (DocumentValue& step : steps->value.items)
        if (step.type == Type::table) collect(step, sequence_step_keys(), found);
  }
  return found;
}

std::vector<std::string> component_names(const DocumentValue& scene) {
  std::vector<std::string> names;
  for (const DocumentEntry& entry : scene.entries)
    if (entry.value.type == Type::table && entry.value.find("kind")) names.push_back(entry.key);
  if (names.empty()) names.push_back("nobody");
  return names;
}

// Every value of the tree, with those that only hold others.
void collect_values(DocumentValue& value, std::vector<DocumentValue*>& all) {
  all.push_back(&value);
  for (DocumentValue& item : value.items) collect_values(item, all);
  for (DocumentEntry& entry : value.entries) collect_values(entry.value, all);
}

std::string misspelt(std::string word, Random& random) {
  if (word.empty()) return "x";
  const std::size_t at = random.index(word.size());
  if (random.chance(0.3)) return word.erase(at, 1);
  if (random.chance(0.5) && at + 1 < word.size())
    std::swap(word[at], word[at + 1]);
  else
    word[at] = static_cast<char>('a' + random.index(26));
  return word;
}

class TreeChange {
 public:
  TreeChange(DocumentValue& scene, Random& random, double wild) : scene_(scene), random_(random), wild_(wild) {}

  void once() {
    const double what = random_.uniform();
    if (what < 0.35) return set_key();
    if (what < 0.60) return scale_quantity();
    if (what < 0.66) return drop_entry();
    if (what < 0.70) return misspell_entry();
    if (what < 0.74) return replace_value();
    if (what < 0.78) return change_list();
    if (what < 0.84) return change_run();
    if (what < 0.89) return change_effects();
    if (what < 0.93) return add_component();
    if (what < 0.96) return change_line();
    if (what < 0.98) return change_sequence();
    splice();
  }

 private:
  void set_key() {
    std::vector<KnownTable> tables = known_tables(scene_);
    if (tables.empty()) return;
    const KnownTable& known = random_.one_of(tables);
    if (known.keys->empty()) return;
    const Key& key = random_.one_of(*known.keys);
    put(*known.table, key.name, value_for(key, random_, wild_));
  }
  // A quantity or number that stands there, by a factor; seldom to an end of what there is.
  void scale_quantity() {
    std::vector<DocumentValue*> all, numbers;
    collect_values(scene_, all);
    UnitError error;
    for (DocumentValue* value : all)
      if (value->type == Type::number || value->type == Type::integer ||
          (value->type == Type::text && parse_quantity(value->text, error)))
        numbers.push_back(value);
    if (numbers.empty()) return;
    DocumentValue& value = *random_.one_of(numbers);
    const bool extreme = random_.chance(wild_);
    const double by = random_.factor(random_.chance(0.3) ? 1e4 : 3);
    if (value.type == Type::integer) {
      value.integer = extreme ? static_cast<std::int64_t>(random_.bits() >> random_.index(64))
                              : static_cast<std::int64_t>(std::clamp(value.number * by, -9e18, 9e18));
    } else if (value.type == Type::number) {
      value.number = extreme ? extreme_number(any_number, random_) : value.number * by;
    } else {
      const std::size_t unit = std::min(value.text.find(' '), value.text.size());
      const double number =
          extreme ? extreme_number(any_number, random_) : by * std::strtod(value.text.c_str(), nullptr);
      value.text = fmt::format("{:.6g}{}", number, value.text.substr(unit));
    }
  }
  DocumentValue* some_table() {
    std::vector<DocumentValue*> all, tables;
    collect_values(scene_, all);
    for (DocumentValue* value : all)
      if (value->type == Type::table && !value->entries.empty()) tables.push_back(value);
    return tables.empty() ? nullptr : random_.one_of(tables);
  }
  void drop_entry() {
    if (DocumentValue* table = some_table())
      table->entries.erase(table->entries.begin() + static_cast<std::ptrdiff_t>(random_.index(table->entries.size())));
  }
  void misspell_entry() {
    DocumentValue* table = some_table();
    if (!table) return;
    DocumentEntry& entry = table->entries[random_.index(table->entries.size())];
    if (random_.chance(0.5) && entry.value.type == Type::text)
      entry.value.text = misspelt(entry.value.text, random_);
    else
      entry.key = misspelt(entry.key, random_);
  }
  void replace_value() {
    std::vector<DocumentValue*> all;
    collect_values(scene_, all);
    *random_.one_of(all) = any_value(random_);
    if (scene_.type != Type::table) scene_ = table_value();
  }
  void change_list() {
    std::vector<DocumentValue*> all, lists;
    collect_values(scene_, all);
    for (DocumentValue* value : all)
      if (value->type == Type::list && !value->items.empty()) lists.push_back(value);
    if (lists.empty()) return;
    std::vector<DocumentValue>& items = random_.one_of(lists)->items;
    const std::size_t a = random_.index(items.size()), b = random_.index(items.size());
    switch (random_.index(4)) {
      case 0:
        std::swap(items[a], items[b]);
        break;
      case 1:
        items.erase(items.begin() + static_cast<std::ptrdiff_t>(a));
        break;
      case 2: {
        const DocumentValue copy = items[a];
        items.insert(items.begin() + static_cast<std::ptrdiff_t>(b), copy);
        break;
      }
      default:
        items.push_back(any_value(random_));
    }
  }
  DocumentValue& table_at_top(const std::string& name) {
    if (!find(scene_, name)) put(scene_, name, table_value());
    DocumentValue& table = find(scene_, name)->value;
    if (table.type != Type::table) table = table_value();
    return table;
  }
  void change_run() {
    DocumentValue& run = table_at_top("run");
    const Key& key = random_.one_of(run_keys());
    if (random_.chance(0.5)) return put(run, key.name, value_for(key, random_, wild_));
    DocumentValue start = table_value();
    const Key speed{.name = "speed", .unit = "rad/s"}, angle{.name = "angle", .unit = "rad"};
    if (random_.chance(0.5)) put(start, "speed", value_for(speed, random_, wild_));
    if (random_.chance(0.4)) put(start, "angle", value_for(angle, random_, wild_));
    if (random_.chance(0.3)) put(start, "equilibrium", flag_value(random_.chance(0.7)));
    if (random_.chance(0.3)) put(start, "on", text_value(random_.one_of(component_names(scene_))));
    if (random_.chance(0.3)) {
      DocumentValue own = table_value();
      put(own, random_.chance(0.5) ? "twist" : "angle", value_for(angle, random_, wild_));
      put(start, random_.one_of(component_names(scene_)), own);
    }
    put(run, "start", random_.chance(0.1) ? text_value("equilibrium") : start);
  }
  void change_effects() {
    DocumentValue& effects = table_at_top("effects");
    const auto flags = effect_flags();
    if (random_.chance(0.3)) {
      put(effects, "elasticity",
          random_.chance(0.6) ? flag_value(random_.chance(0.8))
                              : list_value({text_value(random_.one_of(component_names(scene_)))}));
    } else {
      put(effects, flags[random_.index(flags.size())].name, flag_value(random_.chance(0.7)));
    }
  }
  void add_component() {
    const Kind& kind = random_.one_of(all_kinds());
    const std::string name = fmt::format("new{}", random_.index(5)), on = random_.one_of(component_names(scene_));
    DocumentValue table = table_for(kind, random_, 0.5 * wild_, true);
    if (kind.placement != Placement::inline_two && random_.chance(0.6)) {
      put(table, "on", text_value(on));
    } else if (DocumentEntry* line = find(scene_, "line"); line && line->value.type == Type::list) {
      auto& items = line->value.items;
      items.insert(items.begin() + static_cast<std::ptrdiff_t>(random_.index(items.size() + 1)), text_value(name));
    }
    put(scene_, name, std::move(table));
  }
  void change_line() {
    if (random_.chance(0.5)) {
      const std::string from = random_.one_of(component_names(scene_)) + (random_.chance(0.3)   ? ".in"
                                                                          : random_.chance(0.3) ? ".out"
                                                                                                : "");
      DocumentValue branch = table_value();
      put(branch, "from", text_value(from));
      put(branch, "line", list_value({text_value(random_.one_of(component_names(scene_)))}));
      if (!find(scene_, "branch")) put(scene_, "branch", list_value({}));
      find(scene_, "branch")->value.items.push_back(branch);
      return;
    }
    DocumentEntry* line = find(scene_, "line");
    if (!line || line->value.items.empty()) return;
    auto& items = line->value.items;
    const std::size_t at = random_.index(items.size());
    if (random_.chance(0.5)) {  // out of the line, and out of the scene
      const std::string name = items[at].text;
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(at));
      std::erase_if(scene_.entries, [&](const DocumentEntry& e) { return e.key == name; });
    } else {
      items[at] = text_value(random_.one_of(component_names(scene_)));
    }
  }
  void change_sequence() {
    DocumentValue& sequence = table_at_top("sequence");
    if (random_.chance(0.3)) put(sequence, "repeat", flag_value(random_.chance(0.7)));
    const Kind step{.name = "step", .keys = sequence_step_keys()};
    DocumentValue table = table_value();
    put(table, "set", text_value(random_.one_of(component_names(scene_))));
    const Key& when = step.keys[random_.index(5)];
    put(table, when.name, value_for(when, random_, wild_));
    if (when.name != "at" && when.name != "after")
      put(table, "of", text_value(random_.one_of(component_names(scene_))));
    for (const Key& key : step.keys)
      if ((key.name == "to" || key.name == "over") && random_.chance(0.6))
        put(table, key.name, value_for(key, random_, wild_));
    if (!find(sequence, "steps")) put(sequence, "steps", list_value({}));
    find(sequence, "steps")->value.items.push_back(table);
  }
  // A component of another scene in the place of one here.
  void splice() {
    try {
      const DocumentValue other = parse_toml(random_.one_of(good_scenes()).text, "seed");
      const std::string mine = random_.one_of(component_names(scene_)), theirs = random_.one_of(component_names(other));
      if (const DocumentEntry* entry = other.find(theirs)) put(scene_, mine, entry->value);
    } catch (const SceneError&) {
    }
  }

  DocumentValue& scene_;
  Random& random_;
  double wild_;
};

}  // namespace

void change_bytes(std::string& text, Random& random) {
  const std::size_t at = random.index(text.size() + 1), end = std::min(text.size(), at + 1 + random.index(12));
  switch (random.index(8)) {
    case 0:
      text.insert(at, random.one_of(words()));
      break;
    case 1:
      text.erase(at, end - at);
      break;
    case 2:
      if (at < text.size()) text[at] = static_cast<char>(random.bits());
      break;
    case 3:
      text.insert(random.index(text.size() + 1), text.substr(at, end - at));
      break;
    case 4: {  // a line twice, or away
      const std::size_t begin = line_start(text, at),
                        stop = std::min(text.find('\n', at), text.size() - (text.empty() ? 0 : 1)) + 1;
      const std::string line = text.substr(begin, stop > begin ? stop - begin : 0);
      if (random.chance(0.5))
        text.erase(begin, line.size());
      else
        text.insert(line_start(text, random.index(text.size() + 1)), line);
      break;
    }
    case 5:
      text.resize(at);
      break;
    case 6:
      if (end < text.size()) std::swap(text[at], text[end]);
      break;
    default:
      text.replace(at, end - at, random.one_of(words()));
  }
  if (text.size() > longest) text.resize(longest);
}

std::string mutated_scene(const std::string& text, Random& random, const MutationStyle& style) {
  const std::size_t changes = 1 + random.index(static_cast<std::size_t>(style.most));
  std::string changed = text;
  if (!random.chance(style.text_level)) try {
      DocumentValue scene = parse_toml(text, "seed");
      TreeChange change(scene, random, style.wild);
      for (std::size_t i = 0; i < changes; ++i) change.once();
      changed = toml_document(scene);
      if (changed.size() <= longest && !random.chance(0.1 * style.text_level)) return changed;
    } catch (const SceneError&) {  // no TOML: bytes it is
    }
  for (std::size_t i = 0; i < changes; ++i) change_bytes(changed, random);
  return changed;
}

std::string mutated_table(const std::string& text, Random& random, const MutationStyle&) {
  std::string changed = text;
  static const std::vector<std::string> cells = {",",  ";", "\t", "\n", "\r\n",   "1e999", "nan",          "0,5",
                                                 "\"", "#", "-",  "+1", "1e-320", "x",     "\xEF\xBB\xBF", "1 000"};
  for (std::size_t i = 1 + random.index(6); i-- > 0;)
    if (random.chance(0.5))
      change_bytes(changed, random);
    else
      changed.insert(random.index(changed.size() + 1), random.one_of(cells));
  return changed;
}

std::string scene_input(std::uint64_t seed, const MutationStyle& style) {
  Random random(seed);
  const std::string& text = random.one_of(style.bad_ones_too ? all_scenes() : good_scenes()).text;
  return mutated_scene(text, random, style);
}
std::string table_input(std::uint64_t seed, const MutationStyle&) {
  Random random(seed);
  return mutated_table(random.one_of(tables()).text, random);
}

}  // namespace kurbel::fuzz
