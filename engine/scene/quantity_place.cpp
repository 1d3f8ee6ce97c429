// quantity_place.cpp — a path through a component's tables.
#include "engine/scene/quantity_place.h"

#include <algorithm>

namespace kurbel {

QuantityPlace quantity_place(const std::vector<Section>& sections, const std::string& path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return {};
  const auto section =
      std::find_if(sections.begin(), sections.end(), [&](const Section& s) { return s.name == path.substr(0, dot); });
  if (section == sections.end()) return {};
  const Section* in = &*section;
  for (std::size_t begin = dot + 1;;) {
    const std::size_t end = path.find('.', begin);
    const Setting* const setting = in->find(path.substr(begin, end - begin));
    if (!setting || !setting->given) return {};
    if (end == std::string::npos) {
      const auto key = std::find_if(in->kind->keys.begin(), in->kind->keys.end(),
                                    [&](const Key& k) { return k.name == setting->key; });
      if (key == in->kind->keys.end() || key->type != KeyType::quantity) return {};
      return {setting, &*key};
    }
    if (setting->sections.size() != 1) return {};
    in = &setting->sections[0];
    begin = end + 1;
  }
}

Setting* quantity_at(std::vector<Section>& sections, const std::string& path) {
  return const_cast<Setting*>(quantity_place(sections, path).setting);  // of these sections, which are the caller's own
}

}  // namespace kurbel
