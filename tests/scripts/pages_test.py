#!/usr/bin/env python3
"""Runs docs/guide/lesson.md or docs/guide/paper.md from top to bottom: every command as it stands, with the page's own
words and files.

usage: pages_test.py GRAINREEL lesson|paper

The scene of the lesson has fewer grains, and its pictures are small; nothing else is changed. What the pages say that a
command makes must be there, and what they name in their text (`--for talk`, `lang = "de"`, `--as svg`) must work.
"""
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from guide_blocks import blocks, check, run  # noqa: E402

GUIDE = pathlib.Path(__file__).resolve().parents[2] / "docs/guide"
FEWER = [('count = 1500', 'count = 400'), ('duration = "1 s"', 'duration = "0.6 s"'), ('size = "1280x720"', 'size = "480x270"'),
         ('from = "0.45 s"', 'from = "0.3 s"')]


def of_toml(page):
    """The page's examples of scenes and studies, in their order."""
    return re.findall(r"```toml\n(.*?)```", page.read_text(), re.DOTALL)


def replaced(text, old, new):
    check(text.count(old) == 1, f"{old!r} is not once in the scene that the page copies")
    return text.replace(old, new)


def command(folder, page, line, first=0):
    done = run(line, folder, script=True)
    check(done.returncode == 0, f"{page}:{first}: {line}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    check("error" not in done.stderr, f"{page}:{first}: {line}\n{done.stderr}")
    return done


def commands_of(folder, page, after):
    """Runs all commands; after: what is to be done behind a command, by its first words."""
    count, said = 0, {}
    for first, _, lines in blocks(page):
        for line in lines:
            said[line] = command(folder, page, line, first)
            count += 1
            for words, then in after.items():
                if line.startswith(words):
                    then()
    print(f"{page.name}: ran {count} commands")
    return said


def expect(folder, *names):
    for name in names:
        check((folder / name).is_file() and (folder / name).stat().st_size > 0, f"{name} was not made")


def lesson(folder):
    page = GUIDE / "lesson.md"
    title, words = of_toml(page)

    def use_own_words():
        file = folder / "lesson.toml"
        scene = file.read_text()
        scene = re.sub(r'^title = .*\n', title, scene, count=1, flags=re.MULTILINE)
        scene = replaced(scene, "[film.camera]", words + "\n[film.camera]")
        scene = replaced(scene, 'y = "outflow"', 'y = "outflow"\nlabel = "sand below (g)"')
        for old, new in FEWER:
            scene = replaced(scene, old, new)
        file.write_text(scene)

    said = commands_of(folder, page, {"./movie new": use_own_words})
    expect(folder, "output/lesson/movie.mp4", "output/lesson/report.html", "output/two/movie.mp4", "output/two/report.html",
           "output/handout/still-0.500s.pdf", "still.pdf")
    both = next(done.stderr for line, done in said.items() if line.startswith("./movie compare lesson"))
    check(both.count("outflow: ") == 2 and both.count("Beverloo's law expects") == 2, f"two lines for each hopper: {both}")
    page_of_both = (folder / "output/two/report.html").read_text()
    check("a wide neck</h2>" in page_of_both and 'id="outflow"' in page_of_both, "the page lacks captions or rates")
    talk = command(folder, page, "./movie render output/lesson --for talk --out talk").stderr
    expect(folder, "talk/movie.mp4")
    check("warning" not in talk, talk)
    german = folder / "lesson.toml"
    german.write_text(replaced(german.read_text(), "[film]\n", '[film]\nlang = "de"\n'))
    command(folder, page, "./movie lesson.toml --out german --duration 0.3s")
    check('<html lang="de"' in (folder / "german/report.html").read_text(), "the page is not German")


def paper(folder):
    page = GUIDE / "paper.md"
    study = of_toml(page)[0]
    said = commands_of(folder, page, {"./movie new": lambda: (folder / "rise.toml").write_text(study)})
    ran = next(done.stderr for line, done in said.items() if line.startswith("./movie study rise.toml  "))
    told = re.search(r"warning: (rise_time came up in .*?)\. \.\.\.", page.read_text()).group(1)
    check(told in ran, f"the page tells {told!r}, but: {ran}")
    expect(folder, "figures/rise_time.pdf", "figures/risen.pdf", "periods.csv", "parameters.csv", "output/rise/study.toml",
           *(f"output/rise/{name}" for name in ("methods.txt", "sources.bib", "parameters.csv", "study.csv", "settings.csv",
                                                "index.html")))
    width = re.search(rb"/MediaBox \[ 0 0 ([\d.]+)", (folder / "figures/rise_time.pdf").read_bytes())
    check(width and abs(float(width.group(1)) / 72 * 25.4 - 85) < 0.5, f"rise_time.pdf is not 85 mm wide: {width}")
    command(folder, page, "./movie study rise.toml --collect --charts wide --width-mm 170 --as svg")
    expect(folder, "wide/rise_time.svg", "wide/risen.svg")
    check('width="170' in (folder / "wide/risen.svg").read_text(), "risen.svg is not 170 mm wide")


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "bin").mkdir()
        movie = folder / "movie"
        movie.write_text('#!/bin/bash\nexport GRAINREEL_CALLED=./movie\n'
                         f'if [[ $1 == *.toml ]]; then set -- movie "$@"; fi\nexec "{program}" "$@"\n')
        movie.chmod(0o755)
        {"lesson": lesson, "paper": paper}[sys.argv[2]](folder)


main()
