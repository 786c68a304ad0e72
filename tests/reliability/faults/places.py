"""Folders that vanish or may not be written, caches in any state, and two programs in one place."""
import os
import random
import shutil
import time

from tools import PLAIN, SmallDisk, difference, record_of, scene_in, wait_for

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
        wait_for(process, (run / "run.json").exists)  # before, the run may still make its folder once more
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


class Cache:
    """A scene, the run of it that packs by itself, and runs that use what the cache holds."""

    def __init__(self, bench):
        self.bench, self.here = bench, bench.fresh("caches")
        self.scene = scene_in(self.here, PLAIN)
        self.keeping = bench.environment(GRAINREEL_PACKINGS="all")
        self.folder = bench.folder / "cache" / "grainreel" / "packings"
        bench.must(*packing_words(self.scene, self.here / "whole"))
        shutil.rmtree(self.folder, ignore_errors=True)

    def alike(self, what, **environment):
        run = self.here / "run"
        shutil.rmtree(run, ignore_errors=True)
        ended = self.bench.run(*packing_words(self.scene, run), env=self.bench.environment(
            GRAINREEL_PACKINGS="all", **environment))
        self.same(run, ended, what)

    def same(self, run, ended, what):
        apart = difference(self.here / "whole", run) if ended.status == 0 else ended.said()
        self.bench.check(not apart, f"{what}: {apart}")
        self.bench.count("alike")


def caches(bench):
    """A cache that is damaged, foreign, full, closed, gone, or a file: the right run, and no wrong packing."""
    cache = Cache(bench)
    cache.alike("empty cache")
    kept = list(cache.folder.glob("*.grs"))
    if not bench.check(len(kept) == 1, f"{len(kept)} packings kept"):
        return
    cache.alike("kept packing")
    damaged_packings(cache, kept[0])
    other_things(cache, kept[0])
    small = cache.here / "small"
    with SmallDisk(small, "size=8192"):
        cache.alike("the cache is full", XDG_CACHE_HOME=str(small))
        left = [file for file in small.rglob("*") if file.is_file() and file.suffix == ".new"]
        bench.check(not left, f"a full cache keeps {left}")
    with SmallDisk(small, "size=1m,nr_inodes=2"):
        cache.alike("the cache takes no files", XDG_CACHE_HOME=str(small))
    with SmallDisk(small, "size=1m") as disk:
        disk.change("ro")
        cache.alike("the cache is read-only", XDG_CACHE_HOME=str(small))
    cache.alike("no HOME", HOME=None, XDG_CACHE_HOME=None)
    cache.alike("HOME is no folder", HOME="/dev/null", XDG_CACHE_HOME=None)
    cache.alike("XDG_CACHE_HOME is relative", XDG_CACHE_HOME="cache")
    gone_in_mid_run(bench, cache)
    shared(bench, cache)


def damaged(good, how, dice):
    bad = bytearray(good)
    at = dice.randrange(len(bad) - 16)
    if how == 0:
        bad[at] ^= 1 << dice.randrange(8)
    elif how == 1:
        del bad[at:]
    elif how == 2:
        bad[at:at + 512] = bytes(len(bad[at:at + 512]))
    elif how == 3:
        bad += b"more"
    else:
        del bad[at:at + 8]
    return bytes(bad)


def damaged_packings(cache, kept):
    good, dice = kept.read_bytes(), random.Random(2)
    for k in range(20 if cache.bench.long else 5):
        kept.write_bytes(damaged(good, k % 5, dice))
        cache.alike(f"damaged packing {k}")
        cache.bench.check(kept.read_bytes() == good, f"damaged packing {k} stays")


def other_things(cache, kept):
    """A folder, a pipe, a device in place of the packing, and a file in place of the cache."""
    kept.unlink()
    kept.mkdir()
    cache.alike("a folder has the packing's name")
    kept.rmdir()
    os.mkfifo(kept)
    cache.alike("a pipe has the packing's name")
    kept.unlink()
    kept.symlink_to("/dev/zero")
    cache.alike("a link to an endless device has the packing's name")
    kept.unlink()
    shutil.rmtree(cache.folder)
    cache.folder.write_text("no folder")
    cache.alike("the cache is a file")
    cache.folder.unlink()


def gone_in_mid_run(bench, cache):
    run = cache.here / "vanishing"
    process = bench.start(*packing_words(cache.scene, run), env=cache.keeping)
    while process.poll() is None:
        shutil.rmtree(cache.folder.parent, ignore_errors=True)
        time.sleep(0.002)
    cache.same(run, bench.end(process), "a cache that vanishes all the time")


def shared(bench, cache):
    """Two runs fill the same cache at once, several times, and a third reads it."""
    for k in range(6 if bench.long else 2):
        shutil.rmtree(cache.folder, ignore_errors=True)
        runs = [cache.here / f"shared-{k}-{n}" for n in range(3)]
        both = [bench.start(*packing_words(cache.scene, run), env=cache.keeping) for run in runs[:2]]
        ended = [bench.end(process) for process in both]
        ended.append(bench.run(*packing_words(cache.scene, runs[2]), env=cache.keeping))
        for run, end in zip(runs, ended):
            cache.same(run, end, "shared cache")
        names = [one.name for one in cache.folder.iterdir()]
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
