#!/usr/bin/env python3
"""Writes docs/reference/python.md, the reference of the Python module, from its docstrings.

usage: python_reference.py [--check]     with --check it only tells whether the page is current (exit status 1: no)

It reads the sources, so it needs none of the module's libraries.
"""
import ast
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MODULE = ROOT / "render/package/python/grainreel"
PAGE = ROOT / "docs/reference/python.md"
FUNCTIONS = ("open", "run", "start", "render", "film", "inspect", "export", "report", "compare", "study", "check")
CLASSES = ("Run", "Frame", "Measures", "Running", "Picture", "Film", "Answer", "Comparison", "Study", "GrainreelError",
           "GrainreelWarning")
# Methods that are shown although their names begin with _, as they are written.
SPECIAL = {"__len__": "len(run)", "__getitem__": "run[number]", "__iter__": "for frame in run"}

HEAD = """# The Python module

Functions and types of the module `grainreel`; [from Python](../guide/python.md) shows how they are used. This page is made
of the module's own words by `tests/scripts/python_reference.py`; `help(grainreel.run)` prints the same. Times are s, and all
other numbers are in SI units too. Whatever goes wrong is a `GrainreelError`.
"""


def definitions():
    """All functions and classes of the module by their names, each with the lines of its file."""
    all_of_them = {}
    for file in sorted(MODULE.glob("*.py")):
        text = file.read_text(encoding="utf-8")
        for node in ast.parse(text).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                all_of_them[node.name] = (node, text.splitlines())
    return all_of_them


def words_of(annotation):
    """An annotation as a user would read it."""
    text = ast.unparse(annotation).replace("'", "").replace("PathLike", "path").replace("Optional[Time]", "Optional[time]")
    return text.replace("Settings", "Optional[dict]").replace("Any", "...")


def signature(node, name):
    """name(a, b=None) -> type, broken into lines of at most 100 letters."""
    spec, parts = node.args, []
    plain = [*spec.posonlyargs, *spec.args]
    defaults = [None] * (len(plain) - len(spec.defaults)) + list(spec.defaults)
    for argument, default in zip(plain, defaults):
        if argument.arg != "self":
            parts.append(argument.arg + (f"={ast.unparse(default)}" if default else ""))
    if spec.kwonlyargs:
        parts.append("*")
    for argument, default in zip(spec.kwonlyargs, spec.kw_defaults):
        parts.append(argument.arg + (f"={ast.unparse(default)}" if default else ""))
    if spec.kwarg:
        parts.append("**" + spec.kwarg.arg)
    back = f" -> {words_of(node.returns)}" if node.returns and ast.unparse(node.returns) not in ("None", "Any") else ""
    lines, line = [], f"{name}("
    for place, part in enumerate(parts):
        piece = part + (", " if place < len(parts) - 1 else "")
        if len(line) + len(piece) > 100:
            lines.append(line.rstrip())
            line = " " * (len(name) + 1)
        line += piece
    return "\n".join([*lines, line + ")" + back])


def prose(node):
    """The docstring; lines that belong together are one paragraph."""
    text = ast.get_docstring(node)
    if not text:
        sys.exit(f"{node.name}: has no docstring")
    return text


def is_property(node):
    return any(isinstance(each, ast.Name) and each.id == "property" for each in node.decorator_list)


def attributes(node, lines):
    """self.name = ..., with a comment `#:` above."""
    for part in ast.walk(node):
        if isinstance(part, (ast.Assign, ast.AnnAssign)):
            target = part.targets[0] if isinstance(part, ast.Assign) else part.target
            above = lines[part.lineno - 2].strip()
            if isinstance(target, ast.Attribute) and above.startswith("#: "):
                yield f"- `{target.attr}`: {above[3:]}"


def members(node, lines):
    """Lists of properties and methods."""
    yield from attributes(node, lines)
    for part in node.body:
        if isinstance(part, ast.Assign) and ast.unparse(part.value).startswith("_verbs."):
            yield f"- `{part.targets[0].id}(...)`: see [`{part.targets[0].id}`](#{part.targets[0].id})"
        if not isinstance(part, ast.FunctionDef) or not ast.get_docstring(part):
            continue
        if part.name.startswith("_") and part.name not in SPECIAL:
            continue
        words = " ".join(prose(part).split())
        name = part.name if is_property(part) else " ".join(signature(part, part.name).split())
        name = SPECIAL.get(part.name, name)
        yield f"- `{name}`: {words}"


def page():
    known, text = definitions(), HEAD
    text += "\n## Functions\n"
    for name in FUNCTIONS:
        node, _ = known[name]
        text += f"\n### {name}\n\n```python\n{signature(node, 'grainreel.' + name)}\n```\n\n{prose(node)}\n"
    text += "\n## Types\n"
    for name in CLASSES:
        node, lines = known[name]
        text += f"\n### {name}\n\n{prose(node)}\n"
        rows = list(members(node, lines))
        text += "\n" + "\n".join(rows) + "\n" if rows else ""
    return text


def main():
    exported = set(re.findall(r'"(\w+)"', (MODULE / "__init__.py").read_text().split("__all__ = ")[1].split("]")[0]))
    if exported != {*FUNCTIONS, *CLASSES}:
        sys.exit(f"python_reference.py: its lists differ from __all__: {exported ^ {*FUNCTIONS, *CLASSES}}")
    text = page()
    if sys.argv[1:] != ["--check"]:
        PAGE.write_text(text, encoding="utf-8")
    elif not PAGE.is_file() or PAGE.read_text(encoding="utf-8") != text:
        sys.exit(f"{PAGE.relative_to(ROOT)}: is not current; run tests/scripts/python_reference.py")


main()
