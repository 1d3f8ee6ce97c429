// entries.h — the dictionary's pages, each filled in its own file.
#pragma once

#include <vector>

#include "studies/dictionary/dictionary.h"

namespace kurbel {

// Of a typed quantity, whose word is its name.
struct KindEntry {
  QuantityKind what;
  Definition told;  // its name is filled in
};
std::vector<KindEntry> entries_of_kinds();     // run_entries.cpp: channels and figures of a whole run
std::vector<KindEntry> entries_of_cycles();    // cycle_entries.cpp: of one cycle
std::vector<Definition> entries_of_own();      // own_entries.cpp: states and outputs of elements
std::vector<Definition> entries_of_studies();  // study_entries.cpp

}  // namespace kurbel
