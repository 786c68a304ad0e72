#!/usr/bin/env python3
"""The Python module grainreel: thirty lines that users would write (python_lines.py), misuse (python_misuse.py), and the
code blocks of docs/guide/python.md. Usage: python_test.py PROGRAM.

Exit status 77: xarray, numpy or a reader of NetCDF is missing.
"""
import os
import re
import struct
import subprocess
import sys
import tempfile
import threading
import warnings
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "render/package/python"))
try:
    import netCDF4  # noqa: F401
    import numpy
    import xarray  # noqa: F401
except ImportError as missing:
    print(f"python_test: skipped, {missing}; on Debian: apt-get install python3-xarray python3-netcdf4")
    sys.exit(77)
import grainreel  # noqa: E402
import python_lines  # noqa: E402
import python_misuse  # noqa: E402
from grainreel._data import unit_of  # noqa: E402

SCENE = (ROOT / "tests/data/scenes/fifty.toml").read_text()


def expect(holds, what):
    if not holds:
        sys.exit(f"python_test: {what}")


def mistake_of(call):
    try:
        call()
    except grainreel.GrainreelError as error:
        return str(error)
    return "no mistake"


# ---- pictures


def guess_of(kind, left, up, corner):
    if kind == 4:
        base = left + up - corner
        return min((abs(base - left), 0, left), (abs(base - up), 1, up), (abs(base - corner), 2, corner))[2]
    return (0, left, up, (left + up) // 2)[kind]


def read_png(data):
    """By the definition of the filters (PNG, W3C 2003)."""
    place, packed, head = 8, b"", None
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        expect(struct.unpack(">I", data[place + 8 + length:place + 12 + length])[0] == zlib.crc32(kind + body), "a checksum")
        head, packed = (struct.unpack(">IIBBBBB", body) if kind == b"IHDR" else head,
                        packed + (body if kind == b"IDAT" else b""))
        place += 12 + length
    width, height, bits, colour, *rest = head
    expect(bits == 8 and rest == [0, 0, 0], f"the head of a PNG file is {head}")
    channels = {2: 3, 6: 4}[colour]
    row_bytes = width * channels
    rows, above, lines = zlib.decompress(packed), [0] * row_bytes, []
    for y in range(height):
        kind, line = rows[y * (row_bytes + 1)], []
        for i, byte in enumerate(rows[y * (row_bytes + 1) + 1:(y + 1) * (row_bytes + 1)]):
            left, corner = (line[i - channels], above[i - channels]) if i >= channels else (0, 0)
            line.append((byte + guess_of(kind, left, above[i], corner)) % 256)
        above = line
        lines.append(above)
    return numpy.array(lines, numpy.uint8).reshape(height, width, -1)


def check_pictures():
    for channels in (3, 4):
        picture = numpy.random.default_rng(1).integers(0, 256, (10, 7, channels), dtype=numpy.uint8)
        written = picture.view(grainreel.Picture)
        expect((read_png(written._repr_png_()) == picture).all(), f"a picture of {channels} channels is written wrongly")
        written.save("picture.png")
        expect(Path("picture.png").read_bytes() == written.png(), "save() writes another picture")
        for part in (written[0], written.astype(float), written[:0], written.mean()):
            expect(not hasattr(part, "_repr_png_") or part._repr_png_() is None, "numbers are shown as a picture")


# ---- runs


def check_run(program):
    seen = []
    run = grainreel.run("scene.toml", out="run", program=program, progress=seen.append, threads=1,
                        output__contacts=True, set={"output.orientation": True})
    expect(run.record["status"] == "complete", "the run is not complete")
    expect(seen and seen[-1]["stage"] == "vibrating" and seen[-1]["done"] == 1, f"the last progress is {seen[-1:]}")
    measures = run.measures
    rows = (run.path / "measures.csv").read_text().splitlines()
    expect(measures.sizes["time"] == len(rows) - 1, "measures have not as many rows as their file")
    last = dict(zip(rows[0].split(","), rows[-1].split(",")))
    expect(float(measures.kinetic_J[-1]) == float(last["kinetic_J"]), "the last kinetic energy is not the file's")
    expect(float(measures.time[-1]) == float(last["time_s"]), "the last time is not the file's")
    units = {name: measures[name].attrs["units"] for name in measures.variables}
    expect(units["kinetic_J"] == "J" and units["time"] == "s" and units["lacey"] == "1" and
           units["big_height_m"] == "m" and units["drive_frequency_Hz"] == "Hz", f"units are {units}")
    # The units of all columns are those of the documentation.
    written = {"N m": "N.m", "degrees": "degree", "turns, 0 to 1": "turn", "periods": "1"}
    table = (ROOT / "docs/reference/measures.md").read_text().split("table of columns: ")[1]
    rows = re.findall(r"^\| `(\w[\w.]*)`[^|]* \| ([^|]+) \|", table, re.M)
    expect(len(rows) > 40, f"{len(rows)} columns are documented")
    for name, unit in rows:
        expect("," in unit and unit not in written or unit_of(name) == written.get(unit, unit),
               f"the unit of {name} is {unit_of(name)}, and {unit} in the documentation")
    trajectory = run.trajectory
    expect(trajectory.coordinates.dims == ("frame", "atom", "spatial"), f"dims: {trajectory.coordinates.dims}")
    expect(trajectory.coordinates.attrs["units"] == "m" and trajectory.time.attrs["units"] == "s", "units of frames")
    expect(list(trajectory.spatial.values) == ["x", "y", "z"], "the axes have no names")
    height = float(trajectory.coordinates.isel(frame=-1).sel(spatial="z").max())
    expect(0 < height < 0.04, f"the highest centre is at {height} m")
    expect("orientation" in trajectory, "set= was not heeded")
    expect(not [name for name in trajectory.variables if "checksum" in name], "checksums are shown")
    # Contacts that carry force are those that the frames count, each at both of its grains.
    contacts = run.contacts
    of_last = contacts.where(contacts.frame == trajectory.sizes["frame"] - 1, drop=True)
    touches = int((of_last["second"] >= 0).sum() + (of_last["first"] >= 0).sum())
    expect(int(trajectory.contact_number.isel(frame=-1).sum()) == touches, "contacts and frames do not agree")
    expect(float(of_last.time[0]) == float(trajectory.time[-1]), "contacts have another time than their frame")
    expect("is not there; run the scene with output.fields.grid" in mistake_of(lambda: run.fields), "fields are there")
    picture = grainreel.render(run, at=0.1, size="160x120", program=program)
    expect(picture.shape == (120, 160, 3) and picture.dtype == numpy.uint8 and picture.std() > 10, "no picture")
    command = [program, "render", "run", "--at", "0.1", "--size", "160x120", "--out", "at.png", "--quiet"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    for again in (picture, grainreel.render(run, at=0.1, size="160x120", program=program)):
        expect((read_png(Path("at.png").read_bytes()) == again).all(), "render() and the program draw different pictures")
    expect((run.render(cycle=1, phase=0.5, size="160x120") == run.render(at=0.075, size="160x120")).all(),
           "half a period after the first is not 0.075 s")
    pale = grainreel.render(run.path, size=(160, 120), program=program, transparent=True)
    expect(pale.shape == (120, 160, 4), f"a transparent picture has the shape {pale.shape}")
    check_frames(run)
    check_own_colours(run)
    check_empty_frames()
    check_warnings()
    # A file of another program: its last moment too. A grain that moves to the other side of the picture shows which.
    Path("two.xyz").write_text("".join(
        f'1\nLattice="4 0 0 0 4 0 0 0 4" Properties=species:S:1:pos:R:3:radius:R:1 Time={time}\nA 2 {y} 2 0.5\n'
        for time, y in ((0, 0.5), (1, 3.5))))
    last, first = (grainreel.render("two.xyz", size="160x120", program=program, words="none", **how)
                   for how in ({}, {"at": 0}))
    expect((last == grainreel.render("two.xyz", size="160x120", program=program, words="none", at=1)).all(),
           "without a moment a file's last one is not drawn")
    expect((last != first).any(), "two moments of a file have the same picture")
    run.close()


def check_frames(run):
    """A frame has the numbers of the trajectory, its parts those of the vectors, and its rows are the grains."""
    trajectory = run.trajectory
    for part, (vector, axis) in {"x": ("coordinates", 0), "vz": ("velocities", 2), "wy": ("spin", 1)}.items():
        expect((trajectory[part].values == trajectory[vector].values[..., axis]).all(), f"{part} is another")
        expect(trajectory[part].attrs["units"] == trajectory[vector].attrs["units"], f"{part} has another unit")
    kinds = numpy.array(["small", "big"])[trajectory.type.values - 1]  # of each frame
    expect(trajectory.species.dims == ("atom",) and (trajectory.species.values == kinds).all(),
           "the species have other names than their numbers")
    expect((trajectory.species[3:5].values == kinds[0, 3:5]).all(), "a part of the species is another")
    expect((trajectory.sel(id=[7, 3]).z.values == trajectory.z.values[:, [7, 3]]).all(), "grains by id are others")
    expect(list(run[1:3][1].z.values) == list(trajectory.z.values[2]), "a slice has other frames")
    contacts = run.contacts
    expect((contacts.z.values == contacts.point.values[:, 2]).all(), "z of contacts is another")
    table = run.to_dataframe()
    expect(list(table.groupby("frame").z.max()) == list(trajectory.z.max("atom").values), "the table has other grains")
    expect(abs(float(run.sel(time="100 ms").time) - 0.1) < 1e-3, "a time with a unit finds another frame")
    inside = [float(time) for time in run.time if 0.04 <= time <= 0.16]
    expect([float(frame.time) for frame in run.sel(time=slice(0.04, "160 ms"))] == inside, "a slice has other times")
    expect(0 < len(inside) < len(run) == len(run.sel(time=slice(None))), "a slice of times has all frames")


def check_warnings():
    """What a picture cannot show is a warning at the user's line, and names the user's file."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        grainreel.render("run/trajectory.nc", at=0.12)
    words = [str(each.message) for each in told]  # of a file alone its guess is told too
    expect(len(told) == 2 and {each.filename for each in told} == {__file__} and "says no density" in words[0] and
           "run/trajectory.nc" in words[1] and "0.12 s was not kept" in words[1], f"warnings are {words}")


def check_empty_frames():
    """A run into which grains fall: its first frame has none, and no frame has more than are there."""
    run = grainreel.run(ROOT / "tests/data/scenes/fed.toml", out="fed", run__duration="0.1 s", threads=1,
                        output__fields__grid="yz", output__contacts=True)
    counts = [frame.sizes["atom"] for frame in run]
    expect(counts[0] == 0 and counts == list(run.trajectory.grains.values), f"frames have {counts} grains")
    expect(len(run.to_dataframe()) == sum(counts), "the table has places without grains")
    climbed = run[-1].z - run[2].z  # of the grains that both have
    expect(list(climbed.id.values) == list(run[2].id.values), f"{climbed.sizes} of {counts} grains are compared")
    grain = int(run[2].id[3])
    expect(float(climbed.sel(id=grain)) == float(run[-1].sel(id=grain).z) - float(run[2].z[3]), "grains are mixed up")
    path = run.trajectory.sel(id=grain)
    expect(float(path.z[-1]) == float(run[-1].sel(id=grain).z) and str(path.species.values) == "glass", "a grain's way")
    fields = run.to_dataframe("fields")
    points = int(numpy.prod([run.fields.sizes[name] for name in ("time", "y", "z")]))
    expect(len(fields) == points and {"time", "y", "z", "density"} <= set(fields), f"{len(fields)} of {points} points")
    expect(len(run.to_dataframe("contacts")) == run.contacts.sizes["row"], "the table has other contacts")
    expect(set(run[-1].species.values) == {"glass"} and run[0].species.sizes == {"atom": 0}, "species of a frame")
    picture = run.render(colour=run[-1].z, size="160x120")
    expect((picture != run.render(at=0, size="160x120")).any(), "grains that came are not drawn")


def check_own_colours(run):
    """Own values give the colours that the film's own quantity gives, in any order of the ids; NaN is grey."""
    how = {"size": "160x120", "words": "none", "program": run._program}
    last = run[-1]
    speed = ((last.vx ** 2 + last.vy ** 2 + last.vz ** 2) ** 0.5).astype(float)
    same = run.render(colour__by="speed", colour__range=["0 m/s", "0.2 m/s"], **how)
    own = run.render(colour=speed, colour__range=(0, 0.2), **how)
    far = numpy.abs(same.astype(int) - own.astype(int)).max()
    expect(far <= 2, f"own speeds have other colours than film.colour.by = speed: {far}")  # kept speeds are floats
    turned = speed.isel(atom=numpy.random.default_rng(2).permutation(speed.sizes["atom"]))
    expect((run.render(colour=turned, colour__range=(0, 0.2), **how) == own).all(), "the order of the ids counts")
    column = last.to_dataframe().set_index("id").z
    expect((run.render(colour=column, **how) == run.render(colour=list(column), **how)).all(), "a column is another")
    known = [1.0 if grain == int(last.z.argmax()) else float("nan") for grain in range(50)]  # the highest one is seen
    none = run.render(colour=known, **how)
    colourful = [int((numpy.ptp(each.astype(int), axis=2) > 60).sum()) for each in (own, none)]
    expect(0 < 10 * colourful[1] < colourful[0], f"unknown values are not grey: {colourful} pixels have a colour")
    words = [run.render(colour=speed, colour__title=title, size="640x360", program=run._program) for title in ("a", "b")]
    expect((words[0] != words[1]).any(), "the title is not written")
    dark = run.render(style="dark", **how)
    expect((run.render(**how) != dark).any() and (run.render(style="dark", **how) == dark).all(), "settings stay behind")


def check_mistakes(program):
    def run(**more):
        return mistake_of(lambda: grainreel.run("scene.toml", out="wrong", program=program, **more))

    expect("unknown key 'frequencie' in [drive]" in run(drive__frequencie=3), run(drive__frequencie=3))
    expect("run" in mistake_of(lambda: grainreel.run("scene.toml", out="run", program=program)), "a run is replaced")
    expect("no such file" in mistake_of(lambda: grainreel.run("none.toml", program=program)), "no scene, no mistake")
    render = grainreel.render
    for says, call in (("scene: must be a path", lambda: grainreel.run(None, program=program)),
                       ("leave one out", lambda: render("run", at=0.1, frame=1, program=program)),
                       ("size: must be as", lambda: render("run", size=3, program=program)),
                       ("size: must be as", lambda: render("run", size=(3, 4, 5), program=program)),
                       ("at: must be a time", lambda: render("run", at=float("nan"), program=program)),
                       ("run the scene again with its film", lambda: render("run", frame=1, program=program))):
        said = mistake_of(call)
        expect(says in said and not said.startswith("error"), f"'{says}' is expected, it says: {said}")
    expect("is not found" in mistake_of(lambda: grainreel.run("scene.toml", program="no-such-program")), "no program")
    expect("is no folder of a run" in mistake_of(lambda: grainreel.open("/")), "any folder is a run")


def check_stop(program):
    running = grainreel.start("scene.toml", out="stopped", program=program, run__duration="100 s")
    for now in running:
        if now.get("time_s", 0) > 0.1:
            running.stop()
    run = running.result()
    expect(run.record["status"] == "interrupted", "a run that was stopped says otherwise")
    expect(0 < run.trajectory.sizes["frame"] and float(run.measures.time[-1]) < 100, "what there is was not kept")

    # Ctrl-C, as Python gives it.
    def interrupt(_):
        raise KeyboardInterrupt

    try:
        grainreel.run("scene.toml", out="again", program=program, progress=interrupt, run__duration="100 s")
        expect(False, "Ctrl-C does not come through")
    except KeyboardInterrupt:
        pass
    expect(grainreel.open("again").record["status"] == "interrupted", "Ctrl-C does not stop the program")


# ---- the guide


def check_guide():
    """All blocks in their order, as one notebook in a folder that has scene.toml."""
    page = ROOT / "docs/guide/python.md"
    names = {}
    for match in re.finditer(r"^```python\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL):
        line = page.read_text()[:match.start()].count("\n") + 2
        exec(compile("\n" * (line - 1) + match.group(1), str(page), "exec"), names)


def main(program):
    program = str(Path(program).resolve())
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ.update(XDG_CACHE_HOME=folder, GRAINREEL_PACKINGS="off", GRAINREEL=program)
        Path("scene.toml").write_text(SCENE)
        watchdog = threading.Timer(500, lambda: os._exit(1))
        watchdog.daemon = True
        watchdog.start()
        warnings.filterwarnings("ignore", ".*has no room for words.*")
        check_pictures()
        check_run(program)
        check_mistakes(program)
        check_stop(program)
        wrong = python_lines.check() + python_misuse.check()
        expect(not wrong, "\n".join(wrong))
        check_guide()
        os.chdir("/")


main(sys.argv[1])
