#!/usr/bin/env python3
"""Where the big grains of a mixture are and how the bed flows, from fields.nc on a yz grid.

Writes mixture_T.dat for each moment T (s): a row a cell, rows of one height together,
    y (mm), z (mm), share of the big grains in the solid volume, velocity in y and z (mm/s).
Cells whose solid fraction is below 0.2 have nan. For docs/figures/phenomena/wedge_mixture_fields.gp."""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from fields import Fields  # noqa: E402

LEAST_SOLID = 0.2


def rows(fields, record):
    y, z = fields.values("y"), fields.values("z")
    big, small, across, up = (fields.record(name, record) for name in
                              ("solid_fraction_big", "solid_fraction_small", "velocity_y", "velocity_z"))
    for k, height in enumerate(z):
        for j, side in enumerate(y):
            at = k * len(y) + j
            solid = big[at] + small[at]
            numbers = (big[at] / solid, 1e3 * across[at], 1e3 * up[at]) if solid >= LEAST_SOLID else ["nan"] * 3
            yield " ".join(str(n) for n in (1e3 * side, 1e3 * height, *numbers))
        yield ""


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("run", type=Path, help="folder of a run with output.fields.grid=yz")
    arguments.add_argument("times", type=float, nargs="+", help="moments, s")
    given = arguments.parse_args()
    fields = Fields(given.run / "fields.nc")
    times = fields.values("time")
    for moment in given.times:
        record = min(range(len(times)), key=lambda k: abs(times[k] - moment))
        Path(f"mixture_{moment:g}.dat").write_text("\n".join(rows(fields, record)) + "\n")
        print(f"mixture_{moment:g}.dat: the record about {times[record]:.3f} s")


main()
