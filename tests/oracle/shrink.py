"""The smallest scene that still shows a finding: parts, keys, steps are omitted, numbers rounded, as long as it does."""
import re


def without_part(text, name):
    """Without this component's table, its place in lines, steps that set it."""
    text = re.sub(rf"\n\[{re.escape(name)}\]\n(?:[^\[\n][^\n]*\n|  [^\n]*\n)*", "\n", text)
    text = re.sub(rf'"{re.escape(name)}", |, "{re.escape(name)}"', "", text)
    return re.sub(rf'  \{{[^\n]*set = \["{re.escape(name)}"\][^\n]*\n', "", text)


def rounded(text):
    return re.sub(r"\d+\.\d{2,}|\d{3,}\.\d+", lambda m: f"{float(m.group()):.2g}" if float(m.group()) < 1e4 else m.group(), text)


def smaller(text):
    """Texts that lack one thing, the larger things first."""
    for name in re.findall(r"^\[(?!run|sequence|effects|\[)(\w+)\]", text, re.M):
        yield without_part(text, name)
    if "[sequence]" in text:
        yield re.sub(r"\n\[sequence\]\n.*?\n\]\n", "\n", text, flags=re.S)
    if "[effects]" in text:
        yield re.sub(r"\n\[effects\]\n[^\n]*\n", "\n", text)
    lines = text.splitlines(keepends=True)
    for k, line in enumerate(lines):
        if re.match(r"  \{|(?!kind|line|steps|repeat|until)\w+ = ", line):
            yield "".join(lines[:k] + lines[k + 1:])
    yield re.sub(r", rise = [^,}]*", "", text)
    yield rounded(text)


def shrink(text, shows, most=300):
    """`shows`(texts) → whether each still shows it."""
    tried, size = {text}, 10
    while most > 0:
        todo = [t for t in dict.fromkeys(smaller(text)) if t not in tried]
        if not todo:
            break
        for k in range(0, len(todo), size):
            piece = todo[k:k + size]
            most -= len(piece)
            tried.update(piece)
            if good := next((t for t, yes in zip(piece, shows(piece)) if yes), None):
                text = good
                break
        else:
            break
    return re.sub(r"\n{3,}", "\n\n", text)
