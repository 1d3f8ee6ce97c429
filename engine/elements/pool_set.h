// pool_set.h — the pools of a model.
#pragma once

#include <map>
#include <memory>
#include <typeindex>
#include <typeinfo>
#include <utility>
#include <vector>

#include "engine/elements/element_pool.h"

namespace kurbel {

// The pools of a model, one per type of element, made with the first element of the type.
class PoolSet {
 public:
  template <class Pool>
  Pool& of() {
    std::unique_ptr<ElementPool>*& known = by_type_[std::type_index(typeid(Pool))];
    if (!known) {
      pools_.push_back(std::make_unique<std::unique_ptr<ElementPool>>(std::make_unique<Pool>()));
      known = pools_.back().get();
    }
    return static_cast<Pool&>(**known);
  }
  std::vector<std::unique_ptr<ElementPool>> release() {
    std::vector<std::unique_ptr<ElementPool>> pools;
    for (auto& pool : pools_) pools.push_back(std::move(*pool));
    return pools;
  }

 private:
  std::map<std::type_index, std::unique_ptr<ElementPool>*> by_type_;
  std::vector<std::unique_ptr<std::unique_ptr<ElementPool>>> pools_;  // in the order of first use
};

}  // namespace kurbel
