#!/usr/bin/env python3
"""Our program on the task that eight codes were given, beside what two of them published.

    tests/bench/eight_codes.py PROGRAM DATA CASE [--until SECONDS] [--threads N] [--out FOLDER]

Dosta et al. 2024, Comput. Phys. Commun. 296, 109066. DATA is a folder with the paper's inputs and results: mercury/
(grains), stl/ (walls) and results/ (CSV). CASE is one of

    impact      a steel ball of 20 mm falls into 25,000 grains of 2 mm; to 0.03 s
    impact_50k  into 50,000 in the published box of triangles; to 0.05 s, of which only the lowest place is published
    drum        8,000 grains of 4 mm under 30,000 of 2 mm in a drum; to 1 s
    drum_soft   the same with a five hundredth of the stiffness and a step of 20 us; to 1 s
    silo        100,000 grains of 4 mm run out of a silo through its large orifice; to 1.5 s
    silo_soft   40,000 of them with a hundredth of the stiffness and a step of 15 us; to 0.6 s

Each writes its input and its run into FOLDER/CASE, prints what is compared and its tolerance, and writes CASE.csv with our
curve and, where gnuplot is, CASE.svg with all three. A run that is there already is compared again without being run; one
that was broken off (SIGINT to the program), or that ended before SECONDS, goes on.
Exit status: 0 within the tolerances, 1 outside or broken off, 2 a mistake.
"""
import argparse
import csv
import json
import lzma
import math
import resource
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from fields import Fields  # noqa: E402
from runs import numbers as table  # noqa: E402

POISSON = 0.2
# E (Pa) and density (kg/m3); restitution and friction of each pair.
MATERIALS = {"M1": (1e9, 2500), "M2": (0.5e9, 2000), "steel": (210e9, 7200)}
PAIRS = {("M1", "M1"): (0.5, 0.3), ("M1", "M2"): (0.45, 0.2), ("M2", "M2"): (0.4, 0.4),
         ("M1", "steel"): (0.4, 0.2), ("M2", "steel"): (0.4, 0.2)}
FLOOR = -0.0902431  # m, of the box of the impact
ORIFICE = -0.0554222  # m, of the silo


def modulus(a, b, softer):
    """E* of two materials, all grains softer by a factor; 1/E* = sum of (1 - nu^2) / E."""
    return 1 / sum((1 - POISSON**2) / (MATERIALS[m][0] * (softer if m != "steel" else 1)) for m in (a, b))


def numbers(a, b, softer):
    restitution, friction = PAIRS.get((a, b)) or PAIRS[b, a]
    return f"restitution = {restitution}\nfriction = {friction}\nmodulus = {modulus(a, b, softer):.8g}\n"


def contacts(species, wall, softer=1.0):
    """[contact] and the pairs: Hertz with a dashpot that may pull, as in LIGGGHTS and MUSEN, and Mindlin with history.

    species: names with their materials; wall: what [[contact.pair]] calls the steel wall.
    """
    text = (f"[contact]\nlaw = \"hertz\"\nattraction = true\n"
            f"tangential_ratio = {2 * (1 - POISSON) / (2 - POISSON):.10g}\n")
    first = next(iter(species.values()))
    text += numbers(first, first, softer)
    names = list(species)
    for i, a in enumerate(names):
        for b in names[i:]:
            if "steel" in (species[a], species[b]) and species[a] == species[b]:
                continue  # one ball meets no other
            text += f"[[contact.pair]]\nbetween = [\"{a}\", \"{b}\"]\n" + numbers(species[a], species[b], softer)
        if species[a] != "steel":
            text += f"[[contact.pair]]\nbetween = [\"{a}\", \"{wall}\"]\n" + numbers(species[a], "steel", softer)
    return text


def species_table(name, material, count, diameter):
    return (f"[[species]]\nname = \"{name}\"\ncount = {count}\ndiameter = {diameter}\n"
            f"density = {MATERIALS[material][1]}\n")


def write_table(file, rows):
    """Rows of (type, radius, x, y, z, velocity along z)."""
    with open(file, "w") as out:
        out.write("id,type,radius,x,y,z,vx,vy,vz,wx,wy,wz\n")
        for i, (kind, radius, x, y, z, fall) in enumerate(rows):
            out.write(f"{i},{kind},{radius:.17g},{x:.17g},{y:.17g},{z:.17g},0,0,{fall:g},0,0,0\n")


# m/s, downwards, of one grain. A bed in which a grain moves is taken as it is; one at rest would be brought to rest
# under the laws of the scene before the run begins, and here the walls move or open at once.
NUDGE = 0.3


def published_grains(file):
    """Rows of (radius, x, y, z)."""
    with lzma.open(file, "rt") as lines:
        rows = [line.split() for line in lines]
    return [tuple(map(float, row)) for row in rows[1:] if len(row) == 4]


# ---- Cases: input, curve, comparison --------------------------------------------------------------------------------

class Impact:
    until, step, title = 0.03, 0.5e-6, "A steel ball falls into 25,000 grains"
    published, column = {"LIGGGHTS": "case3_25k_liggghts.csv", "MUSEN": "case3_25k_musen.csv"}, "ball_z_m"

    def prepare(self, job):
        grains = published_grains(job.data / "mercury" / "Penetration_25KParticles.txt.xz")
        rows = [(1, radius, x, y, z - FLOOR, 0) for radius, x, y, z in grains] + [(2, 0.01, 0, 0, 0.06 - FLOOR, -5)]
        write_table(job.folder / "start.csv", rows)
        return (species_table("grains", "M1", len(grains), 0.002) + species_table("ball", "steel", 1, 0.02) +
                contacts({"grains": "M1", "ball": "steel"}, "wall") +
                "[container]\nshape = \"box\"\ndepth = 0.098\nwidth = 0.06\nheight = 0.198\ntop = \"open\"\n"
                "[start]\nmethod = \"file\"\nfile = \"start.csv\"\n" + job.run_table(self.step) +
                "[output]\ntrajectory_interval = \"5 ms\"\nmeasures_interval = \"0.1 ms\"\n")

    def curve(self, job):
        return ["t_s", "ball_z_m"], [(row["time_s"], row["ball_centre_z_m"] + FLOOR)
                                     for row in table(job.run / "measures.csv")]

    def compare(self, job, rows):
        good = True
        for when in (0.01, 0.02, 0.03):
            if when > job.until + 1e-9:
                continue
            ours = at(rows, when) - 0.06
            others = {name: at(job.results(file, self.column), when) - 0.06 for name, file in self.published.items()}
            off = ours / others["MUSEN"] - 1
            good &= judge(f"way of the ball after {1e3 * when:.0f} ms, mm: {1e3 * ours:.2f}; " +
                          ", ".join(f"{name} {1e3 * way:.2f}" for name, way in others.items()), off, 0.01)
        return good


    def panels(self, job, rows):
        def way(points):
            return [(1e3 * t, 1e3 * (z - 0.06)) for t, z in points]
        others = {name: [point for point in way(job.results(file, self.column)) if point[0] <= 1e3 * job.until]
                  for name, file in self.published.items()}
        musen = [point for point in others["MUSEN"] if point[0] >= 5]
        ours = way(rows)
        return [Panel("way of the ball, mm", "time, ms", {"grainreel": ours}, others),
                Panel("off MUSEN, %", "time, ms", {"grainreel": [(t, 100 * (at(ours, t) / z - 1)) for t, z in musen]},
                      {"LIGGGHTS": [(t, 100 * (at(others["LIGGGHTS"], t) / z - 1)) for t, z in musen]}, (-1, 1))]


class DeepImpact(Impact):
    """50,000 grains, walls of triangles. LIGGGHTS and MUSEN are lowest at 0.044 s, at -0.139 m (a third party's words)."""
    until, title = 0.05, "A steel ball falls into 50,000 grains"
    lowest = (0.044, -0.139)

    def prepare(self, job):
        shutil.copy(job.data / "stl" / "impact_box_m.stl", job.folder / "box.stl")
        grains = published_grains(job.data / "mercury" / "Penetration_50KParticles.txt.xz")
        write_table(job.folder / "start.csv", [(1, *grain, 0) for grain in grains] + [(2, 0.01, 0, 0, 0.06, -5)])
        return (species_table("grains", "M1", len(grains), 0.002) + species_table("ball", "steel", 1, 0.02) +
                contacts({"grains": "M1", "ball": "steel"}, "box") +
                "[container]\nshape = \"mesh\"\nmesh = \"box\"\n[[mesh]]\nname = \"box\"\nfile = \"box.stl\"\n"
                "[start]\nmethod = \"file\"\nfile = \"start.csv\"\n" + job.run_table(self.step) +
                "[output]\ntrajectory_interval = \"5 ms\"\nmeasures_interval = \"0.1 ms\"\n")

    def curve(self, job):
        return ["t_s", "ball_z_m"], [(row["time_s"], row["ball_centre_z_m"]) for row in table(job.run / "measures.csv")]

    def compare(self, job, rows):
        when, deepest = min(rows, key=lambda row: row[1])
        return judge(f"lowest place of the ball, mm below its start: {1e3 * (0.06 - deepest):.1f} at {1e3 * when:.1f} ms; "
                     f"LIGGGHTS and MUSEN {-1e3 * self.lowest[1]:.0f} at {1e3 * self.lowest[0]:.0f} ms",
                     (0.06 - deepest) / -self.lowest[1] - 1, 0.01)

    def panels(self, job, rows):
        ours = [(1e3 * t, 1e3 * (z - 0.06)) for t, z in rows]
        return [Panel("way of the ball, mm", "time, ms", {"grainreel": ours},
                      {"LIGGGHTS and MUSEN": [(1e3 * self.lowest[0], 1e3 * self.lowest[1])]})]


class Drum:
    until, step, softer, title = 1.0, 0.8e-6, 1.0, "Grains in two quarters of a drum"
    published, column = {"LIGGGHTS": "case2_liggghts.csv", "MUSEN": "case2_musen.csv"}, "z2_m1"
    counts = ("z1_m1", "z1_m2", "z2_m1", "z2_m2")

    def prepare(self, job):
        grains = published_grains(job.data / "mercury" / "Drum_PartCoordinates.txt.xz")
        small = sum(radius < 0.0015 for radius, *_ in grains)
        write_table(job.folder / "start.csv",
                    [(1 if grain[0] < 0.0015 else 2, *grain, 0 if i else -NUDGE) for i, grain in enumerate(grains)])
        shutil.copy(job.data / "stl" / "drum_m.stl", job.folder / "drum.stl")
        return (species_table("M1", "M1", small, 0.002) + species_table("M2", "M2", len(grains) - small, 0.004) +
                contacts({"M1": "M1", "M2": "M2"}, "drum", self.softer) +
                "[container]\nshape = \"mesh\"\nmesh = \"drum\"\n"
                "[[mesh]]\nname = \"drum\"\nfile = \"drum.stl\"\n"
                "turn = { axis = [0, 1, 0], through = [0, 0, 0], rate = -2 }\n"
                "[start]\nmethod = \"file\"\nfile = \"start.csv\"\n" + job.run_table(self.step) +
                "[output]\ntrajectory_interval = 0.05\nmeasures_interval = 0.01\ninstruments = [\"walls\"]\n")

    def curve(self, job):
        frames, rows = Fields(job.run / "trajectory.nc"), []
        kind = frames.record("type", 0)
        for i, when in enumerate(frames.values("time")):
            place = frames.record("coordinates", i)
            row = [when]
            for side in (1, -1):
                inside = [k for x, z, k in zip(place[0::3], place[2::3], kind) if side * x > 0 and side * z > 0]
                row += [inside.count(1), inside.count(2)]
            rows.append(tuple(row))
        return ["t_s", *self.counts], rows

    def compare(self, job, rows):
        good, all_grains = True, {"m1": 30000, "m2": 8000}
        for when in (0.5, 1.0, 2.0, 3.0, 4.0):
            if when > job.until + 1e-9:
                continue
            for i, column in enumerate(self.counts):
                ours = at([(row[0], row[1 + i]) for row in rows], when)
                others = {name: at(job.results(file, column), when) for name, file in self.published.items()}
                mean = sum(others.values()) / len(others)
                words = (f"{column[3:].upper()} in zone {column[1]} at {when:g} s: {ours:.0f}; " +
                         ", ".join(f"{name} {count:.0f}" for name, count in others.items()))
                off = (ours - mean) / all_grains[column[3:]]
                if when > 1:  # beyond the task: told, not judged
                    print(f"{words}; {100 * off:+.1f} % of the grains")
                else:
                    good &= judge(words, off, 0.05)
        if job.until > 0.5 and "drum_torque_N.m" in table(job.run / "measures.csv")[-1]:  # not in runs of before
            torque, weight = self.torques(job)
            good &= judge(f"torque on the drum from 0.5 s to {job.until:g} s, mN m: {1e3 * torque:.2f}; of the grains' weight "
                          f"{1e3 * weight:.2f}", torque / weight - 1, 0.05)
        return good

    def torques(self, job, since=0.5):
        """About the axis, means from then on: of the grains on the drum, and of their weight, which it balances."""
        torque = [row["drum_torque_N.m"] for row in table(job.run / "measures.csv") if row["time_s"] > since]
        frames, weights = Fields(job.run / "trajectory.nc"), []
        mass = {k + 1: MATERIALS[m][1] * math.pi / 6 * d**3 for k, (m, d) in enumerate((("M1", 0.002), ("M2", 0.004)))}
        kind = frames.record("type", 0)
        for i, when in enumerate(frames.values("time")):
            if when > since:  # the axis is y: r x (0, 0, -m g) has m g x along it
                weights.append(9.81 * sum(mass[k] * x for x, k in zip(frames.record("coordinates", i)[0::3], kind)))
        return sum(torque) / len(torque), sum(weights) / len(weights)


    def panels(self, job, rows):
        last, wholes = rows[-1][0] + 1e-9, {"M1": 30000, "M2": 8000}
        ours, others, off = {}, {}, {}
        for column, name in (("z2_m1", "M1"), ("z2_m2", "M2")):
            ours[f"grainreel, {name}"] = [(row[0], row[1 + self.counts.index(column)]) for row in rows]
            for code, file in self.published.items():
                others.setdefault(code, []).extend(point for point in job.results(file, column) if point[0] <= last)
            off[f"grainreel, {name}"] = [(t, 100 * (at(ours[f"grainreel, {name}"], t) - count) / wholes[name])
                                         for t, count in job.results(self.published["MUSEN"], column) if t <= last]
        return [Panel("grains in the lower left quarter", "time, s", ours, others),
                Panel("off MUSEN, % of the grains", "time, s", off, {}, (-5, 5))]


class SoftDrum(Drum):
    step, softer, title = 2e-5, 0.002, "Soft grains in two quarters of a drum"


class Silo:
    until, step, softer = 1.5, 1.5e-6, 1.0
    grains, title = 100000, "100,000 grains run out of a silo"
    published = {"LIGGGHTS": "case1_large_M1_liggghts.csv", "MUSEN": "case1_large_M1_musen.csv"}
    column = "particles_above_orifice"
    fills = ((0.01, 0.05), (0.1, 0.05), (1, 0.02))  # stiffness, and seconds with it

    def scene(self, softer, start, gate, run, job):
        text = (species_table("M1", "M1", self.grains, 0.004) + contacts({"M1": "M1"}, "silo", softer) +
                "[container]\nshape = \"mesh\"\nmesh = \"silo\"\n[[mesh]]\nname = \"silo\"\nfile = \"silo.stl\"\n")
        if gate:
            text += (f"[[contact.pair]]\nbetween = [\"M1\", \"gate\"]\n{numbers('M1', 'steel', softer)}"
                     f"[[mesh]]\nname = \"gate\"\nfile = \"gate.stl\"\nposition = [0, 0, {ORIFICE - 2e-4}]\n")
        bottom = ORIFICE - (0.02 if gate else 0)
        text += f"[[exit]]\nlow = [-0.2, -0.2, -0.5]\nhigh = [0.2, 0.2, {bottom}]\n"
        return text + start + job.run_table(*run) + "[output]\ntrajectory_interval = 0.25\nmeasures_interval = 0.01\n"

    # The published start is not to be had. Soft grains settle behind a gate, and are then made stiffer by steps.
    def prepare(self, job):
        fill = job.folder.parent / f"silo_fill_{self.grains}"
        maker = Path(__file__).resolve().parents[2] / "scenes" / "meshes" / "make_meshes.py"
        start = "[start]\nsettle_limit = 3\n"
        for folder in (job.folder, fill):
            folder.mkdir(exist_ok=True)
            shutil.copy(job.data / "stl" / "silo_large_orifice_m.stl", folder / "silo.stl")
        subprocess.run([sys.executable, maker, "plate", fill / "gate.stl", "width=0.08", "depth=0.08"], check=True)
        for softer, duration in self.fills:
            name = f"fill_{softer:g}"
            text = self.scene(softer, start, True, (Silo.step / math.sqrt(softer), duration), job)
            if not (fill / name / "final.csv").exists():
                (fill / f"{name}.toml").write_text(text)
                job.call("movie", fill / f"{name}.toml", "--out", fill / name, "--force")
            shutil.copy(fill / name / "final.csv", fill / f"{name}.csv")  # a table without its run
            start = f"[start]\nmethod = \"file\"\nfile = \"{name}.csv\"\n"
        rows = table(fill / f"{name}.csv")
        write_table(job.folder / "start.csv", [(1, row["radius"], row["x"], row["y"], row["z"], 0 if i else -NUDGE)
                                               for i, row in enumerate(rows)])
        return self.scene(self.softer, start.replace(name, "start"), False, (self.step,), job)

    def curve(self, job):
        left = sorted(row["time_s"] for row in table(job.run / "outflow.csv"))
        times = [0.01 * i for i in range(int(job.until / 0.01 + 1e-6) + 1)]
        if job.until > times[-1] + 1e-6:
            times.append(job.until)  # of a run that was broken off
        rows, gone = [], 0
        for when in times:
            while gone < len(left) and left[gone] <= when:
                gone += 1
            rows.append((when, self.grains - gone))
        return ["t_s", self.column], rows

    def compare(self, job, rows):
        begin = 0.5 if job.until > 1 else 0.1

        def rate(points):
            return (at(points, begin) - at(points, job.until)) / (job.until - begin)
        others = {name: rate(job.results(file, self.column)) for name, file in self.published.items()}
        mean = sum(others.values()) / len(others)
        return judge(f"grains a second from {begin:.2g} to {job.until:g} s: {rate(rows):.0f}; " +
                     ", ".join(f"{name} {value:.0f}" for name, value in others.items()), rate(rows) / mean - 1, 0.05)


    def panels(self, job, rows):
        last = rows[-1][0] + 1e-9

        def rate(points):  # over a tenth of a second each
            times = [0.1 * i for i in range(int(10 * points[-1][0] + 1e-6) + 1)]
            return [((a + b) / 2, (at(points, a) - at(points, b)) / (b - a) / 1e3) for a, b in zip(times, times[1:])]
        others = {name: job.results(file, self.column) for name, file in self.published.items()}
        steady = [value for points in others.values() for t, value in rate(points) if 0.5 < t < 1.5]
        mean = sum(steady) / len(steady)
        return [Panel("grains above the orifice", "time, s", {"grainreel": rows},
                      {name: [(t, n - 100000 + self.grains) for t, n in points if t <= last][::1 + len(points) // 60]
                       for name, points in others.items()}),
                Panel("thousand grains a second", "time, s", {"grainreel": rate(rows)},
                      {name: [p for p in rate(points) if p[0] <= last] for name, points in others.items()},
                      (0.95 * mean, 1.05 * mean))]


class SoftSilo(Silo):
    until, step, softer, fills = 0.6, 1.5e-5, 0.01, Silo.fills[:1]
    grains, title = 40000, "40,000 soft grains run out of a silo"


CASES = {"impact": Impact, "impact_50k": DeepImpact, "drum": Drum, "drum_soft": SoftDrum, "silo": Silo, "silo_soft": SoftSilo}


class Panel:
    """A chart: axes, our curves, the published ones, and the band that is allowed."""

    def __init__(self, ordinate, abscissa, ours, others, band=None):
        self.ordinate, self.abscissa, self.ours, self.others, self.band = ordinate, abscissa, ours, others, band


# ---- Running and comparing --------------------------------------------------------------------------------------------

def at(rows, when):
    """Of rows (time, value): the value at a time, by straight lines; that of the last row behind it."""
    for (t0, v0), (t1, v1) in zip(rows, rows[1:]):
        if t0 <= when <= t1:
            return v0 + (v1 - v0) * (when - t0) / (t1 - t0)
    return rows[-1][1]


def judge(words, off, tolerance):
    held = abs(off) <= tolerance
    print(f"{words}; {100 * off:+.2f} %, allowed {100 * tolerance:g} %: {'ok' if held else 'NOT SO'}", flush=True)
    return held


class Job:
    def __init__(self, options, case):
        self.program, self.data, self.threads = options.program, options.data, options.threads
        self.until = options.until or case.until
        self.folder = options.out / options.case
        self.run = self.folder / "run"
        self.folder.mkdir(parents=True, exist_ok=True)

    def run_table(self, step, duration=None):
        # A step more, so that the last moment that is asked for is there.
        return f"[run]\nduration = {(duration or self.until) + step:.10g}\nstep = {step:.10g}\n"

    def call(self, *words):
        """Runs the program. A run that a signal ends is kept as far as it has come. Gives the processor time it took."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        command = [self.program, *words, "--no-film", "--no-report", *(["--threads", str(self.threads)] if self.threads else [])]
        done = subprocess.run(command, stdout=subprocess.DEVNULL)
        if done.returncode not in (0, 130, 143):
            raise subprocess.CalledProcessError(done.returncode, command)
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

    def state(self):
        file = self.run / "run.json"
        return json.loads(file.read_text()) if file.exists() else None

    def results(self, file, column):
        rows = table(self.data / "results" / file)
        if file == "case2_musen.csv":
            rows = rows[:-1]  # its last row counts one frame several times
        return [(row["t_s"], row[column]) for row in rows]


def run_case(job, case):
    """Runs the case, or goes on with it. Gives steps and seconds of processor time of all its pieces."""
    file = job.folder / "cost.json"
    cost = json.loads(file.read_text()) if file.exists() else {"steps": 0, "user_s": 0.0}
    state, end = job.state(), job.until + case.step
    if state is None:
        scene = job.folder / "scene.toml"
        scene.write_text(f"title = \"{case.title}\"\n" + case.prepare(job))
        cost["user_s"] += job.call("movie", scene, "--out", job.run, "--force")
    elif state["engine"]["simulated_s"] < job.until - 1e-9:
        cost["user_s"] += job.call("resume", job.run, "--until", f"{end:.10g}")
    cost["steps"] = job.state()["engine"]["steps"]
    file.write_text(json.dumps(cost))
    return cost


def chart(job, name, panels):
    """NAME.gp with all its numbers, and NAME.svg where gnuplot is."""
    blocks, plots = [], []
    for panel in panels:
        span = "[*:*]"
        ends = [t for rows in panel.ours.values() for t, _ in rows]
        parts = []
        if panel.band:
            low, high = panel.band
            values = [value for rows in (*panel.ours.values(), *panel.others.values()) for _, value in rows]
            room = 0.1 * (high - low)
            span = f"[{min(low, *values) - room:g}:{max(high, *values) + room:g}]"
            parts.append(f"[{min(ends):g}:{max(ends):g}] '+' using 1:({low:g}):({high:g}) with filledcurves lc rgb '#dddddd' "
                         "title 'allowed'")
        for i, (title, rows) in enumerate([*panel.ours.items(), *panel.others.items()]):
            data, own = f"$data{len(blocks)}", title in panel.ours
            blocks.append(f"{data} << END\n" + "".join(f"{t:.6g} {value:.6g}\n" for t, value in rows) + "END\n")
            look = f"lines lw 3 lc {i + 1}" if own else f"points pt {(6, 2)['MUSEN' in title]} ps 1.1 lc rgb 'black'"
            parts.append(f"{data} with {look} title '{title}'")
        plots.append(f"set yrange {span}\nset xlabel '{panel.abscissa}'\nset ylabel '{panel.ordinate}'\nplot " +
                     ", \\\n     ".join(parts) + "\n")
    (job.folder / f"{name}.gp").write_text(
        "# Made by tests/bench/eight_codes.py; the published values are those of Dosta et al. 2024 (its docstring).\n" +
        "".join(blocks) +
        "do for [form in 'svg png'] {\n"
        "if (form eq 'svg') { set terminal svg size 820,720 font 'DejaVu Sans,14' background 'white' } "
        "else { set terminal pngcairo size 1230,1080 font 'DejaVu Sans,18' }\n"
        f"set output '{name}.'.form\nset grid\nset key outside right top\nset lmargin 11\nset rmargin 24\n"
        f"set multiplot layout {len(panels)},1\n" + "".join(plots) + "unset multiplot\n}\n")
    if shutil.which("gnuplot"):
        subprocess.run(["gnuplot", f"{name}.gp"], cwd=job.folder, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("data", type=Path)
    parser.add_argument("case", choices=CASES)
    parser.add_argument("--until", type=float, help="seconds, in place of the case's own")
    parser.add_argument("--threads", type=int)
    parser.add_argument("--out", type=Path, default=Path("output/eight_codes"))
    options = parser.parse_args()
    if not (options.data / "results").is_dir():
        parser.error(f"{options.data}: has no folder results; give the folder of the benchmark's inputs and results")
    case = CASES[options.case]()
    job = Job(options, case)
    try:
        cost = run_case(job, case)
    except subprocess.CalledProcessError as error:
        sys.exit(f"`{' '.join(map(str, error.cmd))}` ended with {error.returncode}")
    engine = job.state()["engine"]
    come = engine["simulated_s"]
    whole = come >= job.until - 1e-9
    if not whole:
        print(f"broken off at {come:g} s; the same command goes on with it")
        job.until = come  # curves and charts end where the run has ended
    head, rows = case.curve(job)
    with open(job.folder / f"{options.case}.csv", "w", newline="") as file:
        csv.writer(file).writerows([head, *rows])
    chart(job, options.case, case.panels(job, rows))
    if cost["user_s"]:
        print(f"{options.case}: {engine['grains']} grains, {cost['steps']} steps, {cost['user_s']:.0f} s of processor time: "
              f"{engine['grains'] * cost['steps'] / cost['user_s'] / 1e6:.2f} million grain-steps a second and core")
    return 0 if case.compare(job, rows) and whole else 1


if __name__ == "__main__":
    sys.exit(main())
