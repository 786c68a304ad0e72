// Puts the page together: charts at once, then film and bed when the bytes at the page's end are there.

function say(id, text) {
    const place = document.getElementById(id);
    if (place) place.textContent = text;
}

function offerTable(bytes, name) {
    const link = document.getElementById("download-csv");
    if (!link) return;
    link.href = URL.createObjectURL(new Blob([bytes], {type: "text/csv"}));
    link.download = name;
    link.hidden = false;
}

async function openTable(facts, charts) {
    const packed = bytesOf("measures-bytes");
    if (!packed || !charts) return;
    try {
        const bytes = await inflated(packed);
        offerTable(bytes, "measures.csv");
        charts.take(readTable(new TextDecoder().decode(bytes), facts.columns));
        charts.fillChooser();
    } catch (problem) {
        say("charts-say", `The complete table is not here: ${problem.message}. It lies in measures.csv beside the page.`);
    }
}

function openFilm(facts, runTime, bar) {
    const bytes = facts.film ? bytesOf("film-bytes") : null;
    if (bytes) return new FilmPanel(facts.film, bytes, runTime, bar);
    return null;
}

async function openBed(facts, runTime) {
    const packed = facts.bed ? bytesOf("bed-bytes") : null;
    if (!packed) return null;
    try {
        return new BedPanel(facts.bed, await inflated(packed), runTime);
    } catch (problem) {
        say("bed-says", `The bed in three dimensions is not shown: ${problem.message}. Film and charts do without it.`);
        return null;
    }
}

// The captions of the film, each of which leads to its moment.
function bindStory(runTime) {
    for (const button of document.querySelectorAll("button[data-time]"))
        button.addEventListener("click", () => runTime.set(Number(button.dataset.time), "story"));
}

function bindCopies() {
    for (const button of document.querySelectorAll("button[data-copies]"))
        button.addEventListener("click", async () => {
            const text = document.getElementById(button.dataset.copies);
            getSelection().selectAllChildren(text);
            try {
                await navigator.clipboard.writeText(text.textContent);
                button.textContent = "Copied";
            } catch {
                button.textContent = "Selected: copy it with Ctrl-C";
            }
        });
}

/** Words, poster and charts are on the screen before bytes are unpacked. A hidden page has no pictures to wait for. */
function firstPicture() {
    const longest = 3000; // ms
    return new Promise((done) => {
        setTimeout(done, document.hidden ? 0 : longest);
        requestAnimationFrame(() => setTimeout(done));
    });
}

const facts = factsOf("facts");
const runTime = new RunTime(facts.begin, facts.end);
const steps = facts.film && facts.film.times.length ? facts.film.times : facts.bed ? facts.bed.times : facts.measures.values[0];
const bar = new TimeBar(runTime, steps, facts.frequency);
const charts = facts.measures ? new Charts(facts.measures, facts.charts, runTime) : null;
bindCopies();
bindStory(runTime);

// For tests and for the curious.
const report = {runTime, charts, film: null, bed: null};
window.grainreelReport = report;
document.addEventListener("DOMContentLoaded", async () => {
    await firstPicture();
    report.film = openFilm(facts, runTime, bar);
    report.bed = await openBed(facts, runTime);
    await openTable(facts, charts);
    document.documentElement.dataset.ready = "yes";
});
