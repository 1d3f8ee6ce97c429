// campbell.h — intersections of excitation orders and modes: the diagram, the list by severity, the map of a run's spectra.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/findings.h"
#include "studies/findings/report.h"
#include "studies/modes/modes.h"

namespace kurbel::modes {

// The parts that vibrate against each other: "generator against engine", the shafts with the largest shares of the
// kinetic energy on either side of the node; only "damper ring" if no other shaft has 3 % of it. For a mode of
// internal states their owners come first: "current of motor and fan".
std::string name_of(const ModesStudy& study, const Mode& mode);

// Indices of the `count` severest critical speeds, the severest first: by load over allowable load of the joint.
// Those below a millionth of the severest are omitted.
std::vector<std::size_t> severest_critical(const ModesStudy& study, std::size_t count);

// Modes as horizontal lines with names, orders as rays with their sources, circles by severity at intersections;
// operating speed and barred ranges.
Plot campbell_plot(const ModesStudy& study);

Rows critical_table(const ModesStudy& study);
Rows zone_table(const ModesStudy& study);

// Amplitudes of a simulated torque's spectra over frequency and the mean speed of their windows, or over time if the
// speed hardly changes.
Plot waterfall_plot(const ModesStudy& study, const TorqueHistory& history);

}  // namespace kurbel::modes
