// no_element.h — placeholder for a shaft element that is absent without its effect; compile() omits it.
#pragma once

#include "engine/elements/any_shaft_element.h"

namespace kurbel {

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

// One shared instance for all omitted elements.
inline ShaftForm no_element() {
  static const ShaftForm one = shaft_form(NoElement{});
  return one;
}

}  // namespace kurbel
