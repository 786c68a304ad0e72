// Shows fields of the run as a map in the plane of the film, and as a profile, at the record of the page's time.
//
// The bytes are, for Ny cells across and Nz in height (y fastest), Q quantities and R records: Ny Nz bytes, the share of
// each cell that is inside the container, 255 for all of it; then for each record and quantity Ny Nz bytes: 0 to 254 from
// the quantity's lowest value to its highest, 255 where there is none. page_measures.cpp writes them.
class FieldsPanel {
    /** facts: {y, z: {low, cell, count}, records: [[begin, end]], quantities: [{name, label, unit, low, high}], ramps}. */
    constructor(facts, bytes, runTime, n = "") {
        Object.assign(this, {facts, bytes, runTime, n});
        this.cells = facts.y.count * facts.z.count;
        const expected = this.cells * (1 + facts.records.length * facts.quantities.length);
        if (bytes.length !== expected) throw new Error(`there are ${bytes.length} bytes of them in place of ${expected}`);
        this.map = this.part("field-map");
        this.line = this.part("field-line");
        this.quantity = 0;
        const select = this.part("field");
        facts.quantities.forEach((one, index) => select.append(element("option", {value: index}, one.label)));
        select.addEventListener("change", () => {
            this.quantity = Number(select.value);
            this.show();
        });
        this.part("field-profile").addEventListener("change", () => this.show());
        this.map.addEventListener("pointermove", (event) => this.tellCell(event));
        this.map.addEventListener("pointerleave", () => this.tell());
        runTime.listen((time) => this.showTime(time));
        new ResizeObserver(() => this.show()).observe(this.map.parentElement);
        for (const query of ["(prefers-color-scheme: dark)", "print"])
            matchMedia(query).addEventListener("change", () => this.show());
        addEventListener("beforeprint", () => this.show());
        this.showTime(runTime.now);
    }

    part(name) {
        return document.getElementById(name + this.n);
    }

    // The record whose middle is nearest to the time.
    showTime(time) {
        const record = nearestIndex(this.facts.records.map(([begin, end]) => (begin + end) / 2), time);
        if (record === this.record) return;
        this.record = record;
        this.show();
    }

    /** The value of a quantity in a cell; null when there is none. */
    value(cell, quantity = this.quantity) {
        const byte = this.byteOf(cell, quantity), {low, high} = this.facts.quantities[quantity];
        return byte === 255 ? null : low + (byte / 254) * (high - low);
    }

    byteOf(cell, quantity) {
        return this.bytes[this.cells * (1 + this.record * this.facts.quantities.length + quantity) + cell];
    }

    show() {
        this.drawMap();
        this.drawProfile();
        this.tell();
    }

    about() {
        return this.facts.quantities[this.quantity];
    }

    // Velocities may have both signs; then the middle of the diverging ramp stands for zero.
    isSigned() {
        const {low, high} = this.about();
        return low < 0 && high > 0;
    }

    rampNow() {
        return this.facts.ramps[this.isSigned() ? "diverging" : "sequential"];
    }

    ends() {
        const {low, high} = this.about(), most = Math.max(-low, high);
        return this.isSigned() ? [-most, most] : [low, high];
    }

    drawMap() {
        const {y, z} = this.facts, canvas = this.map, ramp = this.rampNow().map(bytesOfColour), [low, high] = this.ends();
        canvas.width = y.count;
        canvas.height = z.count;
        canvas.style.aspectRatio = `${y.count * y.cell} / ${z.count * z.cell}`;
        const context = canvas.getContext("2d"), picture = context.createImageData(y.count, z.count);
        for (let row = 0; row < z.count; ++row)
            for (let column = 0; column < y.count; ++column) {
                const cell = (z.count - 1 - row) * y.count + column, value = this.value(cell);
                if (value === null || !this.bytes[cell]) continue;
                const share = high > low ? (value - low) / (high - low) : 0;
                const colour = ramp[Math.round(share * (ramp.length - 1))];
                picture.data.set([...colour, 255], 4 * (row * y.count + column));
            }
        context.putImageData(picture, 0, 0);
        this.part("field-bar").style.background = `linear-gradient(to right, ${this.rampNow().join(",")})`;
        this.part("field-low").textContent = `${numberText(low)} ${this.about().unit}`;
        this.part("field-high").textContent = `${numberText(high)} ${this.about().unit}`;
    }

    /**
     * The profile along "y" or "z": [[place in m, value or null]]. A value is the mean over the other direction, weighted
     * by the cells' shares inside the container.
     */
    profile(along) {
        const {y, z} = this.facts, axis = this.facts[along], points = [];
        for (let k = 0; k < axis.count; ++k) {
            let sum = 0, room = 0;
            for (let other = 0; other < (along === "z" ? y : z).count; ++other) {
                const cell = along === "z" ? k * y.count + other : other * y.count + k, value = this.value(cell);
                if (value === null) continue;
                sum += value * this.bytes[cell];
                room += this.bytes[cell];
            }
            points.push([axis.low + (k + 0.5) * axis.cell, room > 0 ? sum / room : null]);
        }
        return points;
    }

    // Draws the profile, with height upwards or the place across to the right. All records have the same scale, so that
    // they can be compared.
    drawProfile() {
        const canvas = this.line, scale = Math.min(2, devicePixelRatio || 1);
        const width = canvas.clientWidth || 300, height = canvas.clientHeight || 220;
        canvas.width = width * scale;
        canvas.height = height * scale;
        const context = canvas.getContext("2d");
        context.scale(scale, scale);
        const upright = this.part("field-profile").value === "z", points = this.profile(upright ? "z" : "y");
        const [low, high] = this.ends(), span = high - low || 1;
        const first = points[0][0], last = points[points.length - 1][0], room = {left: 56, right: 12, top: 10, bottom: 40};
        const across = (share) => room.left + share * (width - room.left - room.right);
        const up = (share) => height - room.bottom - share * (height - room.top - room.bottom);
        const placeShare = (place) => (place - first) / (last - first || 1), valueShare = (value) => (value - low) / span;
        context.font = "12px system-ui, sans-serif";
        context.fillStyle = context.strokeStyle = colourOf("--ink");
        context.strokeRect(room.left, room.top, width - room.left - room.right, height - room.top - room.bottom);
        const inMm = (place) => numberText(1000 * Number(place.toPrecision(3)));
        const texts = upright ? [[numberText(low), numberText(high)], [inMm(first), inMm(last)], `${this.about().unit || "share"}`, "mm"]
                              : [[inMm(first), inMm(last)], [numberText(low), numberText(high)], `${tr("across")}, mm`, this.about().unit];
        context.textAlign = "left";
        context.fillText(texts[0][0], room.left, height - 24);
        context.textAlign = "right";
        context.fillText(texts[0][1], width - room.right, height - 24);
        context.fillText(texts[1][0], room.left - 4, up(0));
        context.fillText(texts[1][1], room.left - 4, up(1) + 10);
        context.fillText(texts[3], room.left - 4, up(0.5));
        context.textAlign = "center";
        context.fillText(texts[2], across(0.5), height - 8);
        context.strokeStyle = colourOf("--accent");
        context.lineWidth = 2;
        context.beginPath();
        let drawing = false;
        for (const [place, value] of points) {
            if (value === null) {
                drawing = false;
                continue;
            }
            const [x, y] = upright ? [across(valueShare(value)), up(placeShare(place))]
                                   : [across(placeShare(place)), up(valueShare(value))];
            drawing ? context.lineTo(x, y) : context.moveTo(x, y);
            drawing = true;
        }
        context.stroke();
    }

    tell(more = "") {
        const [begin, end] = this.facts.records[this.record], {label, unit} = this.about();
        const text = tr("{1}, mean from {2} to {3} s of the run.", label, numberText(begin), numberText(end));
        this.part("field-says").textContent = text + more;
        const values = this.profile("z").filter(([, value]) => value !== null);
        const part = (at) => (values.length ? `${numberText(values[at][1])} ${unit}` : "none");
        this.map.setAttribute("aria-label", tr("Map: {1}", text));
        this.line.setAttribute("aria-label", tr("Profile: {1} At the bottom {2}, at the top {3}.", text, part(0), part(values.length - 1)));
    }

    tellCell(event) {
        const {y, z} = this.facts, box = this.map.getBoundingClientRect();
        const column = Math.floor(((event.clientX - box.left) / box.width) * y.count);
        const row = z.count - 1 - Math.floor(((event.clientY - box.top) / box.height) * z.count);
        if (column < 0 || row < 0 || column >= y.count || row >= z.count) return;
        const value = this.value(row * y.count + column), place = [y.low + (column + 0.5) * y.cell, z.low + (row + 0.5) * z.cell];
        const at = place.map((length) => (1000 * length).toFixed(1)).join(", ");
        this.tell(` At (${at}) mm: ${value === null ? "none" : `${numberText(value)} ${this.about().unit}`}.`);
    }
}
