// natural_frequencies_test.cpp — torsional modes of shaft lines from the compiled model's exact Jacobian, against
// published frequencies. A gear ratio is positive: each shaft counts its angle in its own direction of drive.
#include <fmt/format.h>

#include "engine/matrices/linear_algebra.h"
#include "tests/published/published.h"
#include "tests/support/validation.h"

namespace kurbel::natural_frequencies_test {
namespace {

using fmt::format;
using test::Against;
using test::expect_frequencies;
using test::two_pi;
using test::Validation;

std::string inertia(const std::string& name, double j) {
  return format("[{}]\nkind = \"inertia\"\ninertia = \"{} kg*m2\"\n", name, j);
}
std::string coupling(const std::string& name, double k, double c = 0) {
  return format("[{}]\nkind = \"coupling\"\nstiffness = \"{} N*m/rad\"\ndamping = \"{} N*m*s/rad\"\n", name, k, c);
}
std::string gear(const std::string& name, int z1, int z2, double j1, double j2) {
  return format("[{}]\nkind = \"gearbox\"\nstages = [{{ teeth = [{}, {}], inertia = [\"{} kg*m2\", \"{} kg*m2\"] }}]\n",
                name, z1, z2, j1, j2);
}
// Without inertia of its own.
std::string shaft(const std::string& name, const std::string& length, const std::string& diameter,
                  const std::string& shear_modulus) {
  return format(
      "[{}]\nkind = \"shaft\"\nlength = \"{}\"\ndiameter = \"{}\"\nshear_modulus = \"{}\"\ninertia = \"0 kg*m2\"\n",
      name, length, diameter, shear_modulus);
}
// A main line, branches, and tables, all elastic.
std::string machine(const std::string& line, const std::string& tables) {
  return format("line = [{}]\n{}[effects]\nelasticity = true\n", line, tables);
}

// A plain row of inertias and springs.
std::string row(const std::vector<double>& j, const std::vector<double>& k) {
  std::string line = "\"j0\"", tables = inertia("j0", j[0]);
  for (std::size_t i = 1; i < j.size(); ++i) {
    line += format(", \"k{0}\", \"j{0}\"", i);
    tables += coupling(format("k{}", i), k[i - 1]) + inertia(format("j{}", i), j[i]);
  }
  return machine(line, tables);
}

// --- EL01 (tests/cases/el01_torsion_frequencies.toml); f in Hz ---

TEST(ShaftLine, TwoMassFrequencyIsRootOfStiffnessOverReducedInertia) {
  expect_frequencies({Against::closed_form, "Two inertias on a spring: ω = √(k (J₁ + J₂)/(J₁ J₂))"},
                     row({211.4, 8.3}, {9.775e6}), {176.07674675}, two_pi, 1e-9);
}

TEST(ShaftLine, FiveDiscFrequenciesMatchFriswell) {  // Friswell et al., Dynamics of Rotating Machines, ex. 9.7.1
  expect_frequencies({Against::published, "Friswell et al.: Dynamics of Rotating Machines, ex. 9.7.1"},
                     row({3.5e-3, 3.5e-3, 3.5e-3, 0.15, 0.05}, {12e3, 12e3, 14e3, 10e3}),
                     {81.207629, 141.214071, 378.952954, 536.363283}, two_pi, 1e-8);
}

TEST(ShaftLine, BranchAtAGearPairMatchesFriswell) {
  const std::string branch = "[[branch]]\nfrom = \"mesh.in\"\nline = [\"k1\", \"rotor1\"]\n";
  expect_frequencies(
      {Against::published, "Friswell et al.: Dynamics of Rotating Machines, branch at a gear pair"},
      machine(R"("motor", "k0", "mesh", "k2", "rotor2")",
              branch + inertia("motor", 400e-6) + coupling("k0", 1e4) + gear("mesh", 20, 20, 25e-6, 25e-6) +
                  coupling("k1", 5e3) + inertia("rotor1", 700e-6) + coupling("k2", 5e3) + inertia("rotor2", 700e-6)),
      {425.359477, 634.07276, 3247.192354}, two_pi, 1e-8);
}

// Two engines on one propeller: the propeller's wheel (200, R 0.5) meshes with a like one; each of the two drives a
// wheel (800, R 0.8) and behind it an engine (450). Ex. 9.6.3.
TEST(ShaftLine, TwoGearedEnginesOnOnePropellerMatchFriswell) {
  const std::string branch = "[[branch]]\nfrom = \"mesh.in\"\nline = [\"first\", \"k_a\", \"engine_a\"]\n";
  const double k1 = 4272566.0089, k2 = 7450763.8269;
  expect_frequencies(
      {Against::published, "Friswell et al.: Dynamics of Rotating Machines, ex. 9.6.3"},
      machine(R"("propeller", "k1", "mesh", "second", "k_b", "engine_b")",
              branch + inertia("propeller", 3200) + coupling("k1", k1) + gear("mesh", 50, 50, 200, 200) +
                  gear("first", 50, 80, 0, 800) + gear("second", 50, 80, 0, 800) + coupling("k_a", k2) +
                  inertia("engine_a", 450) + coupling("k_b", k2) + inertia("engine_b", 450)),
      {10.304193, std::sqrt(k2 / 450) / two_pi, 24.422919},  // the second: engines against each other, all else still
      two_pi, 1e-7);
  EXPECT_NEAR(std::sqrt(k2 / 450) / two_pi, 20.479261, 1e-6);
}

// Bevan, Theory of Machines, ex. 9, p. 572: weights in ton·ft² (over g), shafts by length and diameter. Given per
// minute.
TEST(ShaftLine, ThreeRotorsOnAShaftByDimensionsMatchBevan) {
  const auto rotor = [](const std::string& name, double ton_ft2) {
    return format("[{}]\nkind = \"inertia\"\ninertia = \"{} lbf*ft*s2\"\n", name, ton_ft2 * 2240 / 32.2);
  };
  expect_frequencies({Against::published, "Bevan: Theory of Machines, ex. 9, p. 572"},
                     machine(R"("a", "ab", "b", "bc", "c")",
                             rotor("a", 2.5) + shaft("ab", "9.5 ft", "8.5 in", "11.8e6 psi") + rotor("b", 7.5) +
                                 shaft("bc", "25 ft", "8.5 in", "11.8e6 psi") + rotor("c", 3)),
                     {960.688265, 1787.482711}, two_pi / 60, 1e-8);
}

// Sarkar, ex. 12, p. 298: motor and pump on two shafts with a gear of 3 between them. The gear has no inertia in the
// book; here it has so little that the first mode does not feel it.
TEST(ShaftLine, GearedPumpMatchesSarkar) {
  const Validation is(Against::published, "Sarkar, ex. 12, p. 298: geared motor and pump");
  const auto found = test::natural_frequencies(machine(
      R"("motor", "a", "gear", "b", "pump")", inertia("motor", 400) + shaft("a", "0.18 m", "0.045 m", "84 GPa") +
                                                  gear("gear", 20, 60, 1e-6, 0) +
                                                  shaft("b", "0.45 m", "0.09 m", "84 GPa") + inertia("pump", 1400)));
  ASSERT_EQ(found.size(), 2u);
  is.near("first natural frequency", "Hz", found[0] / two_pi, 4.2021264, 1e-7);
  EXPECT_GT(found[1], 1e4 * found[0]);
}

// --- tests/cases/torsional.toml: published inputs, frequencies to four or five digits ---

TEST(ShaftLine, TurbineGeneratorMatchesTheFirstBenchmark) {  // IEEE first benchmark: J = 2 H/ω₀, K in pu/rad
  std::vector<double> j;
  for (const double h : {0.092897, 0.155589, 0.858670, 0.884215, 0.868495, 0.0342165})
    j.push_back(2 * h / (60 * two_pi));
  expect_frequencies({Against::published, "IEEE first benchmark of subsynchronous resonance"},
                     row(j, {19.303, 34.929, 52.038, 70.858, 2.822}), {15.71, 20.21, 25.55, 32.28, 47.46}, two_pi,
                     5e-4);
}

TEST(ShaftLine, SixCylinderDieselMatchesMendes) {
  expect_frequencies({Against::published, "Mendes, Meirelles, Zampieri (2008): six-cylinder diesel engine"},
                     row({0.0170, 0.0090, 0.0467, 0.0327, 0.0467, 0.0467, 0.0327, 0.0487, 2.0750},
                         {1.106e6, 1.631e6, 1.253e6, 1.253e6, 1.678e6, 1.253e6, 1.253e6, 1.976e6}),
                     {216.58, 592.74, 984.92, 1171.0, 1416.0, 1660.0, 1794.4, 2993.5}, two_pi, 5e-4);
}

TEST(ShaftLine, WindTurbineGeneratorMatchesThePublishedModes) {
  expect_frequencies({Against::published, "Wind turbine generator, published modes (case torsional)"},
                     row({1e7, 5770.0, 97030.0}, {3.67e8, 5.496e9}), {58.340, 1034.1}, 1, 5e-4);
}

// NREL 5 MW: rotor on the slow side with k and c, generator behind a step-up gear of 97.
TEST(ShaftLine, GearedWindTurbineHasThePublishedFrequencyAndDampingRatio) {
  const Validation is(Against::published, "NREL 5 MW wind turbine, drive train");
  const std::string text = machine(R"("rotor", "shaft", "gear", "generator")",
                                   inertia("rotor", 38759228.0) + coupling("shaft", 8.67637e8, 6.215e6) +
                                       gear("gear", 97, 1, 0, 0) + inertia("generator", 534.116));
  const Eigen::VectorXcd eigenvalues = kurbel::eigenvalues(test::state_matrix(text));
  std::complex<double> mode = 0;
  for (const std::complex<double>& lambda : eigenvalues)
    if (lambda.imag() > mode.imag()) mode = lambda;
  is.near("natural frequency", "Hz", std::abs(mode) / two_pi, 2.22266, 1e-5);
  is.near("damping ratio", "", -mode.real() / std::abs(mode), 0.05002, 1e-5);
}

}  // namespace
}  // namespace kurbel::natural_frequencies_test
