// regime_words.cpp — kinds of motion in words.
#include "engine/analysis/regime.h"

namespace kurbel {

const char* name_of(Regime::Kind kind) {
  switch (kind) {
    case Regime::Kind::equilibrium:
      return "equilibrium";
    case Regime::Kind::cycle:
      return "cycle";
    case Regime::Kind::at_rest:
      return "at rest";
    case Regime::Kind::runaway:
      return "running away";
    case Regime::Kind::drifting:
      return "drifting";
    case Regime::Kind::interrupted:
      return "interrupted";
    case Regime::Kind::failed:
      break;
  }
  return "failed";
}

}  // namespace kurbel
