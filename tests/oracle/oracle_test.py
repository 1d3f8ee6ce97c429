"""scripts/oracle --check: is a falsified sentence found, and nothing where words and motion agree?"""
import copy
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import machines  # noqa: E402
from judge import judge  # noqa: E402


def motion(**changes):
    return {"cycle": 6.2831853, "usual_speed": 30.0, "usual_torque": 20.0, "until": 10.0, "begins": "at rest", "moves": True, "end": "forwards",
            "speed_at_end": 30.0, "held_at_end": False, "fastest": 31.0, "rests_since": 10.0, "driven_at_end": True, "drives_at_end": True,
            "drive_at_end": 12.0, "load_at_end": -12.0, "drives_until": 10.0, "pushed_at_end": False, "falls": False,
            "does_not_start": False, "stalls": False, "turns_back": False, "no_round": False, "rounds": 40, "angle_gained": 250.0,
            "switched_last": 0.0, "drive_switched_last": 0.0, "laps": 40, "steady": "yes", "drift": 1e-6, "period": 1, "mean_speed": 30.0, "least_speed": 29.0,
            "greatest_speed": 31.0, "stands_within": 0.0, "run_up": 1.0, "run_up_earliest": 1.0, "run_up_latest": 1.0,
            "fastest_late": abs(changes.get("speed_at_end", 30.0)), "to_and_fro": 1.0, **changes}


def contact(kind="clutch", **changes):
    return {"component": "clutch", "kind": kind, "capacity": 100.0, "usual_speed": 30.0, "open": 0.0, "holds": 9.0, "slips": 1.0,
            "times_slipping": 1, "lets_go": 0, "lets_go_at_all": changes.get("lets_go", 0), "engages": 1, "first_let_go": None, "longest": 0.0, "deepest": 0.0,
            "greatest_held_torque": 50.0, "heat": 10.0, "hottest": 10.0, "stopped_within": 0.0, "at_end": "holds", "slips_since": 1.0, "command_at_end": 1.0,
            "slip_at_end": 0.0, "torque_of_last": 50.0, "slips_to_the_end": False, **changes}


def answer(conclusion='"press" runs steadily at 30 rad/s from 1 s on.', truth=None, contacts=(), limits=(), periods=None, figures=None, ratings=(),
           later=None, steady=None, held=(), motors=(), sequence=0, repeats=False, text="", claims=(), torques=None, driven_part=None):
    m = motion(**(truth or {}))
    figures = {"mean_speed.press": 30.0, "final_speed.press": m["speed_at_end"], **(figures or {})}
    periods = {"run_up_end": 1.0, "run_down_begin": None, "standstill": None, "steady": True, **(periods or {})}
    later = {**m, "until": 40.0, "rests_since": 40.0 if m["end"] != "rests" else m["rests_since"], "complete": True, "fastest_shaft": 1.0, "drift_of_motors": 0.0,
             "mean_speed_of_last_tenth": m["speed_at_end"], "mean_speed_before": m["speed_at_end"], **(later or {})}
    return {"scene": "x.toml",
            "truth": {"complete": True, "prescribed": False, "fastest_shaft": 1.0, "two_periods": False, "link": "press", "sequence": sequence, "repeats": repeats, "motion": m, "later": later,
                      "contacts": list(contacts), "motors": list(motors), "limits": list(limits), "held": list(held),
                      "torques": torques or {}, **({"driven_part": driven_part} if driven_part else {})},
            "run": {"complete": True, "conclusion": conclusion, "periods": periods, "model": {"effects": "none"}, "ratings": list(ratings), "text": text,
                    "claims": [{"name": n, "of": of, "text": f'"{of}" {n}'} for n, of in claims],
                    "figures": [{"name": n, "value": v} for n, v in figures.items()], "energy_balance": {"work": {"driving": 100.0}}},
            "steady": steady or {"complete": True, "conclusion": "Steady cycle, rigid: mean speed 30 rad/s.", "cycles": [
                {"found": True, "effects": "none", "figures": [{"name": "mean_speed.press", "value": 30.0}]}]}}


REST = {"end": "rests", "speed_at_end": 0.0, "steady": "no", "held_at_end": True, "rests_since": 5.0, "drive_at_end": 0.0,
        "drives_at_end": False}
NEVER = {**REST, "moves": False, "fastest": 0.0, "rests_since": 0.0}
NOTHING = {"complete": True, "conclusion": "", "cycles": []}
HELD = ['"press" is held at the end by brake: the acting torque is -8.8 N·m; forwards: up to 12 N·m are held, 21 N·m more would move it']
HOT = {"component": "clutch", "what": "heat", "value": 12.0, "limit": 10.0, "unit": "J"}
TELLS = {"component": "clutch", "requirement": "heat of an engagement: W ≤ W_allowable", "value": 12.0, "limit": 10.0, "verdict": "exceeded"}
MOTOR = {"component": "motor", "kind": "induction motor", "rated_torque": 20.0, "rated_speed": 30.0, "torque": 12.0, "speed": 30.0, "command": 1.0,
         "greatest_torque": 50.0, "rms_torque": 12.0, "late_rms_torque": 12.0, "stands": False}

# Class of the finding → an answer that falsifies a sentence, or lacks one.
FALSE = {
    "runs steadily, but rests": answer(truth=REST, steady=NOTHING),
    "runs steadily, but does not": answer(truth={"steady": "no", "drift": 0.2}),
    "runs steadily, but stops or turns back within each period": answer(truth={"stands_within": 0.5, "least_speed": -0.1}),
    "runs steadily, but goes on to another motion": answer(later={"mean_speed_of_last_tenth": 60.0, "steady": "unclear"}),
    "steady speed is another": answer(figures={"mean_speed.press": 33.0}),
    "δ of a motion that stops": answer(figures={"delta.press": 2.063}),
    "two ends of the run-up": answer(text="  run up            0       1.8439   5.0"),
    "two begins of the run-down": answer('"press" runs steadily at 30 rad/s from 1 s on, runs down from 8 s.', periods={"run_down_begin": 8.0},
                                         text="  run down   7.5  10  5.0"),
    "runs down although it is driven": answer(periods={"run_down_begin": 8.0}),
    "run-down with driving work": answer(figures={"work_of_run_down.driving": 3.0}),
    "run-up ends elsewhere": answer(periods={"run_up_end": 3.0}),
    "rests, but does not": answer('"press" is at 30 rad/s after 10 s.', periods={"standstill": 5.0}),
    "comes to rest, but never moved": answer('"press" is at rest after 10 s.', NEVER, periods={"standstill": 5.0}, steady=NOTHING),
    "comes to rest at another time": answer('"press" is at rest after 10 s.', REST, periods={"standstill": 7.0}, steady=NOTHING),
    "at rest, but turns": answer('"press" is at rest after 10 s.'),
    "rests under load, and what holds it is not said": answer('"press" is at rest after 10 s.', REST, held=HELD, steady=NOTHING),
    "does not start, but moves": answer('"press" does not start: its loads hold the 5 N·m that drive it.'),
    "does not start: \"its loads hold\", but others do": answer(
        '"press" does not start: its loads hold the 5 N·m that drive it.', {**NEVER, "does_not_start": True, "pushed_at_end": True},
        contacts=[contact("brake", component="brake")], held=HELD, steady=NOTHING),
    "does not start": answer('"press" is at rest after 10 s.', {**NEVER, "does_not_start": True, "pushed_at_end": True}, steady=NOTHING),
    "stalls, but turns": answer('"press" stalls at 3° after 2 s: the load can hold the 5 N·m.'),
    "stalls, but never moved": answer('"press" stalls at 3° after 2 s: the load can hold the 5 N·m.', NEVER, steady=NOTHING),
    "stalls": answer('"press" is at rest after 10 s.', {**REST, "stalls": True, "pushed_at_end": True}, steady=NOTHING),
    "turns back, but does not": answer('"press" turns backwards, at 3 rad/s at the end.'),
    "falls or turns back": answer('"press" runs steadily at 30 rad/s.', {"falls": True, "end": "backwards", "speed_at_end": -30.0, "steady": "unclear"}),
    "runs away, but settles": answer('"press" runs away: 90 rad/s at the end.'),
    "runs away": answer('"press" is at 60 rad/s after 10 s.', {"speed_at_end": 60.0, "steady": "unclear"}, later={
        "mean_speed_of_last_tenth": 200.0, "mean_speed_before": 90.0}),
    "does not get round, but does": answer('"press" does not complete a cycle: it is at 50° at the end.'),
    "does not get round": answer('"press" is at 0 rad/s after 10 s.', {**REST, "end": "vibrates", "no_round": True, "rounds": 0}, steady=NOTHING),
    "vibrates, but does not": answer('"press" vibrates to the end.', claims=[("vibrates", "press")]),
    "final speed is another": answer('"press" is at 20 rad/s after 10 s.', figures={"final_speed.press": 20.0}),
    "lets go although closed, but was not closed": answer('"clutch" slips twice although it is closed, first at 1 s.',
                                                          contacts=[contact(command_at_end=0.0, holds=0.0, open=10.0, at_end="open")]),
    "lets go although closed, but does not": answer('"clutch" slips twice although it is closed, first at 1 s.', contacts=[contact()]),
    "lets go another number of times": answer('"clutch" slips twice although it is closed, first at 1 s.', contacts=[contact(lets_go=9, deepest=1.0)]),
    "a freewheel that overruns \"slips\"": answer('"clutch" slips to the end, by 3 rad/s.', contacts=[
        contact("one-way clutch", at_end="slips", slips_to_the_end=True, slip_at_end=-3.0)]),
    "slips to the end, but does not": answer('"clutch" slips to the end, by 3 rad/s.', contacts=[contact()]),
    "clutch slips to the end": answer(contacts=[contact(at_end="slips", slips_to_the_end=True, slip_at_end=3.0)]),
    "belt slips to the end": answer(contacts=[contact("belt", at_end="slips", slips_to_the_end=True, slip_at_end=3.0)]),
    "closed clutch slips on the way": answer(contacts=[contact(lets_go=10, deepest=0.5)]),
    "all ratings hold, beside a closed contact that slips": answer(
        '"press" runs steadily at 30 rad/s from 1 s on. All 4 ratings hold. "clutch" slips 10 times although it is closed.',
        contacts=[contact(lets_go=10, deepest=0.5)]),
    "does not stop it, but has": answer('"clutch" does not stop it: it slips at 3 rad/s.', contacts=[contact("brake")]),
    "brake never stops its shaft": answer(repeats=True, sequence=2, contacts=[contact("brake", holds=0.0, open=5.0, times_slipping=4, at_end="open")]),
    "brake is on and the machine turns": answer(contacts=[contact("brake", at_end="slips", slip_at_end=30.0, slips_since=2.0)]),
    "limit exceeded, and not judged": answer(limits=[HOT]),
    "limit holds, but is exceeded": answer(limits=[HOT], ratings=[{**TELLS, "verdict": "holds", "value": 9.0}]),
    "limit exceeded, but is not": answer('A rating is EXCEEDED.', limits=[{**HOT, "value": 5.0}], ratings=[TELLS]),
    "limit exceeded, and not in the conclusion": answer(limits=[HOT], ratings=[TELLS]),
    "reserve of a clutch that never held": answer(figures={"torque_reserve.clutch": 8.65e-8}, contacts=[contact(greatest_held_torque=0.0)]),
    "reserve is another": answer(figures={"torque_reserve.clutch": 3.0}, contacts=[contact()]),
    "at rest, but vibrates": answer('"press" is at rest after 10 s.', {"end": "vibrates", "speed_at_end": 0.3, "steady": "no"}, steady=NOTHING),
    "slips to the end \"that it can transmit\" while it is partly open": answer('"clutch" slips to the end, by 3 rad/s.', contacts=[
        contact(at_end="slips", slips_to_the_end=True, command_at_end=0.3, slip_at_end=3.0)]),
    "value of a limit is another": answer('A rating is EXCEEDED.', limits=[HOT], ratings=[{**TELLS, "value": 20.0}]),
    "does not start, but nothing pushes": answer('"press" does not start: its loads hold the 5 N·m.', NEVER, steady=NOTHING),
    "stops, but never moved": answer('"press" comes to rest at 3 s.', NEVER, steady=NOTHING),
    "stalls: \"the load can hold\", but others do": answer('"press" stalls at 3° after 2 s: the load can hold the 5 N·m.', {
        **REST, "stalls": True, "pushed_at_end": True}, contacts=[contact("brake", component="brake")], held=HELD, steady=NOTHING),
    "stalls, but nothing pushes": answer('"press" stalls at 3° after 2 s: the load can hold the 5 N·m.', REST, steady=NOTHING),
    "steady: a cycle, but it comes to rest": answer('"press" is at 30 rad/s after 10 s.', later={**REST, "rests_since": 30.0}),
    "falls or turns back, told by a sign alone": answer('"press" is at -30 rad/s after 10 s.', {
        "falls": True, "end": "backwards", "speed_at_end": -30.0, "steady": "unclear"}),
    "run-down begins elsewhere": answer(periods={"run_down_begin": 8.0}, driven_part=motion(until=6.0)),
    "a peak torque that the motion does not have": answer(figures={"peak_torque.clutch": 1403.0}, torques={"clutch": 60.0}),
    "a torque greater than the peak that is said": answer(figures={"peak_torque.clutch": 50.0}, torques={"clutch": 60.0}),
    "claim \"does not move\" is false": answer(claims=[("does_not_move", "press")]),
    "claim \"starts\" is false": answer(truth={"begins": "turning"}, claims=[("starts", "press")]),
    "claim \"at rest\" is false": answer(claims=[("at_rest", "press")]),
    "claim \"strokes\" is false": answer(claims=[("works_in_strokes", "press")]),
    "claim \"held by\" is false": answer(claims=[("held_by", "press")]),
    "claim \"engages\" is false": answer(claims=[("clutch_slips_engaging", "clutch")], contacts=[contact(engages=0, slips=0.0)]),
    "claim \"open\" is false": answer(claims=[("clutch_opened_by_command", "clutch")], contacts=[contact()]),
    "claim \"overruns\" is false": answer(claims=[("freewheel_overruns", "clutch")], contacts=[contact("one-way clutch", slips=0.0)]),
    "clutch is open by command": answer(claims=[("runs_steadily", "press")], contacts=[contact(open=3.0)]),
    "clutch slips while it engages": answer(claims=[("runs_steadily", "press")], contacts=[contact()]),
    "freewheel overruns": answer(claims=[("runs_steadily", "press")], contacts=[contact("one-way clutch")]),
    "motor stands under torque": answer(motors=[{**MOTOR, "speed": 0.0, "stands": True}]),
    "does not come up to speed, but has": answer('"motor" does not come up to speed: it stays at 12 rad/s.', motors=[MOTOR]),
    "motor beyond its rated torque in steady motion": answer(motors=[{**MOTOR, "late_rms_torque": 30.0}]),
    "steady: comes to rest, but never moved": answer('"press" is at rest after 10 s.', NEVER, steady={
        "complete": False, "conclusion": "No steady cycle: the machine comes to rest at 377 s and stays there.", "cycles": []}),
    "steady: comes to rest at another time": answer('"press" is at rest after 10 s.', REST, steady={
        "complete": False, "conclusion": "No steady cycle: the machine comes to rest at 9.5 s and stays there.", "cycles": []}),
    "steady: another speed than the run comes to": answer(figures={"mean_speed.press": 30.0}, steady={
        "complete": True, "conclusion": "Steady cycle", "cycles": [
            {"found": True, "effects": "none", "figures": [{"name": "mean_speed.press", "value": 50.0}]}]}),
    "steady: finds no cycle where the run settles": answer(steady={"complete": False, "conclusion": "No cycle.", "cycles": []}),
}
# Beside those, what hides behind a moment: more answers for classes above.
MORE_FALSE = {
    "at rest, but turns": answer('"press" is nearly at rest (0 rad/s) after 10 s.', {"end": "vibrates", "speed_at_end": 0.0, "fastest_late": 5.0},
                                 steady=NOTHING),
    "runs away, but settles": answer('"press" runs away: 60 rad/s at the end.', {"speed_at_end": 60.0, "steady": "unclear"},
                                     later={"mean_speed_of_last_tenth": 160.0, "mean_speed_before": 150.0}),
    "run-up ends elsewhere": answer(periods={"run_up_end": 4.0}, truth={"run_up_latest": 3.0}),
    "runs steadily, but does not": answer(truth={"steady": "no", "laps": 3}, later={"steady": "yes", "mean_speed": 30.2}),
    'claim "held by" is false': answer(motors=[MOTOR], claims=[("held_by", "motor")]),
}
# Said as it is.
TRUE = {
    "run-up with a swing that touches the edge": answer(periods={"run_up_end": 3.0}, truth={"run_up_latest": 3.0}),
    "steady": answer(),
    "three laps, the last one as the longer run": answer(truth={"steady": "no", "laps": 3}, later={"steady": "yes"}),
    "vibrates while it drifts a little": answer('"press" vibrates to the end.', {"steady": "no", "to_and_fro": 0.26}, claims=[("vibrates", "press")],
                                                periods={"steady": False}),
    "stalls before it turns": answer('"press" stalls at 1.3° after 2 s: the load can hold the 5 N·m that drive there.', {
        **REST, "pushed_at_end": True, "load_at_end": -4.0}, held=HELD, steady=NOTHING),
    "an open clutch ends the stroke": answer('"press" goes through its operating sequence and ends at rest.', {**REST, "no_round": True, "rounds": 0},
                                             sequence=3, contacts=[contact(command_at_end=0.0, open=2.0, at_end="open")], steady=NOTHING),
    "a motor held while the machine vibrates": answer('"press" vibrates to the end.', {"end": "vibrates", "steady": "no"}, steady=NOTHING, motors=[
        {**MOTOR, "speed": 0.0, "stands": True}], claims=[("vibrates", "press"), ("held_by", "motor")]),
    "brakes at the end, for less time than before": answer(contacts=[
        contact("brake", at_end="slips", slip_at_end=30.0, slips_since=8.0, stopped_within=2.5)], sequence=3),
    "says that it is not confirmed": answer('NOT confirmed: accuracy 1.0e-06 requested, errors could not be measured.', REST, claims=[
        ("not_confirmed", ""), ("runs_steadily", "press")], steady=NOTHING),
    "rests": answer('"press" is at rest after 10 s.', REST, periods={"standstill": 5.0}, steady=NOTHING),
    "held": answer('"press" is at rest after 10 s: "brake" holds the 8.8 N·m that act.', REST, held=HELD, steady=NOTHING),
    "does not start": answer('"press" does not start: its loads hold the 5 N·m that drive it.', {**NEVER, "does_not_start": True, "pushed_at_end": True},
                             steady=NOTHING),
    "lets go": answer('"press" runs steadily at 30 rad/s from 1 s on. "clutch" slips 10 times although it is closed, first at 1 s.',
                      contacts=[contact(lets_go=10, deepest=0.5)]),
    "lets go for a moment": answer('"press" runs steadily at 30 rad/s from 1 s on. "clutch" slips 10 times although it is closed, first at 1 s.',
                                   contacts=[contact(lets_go=2, lets_go_at_all=10)]),
    "is settled by its drag": answer('"press" is at 60 rad/s after 10 s.', {"speed_at_end": 60.0, "steady": "unclear"},
                                     later={"mean_speed_of_last_tenth": 500.0, "mean_speed_before": 370.0}),
    "the link alone settles": answer(later={"drift_of_motors": 0.02}, steady={
        "complete": False, "conclusion": "No steady cycle (rigid): after 2400 cycles the motion still changes.", "cycles": [
            {"found": False, "label": "rigid", "effects": "none"}]}),
    "another shaft runs away": answer(later={"fastest_shaft": 3.4}, steady={
        "complete": False, "conclusion": "No steady cycle (rigid): it runs away: …", "cycles": [{"found": False, "label": "rigid", "effects": "none"}]}),
    "the elastic machine alone rests": answer(steady={"complete": False, "conclusion": "No steady cycle (elastic): it slows down.", "cycles": [
        {"found": False, "label": "elastic", "effects": "elasticity"}]}),
    "is held when it long stands": answer('"press" is at rest after 10 s.', {**REST, "held_since": 9.0}, later={"held_since": 39.0}, steady={
        "complete": True, "conclusion": "At the end the machine comes to rest at 5 s and stays there", "cycles": []}),
    "creeps to rest": answer('"press" is at rest after 10 s.', {**REST, "held_since": 7.0}, periods={"standstill": 7.0}, steady=NOTHING),
    "swings": answer('"press" vibrates to the end.', {**REST, "end": "vibrates", "falls": True, "speed_at_end": -30.0}, steady=NOTHING,
                     claims=[("vibrates", "press")]),
    "a motor's rating exceeded": answer('3 of 3 ratings EXCEEDED, worst "brake". "press" runs steadily.', motors=[{**MOTOR, "late_rms_torque": 30.0}],
                                        claims=[("runs_steadily", "press"), ("limit_exceeded", "motor")]),
    "exceeded": answer('A rating is EXCEEDED, "clutch".', limits=[HOT], ratings=[TELLS]),
    "falls": answer('"press" turns backwards, at -30 rad/s at the end.', {"falls": True, "end": "backwards", "speed_at_end": -30.0, "steady": "unclear"},
                    periods={"steady": False}),
}


class Sees(unittest.TestCase):
    def test_every_falsified_sentence(self):
        for label, told in [*FALSE.items(), *MORE_FALSE.items()]:
            with self.subTest(label):
                self.assertIn(label, [f.label for f in judge(told)])

    def test_every_class_has_a_falsified_sentence(self):
        source = (Path(__file__).resolve().parent / "judge.py").read_text()
        labels = {label.replace('\\"', '"') for label in re.findall(r'self\.(?:contradiction|omission)\("((?:[^"\\]|\\.)*)"', source)}
        self.assertGreater(len(labels), 40)
        self.assertEqual({label for label in labels if label not in FALSE and not label.endswith(", but ")}, set())

    def test_nothing_where_words_and_motion_agree(self):
        for name, told in TRUE.items():
            with self.subTest(name):
                self.assertEqual(judge(copy.deepcopy(told)), [])


class Machines(unittest.TestCase):
    def test_a_number_has_one_machine(self):
        self.assertEqual(machines.machine("3", 14), machines.machine("3", 14))
        self.assertNotEqual(machines.machine("3", 14).text, machines.machine("3", 15).text)

    def test_all_families_come(self):
        self.assertEqual({machines.machine("1", k).family for k in range(300)}, set(machines.FAMILIES))


if __name__ == "__main__":
    unittest.main()
