#!/usr/bin/env python3
"""Counts how many .cpp files of engine and render see each header, by following includes from file to file. A header
that is seen by more than half of them makes a change to it as long as a new build, so few should be.

usage: headers.py [--all] [HEADER...]
    Without HEADER: the headers that more than half of the .cpp files see, and how many .cpp files outside engine/mesh
    see headers of that room.
    --all     all headers, not only those that more than half see
    HEADER    which headers and .cpp files include this one, and how many .cpp files would see it no more if that one
              did not include it
"""
import re
import subprocess
import sys
from pathlib import Path

TREE = Path(__file__).resolve().parents[2]
MESHES = "engine/mesh/"  # the room of surfaces, which few files outside should see
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def tree_files():
    """Paths of the C++ files of engine and render that git knows, or that are new and not ignored."""
    listed = subprocess.run(
        ["git", "-C", TREE, "ls-files", "-co", "--exclude-standard", "engine", "render"], check=True, capture_output=True, text=True
    ).stdout.split()
    return sorted({name for name in listed if name.endswith((".cpp", ".hpp")) and (TREE / name).exists()})


def included_by(files):
    """For each file, the files of ours that it includes by itself. Public headers are named from their own folder."""
    roots = ("", "engine/library/", "render/library/")
    known = set(files)
    direct = {}
    for name in files:
        direct[name] = set()
        for wanted in INCLUDE.findall((TREE / name).read_text()):
            beside = f"{Path(name).parent.as_posix()}/{wanted}"
            for candidate in [beside] + [root + wanted for root in roots]:
                if candidate in known:
                    direct[name].add(candidate)
                    break
    return direct


def seen_from(start, direct, without=None):
    """All headers that a file sees. `without` is a pair (file, header): this one include is passed over."""
    seen, waiting = set(), [start]
    while waiting:
        name = waiting.pop()
        for header in direct[name]:
            if header not in seen and (name, header) != without:
                seen.add(header)
                waiting.append(header)
    return seen


def watchers(header, sources, direct, without=None):
    return [source for source in sources if header in seen_from(source, direct, without)]


def explain(header, sources, direct):
    seen_by = watchers(header, sources, direct)
    print(f"{header}: {len(seen_by)} of {len(sources)} .cpp files see it")
    ways = []
    for name in sorted(direct):
        if header in direct[name]:
            through = sum(name == source or name in seen_from(source, direct) for source in seen_by)
            lost = len(seen_by) - len(watchers(header, seen_by, direct, (name, header)))
            ways.append((lost, through, name))
    for lost, through, name in sorted(ways, reverse=True):
        print(f"  {lost:4} less without the include in {name} ({through} see that one)")


def main():
    options = [word for word in sys.argv[1:] if word.startswith("--")]
    wanted = [word for word in sys.argv[1:] if not word.startswith("--")]
    if set(options) - {"--all"}:
        sys.exit(__doc__)
    files = tree_files()
    direct = included_by(files)
    sources = [name for name in files if name.endswith(".cpp")]
    for header in wanted:
        if header not in direct:
            sys.exit(f"{header}: no such header in engine or render; give its path from the top of the tree")
        explain(header, sources, direct)
    if wanted:
        return
    counts = dict.fromkeys((name for name in files if name.endswith(".hpp")), 0)
    for source in sources:
        for header in seen_from(source, direct):
            counts[header] += header in counts
    over = {header: count for header, count in counts.items() if 2 * count > len(sources)}
    for header, count in sorted((counts if options else over).items(), key=lambda entry: (-entry[1], entry[0])):
        print(f"{count:4} {header}")
    print(f"{len(over)} headers are seen by more than half of the {len(sources)} .cpp files of engine and render")
    outside = [name for name in sources if not name.startswith(MESHES)]
    room = [header for header in counts if header.startswith(MESHES)]
    for header in sorted(room):
        seen_by = watchers(header, outside, direct)
        if seen_by:
            print(f"{len(seen_by):4} .cpp files outside {MESHES} see {header}")
    any_of = [name for name in outside if not seen_from(name, direct).isdisjoint(room)]
    print(f"{len(any_of)} .cpp files outside {MESHES} see a header of that room")


if __name__ == "__main__":
    main()
