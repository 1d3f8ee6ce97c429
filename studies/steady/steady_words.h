// steady_words.h — sentences on steady cycles, operating points and starts; ratings against the cycle's own figures.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "studies/findings/rows.h"
#include "studies/limits/verdicts.h"
#include "studies/steady/steady.h"

namespace kurbel {

// Why a quantity of the scene, COMPONENT.KEY, cannot have the value required for a demanded speed: it is outside the
// key's domain. Empty: it can, or no quantity is named.
std::string why_not_held(const Scene& scene, const std::string& by, double value);

std::vector<std::string> words_of(const SteadyCycle& cycle);
std::vector<std::string> words_of_diagram(const SteadyStudy& study);
Record operating_point(const OperatingDiagram& diagram, const OperatingPoint& point);  // the same for programs
std::vector<std::string> words_of_start(const SteadyStudy& study);
// Conclusion from the last model's figures; unstable motions; extrapolated data; overheated motors.
Claims claims_of(const SteadyStudy& study);
std::string complex_text(std::complex<double> z);  // "0.3 + 0.4 i"

// Belts, shafts, rims and motors in continuous or intermittent duty, by the cycle's largest and RMS torques and
// largest speeds. Heat of engagements and short-time duty need a run: `kurbel run` assesses them. Empty: no ratings,
// or no cycle was found.
std::vector<Verdict> steady_ratings(const SteadyCycle& cycle);

}  // namespace kurbel
