// Keeps the page of a run that is still computed up to date: once a second it asks the server of the page what is new
// (render/page/live).

const secondsBetweenLooks = 1;

class Live {
    constructor(facts, runTime) {
        this.facts = facts;
        this.runTime = runTime;
        this.has = {picture: 0, bed: -1, rows: 0}; // versions that the page shows
        this.charts = null;
        this.bed = null;
        runTime.isLive = true;
        for (const words of document.querySelectorAll(".whole-run")) words.hidden = true;
        document.getElementById("bar").hidden = true; // there is no way back in time
        for (const button of document.querySelectorAll("button[data-time]")) button.replaceWith(button.textContent);
        document.getElementById("bed-says").textContent = tr("The run has written no grains yet.");
        document.getElementById("film-says").textContent = tr("The film has no picture yet.");
        document.getElementById("charts-say").textContent = tr("The run has measured nothing yet.");
    }

    async go() {
        try {
            const state = await (await fetch("./live/state", {cache: "no-store"})).json();
            this.failures = 0;
            this.tell(state);
            await this.takeParts(state);
            if (state.last || state.stage === "gone") return;
            this.isOver = state.over;
        } catch {
            this.failures = (this.failures ?? 0) + 1;
            if (this.failures > 2) this.say(tr("The program that shows the run has ended; what it showed last is below."));
        }
        const wait = this.failures > 2 || this.isOver ? 10 : document.hidden ? 5 : 1;
        setTimeout(() => this.go(), 1000 * wait * secondsBetweenLooks);
    }

    say(text) {
        document.getElementById("live-says").textContent = text;
    }

    tell(state) {
        const of = tr("{1} of {2} s", numberText(Math.max(0, state.time)), numberText(state.end));
        const left = state.remaining === null ? "" : tr(", {1} left", durationText(state.remaining));
        const words = {
            packing: tr("The grains are being packed."),
            running: `${of}${left}.`,
            complete: tr("The run is complete: {1} s.", numberText(state.time)),
            interrupted: tr("The run was stopped at {1}.", of),
            failed: tr("The run failed at {1}; log.txt tells why.", of),
            gone: tr("The run’s folder has gone."),
        };
        this.say(words[state.stage] ?? tr("The run was broken off at {1}.", of));
        const bar = document.getElementById("live-done");
        if (state.stage === "packing") bar.removeAttribute("value");
        else bar.value = state.done;
        document.getElementById("live-report").hidden = !(state.over && state.report);
        this.runTime.begin = Math.min(state.begin, 0);
        this.runTime.end = Math.max(state.end, state.time);
        this.runTime.set(state.time, "run");
    }

    async takeParts(state) {
        if (state.rows > this.has.rows) await this.takeMeasures(state.rows);
        if (state.bed !== this.has.bed && state.bed >= 0) await this.takeBed(state);
        if (state.picture !== this.has.picture) await this.takePicture(state.picture);
    }

    async takeMeasures(rows) {
        const answer = await fetch("./live/measures", {cache: "no-store"});
        if (!answer.ok) return;
        const measures = await answer.json();
        this.has.rows = rows;
        say("charts-say", "");
        if (!this.charts) {
            this.charts = new Charts([{name: "", measures}], measures.charts, this.runTime);
            const link = element("a", {href: "./measures.csv", download: ""}, tr("Download {1}", "measures.csv"));
            document.getElementById("downloads").append(link);
            report.charts = this.charts;
        } else {
            this.charts.take(measures);
            for (const name of measures.charts) this.charts.addOnce(name); // charts of columns that begin to change only now
        }
        this.charts.setRange(this.charts.range);
    }

    async takeBed(state) {
        const answer = await fetch("./live/bed", {cache: "no-store"});
        if (!answer.ok) return;
        const bytes = new Uint8Array(await answer.arrayBuffer());
        const length = new DataView(bytes.buffer).getUint32(0, true);
        const facts = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
        this.has.bed = state.bed;
        try {
            const packed = await inflated(bytes.subarray(4 + length));
            if (this.bed) {
                this.bed.take(facts, packed);
            } else {
                this.bed = new BedPanel(facts, packed, this.runTime, "", null, await this.meshes(facts));
                report.bed = this.bed;
            }
        } catch (problem) {
            say("bed-says", tr("The bed in three dimensions is not shown: {1}. Film and charts do without it.", problem.message));
            this.has.bed = state.bed;
        }
    }

    // The meshes of walls come only once.
    async meshes(facts) {
        if (!facts.meshes?.length) return null;
        const answer = await fetch("./live/meshes", {cache: "no-store"});
        return answer.ok ? inflated(new Uint8Array(await answer.arrayBuffer())) : null;
    }

    // The old picture stays until the new one is there.
    async takePicture(version) {
        const picture = document.getElementById("live-picture");
        const next = new Image();
        next.src = `./live/picture?n=${version}`;
        await next.decode();
        this.has.picture = version;
        picture.src = next.src;
        picture.hidden = false;
        say("film-says", tr("The film’s newest picture."));
    }
}

/** A duration in words: "45 s", "3 min", "2 h 5 min". */
function durationText(seconds) {
    const whole = Math.ceil(seconds);
    if (whole < 100) return `${whole} s`;
    const minutes = Math.ceil(whole / 60);
    return minutes < 100 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}
