"""Random machines for the oracle: scenes by a seed and a number, of families that each have one question in mind.

    machine(seed, number) → Machine(family, text)     the same text for the same two numbers

All are short: a few seconds of simulated time, a handful of shafts. Speeds, torques and inertias match, so that most of
them run up, stop and strike within the time; a share of each family does not do what it should.
"""
import math
import random
from dataclasses import dataclass


@dataclass(frozen=True)
class Machine:
    family: str
    text: str
    name: str = ""


def q(value, unit):
    return f'"{value:.5g} {unit}"'


class Dice(random.Random):
    def over(self, low, high):
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def often(self, share):
        return self.random() < share


class Scene:
    """Text of a scene, part by part: keys with their values as TOML has them."""

    def __init__(self, dice, title):
        self.dice, self.title = dice, title
        self.line, self.parts, self.steps, self.branches = [], [], [], []
        self.repeat, self.until, self.start, self.effects = False, 1.0, None, None

    def part(self, name, kind, on=None, **keys):
        if on:
            keys = {"on": f'"{on}"', **keys}
        else:
            self.line.append(name)
        self.parts.append((name, kind, {k: v for k, v in keys.items() if v is not None}))
        return name

    def keys(self, name):
        return next(keys for n, _, keys in self.parts if n == name)

    def kind(self, name):
        return next(kind for n, kind, _ in self.parts if n == name)

    def step(self, set_, to=None, over=None, **when):
        names = set_ if isinstance(set_, list) else [set_]
        keys = {k: f'"{v}"' for k, v in when.items()}
        keys["set"] = "[" + ", ".join(f'"{n}"' for n in names) + "]"
        if to is not None:
            keys["to"] = f"{to:g}"
        if over:
            keys["over"] = q(over, "s")
        self.steps.append("{ " + ", ".join(f"{k} = {v}" for k, v in keys.items()) + " }")

    def text(self):
        lines = [f'title = "{self.title}"', "line = [" + ", ".join(f'"{n}"' for n in self.line) + "]"]
        for name, kind, keys in self.parts:
            lines += ["", f"[{name}]", f'kind = "{kind}"', *(f"{k} = {v}" for k, v in keys.items())]
        for start, line in self.branches:
            lines += ["", "[[branch]]", f'from = "{start}"', "line = [" + ", ".join(f'"{n}"' for n in line) + "]"]
        if self.steps:
            lines += ["", "[sequence]", f"repeat = {str(self.repeat).lower()}", "steps = ["]
            lines += [f"  {s}," for s in self.steps] + ["]"]
        if self.effects is not None:
            lines += ["", "[effects]", f"elasticity = {self.effects}"]
        lines += ["", "[run]", f'until = "{self.until:.6g} s"', 'budget = "2 s"']
        if self.start:
            lines += [f"start = {self.start}"]
        return "\n".join(lines) + "\n"


class Rated:
    """A drive's torque, speed and the time that it takes to run up."""

    def __init__(self, dice):
        self.torque, self.speed = dice.over(5, 2000), dice.over(10, 200)
        self.time = dice.uniform(0.1, 0.5)
        self.inertia = self.torque * self.time / self.speed  # run up in `time` by the rated torque


# --- drives ---

def motor(s, r, name="motor", inertia=0.3, rated=1.0, **window):
    """A motor of any kind, `rated` times the usual torque; returns its torque at standstill, about, and no-load speed."""
    d, M, w, J = s.dice, rated * r.torque, r.speed, q(inertia * r.inertia, "kg*m2")
    kind = d.choice(["shunt", "shunt", "induction", "induction", "catalogue", "table", "pneumatic", "hydraulic", "governor", "inductance",
                     "starter"])
    more = {k: q(v, "s") for k, v in window.items()}
    duty = {"duty": '"S1"'} if d.often(0.3) else {}
    if kind == "shunt":
        s.part(name, "dc shunt motor", stall_torque=q(2.5 * M, "N*m"), no_load_speed=q(1.4 * w, "rad/s"), rated_torque=q(M, "N*m"),
               inertia=J, **duty, **more)
        return 2.5 * M, 1.4 * w
    if kind == "inductance":
        constant = M / 10
        s.part(name, "dc shunt motor", voltage=q(1.2 * w * constant, "V"), resistance=q(1.2 * w * constant / 40, "Ohm"),
               constant=q(constant, "N*m/A"), rated_torque=q(M, "N*m"), inductance=q(1.2 * w * constant / 40 * d.over(0.002, 0.05), "H"),
               inertia=J, **duty, **more)
        return 4 * M, 1.2 * w
    if kind in ("induction", "catalogue", "starter"):
        keys = {"rated_power": q(M * w, "W"), "rated_speed": q(w, "rad/s"), "synchronous_speed": q(w / d.uniform(0.93, 0.985), "rad/s"),
                "breakdown_ratio": f"{d.uniform(1.8, 3):.3g}", "inertia": J}
        if kind == "catalogue":
            keys["starting_ratio"] = f"{d.uniform(1.2, 1.7):.3g}"
        if kind == "starter":
            how = d.choice(["star-delta", "soft start", "frequency converter"])
            keys["starting"] = f'"{how}"'
            if how == "star-delta":
                keys["switch_time"] = q(d.uniform(0.5, 3) * r.time, "s")
            else:
                keys["ramp"] = q(d.uniform(0.5, 4) * r.time, "s")
        s.part(name, "induction motor", **keys, **duty, **more)
        return d.uniform(0.5, 1) * M, w
    if kind == "table":
        s.part(name, "motor", torque='{ over = "speed", unit = ["rad/s", "N*m"], points = ' +
               f"[[0, {2 * M:.5g}], [{w:.5g}, {1.2 * M:.5g}], [{1.3 * w:.5g}, 0]] }}", inertia=J, **more)
        return 2 * M, 1.3 * w
    if kind == "pneumatic":
        s.part(name, "pneumatic motor", max_power=q(M * w, "W"), free_speed=q(2 * w, "rad/s"), inertia=J, **more)
        return 2 * M, 2 * w
    if kind == "hydraulic":
        s.part(name, "hydraulic motor", displacement=q(1.3 * M / 1e7 / 0.9, "m3/rad"), pressure_difference='"100 bar"',
               flow=q(1.3 * M / 1e7 / 0.9 * w * 1.1, "m3/s"), inertia=J, **more)
        return 1.3 * M, 1.1 * w
    s.part(name, "governor", speed=q(w, "rad/s"), proportional_gain=q(20 * M / w, "N*m*s/rad"), integral_gain=q(20 * M / w / r.time, "N*m/rad"),
           max_torque=q(1.5 * M, "N*m"), inertia=J, **more)
    return 1.5 * M, w


def can_be_commanded(s, name):
    return s.kind(name) != "prescribed speed"


# --- between shafts ---

def link(s, r, name, share=1.0):
    """Something between two shafts that always goes along; elastic or not. Returns the ratio of speeds in/out."""
    d = s.dice
    kind = d.choice(["coupling", "coupling", "shaft", "gear", "lossy gear", "rubber", "none"])
    spring = share * r.torque / r.speed * d.over(20, 2000)
    if kind == "coupling":
        s.part(name, "coupling", stiffness=q(spring, "N*m/rad"), damping_ratio=f"{d.over(0.01, 0.2):.3g}",
               backlash=q(d.over(0.02, 1), "deg") if d.often(0.15) else None)
    elif kind == "shaft":
        s.part(name, "shaft", stiffness=q(spring, "N*m/rad"), damping_ratio=f"{d.over(0.005, 0.05):.3g}")
    elif kind == "rubber":
        s.part(name, "rubber coupling", stiffness=q(spring, "N*m/rad"), damping_ratio="0.05",
               branches=f"[{{ stiffness = {q(0.4 * spring, 'N*m/rad')}, relaxation_time = \"10 ms\" }}]")
    elif kind in ("gear", "lossy gear"):
        i = d.choice([1.5, 2, 3, 4])
        s.part(name, "gearbox", stages=f"[{{ teeth = [20, {20 * i:.0f}] }}]", efficiency=f"{d.uniform(0.85, 0.98):.3g}" if kind == "lossy gear" else None)
        return i
    else:
        return 1
    if d.often(0.6):
        s.effects = "true"
    return 1


def crank(s, r, name="press", speed=None, torque=None, load=None, inertia=1.0, gravity=None):
    """A slider-crank for a shaft of this speed and torque; `load`: share of the torque's work that it takes in a turn."""
    d = s.dice
    speed, torque = speed or r.speed, torque or r.torque
    J = inertia * torque * r.time / speed
    radius = d.over(0.03, 0.2)
    work = 2 * math.pi * torque * (d.uniform(0.1, 0.6) if load is None else load)
    kind = d.choice(["press", "press", "opposing", "medium", "compressor", "table"])
    keys = {"radius": q(radius, "m"), "rod": q(radius * d.uniform(2.5, 6), "m"), "crank_inertia": q(0.7 * J, "kg*m2"),
            "slider_mass": q(0.3 * J / radius**2 * d.over(0.1, 1), "kg")}
    if gravity if gravity is not None else d.often(0.3):
        keys["gravity"], keys["stroke_angle"] = '"9.81 m/s2"', d.choice(['"90 deg"', '"-90 deg"', '"0 deg"'])
    if kind == "press":
        travel = radius * d.uniform(0.1, 0.6)
        keys["load"] = (f'{{ kind = "press", nominal_force = {q(work / travel, "N")}, nominal_travel = {q(travel, "m")}, '
                        f'rise = {q(0.1 * travel, "m")} }}')
    elif kind == "opposing":
        keys["load"] = f'{{ kind = "opposing", force = {q(work / 4 / radius, "N")} }}'
    elif kind == "medium":
        keys["load"] = f'{{ kind = "medium", viscous = {q(work / (math.pi * radius**2 * speed), "N*s/m")} }}'
    elif kind == "compressor":
        bore = 2 * radius * d.uniform(0.7, 1.2)
        swept = math.pi / 4 * bore**2 * 2 * radius
        p1 = work / swept / 2.0
        keys["load"] = (f'{{ kind = "compressor", bore = {q(bore, "m")}, suction_pressure = {q(p1, "Pa")}, '
                        f'delivery_pressure = {q(4 * p1, "Pa")}, clearance = 0.06 }}')
    else:
        F = work / 2 / radius
        keys["load"] = ('{ kind = "table", force = { over = "angle", unit = ["deg", "N"], period = "360 deg", points = '
                        f'[[0, 0], [180, 0], [200, {F:.5g}], [330, {F:.5g}], [360, 0]] }} }}')
    s.part(name, "slider-crank", **keys)
    return J


def load(s, r, name="load", share=0.6, inertia=1.0, on=None, kinds=("constant", "viscous", "fan", "weight", "mixed")):
    """A resistance on a shaft, `share` of the rated torque at rated speed."""
    d, M, w = s.dice, share * r.torque, r.speed
    kind = d.choice(kinds)
    keys = {"inertia": q(inertia * r.inertia, "kg*m2")}
    if kind in ("constant", "weight", "mixed"):
        keys["torque"] = q(M * (0.5 if kind == "mixed" else 1), "N*m")
    if kind == "weight":
        keys["acts"] = '"always"'
    if kind == "viscous":
        keys["damping"] = q(M / w, "N*m*s/rad")
    if kind in ("fan", "mixed"):
        keys["quadratic"] = q(M * (0.5 if kind == "mixed" else 1) / w**2, "N*m*s2/rad2")
    s.part(name, "load", on=on, **keys)
    return kind


def scaled(r, ratio):
    other = Rated.__new__(Rated)
    other.torque, other.speed, other.time = r.torque * ratio, r.speed / ratio, r.time
    other.inertia = r.inertia * ratio**2
    return other


# --- what components state ---

def rate(s, r):
    """Limits on some components, from far too low to far too high."""
    d = s.dice
    for name, kind, keys in s.parts:
        if not d.often(0.5):
            continue
        if kind in ("clutch", "torque limiter", "brake"):
            keys["allowable_heat"] = q(r.inertia * r.speed**2 * d.over(0.01, 10), "J")
            if d.often(0.4):
                keys["allowable_heat_power"] = q(r.torque * r.speed * d.over(0.01, 3), "W")
        if kind == "belt":
            keys["slip_reserve"] = f"{d.uniform(1, 2):.3g}"
        if kind in ("coupling", "rubber coupling"):
            keys["maximum_torque"] = q(r.torque * d.over(0.5, 20), "N*m")
        if kind == "flywheel":
            keys["rim_radius"], keys["allowable_rim_speed"] = '"0.3 m"', q(0.3 * r.speed * d.over(0.3, 3), "m/s")


# --- families ---

def plain(s, r):
    """A motor, something between, a load: runs up and on, or does not."""
    d = s.dice
    motor(s, r, rated=d.choice([1, 1, 1, 0.3]))
    i = link(s, r, "coupling")
    other = scaled(r, i)
    if d.often(0.4):
        crank(s, r, "machine", other.speed, other.torque)
    else:
        load(s, other, share=d.choice([0.3, 0.7, 0.9, 1.3]))
    s.until = r.time * d.uniform(4, 20)


def run_up_and_down(s, r):
    """A motor that is switched off: run-up, steady motion, run-down, and their boundaries."""
    d = s.dice
    s.until = r.time * d.uniform(8, 20)
    motor(s, r, stop=s.until * d.uniform(0.3, 0.8))
    i = link(s, r, "coupling")
    other = scaled(r, i)
    if d.often(0.6):
        s.part("flywheel", "flywheel", inertia=q(other.inertia * d.over(0.2, 3), "kg*m2"))
        crank(s, r, "machine", other.speed, other.torque, load=d.uniform(0.05, 0.5))
    else:
        load(s, other, share=d.uniform(0.1, 0.9))
    if d.often(0.4):
        motor(s, r, "helper", rated=0.3, stop=s.until * d.uniform(0.05, 0.3))
        s.line.remove("helper")
        s.keys("helper")["on"] = '"motor"'


def open_clutch(s, r):
    """A clutch that a step at t = 0 opens; later it closes, or never."""
    d = s.dice
    turning = d.often(0.5)
    motor(s, r)
    s.part("flywheel", "flywheel", inertia=q(r.inertia * d.over(0.3, 3), "kg*m2"))
    M = r.torque * d.uniform(0.5, 3)
    s.part("clutch", "clutch", torque=q(M, "N*m"), static_torque=q(M * d.uniform(1, 1.3), "N*m"))
    if d.often(0.5):
        crank(s, r)
    else:
        load(s, r, share=d.uniform(0.1, 0.8), kinds=("constant", "viscous", "fan"))
    s.until = r.time * d.uniform(5, 12)
    s.step("clutch", 0, at="0 s")
    if d.often(0.7):
        s.step("clutch", 1, over=r.time * d.uniform(0.02, 0.5), at=f"{s.until * d.uniform(0.1, 0.5):.4g} s")
        if d.often(0.5):
            s.step("clutch", 0, over=r.time * d.choice([0, 0.1]), at=f"{s.until * d.uniform(0.6, 0.9):.4g} s")
    if turning:
        s.start = f"{{ motor = {{ speed = {q(0.97 * r.speed, 'rad/s')} }}, flywheel = {{ speed = {q(0.97 * r.speed, 'rad/s')} }} }}"


def clutch_slips(s, r):
    """A closed clutch, limiter or belt that the strokes of a crank make slip, or a start, or that slips for good."""
    d = s.dice
    motor(s, r)
    s.part("flywheel", "flywheel", inertia=q(r.inertia * d.over(0.5, 5), "kg*m2"))
    M = r.torque * d.choice([0.3, 0.8, 1.5, 3, 6]) * d.uniform(0.7, 1.3)
    kind = d.choice(["clutch", "clutch", "torque limiter", "belt", "elastic belt"])
    if kind == "clutch":
        s.part("joint", "clutch", torque=q(M, "N*m"), static_torque=q(M * d.uniform(1, 1.3), "N*m"))
    elif kind == "torque limiter":
        s.part("joint", "torque limiter", torque=q(M, "N*m"), slipping_part=f"{d.uniform(0.5, 1):.3g}")
    else:
        s.part("joint", "belt", diameter_in='"200 mm"', diameter_out='"200 mm"', friction_coefficient="0.4", wrap_angle='"160 deg"',
               pretension=q(M / 0.1 / 2 / math.tanh(0.5 * 0.4 * 2.79), "N"),
               stiffness=q(M / r.speed * d.over(50, 1000), "N*m/rad") if kind == "elastic belt" else None)
        if kind == "elastic belt":
            s.keys("joint")["damping_ratio"] = "0.05"
            s.effects = "true"
    if d.often(0.7):
        crank(s, r, load=d.uniform(0.05, 0.7), inertia=d.over(0.1, 1))
    else:
        load(s, r, share=d.uniform(0.2, 1.5), inertia=d.over(0.1, 2))
    s.until = r.time * d.uniform(5, 15)
    if d.often(0.4):
        s.start = f"{{ speed = {q(0.95 * r.speed, 'rad/s')} }}"


def single_stroke(s, r):
    """A press that makes single strokes: once, or again and again."""
    d = s.dice
    motor(s, r)
    s.part("flywheel", "flywheel", inertia=q(r.inertia * d.over(1, 5), "kg*m2"))
    M = r.torque * d.uniform(2, 6)
    s.part("clutch", "clutch", torque=q(M, "N*m"), static_torque=q(1.1 * M, "N*m"))
    B = r.torque * d.uniform(1, 4)
    s.part("brake", "brake", torque=q(B, "N*m"), static_torque=q(B * d.uniform(1, 1.3), "N*m"), inertia=q(0.02 * r.inertia, "kg*m2"))
    i = d.choice([1, 2, 5])
    if i > 1:
        s.part("gearbox", "gearbox", stages=f"[{{ teeth = [20, {20 * i}] }}]")
    other = scaled(r, i)
    crank(s, r, "press", other.speed, other.torque, load=d.uniform(0.05, 0.4), inertia=d.uniform(0.05, 0.3), gravity=d.often(0.5))
    turn = 2 * math.pi / other.speed
    s.step("clutch", 0, at="0 s")
    first = d.uniform(0.5, 2) * turn
    s.step("brake", 0, at=f"{first:.4g} s")
    s.step("clutch", 1, over=0.05 * turn, after=f"{0.02 * turn:.4g} s")
    s.step("clutch", 0, angle=f"{d.uniform(250, 330):.4g} deg", of="press")
    s.step("brake", 1, over=0.02 * turn, after=f"{0.02 * turn:.4g} s")
    if d.often(0.6):
        s.repeat = True
        s.steps[0] = s.steps[0].replace('at = "0 s"', f'after = "{d.uniform(0.2, 2) * turn:.4g} s"')
        s.steps[1] = s.steps[1].replace('at = ', 'after = ')
    s.until = turn * d.uniform(6, 25)
    s.start = f"{{ angle = \"0 deg\", motor = {{ speed = {q(0.97 * r.speed, 'rad/s')} }}, flywheel = {{ speed = {q(0.97 * r.speed, 'rad/s')} }} }}"


def engine(s, r):
    """A piston engine that its load or its drag alone holds, from a speed or driven up by a starter."""
    d = s.dice
    z = d.choice([1, 2, 4])
    M = r.torque / z
    s.part("engine", "engine", firing_order=str(list(range(1, z + 1))), inertia=q(r.inertia * d.over(0.5, 3), "kg*m2"),
           torque='{ over = "angle", unit = ["deg", "N*m"], points = ' + f"[[0, 0], [15, {6 * M:.5g}], [35, {11 * M:.5g}], [70, {5 * M:.5g}], "
           f"[120, {1.3 * M:.5g}], [180, 0], [540, 0], [630, {-1.2 * M:.5g}], [690, {-5 * M:.5g}], [720, 0]] }}")
    s.part("flywheel", "flywheel", inertia=q(r.inertia * d.over(0.5, 3), "kg*m2"))
    link(s, r, "coupling")
    s.part("shaft", "inertia", inertia=q(0.1 * r.inertia, "kg*m2"))
    share = d.choice([0.02, 0.2, 0.7, 1.5, 3])  # of the engine's mean torque, at the usual speed
    s.part("drag", "bearing drag", damping=q(share * r.torque / r.speed, "N*m*s/rad"))
    if d.often(0.4):
        load(s, r, share=d.uniform(0.2, 1.2), kinds=("constant", "viscous", "fan"), inertia=0.2)
    s.start = f"{{ speed = {q(r.speed * d.uniform(0.3, 1), 'rad/s')} }}"
    s.until = r.time * d.uniform(5, 15)


def hoist(s, r):
    """A weight on a drum: lifted, held by a brake, by gears that lock themselves or have losses, or falling."""
    d = s.dice
    off = d.often(0.6)
    s.until = r.time * d.uniform(6, 12)
    stop = s.until * d.uniform(0.2, 0.6)
    by = d.choice(["nothing", "brake always", "brake by sequence", "worm", "lossy gear", "motor alone"])
    never_on = d.often(0.15)
    window = {"stop": stop} if off and by != "brake by sequence" else {}
    if never_on and by != "brake by sequence":
        window = {"start": s.until * 2}
    motor(s, r, rated=d.choice([1, 1, 0.4]), **window)
    if by == "brake always" or by == "brake by sequence":
        B = r.torque * d.uniform(0.3, 4)
        s.part("brake", "brake", torque=q(B, "N*m"), static_torque=q(B * d.uniform(1, 1.3), "N*m"))
    i = d.choice([5, 10, 20])
    if by == "worm":
        s.part("gear", "worm gear", starts="1", teeth=str(2 * i), lead_angle=q(d.uniform(3, 12), "deg"), friction_coefficient=f"{d.uniform(0.04, 0.12):.3g}")
        i *= 2
    else:
        losses = {}
        if by == "lossy gear":
            losses = {"efficiency_forwards": f"{d.uniform(0.4, 0.8):.3g}", "efficiency_backwards": f"{d.uniform(-0.3, 0.6):.3g}"}
        if d.often(0.3) and not losses:
            losses = {"efficiency": "0.9"}
        s.part("gear", "gearbox", stages=f"[{{ teeth = [20, {20 * i}] }}]", **losses)
    other = scaled(r, i)
    s.part("drum", "load", torque=q(other.torque * d.uniform(0.2, 1.2), "N*m"), acts='"always"', inertia=q(other.inertia * d.over(0.3, 2), "kg*m2"))
    if by == "brake by sequence":
        s.step(["motor"], 0, at="0 s")
        s.step("motor", 1, at=f"{0.1 * s.until:.4g} s")
        s.step("brake", 0, after="0 s")
        if d.often(0.8):
            s.step("motor", 0, at=f"{stop:.4g} s" if stop > 0.15 * s.until else f"{0.4 * s.until:.4g} s")
            if d.often(0.8):
                s.step("brake", 1, after=f"{r.time * d.uniform(0, 0.5):.4g} s")
    if d.often(0.2):
        s.start = f"{{ speed = {q(0.5 * r.speed, 'rad/s')}, on = \"motor\" }}"


def never_moves(s, r):
    """A motor too weak to start, one that a brake holds, one that is never on, a machine that nothing drives."""
    d = s.dice
    why = d.choice(["too weak", "brake", "never on", "no drive", "load holds", "open clutch"])
    s.until = r.time * d.uniform(3, 10)
    if why == "no drive":
        s.part("motor", "flywheel", inertia=q(r.inertia, "kg*m2"))
    else:
        motor(s, r, rated=0.2 if why == "too weak" else 1, **({"start": 3 * s.until} if why == "never on" else {}))
    if why == "open clutch":
        s.part("clutch", "clutch", torque=q(r.torque, "N*m"))
        s.step("clutch", 0, at="0 s")
    i = link(s, r, "coupling")
    other = scaled(r, i)
    if why == "brake":
        s.part("brake", "brake", torque=q(other.torque * d.uniform(5, 9), "N*m"), inertia=q(0.1 * other.inertia, "kg*m2"))
    if d.often(0.4):
        load(s, other, "load", share=6 if why == "load holds" else 1, kinds=("constant",) if why in ("too weak", "load holds") else ("constant", "viscous", "fan"))
    else:
        crank(s, r, "machine", other.speed, other.torque, load=4 if why == "load holds" else 0.6)
        if why in ("too weak", "no drive") and d.often(0.5):
            s.part("friction", "bearing", torque=q(other.torque * 1.0, "N*m"))


def braked(s, r):
    """A brake that stops a machine by command or from a time on, strong or too weak, with the motor off or on."""
    d = s.dice
    s.until = r.time * d.uniform(6, 14)
    off = s.until * d.uniform(0.4, 0.7)
    how = d.choice(["sequence", "sequence", "window"])
    motor(s, r, **({"stop": off} if how == "window" and d.often(0.7) else {}))
    B = r.torque * d.over(0.05, 6)
    keys = {"torque": q(B, "N*m"), "static_torque": q(B * d.uniform(1, 1.4), "N*m"), "inertia": q(0.1 * r.inertia, "kg*m2")}
    if how == "window":
        keys["start"] = q(off, "s")
    s.part("brake", "brake", **keys)
    i = link(s, r, "coupling")
    other = scaled(r, i)
    if d.often(0.5):
        crank(s, r, "machine", other.speed, other.torque, load=d.uniform(0.02, 0.3))
    else:
        load(s, other, share=d.uniform(0.02, 0.8))
    if how == "sequence":
        s.step("brake", 0, at="0 s")
        if d.often(0.7):
            s.step("motor", 0, at=f"{off:.4g} s")
            s.step("brake", 1, over=r.time * d.choice([0, 0.1]), after=f"{0.1 * r.time:.4g} s")
        else:
            s.step("brake", 1, over=r.time * d.choice([0, 0.1]), at=f"{off:.4g} s")


def freewheel(s, r):
    """A one-way clutch between a motor and what may run ahead of it."""
    d = s.dice
    s.until = r.time * d.uniform(6, 14)
    motor(s, r, **({"stop": s.until * d.uniform(0.3, 0.7)} if d.often(0.6) else {}))
    s.part("freewheel", "one-way clutch", drag=q(r.torque * d.over(1e-3, 0.05), "N*m") if d.often(0.5) else None)
    s.part("flywheel", "flywheel", inertia=q(r.inertia * d.over(0.3, 3), "kg*m2"))
    if d.often(0.5):
        link(s, r, "coupling")
    if d.often(0.5):
        crank(s, r, load=d.uniform(0.02, 0.4))
    else:
        load(s, r, share=d.uniform(0.05, 0.8), kinds=("constant", "viscous", "fan", "weight"))
    if d.often(0.4):
        faster = scaled(r, 1)
        faster.speed *= d.uniform(0.8, 2)
        motor(s, faster, "second", start=s.until * d.uniform(0, 0.4))
        s.line.remove("second")
        s.keys("second")["on"] = '"flywheel"'


def overloaded(s, r):
    """An induction motor that starts badly, does not come up to speed, or runs hot."""
    d = s.dice
    keys = {"rated_power": q(r.torque * r.speed, "W"), "rated_speed": q(r.speed, "rad/s"), "synchronous_speed": q(r.speed / d.uniform(0.93, 0.98), "rad/s"),
            "breakdown_ratio": f"{d.uniform(1.8, 3):.3g}", "inertia": q(0.3 * r.inertia, "kg*m2")}
    if d.often(0.5):
        keys["starting_ratio"], keys["duty"] = f"{d.uniform(1, 2):.3g}", d.choice(['"S1"', None])
    s.part("motor", "induction motor", **{k: v for k, v in keys.items() if v})
    i = link(s, r, "coupling")
    load(s, scaled(r, i), share=d.choice([0.5, 0.9, 1.1, 1.5, 2.2]), inertia=d.over(0.3, 2), kinds=("constant", "viscous", "fan", "mixed"))
    s.until = r.time * d.uniform(5, 20)


def series(s, r):
    """A DC series motor with little load, or enough."""
    d = s.dice
    k = r.torque / 100  # 10 A at the rated torque
    R = 0.5 * k * r.speed
    s.part("motor", "dc series motor", voltage=q(10 * (R + k * r.speed), "V"), resistance=q(R, "Ohm"), constant=q(k, "N*m/A2"),
           rated_speed=q(r.speed, "rad/s"), max_speed=q(100 * r.speed, "rad/s") if d.often(0.5) else None, inertia=q(0.3 * r.inertia, "kg*m2"))
    i = link(s, r, "coupling")
    load(s, scaled(r, i), share=d.choice([0.001, 0.02, 0.1, 0.5, 1]), inertia=d.over(0.3, 2))
    s.until = r.time * d.uniform(5, 30)


def reversing(s, r):
    """A motor that a sequence switches off, reverses, sets to a part."""
    d = s.dice
    s.part("motor", "dc shunt motor", stall_torque=q(2.5 * r.torque, "N*m"), no_load_speed=q(1.3 * r.speed, "rad/s"), rated_torque=q(r.torque, "N*m"),
           inertia=q(0.3 * r.inertia, "kg*m2"))
    i = link(s, r, "coupling")
    other = scaled(r, i)
    if d.often(0.5):
        crank(s, r, "machine", other.speed, other.torque, load=d.uniform(0.02, 0.4))
    else:
        load(s, other, share=d.uniform(0.05, 0.9))
    s.until = r.time * d.uniform(8, 16)
    at = 0.3 * s.until
    for _ in range(d.randint(1, 3)):
        s.step("motor", d.choice([0, -1, 0.3, 1, -0.5]), over=r.time * d.choice([0, 0.5]), at=f"{at:.4g} s")
        at += 0.2 * s.until


def shaken(s, r):
    """Nothing turns for good: pendulums, torques to and fro, springs."""
    d = s.dice
    how = d.choice(["pendulum", "sine", "weak motor"])
    w = r.speed
    if how == "sine":
        s.part("source", "torque source", amplitude=q(r.torque, "N*m"), frequency=q(d.over(0.5, 20) / r.time / 5, "Hz"), inertia=q(0.3 * r.inertia, "kg*m2"),
               torque=q(r.torque * d.choice([0, 0, 0.5]), "N*m"))
    elif how == "weak motor":
        motor(s, r, "source", rated=0.2)
    else:
        s.part("source", "flywheel", inertia=q(0.3 * r.inertia, "kg*m2"))
    link(s, r, "coupling")
    radius, m = 0.1, r.torque / 9.81 / 0.1
    s.part("rocker", "slider-crank", radius=q(radius, "m"), rod=q(4 * radius, "m"), crank_inertia=q(r.inertia + 0.02 * m * radius**2, "kg*m2"), crank_mass=q(m, "kg"),
           crank_com=q(0.1 * radius, "m"), slider_mass=q(0.5 * m, "kg"), gravity='"9.81 m/s2"')
    if d.often(0.6):
        s.part("drag", "bearing drag", damping=q(r.torque / w * d.over(0.01, 1), "N*m*s/rad"))
    elif d.often(0.5):
        s.part("drag", "bearing", torque=q(r.torque * d.over(0.01, 0.5), "N*m"))
    s.start = f"{{ angle = \"{d.uniform(-150, 150):.4g} deg\" }}" if d.often(0.7) else "\"rest\""
    s.until = r.time * d.uniform(5, 30)


def fluid(s, r):
    """A start over a fluid coupling."""
    d = s.dice
    motor(s, r)
    D = (r.torque / (0.002 * 870 * r.speed**2)) ** 0.2
    s.part("coupling", "fluid coupling", diameter=q(D * d.uniform(0.9, 1.4), "m"),
           **{"lambda": '{ over = "speed ratio", unit = ["1", "1"], points = [[0, 0.008], [0.5, 0.006], [0.9, 0.003], [0.97, 0.0015], [1, 0]] }'})
    load(s, r, share=d.uniform(0.2, 1.2), inertia=d.over(0.5, 3))
    s.until = r.time * d.uniform(5, 20)


def planetary(s, r):
    """A planetary gear whose ring a brake holds, or does not."""
    d = s.dice
    motor(s, r)
    s.part("gear", "planetary gear", sun="24", ring="72", ring_inertia=q(0.3 * r.inertia, "kg*m2"), sun_inertia=q(0.01 * r.inertia, "kg*m2"),
           carrier_inertia=q(0.3 * r.inertia, "kg*m2"), efficiency="0.97" if d.often(0.5) else None)
    load(s, scaled(r, 4), share=d.uniform(0.1, 0.9), inertia=d.over(0.2, 1))
    s.part("brake", "brake", torque=q(3 * r.torque * d.over(0.3, 3), "N*m"), inertia=q(0.02 * r.inertia, "kg*m2"))
    s.line.remove("brake")
    s.branches.append(("gear.ring", ["brake"]))
    s.until = r.time * d.uniform(6, 15)
    s.step("brake", 0, at="0 s")
    s.step("brake", 1, over=r.time * d.uniform(0, 1), at=f"{s.until * d.uniform(0.1, 0.5):.4g} s")
    if d.often(0.3):
        s.step("brake", 0, at=f"{0.8 * s.until:.4g} s")


FAMILIES = {f.__name__: (f, weight) for f, weight in (
    (plain, 3), (run_up_and_down, 3), (open_clutch, 3), (clutch_slips, 4), (single_stroke, 3), (engine, 3), (hoist, 4), (never_moves, 3),
    (braked, 3), (freewheel, 3), (overloaded, 2), (series, 1), (reversing, 2), (shaken, 2), (fluid, 1), (planetary, 1))}


def machine(seed, number, only=None):
    dice = Dice(f"{seed}:{number}")
    names = [n for n in FAMILIES if not only or n in only]
    family = dice.choices(names, [FAMILIES[n][1] for n in names])[0]
    scene = Scene(dice, f"{family} {seed}:{number}")
    r = Rated(dice)
    FAMILIES[family][0](scene, r)
    if dice.often(0.4):
        rate(scene, r)
    return Machine(family, scene.text(), f"{family}_{seed}_{number}")
