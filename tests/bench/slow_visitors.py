#!/usr/bin/env python3
"""How long visitors who say nothing keep others from a run's page.   slow_visitors.py GRAINREEL RUN [VISITORS]

Shows the run with `watch`, and opens VISITORS [600] connections, more than the server takes at once. Half of them stop in
the middle of a request, half take nothing of their answer. The server cuts a silent one off after 20 s; a question that is
asked meanwhile must be answered soon after that. Ends with 1 where it is not.
"""
import re
import socket
import subprocess
import sys
import time

SILENCE, PATIENCE = 20, 3  # s


def request(path):
    return f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{PORT}\r\nConnection: close\r\n"


def is_answered():
    try:
        with socket.create_connection(("127.0.0.1", PORT), timeout=1) as visitor:
            visitor.sendall((request("/live/state") + "\r\n").encode())
            return visitor.recv(100)[9:12] == b"200"
    except OSError:
        return False


def slow_visitors(count):
    visitors = []
    for k in range(count):
        try:
            visitor = socket.create_connection(("127.0.0.1", PORT), timeout=1)
            visitor.sendall((request("/") + ("" if k % 2 else "\r\n")).encode())
            visitors.append(visitor)
        except OSError:
            continue
    return visitors


program, run = sys.argv[1:3]
watch = subprocess.Popen([program, "watch", run, "--port", "0"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
try:
    PORT = next(int(found[1]) for line in watch.stderr if (found := re.search(r"127\.0\.0\.1:(\d+)/", line)))
    assert is_answered()
    begin = time.monotonic()
    visitors = slow_visitors(int(sys.argv[3]) if len(sys.argv) > 3 else 600)
    came = time.monotonic()
    while not is_answered() and time.monotonic() < came + 3 * SILENCE:
        time.sleep(0.2)
    blocked = time.monotonic() - came
    print(f"{len(visitors)} slow visitors, who came within {came - begin:.1f} s: the page is answered {blocked:.1f} s after the last")
finally:
    watch.terminate()
    watch.wait()
sys.exit(blocked > SILENCE + PATIENCE)
