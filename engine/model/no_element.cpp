// no_element.cpp — one that stands for every element left out.
#include "engine/model/no_element.h"

#include "engine/elements/any_shaft_element.h"

namespace kurbel {
namespace {

struct NoElement {
  static constexpr ShaftTraits is{.account = Account::harmful};
  template <class T>
  T torque(const ShaftState<T>&) const {
    return T(0.0);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {}; }
};

}  // namespace

ShaftForm no_element() {
  static const ShaftForm one = shaft_form(NoElement{});
  return one;
}

}  // namespace kurbel
