"""Clocks that jump, little memory, streams that are closed, foreign locales, and odd names."""
import json
import os
import re
import resource
import shutil
import subprocess
from pathlib import Path

from tools import BUSY, PLAIN, compiled, content, difference, scene_in

CLOCK = Path(__file__).with_name("clock.c")


def clocks(bench):
    """The time of day jumps forth and back by hours during a run, and its `resume`; the other clock leaps."""
    here = bench.fresh("clocks")
    scene = scene_in(here)
    bench.must("movie", scene, "--out", here / "whole")
    shim = compiled(CLOCK, here / "clock.so")
    if shim is None:
        bench.count("left out: no C compiler")
        return
    for leaps in (None, "yes"):
        env = bench.environment(LD_PRELOAD=str(shim), CLOCK_LEAPS=leaps, GRAINREEL_PACKINGS="all")
        run = here / f"run-{leaps}"
        ended = bench.run("movie", scene, "--out", run, "--progress", "json", env=env)
        what = "clock leaps" if leaps else "time of day jumps"
        bench.check(ended.status == 0, f"{what}: {ended.status}: {ended.said()}")
        apart = difference(here / "whole", run)
        bench.check(not apart, f"{what}: {apart}")
        lines = [json.loads(line) for line in ended.err.decode().splitlines()]
        progress = [line for line in lines if line["event"] == "progress"]
        bench.check(all(line.get("remaining_s", 0) >= 0 and line["elapsed_s"] >= 0 for line in progress),
                    f"{what}: times below zero: {progress[-1:]}")
        record = json.loads((run / "run.json").read_text())
        negative = re.findall(r'"[a-z_ ]+": -[0-9.]+', json.dumps({k: record[k] for k in record if "wall" in k}))
        bench.check(not negative, f"{what}: run.json has {negative}")
        ended = bench.run("resume", run, "--until", "0.12 s", env=env)
        bench.check(ended.status == 0, f"{what}: resume: {ended.status}: {ended.said()}")
        for words in (("check", scene), ("report", run), ("inspect", run, "--at", "0"), ("doctor",)):
            ended = bench.run(*words, env=env)
            bench.check(ended.status == 0, f"{what}: {words[0]}: {ended.status}: {ended.said()}")
            below = re.findall(rb"\n.*[ (]-[0-9].*", ended.out) if words[0] in ("check", "doctor") else []
            bench.check(not below, f"{what}: {words[0]}: {below}")
        bench.count("alike")


def memory(bench):
    """Limits of address space from almost nothing to plenty."""
    here = bench.fresh("memory")
    scene = scene_in(here)
    wholes = {film: here / f"whole-{len(film)}" for film in ((), ("--no-film",))}
    for film, whole in wholes.items():
        bench.must("movie", scene, "--out", whole, *film)
    moments = [(mega, film) for film in wholes for mega in
               (range(150, 1150, 40) if bench.long else (160, 230, 360, 560, 1200))]
    for mega, film in moments:
        run = here / f"run-{mega}-{len(film)}"
        ended = bench.run("movie", scene, "--out", run, *film,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (mega << 20, mega << 20)))
        what = f"{mega} MB {film}"
        if (ended.status == 127 and b"shared libraries" in ended.err) or (ended.status == 139 and not run.exists()):
            bench.count("not loaded by the system")
            continue
        bench.count(f"status {ended.status}")
        if ended.status == 0:
            apart = difference(wholes[film], run)
            bench.check(not apart, f"{what}: {apart}")
        elif not bench.crashed(ended, what):
            one = len(ended.errors) == 1 and "bad_alloc" not in ended.said()
            bench.check(one and ("limit" in ended.said() or "memory" in ended.said()), f"{what}: {ended.err[-300:]}")
            bench.check(ended.status != 2 or not run.exists(), f"{what}: refused, but made")
            if not run.exists():
                continue
            again = bench.run("resume", run)
            apart = difference(wholes[film], run) if again.status == 0 else ""
            bench.check(again.status in (0, 2) and not apart, f"{what}: resume: {again.said()} {apart}")


def streams(bench):
    """Stdin, stdout and stderr closed, full, or read-only."""
    here = bench.fresh("streams")
    scene = scene_in(here)
    bench.must("movie", scene, "--out", here / "whole")
    cases = {"no stdin": ("<&-", 0), "no stderr": ("2>&-", 0), "no stdout": (">&-", 1), "none": ("<&- >&- 2>&-", 1),
             "full stdout": (">/dev/full", 1), "full stderr": ("2>/dev/full", 0), "read-only stdout": ("1</dev/null", 1)}
    for name, (redirection, status) in cases.items():
        run = here / name.replace(" ", "_")
        env = bench.environment()
        line = f'exec "$0" movie "$1" --frames --out "$2" {redirection}'
        done = subprocess.run(["sh", "-c", line, bench.program, scene, run], env=env, cwd=here, capture_output=True)
        bench.check(done.returncode == status, f"{name}: exit status {done.returncode}: {done.stderr[-200:]!r}")
        apart = difference(here / "whole", run)
        bench.check(not apart, f"{name}: {apart}")
        told = b"stdout: cannot be written" in done.stderr
        bench.check(told == (status == 1 and "2>" not in redirection), f"{name}: says {done.stderr[-200:]!r}")
        bench.count("alike")
        for words in ("check", "inspect"):  # results of verbs that write nothing else
            what = scene if words == "check" else run
            line = f'exec "$0" {words} "$1" {redirection}'
            done = subprocess.run(["sh", "-c", line, bench.program, what], env=env, cwd=here, capture_output=True)
            bench.check(done.returncode == status, f"{name}: {words}: exit status {done.returncode}")


def made_locale(here):
    """A locale with a decimal comma, made by localedef; None where that is not there."""
    if shutil.which("localedef") is None or not Path("/usr/share/i18n/locales/de_DE").exists():
        return None
    subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", here / "de_DE.UTF-8"], check=False, capture_output=True)
    return here / "de_DE.UTF-8" if (here / "de_DE.UTF-8").is_dir() else None


def locales(bench):
    """C, POSIX, one that is missing, one with a decimal comma, and one of Latin-1."""
    here = bench.fresh("locales")
    scene = scene_in(here, BUSY.replace("Busy", "Größe 1,5"))
    bench.must("movie", scene, "--out", here / "whole")
    german = made_locale(here)
    cases = [{"LC_ALL": "C"}, {"LC_ALL": "POSIX"}, {"LC_ALL": "xx_YY.UTF-8"}, {"LC_ALL": None, "LANG": None}]
    if german:
        cases += [{"LC_ALL": "de_DE.UTF-8", "LOCPATH": str(here)}]
    else:
        bench.count("left out: no localedef with de_DE")
    expected = bench.must("inspect", here / "whole", "--at", "0.05").out
    for case in cases:
        run = here / f"run-{case['LC_ALL']}"
        env = bench.environment(**case)
        ended = bench.run("movie", scene, "--out", run, env=env)
        apart = difference(here / "whole", run) if ended.status == 0 else ended.said()
        bench.check(not apart, f"{case}: {apart}")
        shown = bench.run("inspect", run, "--at", "0.05", env=env)
        bench.check(shown.out == expected, f"{case}: inspect answers otherwise: {shown.said()}")
        pages = [content(here / "whole" / "report.html"), content(run / "report.html")]
        bench.check(all(pages) and b"1,5" in pages[1], f"{case}: page")
        bench.count("alike")


ODD = [b"two words", b'"quoted"', b"it's", b"a\nline", b"a\ttab", b"\xff\xfe.not-utf8", "Größe".encode(), b"--out", b"%s%n",
       b"$(true)", b"a&b;c|d", b"<script>", b"*", b"." + b"x" * 200, b"\\", b"#1", b"a=b", b"\x1b[31m"]


def names(bench):
    """Folders of runs with blanks, quotes, line ends, control characters and bytes that are no UTF-8."""
    here = bench.fresh("names")
    scene = scene_in(here)
    bench.must("movie", scene, "--out", here / "whole")
    for name in ODD if bench.long else ODD[::2]:
        place = os.path.join(os.fsencode(here), name)
        ended = bench.run("movie", scene, "--out", os.path.join(os.fsencode(here), name))
        harmless = not re.search(rb"[\x00-\x08\x0b-\x1f\x7f]", ended.out + ended.err)
        bench.check(harmless or name == b"\x1b[31m", f"{name!r}: control characters are printed: {ended.out!r} {ended.err!r}")
        if ended.status == 2 and len(ended.errors) == 1:
            bench.count("refused")
            bench.check(not os.path.exists(place), f"{name!r}: refused, but made")
            continue
        bench.check(ended.status == 0, f"{name!r}: {ended.status}: {ended.said()}")
        if ended.status != 0:
            continue
        bench.count("alike")
        apart = difference(here / "whole", os.fsdecode(place))
        bench.check(not apart, f"{name!r}: {apart}")
        for words in (["inspect", place, "--at", "0"], ["report", place], ["resume", place, "--until", "0.11 s"],
                      ["export", place, "--to", "csv"]):
            after = bench.run(*words)
            bench.check(after.status == 0, f"{name!r}: {words[0]}: {after.status}: {after.said()}")
    # A scene with such a name, and a working folder.
    for name in ODD if bench.long else ODD[1::2]:
        folder = os.path.join(os.fsencode(here), b"in-" + name)
        os.mkdir(folder)
        file = os.path.join(folder, name + b".toml")
        with open(file, "w") as out:
            out.write(PLAIN)
        ended = bench.run("movie", file, "--no-film", cwd=folder)
        well = ended.status == 0 or (ended.status == 2 and len(ended.errors) == 1)
        bench.check(well, f"scene {name!r}: {ended.status}: {ended.said()}")
        bench.count("scenes run" if ended.status == 0 else "scenes refused")


GROUPS = {"clocks": clocks, "memory": memory, "streams": streams, "locales": locales, "names": names}
