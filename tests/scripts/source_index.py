#!/usr/bin/env python3
"""Writes the index of the source, docs/notes/sources.md: a line for each room and each concept (a header and its source
count as one). The room's line comes from the table of docs/architecture.md, a file's line is the first sentence of the
comment at its top. So the index says what the files say.

usage: source_index.py [--check]
    --check    write nothing; exit code 1 where the page differs from what would be written, or a file says nothing
"""
import collections
import re
import sys
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
PAGE = TREE / "docs" / "notes" / "sources.md"
HEAD = """# Sources

One line for each file of the program: a header and its source are one line. The script
`tests/scripts/source_index.py` writes this page from the comment at the top of each file, and ctest compares it
(`SourceIndex`). What rooms are and in which order they stand is in [architecture](../architecture.md).
"""


def rooms():
    """(folder, what it has) as docs/architecture.md lists them."""
    text = (TREE / "docs" / "architecture.md").read_text()
    return re.findall(r"^\| `((?:engine|render)(?:/\w+)?)` \| (.*) \|$", text, re.MULTILINE)


def first_sentence(file):
    """The first sentence of the comment that the file begins with, or nothing."""
    lines = []
    for line in file.read_text().split("\n"):
        if not line.startswith("//"):
            break
        text = line.lstrip("/").replace("@file", "").strip()
        if text:
            lines.append(text)
        elif lines:
            break
    text = " ".join(lines)
    for end in re.finditer(r"[.](?= |$)", text):
        before = text[: end.start()]
        # A stop inside parentheses belongs to a journal's name, and "e.g." ends no sentence.
        if before.count("(") == before.count(")") and not before.endswith(("e.g", "i.e", " al", "Eq")):
            text = before + "."
            break
    text = text.rstrip(",;") + ("" if text.endswith(".") or not text else ".")
    # Pages call the program by the script at the tree's top.
    return text.replace("`grainreel ", "`./movie ").replace("|", "\\|").replace("<", "&lt;")


def concepts(room, others):
    """Stem of each concept of a room, with the files it consists of."""
    found = collections.defaultdict(list)
    for file in sorted((TREE / room).rglob("*.[ch]pp")):
        name = file.relative_to(TREE).as_posix()
        if any(name.startswith(other + "/") for other in others if other != room and other.startswith(room + "/")):
            continue
        found[re.sub(r"(-inl)?\.[ch]pp$", "", name)].append(file)
    return found


def page():
    """The text of the index, and the files that do not say what they are for."""
    silent = []
    listed = rooms()
    names = [room for room, _ in listed]
    out = [HEAD]
    for room, says in listed:
        # This page lies one folder deeper than architecture.md, so its links go up once.
        says = re.sub(r"\((\w+/)", r"(../\1", says)
        out.append(f"\n## {room}\n\n{says}.\n\n| file | what it is for |\n|---|---|")
        for stem, files in concepts(room, names).items():
            # The header speaks for both.
            sentence = next((s for s in map(first_sentence, sorted(files, key=lambda f: f.suffix != ".hpp")) if s), "")
            if not sentence:
                silent.append(stem)
            out.append(f"| `{stem[len(room) + 1:]}` | {sentence} |")
    return "\n".join(out) + "\n", silent


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    text, silent = page()
    for stem in silent:
        print(f"{stem}: no comment at its top says what it is for")
    if sys.argv[1:]:
        old = PAGE.read_text() if PAGE.exists() else ""
        if old != text:
            print(f"{PAGE.relative_to(TREE)} is not what the sources say; write it by tests/scripts/source_index.py")
        sys.exit(1 if silent or old != text else 0)
    PAGE.write_text(text)


main()
