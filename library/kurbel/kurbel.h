// kurbel.h — all of kurbel for programs that use it: machines, runs, states, studies, sweeps, elements of one's own.
//
//     const kurbel::Machine press = kurbel::Machine::from_file("press.toml");
//     const kurbel::Run run = kurbel::run(press);
//     std::puts(run.study().conclusion().c_str());
//     const kurbel::FigureValue peak = run.figures()["peak_torque.main_coupling"];   // value, unit, measured error
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
