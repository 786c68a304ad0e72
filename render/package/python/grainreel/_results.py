"""What the program makes, as values: films, answers, comparisons and studies."""
from __future__ import annotations

import base64
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Optional

from ._messages import GrainreelError, Placed, in_python
from ._words import path_of

if TYPE_CHECKING:
    from ._run import Run

_SHOWN = {".mp4": "video/mp4", ".webm": "video/webm", ".gif": "image/gif", ".png": "image/png"}
_MOST_INSIDE = 50_000_000  # bytes of a film that a notebook takes in; larger ones are only linked


class Film(Placed):
    """A film on disk, which a notebook shows."""

    def __init__(self, file: object) -> None:
        super().__init__(path_of(file, "film"))
        if not self.path.is_file():
            raise GrainreelError(f"film: {self.path} is not there")

    def __repr__(self) -> str:
        return f"<grainreel.Film {self.path}>"

    def _repr_html_(self) -> str:
        """The film itself, so that the notebook can be sent to others; a link where it is too large for that."""
        name, kind = escape(str(self.path), quote=True), _SHOWN.get(self.path.suffix)
        if not self.path.is_file():
            return f"<p>{name}: is not there any more</p>"
        if kind is None or self.path.stat().st_size > _MOST_INSIDE:
            return f'<p><a href="{name}">{name}</a></p>'
        data = f"data:{kind};base64,{base64.b64encode(self.path.read_bytes()).decode('ascii')}"
        if kind.startswith("image/"):
            return f'<img src="{data}" alt="{name}">'
        return f'<video controls loop src="{data}" style="max-width: 100%"></video>'


class Answer(Mapping[str, Any]):
    """What `grainreel.inspect` answers: tables by their names, each a data frame of pandas in SI units (the units of its
    columns are in attrs["units"]). print() shows all of it."""

    def __init__(self, said: Mapping[str, Any]) -> None:
        #: time (s), step, and how the moment was had.
        self.moment: Dict[str, Any] = dict(said.get("moment") or {})
        #: Lines that belong to the answer.
        self.notes: List[str] = [in_python(str(note)) for note in said.get("notes", [])]
        self._said: Dict[str, Any] = dict(said.get("tables", {}))

    def __getitem__(self, name: str) -> Any:
        import pandas

        if name not in self._said:
            raise KeyError(f"{name}: there is no such table; there are {', '.join(self._said)}")
        table = self._said[name]
        names = [column["name"] for column in table["columns"]]
        frame = pandas.DataFrame(table["rows"], columns=names)
        frame.attrs["units"] = {column["name"]: column["unit"] or "1" for column in table["columns"]}
        frame.attrs["title"] = table["title"]
        return frame

    def __iter__(self) -> Iterator[str]:
        return iter(self._said)

    def __len__(self) -> int:
        return len(self._said)

    def __repr__(self) -> str:
        return f"<grainreel.Answer: {', '.join(self._said)}>"

    def __str__(self) -> str:
        parts = [f"{self._said[name]['title']}\n{self[name].to_string(index=False)}" for name in self]
        return "\n\n".join(parts + self.notes)

    def _repr_html_(self) -> str:
        parts = [f"<p>{escape(self._said[name]['title'])}</p>{self[name].to_html(index=False)}" for name in self]
        return "".join(parts + [f"<p>{escape(note)}</p>" for note in self.notes])


class Comparison(Placed):
    """Runs side by side: the folder that `grainreel.compare` made."""

    def __init__(self, folder: object, runs: Optional[List["Run"]] = None) -> None:
        super().__init__(path_of(folder, "comparison"))
        #: The runs, those that were made for it too.
        self.runs: List["Run"] = runs or []

    def __repr__(self) -> str:
        return f"<grainreel.Comparison {self.path}>"

    @property
    def film(self) -> Film:
        """Its film, or with `at` its picture."""
        files = sorted(self.path.glob("movie.*")) or sorted(self.path.glob("*.png"))
        if not files:
            raise GrainreelError(f"{self.path}: has no film; compare() makes one unless film=False")
        return Film(files[0])

    def _repr_html_(self) -> str:
        try:
            return self.film._repr_html_()
        except GrainreelError as error:
            return f"<p>{escape(str(error))}</p>"


class Study(Placed):
    """The results of a study: the folder that `grainreel.study` filled."""

    def __init__(self, folder: object) -> None:
        super().__init__(path_of(folder, "study"))

    def __repr__(self) -> str:
        return f"<grainreel.Study {self.path}>"

    def __fspath__(self) -> str:
        return str(self.path)

    @property
    def table(self) -> Any:
        """study.csv as a data frame of pandas: a row for each member, with its values, its seed and its measures."""
        return self._csv("study.csv")

    @property
    def settings(self) -> Any:
        """settings.csv as a data frame of pandas: a row for each setting, with the mean of each measure over its seeds,
        the ends of its 95 % interval, and in how many members it came up."""
        return self._csv("settings.csv")

    def _csv(self, name: str) -> Any:
        import pandas

        try:
            return pandas.read_csv(self.path / name)
        except (OSError, ValueError) as error:
            raise GrainreelError(f"{self.path / name}: cannot be read: {error}") from None

    @property
    def members(self) -> List["Run"]:
        """The runs, in the order of the table. Those that have not run are left out."""
        from ._run import Run

        folders = [self.path / str(folder) for folder in self.table["folder"].dropna()]
        return [Run(folder) for folder in folders if (folder / "scene.toml").is_file()]

    @property
    def charts(self) -> List[Path]:
        """The files of its charts, SVG."""
        return sorted((self.path / "charts").glob("*.svg"))

    def _repr_html_(self) -> str:
        pictures = [f'<img alt="{escape(chart.stem, quote=True)}" src="data:image/svg+xml;base64,'
                    f'{base64.b64encode(chart.read_bytes()).decode("ascii")}">' for chart in self.charts]
        return "".join(pictures) + str(self.table.to_html(index=False))
