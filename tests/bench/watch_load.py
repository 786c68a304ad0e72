#!/usr/bin/env python3
"""What 200 visitors cost a run.   watch_load.py GRAINREEL SCENE [SECONDS [ROUNDS]]

Runs the scene without a film, by turns alone and shown to 200 connections of this machine: half ask once a second for
state, bed and measures, as the page does, half read the page at 100 bytes a second. Prints the engine's speed of each run,
what it took of processor time (which other programs on the machine change less), and files and memory of the process that shows it, before the visitors and after them. Each run is stopped after SECONDS
[60].
"""
import asyncio
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

VISITORS = 200


async def ask(port, path):
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n".encode())
    answer = await reader.read(-1)
    writer.close()
    return answer


async def quick(port, end, answered):
    while time.monotonic() < end:
        begin = time.monotonic()
        for path in ["/live/state", "/live/bed", "/live/measures"]:
            answered.append((await ask(port, path))[9:12] in (b"200", b"404"))
        await asyncio.sleep(max(0, 1 - (time.monotonic() - begin)))


async def slow(port, end):
    while time.monotonic() < end:
        reader, writer = await asyncio.open_connection("127.0.0.1", port, limit=100)
        writer.write(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
        while time.monotonic() < end and await reader.read(100):
            await asyncio.sleep(1)
        writer.close()


async def visit(port, seconds):
    answered, end = [], time.monotonic() + seconds
    tasks = [quick(port, end, answered) if k % 2 else slow(port, end) for k in range(VISITORS)]
    failures = [one for one in await asyncio.gather(*tasks, return_exceptions=True) if one]
    return sum(answered), len(answered), failures


def shown_by(port):
    """The process that shows the run at this port: files that it has open, MB of memory."""
    for process in pathlib.Path("/proc").iterdir():
        try:
            words = (process / "cmdline").read_bytes().split(b"\0")
            if process.name.isdigit() and b"--socket" in words and b"watch" in words:
                memory = re.search(r"VmRSS:\s+(\d+)", (process / "status").read_text())
                return len(os.listdir(process / "fd")), int(memory[1]) / 1024
        except (OSError, TypeError):
            continue
    return None


def processor_time(process):
    """s, of all its threads."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measured_until(folder):
    """s of the run, by its last complete row."""
    lines = (pathlib.Path(folder) / "measures.csv").read_text().split("\n")
    return float(lines[-2].split(",")[lines[0].split(",").index("time_s")])


def run(program, scene, folder, seconds, watched):
    shutil.rmtree(folder, ignore_errors=True)
    words = [program, "movie", scene, "--out", folder, "--no-film", "--no-report", "--threads", "1", "--duration", "10 h"]
    process = subprocess.Popen(words + (["--watch", "0"] if watched else []), stderr=subprocess.PIPE, text=True,
                               stdout=subprocess.DEVNULL)
    port = None
    for line in process.stderr:
        if found := re.search(r"http://127\.0\.0\.1:(\d+)/", line):
            port = int(found[1])
        if "vibrating" in line and (port or not watched):
            break
    time.sleep(2)
    begin = measured_until(folder), processor_time(process)
    notes = ""
    if watched:
        before = shown_by(port)
        good, asked, failures = asyncio.run(visit(port, seconds))
        time.sleep(3)
        notes = f", {good} of {asked} questions answered, failures {len(failures)}; files and MB {before} -> {shown_by(port)}"
    else:
        time.sleep(seconds + 3)
    end = measured_until(folder), processor_time(process)
    process.send_signal(signal.SIGINT)
    process.stderr.read()
    process.wait()
    record = json.loads((pathlib.Path(folder) / "run.json").read_text())
    cost = (end[1] - begin[1]) / (end[0] - begin[0])
    return record["engine"]["particle_steps_per_second"], cost, notes


def main():
    program, scene = sys.argv[1], sys.argv[2]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 60
    rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 2
    speeds, costs = {False: [], True: []}, {False: [], True: []}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(rounds):
            for watched in (False, True):
                speed, cost, notes = run(program, scene, folder + "/run", seconds, watched)
                speeds[watched].append(speed)
                costs[watched].append(cost)
                print(f"{'watched' if watched else 'alone  '}: {speed * 1e-6:.2f} M particle-steps/s, {cost:.3f} s of processor time a second of the run{notes}", flush=True)
    alone, watched = (sum(speeds[one]) / rounds for one in (False, True))
    print(f"watched against alone: speed {100 * (watched / alone - 1):+.1f} %, processor time "
          f"{100 * (sum(costs[True]) / sum(costs[False]) - 1):+.1f} %")


if __name__ == "__main__":
    main()
