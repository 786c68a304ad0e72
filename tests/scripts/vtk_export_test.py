#!/usr/bin/env python3
"""What `export --to vtk` writes, as VTK sees it. Usage: vtk_export_test.py PROGRAM. Exit status 77: VTK is missing."""
import math
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

# A bed that comes to rest in a box without a drive: then the forces on every grain carry its weight.
SCENE = """
title = "At rest"
gravity = 9.81
[[species]]
name = "small"
count = 40
diameter = "4 mm"
density = 2500
[[species]]
name = "big one"
count = 8
diameter = "7 mm"
density = 3000
[contact]
law = "spring-dashpot"
restitution = 0.3
friction = 0.4
[container]
shape = "box"
width = "24 mm"
depth = "20 mm"
height = "60 mm"
[run]
duration = "0.6 s"
[output]
contacts = true
trajectory_interval = "0.1 s"
[output.fields]
grid = "xyz"
interval = "0.3 s"
"""
SPECIES = ["small", "big one"]
DIAMETERS, COUNTS, DENSITIES = [4e-3, 7e-3], [40, 8], [2500, 3000]
VOLUMES = [math.pi / 6 * d**3 for d in DIAMETERS]
FRAMES, DEPTH, WIDTH, HEIGHT, GRAVITY = 7, 20e-3, 24e-3, 60e-3, 9.81


def expect(condition, what):
    if not condition:
        sys.exit(f"vtk_export_test: {what}")


def close(value, wanted, tolerance, what):
    expect(abs(value - wanted) <= tolerance, f"{what}: {value}, expected {wanted} within {tolerance}")


def collection(path):
    return [(float(one.get("timestep")), path.parent / one.get("file")) for one in xml.parse(path).iter("DataSet")]


def read(path):
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader

    reader = vtkXMLImageDataReader() if path.suffix == ".vti" else vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    expect(reader.GetErrorCode() == 0, f"{path.name}: error {reader.GetErrorCode()}")
    return reader.GetOutput()


def rows(data, name):
    array = data.GetArray(name)
    expect(array is not None, f"there is no array {name}")
    return [array.GetTuple(k) for k in range(array.GetNumberOfTuples())]


def words(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    expect(array is not None, f"there are no words {name}")
    return [array.GetValue(k) for k in range(array.GetNumberOfValues())]


def check_grains(data, time):
    expect(data.GetNumberOfPoints() == sum(COUNTS), f"{data.GetNumberOfPoints()} grains")
    expect(data.GetNumberOfVerts() == sum(COUNTS), "a vertex for each grain")
    expect(words(data, "species") == SPECIES, f"names {words(data, 'species')}")
    close(data.GetFieldData().GetArray("TimeValue").GetValue(0), time, 1e-12, "TimeValue")
    values = data.GetPointData()
    types = [int(t[0]) for t in rows(values, "type")]
    expect([types.count(1), types.count(2)] == COUNTS, "types count from 1")
    expect(sorted(int(i[0]) for i in rows(values, "id")) == list(range(sum(COUNTS))), "ids")
    volume = sum(4 / 3 * math.pi * r[0] ** 3 for r in rows(values, "radius"))
    close(volume, sum(c * v for c, v in zip(COUNTS, VOLUMES)), 1e-12 * volume, "volume of all grains")
    for name in ("velocity", "omega", "force"):
        expect(values.GetArray(name).GetNumberOfComponents() == 3, f"{name} is a vector")


# Newton: the contact forces on a grain at rest are minus its weight. What is left moves it, or the step rounds away.
def check_forces(data):
    values = data.GetPointData()
    total = [0.0, 0.0, 0.0]
    for (kind,), force in zip(rows(values, "type"), rows(values, "force")):
        weight = DENSITIES[int(kind) - 1] * VOLUMES[int(kind) - 1] * GRAVITY
        for axis, part in enumerate((0, 0, weight)):
            close(force[axis], part, 0.02 * weight, "force on a grain at rest")
            total[axis] += force[axis]
    weight = GRAVITY * sum(c * v * d for c, v, d in zip(COUNTS, VOLUMES, DENSITIES))
    for axis, part in enumerate((0, 0, weight)):
        close(total[axis], part, 0.01 * weight, "force on all grains")


def check_contacts(data, grains):
    values, places = data.GetCellData(), {}
    ids, radii = rows(grains.GetPointData(), "id"), rows(grains.GetPointData(), "radius")
    for k, (number,) in enumerate(ids):
        places[int(number)] = (grains.GetPoint(k), radii[k][0])
    expect(data.GetNumberOfLines() == data.GetNumberOfCells() > 0, "contacts are lines")
    normal, tangential, force = (rows(values, name) for name in ("normal_force", "tangential_force", "force"))
    first, second, walls = (rows(values, name) for name in ("id1", "id2", "to_wall"))
    to_walls = 0
    for k in range(data.GetNumberOfCells()):
        begin, end = (data.GetPoint(data.GetCell(k).GetPointId(j)) for j in (0, 1))
        place, radius = places[int(first[k][0])]
        close(math.dist(begin, place), 0, 1e-15, "a line begins at a grain's centre")
        length = math.dist(begin, end)
        if walls[k][0] == 0:
            place, other = places[int(second[k][0])]
            close(math.dist(end, place), 0, 1e-12, "a line ends at a grain's centre")
            close(length, radius + other, 0.02 * (radius + other), "length of a line")
        else:
            to_walls += 1
            expect(second[k][0] < 0, "a wall's number is below 0")
            close(length, radius, 0.02 * radius, "way to a wall")
        along = [normal[k][0] * (e - b) / length for b, e in zip(begin, end)]
        for axis in range(3):
            close(force[k][axis], along[axis] + tangential[k][axis], 1e-6 * normal[k][0] + 1e-12, "force of a line")
    expect(to_walls > 0, "the floor carries something")


def check_walls(data):
    bounds = data.GetBounds()
    wanted = (-DEPTH / 2, DEPTH / 2, -WIDTH / 2, WIDTH / 2, 0)
    for k, value in enumerate(wanted):
        close(bounds[k], value, 1e-6, "bounds of the walls")
    expect(bounds[5] >= HEIGHT - 1e-6, "height of the walls")
    expect(len(words(data, "walls")) >= 5, "names of the walls")


def check_fields(path):
    records = collection(path)
    expect(len(records) == 2, f"{len(records)} records of fields")
    close(records[0][0], 0.15, 1e-3, "middle of the first record")
    close(records[1][0], 0.45, 1e-3, "middle of the second record")
    for _, file in records:
        image = read(file)
        values = image.GetCellData()
        density, room = rows(values, "density"), rows(values, "free_volume")
        mass = sum(c * v * d for c, v, d in zip(COUNTS, VOLUMES, DENSITIES))
        close(sum(d[0] * r[0] for d, r in zip(density, room) if math.isfinite(d[0])), mass, 1e-9 * mass, "mass")
        expect(values.GetArray("velocity").GetNumberOfComponents() == 3, "velocity is a vector")
        expect(values.GetArray("contact_stress").GetNumberOfComponents() == 9, "stress is a tensor")
        bounds = image.GetBounds()
        for k, value in enumerate((-DEPTH / 2, DEPTH / 2, -WIDTH / 2, WIDTH / 2)):
            expect(abs(bounds[k]) >= abs(value) - 1e-9, "the grid covers the container")


def main(program):
    try:
        import vtkmodules.vtkIOXML  # noqa: F401
    except ImportError:
        print("python3-vtk9 is missing")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        scene, run, made = Path(folder) / "rest.toml", Path(folder) / "run", Path(folder) / "made"
        scene.write_text(SCENE)
        subprocess.run([program, "movie", scene, "--out", run, "--no-film", "--no-report", "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
        subprocess.run([program, "export", run, "--to", "vtk", "--out", made, "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
        grains, contacts, walls = (collection(made / f"{name}.pvd") for name in ("grains", "contacts", "walls"))
        # Moments lie on steps.
        expect(len(grains) == FRAMES, f"{len(grains)} frames")
        for k, (time, _) in enumerate(grains):
            close(time, 0.1 * k, 1e-4, "time of a frame")
        expect(len(contacts) == len(walls) == FRAMES, "contacts and walls at each moment")
        for (time, file), (_, lines), (_, surfaces) in zip(grains, contacts, walls):
            frame = read(file)
            check_grains(frame, time)
            check_contacts(read(lines), frame)
            check_walls(read(surfaces))
        check_forces(read(grains[-1][1]))
        check_fields(made / "fields.pvd")
        expect(len(collection(made / "run.pvd")) == 3 * FRAMES, "run.pvd has all parts")


if __name__ == "__main__":
    main(sys.argv[1])
