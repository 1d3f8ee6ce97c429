// steady_words.h — sentences on steady cycles, operating points and starts.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "studies/findings/rows.h"
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

}  // namespace kurbel
