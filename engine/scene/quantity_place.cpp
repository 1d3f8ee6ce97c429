// quantity_place.cpp — a path through a component's tables.
#include "engine/scene/quantity_place.h"

#include "engine/base/find_by.h"

namespace kurbel {
namespace {

// What stands for the whole of a named table.
QuantityPlace first_quantity(const Section& section) {
  const Key& first = section.kind->keys.front();
  const Setting* const setting = section.find(first.name);
  if (!setting || !setting->given || first.type != KeyType::quantity) return {};
  return {setting, &first};
}

}  // namespace

QuantityPlace quantity_place(const std::vector<Section>& sections, const std::string& path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return {};
  const Section* in = find_by(sections, &Section::name, path.substr(0, dot));
  if (!in) return {};
  for (std::size_t begin = dot + 1;;) {
    const std::size_t end = path.find('.', begin);
    const Setting* const setting = in->find(path.substr(begin, end - begin));
    if (!setting || !setting->given) return {};
    if (end == std::string::npos) {
      const Key* const key = in->kind->key(setting->key);
      if (!key || key->type != KeyType::quantity) return {};
      return {setting, key};
    }
    begin = end + 1;
    const Key* const key = in->kind->key(setting->key);
    if (key && key->type == KeyType::named) {
      const std::size_t next = path.find('.', begin);
      in = find_by(setting->sections, &Section::name, path.substr(begin, next - begin));
      if (!in) return {};
      if (next == std::string::npos) return first_quantity(*in);
      begin = next + 1;
      continue;
    }
    if (setting->sections.size() != 1) return {};
    in = &setting->sections[0];
  }
}

Setting* quantity_at(std::vector<Section>& sections, const std::string& path) {
  return const_cast<Setting*>(quantity_place(sections, path).setting);  // of these sections, which are the caller's own
}

}  // namespace kurbel
