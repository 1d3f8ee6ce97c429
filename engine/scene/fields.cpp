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

const Setting* found(const Key& key, const Section& section) {
  return key.required ? &section[key.name] : section.find(key.name);
}

void check_new(const std::vector<Key>& keys, const Key& key) {
  if (std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key.name; }))
    throw std::logic_error(fmt::format("key \"{}\" is declared twice in one table", key.name));
}

void filled_twice(const std::string& key) {
  throw std::logic_error(fmt::format("the member that key \"{}\" fills is filled by another key, too", key));
}

void not_filled() { throw std::logic_error("a member was requested that no key fills"); }

std::string who(const Section& section) { return fmt::format("{} \"{}\"", section.kind->name, section.name); }

void both_given(const Place& place, const std::string& first, const std::string& second, const std::string& at) {
  place.messages->add(place.section->where(at),
                      fmt::format("{}: \"{}\" and \"{}\" both given; keep one", place.what, first, second));
}

void belongs_to(const Place& place, const std::string& key, const std::string& owner) {
  place.messages->add(place.section->where(key),
                      fmt::format("{}: \"{}\" belongs to \"{}\", which is not given; drop it", place.what, key, owner));
}

bool is_one_table(const Place& place, const std::string& key, std::size_t tables) {
  if (tables != 1)
    place.messages->add(place.section->where(key),
                        fmt::format("{}: {} = a list of {} tables; must be one table", place.what, key, tables));
  return tables == 1;
}

}  // namespace kurbel::fields_detail
