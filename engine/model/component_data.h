// component_data.h — what components state beside their part in the equations: ratings, a motor's data, teeth.
//
//     network.data.add("coupling", CouplingLimits{…});                       where a kind is built
//     if (const auto* limits = network.data.find<CouplingLimits>("coupling"))  in a study
// Values are of the families' own types, so that nothing here knows any kind.
#pragma once

#include <any>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace kurbel {

class ComponentData {
 public:
  // Of each type a component states one value at most.
  template <class T>
  void add(const std::string& component, T value) {
    places_.emplace(component, values_.size());
    values_.emplace_back(component, std::move(value));
  }
  // Null: it states none. Valid while nothing is added.
  template <class T>
  const T* find(const std::string& component) const {
    for (auto [place, end] = places_.equal_range(component); place != end; ++place)
      if (const T* value = std::any_cast<T>(&values_[place->second].second)) return value;
    return nullptr;
  }
  // With the components that state them, in the order in which they were added: the canonical one of a scene.
  template <class T>
  std::vector<std::pair<const std::string&, const T&>> all() const {
    std::vector<std::pair<const std::string&, const T&>> list;
    for (const auto& [component, any] : values_)
      if (const T* value = std::any_cast<T>(&any)) list.emplace_back(component, *value);
    return list;
  }

 private:
  std::vector<std::pair<std::string, std::any>> values_;
  std::multimap<std::string, std::size_t> places_;
};

}  // namespace kurbel
