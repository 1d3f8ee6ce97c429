// extraction.h — selects one of two independent tabulations of a mechanism.
#pragma once

namespace kurbel {

// Runs of a machine share its tables, so their comparison does not show the errors of the tables. The second extraction
// has other pieces and another degree, and Simbody confirms its values or, where it does not, is their source.
enum class Extraction { first, second };

}  // namespace kurbel
