// fit_command_test.cpp — kurbel fit on the command line: exit codes, places of what is wrong.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/program.h"

namespace kurbel::fit_command_test {
namespace {

using test::Said;

Said kurbel(const std::string& arguments) { return test::said_by_program("fit " + arguments); }

const std::string tasks = std::string(KURBEL_SOURCE_DIR) + "/docs/tasks/";
const std::string set = tasks + "fit_set.toml --measured " + tasks + "fit_set_1500.csv ";
const std::string mapped = set + "--map 'c*=speed.engine' ";
const std::string rotor = "--free 'rotor.inertia=0.05..0.8 kg*m2' ";

TEST(FitCommand, WhatIsWrongEndsWithTwoAndItsPlace) {
  for (const auto& [arguments, says] : {
           std::pair(set + rotor + "--map c1=speed.engin", "\"c1=speed.engin\":1:4: no channel"),
           {set + rotor + "--map 'x*=speed.engine'", "no column of"},
           {mapped + "--free 'rotr.inertia=0.05..0.8 kg*m2'", "did you mean \"rotor\"?"},
           {mapped + "--free 'rotor.inertia=0.05..0.8 kg'", "must be an inertia"},
           {mapped + "--free 'gain of speed.rotor=0.9..1.1'", "no table \"speed.rotor\""},
           {mapped + rotor + "--hold 'mean speed by load.torqe'", "no quantity \"load.torqe\""},
           {mapped + rotor + "--orders 0.5,x", "--orders \"x\""},
           {mapped + rotor + "--over anlge", "must be time, angle or modes"},
           {mapped + rotor + "--map 'b: c1=speed.engine'", "no record \"b\""},
           {mapped + rotor + "--orders 0.5 --free 'engine.crank_inertia=0..0.05 kg*m2' --free 'load.torque=1..9 N*m'",
            "--free: 3 unknowns for 2 values that are compared"},
           {mapped + rotor + "--predict nothere.toml", "nothere.toml: no such file"},
           {mapped + rotor + "--write /nonexistent/x.toml", "there is no folder"},
       }) {
    const Said said = kurbel(arguments + " --no-files");
    EXPECT_EQ(said.code, 2) << arguments << "\n" << said.text;
    EXPECT_NE(said.text.find(says), std::string::npos) << arguments << "\n" << said.text;
  }
}

}  // namespace
}  // namespace kurbel::fit_command_test
