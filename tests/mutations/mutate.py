#!/usr/bin/env python3
"""Breaks formulas on purpose, one at a time, and tells whether their tests notice.

The files *.toml beside this script list the mutations. Each has the keys
  name, slip   the column, field or mark that it is about, and what is wrong with it
  file         the source file
  old          a text that stands there once: a statement with its semicolon, or an expression. A longer text makes
               it unique where the expression alone is not; then it stands between « and »
  wrong        what stands in its place while the mutation is on
  program      the test program
  tests        a filter of GoogleTest; one of these tests must fail then

All mutations go into one copy of the source tree, each behind a switch that reads the environment variable
GRAINREEL_MUTANT, so that one build serves all of them. The source tree itself stays as it is. First all tests run with
no mutation on: they must pass. Then they run once for each mutation.

Exit code: 0 all mutations are caught; 1 one survives, or a test fails without any; 2 the list does not fit the
sources, or the copy does not build.
"""

import argparse
import concurrent.futures
import dataclasses
import itertools
import os
import re
import subprocess
import sys
import tomllib
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
LEFT_OUT = {".git", "build", "output", ".cache"}  # of the tree's own folder
HEADER = "grainreel_mutant.hpp"
SWITCH = """// Written by tests/mutations/mutate.py: whether a mutation is on.
#pragma once
#include <cstdlib>
inline const unsigned long grainreel_chosen_mutant = [] {
    const char* const number = std::getenv("GRAINREEL_MUTANT");
    return number ? std::strtoul(number, nullptr, 10) : 0ul;
}();
inline bool grainreel_mutant(unsigned long number) { return number == grainreel_chosen_mutant; }
"""
LONGEST_RUN = 900  # s, of the tests of one mutation


class Mistake(Exception):
    """The list does not fit the sources, or the copy does not build."""


@dataclasses.dataclass
class Mutation:
    name: str
    slip: str
    file: str
    old: str
    wrong: str
    tests: str
    program: str
    number: int = 0  # a checksum of its title: it stays when others come, so that only their files are compiled anew
    at: int = 0  # where `old` stands in the file

    @property
    def title(self):
        return f"{self.name}: {self.slip}"


def read_list():
    mutations = []
    for path in sorted(HERE.glob("*.toml")):
        try:
            content = tomllib.loads(path.read_text(encoding="utf-8"))
        except tomllib.TOMLDecodeError as problem:
            raise Mistake(f"{path.name}: {problem}") from None
        usual = {key: content[key] for key in ("program", "file", "tests") if key in content}
        for entry in content["mutation"]:
            try:
                mutations.append(Mutation(**(usual | entry)))
            except TypeError as problem:
                raise Mistake(f"{path.name}: {entry.get('name', entry)}: {problem}") from None
    numbers = set()
    for mutation in mutations:
        mutation.number = zlib.crc32(mutation.title.encode())
        if mutation.number in numbers:
            raise Mistake(f"{mutation.title}: there are two of this name")
        numbers.add(mutation.number)
    return mutations


def is_expression(text):
    """Whether brackets and ?: come in pairs, and no comma stands outside brackets: else it cannot be put in brackets."""
    depth = choices = 0
    for sign in text.replace("::", ""):
        depth += (sign in "([{") - (sign in ")]}")
        choices += (sign == "?") - (sign == ":")
        if depth < 0 or (depth == 0 and sign == ","):
            return False
    return depth == 0 and choices == 0 and text.strip() != ""


def problems_of_texts(mutations):
    """Finds where each text stands. It must be there once, and two texts must be the same or apart."""
    for mutation in mutations:
        path = SOURCE / mutation.file
        text = path.read_text(encoding="utf-8") if path.is_file() else ""
        before, mark, marked = mutation.old.partition("«")
        whole = mutation.old.replace("«", "").replace("»", "")
        mutation.old = marked.partition("»")[0] if mark else whole
        found = text.count(whole)
        mutation.at = text.find(whole) + (len(before) if mark else 0)
        if found != 1:
            yield f"{mutation.file}: {mutation.title}: the text stands there {found} times: {whole.strip()}"
        if not mutation.old.endswith(";") and not (is_expression(mutation.old) and is_expression(mutation.wrong)):
            yield f"{mutation.file}: {mutation.title}: neither a statement nor a whole expression: {mutation.old}"
    for one, other in itertools.permutations(mutations, 2):
        same_text = one.at == other.at and one.old == other.old
        if one.file == other.file and one.at <= other.at < one.at + len(one.old) and not same_text:
            yield f"{one.file}: the texts of these overlap: {one.title}; {other.title}"


def switched(old, those):
    """What stands in place of a text: what is wrong where a mutation is on, else the text."""
    if old.endswith(";"):
        branches = "".join(f"if (grainreel_mutant({m.number}ul)) {{ {m.wrong} }} else " for m in those)
        return f"{{ {branches}{{ {old} }} }}"
    branches = "".join(f"grainreel_mutant({m.number}ul) ? ({m.wrong}) : " for m in those)
    return f"({branches}({old}))"


def mutated(file, text, mutations):
    at_place = {}
    for mutation in mutations:
        if mutation.file == file:
            at_place.setdefault(mutation.at, []).append(mutation)
    for at in sorted(at_place, reverse=True):
        old = at_place[at][0].old
        text = text[:at] + switched(old, at_place[at]) + text[at + len(old):]
    return f'#include "{HEADER}"\n{text}' if at_place else text


def write_changed(path, content, mode=0o644):
    """Leaves a file that is right already, so that nothing is compiled in vain."""
    if path.is_file() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    path.chmod(mode)


def files_in(tree):
    for folder, inner, names in os.walk(tree):
        left_out = LEFT_OUT if Path(folder) == tree else {"__pycache__"}
        inner[:] = [name for name in inner if name not in left_out]
        for name in names:
            yield (Path(folder) / name).relative_to(tree)


def copy_sources(tree, mutations):
    wanted = set(files_in(SOURCE))
    changed = {mutation.file for mutation in mutations}
    for name in wanted:
        content = (SOURCE / name).read_bytes()
        if str(name) in changed:
            content = mutated(str(name), content.decode(), mutations).encode()
        write_changed(tree / name, content, (SOURCE / name).stat().st_mode & 0o777)
    write_changed(tree / HEADER, SWITCH.encode())
    for name in set(files_in(tree)) - wanted - {Path(HEADER)}:
        (tree / name).unlink()


def build(tree, programs, jobs, options):
    targets = sorted(programs) + ["grainreel"]
    for command in (["cmake", "--preset", "release", "-DGRAINREEL_TESTS=ON", *options],
                    ["cmake", "--build", "--preset", "release", "-j", str(jobs), "--target", *targets]):
        if subprocess.run(command, cwd=tree, check=False).returncode != 0:
            raise Mistake("the copy does not build: " + " ".join(command))


def run_tests(tree, program, tests, number):
    """Exit code and what was printed; the code is None where it took too long."""
    environment = os.environ | {"GRAINREEL_MUTANT": str(number)}
    command = [tree / "build/release/tests" / program, f"--gtest_filter={tests}"]
    try:
        done = subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, errors="replace",
                              timeout=LONGEST_RUN, check=False)
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, done.stdout + done.stderr


def names_after(mark, printed):
    """Of tests, without what GoogleTest says of their time and parameters."""
    found = re.findall(rf"^\[ *{mark} *\] ([^\s,(]+\.[^\s,(]+)", printed, re.MULTILINE)
    return list(dict.fromkeys(found))


def check_without(tree, mutations, pool):
    """Every test must be there, and pass while no mutation is on."""
    wanted = sorted({(m.program, one) for m in mutations for one in m.tests.split(":")})
    runs = [(program, one, pool.submit(run_tests, tree, program, one, 0)) for program, one in wanted]
    sound = True
    for program, one, run in runs:
        code, printed = run.result()
        if code == 0 and names_after("OK", printed):
            continue
        sound = False
        print(f"without a mutation: {program} {one}: " + ("no such test passes" if code == 0 else "fails"))
    return sound


def verdict(code, printed):
    if code is None:
        return "caught", f"after {LONGEST_RUN} s without an end"
    if code == 0:
        return "SURVIVED", ""
    failed = names_after("FAILED", printed)
    return "caught", "by " + (", ".join(failed) if failed else f"an end with status {code}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="TEXT", help="only mutations whose name, slip or file holds TEXT")
    parser.add_argument("--check", action="store_true", help="prove that each text stands in its file once, no more")
    parser.add_argument("--list", action="store_true", help="print the mutations, their numbers and tests")
    parser.add_argument("--tree", type=Path, default=SOURCE / "build/mutations", help="where the copy is made: a new "
                        "folder, or that of the last time (default: %(default)s)")
    parser.add_argument("--jobs", "-j", type=int, default=os.cpu_count(), help="processes at a time (default: all)")
    parser.add_argument("--cmake", action="append", default=[], metavar="OPTION", help="one more option of cmake, "
                        "such as --cmake=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    return parser.parse_args()


def run_all(options):
    everything = read_list()
    problems = list(problems_of_texts(everything))
    if problems:
        raise Mistake("\n".join(problems))
    wanted = [m for m in everything if not options.only or options.only in f"{m.title} {m.file}"]
    if not wanted:
        raise Mistake(f"no mutation holds '{options.only}'")
    if options.list:
        for m in wanted:
            print(f"{m.number:10}  {m.title}\n            {m.file}; {m.program} {m.tests}")
    if options.list or options.check:
        print(f"{len(wanted)} mutations; each text stands in its file once")
        return 0
    tree = options.tree.resolve()
    if tree.is_dir() and any(tree.iterdir()) and not (tree / HEADER).is_file():
        raise Mistake(f"{tree} is in use for something else; name a new folder")
    copy_sources(tree, everything)
    build(tree, {m.program for m in wanted}, options.jobs, options.cmake)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        sound = check_without(tree, wanted, pool)
        print("without a mutation: all tests pass" if sound else "without a mutation: some tests fail", flush=True)
        runs = [pool.submit(run_tests, tree, m.program, m.tests, m.number) for m in wanted]
        survivors = []
        for count, (m, run) in enumerate(zip(wanted, runs), 1):
            word, how = verdict(*run.result())
            print(f"{count:4}/{len(wanted)}  {word:8}  {m.title}  {how}", flush=True)
            if word == "SURVIVED":
                survivors.append(m)
    print(f"{len(wanted)} mutations: {len(wanted) - len(survivors)} caught, {len(survivors)} survived")
    for m in survivors:
        print(f"survived: {m.title} ({m.file}); {m.program} {m.tests}")
    return 0 if sound and not survivors else 1


def main():
    try:
        return run_all(arguments())
    except Mistake as problem:
        print(f"mutate.py: {problem}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
