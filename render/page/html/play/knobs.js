// The knobs of a bed: each has a slider and a number, in the unit that reads well.

class Knobs {
    /** knobs: from the page's facts. turned(knob, value in SI): a live one was turned. */
    constructor(knobs, place, placeAnew, turned) {
        this.knobs = knobs;
        this.values = new Map(knobs.map((knob) => [knob.key, knob.value]));
        this.turned = turned;
        this.waiting = new Map(); // timers of sliders that are being dragged
        this.parts = new Map();
        for (const knob of knobs) (knob.anew ? placeAnew : place).append(this.make(knob));
        this.anew = new Set();
    }

    make(knob) {
        const id = `knob-${knob.key.replace(/[^A-Za-z0-9]/g, "-")}`;
        const inUnit = (value) => value / knob.size;
        const step = knob.whole ? 1 : niceStep((inUnit(knob.high) - inUnit(knob.low)) / 100);
        const slider = element("input", {type: "range", id, min: inUnit(knob.low), max: inUnit(knob.high), step});
        const number = element("input", {type: "number", id: `${id}-number`, min: inUnit(knob.low), max: inUnit(knob.high), step: "any"});
        number.setAttribute("aria-label", `${knob.label}${knob.unit ? `, ${knob.unit}` : ""}`);
        const words = element("label", {for: id}, knob.label);
        const said = element("span", {className: "faint"}, knob.unit);
        const row = element("div", {className: "knob"}, words, slider, number, said);
        row.title = knob.key;
        this.parts.set(knob.key, {knob, slider, number});
        this.show(knob, knob.value);
        slider.addEventListener("input", () => this.set(knob, Number(slider.value) * knob.size, number));
        number.addEventListener("change", () => this.set(knob, Number(number.value) * knob.size, null));
        if (knob.presets) {
            const select = element("select", {"aria-label": tr("{1}: known values", knob.label)});
            select.append(element("option", {value: ""}, "…"));
            for (const {name, value} of knob.presets) select.append(element("option", {value}, tr(name)));
            select.addEventListener("change", () => select.value && this.set(knob, Number(select.value), null));
            row.append(select);
        }
        return row;
    }

    show(knob, value) {
        const {slider, number} = this.parts.get(knob.key);
        slider.value = value / knob.size;
        number.value = Number((value / knob.size).toPrecision(4));
        slider.setAttribute("aria-valuetext", `${numberText(value / knob.size)} ${knob.unit}`);
    }

    /** Beyond a limit the limit is taken. */
    set(knob, wanted, dragged) {
        const finite = Number.isFinite(wanted) ? wanted : knob.value;
        const within = Math.min(knob.high, Math.max(knob.low, finite));
        const value = knob.whole ? Math.round(within) : within;
        this.values.set(knob.key, value);
        this.show(knob, value);
        if (knob.anew) {
            this.anew.add(knob.key);
            return this.turned(knob, value);
        }
        clearTimeout(this.waiting.get(knob.key));
        this.waiting.set(knob.key, setTimeout(() => this.turned(knob, value), dragged ? 150 : 0));
    }

    /** The values that differ from the scene's, by key, in SI. */
    changed() {
        return Object.fromEntries(this.knobs.filter((knob) => this.values.get(knob.key) !== knob.value)
            .map((knob) => [knob.key, this.values.get(knob.key)]));
    }
}

/** 1, 2 or 5 times a power of ten, not above `most`. */
function niceStep(most) {
    const power = Math.pow(10, Math.floor(Math.log10(most)));
    return [5, 2, 1].map((digit) => digit * power).find((step) => step <= most * 1.0001) ?? power;
}
