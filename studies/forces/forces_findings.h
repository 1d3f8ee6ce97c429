// forces_findings.h — what is said of the forces of a mechanism.
#pragma once

#include "studies/findings/output.h"
#include "studies/forces/forces.h"

namespace kurbel {

// Files: forces_prescribed.csv, forces_simulated.csv, links_….csv. The forces must outlive the findings.
Findings findings_of(const Forces& forces);

// --- what its parts share: forces_findings.cpp, forces_record.cpp ---

// None at all, as far as rounding goes. What an error hides that is more than that is not known to be nothing.
bool is_nothing(const Peak& peak);
// "10.45 kN"; with the error where it is not told from zero.
std::string in_words(const Peak& peak, const std::string& si_unit);
// Rounding errors beside large forces read as zero.
double or_zero(double value, double largest);
// Of every joint, then balancing torque, shaking force and moment.
std::vector<NamedPeak> peaks_of(const Forces& forces, const ForceCycle& cycle);
// For programs: a problem with its positions; and tables of all positions for files.
Record cycle_record(const Forces& forces, const ForceCycle& cycle);
List links_list(const ForceCycle& cycle);
DataTable table_of_forces(const Forces& forces, const ForceCycle& cycle);
DataTable table_of_links(const ForceCycle& cycle);

}  // namespace kurbel
