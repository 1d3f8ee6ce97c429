"""Compares what two programs answered: values within their stated errors, words, exit codes.

A cell is what one command said of one scene: {"exit", "summary", "csv": {name: text}, "stdout", "stderr"}.
"""
import csv
import io
import json
import math
import re
from dataclasses import dataclass, field, replace

# Last bits. Another compiler, another CPU (libm takes other paths with and without FMA) round elsewhere, by some 1e-16 each
# time; an integration of 1e4 … 1e5 steps carries up to some 1e-11 of that on. What is meant to change changes by more.
LAST_BITS = 1e-9
# Of what is of that order beside larger values of the same name: components of a shape that are zero but for rounding.
NOTHING = 1e-12
# Errors are estimates by the difference of two runs, good to an order of magnitude; one that grew beyond it hides changes of
# its value.
ESTIMATE = 10
# Samples for plots state no error: of the column's largest value. On steep flanks last bits of the time show.
SAMPLES = 1e-6
# Where a largest value is reached [rad]: tops are flat, the root of last bits.
PLACE = 1e-5

# Depends on the processor's speed, on the place of files, on the version.
LEFT_OUT = {"version", "scene", "other_scene", "database", "machine", "fingerprint", "processor_seconds", "cpu_seconds",
            "cpu_seconds_all_runs", "seconds", "repetitions", "time_ratio"}
# Work of the numerics: listed separately, and no result.
EFFORT = {"statistics"}
# Differences that the numerics leave where there should be none: judged as estimates.
RESIDUALS = re.compile(r"residual|closure$|closure_error$|drift$|^relative$|^measured$|agreement|bodies_against|remaining_to")
NAMES = ("name", "figure", "effects", "effect", "component", "joint", "shaft", "label", "parameter", "path", "model",
         "method", "gearbox", "what", "limit", "finding", "point")
NO_BRACKETS = str.maketrans("[]", "()")
NUMBER = re.compile(r"[-+−]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?")
TIMES = [(re.compile(r"[\d.e+-]+ (?:min|s|ms|µs) of processor time"), "T of processor time"),
         (re.compile(r"costs (?:about the same time|[\d.e+-]+ × the time)"), "costs T × the time"),
         (re.compile(r"; most time is due to [^,;]*, [\d.e+-]+ × the time without it"), ""),
         (re.compile(r"takes [\d.]+( %)? of the time"), "takes T of the time"),
         (re.compile(r"(cycles' worth \([^)]*\)), [\d.e+-]+ (?:min|s|ms)"), r"\1, T"),
         (re.compile(r"kurbel \d+\.\d+\.\d+\S*"), "kurbel VERSION")]


@dataclass
class Leaf:
    value: object
    error: float | None = None  # stated; None: none
    kind: str = "value"         # value, estimate (of an error), residual, effort, words
    scale: float = 0            # largest value of that name in the same cell
    kin: object = None          # what it is like: its unit, that of which it is the error, its record; then the largest of those


@dataclass
class Difference:
    path: str
    a: Leaf | None
    b: Leaf | None
    times: float = math.inf  # of what is allowed
    places: int = 1          # that are like it, of which it is the furthest

    def __str__(self):
        text = f"{self.path}: {told(self.a)} → {told(self.b)}"
        text += f"  ({self.times:.2g} × what the errors allow)" if math.isfinite(self.times) else ""
        return text + (f", furthest of {self.places} of its kind" if self.places > 1 else "")


def gathered(differences):
    """The furthest of each kind of place, furthest kinds first."""
    kinds = {}
    for d in sorted(differences, key=lambda d: -d.times):
        kinds.setdefault(pattern(d.path), []).append(d)
    return [replace(places[0], places=len(places)) for places in kinds.values()]


@dataclass
class Outcome:
    values: int = 0
    within: list = field(default_factory=list)     # not to the bit, but within stated errors
    different: list = field(default_factory=list)
    words: list = field(default_factory=list)      # (where, before, after)
    effort: list = field(default_factory=list)
    rounded: int = 0                               # words that differ in the last digit of a number alone

    def verdict(self):
        if self.different or self.words:
            return "different"
        return "within" if self.within or self.rounded else "identical"


def told(leaf):
    if leaf is None:
        return "missing"
    text = f"{leaf.value:.12g}" if isinstance(leaf.value, float) else json.dumps(leaf.value, ensure_ascii=False)
    return text + (f" ± {leaf.error:.2g}" if leaf.error is not None else "")


# --- leaves of a summary ---

def is_number(x):
    return isinstance(x, (int, float)) and not isinstance(x, bool)


def stated_error(record, key):
    """The error that a record states of one of its numbers, by the names that docs/summary.schema.json has."""
    of_all = record.get("error")
    if key + "_error" in record:
        return record[key + "_error"]
    if key in ("least_speed", "greatest_speed"):
        return record.get("speed_extremes_error")
    if key in ("least_share", "greatest_share"):
        return record.get("share_extremes_error")
    if key in ("work_in", "work_useful", "work_harmful"):
        return record.get("works_error")
    if key in ("least", "mean", "greatest", "deviation") and "largest_error" in record:
        return record["largest_error"]
    if not is_number(of_all):
        return None
    for base in ("full", "elastic", "off"):  # the error is that of the change over this one
        if base in record and key in ("full", "without", "elastic", "rigid", "off", "on"):
            return of_all * abs(record[base]) if is_number(record[base]) else None
    if key == "phi":
        return PLACE
    if key == "omega" and "frequency" in record:
        return 2 * math.pi * of_all
    if key == "phase":
        return min(math.pi, of_all / abs(record["amplitude"])) if record.get("amplitude") else math.pi
    if key == "amplitude":
        return of_all if "phase" in record else None
    if "t" in record:  # an event: of its time
        return of_all if key == "t" else None
    if key in ("value", "work", "relative", "change", "shift", "deviation", "real", "imaginary", "magnitude", "frequency",
               "natural_frequency", "time", "order"):
        return of_all
    return None


def kind_of(key, above, error):
    if above == "effort" or key in EFFORT:
        return "effort"
    if above == "estimate" or key in ("error", "errors") or key.endswith("_error"):
        return "estimate"
    return "residual" if above == "residual" or error is None and RESIDUALS.search(key) else "value"


def kin_of(record, key, path):
    if isinstance(record.get("unit"), str):
        return "unit " + record["unit"]
    if key.endswith("_error") and key[:-6] in record:
        return "like " + pattern(path[:-6])
    return "in " + without(path) if key == "error" or key.endswith("_error") else "like " + pattern(path)


def labels(items):
    """What the items of a list are called by: their names where they have any, else their numbers."""
    seen = {}
    for number, item in enumerate(items):
        name = next((item[k] for k in NAMES if isinstance(item.get(k), str)), None) if isinstance(item, dict) else None
        if name is None:
            yield str(number)
            continue
        seen[name] = seen.get(name, 0) + 1
        yield name if seen[name] == 1 else f"{name}#{seen[name]}"


def leaves(node, left_out=LEFT_OUT):
    found = {}

    def walk(node, path, kind, error, kin):
        if isinstance(node, dict):
            for key, value in node.items():
                if key not in left_out:
                    stated, place = stated_error(node, key), f"{path}.{key}" if path else key
                    walk(value, place, kind_of(key, kind, stated), stated, kin_of(node, key, place))
        elif isinstance(node, list):
            errors = error if isinstance(error, list) and len(error) == len(node) else [error] * len(node)
            for label, item, one in zip(labels(node), node, errors):
                walk(item, f"{path}[{label}]", kind, one, kin and kin + "[]" * kin.startswith("like "))
        else:
            known = float(error) if is_number(error) and kind == "value" and is_number(node) else None
            found[path] = Leaf(node, known, "words" if isinstance(node, str) and kind != "effort" else kind, kin=kin)

    walk(node, "", "value", None, None)
    return with_scales(found)


def without(path):
    return path.rpartition(".")[0]


def pattern(path):
    """Without the numbers and names of items: what stands at like places."""
    return re.sub(r"\[[^]]*\]", "[]", path)


def with_scales(found):
    scales = {}
    for path, leaf in found.items():
        if is_number(leaf.value) and math.isfinite(leaf.value) and leaf.kind in ("value", "residual"):
            for key in {"like " + pattern(path), "in " + without(path), leaf.kin}:
                scales[key] = max(scales.get(key, 0), abs(leaf.value))
    for path, leaf in found.items():
        leaf.scale, leaf.kin = scales.get("like " + pattern(path), 0), scales.get(leaf.kin, 0)
    return found


# --- judgement of one pair ---

def same(x, y):
    if isinstance(x, float) and isinstance(y, float) and math.isnan(x) and math.isnan(y):
        return True
    return type(x) is type(y) and x == y or is_number(x) and is_number(y) and x == y


def share_of_allowed(a, b, accuracy, nothing):
    """|a − b| over what both sides' errors allow; up to 1: within."""
    if not (is_number(a.value) and is_number(b.value)) or not (math.isfinite(a.value) and math.isfinite(b.value)):
        return math.inf
    apart, larger = abs(a.value - b.value), max(abs(a.value), abs(b.value))
    scale, kin = max(a.scale, b.scale), max(a.kin, b.kin)
    if a.kind in ("estimate", "residual"):
        if apart <= LAST_BITS * (kin if a.kind == "estimate" else max(kin, 1)):
            return 0
        return larger / max(min(abs(a.value), abs(b.value)), LAST_BITS * kin, 1e-300) / ESTIMATE
    stated = [leaf.error for leaf in (a, b) if leaf.error is not None]
    allowed = sum(stated) if stated else max(LAST_BITS * larger, accuracy * scale)
    allowed = max(allowed, nothing * max(larger, kin))
    return apart / allowed if allowed > 0 else math.inf


def numbers_agree(a, b):
    """Texts that are the same but for numbers that differ by one in the last digit written, or within their ±."""
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    def last_digit(text):
        head, _, power = text.partition("e")
        return 10.0 ** (int(power or 0) - len(head.partition(".")[2]))
    found_a, found_b = list(NUMBER.finditer(a)), list(NUMBER.finditer(b))
    for i, (x, y) in enumerate(zip(found_a, found_b)):
        if x.group() == y.group():
            continue
        p, q = (float(m.group().replace("−", "-")) for m in (x, y))
        allowed = max(last_digit(x.group()), last_digit(y.group()), LAST_BITS)
        if re.fullmatch(r" ?± ?", a[x.end():found_a[i + 1].start()] if i + 1 < len(found_a) else ""):
            allowed += float(found_a[i + 1].group()) + float(found_b[i + 1].group())
        elif re.search(r"± ?$", a[:x.start()]):
            allowed += max(abs(p), abs(q)) / ESTIMATE
        if abs(p - q) > 1.0001 * allowed:
            return False
    return True


def masked(text):
    for pattern, put in TIMES:
        text = pattern.sub(put, text)
    return re.sub(r"[ \t]+", " ", text)


def compare_words(outcome, where, a, b, numbers=True):
    """`numbers`: those in the text count; not where they are those of a summary that is compared."""
    a, b = masked(a), masked(b)
    if not numbers:
        a, b = (re.sub(r"[-+#±% ]+", " ", NUMBER.sub("#", text)) for text in (a, b))
    if a == b:
        return
    if numbers_agree(a, b):
        outcome.rounded += 1
        return
    lines_a, lines_b = a.splitlines(), b.splitlines()
    if len(lines_a) == len(lines_b) > 1:
        for x, y in zip(lines_a, lines_b):
            if x != y and not numbers_agree(x, y):
                outcome.words.append((where, x, y))
    else:
        only_a, only_b = [x for x in lines_a if x not in lines_b], [y for y in lines_b if y not in lines_a]
        outcome.words.append((where, "\n".join(only_a[:6]), "\n".join(only_b[:6])))


# --- a cell ---

def stated_accuracy(summary):
    """What the runs of a summary state of all figures, of their scale; 0: nothing."""
    places = [summary, *(summary.get("models") or {}).values()] if isinstance(summary.get("models"), dict) else [summary]
    stated = [(p.get("accuracy") or {}).get("measured") for p in places if isinstance(p.get("accuracy"), dict)]
    return max((x for x in stated if is_number(x)), default=0)


def compare_leaves(outcome, a, b, accuracy, nothing):
    for path in [*a, *(p for p in b if p not in a)]:
        x, y = a.get(path), b.get(path)
        if x and y and x.kind == y.kind == "words":
            compare_words(outcome, path, x.value, y.value)
            continue
        outcome.values += 1
        if x and y and same(x.value, y.value):
            continue
        if (x or y).kind == "effort":
            outcome.effort.append(Difference(path, x, y))
            continue
        times = share_of_allowed(x, y, accuracy, nothing) if x and y else math.inf
        (outcome.within if times <= 1 else outcome.different).append(Difference(path, x, y, times))


def leaves_of_table(name, text, left_out=LEFT_OUT):
    """Column by column, with its errors where the table has a column of them."""
    rows = [row for row in csv.reader(io.StringIO(text)) if row and not row[0].startswith("# ")]
    columns = {}
    for k, heading in enumerate(rows[0] if rows else ()):
        if "processor time" in heading or heading.partition(" [")[0] in left_out:
            continue
        columns[f"{heading}#{k}" if heading in columns else heading] = [value_of(row[k]) if k < len(row) else None for row in rows[1:]]
    found = {}
    for heading, values in columns.items():
        title, _, unit = heading.partition(" [")
        errors = columns.get(f"error of {heading}") or columns.get(title + "_error")
        if title == "phase":  # of an amplitude that is none, it is any
            amplitudes = next(([abs(a or 0) for a in c] for h, c in columns.items() if h.startswith("amplitude")), [])
            errors = [min(math.pi, SAMPLES * max(amplitudes) / max(a, 1e-300)) for a in amplitudes]
        kind = "estimate" if title.startswith("error of ") or title.endswith("_error") else "residual" if RESIDUALS.search(title) else "value"
        for row, value in enumerate(values):
            error = errors[row] if errors and kind == "value" and is_number(value) else None
            found[f"{name}:{heading.translate(NO_BRACKETS)}[{row + 1}]"] = Leaf(
                value, error, "words" if isinstance(value, str) else kind, kin=f"unit {unit}")
    return with_scales(found)


def value_of(cell):
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell


def compare_cells(a, b, left_out=frozenset(), tables=True, nothing=NOTHING):
    """`left_out`: further names that a command's cells are compared without."""
    outcome = Outcome()
    if a["exit"] != b["exit"]:
        outcome.different.append(Difference("exit code", Leaf(a["exit"]), Leaf(b["exit"])))
    outcome.values += 1
    summary_a, summary_b = a.get("summary") or {}, b.get("summary") or {}
    accuracy = max(stated_accuracy(summary_a), stated_accuracy(summary_b))
    leave = LEFT_OUT | left_out
    compare_leaves(outcome, leaves(summary_a, leave), leaves(summary_b, leave), accuracy, nothing)
    tables_a, tables_b = (cell.get("csv", {}) if tables else {} for cell in (a, b))
    for name in sorted({*tables_a, *tables_b} - leave):
        x, y = tables_a.get(name), tables_b.get(name)
        if x is None or y is None:
            outcome.different.append(Difference(name, x and Leaf("written"), y and Leaf("written")))
        elif x == y:
            outcome.values += x.count(",")
        else:
            compare_leaves(outcome, leaves_of_table(name, x, leave), leaves_of_table(name, y, leave), max(accuracy, SAMPLES), nothing)
    for stream in ("stdout", "stderr"):
        if stream not in leave and stream in a and stream in b:
            compare_words(outcome, stream, a[stream], b[stream], numbers=not summary_a)
    return outcome
