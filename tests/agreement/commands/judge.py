"""What the commands say of one scene, judged: contradictions, values without errors, refusals with their reasons."""
import re
from dataclasses import dataclass, field

import pairs
from pairs import Same, Words

# |a − b| ≤ FACTOR (e_a + e_b) and what rounding may be: last bits of the value, and of what it is nothing beside.
FACTOR = 1
LAST_BITS = 1e-9
NOTHING = 1e-10
WITHOUT_ERROR = 1e-6  # of the value, where one side states no error: listed apart

# What a command finds nothing to be asked about; not a refusal.
NOT_ASKED = [(re.compile(p), words) for p, words in (
    (r"nothing is elastic, so the drive has no modes", "modes: nothing is elastic"),
    (r"forces are found in the joints of mechanisms", "forces: no mechanism"),
    (r"parameters for no effect", "effects, advise: no effect to be switched"),
    (r"no gearbox stage has its module given", "gears: no stage is given by its module"),
)]


@dataclass
class Told:
    """The answers to all questions of one scene, by command."""
    scene: str
    cells: dict = field(default_factory=dict)   # {command: answer}
    about: dict = field(default_factory=dict)   # {command: what a further question was made from}

    @property
    def answers(self):
        return {c: self.get(c) for c in self.cells}

    def get(self, command):
        """The summary of what is complete; one of `steady` that finds no cycle says why, and is complete."""
        answer = self.cells.get(command)
        summary = answer and answer.get("exit") in (0, 3) and answer.get("summary")
        return summary if summary and (summary.get("complete", True) or command.startswith("steady")) else None

    def whole(self, command):
        return self.cells.get(command)

    def said(self, command):
        answer = self.cells.get(command)
        return answer["stdout"] if answer and answer.get("exit") == 0 else None

    def complaint(self, command):
        answer = self.cells.get(command)
        return answer["stderr"] if answer and answer.get("exit") not in (0, None) else None

    def further(self, begin):
        for command in self.cells:
            if command.startswith(begin) and (summary := self.get(command)):
                yield command, summary, self.about[command]


@dataclass(frozen=True)
class Contradiction:
    pair: str
    same: Same | Words
    share: float  # of what is allowed

    def __str__(self):
        s = self.same
        if isinstance(s, Words):
            return f"{s.what}\n    {s.a}\n    {s.b}"
        return (f"{s.figure}: {shown(s.a)} | {shown(s.b)}  ({self.share:.3g} × what is allowed, {relative(s):.2g} of the value)\n"
                f"    {s.a.where} | {s.b.where}")


def shown(v):
    return f"{v.value:.12g}" + (f" ± {v.error:.2g}" if v.error is not None else "")


def relative(s):
    return abs(s.a.value - s.b.value) / max(abs(s.a.value), abs(s.b.value), 1e-300)


def share(s, factor=FACTOR):
    """|a − b| over what is allowed."""
    apart, larger = abs(s.a.value - s.b.value), max(abs(s.a.value), abs(s.b.value))
    bits = LAST_BITS if s.a.error is not None and s.b.error is not None else WITHOUT_ERROR
    allowed = factor * ((s.a.error or 0) + (s.b.error or 0)) + bits * larger + NOTHING * max(s.a.scale, s.b.scale)
    return apart / allowed if allowed > 0 else (0 if apart == 0 else float("inf"))


@dataclass
class Judged:
    scene: str
    compared: dict = field(default_factory=dict)        # {pair: number of values and words}
    contradictions: list = field(default_factory=list)
    without_error: list = field(default_factory=list)   # beyond WITHOUT_ERROR
    number_without: int = 0
    refused: list = field(default_factory=list)         # (command, reason)
    not_asked: list = field(default_factory=list)       # (command, reason)
    skipped: list = field(default_factory=list)         # commands
    answered: int = 0


def reason_of(answer):
    """What a program said that ended with 2 or 3, without names and numbers."""
    diagnosis = (answer.get("summary") or {}).get("diagnosis") or (answer.get("summary") or {}).get("conclusion") if answer["exit"] == 3 else None
    text = answer["stderr"].strip().splitlines()
    words = diagnosis or (text[-1] if text else "")
    words = re.sub(r"^(kurbel: )?(\S+\.toml(:\d+)*: )?", "", words)
    words = re.sub(r'"[^"]*"', '"…"', words)
    words = re.sub(r"[-−]?\d+(\.\d+)?(e[-+]?\d+)?", "#", words)
    return re.split(r"; |\. |: (?=at |\")", words)[0][:180].strip()


def judge(told, factor=FACTOR):
    judged = Judged(told.scene)
    for command, answer in told.cells.items():
        if "cut" in answer:
            judged.skipped.append(command)
        elif answer["exit"] == 0:
            judged.answered += 1
        elif answer["exit"] not in (2, 3) or not reason_of(answer):
            judged.contradictions.append(Contradiction("refusals", Words(
                f"{command} ends with {answer['exit']}", "a refusal has a reason, and ends with 2 or 3", answer["stderr"][-300:], False), float("inf")))
        else:
            whole = answer["stderr"] + answer["stdout"]
            known = next((words for pattern, words in NOT_ASKED if answer["exit"] == 2 and pattern.search(whole)), None)
            (judged.not_asked if known else judged.refused).append((command, known or reason_of(answer)))
    for pair in pairs.PAIRS:
        number = 0
        for same in pair(told):
            number += 1
            if isinstance(same, Words):
                if not same.agree:
                    judged.contradictions.append(Contradiction(pair.__name__, same, float("inf")))
                continue
            times, known = share(same, factor), same.a.error is not None and same.b.error is not None
            judged.number_without += not known
            if times > 1:
                (judged.contradictions if known else judged.without_error).append(Contradiction(pair.__name__, same, times))
        judged.compared[pair.__name__] = number
    return judged
