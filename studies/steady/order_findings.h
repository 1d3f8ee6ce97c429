// order_findings.h — findings on orders of speeds and torques: a table for each model, bars, a list for programs.
#pragma once

#include "studies/findings/findings.h"
#include "studies/findings/result.h"
#include "studies/steady/steady.h"

namespace kurbel {

// Amplitude or phase of an order.
inline bool is_of_order(const Figure& f) {
  return f.what.functional == Functional::order || f.what.functional == Functional::order_phase;
}

// The significant orders of every speed and torque of the cycle; phases in rad.
List orders_for_programs(const SteadyCycle& cycle);
// Bars of the link's speed and of torques, a table for each model. The study must outlive the findings.
void say_orders(Findings& f, Chapter in, const SteadyStudy& study);

}  // namespace kurbel
