#!/usr/bin/env python3
"""Checks that options, keys and tests that the documentation names exist.

usage: names_exist.py GRAINREEL

Options: each `--word` in docs/, README.md and CONTRIBUTING.md, in the scenes, in the program's own help, and in
messages of engine/ and render/. Where a command line names its program, the option must be one of that program: of the verb for `grainreel render`,
of a script for `python3 tests/x.py`. The options of other people's programs are not checked. An option without a command must
be one of some verb or some script of ours.
Keys: each `table.key` of a table of scene files, in code of the documentation and in the program's help.
Tests: docs/reliability.md names a test for each promise, as `ctest -R NAME` or `Suite.Name`, or a script by its path. tests/turns.txt names tests of ctest.
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys

import keys_shown

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPTION = re.compile(r"(?<![\w/-])--[a-z][a-z0-9-]*[a-z0-9]")
CODE = re.compile(r"^```\w*[^\n]*\n(.*?)^```$|`([^`\n]+(?:\n[^`\n]+)?)`", re.S | re.M)
OURS = ("grainreel", "./movie", "movie", "$G", "$GRAINREEL", "build/release/grainreel")
EVERYWHERE = {"--version", "--help"}
# Named without a command: options of other programs, and one that no help tells.
OTHERS = {"--time": "sbatch", "--force-offscreen-rendering": "ParaView", "--long": "zstd", "--render": "Blender", "--continue": "run.sh",
          "--socket": "hidden", "--coverage": "GCC", "--duratoin": "an example of a slip", "--gtest": "GoogleTest"}
WRONG_ON_PURPOSE = {"drive.frequencie"}
FILES = (".sh", ".slurm", ".dump", ".pvd", ".nc", ".csv", ".json", ".toml", ".md", ".py", ".html", ".png", ".mp4", ".grs", ".txt", ".cpp", ".hpp", ".webm", ".gif", ".stl")


def documents():
    yield from sorted(file for file in ROOT.glob("docs/**/*.md") if "stored_run" not in file.parts)  # notes of a plan
    yield ROOT / "README.md"
    yield ROOT / "CONTRIBUTING.md"


def help_of(program, verb=None):
    return subprocess.run([program, *([verb] if verb else []), "--help"], capture_output=True, text=True, check=True).stdout


def helps(program):
    """What each verb says with --help."""
    verbs = re.findall(r"^  ([a-z]+) {2,}", help_of(program).split("Subcommands:")[1], re.M)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return dict(zip(verbs, pool.map(lambda verb: help_of(program, verb), verbs)))


def declared_in(text):
    """The options that a help text declares: those at the beginning of a line of its list."""
    return {word for line in text.splitlines() if re.match(r"  (-\w,)?--", line) for word in OPTION.findall(line.split("  ", 2)[1])}


def texts_of_scripts():
    """The text of each script of ours by its path; an option of it stands there as a word."""
    names = [file for file in ROOT.glob("tests/**/*") if file.is_file() and file.suffix in (".py", ".sh", "") and file.stat().st_size < 200_000]
    names += [*ROOT.glob("*"), *ROOT.glob(".ci/*"), *ROOT.glob("scenes/**/*.py"), *ROOT.glob("render/package/**/*"), *ROOT.glob("docs/**/*.py"), *ROOT.glob("docs/**/*.sh")]
    return {str(file.relative_to(ROOT)): file.read_text(errors="replace") for file in names if file.is_file()}


def commands(line):
    """The commands of a line of a shell: [words], without what stands before the program."""
    for part in re.split(r"[|;&]+|\$\(", re.sub(r"(^|\s)#.*", "", line)):
        words = part.replace("`", " ").split()
        while words and (words[0] in ("$", "sudo", "time", "nice", "env", "python3", "sh", "bash", "exec") or re.match(r"[A-Z_]+=", words[0])):
            words.pop(0)
        yield words


class Names:
    def __init__(self, program):
        self.helps = helps(program)
        self.of_verb = {verb: declared_in(text) | {"--help"} for verb, text in self.helps.items()}
        self.any = set().union(*self.of_verb.values()) | EVERYWHERE | set(OTHERS)
        self.scripts = texts_of_scripts()
        self.any_script = "\n".join(self.scripts.values())
        keys = keys_shown.keys_of_reference()
        self.keys = set(keys) | {key.rsplit(".", n)[0] for key in keys for n in range(1, key.count(".") + 1)}
        self.tables = {key.split(".")[0] for key in keys if "." in key}

    def is_option(self, option, words):
        """Whether the option exists for the command, or anywhere where the words name none."""
        first = words[0] if words else ""
        if first.startswith("./"):
            first = "movie" if first == "./movie" else first[2:]
        if pathlib.Path(first).name in ("grainreel", "movie"):
            verb = next((word for word in words[1:2] if word in self.of_verb), "movie" if first == "movie" else None)
            return option in (self.of_verb[verb] if verb else self.any) | EVERYWHERE or option in self.scripts["movie"]
        if first in self.of_verb:
            return option in self.of_verb[first]
        if first in self.scripts:
            return re.search(re.escape(option) + r"(?![\w-])", self.scripts[first]) is not None or option == "--help"
        if first and not first.startswith("-"):
            return True  # of another program, or prose
        return option in self.any or re.search(re.escape(option) + r"(?![\w-])", self.any_script) is not None

    def faults_of_options(self, place, text):
        for match in CODE.finditer(text):
            block = (match[1] or match[2]).replace("\\\n", " ")
            number = text.count("\n", 0, match.start()) + 1
            for line in block.splitlines() if match[1] else [block.replace("\n", " ")]:
                for words in commands(line):
                    for option in OPTION.findall(" ".join(words)):
                        if not self.is_option(option, words):
                            yield f"{place}:{number}: {option} does not exist in `{' '.join(words)[:80]}`"

    def faults_of_keys(self, place, text):
        for match in re.finditer(r"(?<![\w./{-])((?:[a-z_]+(?:\[\d*\])?\.)+[a-z_]+)(?![\w/(*]|\.\w)", text):
            path = re.sub(r"\[\d*\]", "", match[1])
            if path.split(".")[0] not in self.tables or path.endswith(FILES) or path in self.keys | WRONG_ON_PURPOSE:
                continue
            if path.startswith("species.") and path.count(".") == 2 and "species." + path.split(".")[2] in self.keys:
                continue  # species.big.colour
            if place.endswith("python.md") and path.startswith("run."):
                continue  # a variable of Python
            yield f"{place}:{text.count(chr(10), 0, match.start()) + 1}: no table has the key {path}"


def code_of(text):
    """A document with its prose blanked, so that lines keep their numbers."""
    spans = [(m.start(), m.end()) for m in CODE.finditer(text)]
    kept, end = "", 0
    for start, stop in spans:
        kept += re.sub(r"[^\n]", " ", text[end:start]) + text[start:stop]
        end = stop
    return kept


def faults_of_messages(names):
    """Options that messages of the program name, in strings of its sources."""
    for file in sorted([*ROOT.glob("engine/**/*.cpp"), *ROOT.glob("render/app/**/*.cpp"), *ROOT.glob("render/film/**/*.cpp"), *ROOT.glob("render/scene/**/*.cpp")]):
        if "handover" in file.parts or "codec" in file.parts:
            continue  # these write command lines of other programs
        for number, line in enumerate(file.read_text().splitlines(), 1):
            for string in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
                if "#SBATCH" in string or "sbatch" in string:
                    continue
                for option in OPTION.findall(string):
                    if option not in names.any:
                        yield f"{file.relative_to(ROOT)}:{number}: no verb has {option}"


def faults_of_scenes(names):
    """Options that comments of the shipped scenes and studies name."""
    for file in sorted(ROOT.glob("scenes/**/*.toml")):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            for option in OPTION.findall(line):
                if option not in names.any:
                    yield f"{file.relative_to(ROOT)}:{number}: no verb has {option}"


def faults_of_tests():
    """Tests that docs/reliability.md names, and paths of scripts."""
    text = (ROOT / "docs/reliability.md").read_text()
    sources = "\n".join(file.read_text() for file in ROOT.glob("tests/**/*.cpp")) + (ROOT / "tests/CMakeLists.txt").read_text()
    groups = "\n".join(file.read_text() for file in [*ROOT.glob("tests/reliability/faults/*.py"), *ROOT.glob("tests/hard/*.cpp")])
    fuzz = (ROOT / "tests/fuzz/CMakeLists.txt").read_text()
    count = 0
    around = text.split("## What goes wrong around a run")[1].split("## ")[0]
    for name in re.findall(r"^\| ([a-z ]+[a-z-]*) \|", around, re.M):
        if name != "group" and f'"{name}"' not in groups:
            yield f"docs/reliability.md: tests/reliability/faults has no group {name}"
    for suite, name in re.findall(r"`([A-Z]\w+)\.([A-Z]\w+)`", text):
        count += 1
        if not re.search(rf"TEST(_F|_P)?\({suite},\s*{name}\)", sources):
            yield f"docs/reliability.md: there is no test {suite}.{name}"
    for name in re.findall(r"`ctest -R ([\w.]+)`", text):
        count += 1
        if not re.search(rf"NAME {re.escape(name)}\b|TEST(_F|_P)?\({name},", sources + fuzz):
            yield f"docs/reliability.md: there is no test {name}"
    for name in re.findall(r'`\./test --hard "?([a-z ]+)"?`', text):
        count += 1
        if f'"{name}"' not in groups:
            yield f"docs/reliability.md: there is no group {name}"
    for path in re.findall(r"`((?:tests|\.ci)/[\w./]+)", text):
        count += 1
        if not (ROOT / path).exists():
            yield f"docs/reliability.md: there is no {path}"
    if count < 20:
        yield f"docs/reliability.md names {count} tests"


def faults_of_turns(build):
    """The tests that tests/turns.txt names and ctest does not know."""
    told = subprocess.run(["ctest", "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
    known = set(re.findall(r"^ *Test +#\d+: (\S+)", told, re.M))
    for name in re.findall(r"^\d (\S+)", (ROOT / "tests/turns.txt").read_text(), re.M):
        if name not in known:
            yield f"tests/turns.txt: there is no test {name}"


def main():
    names = Names(sys.argv[1])
    faults = [*faults_of_messages(names), *faults_of_scenes(names), *faults_of_tests(), *faults_of_turns(pathlib.Path(sys.argv[1]).parent)]
    for file in documents():
        text = file.read_text()
        place = str(file.relative_to(ROOT))
        faults += [*names.faults_of_options(place, text), *names.faults_of_keys(place, code_of(text))]
    for verb, text in names.helps.items():
        prose = re.sub(r"Excludes: .*|Needs: .*", "", text)
        faults += [f"`{verb} --help` names {option}" for option in set(OPTION.findall(prose)) - names.any]
        faults += names.faults_of_keys(f"`{verb} --help`", text)
    if faults:
        sys.exit("\n".join(faults))
    print(f"the options of {len(names.helps)} verbs and {len(names.keys)} keys are those that the documentation names")


if __name__ == "__main__":
    main()
