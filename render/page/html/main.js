// Puts the page together: charts at once, then film and bed when the bytes at the page's end have been loaded.

function say(id, text) {
    const place = document.getElementById(id);
    if (place) place.textContent = text;
}

function offerTable(bytes, file, name) {
    const link = element("a", {href: URL.createObjectURL(new Blob([bytes], {type: "text/csv"})), download: file}, name);
    document.getElementById("downloads").append(link, " ");
}

async function openTable(run, k, n) {
    const packed = bytesOf("measures-bytes" + n);
    if (!packed || !charts) return;
    try {
        const bytes = await inflated(packed);
        offerTable(bytes, facts.runs ? `${run.folder}.csv` : "measures.csv", tr("Download {1}", facts.runs ? run.name : "measures.csv"));
        charts.take(readTable(new TextDecoder().decode(bytes), run.columns), k);
        charts.fillChooser();
    } catch (problem) {
        say("charts-say", `The complete table is not here: ${problem.message}. It lies in measures.csv in the run’s folder.`);
    }
}

function openFilm(run, n) {
    const bytes = run.film ? bytesOf("film-bytes" + n) : null;
    return bytes ? new FilmPanel(run.film, bytes, runTime, bar, n) : null;
}

async function openBed(run, n) {
    const packed = run.bed ? bytesOf("bed-bytes" + n) : null;
    if (!packed) return null;
    try {
        const [forces, meshes] = ["forces-bytes", "meshes-bytes"].map((id) => bytesOf(id + n));
        return new BedPanel(run.bed, await inflated(packed), runTime, n, forces && (await inflated(forces)),
                            meshes && (await inflated(meshes)));
    } catch (problem) {
        say("bed-says" + n, tr("The bed in three dimensions is not shown: {1}. Film and charts do without it.", problem.message));
        return null;
    }
}

// Makes the film's captions lead to their moments. The caption of the page's moment also stands below the film.
function bindStory(runTime) {
    for (const button of document.querySelectorAll("button[data-time]"))
        button.addEventListener("click", () => runTime.set(Number(button.dataset.time), "story"));
    const now = document.getElementById("caption-now"), items = [...document.querySelectorAll("li[data-from]")];
    if (!now || !items.length) return;
    runTime.listen((time) => {
        const rounding = 1e-6; // s
        const shown = items.filter(({dataset}) => time >= dataset.from - rounding && time < dataset.until - rounding);
        for (const item of items) item.toggleAttribute("aria-current", shown.includes(item));
        const text = shown.map((item) => item.querySelector("span").textContent).join(" ");
        if (now.textContent !== text) now.textContent = text;
        now.hidden = !text;
    });
}

// Binds the button for large print, for the back row of a lecture hall.
function bindLargePrint() {
    const button = document.getElementById("large-print");
    button.addEventListener("click", () => {
        const isLarge = document.documentElement.classList.toggle("large");
        button.setAttribute("aria-pressed", isLarge);
    });
}

function bindCopies() {
    for (const button of document.querySelectorAll("button[data-copies]"))
        button.addEventListener("click", async () => {
            const text = document.getElementById(button.dataset.copies);
            getSelection().selectAllChildren(text);
            try {
                await navigator.clipboard.writeText(text.textContent);
                button.textContent = tr("Copied");
            } catch {
                button.textContent = tr("Selected: copy it with Ctrl-C");
            }
        });
}

/** Waits until words, poster and charts are on the screen, before bytes are unpacked. A hidden page does not wait. */
function firstPicture() {
    const longest = 3000; // ms
    return new Promise((done) => {
        setTimeout(done, document.hidden ? 0 : longest);
        requestAnimationFrame(() => setTimeout(done));
    });
}

async function openFields(run, n) {
    const packed = run.fields ? bytesOf("fields-bytes" + n) : null;
    if (!packed) return null;
    try {
        return new FieldsPanel(run.fields, await inflated(packed), runTime, n);
    } catch (problem) {
        say("field-says" + n, tr("The fields are not shown: {1}.", problem.message));
        return null;
    }
}

// Ending of the ids of a run's elements: empty when the page has only one run.
function endOf(k) {
    return facts.runs ? `-${k}` : "";
}

async function openPage() {
    report.films = runs.map((run, k) => openFilm(run, endOf(k)));
    if (facts.runs && facts.film) report.films.unshift(openFilm(facts, "-all")); // of all runs, side by side
    report.beds = [];
    for (const [k, run] of runs.entries()) report.beds.push(await openBed(run, endOf(k)));
    performance.mark("beds");
    report.fields = [];
    for (const [k, run] of runs.entries()) report.fields.push(await openFields(run, endOf(k)));
    const films = report.films.filter((film) => film?.tied), beds = report.beds.filter((bed) => bed);
    for (const panels of [films, beds]) for (const one of panels) one.others = panels.filter((other) => other !== one);
    for (const [k, film] of films.entries()) film.leads = k === 0;
    if (beds.length > 1) BedPanel.shareColourings(beds), BedPanel.shareScale(beds);
    [report.film] = report.films;
    [report.bed] = report.beds;
    for (const [k, run] of runs.entries()) await openTable(run, k, endOf(k));
}

// The times that the buttons go through: those of the film's frames, else of the bed's moments or the measures' rows.
function stepsOf(run) {
    if (run.film && run.film.times.length) return run.film.times;
    return run.bed ? run.bed.times : run.measures ? run.measures.values[0] : [0];
}

function makeCharts() {
    if (!runs.some((run) => run.measures)) return null;
    const none = {columns: [{name: "time_s", label: "time", unit: "s"}], values: [[]]};
    const shown = [...new Set(runs.flatMap((run) => run.charts))];
    const tables = runs.map(({name, measures}) => ({name: facts.runs ? name : "", measures: measures ?? none}));
    return new Charts(tables, shown, runTime);
}

// Hides controls for things that the run has not kept.
function hideUseless() {
    if (facts.live || charts) return;
    for (const part of document.querySelectorAll("#chart-controls, .whole-run")) part.hidden = true;
    if (runs.some((run) => run.film || run.bed)) return;
    document.getElementById("bar").hidden = true;
    for (const button of document.querySelectorAll("button[data-time]")) button.replaceWith(button.textContent);
}

const facts = factsOf("facts");
const runTime = new RunTime(facts.begin, facts.end);
const runs = facts.runs ?? [facts];
const bar = new TimeBar(runTime, stepsOf(facts.runs && facts.film?.times.length ? facts : runs[0]), facts.frequency);
const charts = makeCharts();
hideUseless();
bindCopies();
bindLargePrint();
bindStory(runTime);

// An object for tests and for curious readers.
const report = {runTime, charts, film: null, bed: null};
window.grainreelReport = report;
document.addEventListener("DOMContentLoaded", async () => {
    await firstPicture();
    await (facts.live ? new Live(facts, runTime).go() : openPage());
    document.documentElement.dataset.ready = "yes";
});
