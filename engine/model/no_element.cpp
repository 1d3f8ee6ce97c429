// no_element.cpp — one maker that stands for every element left out.
#include "engine/model/no_element.h"

namespace kurbel {
namespace {

struct NoElement {
  static constexpr Account account = Account::harmful;
  template <class T>
  T torque(const ShaftState<T>&) const {
    return T(0.0);
  }
  Rated rated() const { return {}; }
};

}  // namespace

std::shared_ptr<ShaftElementMaker> no_element() {
  static const std::shared_ptr<ShaftElementMaker> one = std::make_shared<ShaftElementMakerOf<NoElement>>(NoElement{});
  return one;
}

}  // namespace kurbel
