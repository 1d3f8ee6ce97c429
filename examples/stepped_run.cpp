// stepped_run.cpp — a machine stepped by its caller: look, keep a state, go on, come back, go on elsewhere.
#include <kurbel/kurbel.h>

#include <cmath>
#include <cstdio>

int main() {
  const kurbel::Machine machine = kurbel::Machine::from_text(R"(
title    = "A fan starts through a clutch that slips"
line     = ["motor", "clutch", "fan"]
motor    = { kind = "inertia", inertia = "0.2 kg*m2" }
drive    = { kind = "torque source", torque = "50 N*m", on = "motor" }
clutch   = { kind = "clutch", torque = "40 N*m" }
fan      = { kind = "load", quadratic = "0.01 N*m*s2/rad2", inertia = "1.5 kg*m2" }
run      = { until = "2 s", start = { motor = { speed = "20 rad/s" } } }
)");
  kurbel::Motion motion(machine);
  for (int i = 1; i <= 4; ++i) {
    motion.go_to(0.1 * i);
    std::printf("%.1f s: motor %.6f, fan %.6f rad/s\n", motion.time(), motion["speed.motor"], motion["speed.fan"]);
  }
  const kurbel::SavedState kept = motion.state();
  motion.go_to(1.5);
  const kurbel::SavedState first = motion.state();
  // Back, and the same way again: the same to the last bit.
  motion.restore(kept);
  motion.go_to(1.5);
  const bool same_again = motion.state() == first;
  // As text into another motion of the machine, as another process would have it.
  kurbel::Motion other(machine);
  other.restore(other.state_from(kept.text()));
  other.go_to(1.5);
  const bool same_elsewhere = other.state() == first;
  // The clutch slips all the way, J ω̇ = M − q ω²:  ω = √(M/q) tanh(√(M q) t/J).
  const double m = 40, q = 0.01, inertia = 1.5;
  const double expected = std::sqrt(m / q) * std::tanh(std::sqrt(m * q) * 1.5 / inertia), speed = other["speed.fan"];
  std::printf("again: %d, elsewhere: %d; at 1.5 s %.9g of %.9g rad/s\n", same_again, same_elsewhere, speed, expected);
  return same_again && same_elsewhere && std::abs(speed / expected - 1) < 1e-8 ? 0 : 1;
}
