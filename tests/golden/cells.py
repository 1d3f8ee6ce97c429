"""Which questions are put to which scene, and what a program answered: computed once, kept outside of the tree."""
import fnmatch
import gzip
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "kurbel" / "golden"
FORM = 1  # of the files of cells; another one: computed anew
FOLDERS = ("scenes", "docs/tasks", "tests/agreement", "tests/agreement/vibrations", "../shared/cases/reports")
QUICK = 5  # s of processor time: dearer cells are skipped


@dataclass(frozen=True)
class Command:
    arguments: tuple            # SCENE: the scene; OUT: a new folder
    left_out: frozenset = frozenset()
    scenes: tuple = ("*",)      # by pattern; names of components stand in the arguments, or the key is needed
    writes: bool = True         # has --out
    then: tuple = ()            # arguments of what is asked next, in the same folder: STATE.0 and STATE.1 are files that all of them share


# A line of progress every ten seconds, on a loaded machine.
PROGRESS = re.compile(r"(?m)^.*: \d+ %\n")
# What accuracy chooses by processor time, and the words about it; errors and counts of each setting are compared.
BY_TIME = frozenset({"stdout", "conclusion", "findings", "answers", "on_front", "on_front_of_model", "median", "fastest", "slowest"})
INTERRUPTED = {130, -signal.SIGINT, -signal.SIGTERM, -signal.SIGHUP, -signal.SIGKILL}  # no answer of the program

# Trials and budgets go by processor time: left off, or so wide that they do not bind.
COMMANDS = {
    "check": Command(("check", "SCENE"), writes=False),
    "figures": Command(("figures", "SCENE"), writes=False),
    "run --explain": Command(("run", "SCENE", "--explain"), writes=False),
    "run": Command(("run", "SCENE", "--no-trials")),
    "compare": Command(("compare", "SCENE", "--no-trials")),
    "steady": Command(("steady", "SCENE")),
    "modes": Command(("modes", "SCENE")),
    "forces": Command(("forces", "SCENE")),
    "size": Command(("size", "SCENE", "--delta", "0.02")),
    "reduce": Command(("reduce", "SCENE")),
    "gears": Command(("gears", "SCENE")),
    "effects": Command(("effects", "SCENE"), frozenset({"stdout"})),
    "advise": Command(("advise", "SCENE", "--no-held-out"), frozenset({"stdout"})),
    "accuracy": Command(("accuracy", "SCENE", "--no-multibody", "--methods", "dop853", "esdirk", "--tolerances", "1e-4",
                         "1e-6", "--time", "1e6 s"), BY_TIME),
    "uncertainty": Command(("uncertainty", "SCENE", "--samples", "20", "--jobs", "1", "--no-trials")),
    "modes --torque": Command(("modes", "SCENE", "--torque", "main_coupling"), scenes=("*press*", "*engine*")),
    "sweep": Command(("sweep", "SCENE", "--vary", "main_coupling.stiffness=500,900,1500 kN*m/rad", "--jobs", "1", "--into",
                      "OUT.db"), frozenset({"row", "line"}), ("scenes/crank_press.toml", "scenes/press_drive.toml")),
    "sweep --of steady": Command(("sweep", "SCENE", "--vary", "main_coupling.stiffness=500..1500 kN*m/rad", "--design",
                                  "sobol:8", "--of", "steady", "--jobs", "1", "--into", "OUT.db"),
                                 frozenset({"row", "line"}), ("scenes/crank_press.toml",)),
    "diff": Command(("diff", "SCENE", "SCENE", "--other-set", "main_coupling.stiffness=1 MN*m/rad"),
                    scenes=("scenes/crank_press.toml", "docs/tasks/eccentric_press.toml")),
}


@dataclass(frozen=True)
class Cell:
    command: str
    scene: str  # from the root of the tree

    @property
    def name(self):
        return f"{self.command} {self.scene}"

    @property
    def asked(self):
        return COMMANDS[self.command]

    def key(self):
        """Of all that the answer depends on but the program."""
        path = ROOT / self.scene
        text = path.read_bytes()
        digest = hashlib.sha256(repr((FORM, self.asked.arguments, *self.asked.then)).encode() + text)
        for file in re.findall(rb'"([^"\n]+\.\w+)"', text):
            data = path.parent / os.fsdecode(file)
            if data.is_file():
                digest.update(data.read_bytes())
        return digest.hexdigest()[:12]


def all_scenes():
    return [f"{folder}/{file.name}" for folder in FOLDERS if (ROOT / folder).is_dir()
            for file in sorted((ROOT / folder).glob("*.toml"))]


def fits(name, patterns):
    return any(fnmatch.fnmatch(n, p) for p in patterns for n in (name, Path(name).name, Path(name).stem))


def cells_of(only=("*",), scenes=("*",)):
    """In the order of the commands; a command is chosen by its name or by a pattern."""
    files = [s for s in all_scenes() if fits(s, scenes)]
    return [Cell(name, s) for name, command in COMMANDS.items() if any(fnmatch.fnmatch(name, p) for p in only)
            for s in files if fits(s, command.scenes) and (name != "uncertainty" or has_tolerances(s))]


def has_tolerances(scene):
    return re.search(r"\btolerance\s*=", (ROOT / scene).read_text()) is not None


# --- one cell ---

def run_cell(program, cell, limit):
    """The answer; after `limit` seconds of processor time the program is stopped: {"cut": limit}. "then": the answers to
    what is asked next, up to the first that ends otherwise than with 0."""
    with tempfile.TemporaryDirectory(prefix="golden-") as folder:
        answer = run_once(program, cell, cell.asked.arguments, Path(folder) / "out", limit)
        last = answer
        for number, arguments in enumerate(cell.asked.then):
            if last.get("exit") != 0:
                break
            last = run_once(program, cell, arguments, Path(folder) / f"out{number + 2}", limit - answer["seconds"])
            seconds = round(answer["seconds"] + last["seconds"], 3)
            if "cut" in last:
                return {"cut": limit, "seconds": seconds}
            answer = {**answer, "seconds": seconds, "then": [*answer.get("then", ()), last]}
        return answer


def run_once(program, cell, arguments, out, limit):
    """Of one process, which writes into the folder `out`."""
    scene, folder = (ROOT / cell.scene).resolve(), out.parent
    put = {"SCENE": str(scene), "OUT.db": f"{out}.db", "STATE.0": f"{folder}/state0.json", "STATE.1": f"{folder}/state1.json"}
    arguments = [put.get(word, word) for word in arguments] + (["--out", str(out)] if cell.asked.writes else [])
    with open(f"{folder}/stdout", "wb") as said, open(f"{folder}/stderr", "wb") as complained:
        process = subprocess.Popen([str(program), *arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=said,
                                   stderr=complained, env={**os.environ, "NO_COLOR": "1", "LC_ALL": "C.UTF-8"})
        cut, status, used = wait_for(process.pid, limit)
        process.returncode = code = os.waitstatus_to_exitcode(status)
    seconds = round(used.ru_utime + used.ru_stime, 3)
    if cut:
        return {"cut": limit, "seconds": seconds}

    def text(path):
        words = path.read_text(errors="replace").replace(str(scene), cell.scene).replace(str(out), "OUT")
        return words.replace(str(folder), "FOLDER").replace(str(program), "kurbel")
    place = out if out.is_dir() else Path(f"{out}.incomplete")
    summary = place / "summary.json"
    return {"exit": code, "seconds": seconds, "stdout": text(folder / "stdout"), "stderr": re.sub(PROGRESS, "", text(folder / "stderr")),
            "summary": json.loads(text(summary)) if summary.is_file() else None,
            "csv": {file.name: text(file) for file in sorted(place.glob("*.csv"))}}


def wait_for(pid, limit):
    """(whether it was stopped, status, what it used). RLIMIT_CPU alone counts ticks, and too few on a shared machine."""
    resource.prlimit(pid, resource.RLIMIT_CORE, (0, 0))
    resource.prlimit(pid, resource.RLIMIT_CPU, (max(1, int(2 * limit)),) * 2)  # should this program be killed
    processor_clock, pause, cut = (~pid << 3) | 2, 0.002, False
    while True:
        done, status, used = os.wait4(pid, os.WNOHANG)
        if done:
            return cut, status, used
        if not cut and time.clock_gettime(processor_clock) > limit:
            cut = True
            os.kill(pid, signal.SIGKILL)
        time.sleep(pause)
        pause = min(1.2 * pause, 0.05)


class Answers:
    """Cells of one program in a folder; a file appears there whole, so that a pass that was killed goes on where it was."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        os.utime(self.folder)

    def file(self, cell):
        return self.folder / cell.command.replace(" ", "_") / f"{cell.scene.replace('../', '').replace('/', '.')}-{cell.key()}.json.gz"

    def load(self, cell):
        try:
            return json.loads(gzip.decompress(self.file(cell).read_bytes()))
        except (OSError, EOFError, ValueError):
            return None

    def known(self, cell, limit):
        """What is there already: an answer, or that it takes longer than `limit`; else None."""
        answer = self.load(cell)
        return None if answer and answer.get("cut", limit) < limit else answer

    def keep(self, cell, answer):
        file = self.file(cell)
        file.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=file.parent, prefix=".new-", delete=False) as new:
            new.write(gzip.compress(json.dumps(answer).encode(), 1))
        os.replace(new.name, file)


def is_dear(answer, limit):
    return answer is not None and ("cut" in answer or answer["seconds"] > limit)


def compute(program, answers, cells, limit, jobs, say):
    """Computes what is not there; returns processor seconds used."""
    todo = [c for c in cells if answers.known(c, limit) is None]
    used, done, lock = 0.0, 0, threading.Lock()

    def one(cell):
        nonlocal used, done
        answer = run_cell(program, cell, limit)
        if answer.get("exit") not in INTERRUPTED:
            answers.keep(cell, answer)
        with lock:
            used, done = used + answer["seconds"], done + 1
            state = f"over {answer['cut']} s" if "cut" in answer else f"exit {answer['exit']}, {answer['seconds']:.1f} s"
            say(f"[{done}/{len(todo)}] {cell.name}: {state}")
    if todo:
        say(f"{len(todo)} of {len(cells)} cells to compute, {len(cells) - len(todo)} are there: {answers.folder}")
    with ThreadPoolExecutor(jobs) as pool:
        try:
            for _ in pool.map(one, todo):
                pass
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return used


# --- programs ---

def answers_of_program(program):
    """Kept by what the program is; those that nobody has used for two weeks are deleted."""
    folder = CACHE / "programs"
    for old in folder.glob("*"):
        if old.stat().st_mtime < Path("/proc/self").stat().st_mtime - 14 * 86400:
            shutil.rmtree(old, ignore_errors=True)
    return Answers(folder / hashlib.sha256(Path(program).read_bytes()).hexdigest()[:16])


def git(*words):
    return subprocess.run(["git", "-C", str(ROOT), *words], check=True, capture_output=True, text=True).stdout.strip()


def program_of_revision(revision, jobs, say):
    """(program, answers): built once per commit in a folder of its own, the program alone."""
    commit = git("rev-parse", "--verify", f"{revision}^{{commit}}")
    folder = CACHE / commit
    program, source, build = folder / "kurbel", folder / "src", folder / "build"
    if not program.is_file():
        say(f"builds the program of {commit[:10]} in {folder}")
        if not source.is_dir():
            new = folder / "src.new"
            shutil.rmtree(new, ignore_errors=True)
            new.mkdir(parents=True)
            archive = subprocess.Popen(["git", "-C", str(ROOT), "archive", commit], stdout=subprocess.PIPE)
            subprocess.run(["tar", "-x", "-C", str(new)], stdin=archive.stdout, check=True)
            if archive.wait() != 0:
                raise OSError(f"git archive {commit} failed")
            new.rename(source)
        subprocess.run(["cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DKURBEL_TESTS=OFF",
                        "-DKURBEL_PYTHON=OFF"], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", build, "--target", "kurbel_app", "-j", str(jobs)], check=True)
        shutil.copy2(build / "kurbel", folder / "kurbel.new")
        (folder / "kurbel.new").rename(program)
        shutil.rmtree(build)
        shutil.rmtree(source)
    return program, Answers(folder / "cells")


def program_of_tree(jobs):
    build = ROOT / "build" / "release"
    subprocess.run(["cmake", "--preset", "release"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "--target", "kurbel_app", "--", "-j", str(jobs), "--quiet"], check=True)
    return build / "kurbel"
