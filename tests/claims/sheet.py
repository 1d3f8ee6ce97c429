"""Whether the conclusions on the sheet are still what the program prints: python3 tests/claims/sheet.py PROGRAM [--renew]

Runs the command of each heading of sheet.md in the repository's folder (a minute in all) and shows every conclusion that
differs; with --renew the sheet gets the new words, and whoever renews it judges them anew.
"""
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

SHEET = Path(__file__).resolve().parent / "sheet.md"
ROOT = SHEET.parent.parent.parent
ENTRY = re.compile(r"(^## \d+\. `kurbel (.+)`\n\n(?:> before: .*\n>\n)?> )(.*)$", re.M)
TIMES = re.compile(r"[\d.]+ × the time|[\d.]+( %)? of the time")  # of this computer


def printed(program, command):
    done = subprocess.run([program, *shlex.split(command)], cwd=ROOT, capture_output=True, text=True)
    place = re.search(r"results: (\S+summary\.json)", done.stdout)
    return json.loads((ROOT / place.group(1)).read_text())["conclusion"] if place else f"no conclusion: {done.stderr.strip()}"


def main(program, renew):
    text, changed = SHEET.read_text(), 0

    def now(entry):
        nonlocal changed
        head, command, told = entry.groups()
        words = printed(program, command)
        if TIMES.sub("", words) == TIMES.sub("", told):
            return entry.group(0)
        changed += 1
        print(f"kurbel {command}\n  sheet: {told}\n  now:   {words}")
        return head + words

    renewed = ENTRY.sub(now, text)
    if renew:
        SHEET.write_text(renewed)
    print(f"{len(ENTRY.findall(text))} conclusions, {changed} changed")
    return 1 if changed else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--renew"]):
        sys.exit(__doc__)
    sys.exit(main(str(Path(sys.argv[1]).resolve()), len(sys.argv) == 3))
