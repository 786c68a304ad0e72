"""Disks that are full: after so many bytes, or after so many files."""
from tools import SmallDisk, content, difference, record_of, scene_in

PAGE = 4096  # bytes, in which a tmpfs counts


def movie(bench, scene, run):
    return bench.run("movie", scene, "--frames", "--out", run)


def whole_run(bench):
    here = bench.fresh("disks")
    scene = scene_in(here)
    bench.must("movie", scene, "--frames", "--out", here / "whole")
    # A file fills whole pages, and one with two names fills them once.
    found = {entry.stat().st_ino: entry.stat().st_size for entry in (here / "whole").rglob("*") if entry.is_file()}
    pages = sum(-(-size // PAGE) for size in found.values())
    return here, scene, pages, len(list((here / "whole").rglob("*")))


def check_left(bench, run, ended, what):
    """What a run leaves that found no room."""
    if bench.crashed(ended, what):
        return
    bench.check(len(ended.errors) == 1, f"{what}: {len(ended.errors)} errors: {ended.said()}")
    bench.check(str(run.parent) in ended.said(), f"{what}: names no file: {ended.said()}")
    said = content(run / "run.json")
    record = record_of(run)
    bench.check(not said or record, f"{what}: run.json is half a file")
    bench.check(record.get("status") not in ("running", "complete"), f"{what}: run.json says {record.get('status')}")
    if (run / "scene.toml").exists() and (run / "trajectory.nc").exists():
        shown = bench.run("inspect", run, "--at", "0")
        bench.crashed(shown, f"{what}: inspect")
        # A file that was cut before its first frame is told as that.
        cut = any(words in shown.said() for words in ("no frame", "cut off"))
        bench.check(shown.status == 0 or cut, f"{what}: what is left cannot be read: {shown.said()}")


def resumed(bench, disk, here, scene, run, room, what):
    """More room, and the run goes on; where it cannot, it says why, and the scene runs anew."""
    disk.change(room)
    again = bench.run("resume", run)
    if again.status != 0:
        reasons = ("has no checkpoint", "scene.toml", "no such folder", "holds no run", "has come to")
        bench.crashed(again, what + ": resume")
        bench.check(any(reason in again.said() for reason in reasons), f"{what}: resume says {again.said()}")
        bench.count("nothing to resume")
        if (run / "run.json").exists():
            bench.must("movie", scene, "--frames", "--out", run, "--force")
        else:
            run = run.with_name("another")
            bench.must("movie", scene, "--frames", "--out", run)
    else:
        bench.count("resumed")
    apart = difference(here / "whole", run)
    bench.check(not apart, f"{what}: {apart} after resume")


def page_made(bench, disk, run, ended, room, what):
    """There was room for all but the page: a warning says so, and `resume` makes it."""
    bench.check(b"the run has no page: " in ended.err, f"{what}: nothing is said of the page")
    disk.change(room)
    again = bench.run("resume", run)
    bench.check(again.status == 0 and (run / "report.html").exists(), f"{what}: the page is not made: {again.said()}")
    bench.count("pages made later")


def case(bench, whole, options, more, what):
    here, scene = whole
    with SmallDisk(here / "disk", options) as disk:
        run = here / "disk" / "run"
        ended = movie(bench, scene, run)
        bench.count(f"status {ended.status}")
        if ended.status == 0:
            apart = difference(here / "whole", run)
            bench.check(not apart, f"{what}: status 0, but {apart}")
            if not (run / "report.html").exists():
                page_made(bench, disk, run, ended, more, what)
            return
        check_left(bench, run, ended, what)
        resumed(bench, disk, here, scene, run, more, what)


def full(bench):
    """Disks of every size from nothing to what a run needs."""
    here, scene, pages, _ = whole_run(bench)
    moments = 50 if bench.long else 8
    for k in range(moments):
        room = max(1, round(pages * k / moments))
        case(bench, (here, scene), f"size={room * PAGE}", f"size={PAGE * pages * 4}", f"{room} of {pages} pages")


def inodes(bench):
    """Disks that take so many files and no more."""
    here, scene, _, entries = whole_run(bench)
    moments = range(2, entries + 8) if bench.long else range(2, entries + 8, max(1, entries // 6))
    for most in moments:
        case(bench, (here, scene), f"nr_inodes={most}", "nr_inodes=100000", f"{most} of {entries} files")


GROUPS = {"small disks": full, "few files": inodes}
