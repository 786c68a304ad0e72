"""Slow, hostile and many visitors of a run's live page: the page answers the good ones, and the run does not notice."""
import random
import re
import socket
import threading
import time

from tools import difference, scene_in, wait_for

LONGEST_RUN = 20  # s of the scene: no machine needs so long for its visitors

HOSTILE_PATHS = ["/../../etc/passwd", "/..%2f..%2fetc%2fpasswd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd",
                 "/checkpoints/../../secret.txt", "/..\\..\\secret.txt", "/%00", "/scene.toml%00.html", "/secret.txt%00",
                 "/./../secret.txt", "/....//secret.txt", "/%c0%ae%c0%ae/secret.txt", "/live/../../secret.txt", "/.lock",
                 "/run.json/../../secret.txt", "http://evil.example/", "*", "", "/?key=" + "k" * 3000, "/" + "%2e" * 2000,
                 "/" + "a/" * 4000, "/%", "/%zz", "/\xff\xfe", "/link.txt", "/folder", "/folder/"]
HOSTILE_TEXTS = [b"", b"\r\n", b"\0" * 5000, b"GET", b"GET / HTTP/9.9\r\n\r\n", b"GET / HTTP/1.1\r\n\r\n",
                 b"\x16\x03\x01\x02\x00\x01",
                 b"GET / HTTP/1.1\r\nHost: {host}\r\nContent-Length: -1\r\n\r\n",
                 b"GET / HTTP/1.1\r\nHost: {host}\r\nContent-Length: 99999999999999999999\r\n\r\n",
                 b"POST / HTTP/1.1\r\nHost: {host}\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n",
                 b"POST / HTTP/1.1\r\nHost: {host}\r\nTransfer-Encoding: chunked\r\n\r\n-1\r\nx\r\n0\r\n\r\n",
                 b"GET / HTTP/1.1\r\nHost: {host}\r\nRange: bytes=-1,0-99999999999999999999\r\n\r\n",
                 b"GET / HTTP/1.1\r\nHost: {host}\r\nHost: evil\r\n\r\n", b"GET / HTTP/1.1\nHost: {host}\n\n",
                 b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 5000 + b"\r\n",
                 b"GET / HTTP/1.1\r\nHost: {host}\r\nCookie: " + b"c=" * 60000,
                 b"GET /" + b"a" * 60000 + b" HTTP/1.1\r\n\r\n", b"CONNECT evil:1 HTTP/1.1\r\nHost: {host}\r\n\r\n",
                 b"TRACE / HTTP/1.1\r\nHost: {host}\r\n\r\n", b"BREW / HTTP/1.1\r\nHost: {host}\r\n\r\n",
                 b"DELETE /run.json HTTP/1.1\r\nHost: {host}\r\n\r\n",
                 b"PUT /run.json HTTP/1.1\r\nHost: {host}\r\nContent-Length: 1\r\n\r\nx"]


class Line:
    """A connection to the page."""

    def __init__(self, port):
        self.port = port
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=60)

    def send(self, data):
        try:
            self.socket.sendall(data)
        except OSError:
            pass  # the page may close the connection at any time

    def answer(self, most=1 << 20):
        """All that comes until the page closes the connection or is silent."""
        data = b""
        try:
            while len(data) < most and (piece := self.socket.recv(65536)):
                data += piece
        except OSError:
            pass
        return data

    def close(self):
        self.socket.close()


def ask(port, path="/live/state", method="GET", more=""):
    line = Line(port)
    text = f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n{more}\r\n"
    line.send(text.encode("latin-1"))
    answer = line.answer()
    line.close()
    return answer


def status(answer):
    return int(answer[9:12]) if answer.startswith(b"HTTP/1.") else 0


class Watched:
    """A run that shows itself."""

    def __init__(self, bench, scene, run, duration):
        self.bench, self.run = bench, run
        self.process = bench.start("movie", scene, "--out", run, "--duration", f"{duration:g} s", "--watch", "0",
                                   "--watch-host", "127.0.0.1")
        self.port, self.said = None, b""
        for line in self.process.stderr:
            self.said += line
            if found := re.search(rb"http://127\.0\.0\.1:(\d+)/", line):
                self.port = int(found[1])
                break
        self.reader = threading.Thread(target=self.read)
        self.reader.start()

    def read(self):
        for line in self.process.stderr:
            self.said += line

    def end(self):
        status = self.process.wait(timeout=240)
        self.reader.join()
        return status


def good_visitor(port, stop, answers):
    while not stop.is_set():
        try:
            answers.append(status(ask(port)))
        except ConnectionRefusedError:
            return  # the run has ended; `besieged` finds that out
        time.sleep(0.05)


def hostile(port):
    """Questions that must not be answered with anything. Returns what was answered all the same."""
    found = []
    for path in HOSTILE_PATHS:
        answer = ask(port, path)
        if b"nobody is to see" in answer or b"root:" in answer:
            found.append(f"{path[:40]!r} gives what lies outside")
        if status(answer) >= 500:
            found.append(f"{path[:40]!r}: status {status(answer)}")
    for method in ("POST", "PUT", "DELETE", "OPTIONS", "PATCH", "PROPFIND", "get", "G\x01T"):
        answer = ask(port, "/run.json", method, "Content-Length: 0\r\n")
        if status(answer) == 200 or status(answer) >= 500:
            found.append(f"{method!r}: status {status(answer)}")
    lines = []
    for text in HOSTILE_TEXTS:
        line = Line(port)
        line.send(text.replace(b"{host}", b"127.0.0.1:%d" % port))
        lines.append(line)
    dice = random.Random(3)
    for _ in range(50):  # noise
        line = Line(port)
        line.send(dice.randbytes(dice.randrange(2000)))
        lines.append(line)
    for line in lines:
        line.close()
    for k in range(40):  # broken off after each so many bytes
        line = Line(port)
        line.send(f"GET /live/state HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode()[:k])
        line.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")  # with a reset
        line.close()
    return found


def byte_by_byte(port, answers):
    try:
        line = Line(port)
    except ConnectionRefusedError:
        return  # the run has ended
    for byte in f"GET /live/state HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n".encode():
        line.send(bytes([byte]))
        time.sleep(0.005)
    answers.append(status(line.answer()))
    line.close()


def besieged(bench, watched, run, secret):
    """Sends all visitors to a run's page. Returns whether the run went on until the last of them had come."""
    stop, answers, slowly = threading.Event(), [], []
    good = threading.Thread(target=good_visitor, args=(watched.port, stop, answers))
    good.start()
    slow = threading.Thread(target=byte_by_byte, args=(watched.port, slowly))
    crowd, found = [], []
    try:
        for k in range(200):  # half of them ask and never read, the others never end their question
            crowd.append(Line(watched.port))
            crowd[-1].send(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{watched.port}\r\n".encode() + (b"\r\n" if k % 2 else b""))
        slow.start()
        wait_for(watched.process, run.exists)
        (run / "link.txt").symlink_to(secret)
        found = hostile(watched.port)
        slow.join()
    except (ConnectionRefusedError, FileNotFoundError):
        pass  # the run has ended, and its page with it
    went_on = watched.process.poll() is None
    stop.set()
    good.join()
    if slow.ident is not None:
        slow.join()
    for line in crowd:
        line.close()
    if went_on:
        bench.check(not found, f"hostile visitors: {found}")
        bench.check(slowly == [200], f"byte by byte: status {slowly}")
        bench.check(answers and set(answers) == {200}, f"good visitors: {sorted(set(answers))} in {len(answers)} answers")
        bench.counts["good answers"] = bench.counts.get("good answers", 0) + answers.count(200)
    return went_on


def watched_run(bench, scene, run, secret, duration):
    """A run that all visitors come to. Returns whether it lasted long enough for that."""
    watched = Watched(bench, scene, run, duration)
    if not bench.check(watched.port is not None, f"no page: {watched.said[-300:]}"):
        return True
    went_on = besieged(bench, watched, run, secret)
    code = watched.end()
    bench.check(code == 0, f"watched run: exit status {code}: {watched.said[-300:]}")
    (run / "link.txt").unlink(missing_ok=True)
    return went_on


def visitors(bench):
    """200 visitors at once, half of whom stop reading, hostile ones, and good ones meanwhile."""
    here = bench.fresh("visitors")
    secret = here / "secret.txt"
    secret.write_text("nobody is to see this")
    scene = scene_in(here)
    duration, wanted = 0.6, 3 if bench.long else 1  # s, runs
    while wanted and duration < LONGEST_RUN:
        run = here / f"run-{duration:g}-{wanted}"
        if not watched_run(bench, scene, run, secret, duration):
            duration *= 2  # how long visitors need and how fast a run goes depends on the machine
            continue
        whole = here / f"whole-{duration:g}"
        if not whole.exists():
            bench.must("movie", scene, "--out", whole, "--duration", f"{duration:g} s")
        apart = difference(whole, run)
        bench.check(not apart, f"watched run: {apart}")
        bench.count("watched runs alike")
        wanted -= 1
    bench.check(not wanted, f"runs of {duration:g} s ended before the visitors had all come")
    bench.counts["hostile questions"] = len(HOSTILE_PATHS) + 8 + len(HOSTILE_TEXTS) + 90


GROUPS = {"visitors": visitors}
