"""The digest that is committed: summaries of a few cheap cells, so that a change of results cannot land unseen."""
import json
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from cells import COMMANDS, FORM, Cell, cells_of, run_cell
from compare import EFFORT, LEFT_OUT, compare_cells

# Every command, and scenes that have between them every mechanism and kind of drive; together ≤ 60 s, ≤ 1 MB.
CHOSEN = {
    "check": ("crank_press", "genset"),
    "figures": ("crank_press", "planetary_brake", "six_inertia_chain"),
    "run --explain": ("crank_press", "gear_pair", "drive_axle", "six_inertia_chain"),
    "run": ("scenes/*", "star_delta", "two_axis_motor", "armature_voltage_ramp", "belt_rigid_slips", "at_rest", "knuckle_small"),
    "compare": ("crank_press", "planetary_brake"),
    "steady": ("crank_press", "piston_pump", "six_inertia_chain", "gear_pair", "genset", "dc_hoist",
               "two_axis_motor", "worm_losses_shaft", "sine_and_crank", "belt_slips", "planetary_held"),
    "modes": ("four_bar_rocker", "six_inertia_chain", "piston_pump", "torque_by_table", "housing_support_fan", "damper_tuned"),
    "forces": ("crank_press", "four_bar_rocker"),
    "size": ("crank_press", "four_bar_rocker", "knuckle_small", "two_axis_motor", "dc_hoist"),
    "reduce": ("crank_press", "four_bar_rocker", "piston_pump", "shaper", "worm_losses_shaft"),
    "gears": ("gear_pair", "gear_test_rig", "crank_press"),
    "effects": ("four_bar_rocker", "planetary_brake", "screw_jack"),
    "advise": ("planetary_brake", "screw_jack"),
    "sweep": ("crank_press",),
    "sweep --of steady": ("crank_press",),
    "diff": ("crank_press",),
}
DEAR = {"four_cylinder_engine", "gear_test_rig", "ship_propulsion", "flexible_rod"}  # not run: 1 … 3 s each
SLOW = 300     # s of processor time after which a cell is given up; instrumented programs take long
LONG = 6       # items of a list without names that are kept: the first ones
# Digests are held on other CPUs: measured without FMA, values moved by up to some 1e-11 of the largest of their unit where
# stated errors were 1e-12. Whatever errors state, so much is nothing.
NOTHING = 1e-10
ORDER = re.compile(r"(speed|torque)_order(_phase)?\.")  # figures that stand in the list of orders, too
DIGITS = 12    # of a value: LAST_BITS stays far above what is cut off


def shortened(node):
    """Without what is not compared, in fewer digits; long lists by their first items and their length."""
    if isinstance(node, dict):
        return {key: shortened(value) for key, value in node.items() if key not in LEFT_OUT | EFFORT}
    if isinstance(node, list):
        node = [x for x in node if not (isinstance(x, dict) and ORDER.match(str(x.get("name"))))]
        nameless = not all(isinstance(x, dict) and "name" in x for x in node)
        kept = [shortened(x) for x in (node[:LONG] if nameless else node)]
        return kept + ([f"{len(node)} items"] if len(kept) < len(node) else [])
    return float(f"{node:.{DIGITS}g}") if isinstance(node, float) else node


def in_short(answer):
    if "cut" in answer:
        return {"exit": f"over {answer['cut']} s"}
    short = {"exit": answer["exit"], "stderr": answer["stderr"], "summary": shortened(answer["summary"])}
    return short if answer["summary"] else {**short, "stdout": answer["stdout"]}


def answers(program, cells, jobs, say):
    with ThreadPoolExecutor(jobs) as pool:
        found = dict(zip(cells, pool.map(lambda cell: run_cell(program, cell, SLOW), cells)))
    for cell, answer in found.items():
        say(f"{cell.name}: {answer['seconds']:.2f} s")
    return {c: in_short(a) for c, a in found.items()}, sum(a["seconds"] for a in found.values())


def write(file, program, jobs, say):
    chosen = [cell for command, scenes in CHOSEN.items() for cell in cells_of([command], scenes)
              if command != "run" or Path(cell.scene).stem not in DEAR]
    found, spent = answers(program, chosen, jobs, say)
    lines = [f" {json.dumps(c.name)}: {json.dumps({'command': c.command, 'scene': c.scene, **a}, ensure_ascii=False, separators=(',', ':'))}"
             for c, a in found.items()]
    file.write_text('{"form": %d, "cells": {\n%s\n}}\n' % (FORM, ",\n".join(lines)))
    return file.stat().st_size, spent


def compare(file, program, jobs, say):
    """[(cell, outcome)] of all cells of the digest."""
    kept = {Cell(a["command"], a["scene"]): a for a in json.loads(file.read_text())["cells"].values()}
    found, spent = answers(program, list(kept), jobs, say)
    return [(cell, compare_cells(a, found[cell], COMMANDS[cell.command].left_out, tables=False, nothing=NOTHING)) for cell, a in kept.items()], spent
