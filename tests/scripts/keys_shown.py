#!/usr/bin/env python3
"""Checks that each key of scene files is shown, in a scene of scenes/ or in a guide, and that the guides' examples work.

usage: keys_shown.py GRAINREEL [--list]

The keys are those of the table "All keys" of docs/reference/scenes.md. A key counts as shown where a scene has it, where
a block of TOML in a guide has it, or where a guide gives it after --set, by its path, or by a last word that only one
key has. Each block of TOML on the pages EXAMPLES, put into a small scene, must pass `grainreel check`; so must each
`film.KEY=VALUE` of the gallery. --list prints the keys that only guides show.
"""
import collections
import concurrent.futures
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
GUIDES = ROOT / "docs/guide"
EXAMPLES = ("contacts.md", "scene_pieces.md", "meshes.md", "fields.md", "gallery.md")
ASSIGNED = re.compile(r'((?:[a-z_]+(?:\[\d*\])?\.)+[a-z_]+) ?= ?(\{[^}]*\}|\[\{.*?\}\]|\[[^\]]*\]|"[^"]*"|[\w.+-]+)?')
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.S | re.M)

# The scene around an example. A table that the example has is left out here.
BASE = {
    "species": """
[[species]]
name = "small"
count = 40
diameter = "4 mm"
density = "2500 kg/m3"

[[species]]
name = "big"
count = 4
diameter = "6 mm"
density = "2500 kg/m3"
""",
    "container": """
[container]
shape = "box"
width = "60 mm"
depth = "20 mm"
height = "100 mm"
""",
    "drive": """
[drive]
frequency = "25 Hz"
g_level = 2
""",
    "run": """
[run]
duration = "4 s"
""",
}
MESHES = """
[container]
shape = "mesh"
mesh = "drum"

[[mesh]]
name = "drum"
file = "drum.stl"
scale = 0.001

[[mesh]]
name = "plate"
file = "plate.stl"
scale = 0.001
position = [0, "0.2 m", 0]
"""


def keys_of_reference():
    table, keys = "", []
    text = (ROOT / "docs/reference/scenes.md").read_text()
    for line in text[text.index("## All keys"):].splitlines():
        if head := re.match(r"### (?:`\[+([\w.]+)\]+`)?", line):
            table = head[1] or ""
        if row := re.match(r"\| `([\w.]+)` \|", line):
            keys.append(f"{table}.{row[1]}".lstrip("."))
    return keys


def paths(value, table=""):
    for one in value if isinstance(value, list) else [value]:
        if isinstance(one, dict):
            for key, inner in one.items():
                path = f"{table}.{key}".lstrip(".")
                yield path
                yield from paths(inner, path)


def toml_paths(text):
    try:
        return set(paths(tomllib.loads(text)))
    except tomllib.TOMLDecodeError:
        return set()


def named(text, once):
    """The keys that a guide names."""
    keys = set()
    for _, block in BLOCK.findall(text):
        keys |= toml_paths(block)
    for path, value in ASSIGNED.findall(text):
        path = re.sub(r"\[\d*\]", "", path)
        keys |= {path} | toml_paths(f"{path} = {value}" if value else "")
    keys |= set(re.findall(r"`((?:[a-z_]+\.)+[a-z_]+)", text))
    for table, inner in re.findall(r"`\[+([a-z_.]+)\]+` `([^`]*)`", text):
        keys |= toml_paths(f"[{table}]\n{inner}")
    for word in re.findall(r"`([a-z_]+)(?:`| = )", text):
        keys |= {once[word]} if word in once else set()
    return keys


def not_shown():
    """Keys that neither a scene nor a guide shows, and those that only guides show."""
    rows = keys_of_reference()
    repeated = {key for key in rows if key.startswith(("contact.wall.", "contact.pair."))
                and "contact." + key.split(".")[-1] in rows}
    keys = [key for key in rows if key not in repeated]
    lasts = collections.Counter(key.split(".")[-1] for key in keys)
    once = {key.split(".")[-1]: key for key in keys if lasts[key.split(".")[-1]] == 1}
    in_scenes = set().union(*(toml_paths(file.read_text()) for file in (ROOT / "scenes").glob("*.toml")))
    in_guides = set().union(*(named(file.read_text(), once) for file in GUIDES.glob("*.md")))
    return ([key for key in keys if key not in in_scenes | in_guides],
            [key for key in keys if key in in_guides - in_scenes])


def whole_scene(block):
    """The scene of an example: the example, and the tables that it leaves out."""
    tables = tomllib.loads(block)
    base = dict(BASE)
    if "[film.walls]" in block or ("drum" in block and "mesh" not in tables):
        base["container"] = MESHES
    if "[container.turn]" in block:
        base["drive"] = ""  # a container has one motion
    if "frequency" not in tables.get("drive", {"frequency": 1}):
        tables.pop("drive")  # stages alone
    if '"sand"' in block:
        base["species"] = base["species"].replace('"big"', '"sand"')
    if any("mass" in species for species in tables.get("species", [])):
        base["species"] = ""
    return block + "".join(words for table, words in base.items() if table not in tables or table == "species")


def write_in_mm(stl, to):
    """Copies a binary STL that is in m: 80 bytes, a count, and for each triangle 12 floats and 2 bytes."""
    bytes_ = bytearray(stl.read_bytes())
    for triangle in range(84, len(bytes_), 50):
        corners = struct.unpack_from("<9f", bytes_, triangle + 12)
        struct.pack_into("<9f", bytes_, triangle + 12, *(1000 * x for x in corners))
    to.write_bytes(bytes_)


def check(program, folder, number, text, sets=()):
    scene = f"scene_{number}.toml"
    (folder / scene).write_text(text)
    options = [word for one in sets for word in ("--set", one)]
    done = subprocess.run([program, "check", scene, "--size", "160x90", *options], cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, "XDG_CACHE_HOME": str(folder / "cache"), "LC_ALL": "C.UTF-8"})
    return done.stderr.strip().splitlines()[-1] if done.returncode != 0 else ""


def faults_of_examples(program, folder):
    write_in_mm(ROOT / "scenes/meshes/drum.stl", folder / "drum.stl")
    write_in_mm(ROOT / "scenes/meshes/gate.stl", folder / "plate.stl")
    examples = []  # where it stands, what stands there, the scene, assignments
    for page in EXAMPLES:
        for kind, block in BLOCK.findall((GUIDES / page).read_text()):
            if kind == "toml":
                examples.append((page, block, whole_scene(block), ()))
    shipped = (ROOT / "scenes/wedge_segregation.toml").read_text()
    for span in re.findall(r"`((?:film\.[^`]*=)[^`]*)`", (GUIDES / "gallery.md").read_text()):
        sets = [f"{path}={value}" for path, value in ASSIGNED.findall(span) if value]
        examples.append(("gallery.md", span, shipped, sets))
    # A check mostly waits, so several run side by side. The first makes the caches for the others.
    check(program, folder, 0, shipped)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        faults = pool.map(lambda k: check(program, folder, k + 1, *examples[k][2:]), range(len(examples)))
    return len(examples), [f"docs/guide/{page}: {fault}\n{words}"
                           for (page, words, _, _), fault in zip(examples, faults) if fault]


def main():
    lacking, only_guides = not_shown()
    if sys.argv[2:] == ["--list"]:
        print(*only_guides, sep="\n")
        return
    with tempfile.TemporaryDirectory() as folder:
        count, faults = faults_of_examples(str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(folder))
    faults += [f"{key}: no scene of scenes/ has it, and no guide of docs/guide shows it" for key in lacking]
    if not count:
        faults.append("no example was found")
    if faults:
        sys.exit("\n".join(faults))
    print(f"all keys are shown, and {count} examples pass `check`")


if __name__ == "__main__":
    main()
