"""Lines that a user of the Python module would write, thirty at a time, written down before the module could do them.

check(program) runs each in the present folder, which has scene.toml, and returns the lines that do not hold.
"""
import copy
import pickle
from pathlib import Path

import numpy
import pandas
import xarray

PRELUDE = """
import grainreel
run = grainreel.run("scene.toml", out="line", output__contacts=True, output__fields={"grid": "yz", "periods": 1})
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

# What a notebook of the field does, written down on 2026-11-29 from the README and the guide alone; 21 of the thirty ran
# then. Each must run; those with a value in front of == must have it. Lines with plots need matplotlib.
NOTEBOOK = """
run.measures.kinetic_J.plot()
run.measures[["kinetic_J", "gravitational_J"]].to_dataframe().plot()
run.measures.kinetic_J.rolling(time=5, center=True).mean().plot()
float(run.measures.kinetic_J.sel(time=slice(0.05, 0.1)).mean()) == run.inspect(measure="kinetic_J", window=(0.05, 0.1))["mean"]["mean"][0]
run.inspect(measure="kinetic_J", window=(0.05, None))
run.inspect(measure="kinetic_J", by="period")["by_period"].plot(x="period", y="kinetic_J_mean")
run.inspect(measure=["height_difference", "kinetic_J"], slope=(0.05, 0.15))
run[-1].plot.scatter(x="y", y="z", hue="species")
run[-1].to_dataframe().plot.scatter("y", "z", c="speed")
float(run[-1].groupby("species").mean()["z"].sel(species="big")) == float(last.z.where(last.species == "big").mean())
run[-1].where("species == big").z.plot.hist(bins=20)
(run.sel(time=0.1).x.values.size, run.sel(time=0.1)["speed"].max().item() > 0) == (50, True)
run.trajectory.z.groupby("species").mean().plot.line(x="time", hue="species")
run.trajectory.z.sel(id=12).plot(x="time")
((run.trajectory.coordinates - run.trajectory.coordinates[0]) ** 2).sum("spatial").mean("atom").plot(x="time")
run.to_dataframe().groupby(["time", "species"]).z.mean().unstack().plot()
run.contacts.to_dataframe().query("second >= 0").normal.describe()
run.contacts.normal.groupby("time").sum().plot()
plt.hist(run.contacts.normal, bins=50)
run.fields.solid_fraction_big.mean("time").plot(x="y", y="z")
run.fields.isel(time=-1).plot.streamplot(x="y", y="z", u="velocity_y", v="velocity_z")
(run.render(at=0.1, size="160x120", colour="speed") == run.render(at=0.1, size="160x120", colour__by="speed")).all() == True
plt.imshow(run.render(at=run.time[-1], size="160x120", colour=run[-1].speed))
[frame.z.max().item() for frame in run[::2]] == [frame.z.max().item() for frame in list(run)[::2]]
run.inspect("species == big", at=0.1)["grains"].set_index("id").height.plot.bar()
grainreel.run({**run.scene, "drive": {**run.scene["drive"], "frequency": "30 Hz"}}, out="f30", run__duration="0.05 s").scene["drive"]["frequency"] == 30
pandas.DataFrame({"weak": run.measures.kinetic_J.to_series(), "strong": other.measures.kinetic_J.to_series()}).plot()
xarray.concat([run.measures, other.measures], pandas.Index([2, 3], name="g_level")).height_difference.plot.line(x="time", hue="g_level")
list(grainreel.study("study.toml", out="sweep").settings.heat) == list(grainreel.study("study.toml", out="sweep").table.groupby("drive.g_level").heat.mean())
grainreel.compare({"weak": run, "strong": other}, out="trio", size="640x360", at=0.1).film == grainreel.compare([run, other], out="trio", force=True, captions=["weak", "strong"], size="640x360", at=0.1).film
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


def not_running(names):
    """The lines of the notebook that do not run, or have another value, each with the reason."""
    wrong = []
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        pyplot = None
    names = {**names, "plt": pyplot, "xarray": xarray}
    for line in NOTEBOOK:
        if pyplot is None and "pl" in line and (".plot" in line or "plt." in line):
            continue
        try:
            value = eval(line, names)
            if " == " in line.split('"')[-1] and not value:
                wrong.append(f"{line}: does not hold")
        except Exception as error:
            wrong.append(f"{line}: {type(error).__name__}: {error}")
        if pyplot is not None:
            pyplot.close("all")
    return wrong


def check():
    assert len(LINES) == 30 == len(NOTEBOOK)
    Path("study.toml").write_text(STUDY)
    Path("two.xyz").write_text(TWO)
    names = {"copy": copy, "numpy": numpy, "pandas": pandas, "pickle": pickle, "Path": Path}
    for line in PRELUDE.strip().splitlines():
        exec(line, names)
    return failing(names) + not_running(names)
