"""Runs that are stopped, halted or killed, and then go on."""
import random
import signal
import time

from tools import difference, scene_in, wait_for


def command(scene, run):
    return "movie", scene, "--frames", "--duration", "0.3 s", "--out", run


def whole_run(bench, name):
    here = bench.fresh(name)
    scene = scene_in(here)
    took = bench.must(*command(scene, here / "whole")).seconds
    return here, scene, took


def gone_on(bench, here, run, what):
    """The run goes on, or has not begun and is made anew, and is the whole one then."""
    again = bench.run("resume", run)
    over = "has come to" in again.said()
    if again.status != 0 and not over:
        bench.crashed(again, what + ": resume")
        early = not (run / "checkpoint.grs").exists() or not (run / "measures.csv").exists()
        if bench.check(early, f"{what}: resume says {again.said()}"):
            bench.count("had not begun")
        return
    bench.count("went on")
    apart = difference(here / "whole", run)
    bench.check(not apart, f"{what}: {apart} after resume")


def kills(bench):
    """SIGKILL at moments spread over the whole run."""
    here, scene, took = whole_run(bench, "kills")
    moments = 20 if bench.long else 5
    for k in range(moments):
        run = here / f"run-{k}"
        process = bench.start(*command(scene, run))
        time.sleep(took * (k + 0.5) / moments)
        process.kill()
        ended = bench.end(process)
        if ended.status == 0:
            bench.count("ended before")
            continue
        gone_on(bench, here, run, f"killed at {k}/{moments}")


def asked(bench):
    """Signals that ask the program to stop: once, twice, and again while it stops; at several moments."""
    here, scene, took = whole_run(bench, "asked")
    cases = [(signal.SIGTERM,), (signal.SIGHUP,), (signal.SIGINT, signal.SIGINT), (signal.SIGTERM, signal.SIGINT),
             (signal.SIGINT,) * 3]
    dice = random.Random(1)
    for number, signals in enumerate(cases * (4 if bench.long else 1)):
        run = here / f"run-{number}"
        process = bench.start(*command(scene, run))
        time.sleep(took * dice.uniform(0.1, 0.9))
        for one in signals:
            process.send_signal(one)
            time.sleep(0.01)
        ended = bench.end(process)
        what = "+".join(one.name for one in signals) + f" ({number})"
        if ended.status == 0:
            bench.count("ended before")
            continue
        bench.check(ended.status in [128 + one for one in signals], f"{what}: exit status {ended.status}")
        bench.check(not ended.errors, f"{what}: {ended.said()}")
        gone_on(bench, here, run, what)


def halted(bench):
    """SIGSTOP and SIGCONT, fifteen times in one run, change nothing."""
    here, scene, took = whole_run(bench, "halted")
    run = here / "run"
    process = bench.start(*command(scene, run))
    for _ in range(15):
        time.sleep(took / 20)
        process.send_signal(signal.SIGSTOP)
        time.sleep(0.03)
        process.send_signal(signal.SIGCONT)
    ended = bench.end(process)
    bench.check(ended.status == 0, f"halted: {ended.status}: {ended.said()}")
    apart = difference(here / "whole", run)
    bench.check(not apart, f"halted: {apart}")
    bench.count("alike")


def broken_pipes(bench):
    """Who reads stdout and stderr goes away in mid-run: SIGPIPE from the system, and one sent by hand."""
    here, scene, took = whole_run(bench, "pipes")
    run = here / "run"
    process = bench.start(*command(scene, run), preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_DFL))
    wait_for(process, (run / "trajectory.nc").exists)
    process.stdout.close()
    process.stderr.close()
    process.send_signal(signal.SIGPIPE)
    status = process.wait(timeout=120)
    # The run is whole; only the line with its folder found no reader, which is no mistake of the run.
    bench.check(status in (0, 1), f"readers gone: exit status {status}")
    apart = difference(here / "whole", run)
    bench.check(not apart, f"readers gone: {apart}")
    bench.count("alike")


GROUPS = {"killed": kills, "asked to stop": asked, "halted": halted, "readers gone": broken_pipes}
