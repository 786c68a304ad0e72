#!/usr/bin/env python3
"""Which pattern does a wide shaken layer stand in: stripes, squares or hexagons?

    tests/phenomena/layer_pattern.py RUN [--periods N] [--until SECONDS] [--every-second] [--map FILE]

RUN is a finished run in a box, seen at one phase of the drive. Prints for its last N periods:
  inverted    share of the surface's shape that changes its sign from each period to the next; by chance 1/N
  wavelength  of the ring in the spectrum of that part of the surface
  waves       strongest whole number of waves to the box, with Hann's window: so were the pictures of figure 1 of Bizon et
              al. 1998 measured (docs/phenomena/layer_patterns.md)
  M2, M4, M6  |sum of P(a) exp(i n a)| / sum of P(a), of the power P of waves of that length in the direction a, in 25
              places with a Gaussian window of 0.6 wavelengths; and what ideal stripes, squares and hexagons have:
              M2 is largest for stripes, M4 is larger than M2 and M6 for squares, and M6 for hexagons
--every-second is for a layer that lands in every second period, and looks otherwise in the one than in the other. The
pattern is then the mean of N surfaces two periods apart, the last of them at the end or at SECONDS, and `repeated` its
share of the surfaces' shape; by chance 1/N. Its skewness is above 0 where there are single peaks, below 0 where there are
single holes, and 0 for stripes and squares.
--map writes the pattern's height, each cell's mean with its neighbours, for gnuplot.
"""
import argparse
import cmath
import math
import operator
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from fields import Fields  # noqa: E402


def surface(places, radii, floor, cells, width, depth, diameter):
    """Height of the surface above the floor in cells x cells columns (docs/reference/theory.md, the surface)."""
    columns = [[] for _ in range(cells * cells)]
    for i, radius in enumerate(radii):
        x, y, z = places[3 * i:3 * i + 3]
        column = min(cells - 1, max(0, int((x / depth + 0.5) * cells)))
        row = min(cells - 1, max(0, int((y / width + 0.5) * cells)))
        columns[column * cells + row].append((z - floor, radius))
    return [top(sorted(column), diameter) for column in columns]


def top(column, diameter):
    """Of grains from the lowest up, as the layer flies; a column ends below a gap of more than 1.5 diameters."""
    height = column[0][0] if column else 0.0
    for z, radius in column:
        if z - radius > height + 1.5 * diameter:
            break
        height = max(height, z + radius)
    return height


def without_mean(values):
    mean = sum(values) / len(values)
    return [value - mean for value in values]


def subharmonic(surfaces):
    """The part of the surface that changes its sign every period, and its share of the variance."""
    shapes = [without_mean(surface) for surface in surfaces]
    part = [sum((-1)**n * shape[i] for n, shape in enumerate(shapes)) / len(shapes) for i in range(len(shapes[0]))]
    total = sum(value * value for shape in shapes for value in shape) / len(shapes)
    return part, sum(value * value for value in part) / total


def repeated(surfaces):
    """The mean shape of the surfaces, and its share of the variance."""
    shapes = [without_mean(surface) for surface in surfaces]
    part = [sum(values) / len(shapes) for values in zip(*shapes)]
    total = sum(value * value for shape in shapes for value in shape) / len(shapes)
    return part, sum(value * value for value in part) / total


def smooth(part, cells):
    """The mean of each cell and its neighbours; those outside are those at the edge."""
    def line(values):
        return [(values[max(0, i - 1)] + values[i] + values[min(cells - 1, i + 1)]) / 3 for i in range(cells)]
    rows = [line(part[c * cells:(c + 1) * cells]) for c in range(cells)]
    columns = [line([row[r] for row in rows]) for r in range(cells)]
    return [columns[r][c] for c in range(cells) for r in range(cells)]


def skewness(values):
    values = without_mean(values)
    square = sum(value * value for value in values) / len(values)
    return sum(value**3 for value in values) / len(values) / square**1.5


def spectrum(values, cells, most, fine=2):
    """Power at the wave numbers p/(fine L), q/(fine L), 0 <= p, |q| <= fine most; Hann's window takes the edges away."""
    window = [math.sin(math.pi * (i + 0.5) / cells)**2 for i in range(cells)]
    waves = range(-fine * most, fine * most + 1)
    turns = {q: [window[i] * cmath.exp(-2j * math.pi * q * (i + 0.5) / (fine * cells)) for i in range(cells)] for q in waves}
    rows = [{q: sum(map(operator.mul, values[c * cells:(c + 1) * cells], turns[q])) for q in waves}
            for c in range(cells)]
    return {(p / fine, q / fine): abs(sum(turns[p][c] * rows[c][q] for c in range(cells)))**2
            for p in range(fine * most + 1) for q in waves}


def ring(power, least):
    """The wave number of the spectrum's ring: the mean over it, weighted with the power."""
    shells = {}
    for (p, q), value in power.items():
        k = math.hypot(p, q)
        if k >= least:
            shells[round(2 * k)] = shells.get(round(2 * k), 0) + value
    strongest = max(shells, key=shells.get) / 2
    near = [(math.hypot(p, q), value) for (p, q), value in power.items()
            if abs(math.hypot(p, q) - strongest) <= 0.25 * strongest]
    return sum(k * value for k, value in near) / sum(value for _, value in near)


def whole_waves(power):
    """The strongest whole number of waves to the box, from 2 on; `power` at whole wave numbers."""
    shells = {}
    for (p, q), value in power.items():
        shell = math.floor(math.hypot(p, q) + 0.5)
        if shell >= 2:
            shells[shell] = shells.get(shell, 0) + value
    return max(shells, key=shells.get)


def local_angles(part, cells, wavelength, at, directions=36, reach=0.6):
    """Power at the wavelength against the direction of the wave, 0 to 180 degrees, around a place; lengths in cells."""
    spread, k = reach * wavelength, 2 * math.pi / wavelength
    weights = [[math.exp(-((i + 0.5 - place) / spread)**2 / 2) for i in range(cells)] for place in at]
    angles = []
    for n in range(directions):
        a = math.pi * n / directions
        turns = [[w * cmath.exp(-1j * k * part_of * i) for i, w in enumerate(row)]
                 for row, part_of in zip(weights, (math.cos(a), math.sin(a)))]
        angles.append(abs(sum(turns[0][c] * sum(map(operator.mul, part[c * cells:(c + 1) * cells], turns[1]))
                              for c in range(cells)))**2)
    return angles


def local_orders(part, cells, wavelength, places=5):
    """M2, M4 and M6 of `places` x `places` parts of the layer, each weighted with its power, and the summed powers."""
    grid = [cells * (i + 1) / (places + 1) for i in range(places)]
    found = [local_angles(part, cells, wavelength, (x, y)) for x in grid for y in grid]
    power = sum(map(sum, found))
    return [sum(moment(angles, n) for angles in found) / power for n in (2, 4, 6)]


def moment(angles, n):
    return abs(sum(value * cmath.exp(1j * n * math.pi * i / len(angles)) for i, value in enumerate(angles)))


def ideal(waves, cells, wavelength):
    """The layer's height in a pattern of so many plane waves: 1 stripes, 2 squares, 3 hexagons, many no order."""
    k, heights = 2 * math.pi / wavelength, []
    turns = [(math.pi * n / waves + 0.2, 2.4 * n * n) for n in range(waves)]  # direction and phase
    for c in range(cells):
        for r in range(cells):
            heights.append(sum(math.cos(k * (math.cos(a) * c + math.sin(a) * r) + phase) for a, phase in turns))
    return heights


class Pattern:
    """Of the last `periods` frames of a trajectory at one phase of the drive, whole periods apart, until a time."""

    def __init__(self, trajectory, width, depth, periods=8, phase=0.0, until=math.inf, every_second=False):
        radii = trajectory.record("radius", 0)
        diameter = 2 * sum(radii) / len(radii)
        self.cells = int(min(width, depth) / (1.5 * diameter))
        frames = [i for i, (turns, time) in enumerate(zip(trajectory.values("phase"), trajectory.values("time")))
                  if abs((turns - phase + 0.5) % 1 - 0.5) < 0.02 and time <= until]
        floor = trajectory.values("floor_offset")
        chosen = frames[::-2][:periods] if every_second else frames[-periods:]
        surfaces = [surface(trajectory.record("coordinates", i), radii, floor[3 * i + 2], self.cells, width, depth, diameter)
                    for i in chosen]
        self.part, self.share = (repeated if every_second else subharmonic)(surfaces)
        self.skewness = skewness(smooth(self.part, self.cells))
        self.rms = math.sqrt(sum(value * value for value in self.part) / len(self.part))
        power = spectrum(self.part, self.cells, most=12)
        k = ring(power, least=2)
        self.wavelength = min(width, depth) / k
        self.waves = whole_waves(spectrum(self.part, self.cells, most=12, fine=1))
        self.orders = local_orders(self.part, self.cells, self.cells / k)
        self.ideals = {name: local_orders(ideal(waves, self.cells, self.cells / k), self.cells, self.cells / k)
                       for name, waves in (("stripes", 1), ("squares", 2), ("hexagons", 3), ("no order", 40))}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path)
    parser.add_argument("--size", type=float, default=0.1, help="width and depth of the box, m [0.1]")
    parser.add_argument("--periods", type=int, default=8, help="how many [8]")
    parser.add_argument("--phase", type=float, default=0.0, help="of the drive, turns [0]")
    parser.add_argument("--until", type=float, default=math.inf, help="end of those periods, s [the run's]")
    parser.add_argument("--every-second", action="store_true", help="surfaces two periods apart")
    parser.add_argument("--map", type=Path, help="write the pattern's height, mm, a line for each row across")
    options = parser.parse_args()
    pattern = Pattern(Fields(options.run / "trajectory.nc"), options.size, options.size, options.periods, options.phase,
                      options.until, options.every_second)
    print(f"{'repeated' if options.every_second else 'inverted'} {pattern.share:.3f}  rms {1000 * pattern.rms:.3f} mm  "
          f"wavelength {1000 * pattern.wavelength:.2f} mm  waves {pattern.waves}  skewness {pattern.skewness:.2f}")
    for name, orders in {"here": pattern.orders, **pattern.ideals}.items():
        print(f"{name:<9}M2 {orders[0]:.2f}  M4 {orders[1]:.2f}  M6 {orders[2]:.2f}")
    if options.map:
        heights, n = smooth(pattern.part, pattern.cells), pattern.cells
        rows = (" ".join(f"{1000 * height:.4f}" for height in heights[c * n:(c + 1) * n]) for c in range(n))
        options.map.write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    sys.exit(main())
