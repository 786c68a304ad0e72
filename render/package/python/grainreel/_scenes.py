"""Scenes and studies that are a file, a text or a dict: the program takes files."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Dict, Optional, Tuple

from ._messages import GrainreelError, wrong
from ._words import path_of, text_of, toml_of_scene


class SceneFile:
    """The file of a scene, and what is to be done with it in the end.

    A text or a dict becomes a file in the present folder, from which its own paths count, and where this may not be
    written, one for temporary files. It goes away with the run, which keeps a copy.
    """

    def __init__(self, scene: object, text: object, what: str) -> None:
        if scene is None and text is None:
            raise GrainreelError(f"{what}: must be a path or a dict, or be given as text=")
        if scene is not None and text is not None:
            raise GrainreelError(f"{what} and text: both are the {what}; leave one out")
        self.path: str
        self.tidy: Optional[Callable[[], None]] = None
        self.names: Dict[str, str] = {}
        self.is_own = text is not None or isinstance(scene, Mapping)
        if not self.is_own:
            self.path = path_of(scene, what)
            return
        content = text_of(text, "text") if text is not None else toml_of_scene(_table(scene, what))
        self.path = _written(content)
        self.tidy = lambda: Path(self.path).unlink(missing_ok=True)
        self.names = {self.path: "text" if text is not None else what}

    def out(self, out: object) -> Tuple[Optional[str], bool]:
        """The folder, and whether it was chosen here: a text has no name that one could be called after."""
        if out is not None or not self.is_own:
            return (None if out is None else path_of(out, "out")), False
        base = Path(os.environ.get("GRAINREEL_OUTPUT") or "output")
        number = 1
        while (base / f"run-{number}").exists():
            number += 1
        return str(base / f"run-{number}"), True


def _table(scene: object, what: str) -> Mapping[str, object]:
    if not isinstance(scene, Mapping):
        raise wrong(what, "a path or a dict", scene)
    return scene


def _written(content: str) -> str:
    for folder in (".", tempfile.gettempdir()):
        try:
            handle, name = tempfile.mkstemp(prefix=".grainreel-", suffix=".toml", dir=folder)
        except OSError:
            continue
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(content)
        return os.path.relpath(name) if folder == "." else name
    raise GrainreelError("text: can be written neither in this folder nor among temporary files")
