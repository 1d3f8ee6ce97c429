// component_data.h — data of components that are not in the equations: ratings, motor data, teeth.
//
//     network.data.add("coupling", CouplingLimits{…});                       where a kind is built
//     if (const auto* limits = network.data.find<CouplingLimits>("coupling"))  in a study
// The types of the values belong to the families of components; this class is independent of them.
#pragma once

#include <any>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace kurbel {

class ComponentData {
 public:
  // A component has at most one value of each type.
  template <class T>
  void add(const std::string& component, T value) {
    places_.emplace(component, values_.size());
    values_.emplace_back(component, std::move(value));
  }
  // Null: none. Valid until the next add().
  template <class T>
  const T* find(const std::string& component) const {
    for (auto [place, end] = places_.equal_range(component); place != end; ++place)
      if (const T* value = std::any_cast<T>(&values_[place->second].second)) return value;
    return nullptr;
  }
  // All values with their components, in the order of addition: the canonical order of the scene.
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
