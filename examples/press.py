"""press.py: the press of the README with a stiffer coupling; what its figures, its trajectory and a sweep say."""

import sys

import kurbel

press = sys.argv[1] if len(sys.argv) > 1 else "scenes/crank_press.toml"

r = kurbel.run(press, set={"main_coupling.stiffness": "1 MN*m/rad"})
peak = r.figures["peak_torque.main_coupling"]
print(r.conclusion)
print(f"peak torque {peak.value:.6g} ± {peak.error:.1g} {peak.unit} at {peak.at:.4g} s")

torque = r.trajectory["torque.main_coupling"]  # numpy, in the run's own memory
assert abs(torque).max() <= abs(peak.value) * (1 + 1e-6)

rows = kurbel.sweep(press, "main_coupling.stiffness=500..1500 kN*m/rad", design="grid:3", no_error=True,
                    figures=["peak_torque.main_coupling"])
for (stiffness,), value in zip(rows.parameters, rows["peak_torque.main_coupling"]):
    print(f"{stiffness:6.0f} kN*m/rad: {value:.6g} N*m")
