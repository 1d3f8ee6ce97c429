// clearance_and_rod_cases.cpp — hard contact in joints with clearance; rods that bend in modes far above the crank's
// turning.
#include <algorithm>

#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {
namespace {

const std::string family = "ClearanceAndRod";

// r = 50 mm, l = 150 mm at 60 rad/s: half a radian.
std::string machine(const std::string& more, double until) {
  return "line = [\"crank\"]\n[crank]\nkind = \"slider-crank\"\nradius = \"50 mm\"\nrod = \"150 mm\"\n"
         "crank_inertia = \"0.02 kg*m2\"\nrod_mass = \"0.3 kg\"\nrod_inertia = \"5.625e-4 kg*m2\"\n"
         "slider_mass = \"0.5 kg\"\ngravity = \"9.81 m/s2\"\n" +
         more + fmt::format("\n[run]\nstart = {{ speed = \"60 rad/s\" }}\nuntil = {}\n", quantity(until, "s"));
}

// The work of gravity and of contact is small beside the kinetic energy: the speed shows it, with the crank's angle.
Truth as_converged(const std::string& scene) { return converged(scene, {"final_angle.crank", "final_speed.crank"}); }

Truth hit_as_often(const std::string& scene) { return converged(scene, {"impacts.crank"}); }

Truth touches() {
  return residual("the pin touches its bearing", [](const Result& r) {
    return std::any_of(r.events.begin(), r.events.end(), [](const Event& e) { return e.what.ends_with(": touches"); })
               ? 0.0
               : HUGE_VAL;
  });
}

// Contact from soft to hard: the shorter, the harder. Impacts are counted as in the reference.
HardCase hard_contact(int decades, double restitution, double friction) {
  const std::string scene =
      machine(fmt::format("clearance = {{ kind = \"crank pin\", gap = \"0.1 mm\", restitution = {:g}, "
                          "restitution_speed = \"0.2 m/s\", friction = {:g}, radius = \"10 mm\", friction_speed = "
                          "\"10 mm/s\", stiffness = \"1e{} N/m\" }}",
                          restitution, friction, decades),
              0.008);
  return {.family = family,
          .name = fmt::format("CrankPinOfStiffness1e{:02d}{}", decades, friction > 0 ? "WithFriction" : ""),
          .parameter = fmt::format("k = 1e{} N/m, restitution {:g}, μ = {:g}", decades, restitution, friction),
          .scene = scene,
          .truths = {as_converged(scene), hit_as_often(scene), touches()}};
}

// Both pins and the guide at once.
HardCase three_joints(int decades) {
  const std::string contact =
      fmt::format(", gap = \"0.1 mm\", stiffness = \"1e{} N/m\", damping = \"1 s/m\", friction = 0.1", decades);
  const std::string scene = machine(
      "clearance = [{ kind = \"crank pin\", radius = \"10 mm\"" + contact +
          " }, { kind = \"wrist pin\", radius = \"8 mm\"" + contact +
          " }, { kind = \"guide\", length = \"60 mm\", height = \"40 mm\", inertia = \"3e-4 kg*m2\"" + contact + " }]",
      0.006);
  return {.family = family,
          .name = fmt::format("ThreeJointsOfStiffness1e{:02d}", decades),
          .parameter = fmt::format("k = 1e{} N/m, both pins and the guide", decades),
          .scene = scene,
          .truths = {as_converged(scene), touches()}};
}

// The n-th mode of bending, n² times as fast as the first (1 kHz).
HardCase high_mode(int modes, double damping_ratio) {
  const std::string scene =
      machine(fmt::format("rod_flexibility = {{ modulus = \"200 GPa\", height = \"8 mm\", width = \"8 mm\", modes = "
                          "{}, damping_ratio = {:g} }}",
                          modes, damping_ratio),
              0.004);
  return {.family = family,
          .name = fmt::format("RodIn{}ModesStudy{}", modes, damping_ratio > 0 ? "" : "Undamped"),
          .parameter = fmt::format("{} modes of bending, ζ = {:g}", modes, damping_ratio),
          .scene = scene,
          .truths = {as_converged(scene)}};
}

// The thinner, the softer: a wire of a rod at high speed still bends within the linear range.
HardCase thin_rod(double millimetres) {
  const std::string scene = machine(fmt::format("rod_flexibility = {{ modulus = \"200 GPa\", height = \"{:g} mm\", "
                                                "width = \"8 mm\", damping_ratio = 0.02 }}",
                                                millimetres),
                                    0.004);
  return {.family = family,
          .name = fmt::format("RodOf{:.0f}MicrometresHeight", 1e3 * millimetres),
          .parameter = fmt::format("{:g} mm high", millimetres),
          .scene = scene,
          .truths = {as_converged(scene)}};
}

}  // namespace

std::vector<HardCase> clearance_and_rod_cases() {
  std::vector<HardCase> cases;
  for (const int decades : {5, 6, 8, 10}) cases.push_back(hard_contact(decades, 0.5, 0.05));
  for (const int decades : {6, 8, 10}) cases.push_back(hard_contact(decades, 0.9, 0));
  for (const int decades : {6, 8}) cases.push_back(three_joints(decades));
  for (const int modes : {1, 3, 6}) cases.push_back(high_mode(modes, 0.02));
  cases.push_back(high_mode(3, 0));
  for (const double millimetres : {4.0, 16.0}) cases.push_back(thin_rod(millimetres));
  return cases;
}

}  // namespace kurbel::hard
