// own_mechanism.cpp — a mechanism of one's own: a Scotch yoke, x = r cos φ, with a crank's inertia J and the yoke's mass m.
// Nothing drives it, so that its kinetic energy stays:  (J + m r² sin² φ) ω² = J ω₀²  from φ = 0.
#include <kurbel/kurbel.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

int main() {
  kurbel::add_mechanism("Scotch yoke", "a slot across the stroke, carried along by the crank pin",
                        {{"radius", "m", {}, "r"}, {"crank_inertia", "kg*m2", {}, "J"}, {"yoke_mass", "kg", {}, "m"}},
                        [](const kurbel::Parameters& p) {
                          return [r = p["radius"], j = p["crank_inertia"],
                                  m = p["yoke_mass"]](const kurbel::Taylor& phi) {
                            const kurbel::Taylor x = r * cos(phi);
                            return kurbel::LinkagePosition{{{"crank", 0, j, 0, 0, phi}, {"yoke", m, 0, x, 0, 0}}, x};
                          };
                        });
  const kurbel::Machine machine = kurbel::Machine::from_text(R"(
title = "A Scotch yoke runs on"
line  = ["yoke"]
yoke  = { kind = "Scotch yoke", radius = "80 mm", crank_inertia = "0.02 kg*m2", yoke_mass = "6 kg" }
run   = { start = { speed = "10 rad/s" }, until = "1 s" }
)");
  const double r = 0.08, j = 0.02, m = 6;
  const kurbel::Run run = kurbel::run(machine);
  const kurbel::TimeSeries speed = run.trajectory()["speed.yoke"], angle = run.trajectory()["angle.yoke"];
  double worst = 0;
  for (std::size_t i = 0; i < speed.size(); ++i) {
    const double s = std::sin(angle[i]);
    worst = std::max(worst, std::abs(speed[i] / (10 * std::sqrt(j / (j + m * r * r * s * s))) - 1));
  }
  const double slowest = run.figures()["min_speed.yoke"].value, expected = 10 * std::sqrt(j / (j + m * r * r));
  std::printf("%s\nslowest %.9g rad/s of %.9g; off by at most %.1e on the way\n", run.study().conclusion().c_str(),
              slowest, expected, worst);
  // Of its joints nothing was told.
  std::string refused;
  try {
    kurbel::forces(machine);
  } catch (const std::invalid_argument& why) {
    refused = why.what();
  }
  std::puts(refused.c_str());
  return run.complete() && worst < 1e-6 && std::abs(slowest / expected - 1) < 1e-6 &&
                 refused.find("a kind of its user's own") != std::string::npos
             ? 0
             : 1;
}
