"""Thirty lines that a user of the Python module would write, written down before the module could do them.

check(program) runs each in the present folder, which has scene.toml, and returns the lines that do not hold.
"""
import copy
import pickle
from pathlib import Path

import numpy
import pandas

PRELUDE = """
import grainreel
run = grainreel.run("scene.toml", out="line", output__contacts=True)
other = grainreel.run("scene.toml", out="other", drive__g_level=3)
last = run[-1]
foreign = grainreel.open("two.xyz")
speed = (last.vx ** 2 + last.vy ** 2 + last.vz ** 2) ** 0.5
"""

LINES = """
len(run) == run.trajectory.sizes["frame"]
run[-1].z.sizes == {"atom": 50}
[float(frame.time) for frame in run] == list(run.time)
float(run.time[-1]) == float(run.trajectory.time[-1])
run.species == ["small", "big"]
run.trajectory.where(run.trajectory.species == "big").z.mean("atom").sizes == {"frame": len(run)}
run.trajectory.sel(time=0.1, method="nearest").z.sizes == {"atom": 50}
0 < run.trajectory.sel(time=slice(0.04, 0.12)).sizes["frame"] < len(run)
0.09 < float(run.sel(time=0.1).time) < 0.11
set(run[-1].to_dataframe().groupby("species").z.mean().index) == {"small", "big"}
len(run.to_dataframe()) == 50 * len(run)
len(run.contacts[["first", "second", "normal", "x", "y", "z"]].to_dataframe()) == run.contacts.sizes["row"]
run.to_dataframe("contacts").groupby("time").normal.sum().max() > 0
run.scene["drive"]["frequency"] == 20
run == grainreel.open("line")
pickle.loads(pickle.dumps(run)).measures.equals(run.measures)
grainreel.open("line").__enter__().__exit__(None, None, None) is None
grainreel.render(run, at=run.trajectory.time[-1], size="160x120").shape == (120, 160, 3)
(run.render(colour=speed, size="160x120") != run.render(size="160x120")).any()
run.render(size="160x120")._repr_png_().startswith(b"\\x89PNG")
grainreel.run(text=Path("scene.toml").read_text(), out="of text").record["status"] == "complete"
grainreel.run(scene=run.scene, out="of dict").record["status"] == "complete"
run.export("vtk").parent == run.path
list(run.inspect(at=0.1)["species"]["species"]) == ["small", "big"]
len(run.inspect(where="species == big")["grains"]) == 10
grainreel.open("two.xyz").trajectory.x.sizes == {"frame": 2, "atom": 1}
"<video" in run.film(size="160x120", progress=True)._repr_html_()
run.report().name == "report.html" and "vibrated" not in grainreel.check("scene.toml", drive__g_level=3)
grainreel.compare([run, other], out="pair", size="640x360").path.is_dir()
len(grainreel.study("study.toml", out="sweep").table) == 2
""".strip().splitlines()

# More lines, of 2026-11-29, likewise written down beforehand (some as they stand above are left out).
MORE = """
copy.deepcopy(run) == run and len({run, grainreel.open("line")}) == 1
(grainreel.open("two.xyz").render(frame=-1, size="160x120") == grainreel.open("two.xyz").render(frame=1, size="160x120")).all()
list(reversed(run))[0].equals(run[-1]) and run[numpy.int64(-1)].equals(run[-1])
run[-1].where(run[-1].species == "big", drop=True).sizes["atom"] == 10
run[-1].groupby("species").mean().sizes["species"] == 2
__import__("importlib.util").util.find_spec("scipy") is None or run.trajectory.swap_dims(frame="time").z.interp(time=0.1).sizes == {"atom": 50}
run.contacts.groupby("time").sum().normal.sizes["time"] >= 1
run.measures.to_dataframe().index.name == "time"
run.render(size="160x120", colour=pandas.Series(numpy.arange(50.0), index=pandas.Index(last.id.values, name="id"))).shape[0] == 120
Path(run.export("csv")).read_text().count(chr(10)) == 1 + 50 * len(run)
run.render("p.png", size="160x120").shape == (120, 160, 3) and Path("p.png").read_bytes().startswith(b"\\x89PNG")
run.film("film", size="160x120").path.parent.name == "film"
len(run.inspect("species == 'big'")["grains"]) == 10
run.report("rep.html").name == "rep.html" and run.export("vtk", "dir").name == "dir"
grainreel.compare(run, other, out="pair 2", size="640x360", at=0.1).path.exists()
last.where("species == big").sizes["atom"] == 10 == last.where('species != "small" and z > 0 mm').sizes["atom"]
last.where("z > 8 mm").sizes["atom"] == int((last.z > 0.008).sum()) > 0
abs(last["speed"] - speed).max() < 1e-6 and last.speed.attrs["units"] == "m/s"
abs(float(last.mass.sum()) - 2500 * 4 / 3 * numpy.pi * float((last.radius.astype(float) ** 3).sum())) < 1e-12
[float(frame.time) for frame in run.sel(time=slice(0.05 + 1e-9, 0.15 - 1e-9))] == [float(time) for time in run.time[1:4]]
foreign.film(size="160x120").path == foreign.film(size="160x120").path != foreign.film(size="320x240").path
not hasattr(run, "where") and hasattr(run, "measures")
""".strip().splitlines()

STUDY = """scene = "scene.toml"
[[vary]]
key = "drive.g_level"
values = [2, 3]
[[measure]]
name = "heat"
column = "kinetic_J"
reduce = "mean"
"""
TWO = "".join(f'1\nLattice="4 0 0 0 4 0 0 0 4" Properties=species:S:1:pos:R:3:radius:R:1 Time={time}\nA 2 {y} 2 0.5\n'
              for time, y in ((0, 0.5), (1, 3.5)))


def failing(names):
    """The lines that do not hold, each with the reason."""
    wrong = []
    for line in LINES + MORE:
        try:
            held = eval(line, names)
        except Exception as error:
            wrong.append(f"{line}: {type(error).__name__}: {error}")
        else:
            if not held:
                wrong.append(f"{line}: does not hold")
    return wrong


def check():
    assert len(LINES) == 30
    Path("study.toml").write_text(STUDY)
    Path("two.xyz").write_text(TWO)
    names = {"copy": copy, "numpy": numpy, "pandas": pandas, "pickle": pickle, "Path": Path}
    for line in PRELUDE.strip().splitlines():
        exec(line, names)
    return failing(names)
