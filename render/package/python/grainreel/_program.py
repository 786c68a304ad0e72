"""The program at work."""
from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, Dict, List, Optional

from ._messages import GrainreelError, in_python, wrong
from ._words import path_of

_OF_WHEEL = Path(__file__).parent.with_name("grainreel_program") / "bin" / "grainreel"


def program_of(given: object = None) -> str:
    """The program: the argument, else $GRAINREEL, else the one of the wheel, else the one on the PATH."""
    name = given or os.environ.get("GRAINREEL") or (_OF_WHEEL if _OF_WHEEL.exists() else "grainreel")
    path = shutil.which(path_of(name, "program"))
    if not path:
        raise GrainreelError(f"{name}: is not found; install grainreel, or give program= or $GRAINREEL")
    return path


def popen(words: Sequence[str], **how: Any) -> subprocess.Popen[Any]:
    """Starts a program in a session of its own, so that Ctrl-C reaches it through stop() alone, and once."""
    try:
        return subprocess.Popen(list(words), stdout=subprocess.PIPE, start_new_session=True, **how)
    except OSError as error:
        raise GrainreelError(f"{words[0]}: cannot be started: {error.strerror}") from None


class ProgressLine:
    """progress=True: one line on stderr that is drawn anew."""

    def __init__(self) -> None:
        self._shown = 0

    def __call__(self, now: Dict[str, Any]) -> None:
        """Shows the progress."""
        left = f", {now['remaining_s']:.0f} s left" if now.get("remaining_s", 0) >= 1 else ""
        self._show(f"{now.get('stage', '')} {100 * now.get('done', 0):.0f} %{left}")

    def _show(self, line: str) -> None:
        sys.stderr.write("\r" + line.ljust(self._shown))
        sys.stderr.flush()
        self._shown = len(line)

    def end(self) -> None:
        """Takes the line away."""
        if self._shown:
            self._show("")
            sys.stderr.write("\r")


def watcher_of(progress: object) -> Optional[Callable[[Any], object]]:
    """What is called with each dict of progress."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return ProgressLine()
    if not callable(progress):
        raise wrong("progress", "True or a function", progress)
    watcher: Callable[[Any], object] = progress
    return watcher


def _end(process: subprocess.Popen[str], owner: int) -> None:
    """Ends a run that nobody has any more, as stop() does. A forked process does not own it."""
    if os.getpid() == owner and process.poll() is None:
        process.send_signal(signal.SIGINT)
    if process.stderr:
        process.stderr.close()


class Running:
    """The program at work. Iterating gives its progress, a dict each: stage, done from 0 to 1, time_s, and more.

    When nobody holds it any more, it is stopped in good order.
    """

    def __init__(self, words: Sequence[object], made: Optional[Callable[[str], Any]] = None, verb: str = "",
                 tidy: Optional[Callable[[], None]] = None, names: Optional[Dict[str, str]] = None,
                 progress: bool = True) -> None:
        # made: makes the result of what was printed. tidy: is called at the end. names: texts of messages, and what
        # stands in their place. progress: whether the verb tells it.
        self._words = [os.fspath(word) for word in words] + ["--progress", "json"] * progress  # type: ignore[call-overload]
        self._made, self._verb, self._tidy, self._names = made, verb, tidy, names or {}
        self._result: Any = None
        self._printed: Optional[str] = None
        self._error: Optional[GrainreelError] = None
        self._stopped = False
        #: What it has said, a dict each: event and text.
        self.messages: List[Dict[str, Any]] = []
        try:
            self._process = popen(self._words, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True,
                                  encoding="utf-8", errors="surrogateescape")
        except GrainreelError:
            self._ended()
            raise
        # Both pipes are read at the same time, so that neither is ever full.
        self._parts: List[str] = []
        self._reader = threading.Thread(target=_gather, args=(self._process.stdout, self._parts), daemon=True)
        self._reader.start()
        self._finalizer = weakref.finalize(self, _end, self._process, os.getpid())

    def __repr__(self) -> str:
        state = "ended" if self._process.poll() is not None else "at work"
        return f"<grainreel.Running {' '.join(self._words[1:3])} ({state})>"

    def __reduce__(self) -> Any:
        raise GrainreelError("a run that goes on cannot be pickled; wait for its result() and pickle that")

    def __iter__(self) -> Iterator[Dict[str, Any]]:
        pipe = self._process.stderr
        if pipe is None or pipe.closed:
            return
        for line in pipe:
            try:
                said = json.loads(line)
            except ValueError:
                said = {"event": "error", "text": line.strip().removeprefix("error: ")}
            if not isinstance(said, dict):
                continue
            if said.get("event") == "progress":
                yield said
            elif said.get("text"):
                said["text"] = self._in_python(said["text"])
                self.messages.append(said)

    def stop(self) -> None:
        """Ends it in good order, as Ctrl-C in a terminal does: what there is stays and is whole, and result() has it.
        Without effect once it has ended."""
        if self._process.poll() is None:
            self._stopped = True
            self._process.send_signal(signal.SIGINT)

    def wait(self, progress: object = None) -> str:
        """Waits for its end and gives what it printed. progress: True for a line on stderr, or a function that is
        called with each dict; Ctrl-C stops the program."""
        if self._error:
            raise self._error
        if self._printed is not None:
            return self._printed
        watcher = watcher_of(progress)
        try:
            for each in self:
                if watcher:
                    watcher(each)
            status = self._process.wait()
        except BaseException:
            self.stop()
            for _ in self:
                pass
            self._process.wait()
            self._ended()
            raise
        finally:
            if isinstance(watcher, ProgressLine):
                watcher.end()
        self._ended()
        # A program that was stopped before it could wait for signals ends by the signal itself.
        if status != 0 and not (self._stopped and status in (128 + signal.SIGINT, -signal.SIGINT)):
            self._error = GrainreelError(self._why(status))
            raise self._error
        self._printed = "".join(self._parts)
        return self._printed

    def result(self, progress: object = None) -> Any:
        """Waits for the end as wait() does, and gives what was made: of a run its Run. A second call gives the
        same."""
        if self._result is None:
            printed = self.wait(progress)
            if self._made and not printed.strip():
                raise GrainreelError("was stopped before it had made anything")
            self._result = self._made(printed) if self._made else printed
        return self._result

    def _ended(self) -> None:
        if hasattr(self, "_finalizer"):
            self._finalizer.detach()
            self._reader.join()
            for pipe in (self._process.stdout, self._process.stderr):
                if pipe:
                    pipe.close()
        if self._tidy:
            self._tidy()
            self._tidy = None

    def _in_python(self, text: str) -> str:
        for name, instead in self._names.items():
            text = text.replace(name, instead)
        return in_python(text, self._verb)

    def _why(self, status: int) -> str:
        errors = [said["text"] for said in self.messages if said.get("event") == "error"]
        return str(errors[-1]) if errors else f"{self._words[0]}: {end_of(status)}"


def end_of(status: int) -> str:
    """In words, how a process ended that has said no error."""
    if status >= 0:
        return f"ended with status {status} and said no error"
    try:
        name = f" ({signal.Signals(-status).name})"
    except ValueError:
        name = ""
    return f"was killed by signal {-status}{name}"


def _gather(pipe: Any, parts: List[str]) -> None:
    try:
        while part := pipe.read(1 << 16):
            parts.append(part)
        pipe.close()
    except (OSError, ValueError):  # closed by a finalizer
        pass


def call(verb: str, words: Sequence[object], program: object = None, progress: object = None) -> str:
    """Runs a verb to its end and gives what it printed."""
    return Running([program_of(program), verb, *words], verb=verb).wait(progress)
