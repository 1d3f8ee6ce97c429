// key_values.h — values that a key may hold, or just may not: made from the table of keys.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/keys.h"
#include "tests/fuzz/random.h"

namespace kurbel::fuzz {

DocumentValue text_value(const std::string& text);
DocumentValue number_value(double x);
DocumentValue integer_value(std::int64_t x);
DocumentValue flag_value(bool on);
DocumentValue list_value(std::vector<DocumentValue> items);
DocumentValue table_value(std::vector<DocumentEntry> entries = {});

// Sets or adds.
void put(DocumentValue& table, const std::string& key, DocumentValue value);
DocumentEntry* find(DocumentValue& table, const std::string& key);

// A number that arithmetic may not like: 0, bounds of the domain, the ends of double precision.
double extreme_number(const Domain& domain, Random& random);

// A value of the key's type. `wild`: how likely one out of its domain, of another unit, of an extreme size is.
DocumentValue value_for(const Key& key, Random& random, double wild);
// A value of any type at all.
DocumentValue any_value(Random& random);
// A table of this kind: what it needs, and some of what it may have.
DocumentValue table_for(const Kind& kind, Random& random, double wild, bool with_kind);

}  // namespace kurbel::fuzz
