// extraction.h — selects one of two independent tabulations of a mechanism.
#pragma once

namespace kurbel {

// Runs of a machine share its tables, so their comparison does not show the errors of the tables. The second extraction
// shares only the mechanism's data with the first: it has another source, other pieces and another degree.
enum class Extraction { first, second };

}  // namespace kurbel
