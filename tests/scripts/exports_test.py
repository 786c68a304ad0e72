#!/usr/bin/env python3
"""What `export` writes, as other programs read it: VTK, HDF5, ASE, gsd, MDAnalysis; and the script for Blender, with a stand-in
for Blender. Usage: exports_test.py PROGRAM. Readers that are missing are named and left out; `./test --peers` installs them.
Exit status 77: all of them are missing."""
import importlib
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest.mock
from pathlib import Path

SCENE = """
title = "A few"
[[species]]
name = "small"
count = 12
diameter = "4 mm"
density = 2500
[[species]]
name = "big one"
count = 3
diameter = "7 mm"
density = 3000
[container]
shape = "box"
width = "24 mm"
depth = "20 mm"
height = "60 mm"
[run]
duration = "0.04 s"
[output]
trajectory_interval = "0.02 s"
"""
FRAMES, COUNTS, RADII = 3, [12, 3], [2e-3, 3.5e-3]
LEFT_OUT = []


def expect(condition, what):
    if not condition:
        sys.exit(f"exports_test: {what}")


def module(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        LEFT_OUT.append(name)
        return None


def grains_of(table):
    """Places, radii, ids and species of the last moment of a CSV file, by rising id."""
    rows = [line.split(",") for line in table.read_text().splitlines()]
    rows = [dict(zip(rows[0], row)) for row in rows[1:]]
    last = max(float(row["time"]) for row in rows)
    rows = sorted((row for row in rows if float(row["time"]) == last), key=lambda row: int(row["id"]))
    return [(tuple(float(row[axis]) for axis in "xyz"), float(row["radius"]), int(row["id"]), int(row["type"])) for row in rows]


def expect_places(found, grains, tolerance, what):
    expect(len(found) == len(grains), f"{what}: {len(found)} grains, expected {len(grains)}")
    for place, (wanted, *_) in zip(found, grains):
        expect(math.dist(place, wanted) <= tolerance, f"{what}: a grain at {tuple(place)}, expected {wanted}")


def look_with_vtk(folder, grains):
    """Each grain is a ball of its size at its place; nothing else is as large as the unit balls of instances."""
    vtk = module("vtk")
    if not vtk:
        return
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(str(folder / "r.glb"))
    reader.Update()
    blocks = reader.GetOutput().NewIterator()
    balls = []
    while not blocks.IsDoneWithTraversal():
        data = blocks.GetCurrentDataObject()
        low_x, high_x, low_y, high_y, low_z, high_z = data.GetBounds()
        if data.GetNumberOfPoints() == 162:  # our spheres
            middle = ((low_x + high_x) / 2, -(low_z + high_z) / 2, (low_y + high_y) / 2)  # y is up in glTF
            balls.append((middle, (high_y - low_y) / 2))
        blocks.GoToNextItem()
    expect(len(balls) == len(grains), f"VTK: {len(balls)} balls in the .glb, expected {len(grains)}")
    for place, radius, *_ in grains:
        near = min(balls, key=lambda ball: math.dist(ball[0], place))
        expect(math.dist(near[0], place) < 0.02 * radius, f"VTK: no ball at {place}, the nearest at {near[0]}")
        expect(0.9 * radius < near[1] < 1.01 * radius, f"VTK: a ball of {near[1]} m, expected {radius}")


def expect_grains(found, grains, what):
    """found: place, radius, id and type of each, in any order."""
    expect(len(found) == len(grains), f"{what}: {len(found)} grains, expected {len(grains)}")
    for one, (place, radius, number, kind) in zip(sorted(found, key=lambda each: each[2]), grains):
        expect(math.dist(one[0], place) < 1e-6 and abs(one[1] - radius) < 1e-8 and one[2:] == (number, kind),
               f"{what}: a grain is {one}, expected {(place, radius, number, kind)}")


def look_with_vtkhdf(folder, grains):
    """The .vtkhdf by VTK's own reader: a block for grains and one for walls, and in each step its moment. The reader of
    ParaView 5.13, VTK 9.4, is the first for it (docs/guide/other-programs.md)."""
    vtk = module("vtk")
    version = vtk.vtkVersion().GetVTKVersion() if vtk else "0"
    if [int(part) for part in version.split(".")[:2]] < [9, 4]:
        LEFT_OUT.append(f"vtkHDFReader of VTK 9.4 (here is {version})")
        return
    reader = vtk.vtkHDFReader()
    expect(reader.CanReadFile(str(folder / "r.vtkhdf")), "VTK: cannot read r.vtkhdf")
    reader.SetFileName(str(folder / "r.vtkhdf"))
    reader.UpdateInformation()
    expect(reader.GetNumberOfSteps() == FRAMES, f"VTK: {reader.GetNumberOfSteps()} steps in r.vtkhdf")
    reader.SetStep(FRAMES - 1)
    reader.Update()
    expect(abs(reader.GetTimeValue() - 0.04) < 1e-3, f"VTK: the last step is at {reader.GetTimeValue()} s")
    blocks = reader.GetOutputDataObject(0)
    names = [blocks.GetMetaData(k).Get(vtk.vtkCompositeDataSet.NAME()) for k in range(blocks.GetNumberOfPartitionedDataSets())]
    expect(names[:2] == ["grains", "walls"], f"VTK: blocks {names}")
    bed = blocks.GetPartitionedDataSet(0).GetPartition(0)
    column = {name: bed.GetPointData().GetArray(name) for name in ("radius", "id", "type")}
    expect_grains([(bed.GetPoint(k), column["radius"].GetValue(k), int(column["id"].GetValue(k)), int(column["type"].GetValue(k)))
                   for k in range(bed.GetNumberOfPoints())], grains, "VTK: r.vtkhdf")
    low_x, high_x, low_y, high_y, *_ = blocks.GetPartitionedDataSet(1).GetPartition(0).GetBounds()
    expect(abs(high_x - low_x - 0.02) < 1e-6 and abs(high_y - low_y - 0.024) < 1e-6, "VTK: walls of another box in r.vtkhdf")


def look_with_hdf5(folder, grains):
    """The .vtkhdf as its specification says (VTK file formats, version 2.1), by offsets, without VTK."""
    netcdf = module("netCDF4")
    if not netcdf:
        return
    with netcdf.Dataset(str(folder / "r.vtkhdf")) as data:
        root = data["VTKHDF"]
        expect(root.Type == "PartitionedDataSetCollection" and list(root.Version) == [2, 1], "HDF5: another type of VTKHDF")
        bed, steps = root["grains"], root["grains"]["Steps"]
        expect(int(steps.NSteps) == FRAMES and abs(float(steps["Values"][-1]) - 0.04) < 1e-3, "HDF5: other steps")
        part = int(steps["PartOffsets"][-1])
        first, count = int(steps["PointOffsets"][-1]), int(bed["NumberOfPoints"][part])
        points = bed["Points"][first:first + count]

        def column(name):
            offset = int(steps["PointDataOffsets"][name][-1])
            return bed["PointData"][name][offset:offset + count]

        expect_grains([(tuple(map(float, place)), float(radius), int(number), int(kind)) for place, radius, number, kind
                       in zip(points, column("radius"), column("id"), column("type"))], grains, "HDF5: r.vtkhdf")
        for kind in ("grains", "walls"):
            expect(kind in root["Assembly"].groups and kind in root["Assembly"][kind].groups, f"HDF5: no {kind} in the assembly")


def look_with_ase(folder, grains):
    ase_io = module("ase.io")
    if not ase_io:
        return
    for name, form, tolerance in (("r.xyz", "extxyz", 1e-9), ("r.dump", "lammps-dump-text", 1e-9), ("r.nc", "netcdftrajectory", 1e-9)):
        frames = ase_io.read(str(folder / name), index=":", format=form)
        expect(len(frames) == FRAMES, f"ASE: {len(frames)} frames in {name}")
        expect_places(frames[-1].get_positions(), grains, tolerance, f"ASE: {name}")
    last = ase_io.read(str(folder / "r.xyz"), index=-1, format="extxyz")
    expect([int(i) for i in last.arrays["id"]] == [one[2] for one in grains], "ASE: other ids in r.xyz")
    expect(all(abs(a - one[1]) < 1e-9 for a, one in zip(last.arrays["radius"], grains)), "ASE: other radii in r.xyz")


def look_with_gsd(folder, grains):
    gsd = module("gsd.hoomd")
    if not gsd:
        return
    frames = gsd.open(str(folder / "r.gsd"))
    expect(len(frames) == FRAMES, f"gsd: {len(frames)} frames")
    last = frames[-1].particles
    expect(list(last.types) == ["small", "big one"], f"gsd: types {last.types}")
    expect([int(t) + 1 for t in last.typeid] == [one[3] for one in grains], "gsd: other types of grains")
    expect(all(abs(d / 2 - one[1]) < 1e-8 for d, one in zip(last.diameter, grains)), "gsd: other diameters")
    expect_places(last.position, grains, 1e-7, "gsd")


def look_with_mdanalysis(folder, grains):
    mda = module("MDAnalysis")
    if not mda:
        return
    data = mda.Universe(str(folder / "r.data"), format="DATA", atom_style="id type diameter density x y z")
    expect_places(data.atoms.positions, grains, 1e-7, "MDAnalysis: r.data")
    # The guide's command: frames of nothing but the nine lines that MDAnalysis counts.
    plain = subprocess.run(["sed", "/^ITEM: UNITS/,+1d; /^ITEM: TIME$/,+1d", folder / "r.dump"], capture_output=True, text=True, check=True)
    (folder / "plain.dump").write_text(plain.stdout)
    dump = mda.Universe(str(folder / "plain.dump"), format="LAMMPSDUMP")
    expect(len(dump.trajectory) == FRAMES, f"MDAnalysis: {len(dump.trajectory)} frames in plain.dump")
    dump.trajectory[-1]
    low = (folder / "plain.dump").read_text().split("ITEM: BOX BOUNDS")[-1].splitlines()[1:4]
    corner = [float(line.split()[0]) for line in low]  # MDAnalysis moves it to 0
    expect_places([[a + b for a, b in zip(place, corner)] for place in dump.atoms.positions], grains, 1e-7, "MDAnalysis: plain.dump")
    # The ids of both files are the same, so that read_dump finds the atoms of read_data.
    expect(sorted(int(i) for i in data.atoms.ids) == list(range(1, len(grains) + 1)), f"MDAnalysis: ids {data.atoms.ids}")


def run_script_of_blender(folder, parts, new):
    """Runs bed.py with a stand-in for Blender whose node trees have these parts alone. Returns the tree."""
    tree = unittest.mock.MagicMock(spec_set=parts)
    tree.nodes.new.return_value.outputs.__iter__.side_effect = lambda: iter([unittest.mock.MagicMock()])
    bpy = unittest.mock.MagicMock()
    bpy.data.node_groups.new.return_value = tree
    bpy.context.scene.frame_current = 0
    vectors = unittest.mock.MagicMock()
    with unittest.mock.patch.dict(sys.modules, {"bpy": bpy, "mathutils": vectors}), unittest.mock.patch.object(sys, "argv", ["blender"]):
        script = folder / "r-blender/bed.py"
        exec(compile(script.read_text(), str(script), "exec"), {"__file__": str(script), "__name__": "__main__"})
    expect(bool(new(tree)), f"Blender: a tree with {parts} got no sockets")
    return tree


class Vector(tuple):
    """As much of Blender's vectors as bed.py uses."""
    x, y, z = (property(lambda self, k=k: self[k]) for k in range(3))

    def __add__(self, other):
        return Vector(a + b for a, b in zip(self, other))

    def __mul__(self, number):
        return Vector(number * a for a in self)

    __rmul__ = __mul__

    def __neg__(self):
        return -1 * self

    def __sub__(self, other):
        return self + -Vector(other)

    def dot(self, other):
        return sum(a * b for a, b in zip(self, other))

    def cross(self, other):
        (a, b, c), (d, e, f) = self, other
        return Vector((b * f - c * e, c * d - a * f, a * e - b * d))

    def normalized(self):
        length = math.sqrt(self.dot(self))
        return self * (1 / length) if length > 0 else self  # a face without area has no normal

    def to_track_quat(self, *_):
        return unittest.mock.MagicMock()


class Wall:
    """A mesh of triangles as Blender has it."""
    def __init__(self, name):
        self.name, self.polygons, self.materials = name, [], []

    def from_pydata(self, vertices, _, triangles):
        for corners in triangles:
            a, b, c = (Vector(vertices[k]) for k in corners)
            self.polygons.append(unittest.mock.Mock(center=(a + b + c) * (1 / 3), normal=(b - a).cross(c - a).normalized()))

    def __getattr__(self, name):
        return unittest.mock.MagicMock()


def look_at_blenders_picture(folder):
    """The walls between camera and bed are clear and all others solid, a ground lies below all, and a wide lamp shines."""
    bpy, vectors, objects = unittest.mock.MagicMock(), unittest.mock.MagicMock(Vector=Vector), []
    bpy.context.scene.frame_current = 0
    tree = bpy.data.node_groups.new.return_value
    tree.nodes.new.return_value.outputs.__iter__.side_effect = lambda: iter([unittest.mock.MagicMock()])
    bpy.data.meshes.new.side_effect = Wall
    bpy.data.objects.new.side_effect = lambda name, data: objects.append(unittest.mock.MagicMock(data=data)) or objects[-1]
    with unittest.mock.patch.dict(sys.modules, {"bpy": bpy, "mathutils": vectors}), unittest.mock.patch.object(sys, "argv", ["blender"]):
        script, world = folder / "r-blender/bed.py", {"__name__": "__main__"}
        exec(compile(script.read_text(), str(script), "exec"), {"__file__": str(script)} | world)
    head = json.loads((folder / "r-blender/bed.json").read_text())
    walls = [one.data for one in objects if isinstance(one.data, Wall) and one.data.polygons]
    expect(len(walls) == len(head["walls"]), f"Blender: {len(walls)} walls")
    camera = next(one for one in objects if isinstance(one.location, Vector))
    corners = [Vector(corner) for wall in head["walls"] for corner in wall["vertices"]]
    middle = sum(corners, Vector((0, 0, 0))) * (1 / len(corners))
    def outside(face):  # > 0 where the camera is on the outer side of a face
        outward = face.normal if face.normal.dot(face.center - middle) > 0 else -face.normal
        return outward.dot(camera.location - face.center)

    faces = [face for wall in walls for face in wall.polygons]
    clear = [face for face in faces if face.material_index == 1]
    expect(clear and min(map(outside, clear)) > 0, f"Blender: {len(clear)} clear triangles")
    behind = [face for face in faces if outside(face) < 0]
    expect(len(behind) >= 4 and not any(face.material_index for face in behind), "Blender: walls behind the bed are clear")
    expect(any(call.args[1] == "AREA" for call in bpy.data.lights.new.call_args_list), "Blender: no wide lamp")
    ground = bpy.ops.mesh.primitive_plane_add.call_args.kwargs["location"][2]
    lowest = min(corner.z for corner in corners)
    expect(lowest - 0.01 < ground <= lowest, f"Blender: the ground at {ground} m, the lowest wall at {lowest} m")


def look_as_blender(folder, grains):
    if not module("numpy"):
        return
    look_at_blenders_picture(folder)
    # Before 4.0 a tree has inputs and outputs, and since then an interface.
    run_script_of_blender(folder, ["inputs", "outputs", "nodes", "links"], lambda tree: tree.inputs.new.called and tree.outputs.new.called)
    tree = run_script_of_blender(folder, ["interface", "nodes", "links"], lambda tree: tree.interface.new_socket.called)
    ways = {call.kwargs["in_out"] for call in tree.interface.new_socket.call_args_list}
    expect(ways == {"INPUT", "OUTPUT"}, f"Blender: sockets {ways}")
    expect(json.loads((folder / "r-blender/bed.json").read_text())["frames"][-1]["grains"] == len(grains), "Blender: other grains")


def main():
    program = os.path.abspath(sys.argv[1])
    readers = [look_with_vtk, look_with_vtkhdf, look_with_hdf5, look_with_ase, look_with_gsd, look_with_mdanalysis, look_as_blender]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "s.toml").write_text(SCENE)
        quiet = {"cwd": folder, "check": True, "capture_output": True}
        subprocess.run([program, "movie", "s.toml", "--out", "r", "--no-film", "--no-report", "--threads", "1"], **quiet)
        for form in ("csv", "gltf", "xyz", "lammps-dump", "lammps-data", "netcdf", "gsd", "blender", "vtkhdf"):
            subprocess.run([program, "export", "r", "--to", form], **quiet)
        grains = grains_of(folder / "r.csv")
        expect([sum(one[3] == s + 1 for one in grains) for s in (0, 1)] == COUNTS, "the run has other grains")
        for reader in readers:
            reader(folder, grains)
    if len(LEFT_OUT) == len(readers):
        print("skipped: none of the readers is installed")
        sys.exit(77)
    print("left out: " + ", ".join(LEFT_OUT) if LEFT_OUT else "all readers were there")


if __name__ == "__main__":
    main()
