// forces_findings.h — findings for the forces of a mechanism.
#pragma once

#include "studies/findings/output.h"
#include "studies/forces/forces.h"

namespace kurbel {

// Files: forces_prescribed.csv, forces_simulated.csv, links_….csv. The forces must outlive the findings.
Findings findings_of(const Forces& forces);

// --- shared by forces_findings.cpp and forces_record.cpp ---

// Zero within a negligible error; a larger error may hide a non-zero value.
bool is_nothing(const Peak& peak);
// "10.45 kN"; with the error if it is indistinguishable from zero.
std::string in_words(const Peak& peak, const std::string& si_unit);
// Sets values of the size of rounding errors of `largest` to zero.
double or_zero(double value, double largest);
// Peaks of every joint, then balancing torque, shaking force and moment.
std::vector<NamedPeak> peaks_of(const Forces& forces, const ForceCycle& cycle);
// "the main bearing (frame on crank)", "pin O (frame on crank)".
std::string joint_in_words(const NamedPeak& reaction);
// "crank pin"; of a name that several have "pin A: crank on coupler".
std::string heading_of(const std::vector<JointForces>& joints, const JointForces& joint);
// For programs: a problem with its positions; and tables of all positions for files.
Record cycle_record(const Forces& forces, const ForceCycle& cycle);
List links_list(const ForceCycle& cycle);
DataTable table_of_forces(const Forces& forces, const ForceCycle& cycle);
DataTable table_of_links(const ForceCycle& cycle);

}  // namespace kurbel
