// kurbel.h — all of kurbel for programs that use it: machines, runs, states, studies, sweeps, elements of one's own.
//
//     const kurbel::Machine press = kurbel::Machine::from_file("press.toml");
//     const kurbel::Run run = kurbel::run(press);
//     std::puts(run.study().conclusion().c_str());
//     const kurbel::FigureValue peak = run.figures()["peak_torque.main_coupling"];   // value, unit, measured error
//
// Contents, one header each, with examples:
//
// - scene.h: a kurbel::Machine, described by its scene, read and validated
// - run.h: a kurbel::Run, one simulation with figures whose errors are measured
// - figures.h: its results, kurbel::FigureValue and kurbel::Trajectory
// - state.h: a kurbel::Motion that is stepped by its caller, a kurbel::SavedState to return to
// - studies.h: every question by its name, answered by a kurbel::Study
// - sweep.h: many variants, of a machine or of a function of the caller
// - elements.h: user-defined elements: the law of a coupling, the motion of a mechanism
//
// SI units inside and out, angles in rad. Binary compatibility is not promised; source compatibility holds within a
// minor version. Errors: BadScene for a scene that makes no machine, std::invalid_argument for a wrong argument,
// std::runtime_error for failures at run time. A run that cannot continue is no exception: it is incomplete and says
// why.
#pragma once

#include <kurbel/elements.h>
#include <kurbel/figures.h>
#include <kurbel/run.h>
#include <kurbel/scene.h>
#include <kurbel/state.h>
#include <kurbel/studies.h>
#include <kurbel/sweep.h>
