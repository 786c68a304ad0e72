"""Runs of grainreel as xarray datasets, and the program from Python.

    import grainreel
    run = grainreel.run("scene.toml", out="output/mine", drive__g_level=3)
    run.measures.kinetic_J.plot(x="time")
    run[-1].z.mean()                                   # m, of the last moment; one row a grain
    picture = grainreel.render(run, at=0.1)            # rows x columns x 3, of 0 to 255

Needs numpy and xarray with a reader of NetCDF (Debian: python3-xarray, python3-netcdf4), and the program itself: the
argument `program`, else $GRAINREEL, else the one in the wheel that this module came in, else `grainreel` on the PATH. SI
units; every variable says its own in attrs["units"]. What goes wrong is a GrainreelError with one line that says what to
do.
"""
from ._frames import Frame, Measures
from ._messages import GrainreelError, GrainreelWarning
from ._pictures import Picture
from ._program import Running
from ._results import Answer, Comparison, Film, Study
from ._run import Run
from ._verbs import check, compare, export, film, inspect, open, render, report, run, start, study

__all__ = ["Answer", "Comparison", "Film", "Frame", "GrainreelError", "GrainreelWarning", "Measures", "Picture", "Run",
           "Running", "Study", "check", "compare", "export", "film", "inspect", "open", "render", "report", "run", "start",
           "study"]
__version__ = "1.0.0"
