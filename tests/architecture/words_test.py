"""words_test.py: none of the words of words.txt is used in READMEs, docs, help, messages or comments.

    python3 tests/architecture/words_test.py [PROGRAM]

Reads the pages as people see them (no code, no links), every text of more than one word in the sources of C++ and of the page,
the docstrings of Python's module, the comments of all sources, tests and benches included, and, given the program, the help of
each of its commands.
"""
import io
import re
import subprocess
import sys
import tokenize
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FOLDERS = ("engine", "drivetrain", "mechanisms", "studies", "library", "app", "python")
COMMENTED = (*FOLDERS, "tests", "bench")
LITERAL = re.compile(r'//[^\n]*|/\*.*?\*/|#include[^\n]*|R"(\w*)\((.*?)\)\1"|"((?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\\n]|\\.)+\'|\S', re.S)


def patterns():
    for line in (ROOT / "tests/architecture/words.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            # The first two bars with blanks around part the columns; bars of the patterns have none.
            what, instead, passes = (part.strip() for part in re.split(r" +\|(?: +|$)", line, maxsplit=2))
            yield re.compile(rf"(?<![\w-])(?:{what})(?![\w-])", re.I), instead, re.compile(passes, re.I) if passes else None


def page(text):
    """A page of Markdown without code, targets of links and marks."""
    text = re.sub(r"```.*?```|`[^`]*`|<[^>]*>|(?<=\])\([^)]*\)", " ", text, flags=re.S)
    return re.sub(r"[*_]{1,2}", "", text)


def literals(text):
    """Texts of a C++ source, those that stand in a row joined; of a single word only those that are no name."""
    texts, joined = [], None
    for found in LITERAL.finditer(text):
        raw, plain = found.group(2), found.group(3)
        if raw is not None or plain is not None:
            piece = raw if raw is not None else plain.replace("\\n", " ").replace('\\"', '"')
            joined = piece if joined is None else joined + piece
        elif not found.group().startswith(("//", "/*")):
            texts += [joined] if joined else []
            joined = None
    return [t for t in texts + ([joined] if joined else []) if " " in t.strip()]


def comments(text, python):
    """Comments of a source, those on lines that follow each other joined; of Python with its docstrings."""
    if python:
        starts = [0, *(newline.end() for newline in re.finditer("\n", text))]
        found = [(starts[t.start[0] - 1] + t.start[1], t.string) for t in tokenize.generate_tokens(io.StringIO(text).readline)
                 if t.type == tokenize.COMMENT or t.type == tokenize.STRING and t.string.startswith(('"""', 'r"""'))]
    else:
        found = [(m.start(), m.group()) for m in LITERAL.finditer(text) if m.group().startswith(("//", "/*"))]
    parts, end = [], None
    for start, comment in found:
        plain = re.sub(r"^\s*(?://+|/?\*+/?|#+)|\*/$|`[^`\n]*`", " ", comment, flags=re.M)
        if end is not None and re.fullmatch(r"\n[ \t]*", text[end:start]):
            parts[-1] += plain
        else:
            parts.append(plain)
        end = start + len(comment)
    return parts


def texts(program):
    for path in sorted(ROOT.rglob("*.md")):
        name = path.relative_to(ROOT).as_posix()
        if name.startswith(("build", "results", ".")) or "vendor" in name or name == "tests/architecture/reading.md":
            continue  # it quotes what was before
        text = path.read_text()
        if name == "tests/claims/sheet.md":  # what it quotes is in the sources, or was before
            text = re.sub(r"^>.*$", "", text, flags=re.M)
        yield name, [page(text)]
    yield "docs/kurbel.1", [(ROOT / "docs/kurbel.1").read_text()]
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            if "vendor" in name:
                continue
            if path.suffix in (".cpp", ".h", ".js"):
                yield name, literals(path.read_text())
            elif path.suffix == ".py":
                yield name, re.findall(r'""".*?"""|"[^"\n]* [^"\n]*"', path.read_text(), re.S)
    for folder in COMMENTED:
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            if path.suffix in (".cpp", ".h", ".js", ".py") and "vendor" not in name:
                yield name, comments(path.read_text(), path.suffix == ".py")
    if program:
        def said(*arguments):
            return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout
        yield "kurbel --help", [said("--help")]
        for command in said("commands").split():
            yield f"kurbel {command} --help", [said(command, "--help")]


def main(program):
    rules, found, read = list(patterns()), 0, 0
    for name, parts in texts(program):
        for part in parts:
            read += 1
            part = re.sub(r"\s+", " ", part)
            for rule, instead, passes in rules:
                fine = [m.span() for m in passes.finditer(part)] if passes else []
                for m in rule.finditer(part):
                    if not any(begin <= m.start() and m.end() <= end for begin, end in fine):
                        found += 1
                        print(f"{name}: …{part[max(0, m.start() - 50):m.end() + 40]}… ({m.group()}: {instead})")
    print(f"{read} texts, {found} to be mended")
    return 1 if found or read < 15000 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else None))
