#!/usr/bin/env python3
"""Holds the order of the rooms: what the first table of docs/architecture.md lists, each room after those it may
include. It fails where a file lies in no room, where an #include goes to a room further down the table, and where
folders include each other in a ring (a folder and what lies in it are no two). No file is excepted.

usage: rooms_test.py [TREE]     (the tree that it lies in, if none is named)
"""
import collections
import pathlib
import re
import sys

SOURCES = ("engine", "render")
INCLUDE = re.compile(r'^\s*#\s*include\s+"((?:engine|render)/[^"]+)"', re.MULTILINE)


def rooms_of(page):
    """The rooms as the page's first table of folders lists them."""
    rooms = re.findall(r"^\| `((?:engine|render)(?:/\w+)?)` \|", page.read_text(), re.MULTILINE)
    for room in rooms:
        if rooms.count(room) > 1:
            sys.exit(f"{page}: lists {room} twice")
    return rooms


def includes_of(tree):
    """(file, what it includes), for all C++ files."""
    for top in SOURCES:
        for file in sorted((tree / top).rglob("*.[ch]pp")):
            for target in INCLUDE.findall(file.read_text()):
                yield str(file.relative_to(tree)), target


def room_of(file):
    """engine/scene/keys/x.hpp is in engine/scene, engine/frame.hpp in engine."""
    return "/".join(file.split("/")[:-1][:2])


def folder_of(file):
    return file.rpartition("/")[0]


def inside(one, other):
    return one.startswith(other + "/") or other.startswith(one + "/")


def graph_of(includes):
    """Folder by folder, where its includes go, with one of them for each."""
    graph = collections.defaultdict(dict)
    for file, target in includes:
        one, other = folder_of(file), folder_of(target)
        if one != other and not inside(one, other):
            graph[one].setdefault(other, f"{file} includes {target}")
    return graph


def reach_of(graph, start):
    """For each folder that includes lead to from `start`, the one before it on the way."""
    before, ahead = {}, collections.deque([start])
    while ahead:
        here = ahead.popleft()
        for there in graph.get(here, ()):
            if there not in before:
                before[there] = here
                ahead.append(there)
    return before


def rings_of(graph):
    """One shortest ring for each set of folders that include each other, as the includes of its way."""
    rings = {}
    for start in sorted(graph):
        before = reach_of(graph, start)
        if start not in before:
            continue
        ring, here = [start], start
        while before[here] != start:
            here = before[here]
            ring.append(here)
        way = [start, *reversed(ring[1:]), start]
        rings.setdefault(frozenset(ring), [graph[a][b] for a, b in zip(way, way[1:])])
    return list(rings.values())


def main():
    tree = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
    page = tree / "docs" / "architecture.md"
    rooms = rooms_of(page)
    faults = [f"{room} is in the table of {page.name}, but is no folder" for room in rooms if not (tree / room).is_dir()]
    files = [str(f.relative_to(tree)) for top in SOURCES for f in (tree / top).rglob("*.[ch]pp")]
    strange = sorted({room_of(f) for f in files} - set(rooms))
    faults += [f"{room} is in no row of the table of {page.name}" for room in strange]
    includes = list(includes_of(tree))
    order = {room: place for place, room in enumerate(rooms)}
    for file, target in includes:
        one, other = room_of(file), room_of(target)
        if one in order and other in order and order[one] < order[other]:
            faults.append(f"{file} includes {target}, which is further down: {other} comes after {one}")
    for ring in rings_of(graph_of(includes)):
        faults.append("folders include each other:\n    " + "\n    ".join(ring))
    for fault in faults:
        print(fault)
    print(f"{len(files)} files, {len(rooms)} rooms, {len(includes)} includes, {len(faults)} faults")
    if not files or len(rooms) < 2:
        sys.exit("nothing to look at")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
