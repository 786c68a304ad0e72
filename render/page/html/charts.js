// Charts of the measures against the run's time, drawn by uPlot. Pressing and dragging in one moves the time;
// the wheel and the buttons zoom in time, for all charts together.

function colourOf(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

const chartHeight = 200; // CSS pixels, with the axes

class Charts {
    /**
     * runs: {name, measures} for each run, which gets a line in each chart. measures: {columns: [{name, label, unit}],
     * values: [[...]]}; the time is the first column. shown: names of the columns that have a chart at first.
     */
    constructor(runs, shown, runTime) {
        this.runTime = runTime;
        this.place = document.getElementById("charts");
        this.plots = new Map(); // by the column's name
        this.titles = new Map(); // by the same: the elements with the charts' titles
        this.range = null; // of time, s; null for all
        this.removed = new Set(); // names of columns whose charts the reader took away
        this.runs = runs;
        this.takeAll();
        for (const name of shown) this.add(name);
        this.fillChooser();
        for (const [id, factor] of [["zoom-in", 0.5], ["zoom-out", 2]])
            document.getElementById(id).addEventListener("click", () => this.zoom(factor, runTime.now));
        document.getElementById("zoom-all").addEventListener("click", () => this.setRange(null));
        runTime.listen(() => this.redraw());
        new ResizeObserver(() => this.resize()).observe(this.place);
        addEventListener("beforeprint", () => this.redraw());
        for (const query of ["(prefers-color-scheme: dark)", "print"])
            matchMedia(query).addEventListener("change", () => this.redraw());
    }

    /** Takes new values of a run, with more columns or more rows. */
    take(measures, run = 0) {
        this.runs[run].measures = measures;
        this.takeAll();
    }

    takeAll() {
        this.columns = new Map(); // by name, of all runs
        for (const {measures} of this.runs)
            for (const column of measures.columns.slice(1)) this.columns.set(column.name, column);
        for (const [name, plot] of this.plots) {
            this.titles.get(name).textContent = titleOf(this.columns.get(name), this.unitOf(name));
            plot.setData(this.dataOf(name));
        }
    }

    // The values of a column in a run; null when the run lacks it.
    valuesOf(name, {measures}) {
        const at = measures.columns.findIndex((column) => column.name === name);
        return at > 0 ? measures.values[at] : null;
    }

    // The data of a chart: the times, and for each run its rows and, where the film has them, their means over a period.
    dataOf(name) {
        const tables = this.runs.map((run) => {
            const times = run.measures.values[0], values = this.valuesOf(name, run) ?? times.map(() => null);
            return this.columns.get(name).smooth ? [times, values, meansOf(values, this.valuesOf("cycles", run))] : [times, values];
        });
        return tables.length === 1 ? tables[0] : uPlot.join(tables);
    }

    // The unit that suits the largest value of all runs, as in films: {name, size in SI}.
    unitOf(name) {
        const {units, unit} = this.columns.get(name);
        if (!units) return {name: unit, size: 1};
        let largest = 0;
        for (const run of this.runs)
            for (const value of this.valuesOf(name, run) ?? []) largest = Math.max(largest, Math.abs(value ?? 0));
        return units.find(({size}) => largest >= 0.5 * size) ?? units[units.length - 1];
    }

    fillChooser() {
        const chooser = document.getElementById("more-charts");
        chooser.replaceChildren(element("option", {value: ""}, tr("Add a chart…")));
        for (const column of this.columns.values())
            if (!this.plots.has(column.name))
                chooser.append(element("option", {value: column.name}, column.label));
        chooser.onchange = () => {
            if (chooser.value) this.add(chooser.value);
            this.fillChooser();
        };
    }

    addOnce(name) {
        if (!this.plots.has(name) && !this.removed.has(name)) this.add(name);
    }

    add(name) {
        const column = this.columns.get(name);
        if (!column) return;
        const frame = element("figure", {className: "chart"});
        const summary = this.summaryOf(column);
        const title = element("span", {}, titleOf(column, this.unitOf(name)));
        const words = element("figcaption", {}, title);
        const remove = element("button", {type: "button", title: tr("Remove this chart")}, "×");
        remove.setAttribute("aria-label", tr("Remove the chart of {1}", column.label));
        words.append(remove);
        const canvas = element("div", {role: "img", "aria-label": summary});
        frame.append(words, canvas);
        if (this.runs.length === 1) frame.classList.add("alone");
        if (column.smooth) frame.append(element("p", {className: "faint"}, tr("mean of a period; the faint line has all rows")));
        this.place.append(frame);
        const plot = new uPlot(this.optionsOf(column, canvas), this.dataOf(name), canvas);
        this.plots.set(name, plot);
        this.titles.set(name, title);
        this.scrubIn(plot);
        remove.addEventListener("click", () => {
            this.removed.add(name);
            plot.destroy();
            frame.remove();
            this.plots.delete(name);
            this.fillChooser();
        });
        if (this.range) plot.setScale("x", this.range);
        this.resize(); // one more chart may leave the others less room
    }

    // Words for readers who cannot see the chart.
    summaryOf(column) {
        const several = this.runs.length > 1;
        const ofRuns = this.runs.map((run) => (several ? `${run.name}: ` : "") + this.summaryOfRun(column, run));
        return tr("{1} against time: {2}.", titleOf(column, this.unitOf(column.name)), ofRuns.join("; "));
    }

    summaryOfRun(column, run) {
        const values = (this.valuesOf(column.name, run) ?? []).filter((value) => value !== null);
        if (!values.length) return tr("no value");
        let low = values[0], high = values[0];
        for (const value of values) {
            low = Math.min(low, value);
            high = Math.max(high, value);
        }
        return tr("at first {1}, at the end {2}, between {3} and {4}",
                  ...[values[0], values[values.length - 1], low, high].map((value) => numberText(value / this.unitOf(column.name).size)));
    }

    // Open axes as in films and in print: a line to the left and one below, and faint lines at the ticks.
    optionsOf(column, canvas) {
        const ink = () => colourOf("--ink"), line = () => colourOf("--line"), axisLine = () => colourOf("--faint");
        const axis = {stroke: ink, border: {show: true, stroke: axisLine, width: 1}, ticks: {stroke: axisLine, width: 1, size: 5}};
        const inUnit = (number) => number / this.unitOf(column.name).size;
        const value = (plot, number) => (number === null || number === undefined ? "–" : numberText(inUnit(number)));
        const time = (plot, number) => (number === null || number === undefined ? "–" : numberText(number));
        const timeName = `${tr("time")} (s)`;
        return {
            width: canvas.clientWidth || 300,
            height: chartHeight,
            cursor: {sync: {key: "run"}, drag: {x: false, y: false, setScale: false}},
            scales: {x: {time: false}},
            axes: [
                {...axis, grid: {show: false}, size: 40, label: timeName, labelSize: 18, values: (plot, ticks) => tickTexts(ticks)},
                {...axis, grid: {stroke: line, width: 1}, size: 62, values: (plot, ticks) => tickTexts(ticks.map(inUnit))},
            ],
            series: [{label: timeName, value: time}, ...this.runs.flatMap((run, k) => this.linesOf(column, run, k, value))],
            hooks: {draw: [(plot) => this.drawNow(plot)]},
        };
    }

    linesOf(column, {name}, k, value) {
        const main = {label: name || tr("value"), value, ...styleOfRun(k, this.runs.length)};
        if (!column.smooth) return [main];
        return [{...main, class: "rows", dash: [], width: 1, alpha: 0.3}, main];
    }

    // A line at the moment that film and bed show.
    drawNow(plot) {
        const x = plot.valToPos(this.runTime.now, "x", true);
        const {left, top, width, height} = plot.bbox;
        if (x < left || x > left + width) return;
        plot.ctx.save();
        plot.ctx.strokeStyle = colourOf("--now");
        plot.ctx.lineWidth = 2 * devicePixelRatio;
        plot.ctx.setLineDash([]);
        plot.ctx.beginPath();
        plot.ctx.moveTo(x, top);
        plot.ctx.lineTo(x, top + height);
        plot.ctx.stroke();
        plot.ctx.restore();
    }

    scrubIn(plot) {
        const over = plot.over;
        const move = (event) => {
            const x = event.clientX - over.getBoundingClientRect().left;
            this.runTime.set(plot.posToVal(x, "x"), "chart");
        };
        over.addEventListener("pointerdown", (event) => {
            over.setPointerCapture(event.pointerId);
            move(event);
        });
        over.addEventListener("pointermove", (event) => {
            if (over.hasPointerCapture(event.pointerId)) move(event);
        });
        over.addEventListener(
            "wheel",
            (event) => {
                if (!event.ctrlKey && !event.shiftKey) return; // then the page scrolls
                event.preventDefault();
                const x = event.clientX - over.getBoundingClientRect().left;
                this.zoom((event.deltaY || event.deltaX) > 0 ? 1.25 : 0.8, plot.posToVal(x, "x"));
            },
            {passive: false},
        );
    }

    /** Makes the shown range of time longer by a factor; the time `about` keeps its place. */
    zoom(factor, about) {
        const {begin, end} = this.runTime;
        const {min, max} = this.range ?? {min: begin, max: end};
        const length = Math.min(end - begin, (max - min) * factor);
        const share = Math.min(1, Math.max(0, (about - min) / (max - min)));
        const from = Math.min(end - length, Math.max(begin, about - share * length));
        this.setRange(length >= end - begin ? null : {min: from, max: from + length});
    }

    setRange(range) {
        this.range = range;
        for (const plot of this.plots.values())
            plot.setScale("x", range ?? {min: this.runTime.begin, max: this.runTime.end});
    }

    redraw() {
        for (const plot of this.plots.values()) plot.redraw(false);
    }

    resize() {
        for (const plot of this.plots.values()) {
            const width = plot.root.parentElement.clientWidth;
            if (width > 0 && width !== plot.width) plot.setSize({width, height: chartHeight});
        }
    }
}

// Lines of several runs differ in colour and in dashes.
function styleOfRun(k, runs) {
    const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 2], [1, 5]];
    const stroke = () => colourOf(runs > 1 ? `--run-${k % dashes.length}` : "--accent");
    return {stroke, dash: runs > 1 ? dashes[k % dashes.length] : [], width: 1.5, points: {show: false}};
}

function titleOf(column, unit) {
    return unit.name ? `${column.label} (${unit.name})` : column.label;
}

/** Ticks with as many decimals as their distance needs. */
function tickTexts(ticks) {
    const distance = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : 1;
    let decimals = 0;
    while (decimals < 9 && Math.abs(distance * 10 ** decimals - Math.round(distance * 10 ** decimals)) > 1e-6 * distance * 10 ** decimals) ++decimals;
    const largest = Math.max(...ticks.map(Math.abs));
    if (decimals > 4 || largest >= 1e5) return ticks.map(numberText);
    return ticks.map((tick) => withMinus((Math.abs(tick) < 1e-6 * distance ? 0 : tick).toFixed(decimals)));
}

/** The mean of each row and of those less than a period before it; null before a period has passed, as in films. */
function meansOf(values, cycles) {
    if (!cycles) return values;
    const hair = 1e-3; // of a period: rows are at whole time steps
    let first = 0;
    return values.map((_, row) => {
        while (cycles[first] <= cycles[row] - 1 + hair) ++first;
        if (cycles[row] < 1 - hair) return null;
        const known = values.slice(first, row + 1).filter((value) => value !== null);
        return known.length ? known.reduce((a, b) => a + b, 0) / known.length : null;
    });
}

/** Reads measures.csv column by column, the time first; empty cells become null. facts: about the columns. */
function readTable(text, facts) {
    const lines = text.trimEnd().split("\n");
    const names = lines[0].split(",");
    const known = new Map(facts.map((column) => [column.name, column]));
    const time = names.indexOf("time_s");
    const order = [time, ...names.keys()].filter((index, at) => at === 0 || index !== time);
    const values = order.map(() => []);
    for (const line of lines.slice(1)) {
        const cells = line.split(",");
        order.forEach((index, at) => {
            const number = Number(cells[index]);
            values[at].push(cells[index] !== "" && Number.isFinite(number) ? number : null);
        });
    }
    const columns = order.map((index) => known.get(names[index]) ?? {name: names[index], label: names[index], unit: ""});
    return {columns, values};
}
