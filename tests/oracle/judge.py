"""What is said of a machine held against what it did: contradictions, and severe things that nobody says.

    judge(answer) → [Finding(kind, label, words)]      answer: a line of kurbel_oracle
"""
import tomllib
from dataclasses import dataclass
from pathlib import Path

from told import Told

NEAR = 0.01     # of a speed or torque: further apart is another one
TURNS = 1e-3    # of the usual speed: a shaft turns (classify.h)
CLEARLY = 0.05  # of the time: too late to be rounding
MOST_CYCLES = 6  # of a period (classify.h): as few laps may lead to it
DRIFTS = 0.35   # of the way: gained by what goes to and fro and does not vibrate


@dataclass(frozen=True)
class Finding:
    kind: str   # "contradiction", "omission"
    label: str  # of its class
    words: str  # what is said, and what is true


def differs(a, b, part=NEAR, least=0.0):
    return abs(a - b) > part * max(abs(a), abs(b)) + least


class Judge:
    def __init__(self, answer):
        self.truth, self.run, self.steady = answer["truth"], Told(answer.get("run", {})), Told(answer.get("steady", {}))
        self.answer, self.found = answer, []
        self.motion, self.later = self.truth.get("motion"), self.truth.get("later")

    def contradiction(self, label, words):
        self.found.append(Finding("contradiction", label, words))

    def omission(self, label, words):
        self.found.append(Finding("omission", label, words))

    @property
    def usual(self):
        return self.motion["usual_speed"]

    # Components that hold something at the end, by the engine's own account of what stands.
    def holders(self):
        names = []
        for words in self.truth["held"]:
            part = words.split(" is held at the end by ")[-1].split(":")[0]
            names += [n.strip() for n in part.split(",")]
        return names

    def all(self):
        if not self.motion or not self.truth["complete"] or self.truth["prescribed"]:
            return []
        # A run that says itself that its figures may be anything claims nothing (scripts/oracle counts these).
        if "refused" not in self.answer.get("run", {"refused": 1}) and self.run.summary.get("complete") and not self.run.may_be_anything:
            for rule in (self.steadiness, self.boundaries, self.rest, self.starting, self.stalling, self.turning_back, self.running_away,
                         self.round, self.final_speed, self.contacts, self.brakes, self.limits, self.reserves, self.peaks, self.motors,
                         self.typed):
                rule()
        if "refused" not in self.answer.get("steady", {"refused": 1}):
            self.steady_study()
        return self.found

    # --- run: motion ---

    def steadiness(self):
        if not self.run.says("steady"):
            return
        p, m = self.run.periods, self.motion
        off = p.get("run_down_begin")
        part = self.truth.get("driven_part") if off is not None else m
        if part is None:
            return self.contradiction("runs down although it is driven", f"said: drive off from {off}; a source is on to the end")
        claimed = self.run.value(f"mean_speed.{self.truth['link']}")
        claimed = claimed if claimed is not None else self.run.value(f"mid_speed.{self.truth['link']}")
        if off is None and m["end"] in ("rests", "vibrates"):
            self.contradiction("runs steadily, but " + m["end"], f"speed at the end {m['speed_at_end']:.4g} rad/s")
        elif part["steady"] == "no" and not (part is m and self.comes_later()) and not self.is_flat(part):
            self.contradiction("runs steadily, but does not", f"drift {part['drift']:.3g} between eighths of the time, {part['laps']} laps")
        stands, least, greatest = (part.get(k) or 0 for k in ("stands_within", "least_speed", "greatest_speed"))
        if stands > 0.01 or least <= 0 < greatest:
            self.contradiction("runs steadily, but stops or turns back within each period",
                               f"stands {100 * stands:.0f} % of it, {least:.4g} … {greatest:.4g} rad/s")
        elif claimed is not None and part["steady"] == "yes" and differs(claimed, part["mean_speed"], 0.02):
            self.contradiction("steady speed is another", f"said {claimed:.5g}, sampled {part['mean_speed']:.5g} rad/s")
        l = self.later
        if off is None and l and l["complete"] and not self.truth["sequence"] and l["switched_last"] <= m["until"]:
            if differs(m["speed_at_end"] if not m["cycle"] else m.get("mean_speed", 0), l["mean_speed_of_last_tenth"], 0.03):
                self.contradiction("runs steadily, but goes on to another motion",
                                   f"{m.get('mean_speed', m['speed_at_end']):.5g} rad/s at the end, {l['mean_speed_of_last_tenth']:.5g} after {l['until'] / m['until']:.0f} times the time")
        delta = self.run.value(f"delta.{self.truth['link']}")
        if delta is not None and delta >= 2:
            self.contradiction("δ of a motion that stops", f"δ = {delta:.4g}")

    # Few laps of the time itself show nothing: the last one is already that of the motion to which the machine comes.
    def comes_later(self):
        m, l = self.motion, self.later
        return bool(m["cycle"] and m["laps"] <= MOST_CYCLES and l and l["complete"] and l["steady"] == "yes" and
                    not any(differs(m[k], l[k], NEAR / 2) for k in ("mean_speed", "least_speed", "greatest_speed")))

    # The last tenth of a motion without a cycle is steady by itself, however late the run-up ended.
    def is_flat(self, part):
        return not self.motion["cycle"] and part["greatest_speed"] - part["least_speed"] < TURNS * abs(part["mean_speed"])

    def boundaries(self):
        """One definition of run-up, steady motion and run-down, everywhere."""
        p, until = self.run.periods, self.motion["until"]
        table = self.run.works_table()
        up, down = p.get("run_up_end"), p.get("run_down_begin")
        if up is not None and "run up" in table and differs(up, table["run up"][1], 1e-4):
            self.contradiction("two ends of the run-up", f"said {up:.5g} s, table of works {table['run up'][1]:.5g} s")
        if down is not None and "run down" in table and differs(down, table["run down"][0], 1e-4):
            self.contradiction("two begins of the run-down", f"said {down:.5g} s, table of works {table['run down'][0]:.5g} s")
        driving = self.run.value("work_of_run_down.driving")
        whole = sum(abs(v) for v in (self.run.summary.get("energy_balance", {}).get("work") or {}).values())
        if driving is not None and abs(driving) > 1e-6 * whole:
            self.contradiction("run-down with driving work", f"{driving:.4g} J of {whole:.4g} J turned over")
        part = self.truth.get("driven_part", self.motion) if down is not None else self.motion
        if self.run.says("steady") and part["steady"] == "yes" and "run_up" in part:
            cycle = self.motion["cycle"] / max(abs(part["mean_speed"]), 1e-9) if self.motion["cycle"] else 0
            margin = CLEARLY * until + 1.5 * cycle
            latest = max([part["run_up_latest"], *(ramp for ramp in self.ramps() if not differs(ramp, up or 0, 1e-4))])
            if not part["run_up_earliest"] - margin <= (up or 0) <= latest + margin:
                self.contradiction("run-up ends elsewhere", f"said {up}, sampled {part['run_up']:.4g} s")
        if down is not None and self.truth.get("driven_part") and abs(down - self.truth["driven_part"]["until"]) > 0.001 * until:
            self.contradiction("run-down begins elsewhere", f"said {down:.5g}, the last source is on until {self.truth['driven_part']['until']:.5g} s")

    def ramps(self):
        """When starters of the scene that are on from the start, or from a time, have done their work [s]: no run-up ends before."""
        scene = Path(self.answer.get("scene", ""))
        parts = tomllib.loads(scene.read_text()) if scene.is_file() else {}
        return [sum(float(part.get(key, "0 s").split()[0]) for key in ("start", "ramp", "switch_time"))
                for part in parts.values() if isinstance(part, dict) and {"ramp", "switch_time"} & part.keys()]

    # Neither when it last turned, nor when it is held, nor between them.
    @staticmethod
    def another_rest(at, m):
        held = m["rests_since"] if m.get("held_since") is None else m["held_since"]
        margin = 0.02 * m["until"]
        return not m["rests_since"] - margin <= at <= max(held, m["rests_since"]) + margin

    def rest(self):
        m, p = self.motion, self.run.periods
        at = p.get("standstill")
        if at is not None:
            if m["end"] != "rests" and abs(m["speed_at_end"]) > 2 * TURNS * self.usual:
                self.contradiction("rests, but does not", f"standstill said at {at:.4g} s; {m['end']} at the end")
            elif not m["moves"]:
                self.contradiction("comes to rest, but never moved", f"standstill said at {at:.4g} s")
            elif self.another_rest(at, m):
                self.contradiction("comes to rest at another time", f"said {at:.4g}, sampled {m['rests_since']:.4g} s")
        at_rest = any(w in self.run.conclusion for w in ("is at rest", "ends at rest", "is nearly at rest", "nearly at rest", "comes to rest at"))
        for claim in self.run.typed_of("at_rest"):
            if "comes to rest at" in claim["text"] and m["end"] == "rests" and m["moves"] and self.another_rest(claim["at"], m):
                self.contradiction("comes to rest at another time", f"said {claim['at']:.4g} s, sampled {m['rests_since']:.4g} s")
        if at_rest and m["fastest_late"] > 0.02 * self.usual:
            self.contradiction("at rest, but turns", f"{m['speed_at_end']:.4g} rad/s at the end, {m['fastest_late']:.4g} shortly before")
        acting = abs(m["load_at_end"]) + (abs(m["drive_at_end"]) if m["pushed_at_end"] else 0)
        if m["end"] == "rests" and m["held_at_end"] and acting > 1e-3 * m["usual_torque"] and self.holders() and \
                not (m["does_not_start"] or m["stalls"] or self.run.says("stalls") or self.braked_by_command()):
            if not any(f'"{h}"' in self.run.conclusion for h in self.holders()):
                self.omission("rests under load, and what holds it is not said",
                              f"{', '.join(self.holders())} holds {m['load_at_end']:.4g} N·m; said: {self.run.sentences[0]}")
        if not m["moves"] and m["end"] == "rests" and not m["does_not_start"] and \
                any(w in self.run.conclusion for w in ("comes to rest", "runs down", "rests at")):
            self.contradiction("stops, but never moved", self.run.sentences[0])

    def starting(self):
        m, r = self.motion, self.run
        if r.says("does not start"):
            if m["moves"]:
                self.contradiction("does not start, but moves", f"fastest {m['fastest']:.4g} of usually {self.usual:.4g} rad/s")
            elif "its loads hold" in r.conclusion and self.held_by_others():
                self.contradiction("does not start: \"its loads hold\", but others do", f"held by {', '.join(self.holders())}")
            elif not m["pushed_at_end"] and not m["drives_at_end"]:
                self.contradiction("does not start, but nothing pushes", f"drive {m['drive_at_end']:.4g} N·m")
        elif m["does_not_start"] and not r.says("held by") and not r.bad_motion:
            self.omission("does not start", f"a source pushes and nothing moves; said: {r.sentences[0]}")

    # Brakes, gears that lock themselves: no load.
    def held_by_others(self):
        kinds = {c["component"]: c["kind"] for c in self.truth["contacts"]}
        holders = self.holders()
        return bool(holders) and all(kinds.get(h) == "brake" or h in ("gear", "worm", "gearbox") for h in holders)

    def stalling(self):
        m, r = self.motion, self.run
        if r.says("stalls"):
            if m["end"] != "rests":
                self.contradiction("stalls, but turns", f"{m['speed_at_end']:.4g} rad/s at the end")
            elif not m["moves"]:
                self.contradiction("stalls, but never moved", r.sentences[0])
            elif not m["pushed_at_end"] and not m["drives_at_end"]:
                self.contradiction("stalls, but nothing pushes", r.sentences[0])
            elif "the load can hold" in r.conclusion and self.held_by_others():
                self.contradiction("stalls: \"the load can hold\", but others do", f"held by {', '.join(self.holders())}")
        elif m["stalls"] and not m["does_not_start"] and not r.bad_motion and not r.says("held by") and not self.braked_by_command():
            self.omission("stalls", f"rests since {m['rests_since']:.4g} s under a source that pushes; said: {r.sentences[0]}")

    # A brake that the sequence put on last: the machine is meant to stand.
    def braked_by_command(self):
        return self.truth["sequence"] and any(c["kind"] == "brake" and c["command_at_end"] > 0 for c in self.truth["contacts"])

    # By an open clutch that the sequence commanded last: what drives does not drive the link.
    def parted_by_command(self):
        return self.truth["sequence"] and any(c["kind"] == "clutch" and c["command_at_end"] <= 0 for c in self.truth["contacts"])

    def turning_back(self):
        m, r = self.motion, self.run
        if r.says("turns back") and not (m["speed_at_end"] < 0 and (m["turns_back"] or m["falls"])):
            self.contradiction("turns back, but does not", f"{m['speed_at_end']:.4g} rad/s at the end")
        negative = any(w in r.conclusion for w in ("backwards", "turns back", "at -", "away: -", "falls"))
        if m["falls"] and (m["end"] == "vibrates" and r.says("vibrates") or "to and fro" in r.conclusion):
            return
        if m["falls"] and not negative:
            self.omission("falls or turns back", f"{m['speed_at_end']:.4g} rad/s at the end, fastest {m['fastest']:.4g}; said: {r.sentences[0]}")
        elif m["falls"] and not (r.says("turns back") or "falls" in r.conclusion or "backwards" in r.conclusion):
            self.omission("falls or turns back, told by a sign alone", f"{m['speed_at_end']:.4g} rad/s at the end; said: {r.sentences[0]}")

    def running_away(self):
        m, l, r = self.motion, self.later, self.run
        if not l or not l["complete"] or l["switched_last"] > m["until"]:
            return
        end, last = abs(m["speed_at_end"]), abs(l["mean_speed_of_last_tenth"])
        before = abs(l["mean_speed_before"])
        grows = last > 1.3 * end and last > 1.3 * before
        fades = last - before < 0.5 * (before - end)  # the gain halves from half to half of the time: drag settles it
        if r.says("runs away") and (not grows or fades):
            self.contradiction("runs away, but settles", f"{end:.4g} rad/s at the end, {last:.4g} after {l['until'] / m['until']:.0f} times the time")
        if grows and not fades and last > 2 * end and last > 3 * self.usual and end > 1.5 * self.usual and not r.says("runs away") and not r.says("turns back") and not self.truth["sequence"] and \
                not (r.says("not steady") or "times the speed of its data" in r.conclusion or m["falls"]):
            self.omission("runs away", f"{end:.4g} rad/s at the end, {last:.4g} after {l['until'] / m['until']:.0f} times the time, usual {self.usual:.4g}; said: {r.sentences[0]}")

    def round(self):
        m, r = self.motion, self.run
        if r.says("no round") and m["rounds"] >= 2:
            self.contradiction("does not get round, but does", f"{m['rounds']:.0f} cycles")
        # From a vibration to a drift there is no sharp border.
        if r.says("vibrates") and m["end"] != "vibrates" and m["to_and_fro"] > DRIFTS:
            self.contradiction("vibrates, but does not", f"{m['end']} at the end, {m['speed_at_end']:.4g} rad/s")
        if m["no_round"] and not r.bad_motion and not r.says("vibrates") and not self.braked_by_command() and not self.parted_by_command() and not m["stalls"]:
            self.omission("does not get round", f"{m['end']} at the end; said: {r.sentences[0]}")
        if m["end"] == "vibrates" and r.says("ends") and "at rest" in r.conclusion and m["fastest"] > 0.05 * self.usual and \
                abs(m["speed_at_end"]) > TURNS * self.usual:
            self.contradiction("at rest, but vibrates", f"{m['speed_at_end']:.4g} rad/s at the end")

    def final_speed(self):
        said = self.run.value(f"final_speed.{self.truth['link']}")
        if said is not None and abs(said - self.motion["speed_at_end"]) > 0.02 * max(self.usual, self.motion["fastest"]):
            self.contradiction("final speed is another", f"said {said:.5g}, sampled {self.motion['speed_at_end']:.5g} rad/s")

    # --- run: contacts, limits ---

    def contacts(self):
        r, severe = self.run, []
        for c in self.truth["contacts"]:
            name, kind = c["component"], c["kind"]
            if kind == "brake":
                continue
            if r.says("lets go", name) and c["lets_go_at_all"] == 0:
                label = "lets go although closed, but was not closed" if c["holds"] == 0 or c["command_at_end"] < 1 else "lets go although closed, but does not"
                self.contradiction(label, f"\"{name}\": held {c['holds']:.3g} s, open {c['open']:.3g} s, slipped {c['times_slipping']} times")
            elif r.says("lets go", name) and r.counts.get(name) and not \
                    c["lets_go"] - max(1, 0.2 * c["lets_go"]) <= r.counts[name] <= c["lets_go_at_all"] + max(1, 0.2 * c["lets_go_at_all"]):
                self.contradiction("lets go another number of times",
                                   f"\"{name}\": said {r.counts[name]}, sampled {c['lets_go']} … {c['lets_go_at_all']}")
            if r.says("slips to the end", name):
                if kind == "one-way clutch":
                    self.contradiction("a freewheel that overruns \"slips\"", f"\"{name}\" runs ahead by {c['slip_at_end']:.4g} rad/s")
                elif not c["slips_to_the_end"] and c["at_end"] != "slips":
                    self.contradiction("slips to the end, but does not", f"\"{name}\" {c['at_end']} at the end")
                elif c["command_at_end"] < 1:
                    self.contradiction("slips to the end \"that it can transmit\" while it is partly open", f"\"{name}\" is told {c['command_at_end']:.3g}")
            if kind == "one-way clutch":
                continue
            slips = r.mentions(name, "slip")
            if c["slips_to_the_end"] and c["torque_of_last"] > 1e-3 * self.motion["usual_torque"]:
                severe.append(name)
                if not slips:
                    self.omission(f"{kind} slips to the end", f"\"{name}\" by {c['slip_at_end']:.4g} rad/s since {c['slips_since']:.4g} s; said: {r.conclusion[:160]}")
            elif c["lets_go"] >= 1 and c["deepest"] > 0.1:
                severe.append(name)
                if not slips:
                    self.omission(f"closed {kind} slips on the way", f"\"{name}\" {c['lets_go']} times, up to {c['deepest']:.3g} rad; said: {r.conclusion[:160]}")
        if severe and any(w in r.conclusion for w in (" ratings hold", "Its rating holds", "its rating holds")):
            self.contradiction("all ratings hold, beside a closed contact that slips", ", ".join(severe))

    def brakes(self):
        r, m = self.run, self.motion
        for c in self.truth["contacts"]:
            name = c["component"]
            if c["kind"] != "brake":
                continue
            said = r.says("brake too weak", name) or r.says("brake not done", name)
            turns = c["at_end"] == "slips" and abs(c["slip_at_end"]) > TURNS * c["usual_speed"]
            if said and not turns and c["holds"] > 0:
                self.contradiction("does not stop it, but has", f"\"{name}\" {c['at_end']} at the end")
            if self.truth["repeats"] and c["times_slipping"] > 1 and c["holds"] == 0 and c["open"] > 0 and not r.mentions(name):
                self.omission("brake never stops its shaft", f"\"{name}\" slips {c['times_slipping']} times and never holds; said: {r.sentences[0]}")
            # A brake that has stopped the machine before may take as long again.
            as_before = max(CLEARLY * m["until"], c["stopped_within"])
            if turns and not said and c["command_at_end"] > 0 and m["until"] - c["slips_since"] > as_before and not r.mentions(name):
                self.omission("brake is on and the machine turns", f"\"{name}\" slips at {c['slip_at_end']:.4g} rad/s since {c['slips_since']:.4g} s; said: {r.sentences[0]}")

    WORDS = {"heat": "heat of an engagement", "heat power": "mean heat power", "tension": "strand force", "reserve": "reserve against slip",
             "maximum torque": "maximum torque", "shear stress": "shear stress", "rim speed": "rim speed", "rim stress": "hoop stress"}

    def limits(self):
        for limit in self.truth["limits"]:
            head = self.WORDS.get(limit["what"])
            if not head:
                continue
            told = next((v for v in self.run.ratings if v["component"] == limit["component"] and v["requirement"].startswith(head)), None)
            use = limit["value"] / limit["limit"]
            what = f"\"{limit['component']}\", {limit['what']}: sampled {100 * use:.0f} % of {limit['limit']:.4g} {limit['unit']}"
            if not told:
                if use > 1.01:
                    self.omission("limit exceeded, and not judged", what)
            elif use > 1.01 and told["verdict"] == "holds":
                self.contradiction("limit holds, but is exceeded", f"{what}; said {told['value']:.4g}")
            elif use < 0.9 and told["verdict"] == "exceeded" and not told.get("bound"):
                self.contradiction("limit exceeded, but is not", f"{what}; said {told['value']:.4g}")
            elif use > 1.01 and "EXCEEDED" not in self.run.conclusion:
                self.omission("limit exceeded, and not in the conclusion", what)
            elif told and not told.get("bound") and differs(told["value"], limit["value"], 0.05) and told["verdict"] != "undecided" and \
                    limit["what"] in ("heat", "heat power", "rim speed"):
                self.contradiction("value of a limit is another", f"{what}; said {told['value']:.5g}, sampled {limit['value']:.5g}")

    def reserves(self):
        for c in self.truth["contacts"]:
            said = self.run.value(f"torque_reserve.{c['component']}")
            if said is None or c["kind"] not in ("clutch", "torque limiter"):
                continue
            if c["greatest_held_torque"] <= 0:
                self.contradiction("reserve of a clutch that never held", f"\"{c['component']}\" torque_reserve = {said:.4g}")
            elif c["capacity"] and said > 0 and c["lets_go"] == 0 and differs(said, c["capacity"] / c["greatest_held_torque"], 0.05):
                self.contradiction("reserve is another", f"\"{c['component']}\" said {said:.4g}, sampled {c['capacity'] / c['greatest_held_torque']:.4g}")

    def peaks(self):
        for of, sampled in self.truth.get("torques", {}).items():
            said = self.run.value(f"peak_torque.{of}")
            if said is None:
                continue
            least = 1e-3 * self.motion["usual_torque"]
            at = (self.run.figure(f"peak_torque.{of}").get("at"))
            if abs(said) > 1.3 * sampled + least:
                self.contradiction("a peak torque that the motion does not have",
                                   f"\"{of}\" said {said:.5g} N·m at {at} s, sampled {sampled:.5g}")
            elif abs(said) < 0.95 * sampled - least:
                self.contradiction("a torque greater than the peak that is said", f"\"{of}\" said {said:.5g} N·m, sampled {sampled:.5g}")

    def typed(self):
        """Claims that no sentence had before they were typed."""
        m, r = self.motion, self.run
        contacts = {c["component"]: c for c in self.truth["contacts"]}
        for name, wrong in (("does not move", m["moves"]), ("starts", m["begins"] != "at rest" or not m["moves"]),
                            ("at rest", m["end"] != "rests" and abs(m["speed_at_end"]) > 0.02 * self.usual),
                            ("strokes", not ((m.get("stands_within") or 0) > 0 or (m.get("least_speed") or 0) <= 0)),
                            ("held by", m["end"] not in ("rests", "vibrates") and abs(m["speed_at_end"]) > NEAR * self.usual)):
            if r.says(name, self.truth["link"] if name == "held by" else None) and wrong:
                self.contradiction(f"claim \"{name}\" is false", f"{m['end']} at the end, moves: {m['moves']}, begins {m['begins']}")
        for motor in self.truth["motors"]:
            if r.says("held by", motor["component"]) and motor["component"] != self.truth["link"] and abs(motor["speed"]) > 0.01 * motor["rated_speed"]:
                self.contradiction("claim \"held by\" is false", f"\"{motor['component']}\" turns at {motor['speed']:.4g} rad/s")
        for name, holds in (("engages", lambda c: c["engages"] > 0 or c["slips"] > 0), ("open", lambda c: c["open"] > 0),
                            ("overruns", lambda c: c["kind"] == "one-way clutch" and c["slips"] > 0)):
            for component in r.claims.get(name, ()):
                if component in contacts and not holds(contacts[component]):
                    self.contradiction(f"claim \"{name}\" is false", f"\"{component}\"")
        if not r.typed:
            return
        for c in self.truth["contacts"]:
            if c["kind"] == "clutch" and c["open"] > 0 and not r.says("open", c["component"]):
                self.omission("clutch is open by command", f"\"{c['component']}\" {c['open']:.3g} s")
            if c["kind"] == "clutch" and c["engages"] > 0 and not r.mentions(c["component"], "slip"):
                self.omission("clutch slips while it engages", f"\"{c['component']}\" {c['engages']} times")
            if c["kind"] == "one-way clutch" and c["times_slipping"] > 0 and not r.says("overruns", c["component"]):
                self.omission("freewheel overruns", f"\"{c['component']}\" {c['times_slipping']} times")

    def motors(self):
        m, r = self.motion, self.run
        for motor in self.truth["motors"]:
            name = motor["component"]
            if motor["stands"] and abs(motor["torque"]) > 0.1 * motor["rated_torque"] and not r.bad_motion and not r.says("held by") and not self.braked_by_command():
                self.omission("motor stands under torque", f"\"{name}\" gives {motor['torque']:.4g} N·m (rated {motor['rated_torque']:.4g}) at rest; said: {r.sentences[0]}")
            if motor["kind"] == "induction motor" and r.says("hangs", name) and motor["speed"] > 0.9 * motor["rated_speed"]:
                self.contradiction("does not come up to speed, but has", f"\"{name}\" {motor['speed']:.4g} of {motor['rated_speed']:.4g} rad/s")
            hot = motor["late_rms_torque"] > 1.05 * motor["rated_torque"] > 0
            if hot and m["steady"] == "yes" and motor["command"] != 0 and not r.mentions(name, "hot", "EXCEEDED", "hangs", "stands", "stalls", "does not start") and \
                    not r.typed_of("limit_exceeded", name) and not r.typed_of("not_assessed", name):
                self.omission("motor beyond its rated torque in steady motion",
                              f"\"{name}\" RMS {motor['late_rms_torque']:.4g} of {motor['rated_torque']:.4g} N·m in the last eighths; said: {r.conclusion[:200]}")

    # --- steady ---

    def steady_study(self):
        s, l, m = self.steady, self.later, self.motion
        rests = s.time_of(r"(?:comes to rest at|below 0\.1 % of its rated speed from) TIME")
        # The time is that of the machine with all effects of the study (At the end …), or of the one that found no cycle.
        asked = s.summary.get("cycles", ())
        of = next((c for c in asked if f"({c.get('label')})" in s.conclusion), None) if "No steady cycle (" in s.conclusion else \
            asked[-1] if asked else None
        same = not of or of.get("effects") == self.run.summary.get("model", {}).get("effects")
        if rests is not None and same:
            where = l if l and l["complete"] and (l["moves"] or not m["moves"]) else m
            if not where["moves"]:
                self.contradiction("steady: comes to rest, but never moved", f"said at {rests:.4g} s")
            elif where["end"] == "rests" and self.another_rest(rests, where) and not self.truth["sequence"]:
                self.contradiction("steady: comes to rest at another time", f"said {rests:.4g}, sampled {where['rests_since']:.4g} s")
        if not l or not l["complete"] or self.truth["sequence"] or l["drive_switched_last"] > 0:
            return
        cycles = [c for c in s.summary.get("cycles", ()) if c.get("found")]
        cycle = cycles[-1] if cycles and cycles[-1].get("effects") == self.run.summary.get("model", {}).get("effects") else None
        if cycle and l["steady"] == "yes" and "At the end" not in s.conclusion:
            mean = next((f["value"] for f in cycle["figures"] if f["name"] == f"mean_speed.{self.truth['link']}"), None)
            if mean is not None and differs(mean, l["mean_speed"], 0.02):
                self.contradiction("steady: another speed than the run comes to", f"said {mean:.5g}, sampled {l['mean_speed']:.5g} rad/s")
        if cycle and s.summary.get("complete", True) and l["end"] == "rests" and "At the end" not in s.conclusion:
            mean = next((f["value"] for f in cycle["figures"] if f["name"] == f"mean_speed.{self.truth['link']}"), None)
            if mean is not None and abs(mean) > 0.01 * self.usual:
                self.contradiction("steady: a cycle, but it comes to rest", f"said {mean:.5g} rad/s; rests since {l['rests_since']:.4g} s; {s.conclusion[:120]}")
        own = [c for c in asked if c.get("effects") == self.run.summary.get("model", {}).get("effects")]
        # Another shaft than the link runs away, or another machine than the run's comes to no steady motion.
        another = "runs away" in s.conclusion and l["fastest_shaft"] > 1.3 * max(1, self.truth["fastest_shaft"]) or \
            (asked and not any(not c.get("found") for c in own))
        another = another or l["drift_of_motors"] > NEAR / 2  # the link alone has settled
        no_period = "no common period" in s.conclusion and self.truth["two_periods"]
        if not s.summary.get("complete", True) and l["steady"] == "yes" and abs(l["mean_speed"]) > 0.01 * self.usual and not another and not no_period:
            self.contradiction("steady: finds no cycle where the run settles", f"{s.conclusion[:200]}; sampled {l['mean_speed']:.5g} rad/s")


def judge(answer):
    if "refused" in answer["truth"]:
        return []
    return Judge(answer).all()
