"""Which values of two commands mean the same. A pair is a function of the answers of one scene, by command (`Told`), that
yields `Same` for values and `Words` for conclusions; docstrings say why both are one thing."""
import math
import re
from collections import Counter
from dataclasses import dataclass

from asked import effects_of_forces, figure, figure_time, same_effects, slowest

# Of a run that has not settled a figure of its last cycle is off by some times what its mid speed is off. The settled run
# is exact; here figures other than speeds are compared where that is nothing.
OF_OTHERS = 100
SETTLED = 1e-9    # of the speed
LEFT_IS_ABOUT = 3  # what a motion has still to change is itself an estimate


@dataclass(frozen=True)
class Value:
    value: float
    error: float | None
    where: str          # command and place in its summary
    scale: float = 0    # beside which rounding is nothing


@dataclass(frozen=True)
class Same:
    figure: str
    a: Value
    b: Value


@dataclass(frozen=True)
class Words:
    what: str
    a: str
    b: str
    agree: bool


def number(x):
    return isinstance(x, (int, float)) and not isinstance(x, bool) and math.isfinite(x)


def values(figures, where, scale=0):
    """{name: Value} of a list of figures; of equal names the first, and without those that are not stated."""
    found = {}
    for f in figures:
        if number(f.get("value")):
            found.setdefault(f["name"], Value(f["value"], f.get("error"), f"{where} {f['name']}", scale))
    return found


def both(a, b, of=None):
    for name in a:
        if name in b and (of is None or of(name)):
            yield Same(name, a[name], b[name])


def absolute(v):
    return Value(abs(v.value), v.error, v.where, v.scale)


def plus(v, error):
    return Value(v.value, None if v.error is None else v.error + error, v.where, v.scale)


def times(v, factor):
    return Value(v.value * factor, None if v.error is None else v.error * abs(factor), f"{v.where} × {factor:.6g}", v.scale * abs(factor))


def turnover(cycle):
    """The largest of a cycle's works: beside it another work may be nothing."""
    return max((abs(f["value"]) for f in cycle["figures"] if "work_per_cycle" in f["name"] and number(f["value"])), default=0)


def cycle_values(cycle, label="steady"):
    largest, found = turnover(cycle), {}
    for name, v in values(cycle["figures"], f"{label} ({cycle['label']})").items():
        found[name] = Value(v.value, v.error, v.where, largest if "work" in name else name.startswith("delta"))
    return found


# --- runs of one machine, reported by several commands ---

def events_of(summary):
    return Counter((e["component"], e["kind"], e["what"]) for e in summary["events"])


def runs_alike(a, b, name_a, name_b):
    yield from both(values(a["figures"], name_a), values(b["figures"], name_b))
    for key in ("run_up_end", "run_down_begin", "standstill", "steady"):
        x, y = a["periods"][key], b["periods"][key]
        if number(x) and number(y):
            continue  # figures say so with errors
        yield Words(f"periods.{key}", f"{name_a}: {x}", f"{name_b}: {y}", x == y)
    x, y = events_of(a), events_of(b)
    for what in sorted({*x, *y}, key=str):
        yield Words(f"number of events {' '.join(map(str, what))}", f"{name_a}: {x[what]}", f"{name_b}: {y[what]}", x[what] == y[what])


def run_and_compare(told):
    """`compare` runs the same machine as `run`, and another one."""
    run, compare = told.get("run"), told.get("compare")
    for label, model in (compare or {}).get("models", {}).items() if run else ():
        if model["model"]["effects"] == run["model"]["effects"]:
            yield from runs_alike(run, model, "run", f"compare ({label})")
            return


def run_and_diff(told):
    """Both columns of a machine beside itself are those of its run."""
    run, diff = told.get("run"), told.get("diff")
    if not run or not diff:
        return
    own = values(run["figures"], "run")
    for side in "ab":
        other = {f["name"]: Value(f[side], f.get(f"{side}_error"), f"diff ({side}) {f['name']}") for f in diff["figures"] if number(f.get(side))}
        yield from both(own, other)
    for f in diff["figures"]:
        yield Words(f"{f['name']} differs from itself", "diff: differs" if f["differs"] else "", "the same machine", not f["differs"])


def run_and_effects(told):
    """The full model of `effects`, where it is that of the scene. The error is that of the change over the full value."""
    run, effects = told.get("run"), told.get("effects")
    if not run or not effects or effects["full"]["effects"] != run["model"]["effects"]:
        return
    own, seen = values(run["figures"], "run"), set()
    for effect in effects["effects"]:
        if effect.get("in_place_of"):
            continue  # it is compared within a model of its own
        for c in effect["changes"]:
            name = c["figure"]
            if name in own and name not in seen and number(c["full"]) and number(c["error"]):
                seen.add(name)
                yield Same(name, own[name], Value(c["full"], c["error"] * abs(c["full"]), f"effects full {name}"))
    if len(effects["effects"]) and (rigid := rigid_of(told, "none")):
        elastic = [e for e in effects["effects"] if e["effect"].startswith("elasticity:")]
        if len(elastic) == 1 and "," not in run["model"]["effects"] and " and " not in run["model"]["effects"]:
            for c in elastic[0]["changes"]:
                if c["figure"] in rigid and number(c["without"]) and number(c["error"]):
                    yield Same(c["figure"], rigid[c["figure"]], Value(
                        c["without"], c["error"] * abs(c["full"]), f"effects without {elastic[0]['effect']} {c['figure']}"))


def rigid_of(told, effects):
    for label, model in (told.get("compare") or {}).get("models", {}).items():
        if model["model"]["effects"] == effects:
            return values(model["figures"], f"compare ({label})")
    return None


def set_of(effects):
    return frozenset(re.sub(r"\belasticity of ", "", effects).replace(" and ", ", ").split(", ")) - {"none"}


def effects_and_advise(told):
    """What leaving one effect out changes in a figure is, for `advise`, the deviation of that set."""
    effects, advise = told.get("effects"), told.get("advise")
    if not effects or not advise:
        return
    full = max((set_of(t["effects"]) for t in advise["tried"]), key=len, default=frozenset())
    if advise["tried"] and full != set_of(advise["tried"][0]["effects"]):
        return
    left = LEFT_IS_ABOUT * left_of(told.get("run"))
    for tried in advise["tried"]:
        missing = full - set_of(tried["effects"])
        if len(missing) != 1 or not tried.get("figure") or set_of(tried["effects"]) - full:
            continue
        gone = next(iter(missing))
        for effect in effects["effects"]:
            if effect["effect"].removeprefix("elasticity:").replace("_", " ") != gone.replace("_", " "):
                continue
            for c in effect["changes"]:
                if c["figure"] == tried["figure"] and number(c["relative"]) and number(tried["deviation"]):
                    yield Same(f"change of {c['figure']} without {gone}", plus(Value(c["relative"], c["error"], "effects relative"), left),
                               Value(tried["deviation"], tried["error"], "advise deviation"))


def run_and_accuracy(told):
    """Values that `accuracy` holds settings against: two methods at the tightest tolerance, apart by `agreement` of the value."""
    for model in (told.get("accuracy") or {}).get("models", ()):
        own = rigid_of(told, model["effects"])
        if not own and (run := told.get("run")) and run["model"]["effects"] == model["effects"]:
            own = values(run["figures"], "run")
        for f in model["figures"] if own else ():
            if f["name"] in own and number(f["value"]) and number(f["agreement"]):
                yield Same(f["name"], own[f["name"]], Value(f["value"], f["agreement"] * abs(f["value"]), f"accuracy ({model['name']}) {f['name']}"))


def run_and_uncertainty(told):
    """The machine without its tolerances."""
    run, uncertain = told.get("run"), told.get("uncertainty")
    if run and uncertain:
        own = values(run["figures"], "run")
        yield from both(own, {f["figure"]: Value(f["value"], f["numerical"], f"uncertainty {f['figure']}")
                              for f in uncertain["figures"] if number(f.get("value"))})


def run_and_figures(told):
    """`figures` lists what runs of the scene yield."""
    run, listed = told.get("run"), told.said("figures")
    if not run or not listed:
        return
    names = {line.split()[0] for line in listed.splitlines() if line.strip() and not line.startswith(" ")}
    for f in run["figures"]:
        yield Words(f"list of figures has {f['name']}", "run: has it", "figures: " + ("has it" if f["name"] in names else "has it not"),
                    f["name"] in names)


# --- the steady motion ---

def last_cycle(figures):
    """The figures of a run's last cycle have the names of those of `steady`."""
    return lambda name: not name.startswith(("greatest_torque", "least_torque"))


def left_of(run):
    """What a run's mid speed still has to go, over itself; 0: it has none, or no steady motion to come to."""
    left = ((run or {}).get("periods") or {}).get("remaining_to_limit")
    mid = next((f["value"] for f in (run or {}).get("figures", ()) if f["name"].startswith("mid_speed")), None)
    return abs(left / mid) if number(left) and number(mid) and mid else 0


def run_and_steady(told):
    """A run that has become steady, by its own account to within `remaining_to_limit` of its mid speed."""
    pair = same_effects(told.answers)
    if pair:
        yield from ended_and_steady(pair[1], pair[0], "run")


def rigid_and_steady(told):
    """The rigid machine of `compare` is that of `steady`."""
    for label, model in (told.get("compare") or {}).get("models", {}).items():
        for cycle in (told.get("steady") or {}).get("cycles", ()):
            if label == "rigid" and cycle["effects"] == model["model"]["effects"]:
                yield from ended_and_steady(model, cycle, f"compare ({label})")


def ended_and_steady(run, cycle, name):
    periods, left = run["periods"], run["periods"]["remaining_to_limit"]
    if not cycle.get("found") or not periods["steady"] or periods["run_down_begin"] is not None or not number(left):
        return  # what is shown of a machine that ends otherwise is not its last cycle
    own, steady = values(run["figures"], name), cycle_values(cycle)
    speed = figure(cycle["figures"], "mean_speed") or 1
    for s in both(own, steady, last_cycle(run)):
        kind = s.figure.partition(".")[0]
        if kind == "mid_speed":
            yield Same(s.figure, plus(s.a, LEFT_IS_ABOUT * abs(left)), s.b)
        elif abs(left / speed) < SETTLED:
            yield Same(s.figure, plus(s.a, OF_OTHERS * abs(left / speed) * max(abs(s.b.value), s.b.scale)), s.b)
    if any(e["kind"] == "command" for e in run["events"]):
        return  # of all cycles that repeat between commands the heaviest counts as thermal use
    use = {d["component"]: d for d in cycle.get("drives", ())}
    for name_of, v in own.items():
        kind, _, component = name_of.partition(".")
        if kind == "thermal_use" and component in use and number(use[component].get("thermal_use")) and abs(left / speed) < SETTLED:
            rms = steady.get(f"rms_drive_torque.{component}")
            rated = use[component]["rated_torque"]
            yield Same(name_of, plus(v, OF_OTHERS * abs(left / speed)), Value(
                use[component]["thermal_use"], rms.error / rated if rms and rms.error is not None else None, f"steady drives {component} thermal_use"))


# Of a run over one period, and of `steady`: the same functional of the same quantity.
OF_PERIOD = {"peak_torque": "cycle_peak_torque", "peak_spring_torque": "cycle_peak_spring_torque", "rms_torque": "cycle_rms_torque",
             "max_speed": "cycle_max_speed", "min_speed": "cycle_min_speed", "motor_peak_torque": "peak_drive_torque",
             "motor_rms_torque": "rms_drive_torque", "greatest_torque": "greatest_torque", "least_torque": "least_torque",
             **{f"peak_{q}": f"cycle_peak_{q}" for q in (
                 "velocity", "acceleration", "force", "current", "load_torque", "guide_reaction", "crank_pin_force",
                 "crank_pin_penetration", "rod_deflection", "rod_bending_stress", "bending_1", "bending_2", "stretching_end")}}
PEAKS = ("peak_", "motor_peak_")  # of two of opposite signs that are equal either may be taken


def settled_and_steady(told):
    """Two periods of the machine run on from its own start until nothing is left of it: each is a cycle of `steady`. What
    still differs between the two, and by the slowest multiplier all that would follow, is part of the run's error."""
    pair, answer = same_effects(told.answers), told.whole("run settled")
    runs = [a.get("summary") for a in (answer or {}).get("then", ())]
    if not pair or len(runs) != 2 or not all(runs):
        return
    cycle = pair[0]
    steady, more = cycle_values(cycle), LEFT_IS_ABOUT / max(1 - slowest(cycle), 1e-3)
    first, second = (values(r["figures"], "run settled") for r in runs)

    def own(name, scale=0):
        """With the error of what is still to come; None where a period does not show it."""
        a, b = first.get(name), second.get(name)
        if not a or not b:
            return None
        x, y = (abs(a.value), abs(b.value)) if name.startswith(PEAKS) else (a.value, b.value)
        return Value(y, None if b.error is None else b.error + more * abs(y - x), b.where, scale)
    for name in second:
        kind, dot, of = name.partition(".")
        other = steady.get(OF_PERIOD.get(kind, "") + dot + of)
        v = own(name)
        if other and v:
            yield Same(name, v, absolute(other) if name.startswith(PEAKS) else other)
    for kind in ("driving", "useful", "harmful", "weight"):
        v, other = own(f"work.{kind}", turnover(cycle)), steady.get(f"{kind}_work_per_cycle")
        if v and other:
            yield Same(f"work.{kind}", v, other)
    for name in first:
        kind, _, component = name.partition(".")
        if kind == "motor_mean_power" and (v := own(name)) and (other := steady.get(f"cycle_motor_power.{component}")):
            yield Same(name, v, other)
    accounts = Counter()
    for f in cycle["figures"]:
        if f["name"].startswith("work_per_cycle."):
            accounts[f["name"].removeprefix("work_per_cycle.").rpartition(" (")[0]] += f["value"]
    error = max((v.error or 0 for n, v in second.items() if n.startswith("work.")), default=0) + max(
        (v.error or 0 for n, v in steady.items() if "work_per_cycle" in n), default=0)
    works = [r["energy_balance"]["work_by_component"] for r in runs]
    for component, sum_ in accounts.items():
        if component in works[1]:
            x, y = works[0].get(component, 0), works[1][component]
            yield Same(f"work of {component}", Value(y, error + more * abs(y - x), f"run settled work_by_component.{component}", turnover(cycle)),
                       Value(sum_, error, f"steady work_per_cycle.{component}", turnover(cycle)))
    yield Words("the machine that is run on is steady", f"run settled: {runs[1]['conclusion'][:160]}", f"steady: {cycle['steady_motion']['words']}",
                not re.search(r"runs away|stalls|does not start|comes to rest|rests at", runs[1]["conclusion"]))


# --- size, reduce, forces, modes ---

MODELS = {"rigid, simulated": "rigid", "elastic, simulated": "elastic"}


def size_and_steady(told):
    """δ and mid speed that `size` found by simulation with a flywheel, against `steady` of the machine with that flywheel."""
    size = told.get("size")
    for command, answer, about in told.further("steady resized"):
        for row in size["reached"] if size else ():
            label = MODELS.get(row["model"])
            if row["flywheel"] != about["flywheel"] or label is None:
                continue
            for cycle in answer["cycles"]:
                if cycle["label"] != label or not cycle.get("found"):
                    continue
                steady = cycle_values(cycle, command)
                for what, value, error in (("delta", row["delta_crank"], row["delta_crank_error"]),
                                           ("mid_speed", row["mid_speed"], (row["delta_crank_error"] or 0) * abs(row["mid_speed"] or 0))):
                    other = steady.get(f"{what}.{size['link']}")
                    if other and number(value) and row["settled"]:
                        yield Same(f"{what} with {about['flywheel']:.6g} ({row['sized_by']}, {label})",
                                   Value(value, error, f"size reached ({row['model']}, {row['sized_by']})"), other)


def size_and_present(told):
    """δ with the flywheel that the scene has."""
    size, steady = told.get("size"), told.get("steady")
    if not size or not steady:
        return
    # The work equation is an estimate; that of the motion is `steady`'s of the scene's effects.
    value, link = size["flywheel"].get("delta_of_steady_cycle_in_scene"), size["link"]
    cycle = steady["cycles"][-1]
    if number(value) and cycle.get("found") and (other := cycle_values(cycle).get(f"delta.{link}")):
        yield Same("δ as the scene is", Value(value, None, "size flywheel.delta_of_steady_cycle_in_scene"), other)


def operating_speeds(told):
    """The speed at which mean torques of drive and load balance: `steady`'s operating point, `size` and `reduce`."""
    size, reduced, steady = (told.get(c) for c in ("size", "reduce", "steady"))
    points = [p for p in (steady or {}).get("operating_points", ()) if p.get("stable")]
    found = []
    if size and size["basis"] == "classical" and "operating speed" in size["mid_speed"]["source"]:
        found.append((Value(size["mid_speed"]["value"], None, "size mid_speed"), size["link"], size["work_diagram"].get("mean_torque"), "size work_diagram.mean_torque"))
    if reduced and reduced["basis"] == "classical" and "operating speed" in reduced["speed"]["source"] and reduced["reduced_to"] == reduced["link"]:
        drive = order_of(reduced, "driving torque", 0)
        found.append((Value(reduced["speed"]["value"], None, "reduce speed"), reduced["link"], drive and drive.value, "reduce mean driving torque"))
    for speed, _, torque, words in found:
        if len(points) == 1:
            p = points[0]
            yield Same("operating speed", speed, Value(p["speed"], p["speed_error"], "steady operating_points speed"))
            if number(torque):
                yield Same("mean torque there", Value(torque, None, words), Value(p["torque"], p["torque_error"], "steady operating_points torque"))
    if len(found) == 2 and found[0][1] == found[1][1]:
        yield Same("operating speed", found[0][0], found[1][0])
        if number(found[0][2]) and number(found[1][2]):
            yield Same("mean torque there", *(Value(t, None, w) for _, _, t, w in found))


def order_of(reduced, name, order):
    for h in reduced["harmonics"]:
        if h["name"].startswith(name):
            for o in h["orders"]:
                if o["order"] == order:
                    return Value(o["amplitude"] * (1 if order or abs(o["phase"]) < 1 else -1), o["error"], f"reduce harmonics {name} order {order}")
    return None


def reduce_and_steady(told):
    """Along the steady cycle `reduce` has its speed, and its torques' means are the works over the angle."""
    reduced, pair = told.get("reduce"), same_effects(told.answers)
    if not reduced or not pair or not pair[0].get("found") or reduced["basis"] != "steady" or reduced["reduced_to"] != reduced["link"]:
        return
    cycle, link = cycle_values(pair[0]), reduced["link"]
    speed = cycle.get(f"mid_speed.{link}" if "mid speed" in reduced["speed"]["source"] else f"mean_speed.{link}")
    if speed and "steady" in reduced["speed"]["source"] or speed and "start leads to" in reduced["speed"]["source"]:
        yield Same("speed", Value(reduced["speed"]["value"], None, "reduce speed"), speed)
    mean, time = cycle.get(f"mean_speed.{link}"), cycle.get("period")  # of the works, too
    work = cycle.get("driving_work_per_cycle")
    drive = order_of(reduced, "driving torque", 0)
    if mean and time and work and drive and abs(mean.value * time.value) > 1e-9:
        # Torques count along the motion.
        yield Same("mean driving torque", drive, times(work, 1 / abs(mean.value * time.value)))


def chains(told):
    """Springs and dampers as `reduce` draws them, at rest, and as `modes` has them at its operating point: linear ones are
    the same, and the pieces of a shaft in series are the shaft. Neither states an error."""
    reduced, modes = told.get("reduce"), told.get("modes")
    if not reduced or not modes:
        return
    def in_series(pieces):
        found = {}
        for piece in pieces:
            name, _, last = piece["name"].rpartition(".")
            found.setdefault(name if last.isdigit() else piece["name"], []).append(piece)
        return {(name, key): 1 / sum(1 / p[key] for p in of) for name, of in found.items() for key in ("stiffness", "damping")
                if all(number(p.get(key)) and p[key] > 0 for p in of)}
    drawn, joints = in_series((reduced.get("chain") or {}).get("springs", ())), in_series(modes["joints"])
    for name, key in drawn:
        if (name, key) in joints:
            yield Same(f"{key} of {name}", Value(drawn[name, key], None, f"reduce chain {key}"), Value(joints[name, key], None, f"modes joints {key}"))


def forces_and_steady(told):
    """Speeds of the crank in the cycle that `forces` is of, and the works of what loads it."""
    forces, effects = told.get("forces"), effects_of_forces(told.get("forces"))
    if not effects:
        return
    answers = [("steady", told.get("steady"))] + [(c, a) for c, a, _ in told.further("steady as forces")]
    for command, steady in answers:
        for cycle in (steady or {}).get("cycles", ()):
            if cycle["effects"] != effects[0] or not cycle.get("found"):
                continue
            own, s, name = cycle_values(cycle, command), forces["simulated"], forces["mechanism"]
            for key, error, figure_name in (("mean_speed", "mean_speed_error", f"mean_speed.{name}"),
                                            ("least_speed", "speed_extremes_error", f"cycle_min_speed.{name}"),
                                            ("greatest_speed", "speed_extremes_error", f"cycle_max_speed.{name}")):
                if figure_name in own and number(s[key]):
                    yield Same(figure_name, Value(s[key], s[error], f"forces simulated {key}"), own[figure_name])
            # Extremes are over all cycles until it repeats, works over one of the crank.
            if "of them until it repeats" in s["description"]:
                return
            turns = own.get("period").value * own.get("mean_speed." + name).value / s["cycle"] if own.get("mean_speed." + name) else None
            for w in s["work"]:
                other = own.get(f"work_per_cycle.{w['name']} ({w['line']})")
                if other and turns and abs(turns - 1) < 1e-6:
                    yield Same(other.where, Value(w["work"], w["error"], f"forces simulated work {w['name']}", turnover(cycle)), other)
            return


def modes_and_steady(told):
    """The state that `modes` linearises at, and what oscillates there in the cycle itself."""
    modes, pair = told.get("modes"), same_effects(told.answers)
    if not modes or not pair or not pair[0].get("found"):
        return
    cycle, point = cycle_values(pair[0]), modes["operating_point"]
    if speed := cycle.get(f"mean_speed.{point['link']}"):
        yield Same("operating speed", Value(point["speed"], None, "modes operating_point.speed"), speed)
    for r in modes["response"]:
        if "cycle_peak" not in r:  # the motion itself was not followed
            continue
        peak, rms = (cycle.get(f"{n}.{r['joint']}") for n in ("cycle_peak_torque", "cycle_rms_torque"))
        if peak and number(r["cycle_peak"]) and r["cycle_peak"]:
            # It is the largest way from the mean, to whichever side: on the other one the torque may go less far.
            reach = abs(abs(r["mean"]) - r["cycle_peak"]), abs(r["mean"]) + r["cycle_peak"]
            yield Same(f"peak torque in {r['joint']}, within {reach[0]:.6g} … {reach[1]:.6g}", Value(
                min(max(abs(peak.value), reach[0]), reach[1]), None, "modes response mean, cycle_peak"), absolute(peak))
        elif rms and number(r["mean"]) and not r["cycle_peak"] and pair[0]["steady_motion"]["kind"] == "equilibrium":
            yield Same(f"mean torque in {r['joint']}", Value(abs(r["mean"]), None, "modes response mean"), rms)


def modes_and_multipliers(told):
    """At an equilibrium a period leaves e^(λT) of a deviation by mode λ."""
    modes, pair = told.get("modes"), same_effects(told.answers)
    if not modes or not pair or not pair[0].get("found") or pair[0]["steady_motion"]["kind"] != "equilibrium":
        return
    cycle = pair[0]
    period, multipliers = figure(cycle["figures"], "period"), cycle.get("multipliers") or ()
    for mode in modes["modes"]:
        damped = mode.get("damped")
        if not damped or not period or not multipliers or not number(damped.get("real")) or damped["real"] == damped["imaginary"] == 0:
            continue
        told_, error = math.exp(damped["real"] * period), mode["error"] * period
        nearest = min(multipliers, key=lambda m: abs(m["magnitude"] - told_))
        yield Same(f"what a period leaves of mode {mode['number']}", Value(told_, max(error, 1e-9) * told_ + 1e-9, "modes exp(damped.real × period)"),
                   Value(nearest["magnitude"], nearest["error"], "steady multipliers, the nearest"))


# --- verdicts and conclusions ---

def ratings_of(told):
    for command in ("run", "steady", "compare", "modes"):
        answer = told.get(command) or {}
        for r in answer.get("ratings") or answer.get("verdicts") or ():
            yield command, r


def load_case(command, rating):
    """That a verdict is on, as it says itself: "start", "steady", "run", a step of the sequence; what says none is on the
    run of the scene with its start, or on the steady motion. None where it is not assessed, or on a start that is made up."""
    if rating["verdict"] == "not assessed" or "not given by the scene" in rating.get("note", ""):
        return None
    if "load_case" in rating:
        return rating["load_case"]
    steady = command == "steady" or command == "modes" and not rating["requirement"].startswith("maximum")
    return "steady" if steady or "steady cycle" in rating["requirement"] else "run"


def verdicts(told):
    """The same limit on the same load case has the same verdict and value. A run that becomes steady has its steady motion
    within it: what that exceeds, the run exceeds."""
    pair, seen = same_effects(told.answers), {}
    within = pair and pair[1]["periods"]["steady"] and pair[1]["periods"]["run_down_begin"] is None
    for command, r in ratings_of(told):
        case = load_case(command, r)
        for other_command, other_case, other in seen.setdefault((r["component"], r["requirement"]), []):
            what = f"verdict on {r['component']}, {r['requirement']}"
            told_as = lambda x: f"{x:.6g}" if number(x) else "not assessed"  # noqa: E731
            said = [f"{c}: {x['verdict']} ({told_as(x['value'])} of {told_as(x['limit'])})"
                    for c, x in ((other_command, other), (command, r))]
            if number(r["limit"]) and number(other["limit"]):
                yield Same(f"limit of {what}", Value(other["limit"], None, f"{other_command} ratings"), Value(r["limit"], None, f"{command} ratings"))
            if case and case == other_case:
                yield Words(what, *said, other["verdict"] == r["verdict"])
                # What a run takes for steady has still to settle by up to a thousandth: its verdict is the same, not its value.
                settles = case == "steady" and (command in ("run", "compare")) != (other_command in ("run", "compare"))
                if number(r["value"]) and number(other["value"]) and not settles:
                    yield Same(what, Value(other["value"], other["error"], f"{other_command} ratings"), Value(r["value"], r["error"], f"{command} ratings"))
            elif {case, other_case} == {"steady", "run"} and within and "RMS" not in r["requirement"]:
                steady, run = (r, other) if case == "steady" else (other, r)
                yield Words(what, *said, steady["holds"] or not run["holds"])
        if case:
            seen[r["component"], r["requirement"]].append((command, case, r))


def hot(conclusion):
    return {m.group(1): float(m.group(2)) for m in re.finditer(r'"([^"]+)" gets too hot: .*? is (\d+) %', conclusion)}


def too_hot(told):
    """A motor that gets too hot in its steady motion does so in every command that reports that motion."""
    pair = same_effects(told.answers)
    if not pair or not pair[0].get("found") or not pair[1]["periods"]["steady"]:
        return
    said = {c: hot(told.get(c)["conclusion"]) for c in ("run", "compare", "steady") if told.get(c)}
    for motor in {m for s in said.values() for m in s}:
        first = said["run"].get(motor)
        for command, s in said.items():
            other = s.get(motor)
            agree = first is not None and other is not None and abs(first - other) <= 1
            yield Words(f"{motor} gets too hot", f"run: {first} %", f"{command}: {other} %", agree)


RESTS = re.compile(r"(?:comes to rest at|rests at|of its rated speed from) ([\d.e+-]+) (s|ms|min|h)\b")
UNITS = {"s": 1, "ms": 1e-3, "min": 60, "h": 3600}


def rest_of(words):
    m = RESTS.search(words or "")
    return float(m.group(1)) * UNITS[m.group(2)] if m else None


def kinds_of_motion(told):
    """Comes to rest, stalls, goes on: `steady` of the scene's effects against what `run` has seen by its end; the time of
    rest to the four digits that are said. That of `run` is the link's: behind springs the rest of the machine rests later.
    Of a machine that rests in the end `steady` shows the motion that it keeps before, and says when it rests."""
    pair = same_effects(told.answers)
    if not pair:
        return
    cycle, run = pair
    end, stands = figure_time(run) or 0, run["periods"]["standstill"]
    why, conclusion = cycle.get("why") or "", told.get("steady")["conclusion"]
    ends = why if not cycle.get("found") else conclusion if "At the end" in conclusion else ""
    rest = rest_of(ends)
    said, ran = f"steady: {why or conclusion}"[:240], f"run: {run['conclusion']}"[:240]
    if rest is not None and stands is not None:
        later = "elastic" in (c["label"] for c in told.get("steady")["cycles"])
        yield Words("when it comes to rest", f"steady: {rest} s", f"run: standstill {stands:.6g} s",
                    abs(rest - stands) <= 1e-3 * stands or later and rest > stands)
    elif rest is not None and rest < 0.999 * end:
        yield Words("it comes to rest", said, ran, "at rest" in run["conclusion"])
    elif ends and "stall" in ends:
        yield Words("it stalls", said, ran, "runs steadily" not in run["conclusion"])
    elif cycle.get("found"):
        yield Words("it goes on", said, ran, (stands is None or "stands while" in ends) and not re.search(
            r"runs away|stalls|does not start", run["conclusion"]))


def rests_alike(told):
    """When the machine comes to rest, as `size` and `reduce` refuse and as `steady` does."""
    steady = told.get("steady")
    times_ = [t for t in (rest_of(w) for w in ((steady or {}).get("conclusion"), *(c.get("why") for c in (steady or {}).get("cycles", ()))))
              if t is not None]
    for command in ("size", "reduce", "forces"):
        t = rest_of(told.complaint(command))
        if t is not None and steady:
            yield Words("when it comes to rest", f"{command}: {t} s", f"steady: {times_ or steady['conclusion'][:160]}", any(abs(t - x) <= 1e-3 * x for x in times_))


def figures_in(node, where):
    """Every list of figures of a summary, with its place."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key == "figures" and isinstance(value, list):
                yield f"{where} {key}", value
            yield from figures_in(value, f"{where} {key}")
    elif isinstance(node, list):
        for i, value in enumerate(node):
            yield from figures_in(value, f"{where} {i + 1}")


def one_figure_of_a_name(told):
    """A name stands once in a list of figures: its value and error are looked up by it."""
    for command in told.cells:
        for where, figures in figures_in(told.get(command), command):
            count = Counter(f.get("name") or f.get("figure") for f in figures)
            name, times_ = count.most_common(1)[0] if count else ("", 1)
            yield Words("a figure's name", f"{where}: {times_} of {name}", "one", times_ == 1)


def accepted(told):
    """What `check` finds valid, `run` runs."""
    check, run = told.whole("check"), told.whole("run")
    if check and run and "exit" in check and "exit" in run:
        yield Words("the scene is valid", f"check: exit {check['exit']}", f"run: exit {run['exit']}", (check["exit"] == 0) == (run["exit"] != 2))


PAIRS = (run_and_compare, run_and_diff, run_and_effects, effects_and_advise, run_and_accuracy, run_and_uncertainty, run_and_figures,
         run_and_steady, rigid_and_steady, settled_and_steady, size_and_steady, size_and_present, operating_speeds, reduce_and_steady,
         chains, forces_and_steady, modes_and_steady, modes_and_multipliers, verdicts, too_hot, kinds_of_motion, rests_alike, one_figure_of_a_name, accepted)
