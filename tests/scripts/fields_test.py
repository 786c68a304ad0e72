#!/usr/bin/env python3
"""fields.nc as other programs see it. Usage: fields_test.py xarray|vtk PROGRAM. Exit status 77: the library is missing."""
import math
import subprocess
import sys
import tempfile
from pathlib import Path

SCENE = """
gravity = 9.81
[[species]]
name = "small"
count = 60
diameter = "4 mm"
density = 2500
[[species]]
name = "big one"
count = 6
diameter = "8 mm"
density = 2500
[contact]
law = "spring-dashpot"
restitution = 0.5
friction = 0.3
[container]
shape = "wedge"
half_angle = "20 deg"
slant_height = "20 mm"
half_width = "20 mm"
depth = "12 mm"
height = "60 mm"
[drive]
frequency = "30 Hz"
g_level = 2
[run]
duration = "0.18 s"
accuracy = "draft"
[output.fields]
grid = "GRID"
periods = 2
"""
MASS = (60 * 4e-3**3 + 6 * 8e-3**3) * math.pi / 6 * 2500
SOLIDS = {"solid_fraction_small": 60 * 4e-3**3 * math.pi / 6, "solid_fraction_big_one": 6 * 8e-3**3 * math.pi / 6}


def run(program, folder, grid):
    scene = Path(folder) / "scene.toml"
    scene.write_text(SCENE.replace("GRID", grid))
    run_folder = Path(folder) / grid
    subprocess.run([program, "movie", scene, "--out", run_folder, "--no-film", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    return run_folder / "fields.nc"


def expect(condition, what):
    if not condition:
        sys.exit(f"fields_test: {what}")


def close(value, wanted, share, what):
    expect(abs(value - wanted) <= share * abs(wanted), f"{what}: {value}, expected {wanted}")


def with_xarray(program, folder):
    import xarray

    for grid, dims in (("yz", ("time", "z", "y")), ("xyz", ("time", "z", "y", "x"))):
        data = xarray.open_dataset(run(program, folder, grid))
        expect(data.attrs["Conventions"] == "CF-1.8", "Conventions")
        expect(data.density.dims == dims, f"dimensions {data.density.dims}")
        # 5.4 periods: two records of two periods, one of the fifth.
        expect(data.sizes["time"] == 3, f"{data.sizes['time']} records")
        bounds = data.time_bounds.values
        for record, (begin, end) in enumerate(((0, 2), (2, 4), (4, 5))):
            close(bounds[record][1], end / 30, 1e-12, "end of a record")
            close(bounds[record][0], begin / 30, 1e-12, "begin of a record")
            close(float(data.time[record]), (begin + end) / 60, 1e-12, "time")
            moment = data.isel(time=record)
            close(float((moment.density * moment.free_volume).sum()), MASS, 1e-10, "mass")
            for name, volume in SOLIDS.items():
                close(float((moment[name] * moment.free_volume).sum()), volume, 1e-10, name)
        for name, variable in data.data_vars.items():
            if variable.dims == dims:
                expect(variable.attrs["units"] and variable.attrs["long_name"], f"attributes of {name}")
        expect(data.z.attrs["units"] == "m" and data.z.attrs["axis"] == "Z", "attributes of z")
        inside = data.density.isel(time=0) > 0
        expect(bool((data.granular_temperature.isel(time=0).where(inside) >= 0).any()), "temperature")
        expect(float(data.contact_stress_zz.sum()) > 0, "contact stress")


def with_vtk(program, folder):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIONetCDF import vtkNetCDFCFReader

    reader = vtkNetCDFCFReader()
    reader.SetFileName(str(run(program, folder, "xyz")))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    expect(len(times) == 3, f"time steps {times}")
    reader.UpdateTimeStep(times[1])
    output = reader.GetOutput()
    data = output.GetCellData() if output.GetCellData().GetNumberOfArrays() else output.GetPointData()
    density, volume = (vtk_to_numpy(data.GetArray(name)) for name in ("density", "free_volume"))
    close(float((density * volume).sum()), MASS, 1e-10, "mass")
    # With its defaults the reader must not take x and y for longitude and latitude.
    expect(output.GetClassName() == "vtkImageData", f"the grid is {output.GetClassName()}")
    low, high = output.GetBounds()[4:6]
    expect(low < 0 and high > 0.06, f"bounds of z {low} to {high}")


def main():
    kind, program = sys.argv[1:]
    try:
        __import__({"xarray": "netCDF4", "vtk": "vtkmodules"}[kind])
        if kind == "xarray":
            __import__("xarray")
    except ImportError as error:
        print(f"skipped: {error}; apt-get install {'python3-xarray python3-netcdf4' if kind == 'xarray' else 'python3-vtk9'}")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        {"xarray": with_xarray, "vtk": with_vtk}[kind](program, folder)
    print("fields.nc is as it should be")


main()
