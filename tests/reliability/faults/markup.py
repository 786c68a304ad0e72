"""Markup in every text that a scene, a study or a file's name brings to a page: it is shown as text, and nothing runs."""
import json
import re
import shutil
import subprocess
import sys
from xml.etree import ElementTree
from html.parser import HTMLParser
from pathlib import Path

from tools import scene_in
from visitors import ask

# Each text would leave what it stands in (text, attribute, script, comment, CDATA) and run `hit(N)`.
EVIL = ["<script>hit(1)</script>", "</script><script>hit(2)</script>", '\\"><img src=x onerror=hit(3)>', "' onload='hit(4)' '",
        "]]><script>hit(5)</script>", "--><script>hit(6)</script>", "&lt;script&gt;hit(7)&lt;/script&gt;",
        "</title></style></textarea></pre><svg onload=hit(8)>", "${hit(9)}`+hit(10)+`", "{{facts}}{{title}}", "\\u2028hit(11)//",
        "<!--<script>", "javascript:hit(12)", "`touch HIT`", '\\";system(\\"touch HIT\\")#', "';system 'touch HIT';'"]

STL = """solid {evil}
facet normal 0 0 1
outer loop
vertex -0.005 -0.005 0.01
vertex 0.005 -0.005 0.01
vertex 0 0.005 0.01
endloop
endfacet
endsolid {evil}
"""

SCENE = """title = "{evil} title"
[[species]]
name = "{evil} a"
count = 20
diameter = "4 mm"
density = "2.5 g/cm3"
colour = "#cc8833"
[[species]]
name = "{evil} b"
count = 5
diameter = "5 mm"
density = "2.5 g/cm3"
[container]
shape = "box"
width = "30 mm"
depth = "20 mm"
height = "40 mm"
[[mesh]]
name = "{evil} m"
file = "{file}"
[drive]
frequency = "30 Hz"
g_level = 2
[run]
duration = "0.05 s"
overlap = 0.05
threads = 1
[output]
contacts = true
[film]
size = "320x180"
rate = 20
[[film.segment]]
playback = 0.5
[[film.caption]]
text = "{evil in a caption} caption"
from = "0 s"
to = "0.05 s"
"""

STUDY = """title = "{evil} title"
scene = "{scene}"
[[variant]]
name = "{evil} one"
set = []
[[variant]]
name = "{evil} two"
set = ["drive.g_level=3"]
[[measure]]
name = "kinetic"
label = "{evil} label"
column = "kinetic"
reduce = "mean"
[[chart]]
y = "kinetic"
x = "variant"
title = "{evil} chart"
"""


class Looker(HTMLParser):
    """Finds what a browser would run in a page: scripts that hold our texts raw, and attributes on...="""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.found, self.inside, self.shown = [], None, ""

    def handle_starttag(self, tag, attributes):
        if tag == "script":
            self.inside = dict(attributes).get("type", "")
        for name, value in attributes:
            if name.startswith("on") or (value or "").strip().lower().startswith("javascript:"):
                self.found.append(f"<{tag} {name}={value[:60]!r}>")
            if name == "srcdoc" or tag in ("iframe", "object", "embed", "base", "foreignobject"):
                self.found.append(f"<{tag} {name}={(value or '')[:60]!r}>")

    def handle_endtag(self, tag):
        if tag == "script":
            self.inside = None

    def handle_data(self, data):
        if self.inside is None:
            self.shown += data
        elif self.inside == "" and re.search(r"(?<![\"'\w])hit\(\d", data) and "\\u003c" not in data:
            self.found.append("a script has " + data[max(0, data.find("hit(") - 60):][:120])


def look_at(bench, page, what):
    text = page.read_text(errors="replace") if isinstance(page, Path) else page
    looker = Looker()
    looker.feed(text)
    bench.check(not looker.found, f"{what}: {looker.found[:3]}")
    scripts = re.findall(r"<script>\s*hit", text)
    bench.check(not scripts, f"{what}: a script of the text's own")
    return looker.shown


def look_at_drawing(bench, drawing, what):
    """An SVG has no scripts, no attributes on...=, and is whole XML."""
    try:
        root = ElementTree.parse(drawing).getroot()
    except ElementTree.ParseError as problem:
        bench.problem(f"{what}: {drawing.name}: {problem}")
        return
    for part in root.iter():
        active = [name for name in part.attrib if name.startswith("on")]
        links = [value for value in part.attrib.values() if value.strip().lower().startswith("javascript:")]
        foreign = part.tag.rsplit("}", 1)[-1] in ("script", "foreignObject", "iframe")
        bench.check(not (active or links or foreign), f"{what}: {drawing.name}: {part.tag} {part.attrib}")
    bench.count("drawings")


def look_at_live_page(bench, run, evil):
    """The page of `watch`, its state, and the links to files."""
    process = bench.start("watch", run, "--port", "0", cwd=run.parent)
    found = None
    while found is None and (line := process.stderr.readline()):
        found = re.search(rb"http://127\.0\.0\.1:(\d+)/", line)
    if bench.check(found is not None, f"live page with {evil!r}: none"):
        answer = ask(int(found[1]), "/").partition(b"\r\n\r\n")[2].decode(errors="replace")
        shown = look_at(bench, answer, f"live page with {evil!r}")
        bench.check(words_of(evil)[0] + " title" in shown, f"live page with {evil!r}: the title is not shown as it is")
        json.loads(ask(int(found[1]), "/live/state").partition(b"\r\n\r\n")[2])
    process.terminate()
    bench.end(process)
    bench.count("live pages")


def words_of(evil):
    """The text as TOML reads it, and as a file's name."""
    plain = evil.replace("\\u2028", "\u2028").replace('\\"', '"')
    return plain, plain.replace("/", "_")


def in_a_caption(evil):
    """The text without braces, between which a caption names a column."""
    return evil.replace("{", "(").replace("}", ")")


def one_run(bench, folder, evil):
    """A run full of the text; None where it is refused."""
    plain, name = words_of(evil)
    mesh = folder / f"{name}.stl"
    mesh.write_text(STL.replace("{evil}", plain))
    file = mesh.name.replace("\\", "\\\\").replace('"', '\\"')
    scene = scene_in(folder, SCENE.replace("{evil}", evil).replace("{file}", file).replace("{evil in a caption}", in_a_caption(evil)), f"{name}.toml")
    run = folder / f"{name} run"
    ended = bench.run("movie", scene, "--out", run, cwd=folder)
    if ended.status == 2 and "control character" in ended.said():
        bench.count("refused scenes")
        return None
    if not bench.check(ended.status == 0, f"{evil!r}: {ended.status}: {ended.said()}"):
        return None
    (run / f"notes {name}.txt").write_text("a file beside the run's")
    bench.must("report", run, cwd=folder)
    bench.must("report", run, "--charts", folder / f"{name} charts", "--as", "svg", cwd=folder)
    for drawing in folder.glob("* charts/*.svg"):
        look_at_drawing(bench, drawing, f"charts with {evil!r}")
    shown = look_at(bench, run / "report.html", f"page with {evil!r}")
    bench.check(plain + " title" in shown, f"page with {evil!r}: the title is not shown as it is")
    look_at_live_page(bench, run, evil)
    return run / "report.html"


def one_study(bench, folder, evil):
    plain, name = words_of(evil)
    scene = f"{name}.toml".replace("\\", "\\\\").replace('"', '\\"')
    study = scene_in(folder, STUDY.replace("{evil}", evil).replace("{scene}", scene), f"{name} study.toml")
    ended = bench.run("study", study, "--out", folder / "study", cwd=folder)
    if not bench.check(ended.status == 0, f"study of {evil!r}: {ended.status}: {ended.said()}"):
        return []
    for drawing in (folder / "study").rglob("*.svg"):
        look_at_drawing(bench, drawing, f"study of {evil!r}")
    made = list((folder / "study").glob("*.html"))
    for page in made:
        shown = look_at(bench, page, f"study of {evil!r}")
        bench.check(plain + " label" in shown, f"study of {evil!r}: the label is not shown as it is")
    return made


def pages(bench):
    here = bench.fresh("markup")
    made = []
    for k, evil in enumerate(EVIL):
        folder = here / str(k)
        folder.mkdir()
        page = one_run(bench, folder, evil)
        if page is None:
            continue
        made.append(page)
        if bench.long or k % 5 == 2:
            made += one_study(bench, folder, evil)
        if len(made) > 1 and (bench.long or k % 5 == 3):
            both = folder / "both.html"
            bench.must("report", page.parent, made[0].parent, "--out", both)
            look_at(bench, both, f"two runs with {evil!r}")
            made.append(both)
    bench.counts["pages"] = len(made)
    hits = list(here.rglob("HIT")) + list(bench.folder.glob("HIT"))
    bench.check(not hits, f"a text was run by a shell: {hits}")
    in_browser(bench, made)


BROWSE = """
import json, pathlib, sys
sys.path.insert(0, sys.argv[1])
from browser import Browser
hits = []
with Browser(at_start="window.hits = []; window.hit = n => window.hits.push(n); window.alert = hit;") as browser:
    for page in map(pathlib.Path, sys.argv[2:]):
        if "dataset.ready" in page.read_text():
            browser.open(page)
        else:  # a study's page: it has no script that says when it is ready
            browser.driver.get(page.resolve().as_uri())
        hits += [f"{page}: {n}" for n in browser.run("return window.hits")]
print(json.dumps(hits))
"""


def in_browser(bench, made):
    """Opens the pages in Chromium, where ./test --browser has installed it."""
    tests = Path(__file__).resolve().parents[2] / "browser"
    if shutil.which("chromium") is None or shutil.which("chromedriver") is None:
        bench.count("browsers (none is installed)")
        return
    done = subprocess.run(["/usr/bin/python3", "-c", BROWSE, tests, *made], capture_output=True, text=True)
    said = f"{done.stdout[-300:]} {done.stderr[-300:]}"
    if bench.check(done.returncode == 0 and done.stdout.strip() == "[]", f"browser: {said}"):
        bench.counts["pages in Chromium"] = len(made)


GROUPS = {"markup": pages}
