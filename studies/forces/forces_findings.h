// forces_findings.h — what is said of the forces of a mechanism.
#pragma once

#include "studies/findings/output.h"
#include "studies/forces/forces.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {

// Files: forces_prescribed.csv, forces_simulated.csv, links_….csv. The forces must outlive the findings.
Findings findings_of(const Forces& forces);
Findings findings_of(const LinkageStudy& study);

// Peaks in words: "90.0°", "10.45 kN"; for tables with the error, or "no bound".
double degrees(double angle);
std::string at_angle(const Peak& p);
// None at all, as far as rounding tells. What an error hides that is more than that is not known to be nothing.
bool is_nothing(const Peak& p);
std::string in_words(const Peak& p, const std::string& si_unit);
std::string peak_text(const Peak& p, double factor = 1);

// Motion, inertia forces and shares of the links; the cycle must outlive the findings.
void say_links(Findings& to, Chapter in, const LinkageCycle& cycle);
List links_list(const LinkageCycle& cycle);
List order_list(const std::vector<ForceHarmonic>& orders);
std::string csv_of_links(const LinkageCycle& cycle);

}  // namespace kurbel
