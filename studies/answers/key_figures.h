// key_figures.h — which of a run's figures a person is told first: at most twelve.
//
// The rule: (1) what a rating judges, (2) how evenly and how fast the link turns, (3) what the motor has to give, (4) the
// three largest peak torques over their joints' usual ones, (5) efficiency, forces and pressures of the machine's work,
// (6) times and angles of run-up, run-down, stopping, heat of what slips, (7) what the link comes to. Of each rule in the
// order of the run's own list; what no longer finds a place stands in the table.
#pragma once

#include <vector>

#include "studies/findings/result.h"

namespace kurbel {

// Numbers of figures in result.figures, at most so many, in the order in which they are told: that of the list itself.
std::vector<std::size_t> chosen_figures(const Result& result, std::size_t most);

}  // namespace kurbel
