"""The verbs of the program as functions."""
from __future__ import annotations

import glob
import json
import os
import re
import shlex
from collections.abc import Iterator, Mapping, Sequence, ValuesView
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Union

from ._data import read_record
from ._messages import GrainreelError, tell, wrong
from ._pictures import Picture, coloured_by, painter_of, question
from ._program import Running, call, program_of
from ._results import Answer, Comparison, Film, Study
from ._scenes import SceneFile
from ._words import Path as PathLike
from ._words import (Progress, Time, columns_of, exclusive, options, path_of, reading_words, sets, size_of, text_of, time_of,
                     whole_of, whole_or_none, window_of)

if TYPE_CHECKING:
    from ._run import Run

Scene = Union[PathLike, Mapping[str, Any], None]
Settings = Optional[Mapping[str, Any]]


def open(run: Union[PathLike, "Run"], *, program: Optional[PathLike] = None, **reading: Any) -> "Run":  # as xarray has it
    """The run in a folder, or files of another program as a run: a file, a folder, or a pattern as "dump.*".

    For these files `reading` says what they do not: `columns={"radius": "c_rad"}`, `radius="2 mm"`, `time_step="1 us"`,
    `units="lj"`, `species={1: "small"}`, `density="2500 kg/m3"`, `contacts="contacts.*"`, `walls="mesh.stl"`,
    `walls_scale=0.001`, `container="scene.toml"`, `moves_with="container"`, `one=True`
    (docs/guide/other-programs.md).
    """
    from ._run import Run

    return run if isinstance(run, Run) and not reading else Run(run, program=program, **reading)


def start(scene: Scene = None, *, text: Optional[str] = None, out: Optional[PathLike] = None, force: bool = False,
          film: bool = False, report: bool = False, threads: Optional[int] = None, cache: bool = True,
          program: Optional[PathLike] = None, set: Settings = None, **settings: Any) -> Running:
    """Starts a run of a scene and gives it as it goes, see `Running`.

    - `scene`: its file, or the scene itself as a dict; or `text`: the scene as text.
    - `out`: the folder, which must be new, or `force=True`; else one in output/ is chosen.
    - `film`, `report`: whether they are made. `cache`: whether a packing of an earlier run is taken.
    - `settings`: other values for keys of the scene, `drive__frequency="20 Hz"` for drive.frequency;
      `set={"drive.frequency": "20 Hz"}` is the same.
    """
    file = SceneFile(scene, text, "scene")
    try:
        folder, _ = file.out(out)
        words: List[object] = [program_of(program), "movie", file.path]
        words += options(no_film=not film, no_report=not report, no_cache=not cache, out=folder,
                         force=bool(force) and out is not None,
                         threads=None if threads is None else whole_of(threads, "threads"))
        words += sets(settings, set)
    except BaseException:
        if file.tidy:
            file.tidy()
        raise

    def made(printed: str) -> "Run":
        return _run_in(printed.strip(), program)

    return Running(words, made, "movie", file.tidy, file.names)


def run(scene: Scene = None, *, text: Optional[str] = None, progress: Progress = None, out: Optional[PathLike] = None,
        force: bool = False, film: bool = False, report: bool = False, threads: Optional[int] = None, cache: bool = True,
        program: Optional[PathLike] = None, set: Settings = None, **settings: Any) -> "Run":
    """Runs a scene to its end and gives its Run.

    - `progress`: True for a line on stderr, or a function that is called with each dict of progress.
    - The rest: see `start`.

    Ctrl-C ends the run in good order and raises KeyboardInterrupt.
    """
    _check_progress(progress)
    running = start(scene, text=text, out=out, force=force, film=film, report=report, threads=threads, cache=cache,
                    program=program, set=set, **settings)
    made: "Run" = running.result(progress)
    return made


def render(run: Union[PathLike, "Run"], file: Optional[PathLike] = None, *, at: Optional[Time] = None,
           frame: Optional[int] = None, cycle: Optional[float] = None, phase: Optional[float] = None, size: Any = None,
           colour: Any = None, program: Optional[PathLike] = None, reading: Settings = None, set: Settings = None,
           **settings: Any) -> Picture:
    """A picture of a moment of a run, or of another program's files, as an array: rows x columns x 3 (4 where it is
    transparent) numbers of 0 to 255.

    - `file`: a PNG file that it is written to as well.
    - `at`: s; `frame`: number of a frame of the film, from 0 or from its end (-1), of a run that was made with `film=True`;
      `cycle`: periods of the drive, and `phase`, from 0 to 1 of the next one. None of them: the last moment.
    - `size`: "640x480" or (640, 480).
    - `colour`: a quantity by which grains are coloured, as "speed" (`colour__by` is the same); or a number for each
      grain, in the order of ids, or with the ids as the coordinate or the index `id`, as arrays of `run[-1]` have them. `colour__range=(0, 2)`, `colour__map="vik"`,
      `colour__scale="logarithmic"` and `colour__title="age (s)"` belong to it.
    - `reading`: a dict, what files of other programs do not say, see `open`.
    - `settings`: keys of [film], as in `colour__by="speed"`; `set={"film.colour.by": "speed"}` is the same.

    The first picture of a run starts a program that stays; the next ones take some tens of ms. What a picture cannot
    show is told as a warning.
    """
    moment = {"at": at, "frame": frame, "cycle": cycle, "phase": phase}
    asked = question(moment, size, colour, dict(settings), set)
    target = None if file is None else path_of(file, "file")
    painter = painter_of(path_of(run, "run"), _program(run, program), _reading(run, reading))
    picture, notes = painter.draw(asked)
    for note in [*([] if hasattr(run, "_told") else painter.told), *notes]:
        tell(note)
    if target is not None:
        picture.save(target)
    return picture


def film(run: Union[PathLike, "Run"], out: Optional[PathLike] = None, *, force: bool = False, size: Any = None,
         fps: Optional[float] = None, format: Optional[str] = None, title: Optional[str] = None,
         start: Optional[Time] = None, end: Optional[Time] = None, every: Optional[int] = None,
         colour: Optional[str] = None, replay: bool = True, threads: Optional[int] = None, progress: Progress = None,
         program: Optional[PathLike] = None, reading: Settings = None, set: Settings = None, **settings: Any) -> Film:
    """A film of a finished run, or of another program's files. Without further arguments it is the one that the run
    has, if it has one; else it is drawn.

    - `start`, `end`: s, the first and the last moment. `every`: draws each such frame of the trajectory.
    - `colour`: a quantity, as "speed".
    - `out`: the folder of the film, which must be new, or `force=True`; else one beside the run is chosen, and a film
      there that was drawn of the same files with the same arguments is taken.
    - `replay=False`: only kept moments.
    - `progress`: see `run`. `reading`, `settings`, `set`: see `render`.
    """
    _check_progress(progress)
    path = path_of(run, "run")
    if colour is not None:
        coloured_by(text_of(colour, "colour"), settings)
    wanted = options(out=out, force=bool(force) and out is not None, fps=fps, format=format, title=title, every=every,
                     size=None if size is None else size_of(size), no_replay=not replay, threads=threads)
    wanted += _between(start, end, "to") + sets({f"film__{key}": each for key, each in settings.items()}, set)
    own = sorted(Path(path).glob("movie.*"))
    if own and not wanted:
        return Film(own[0])
    words = [path, *wanted, *reading_words(_reading(run, reading))]
    drawn = None if out is not None else _drawn_before(path, [program_of(_program(run, program)), "render", *words])
    if drawn:
        return drawn
    folder = Path(call("render", words, _program(run, program), progress).strip())
    films = sorted(folder.glob("movie.*")) if folder.is_dir() else [folder]
    return Film(films[0] if films else folder)


def inspect(run: Union[PathLike, "Run"], where: Optional[str] = None, *, at: Optional[Time] = None,
            frame: Optional[int] = None, cycle: Optional[float] = None, phase: Optional[float] = None,
            average: Optional[float] = None, grain: Optional[int] = None, wall: Optional[str] = None,
            largest_overlap: bool = False, profile: Optional[str] = None, slice: Optional[str] = None,
            histogram: Optional[str] = None, bins: Optional[int] = None, pair_distribution: bool = False,
            compare: Optional[Time] = None, steady: Optional[str] = None,
            measure: Union[str, Sequence[str], None] = None, fields: Optional[str] = None, discharge: bool = False,
            parameters: bool = False, over_time: bool = False, every: Optional[Time] = None, mean: Optional[str] = None,
            window: Any = None, slope: Any = None, by: Optional[str] = None, limit: Optional[int] = None,
            replay: bool = True, progress: Progress = None, program: Optional[PathLike] = None,
            reading: Settings = None) -> Answer:
    """What is there at a moment: at (s), frame (of the film) or cycle (periods of the drive); neither: the last one.

    - One question: `grain` (its id), `wall` (its name), `largest_overlap`, `where` (a condition, as "species == big and
      height > 2 cm"), `profile` (a direction), `slice` (a plane, as "y=0"), `histogram` (a quantity),
      `pair_distribution`, `compare` (another time). Without one: an overview.
    - Of the whole run: `measure` (columns of measures: mean, deviation, interval), `steady` (such a column),
      `discharge`, `fields` ("kept" or "rz": their means), `parameters`.
    - `over_time`, `every`, `mean` belong to `where`, `bins` to `histogram`, `phase` to `cycle`; `window=(0.2, 0.8)` (s,
      None for an open end), `slope=(0.2, 0.8)` and `by="period"` to `measure`, `window` to `fields` too.
    - `average`: means over so many periods. `limit`: most grains in a list. `replay=False`: only kept moments.

    docs/guide/inspect.md tells more.
    """
    words = [path_of(run, "run"), "--json"]
    words += options(at=time_of(at, "at"), frame=whole_or_none(frame, "frame"), cycle=cycle, phase=phase, average=average,
                     grain=whole_or_none(grain, "grain"), wall=wall, largest_overlap=largest_overlap,
                     where=_condition(where), profile=profile, slice=slice, histogram=histogram,
                     bins=whole_or_none(bins, "bins"), pair_distribution=pair_distribution,
                     compare=time_of(compare, "compare"), steady=steady, fields=fields, discharge=discharge,
                     measure=columns_of(measure, "measure"),
                     window=window_of(window, "window"), slope=window_of(slope, "slope"), by=by,
                     parameters=parameters, over_time=over_time,
                     every=time_of(every, "every"), mean=mean, limit=whole_or_none(limit, "limit"), no_replay=not replay)
    words += reading_words(_reading(run, reading))
    return Answer(json.loads(call("inspect", words, _program(run, program), progress)))


_EXPORTS = {"netcdf": "frames.nc", "lammps-dump": "frames.lammpstrj", "lammps-data": "last.data", "xyz": "frames.xyz",
            "csv": "frames.csv", "vtkhdf": "frames.vtkhdf", "stl": "walls.stl", "gsd": "frames.gsd", "gltf": "last.glb",
            "grain-table": "last.csv"}


def export(run: Union[PathLike, "Run"], to: str, out: Optional[PathLike] = None, *, force: bool = False,
           at: Optional[Time] = None, start: Optional[Time] = None, end: Optional[Time] = None,
           every: Optional[int] = None, progress: Progress = None, program: Optional[PathLike] = None,
           reading: Settings = None) -> Path:
    """Writes the frames of a run for another program, and gives the file or folder.

    - `to`: "vtk", "vtkhdf", "xyz", "csv", "lammps-dump", "lammps-data", "netcdf", "stl", "gsd", "gltf", "blender" or
      "grain-table".
    - `out`: the file or folder. Without it they go into the run's own folder, in place of an earlier export of this
      format; those of other programs' files go beside these.
    - `at`: s, only this moment. `start`, `end`: s, the first and the last one. `every`: each such frame.
    """
    path = path_of(run, "run")
    if out is None and (Path(path) / "scene.toml").is_file():
        out, force = Path(path) / _EXPORTS.get(str(to), str(to)), True
    words = [path, *options(to=to, out=out, force=bool(force) and out is not None, at=time_of(at, "at"), every=every)]
    words += _between(start, end, "until") + reading_words(_reading(run, reading))
    return Path(call("export", words, _program(run, program), progress).strip())


def report(runs: Any, out: Optional[PathLike] = None, *, progress: Progress = None, program: Optional[PathLike] = None,
           reading: Settings = None) -> Path:
    """The page of a run, or of several runs side by side: film, charts and the bed in three dimensions. It gives the
    file, report.html in the run's folder; of several runs side_by_side.html."""
    runs = _listed(runs)
    first = runs[0] if isinstance(runs, (list, tuple)) and runs else runs
    words = _paths(runs) + options(out=out) + reading_words(_reading(first, reading))
    return Path(call("report", words, _program(first, program), progress).strip())


def compare(runs: Any, *more: Union[PathLike, "Run"], out: Optional[PathLike] = None, force: bool = False,
            vary: Optional[Mapping[str, Any]] = None, captions: Optional[Sequence[str]] = None, at: Optional[Time] = None,
            size: Any = None, fps: Optional[float] = None, format: Optional[str] = None, title: Optional[str] = None,
            cache: bool = True, threads: Optional[int] = None, replay: bool = True, progress: Progress = None,
            program: Optional[PathLike] = None, reading: Settings = None, set: Settings = None,
            **settings: Any) -> Comparison:
    """Runs side by side, in step: two to six runs, scenes or files of other programs, as a list, one after another,
    or as a dict with their captions, {"weak": run, "strong": other}; or one scene with
    `vary={"drive.g_level": [2, 4]}`.

    - `captions`: one for each. `at`: s, one picture in place of a film.
    - `settings`, `set`: keys that every scene gets. The rest: see `start` and `film`.
    """
    _check_progress(progress)
    if isinstance(runs, Mapping) and captions is None:
        captions = [text_of(each, "a caption") for each in runs]
    runs = [runs, *more] if more else _listed(runs)
    given = _paths(runs)
    words: List[str] = given + options(
        out=out, force=bool(force) and out is not None, vary=_vary(vary), fps=fps, format=format, title=title,
        captions=None if captions is None else captions if isinstance(captions, str) else "|".join(captions),
        at=time_of(at, "at"), size=None if size is None else size_of(size), no_cache=not cache,
        threads=threads, no_replay=not replay)
    first = runs[0] if isinstance(runs, (list, tuple)) and runs else runs
    words += sets(settings, set) + reading_words(_reading(first, reading))
    folder = Path(call("compare", words, _program(first, program), progress).strip())
    inside = sorted(each.parent for each in folder.glob("*/scene.toml")) if folder.is_dir() else []
    given_runs = [each for each in given if (Path(each) / "scene.toml").is_file()]
    return Comparison(folder, [_run_in(str(each), program) for each in [*given_runs, *inside]])


def study(study: Scene = None, *, text: Optional[str] = None, out: Optional[PathLike] = None, jobs: Optional[int] = None,
          films: bool = False, retry: bool = False, cache: bool = True, progress: Progress = None,
          program: Optional[PathLike] = None) -> Study:
    """Runs a study to its end, or goes on with one that was stopped, and gives its results.

    - `study`: its file, or the study itself as a dict; or `text`: the study as text (docs/guide/studies.md).
    - `out`: its folder. `jobs`: members that run at a time.
    - `films`: makes a film of each member. `retry`: runs failed members again.
    """
    _check_progress(progress)
    file = SceneFile(study, text, "study")
    try:
        folder, _ = file.out(out)
        words = [program_of(program), "study", file.path]
        words += options(out=folder, jobs=jobs, films=films, retry=retry, no_cache=not cache)
    except BaseException:
        if file.tidy:
            file.tidy()
        raise
    made: Study = Running(words, lambda printed: Study(printed.strip()), "study", file.tidy, file.names).result(progress)
    return made


def check(scene: Scene = None, *, text: Optional[str] = None, program: Optional[PathLike] = None, set: Settings = None,
          **settings: Any) -> str:
    """The plan of a scene as text: laws, stiffness, step, cost. Nothing is run."""
    file = SceneFile(scene, text, "scene")
    try:
        words = [program_of(program), "check", file.path, *sets(settings, set)]
    except BaseException:
        if file.tidy:
            file.tidy()
        raise
    return Running(words, None, "check", file.tidy, file.names, progress=False).wait()


def _check_progress(progress: object) -> None:
    if progress is not None and not isinstance(progress, bool) and not callable(progress):
        raise wrong("progress", "True or a function", progress)


def _run_in(folder: str, program: object) -> "Run":
    from ._run import Run

    return Run(folder, program=program)


def _between(start: object, end: object, last: str) -> List[str]:
    """Options for the first and the last moment; the latter has another name in each verb."""
    words = options(**{"from": time_of(start, "start")})
    return words + options(**{last: time_of(end, "end")})


def _reading(run: object, reading: Settings) -> Dict[str, Any]:
    if reading is not None and not isinstance(reading, Mapping):
        raise wrong("reading", 'a dict, as in {"radius": "2 mm"}', reading)
    return {**getattr(run, "_reading", {}), **(reading or {})}


def _program(run: object, program: object) -> object:
    return program or getattr(run, "_program", None)


def _listed(runs: Any) -> Any:
    """A list of what a dict or another collection holds."""
    if isinstance(runs, Mapping):
        return list(runs.values())
    return list(runs) if isinstance(runs, (ValuesView, Iterator)) else runs


def _paths(runs: object) -> List[str]:
    if isinstance(runs, (str, bytes)) or hasattr(runs, "__fspath__"):
        return [path_of(runs, "runs")]
    if not isinstance(runs, (list, tuple)):
        raise wrong("runs", "a path or a list of them", runs)
    if not runs:
        raise GrainreelError("runs: is an empty list; give the runs")
    return [path_of(each, "runs") for each in runs]


def _drawn_before(path: str, words: List[str]) -> Optional[Film]:
    """The film that the same call has drawn of the same files beside them before."""
    source = Path(path)
    files = [source] if source.is_file() else [each for each in source.glob("*") if each.is_file()]
    if not files or not source.name:
        return None
    for folder in sorted(source.parent.glob(glob.escape(source.name) + "-render*")):
        try:
            record = read_record(folder / "run.json")
            made = (folder / "run.json").stat().st_mtime
            same = shlex.split(str(record.get("command", ""))) == [*words, "--progress", "json"]
            films = sorted(folder.glob("movie.*"))
            if same and films and record.get("status") == "complete" and all(each.stat().st_mtime < made for each in files):
                return Film(films[0])
        except (GrainreelError, OSError, ValueError):
            continue
    return None


def _condition(where: Optional[str]) -> Optional[str]:
    """A condition in the program's words, which has names in double quotes."""
    return None if where is None else re.sub(r"'([^'\"]*)'", r'"\1"', text_of(where, "where"))


def _vary(vary: Optional[Mapping[str, Any]]) -> Optional[str]:
    if vary is None:
        return None
    if not isinstance(vary, Mapping) or len(vary) != 1:
        raise wrong("vary", 'one key and its values, as in {"drive.g_level": [2, 4]}', vary)
    key, values = next(iter(vary.items()))
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise wrong("vary", 'one key and its values, as in {"drive.g_level": [2, 4]}', vary)
    return f"{key}=" + ",".join(str(each.item() if hasattr(each, "item") else each) for each in values)
