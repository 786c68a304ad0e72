// Puts a page together that computes its bed: starts the worker, shows what it sends, and passes on what the reader does.
const mostRows = 1500; // of the charts; then every second one goes
const shaking = {goesOn: 0, rests: 1, tapsOnce: 2}; // as PlayedBed::Shaking (engine/play/played_bed.hpp)

function say(id, text) {
    document.getElementById(id).textContent = text;
}

class Play {
    constructor(facts) {
        this.facts = facts;
        this.runTime = new RunTime(0, 1);
        this.runTime.isLive = true;
        this.isGoing = false;
        this.isResting = false;
        this.awaits = new Map(); // for tests: what is called when a message comes
        this.knobs = new Knobs(facts.knobs, this.part("knobs"), this.part("knobs-anew"), (knob, value) => this.turned(knob, value));
        this.bind();
    }

    part(id) {
        return document.getElementById(id);
    }

    async start() {
        if (typeof WebAssembly !== "object") throw new Error(tr("this browser has no WebAssembly, or it is switched off"));
        const [script, wasm] = await Promise.all(["engine-script", "engine-wasm"].map((id) => inflated(bytesOf(id))));
        this.wasm = wasm;
        if (!canCompute(wasm)) throw new Error(tr("this browser is too old for the engine (it needs WebAssembly with SIMD and exceptions)"));
        const source = new Blob([script, this.facts.worker], {type: "text/javascript"});
        this.worker = new Worker(URL.createObjectURL(source));
        this.worker.onmessage = ({data}) => this.take(data);
        this.worker.onerror = (event) => this.fail(event.message ?? "the worker has ended");
        await this.begin();
    }

    tell(message, transfer = []) {
        this.worker?.postMessage(message, transfer);
    }

    begin() {
        const {planned, open, columns, bed} = this.facts;
        this.isGoing = false;
        this.isPacked = false;
        this.hasFrame = false;
        this.enable(false);
        this.part("play-done").hidden = false;
        this.startedAt = performance.now();
        const request = {planned, open, turned: this.knobs.changed(), columns: columns.map((column) => column.name), low: bed.low,
                         high: bed.high, speed: bed.speed.highest};
        this.rows = {columns: [{name: "time_s", label: tr("time"), unit: "s"}, ...columns], values: [[], ...columns.map(() => [])]};
        this.tell({does: "begin", wasm: this.wasm, request});
    }

    // ---- What the worker sends ----

    take(message) {
        this[`on_${message.is}`]?.(message);
        this.awaits.get(message.is)?.(message);
        this.awaits.delete(message.is);
    }

    /** For tests: a promise of the next message of a kind. */
    next(is) {
        return new Promise((done) => this.awaits.set(is, done));
    }

    on_planned({plan}) {
        this.plan = plan;
        this.tellPlan();
    }

    on_turned({plan}) {
        this.plan = plan;
        this.tellPlan();
    }

    // How soft the grains are with the knobs as they stand.
    tellPlan() {
        const percent = numberText(Number((100 * this.plan.overlap).toPrecision(2)));
        say("overlap-says", tr("Grains overlap by {1} % of their diameter at most, by the plan; one step is {2} µs.", percent, numberText(1e6 * this.plan.step)));
    }

    on_packing({stage, done}) {
        const words = [tr("The grains grow to their sizes"), tr("The grains rain"), tr("The bed settles")];
        say("play-says", `${words[stage]} …`);
        this.part("play-done").value = done;
    }

    on_packed() {
        this.isPacked = true;
        this.part("play-done").hidden = true;
        this.enable(true);
        if (window.grainreelWaits) return; // a test makes the steps
        this.wasHidden = document.hidden;
        this.go(!document.hidden);
        this.tell({does: "frame", pairs: true});
    }

    on_frame(frame) {
        this.time = frame.time;
        if (!this.hasFrame) this.first(frame);
        this.frame = frame;
        if (this.isWaiting) return;
        this.isWaiting = true;
        requestAnimationFrame(() => {
            this.isWaiting = false;
            this.panel?.showFrame(this.frame);
            this.pictures = (this.pictures ?? 0) + 1;
            this.tell({does: "frame", pairs: this.panel?.wantsPairs() ?? false});
        });
    }

    // The first picture of a bed makes the panel; that of another bed replaces its moments.
    first(frame) {
        this.hasFrame = true;
        const {bed} = this.facts, frames = new LiveBed(bed, frame);
        try {
            if (!this.panel) {
                this.panel = new LivePanel(bed, frames, this.runTime, "", new LiveForces(frames.grains), this.meshes ?? null);
                this.part("forces").hidden = false;
                for (const id of ["forces-back", "forces-on"]) this.part(id).hidden = true;
            } else {
                this.panel.frames = frames;
                this.panel.forces.grains = frames.grains;
                this.panel.viewer.chosen = -1;
                this.panel.viewer.path = [];
                this.panel.viewer.take(frames, this.panel.viewer.walls);
                this.panel.findColourings();
                this.panel.colour(this.panel.coloured);
            }
        } catch (problem) {
            say("bed-says", tr("The bed in three dimensions is not shown: {1}. Film and charts do without it.", problem.message));
        }
        this.report?.();
        document.documentElement.dataset.ready = "yes";
    }

    on_measures({time, values, rates}) {
        const rows = this.rows.values;
        const last = rows[0].length - 1;
        if (!(rows[0][last] >= time)) [time, ...values].forEach((value, column) => rows[column].push(value));
        if (rows[0].length > mostRows) this.rows.values = rows.map((column) => column.filter((_, row) => row % 2 === 0));
        this.runTime.end = Math.max(1e-6, time);
        if (this.charts) {
            this.charts.take(this.rows);
        } else {
            this.charts = new Charts([{name: "", measures: this.rows}], this.facts.charts, this.runTime);
            say("charts-say", "");
        }
        this.runTime.set(time, "run");
        this.tellPace(time, rates);
    }

    on_stopped({over}) {
        this.isGoing = false;
        this.showGoing();
        if (over) say("play-says", tr("The scene ends here, at {1} s.", numberText(this.time)));
    }

    on_scene({text}) {
        const file = `${this.facts.name}.toml`;
        const link = element("a", {href: URL.createObjectURL(new Blob([text], {type: "text/plain"})), download: file});
        link.click();
        say("take-says", tr("{1} is saved. Make its film by: {2}", file, `${this.facts.call} ${file}`));
    }

    on_error({text}) {
        this.fail(text);
    }

    fail(text) {
        this.isGoing = false;
        this.showGoing();
        this.part("play-done").hidden = true;
        const words = this.part("play-says");
        words.classList.add("slow");
        words.textContent = tr("It does not go on: {1}", text);
        this.part("again").disabled = !this.worker;
        document.documentElement.dataset.ready ??= "failed";
    }

    // ---- How fast it goes ----

    tellPace(time, rates) {
        const words = this.part("pace-says");
        if (!rates) return;
        const wanted = Number(this.part("pace").value);
        say("play-says", tr("{1} s of the bed; {2} s of it in a second.", time.toFixed(2), numberText(Number(rates.does.toPrecision(2)))));
        const isSlow = wanted < 100 && rates.could !== null && rates.could < 0.95 * wanted;
        this.slow = isSlow ? (this.slow ?? 0) + 1 : 0;
        words.classList.toggle("slow", this.slow > 10);
        if (this.slow <= 10) return void (words.textContent = "");
        words.textContent = tr("This device computes {1} s of the bed in a second, not {2}. Fewer grains are faster, or a lower speed.",
                               numberText(Number(rates.could.toPrecision(2))), numberText(wanted));
        if (!this.part("fewer") && this.knobs.knobs.some((knob) => knob.key.endsWith(".count"))) {
            const fewer = element("button", {type: "button", id: "fewer"}, tr("Half as many grains"));
            fewer.addEventListener("click", () => this.halve());
            words.after(fewer);
        }
    }

    halve() {
        this.part("fewer")?.remove();
        for (const knob of this.knobs.knobs)
            if (knob.key.endsWith(".count") && this.knobs.values.get(knob.key) > 8) this.knobs.set(knob, this.knobs.values.get(knob.key) / 2, null);
        this.begin();
    }

    // ---- What the reader does ----

    bind() {
        const on = (id, what) => this.part(id).addEventListener("click", what);
        on("go", () => this.go(!this.isGoing));
        on("one-period", () => this.onePeriod());
        on("again", () => this.begin());
        on("anew", () => this.begin());
        on("rest", () => this.rest(!this.isResting));
        on("tap", () => this.tap());
        on("take", () => this.tell({does: "scene"}));
        this.part("pace").addEventListener("change", (event) => this.tell({does: "pace", pace: Number(event.target.value)}));
        this.part("tilt").addEventListener("input", (event) => this.tilt(Number(event.target.value)));
        for (const words of document.querySelectorAll(".whole-run")) words.hidden = true;
        this.part("anew-set").hidden = !this.facts.knobs.some((knob) => knob.anew);
        this.part("shake-controls").hidden = this.part("one-period").hidden = !this.facts.frequency;
        this.part("tilt-knob").hidden = !this.facts.tilts;
        addEventListener("keydown", (event) => this.key(event));
        document.addEventListener("visibilitychange", () => this.hide(document.hidden));
        setInterval(() => this.askForPairs(), 250);
    }

    // A bed that stands still gets its pairs when somebody asks for them.
    askForPairs() {
        if (this.frame && !this.isGoing && !this.frame.pairs && this.panel?.wantsPairs()) this.tell({does: "frame", pairs: true});
    }

    // Space stops and goes on, unless something has the focus that takes it itself.
    key(event) {
        if (event.key !== " " || !this.isPacked || ["INPUT", "BUTTON", "SELECT", "A", "SUMMARY"].includes(event.target.tagName)) return;
        event.preventDefault();
        this.go(!this.isGoing);
    }

    // A page that nobody sees does not compute.
    hide(isHidden) {
        if (isHidden && this.isGoing) {
            this.go(false);
            this.wasHidden = true;
        } else if (!isHidden && this.wasHidden) {
            this.wasHidden = false;
            this.go(true);
        }
    }

    enable(is) {
        for (const id of ["go", "one-period", "again", "rest", "tap", "take", "anew"]) this.part(id).disabled = !is;
    }

    showGoing() {
        say("go", tr(this.isGoing ? "Pause" : "Go on"));
    }

    go(on, steps = null) {
        this.isGoing = on;
        this.showGoing();
        this.tell({does: "go", on, steps});
    }

    onePeriod() {
        const frequency = this.knobs.values.get("drive.frequency") ?? this.facts.frequency;
        this.go(true, Math.max(1, Math.round(1 / frequency / this.plan.step)));
    }

    rest(is) {
        this.isResting = is;
        this.part("rest").setAttribute("aria-pressed", is);
        say("rest", tr(is ? "Shake again" : "Stop shaking"));
        this.tell({does: "shake", how: is ? shaking.rests : shaking.goesOn});
    }

    tap() {
        this.rest(true);
        this.tell({does: "shake", how: shaking.tapsOnce});
        if (!this.isGoing) this.go(true);
    }

    tilt(degrees) {
        say("tilt-says", `${withMinus(String(degrees))}°`);
        clearTimeout(this.tilting);
        this.tilting = setTimeout(() => this.tell({does: "tilt", angle: (degrees * Math.PI) / 180}), 100);
    }

    turned(knob, value) {
        if (knob.anew) return;
        this.tell({does: "turn", key: knob.key, value});
    }
}

// Whether the browser knows the instructions that the engine uses.
function canCompute(wasm) {
    try {
        return WebAssembly.validate(wasm);
    } catch {
        return false;
    }
}

function bindLargePrint() {
    const button = document.getElementById("large-print");
    button.addEventListener("click", () => button.setAttribute("aria-pressed", document.documentElement.classList.toggle("large")));
}

bindLargePrint();
const play = new Play(factsOf("facts"));
window.grainreelPlay = play; // for tests and for curious readers
document.addEventListener("DOMContentLoaded", async () => {
    try {
        const meshes = bytesOf("meshes-bytes");
        if (meshes) play.meshes = await inflated(meshes);
        await play.start();
    } catch (problem) {
        play.fail(problem.message);
    }
});
