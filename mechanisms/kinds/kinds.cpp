// kinds.cpp — gathers the mechanisms.
#include "mechanisms/kinds/kinds.h"

namespace kurbel {

std::vector<Kind> mechanism_kinds() {
  std::vector<Kind> all;
  for (Kind (*kind)() :
       {slider_crank_kind, four_bar_kind, quick_return_kind, slotted_lever_kind, knuckle_press_kind, linkage_kind})
    all.push_back(kind());
  return all;
}

}  // namespace kurbel
