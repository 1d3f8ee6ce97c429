// kurbel.h — all of kurbel for programs that use it: machines, runs, states, studies, sweeps, elements of one's own.
//
//     const kurbel::Machine press = kurbel::Machine::from_file("press.toml");
//     const kurbel::Run run = kurbel::run(press);
//     std::puts(run.study().conclusion().c_str());
//     const kurbel::FigureValue peak = run.figures()["peak_torque.main_coupling"];   // value, unit, measured error
//
// What there is, a header each, with an example where one is due:
//
// - scene.h: a kurbel::Machine, as its scene describes it, read and found to be sound
// - run.h: a kurbel::Run, one simulation with figures whose errors are measured
// - figures.h: what it yields, kurbel::FigureValue and kurbel::Trajectory
// - state.h: a kurbel::Motion that is stepped by its caller, a kurbel::SavedState to come back to
// - studies.h: every question by its name, answered by a kurbel::Study
// - sweep.h: many variants, of a machine or of a function of the caller's
// - elements.h: elements of one's own, a coupling's law, a mechanism's motion
//
// SI units inside and out, angles in rad. Nothing here is promised to stay binary compatible; source compatible within a
// minor version. What cannot be: BadScene for a scene that makes no machine, std::invalid_argument for an argument that
// is none, std::runtime_error for what fails on its way. A run that cannot go on is no exception: it is incomplete and
// says why.
#pragma once

#include <kurbel/elements.h>
#include <kurbel/figures.h>
#include <kurbel/run.h>
#include <kurbel/scene.h>
#include <kurbel/state.h>
#include <kurbel/studies.h>
#include <kurbel/sweep.h>
