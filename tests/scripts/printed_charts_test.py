#!/usr/bin/env python3
"""Charts for print: their curves are the rows of measures.csv, and they are as large as they were asked for.

usage: printed_charts_test.py GRAINREEL
"""
import csv
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import guide_files  # noqa: E402

POINT = 25.4 / 72  # mm
STUDY = """
scene = "bed.toml"
seeds = 2
set = ["run.duration=0.05 s"]
[[vary]]
key = "drive.g_level"
values = [2, 3]
[[measure]]
name = "rise"
column = "centre_z_m"
reduce = "end"
[[chart]]
y = "rise"
"""


def check(holds, words):
    if not holds:
        sys.exit(words)


def run(folder, *words, status=0):
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True, check=False)
    check(done.returncode == status, f"{words} ended with {done.returncode}, not {status}:\n{done.stderr}")
    return done


def column(file, name):
    with open(file, newline="") as table:
        return [float(row[name] or "nan") for row in csv.DictReader(table)]


def fit(wanted, found, words):
    """The line found = a + b wanted, which must hold to a fiftieth of a point at each; gives b."""
    n, mx, my = len(wanted), sum(wanted) / len(wanted), sum(found) / len(found)
    b = sum((x - mx) * (y - my) for x, y in zip(wanted, found)) / sum((x - mx) ** 2 for x in wanted)
    worst = max(abs(my + b * (x - mx) - y) for x, y in zip(wanted, found))
    check(worst < 0.02, f"{words}: of {n} points one lies {worst} points off")
    return b


def nearest_rows(points, times):
    """Of each point the row, by its place along the axis of time, which goes from the first row to the last."""
    (left, _), (right, _) = points[0], points[-1]
    at = [times[0] + (x - left) / (right - left) * (times[-1] - times[0]) for x, _ in points]
    return [min(range(len(times)), key=lambda k: abs(times[k] - t)) for t in at]


def check_curve(points, times, values, words, every_row=True):
    """Cairo leaves out points between others on a straight line; then those that are there must be rows."""
    if not every_row:
        rows = nearest_rows(points, times)
        check(len(set(rows)) == len(points) > len(times) / 2, f"{words}: points lie between rows")
        times, values = [times[k] for k in rows], [values[k] for k in rows]
    check(len(points) == len(times), f"{words}: {len(points)} points for {len(times)} rows")
    across = fit(times, [x for x, _ in points], words + ", time")
    upright = fit(values, [y for _, y in points], words + ", value")
    return across, upright


def svg_curve(text):
    group = text[text.index('<g id="gnuplot_plot_1"'):]
    group = group[:group.index("\n</g>\n", group.index("<path"))] if "<path" in group else group
    path = re.search(r"<path[^>]* d='([^']*)'", group, re.DOTALL).group(1)
    return [tuple(map(float, pair)) for pair in re.findall(r"(-?[\d.]+),(-?[\d.]+)", path)]


def svg_ticks(text, anchor, axis):
    """Numbers at the ticks of an axis, and where their words stand."""
    found = re.findall(r'translate\(([\d.]+),([\d.]+)\)"[^>]*text-anchor="' + anchor + r'">\s*<text>([−\d. ]+)<',
                       text)
    return [(float(word.replace("−", "-")), float((x, y)[axis])) for x, y, word in found]


def check_svg(file, times, values, size, width):
    text = file.read_text(encoding="utf-8")
    found = re.search(r'width="([\d.]+)mm" height="([\d.]+)mm"', text)
    check(found and float(found[1]) == width, f"{file}: is not {width} mm wide")
    across, upright = check_curve(svg_curve(text), times, values, str(file))
    for anchor, axis, slope, unit in (("middle", 0, across, 1), ("end", 1, upright, size)):
        ticks = svg_ticks(text, anchor, axis)
        check(len(ticks) >= 2, f"{file}: has {len(ticks)} numbers at an axis")
        (a, at), (b, bt) = ticks[0], ticks[-1]
        shown = (bt - at) / ((b - a) * unit)
        check(abs(shown / slope - 1) < 2e-3, f"{file}: its ticks have {shown} points a unit, its curve {slope}")
    check('font-size="8.0' in text, f"{file}: its letters have not 8 points")


def pdf_streams(data):
    for part in re.findall(rb"stream\r?\n(.*?)endstream", data, re.DOTALL):
        try:
            yield zlib.decompress(part)
        except zlib.error:
            continue


def pdf_text(file):
    """All that a PDF says, out of its streams too: since Cairo 1.18 pages and fonts stand there."""
    data = file.read_bytes()
    return data + b"".join(pdf_streams(data))


def check_pdf(file, times, values, width, height):
    data = pdf_text(file)
    box = list(map(float, re.search(rb"/MediaBox \[ ([\d. ]+)\]", data)[1].split()))
    check(abs(box[2] * POINT - width) < 0.18 and abs(box[3] * POINT - height) < 0.18,
          f"{file}: has {box[2] * POINT} mm x {box[3] * POINT} mm")
    check(b"/FontFile" in data and b"DejaVuSans" in data, f"{file}: its letters are not embedded")
    check(b"/Subtype /Image" not in data, f"{file}: has a picture of pixels")
    lines = [re.findall(r"(-?[\d.]+) (-?[\d.]+) [ml]\b", path)
             for stream in pdf_streams(data) for path in re.split(r"\bS\b", stream.decode("latin-1"))]
    longest = max(lines, key=len)
    check_curve([tuple(map(float, pair)) for pair in longest], times, values, str(file), every_row=False)
    sizes = re.findall(r"([\d.]+) 0 0 -[\d.]+ [\d.]+ [\d.]+ Tm", "".join(s.decode("latin-1") for s in pdf_streams(data)))
    check(sizes and all(abs(float(size) - 8) < 0.05 for size in sizes), f"{file}: letters of {set(sizes)} points")


def check_png(file, width, height, dpi):
    data = file.read_bytes()
    chunks, at = {}, 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        check(zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0], f"{file}: {kind}")
        chunks.setdefault(kind, body)
        at += 12 + length
    size = struct.unpack(">II", chunks[b"IHDR"][:8])
    dots = struct.unpack(">IIB", chunks[b"pHYs"])
    check(dots == (round(dpi / 0.0254), round(dpi / 0.0254), 1), f"{file}: says {dots}")
    for pixels, mm in zip(size, (width, height)):
        check(abs(pixels / dpi * 25.4 - mm) < 25.4 / dpi, f"{file}: has {pixels} pixels for {mm} mm")


def check_run(folder):
    made = run(folder, "report", "bed", "--charts", "fig", "--as", "pdf,svg,png", "--measures", "centre_z_m,kinetic_J")
    check(made.stdout == "fig\n", made.stdout)
    check(not (folder / "bed/report.html").exists(), "charts are made in place of the page")
    table = folder / "bed/measures.csv"
    times = column(table, "time_s")
    check(len(times) > 20, f"{len(times)} rows are few")
    for name, unit in (("centre_z_m", 1e-3), ("kinetic_J", None)):
        values = column(table, name)
        check(column(folder / f"fig/{name}.csv", name) == values, f"the table of {name} is another")
        check_pdf(folder / f"fig/{name}.pdf", times, values, 85, 0.68 * 85)
        check_png(folder / f"fig/{name}.png", 85, 0.68 * 85, 300)
        if unit:
            check_svg(folder / f"fig/{name}.svg", times, values, unit, 85)
            check("(mm)" in (folder / f"fig/{name}.svg").read_text(encoding="utf-8"), "the unit is missing")
    run(folder, "report", "bed", "--charts", "wide", "--width-mm", "170", "--as", "pdf")
    check({file.suffix for file in (folder / "wide").iterdir()} == {".csv", ".gp", ".pdf"}, "other files than were asked for")
    box = re.search(rb"/MediaBox \[ 0 0 (\d+) (\d+)", pdf_text(next((folder / "wide").glob("*.pdf"))))
    check((int(box[1]), int(box[2])) == (482, 283), f"170 mm x 100 mm are not {box[1]} x {box[2]} points")


def check_several(folder):
    run(folder, "movie", "bed.toml", "--out", "calm", "--no-film", "--no-report", "--quiet", "--set", "drive.g_level=2")
    run(folder, "report", "bed", "calm", "--charts", "both", "--as", "svg", "--measures", "centre_z_m")
    text = (folder / "both/centre_z_m.svg").read_text(encoding="utf-8")
    check(text.count('<g id="gnuplot_plot_') == 2 and "Γ = 2" in text and "Γ = 3" in text, "a line and a name for each run")


def check_study(folder):
    (folder / "shaking.toml").write_text(STUDY)
    run(folder, "study", "shaking.toml", "--out", "study", "--quiet", "--no-posters", "--charts", "print", "--as", "svg,pdf")
    with open(folder / "study/study.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    means = [sum(float(r["rise"]) for r in rows if float(r["drive.g_level"]) == g) / 2 for g in (2, 3)]
    stem = next((folder / "print").glob("*.svg")).stem
    shown = column(folder / f"print/{stem}.csv", "mean")
    check(all(math.isclose(a, b, rel_tol=1e-12) for a, b in zip(means, shown)), f"{shown} are not {means}")
    text = (folder / f"print/{stem}.svg").read_text(encoding="utf-8")
    check('width="85mm"' in text and text.count("xlink:href='#gpPt") >= 4, "points and bars")
    before = (folder / "study/study.csv").stat().st_mtime_ns
    run(folder, "study", "shaking.toml", "--out", "study", "--quiet", "--collect", "--charts", "again")
    check(next((folder / "again").glob("*.pdf")).stat().st_size > 0 and before, "nothing is run for other charts")


def check_mistakes(folder):
    for words, piece in ((["--charts", "x", "--measures", "nonsense"], "nonsense: no such column"),
                         (["--charts", "x", "--as", "eps"], "eps"),
                         (["--as", "pdf"], "--charts"),
                         (["--charts", "bed.toml"], "is a file"),
                         (["--charts", ""], "is empty"),
                         (["--charts", "x", "--width-mm", "nan"], "--width-mm"),
                         (["--charts", "x", "--width-mm", "1"], "--width-mm"),
                         (["--charts", "x", "--as", "png", "--width-mm", "900", "--dpi", "2400"], "pixels"),
                         (["--charts", "x", "--out", "y.html"], "--out")):
        said = run(folder, "report", "bed", *words, status=2).stderr
        check(piece in said and said.count("\n") == 1, f"{words}: {said}")
    check(not (folder / "x").exists(), "a mistake leaves a folder")


PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
with tempfile.TemporaryDirectory() as name:
    here = pathlib.Path(name)
    (here / "bed.toml").write_text(guide_files.SCENE.format(small=40, big=10, width=30, height=40, duration=0.2, interval=0.1))
    run(here, "movie", "bed.toml", "--out", "bed", "--no-film", "--no-report", "--quiet")
    check_run(here)
    check_several(here)
    check_study(here)
    check_mistakes(here)
