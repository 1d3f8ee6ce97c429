"""The questions put to every scene, and those that follow from an answer: a steady motion that is also run, etc."""
import math
import os
import re
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "golden"))
import cells as golden  # noqa: E402

QUICK = 20  # s of processor time: dearer cells are skipped by --quick

# Of the commands of the golden outputs those that answer with figures of one machine. `diff` of a scene with itself, so
# that its figures are those of the scene. Without those, `accuracy` and `uncertainty` are asked only without --quick.
BASE = ("check", "figures", "run", "compare", "steady", "size", "reduce", "forces", "modes", "gears", "effects", "advise")
DEAR = ("accuracy", "uncertainty")
ITSELF = golden.Command(("diff", "SCENE", "SCENE"))

WORST_LEFT = 1e-10    # of a deviation, when a run is taken as settled
MOST_PERIODS = 4000   # of the steady motion, until it is
MOST_TIME = 1000      # s of machine time, until it is


@dataclass(frozen=True)
class Further(golden.Cell):
    """A question that follows from an answer, with what it was made from."""
    question: golden.Command = None
    about: tuple = ()

    @property
    def asked(self):
        return self.question


def base_cells(only, scenes, dear):
    names = [c for c in (*BASE, *(DEAR if dear else ())) if golden.fits(c, only)]
    cells = [c for name in names for c in golden.cells_of([name], scenes)]
    if golden.fits("diff", only):
        cells += [Further("diff", s, ITSELF) for s in golden.all_scenes() if golden.fits(s, scenes)]
    return cells


def further_cells(scene, answers, only):
    """Of one scene; `answers`: the summaries by command."""
    found = [settled(scene, answers), *resized(scene, answers), *as_forces(scene, answers)]
    return [c for c in found if c and golden.fits(c.command, only)]


def same_effects(answers):
    """(cycle of `steady`, summary of `run`) of the same model; None: none."""
    run, steady = answers.get("run"), answers.get("steady")
    if run and steady:
        for cycle in steady["cycles"]:
            if cycle["effects"] == run["model"]["effects"]:
                return cycle, run
    return None


def figure(figures, begin):
    """The first whose name begins so."""
    return next((f["value"] for f in figures if f["name"].startswith(begin) and f["value"] is not None), None)


def slowest(cycle):
    """What a period leaves of a deviation that dies away; a multiplier of 1 belongs to a phase, or to no preferred speed."""
    sizes = [m["magnitude"] for m in cycle.get("multipliers") or () if abs(m["magnitude"] - 1) > 1e-6]
    return max(sizes, default=0)


def settled(scene, answers):
    """The machine run from its own start until `steady`'s multipliers leave nothing of it, then two periods more."""
    pair = same_effects(answers)
    if not pair or not pair[0].get("found") or pair[0].get("stable") is False:
        return None
    cycle, run = pair
    period, left = figure(cycle["figures"], "period"), slowest(cycle)
    end = figure_time(run)
    if not period or not end or left >= 1:
        return None
    number = math.ceil(math.log(WORST_LEFT) / math.log(left) - 1e-9) if left > 0 else 1
    begin = end + max(1, min(number, MOST_PERIODS, math.ceil(MOST_TIME / period))) * period
    if run.get("periods", {}).get("standstill") is not None:
        return None
    if any("shown is the motion that it keeps" in note for note in answers["steady"].get("notes", ())):
        return None  # the machine does something else in the end
    at = [f"{begin + k * period!r} s" for k in range(3)]
    to = ("run", "SCENE", "--no-trials", "--until")
    return Further("run settled", scene, golden.Command(
        (*to, at[0], "--no-error", "--save-state", "STATE.0"), writes=True,
        then=((*to, at[1], "--from-state", "STATE.0", "--save-state", "STATE.1"), (*to, at[2], "--from-state", "STATE.1"))),
        (("left", left), ("period", period)))


def figure_time(run):
    """When the run of the scene ends."""
    return next((f["at"] for f in run["figures"] if f["name"].startswith("final_") and f.get("at")), None)


def resized(scene, answers):
    """`steady` of the machine with the flywheel that `size` made for it, where the scene has one to be changed."""
    size = answers.get("size")
    if not size or size["flywheel"].get("added") or not size["flywheel"].get("needed"):
        return
    wheel, done = size["flywheel"]["component"], set()
    for row in size["reached"]:
        inertia = row["flywheel"]
        if "simulated" in row["model"] and row.get("settled") and inertia and inertia > 0 and inertia not in done:
            done.add(inertia)
            yield Further(f"steady resized {len(done)}", scene, golden.Command(
                ("steady", "SCENE", "--set", f"{wheel}.inertia={inertia!r} kg*m2")), (("flywheel", inertia),))


EFFECT_WORDS = {"joint friction": "joint_friction", "flexible rod": "flexible_rod", "electrical transients": "transients",
                "gear losses": "gear_losses", "bearing friction": "bearing_friction", "backlash": "backlash",
                "joint clearance": "joint_clearance", "relaxation": "relaxation", "mesh variation": "mesh_variation",
                "elasticity": "elasticity", "rigid": "none"}


def effects_of_forces(forces):
    """The words and the option's value for the effects of the motion that `forces` is of; None: none."""
    said = re.search(r"steady motion of the machine \((.*?)\), crank's cycle", (forces or {}).get("simulated", {}).get("description", ""))
    if not said:
        return None
    parts = re.split(r", | and ", said.group(1))
    option = []
    for part in parts:
        words = part.removeprefix("elasticity of ")
        if words != part or words not in EFFECT_WORDS:
            option.append(f"elasticity:{words}")
        else:
            option.append(EFFECT_WORDS[words])
    return "none" if said.group(1) == "rigid" else said.group(1), ",".join(option)


def as_forces(scene, answers):
    """`steady` with the effects that `forces` has, where it was not asked with them."""
    effects, steady = effects_of_forces(answers.get("forces")), answers.get("steady")
    if effects and steady and effects[0] not in (c["effects"] for c in steady["cycles"]):
        yield Further("steady as forces", scene, golden.Command(("steady", "SCENE", "--effects", effects[1])),
                      (("effects", effects[0]),))


def scene_exists(scene):
    return os.path.isfile(golden.ROOT / scene)
