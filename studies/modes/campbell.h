// campbell.h — where orders of excitation meet the modes: the diagram, the list by severity, the map of a run's spectra.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/findings.h"
#include "studies/findings/report.h"
#include "studies/modes/modes.h"

namespace kurbel::modes {

// What swings against what: "generator against engine", the shafts with the largest shares of the kinetic energy on
// either side of the node; "damper ring" alone where no other shaft has 3 % of it. Of a mode of internal states first of all
// whose they are: "current of motor and fan".
std::string name_of(const ModesStudy& study, const Mode& mode);

// The `count` severest critical speeds by their places in the list, the severest first: by what the joint may bear.
// Those that stay below a millionth of the severest are none.
std::vector<std::size_t> severest_critical(const ModesStudy& study, std::size_t count);

// Modes as level lines with their names, orders as rays with what excites them, circles by severity where they meet;
// operating speed and barred ranges.
Plot campbell_plot(const ModesStudy& study);

Rows critical_table(const ModesStudy& study);
Rows zone_table(const ModesStudy& study);

// Amplitudes of a simulated torque's spectra over frequency and the speed of their windows, or over time where the
// speed hardly changes.
Plot waterfall_plot(const ModesStudy& study, const TorqueHistory& history);

}  // namespace kurbel::modes
