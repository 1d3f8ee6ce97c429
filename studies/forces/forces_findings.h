// forces_findings.h — what is said of the forces of a mechanism.
#pragma once

#include "studies/findings/output.h"
#include "studies/forces/forces.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {

// Files: forces_prescribed.csv, forces_simulated.csv, links_….csv. The forces must outlive the findings.
Findings findings_of(const Forces& forces);
Findings findings_of(const LinkageStudy& study);
// Of the mechanism asked for, of either kind. Throws as find_forces and find_linkage_forces do.
StudyOutput output_of_forces(const Scene& scene, const ForcesOptions& options);

// Peaks in words: "90.0°", "10.45 kN"; for tables with the error, or "no bound".
double degrees(double angle);
std::string at_angle(const Peak& p);
// None at all, as far as rounding tells. What an error hides that is more than that is not known to be nothing.
bool is_nothing(const Peak& p);
std::string in_words(const Peak& p, const std::string& si_unit);
std::string peak_text(const Peak& p, double factor = 1);
// Rounding errors beside large forces read as zero.
double or_zero(double value, double largest);

// With what findings of both kinds begin.
Findings begin_findings(const AboutForces& f, const CycleOfForces& front, const std::string& conclusion);
// "press at 60 rpm: the main bearing carries up to 10.45 kN (at 90.0°)", or that reactions have no bound.
std::string begin_conclusion(const AboutForces& f, const CycleOfForces& front, const Peak& main_bearing);
std::string torque_in_words(const CycleOfForces& cycle);

// What both kinds of study say of a cycle: its largest values side by side, works, orders, and the record for programs.
std::vector<NamedPeak> with_torque_and_shaking(std::vector<NamedPeak> reactions, const CycleOfForces& cycle);
KeyFigure key_figure(const NamedPeak& peak);
RowsOf<std::size_t> peak_table(const std::vector<std::string>& labels, const std::vector<std::vector<NamedPeak>>& of);
template <class Study, class Cycle>
RowsOf<std::size_t> peak_table(const Study& study, std::vector<NamedPeak> (*peaks_of)(const Cycle&)) {
  std::vector<std::string> labels;
  std::vector<std::vector<NamedPeak>> peaks;
  for (const Cycle* c : problems_of(study)) labels.push_back(c->label), peaks.push_back(peaks_of(*c));
  return peak_table(labels, peaks);
}
Rows work_table(const std::vector<const CycleOfForces*>& problems);
Rows harmonic_table(const CycleOfForces& cycle, bool on_terminal);
Record common_record(const CycleOfForces& cycle, const std::vector<NamedPeak>& peaks);

// Motion, inertia forces and shares of the links; the cycle must outlive the findings.
void say_links(Findings& to, Chapter in, const LinkageCycle& cycle);
List links_list(const LinkageCycle& cycle);
DataTable table_of_links(const LinkageCycle& cycle);

}  // namespace kurbel
