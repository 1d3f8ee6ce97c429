// extraction.h — which of two independent tabulations of a mechanism is taken.
#pragma once

namespace kurbel {

// Runs of one machine share its tables, so they cannot tell each other of the tables' errors. The second extraction
// shares with the first nothing but the mechanism's data: other source, other pieces, other degree.
enum class Extraction { first, second };

}  // namespace kurbel
