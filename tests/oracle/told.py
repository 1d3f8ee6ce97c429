"""What a summary says of a machine, as facts: from typed claims where it has them, else from the sentences of its conclusion."""
import re

NUMBER = r"[-−+]?[\d.]+(?:e[-+]?\d+)?"
TIMES = {"once": 1, "twice": 2}
FACTORS = {"µs": 1e-6, "ms": 1e-3, "s": 1, "min": 60, "h": 3600}
TIME = rf"({NUMBER}) (µs|ms|s|min|h)\b"

# Name of what is said, and the sentence that says it; the first group is the component.
SENTENCES = {
    "jams": r'"([^"]+)" jams at ',
    "stalls": r'"([^"]+)" stalls at ',
    "does not start": r'"([^"]+)" does not start',
    "turns back": r'"([^"]+)" turns backwards',
    "runs away": r'"([^"]+)" runs away',
    "hangs": r'"([^"]+)" does not come up to speed',
    "no round": r'"([^"]+)" does not complete a cycle',
    "slips to the end": r'"([^"]+)" slips to the end',
    "brake too weak": r'"([^"]+)" does not stop it',
    "brake not done": r'"([^"]+)" has not stopped it by the end',
    "lets go": r'"([^"]+)" slips (once|twice|\d+ times) although it is closed',
    "slips at times": r'"([^"]+)" slips (once|twice|\d+ times), first',
    "steady": r'"([^"]+)" runs steadily at ',
    "sequence done": r'"([^"]+)" goes through its operating sequence',
    "not steady": r'"([^"]+)" has not reached a steady motion',
    "ends": r'"([^"]+)" (is at rest|is nearly at rest|is at |comes to rest at |moves at )',
    "too hot": r'"([^"]+)" gets too hot',
}
# The same of typed claims (docs/claims.md).
PREDICATES = {
    "jams": "jams", "stalls": "stalls", "does_not_start": "does not start", "turns_back": "turns back", "runs_away": "runs away", "hangs_below_breakdown": "hangs", "starter_waits": "starter waits",
    "does_not_get_round": "no round", "slips_to_the_end": "slips to the end", "brake_does_not_stop": "brake too weak",
    "brake_has_not_stopped": "brake not done", "clutch_slips_closed": "lets go", "limiter_slips": "lets go", "belt_slips": "slips at times",
    "runs_steadily": "steady", "goes_through_sequence": "sequence done", "not_steady_yet": "not steady", "at_rest": "at rest", "moves": "ends",
    "motor_overloaded": "too hot", "held_by": "held by", "works_in_strokes": "strokes", "does_not_move": "does not move", "starts": "starts",
    "vibrates": "vibrates", "clutch_slips_engaging": "engages", "clutch_opened_by_command": "open", "freewheel_overruns": "overruns",
}
# What shows that the machine's motion is not what it should be.
BAD_MOTION = ("jams", "stalls", "does not start", "turns back", "runs away", "hangs", "no round", "slips to the end", "brake too weak",
              "brake not done")


class Told:
    def __init__(self, summary):
        self.summary = summary
        self.conclusion = summary.get("conclusion", "").replace("−", "-")
        self.text = summary.get("text", "")
        self.claims = {}  # name → list of components
        self.typed = summary.get("claims") or []
        for claim in self.typed:
            self.claims.setdefault(PREDICATES.get(claim["name"], claim["name"]), []).append(claim["of"])
        for name, pattern in SENTENCES.items() if not self.typed else ():
            found = re.findall(pattern, self.conclusion)
            if found:
                self.claims[name] = [f[0] if isinstance(f, tuple) else f for f in found]
        self.counts = {c: TIMES.get(n) or int(n.split()[0]) for c, n in
                       re.findall(r'"([^"]+)" slips (once|twice|\d+ times)', self.conclusion)}

    def says(self, name, component=None):
        return name in self.claims and (component is None or component in self.claims[name])

    @property
    def bad_motion(self):
        return [name for name in BAD_MOTION if name in self.claims]

    @property
    def may_be_anything(self):
        """By its own words not confirmed, and by errors that are unknown or as large as the figures."""
        measured = (self.summary.get("accuracy") or {}).get("measured")
        return self.says("not_confirmed") and (measured is None or measured > 0.1)

    def mentions(self, component, *words):
        """A sentence of the conclusion names the component with one of these words."""
        return any(f'"{component}"' in s and (not words or any(w in s for w in words)) for s in self.sentences)

    @property
    def sentences(self):
        told = re.split(r"(?<=[a-zA-Z\d)%\"°])\. (?=[\"A-Z\d])", self.conclusion)
        return told + [c["text"].replace("−", "-") for c in self.typed if c["text"] and c["text"] not in self.conclusion]

    def typed_of(self, name, component=None):
        return [c for c in self.typed if c["name"] == name and component in (None, c["of"])]

    def time_of(self, pattern):
        found = re.search(pattern.replace("TIME", TIME), self.conclusion)
        return found and float(found.group(1)) * FACTORS[found.group(2)]

    def figure(self, name):
        return next((f for f in self.summary.get("figures", ()) if f["name"] == name), None)

    def value(self, name):
        f = self.figure(name)
        return f["value"] if f else None

    @property
    def periods(self):
        return self.summary.get("periods") or {}

    @property
    def ratings(self):
        return self.summary.get("ratings") or []

    def works_table(self):
        """{"run up": (from, to), …} of the table of works by periods, which people are shown."""
        rows = re.findall(rf"^\s*(run up|steady motion|run down)\s+({NUMBER})\s+({NUMBER})\s", self.text.replace("−", "-"), re.M)
        return {name: (float(a), float(b)) for name, a, b in rows}
