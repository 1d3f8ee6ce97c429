// fields.cpp — the faults of tables of keys, and those that their readings share.
#include "engine/scene/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace kurbel::fields_detail {

int whole(double number) {
  using Int = std::numeric_limits<int>;
  return static_cast<int>(std::clamp(number, static_cast<double>(Int::min()), static_cast<double>(Int::max())));
}

std::vector<int> wholes(const std::vector<double>& numbers) {
  std::vector<int> all;
  for (const double number : numbers) all.push_back(whole(number));
  return all;
}

// Its value in the section, or null; throws std::logic_error where a required one is missing.
static const Setting* found(const std::string& key, bool required, const Section& section) {
  return required ? &section[key] : section.find(key);
}

struct FieldTable::Rows {
  struct Entry {
    std::vector<std::string> names;  // of its keys; none: a rule
    Member member;
    Reader read;
  };
  std::vector<Key> keys;
  std::vector<Entry> entries;
  std::vector<void (*)()> rules;

  const Entry* of(Member member) const {
    const auto is = [&](const Entry& entry) { return !entry.names.empty() && entry.member == member; };
    const auto entry = std::find_if(entries.begin(), entries.end(), is);
    return entry == entries.end() ? nullptr : &*entry;
  }
};

FieldTable::FieldTable() : rows_(std::make_shared<Rows>()) { rows_->keys.reserve(16), rows_->entries.reserve(16); }
FieldTable::FieldTable(const FieldTable&) = default;
FieldTable::~FieldTable() = default;

FieldTable::Rows& FieldTable::own() {
  if (rows_.use_count() > 1) rows_ = std::make_shared<Rows>(*rows_);
  return *rows_;
}

void FieldTable::enter(Key key, Member member, Setter set) {
  Reader read = [name = key.name, required = key.required, at = member.at, set = std::move(set)](std::byte* data,
                                                                                                 const Place& place) {
    if (const Setting* setting = found(name, required, *place.section)) set(data + at, *setting);
  };
  std::vector<Key> one;
  one.push_back(std::move(key));
  enter(std::move(one), member, std::move(read));
}

void FieldTable::enter(std::vector<Key>&& added, Member member, Reader read) {
  Rows& rows = own();
  if (rows.of(member))
    throw std::logic_error(
        fmt::format("the member that key \"{}\" fills is filled by another key, too", added.front().name));
  Rows::Entry entry{{}, member, std::move(read)};
  for (Key& key : added) {
    if (std::any_of(rows.keys.begin(), rows.keys.end(), [&](const Key& k) { return k.name == key.name; }))
      throw std::logic_error(fmt::format("key \"{}\" is declared twice in one table", key.name));
    entry.names.push_back(key.name);
    rows.keys.push_back(std::move(key));
  }
  rows.entries.push_back(std::move(entry));
}

void FieldTable::enter(Reader rule) { own().entries.push_back({{}, {-1, &typeid(void)}, std::move(rule)}); }

void FieldTable::check(void (*rule)()) { own().rules.push_back(rule); }

void FieldTable::read(std::byte* data, const Place& place) const {
  for (const Rows::Entry& entry : rows_->entries) entry.read(data, place);
}

const std::vector<std::string>& FieldTable::names_of(Member member) const {
  if (const Rows::Entry* entry = rows_->of(member)) return entry->names;
  not_filled();
}

const std::string& FieldTable::key_of(Member member, const Section& section) const {
  const std::vector<std::string>& names = names_of(member);
  for (const std::string& name : names)
    if (section.given(name)) return name;
  return names.front();
}

const std::vector<Key>& FieldTable::keys() const { return rows_->keys; }
std::vector<Key> FieldTable::take_keys() { return std::move(own().keys); }
const std::vector<void (*)()>& FieldTable::rules() const { return rows_->rules; }

const Key* one_given(const std::vector<Key>& keys, const Place& place) {
  const Key* given = nullptr;
  for (const Key& key : keys) {
    if (!place.section->given(key.name)) continue;
    if (given) both_given(place, given->name, key.name, key.name);
    given = &key;
  }
  return given;
}

// False, with a message, where a list stands in place of one table.
static bool is_one_table(const Place& place, const std::string& key, std::size_t tables) {
  if (tables != 1)
    place.messages->add(place.section->where(key),
                        fmt::format("{}: {} = a list of {} tables; must be one table", place.what, key, tables));
  return tables == 1;
}

Reader nested(Key key, bool list, bool numbered, bool named, Reader put) {
  return [=](std::byte* data, const Place& place) {
    const Setting* setting = found(key.name, key.required, *place.section);
    if (!setting || (!list && !is_one_table(place, key.name, setting->sections.size()))) return;
    for (std::size_t i = 0; i < setting->sections.size(); ++i) {
      std::string what = place.what + ": " + key.name;
      if (numbered) what += fmt::format("[{}]", i + 1);
      if (named) what += "." + setting->sections[i].name;
      put(data, {&setting->sections[i], place.messages, std::move(what)});
    }
  };
}

void not_filled() { throw std::logic_error("a member was requested that no key fills"); }

std::string who(const Section& section) { return fmt::format("{} \"{}\"", section.kind->name, section.name); }

bool refuse(const Place& place, Location at, const std::string& text) {
  place.messages->add(at, place.what + ": " + text);
  return false;
}

void both_given(const Place& place, const std::string& first, const std::string& second, const std::string& at) {
  place.messages->add(place.section->where(at),
                      fmt::format("{}: \"{}\" and \"{}\" both given; keep one", place.what, first, second));
}

void belongs_to(const Place& place, const std::string& key, const std::string& owner) {
  place.messages->add(place.section->where(key),
                      fmt::format("{}: \"{}\" belongs to \"{}\", which is not given; drop it", place.what, key, owner));
}

}  // namespace kurbel::fields_detail
