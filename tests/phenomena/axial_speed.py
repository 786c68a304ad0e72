#!/usr/bin/env python3
"""How fast does a shaken bed rise in its middle, at each depth?

    tests/phenomena/axial_speed.py RUN [--from SECONDS] [--width SHARE]

RUN is a finished run with [output.fields] grid = "yz". Prints the mean upward velocity in the middle of the container
(a fifth of its width, or the share given) against the depth below the surface, and the exponential law that fits it best
between the turn at the surface and the slow part at the floor. The surface is where half of the largest solid fraction
is left.
"""
import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from fields import Fields  # noqa: E402


def middle(fields, name, start, width):
    """Of each height: the mean of a field over the records after `start` and over the middle of the width, and the room."""
    y, z, times = fields.values("y"), fields.values("z"), fields.values("time")
    values, room = fields.values(name), fields.values("free_volume")
    half = width * max(y)
    profile = []
    for k in range(len(z)):
        sums = [0.0, 0.0]
        for t, time in enumerate(times):
            for j in range(len(y)):
                i = (t * len(z) + k) * len(y) + j
                if time >= start and abs(y[j]) <= half and room[i] > 0 and not math.isnan(values[i]):
                    sums[0] += values[i] * room[i]
                    sums[1] += room[i]
        profile.append(sums[0] / sums[1] if sums[1] else math.nan)
    return z, profile


def line(points):
    """Least squares y = a + b x, and the share of the variance that it leaves unexplained."""
    n = len(points)
    mx, my = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    sxx, sxy = sum((x - mx)**2 for x, _ in points), sum((x - mx) * (y - my) for x, y in points)
    syy = sum((y - my)**2 for _, y in points)
    b = sxy / sxx
    return my - b * mx, b, 1 - b * sxy / syy


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path)
    parser.add_argument("--from", dest="start", type=float, default=1.0, help="records from this time on [1 s]")
    parser.add_argument("--width", type=float, default=0.2, help="share of the width that counts as the middle [0.2]")
    options = parser.parse_args()
    fields = Fields(options.run / "fields.nc")
    z, speed = middle(fields, "velocity_z", options.start, options.width)
    species = next(name for name in fields.variables if name.startswith("solid_fraction_"))
    _, solid = middle(fields, species, options.start, options.width)
    full = max(s for s in solid if not math.isnan(s))
    surface = max(height for height, s in zip(z, solid) if s >= full / 2)
    print("# depth_m,upward_speed_m_per_s")
    for height, v in zip(z, speed):
        if height <= surface and not math.isnan(v):
            print(f"{surface - height:.5f},{v:.6g}")
    fastest = max((v, height) for height, v in zip(z, speed) if height <= surface and not math.isnan(v))
    part = [(surface - height, math.log(v)) for height, v in zip(z, speed)
            if height < fastest[1] and v > 0.03 * fastest[0]]
    if len(part) < 3:
        sys.exit("the fastest rise is at the floor, so there is no fall with depth to be fitted")
    a, b, left = line(part)
    print(f"# surface at {surface:.4f} m; fastest {fastest[0]:.4g} m/s at a depth of {surface - fastest[1]:.4f} m")
    print(f"# v = {math.exp(a):.4g} m/s exp(-depth / {-1 / b:.4g} m) over {len(part)} heights; r^2 = {1 - left:.3f}")


if __name__ == "__main__":
    main()
