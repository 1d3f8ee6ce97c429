// links_summed.h — the reduced functions of any planar linkage by sums over its links (theory 2.1, 2.2).
#pragma once

#include "mechanisms/reduced/closed_forms.h"

namespace kurbel {

// I_r = Σ m v_S′² + J ϑ′², M_g = −g Σ m h_S′, each with its derivatives by φ from the links' Taylor series.
ClosedForm closed_form_of(const PlanarLinkage& linkage);

}  // namespace kurbel
