"""Folders that vanish or may not be written, caches in any state, and two programs in one place."""
import os
import random
import shutil
import signal
import subprocess
import time

from tools import BUSY, FILES, PLAIN, SmallDisk, content, difference, record_of, scene_in, wait_for

NOBODY = 65534


def gone(bench):
    """rm -rf of the run's folder while the run goes on."""
    here = bench.fresh("gone")
    scene = scene_in(here)
    took = bench.must("movie", scene, "--out", here / "whole").seconds
    moments = 10 if bench.long else 4
    for k in range(moments):
        run = here / "run"
        process = bench.start("movie", scene, "--out", run)
        wait_for(process, run.exists)
        time.sleep(took * k / moments)
        before = record_of(run)
        while run.exists():
            shutil.rmtree(run, ignore_errors=True)
        ended = bench.end(process)
        what = f"gone at {k}/{moments}"
        if before.get("status") == "complete":
            bench.count("ended before")
            continue
        if not bench.check(ended.status != 0, f"{what}: false success"):
            continue
        bench.crashed(ended, what)
        bench.check(len(ended.errors) == 1 and str(run) in ended.said(), f"{what}: {ended.err[-400:]}")
        bench.check(not run.exists(), f"{what}: something was written there again")
        bench.count(f"status {ended.status}")
        shutil.rmtree(run, ignore_errors=True)


def as_nobody():
    os.setgroups([])
    os.setgid(NOBODY)
    os.setuid(NOBODY)


def read_only(bench):
    """Folders that may not be written: where the run should go, the run's own, and the working folder."""
    here = bench.fresh("read_only")
    scene = scene_in(here)
    bench.must("movie", scene, "--out", here / "whole")
    how = {"preexec_fn": as_nobody} if os.geteuid() == 0 else {}
    shut, open_ = here / "shut", here / "open"
    shut.mkdir(mode=0o555)
    open_.mkdir(mode=0o777)
    open_.chmod(0o777)
    ended = bench.run("movie", scene, "--out", shut / "run", **how)
    bench.check(ended.status == 2 and len(ended.errors) == 1 and str(shut) in ended.said(), f"shut: {ended.err}")
    bench.count("refused")
    ended = bench.run("movie", scene, cwd=shut, **how)  # into the folder output of the working folder
    bench.check(ended.status == 2 and len(ended.errors) == 1, f"shut working folder: {ended.err}")
    ended = bench.run("movie", scene, "--out", open_ / "elsewhere", cwd=shut, **how)
    bench.check(ended.status == 0, f"shut working folder, --out elsewhere: {ended.said()}")
    apart = difference(here / "whole", open_ / "elsewhere")
    bench.check(not apart, f"shut working folder, --out elsewhere: {apart}")
    # The folder is closed while the run goes on: files that are open grow, new ones cannot be made.
    run = open_ / "run"
    process = bench.start("movie", scene, "--out", run, **how)
    wait_for(process, (run / "checkpoint.grs").exists)
    run.chmod(0o555)
    ended = bench.end(process)
    bench.check(ended.status == 1 and len(ended.errors) == 1 and str(run) in ended.said(), f"closed in mid-run: {ended.err}")
    bench.check(record_of(run).get("status") == "failed", f"closed in mid-run: run.json says {record_of(run).get('status')}")
    again = bench.run("resume", run, **how)
    bench.check(again.status in (1, 2) and len(again.errors) == 1, f"resume in a closed folder: {again.err}")
    run.chmod(0o755)
    again = bench.run("resume", run, **how)
    apart = difference(here / "whole", run)
    bench.check(again.status == 0 and not apart, f"resume after a closed folder: {again.said()} {apart}")
    bench.count("resumed")


def packing_words(scene, run, more=()):
    return "movie", scene, "--no-film", "--no-report", "--out", run, *more


def caches(bench):
    """A cache that is damaged, foreign, full, closed, gone, or a file: the right run, and no wrong packing."""
    here = bench.fresh("caches")
    scene = scene_in(here, PLAIN)
    keeping = bench.environment(GRAINREEL_PACKINGS="all")
    bench.must(*packing_words(scene, here / "whole"))
    cache = here.parent / "cache" / "grainreel" / "packings"
    shutil.rmtree(cache, ignore_errors=True)

    def alike(what, env=keeping, **how):
        run = here / "run"
        shutil.rmtree(run, ignore_errors=True)
        ended = bench.run(*packing_words(scene, run), env=env, **how)
        apart = difference(here / "whole", run) if ended.status == 0 else ended.said()
        bench.check(not apart, f"{what}: {apart}")
        bench.count("alike")
        return ended

    alike("empty cache")
    kept = list(cache.glob("*.grs"))
    if not bench.check(len(kept) == 1, f"{len(kept)} packings kept"):
        return
    good = kept[0].read_bytes()
    alike("kept packing")
    dice = random.Random(2)
    for k in range(20 if bench.long else 5):
        bad = bytearray(good)
        how = k % 5
        if how == 0:
            bad[dice.randrange(len(bad))] ^= 1 << dice.randrange(8)
        elif how == 1:
            bad = bad[:dice.randrange(len(bad))]
        elif how == 2:
            at = dice.randrange(len(bad))
            bad[at:at + 512] = bytes(len(bad[at:at + 512]))
        elif how == 3:
            bad += b"more"
        else:
            at = dice.randrange(len(bad) - 16)
            del bad[at:at + 8]
        kept[0].write_bytes(bad)
        ended = alike(f"damaged packing {k}")
        bench.check(bytes(bad) == good or kept[0].read_bytes() == good, f"damaged packing {k} stays")
    kept[0].unlink()
    kept[0].mkdir()
    alike("a folder has the packing's name")
    kept[0].rmdir()
    os.mkfifo(kept[0])
    alike("a pipe has the packing's name")
    kept[0].unlink()
    kept[0].symlink_to("/dev/zero")
    alike("a link to an endless device has the packing's name")
    kept[0].unlink()
    shutil.rmtree(cache)
    cache.write_text("no folder")
    alike("the cache is a file")
    cache.unlink()
    with SmallDisk(here / "small", "size=8192"):
        ended = alike("the cache is full", bench.environment(GRAINREEL_PACKINGS="all", XDG_CACHE_HOME=str(here / "small")))
        left = [f for f in (here / "small").rglob("*") if f.is_file() and f.suffix == ".new"]
        bench.check(not left, f"a full cache keeps {left}")
    with SmallDisk(here / "small", "size=1m,nr_inodes=2"):
        alike("the cache takes no files", bench.environment(GRAINREEL_PACKINGS="all", XDG_CACHE_HOME=str(here / "small")))
    with SmallDisk(here / "small", "size=1m") as disk:
        disk.change("ro")
        alike("the cache is read-only", bench.environment(GRAINREEL_PACKINGS="all", XDG_CACHE_HOME=str(here / "small")))
    for name, environment in {"no HOME": {"HOME": None, "XDG_CACHE_HOME": None}, "HOME is no folder": {
            "HOME": "/dev/null", "XDG_CACHE_HOME": None}, "XDG_CACHE_HOME is relative": {"XDG_CACHE_HOME": "cache"}}.items():
        alike(name, bench.environment(GRAINREEL_PACKINGS="all", **environment))
    gone_in_mid_run(bench, here, scene, cache, keeping)
    shared(bench, here, scene, cache, keeping)


def gone_in_mid_run(bench, here, scene, cache, keeping):
    run = here / "vanishing"
    process = bench.start(*packing_words(scene, run), env=keeping)
    while process.poll() is None:
        shutil.rmtree(cache.parent, ignore_errors=True)
        time.sleep(0.002)
    ended = bench.end(process)
    apart = difference(here / "whole", run) if ended.status == 0 else ended.said()
    bench.check(not apart, f"a cache that vanishes all the time: {apart}")
    bench.count("alike")


def shared(bench, here, scene, cache, keeping):
    """Two runs fill the same cache at once, several times, and a third reads it."""
    for k in range(6 if bench.long else 2):
        shutil.rmtree(cache, ignore_errors=True)
        runs = [here / f"shared-{k}-{n}" for n in range(3)]
        for process in [bench.start(*packing_words(scene, run), env=keeping) for run in runs[:2]]:
            bench.end(process)
        bench.must(*packing_words(scene, runs[2]), env=keeping)
        for run in runs:
            apart = difference(here / "whole", run)
            bench.check(not apart, f"shared cache: {apart}")
            bench.count("alike")
        names = [one.name for one in cache.iterdir()]
        bench.check(len(names) == 1, f"shared cache holds {names}")


def two(bench):
    """Two runs, two `resume`, or both, begin in one folder at once: one of them is refused in one line."""
    here = bench.fresh("two")
    scene = scene_in(here)
    bench.must("movie", scene, "--out", here / "whole")
    for k in range(10 if bench.long else 3):
        run = here / f"run-{k}"
        if k % 2:
            run.mkdir()  # an empty folder may be given, too
        one_of_two(bench, here, run, [("movie", scene, "--out", run)] * 2, f"two runs ({k})")
    # A run that was stopped is resumed twice at once.
    stopped = here / "stopped"
    process = bench.start("movie", scene, "--out", stopped)
    wait_for(process, lambda: (stopped / "trajectory.nc").exists() and (stopped / "checkpoint.grs").exists())
    process.kill()
    bench.end(process)
    for k in range(10 if bench.long else 3):
        run = here / f"resumed-{k}"
        shutil.copytree(stopped, run, symlinks=True)
        one_of_two(bench, here, run, [("resume", run)] * 2, f"two resume ({k})")
    run = here / "replaced"
    shutil.copytree(stopped, run, symlinks=True)
    one_of_two(bench, here, run, [("resume", run), ("movie", scene, "--out", run, "--force")], "resume and --force")
    run = here / "replaced-twice"
    shutil.copytree(stopped, run, symlinks=True)
    one_of_two(bench, here, run, [("movie", scene, "--out", run, "--force")] * 2, "twice --force")


def one_of_two(bench, here, run, commands, what):
    both = [bench.end(process) for process in [bench.start(*words) for words in commands]]
    statuses = sorted(ended.status for ended in both)
    if bench.check(statuses == [0, 2], f"{what}: exit statuses {statuses}: {[ended.said() for ended in both]}"):
        refused = next(ended for ended in both if ended.status == 2)
        bench.check(len(refused.err.splitlines()) == 1 and str(run) in refused.said(), f"{what}: {refused.err}")
        bench.count("one refused")
    apart = difference(here / "whole", run)
    bench.check(not apart, f"{what}: {apart}")
    bench.check(not (run / ".lock").exists(), f"{what}: .lock stays")


GROUPS = {"folder gone": gone, "read-only": read_only, "caches": caches, "two at once": two}
