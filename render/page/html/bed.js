// The bed beside its controls: what colours mean, who is shown, a slice, and the grain that was chosen.
const asInFilm = 6; // number of the film's own colouring; findColourings() has the other numbers, shaders.js uses all

class BedPanel {
    /**
     * n: ending of the ids of its elements, when the page has several beds. forceBytes: bytes of the forces at key
     * moments; meshBytes: bytes of the meshes of walls; null without any.
     */
    constructor(facts, bytes, runTime, n = "", forceBytes = null, meshBytes = null) {
        this.n = n;
        this.frames = new PageBed(facts, bytes);
        this.facts = facts;
        this.runTime = runTime;
        this.forces = facts.forces && forceBytes ? new PairForces(facts.forces, forceBytes, facts.grains) : null;
        this.others = []; // beds beside this one
        this.canvas = this.part("bed");
        const camera = new Camera(facts.view, facts.box);
        this.viewer = new Viewer(this.canvas, this.frames, new Walls(facts.slabs, facts.box), camera);
        if (meshBytes) this.viewer.setMeshes(facts.meshes, meshBytes);
        this.shown = facts.species.map((species) => (species.hidden ? 0 : species.ghost ? 128 : 255));
        this.fillColours();
        this.fillSpecies();
        this.bindForces();
        this.bindSlice();
        this.bindChoice();
        new Handling(this);
        this.canvas.hidden = this.part("bed-controls").hidden = false;
        this.showTime(runTime.now);
        runTime.listen((time) => this.showTime(time));
        new ResizeObserver(() => this.viewer.change()).observe(this.canvas);
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.viewer.draw());
        this.printed = element("canvas", {className: "bed-print"});
        this.printed.setAttribute("aria-hidden", "true");
        this.canvas.after(this.printed);
        matchMedia("print").addEventListener("change", () => this.drawForPrint());
        addEventListener("beforeprint", () => this.drawForPrint());
    }

    // Printers may see what WebGL has drawn as black, so they get a copy.
    drawForPrint() {
        if (this.canvas.clientWidth === 0) return;
        this.viewer.draw();
        const {width, height} = this.canvas;
        Object.assign(this.printed, {width, height});
        this.printed.getContext("2d").drawImage(this.canvas, 0, 0);
    }

    part(name) {
        return document.getElementById(name + this.n);
    }

    /** Takes other moments of the same run. */
    take(facts, bytes) {
        const chosen = this.viewer.chosen >= 0 ? this.frames.ids[this.viewer.chosen] : -1;
        this.frames = new PageBed(facts, bytes);
        this.facts = facts;
        this.viewer.take(this.frames, new Walls(facts.slabs, facts.box));
        this.viewer.chosen = this.frames.ids.indexOf(chosen);
        this.findColourings();
        this.colour(this.coloured);
        this.showTime(this.runTime.now);
    }

    showTime(time) {
        const last = this.frames.times.length - 1;
        this.viewer.frame = this.runTime.isLive ? last : this.frames.indexAt(time);
        const shown = this.frames.times[this.viewer.frame];
        const number = [this.viewer.frame + 1, last + 1, shown.toFixed(3), time.toFixed(3)];
        this.part("bed-says").textContent =
            this.runTime.isLive ? tr("The newest moment, {1} s of the run.", number[2])
            : number[2] === number[3] ? tr("Moment {1} of {2}, {3} s of the run.", ...number)
            : tr("Moment {1} of {2}, {3} s of the run, the nearest that was kept to {4} s.", ...number);
        this.tellChosen();
        this.showForces();
        this.viewer.change();
    }

    // ---- Forces: at key moments ----

    bindForces() {
        this.chains = this.part("chains");
        if (!this.forces) return;
        this.part("forces").hidden = this.part("forces-say").hidden = false;
        this.chains.addEventListener("change", () => {
            if (this.chains.checked && !this.forces.at.has(this.viewer.frame)) this.goToForces(this.nearestKey());
            this.showForces();
            this.viewer.change();
        });
        for (const [name, by] of [["back", -1], ["on", 1]])
            this.part(`forces-${name}`).addEventListener("click", () => this.goToForces(this.forces.next(this.viewer.frame, by)));
    }

    nearestKey() {
        const {times} = this.frames, moments = this.forces.moments;
        return moments[nearestIndex(moments.map((moment) => times[moment]), times[this.viewer.frame])];
    }

    goToForces(moment) {
        if (moment !== null) this.runTime.set(this.frames.times[moment], "forces");
    }

    // The width of a band is proportional to its force, up to 0.6 times the smallest radius for the strongest 2 %.
    showForces() {
        const {forces, viewer, frames} = this;
        if (!forces) return;
        const sums = forces.sums(viewer.frame), [low, high] = forces.range;
        const byte = (sum) => (sum > low ? Math.min(255, Math.round((255 * Math.log(sum / low)) / Math.log(high / low))) : 0);
        viewer.setPressed(sums && Uint8Array.from(sums, byte));
        const mostChains = 4500; // so that a moment sends at most 0.2 MB to the graphics card
        const [x, y, z, distance] = viewer.slice;
        const shows = (grain) => {
            const [px, py, pz] = frames.place(viewer.frame, grain);
            return this.shown[frames.species[grain]] > 0 && px * x + py * y + pz * z <= distance;
        };
        const chains = this.chains.checked ? chainsOf(forces, frames, viewer.frame, shows, mostChains) : [];
        const strong = chains.length ? chains[Math.floor(0.98 * (chains.length - 1))][2] : 1;
        const widest = 0.6 * frames.radii.reduce((a, b) => Math.min(a, b));
        viewer.chains = chains.map(([from, to, force]) => [from, to, widest * Math.min(1, force / strong)]);
        this.sayForces(sums, strong);
    }

    sayForces(known, strong) {
        const {forces, frames} = this;
        const words = !known
            ? tr("Forces between grains are known at {1} moments of the page, the nearest at {2} s. At this one they are not.",
                 forces.moments.length, frames.times[this.nearestKey()].toFixed(3))
            : this.viewer.chains.length
              ? tr("Bands join grains that push each other. The widest stand for {1} N and more.", numberText(strong))
              : tr("The forces of this moment are known.");
        this.part("forces-say").textContent = words;
    }

    /** Call it when the camera has moved: beds beside this one get the same direction and enlargement. */
    turned() {
        const {azimuth, elevation, distance, fitted} = this.viewer.camera;
        this.viewer.change();
        for (const other of this.others) {
            Object.assign(other.viewer.camera, {azimuth, elevation});
            other.viewer.camera.fit();
            other.viewer.camera.zoom(fitted / distance);
            other.viewer.change();
        }
    }

    // ---- Colours ----

    fillColours() {
        const select = this.part("colour-by");
        this.findColourings();
        for (const one of this.colourings) select.append(element("option", {value: one.by}, one.name));
        select.addEventListener("change", () => {
            for (const panel of [this, ...this.others]) panel.colourAs(Number(select.value));
        });
        this.colourAs(this.facts.film ? asInFilm : 0);
    }

    // Finds the colourings of the bed, with the ranges that the moments need. `by` is the number of the colouring in
    // colourFor() of shaders.js.
    findColourings() {
        const facts = this.facts;
        const heights = this.viewer.startHeights();
        const lowest = heights.reduce((a, b) => Math.min(a, b)), highest = heights.reduce((a, b) => Math.max(a, b));
        const rise = this.largestRise();
        const speeds = this.usualSpeeds();
        this.colourings = [
            {name: tr("species"), by: 0},
            {name: tr("speed (logarithmic)"), by: 1, range: speeds.shares, ends: speeds.ends, unit: "m/s", ramp: "sequential"},
            {name: tr("height at start"), by: 2, range: [lowest, highest], unit: "m", ramp: "sequential"},
            {name: tr("rise since the moment before"), by: 3, range: [-rise, rise], unit: "m", ramp: "diverging"},
        ];
        if (facts.contacts)
            this.colourings.push({name: tr("contact number"), by: 4, range: [0, 8], unit: "", ramp: "sequential"});
        if (this.forces)
            this.colourings.push({name: tr("force (logarithmic)"), by: 5, range: [0, 1], ends: this.forces.range, unit: "N", ramp: "sequential"});
        const {film} = facts;
        if (film)
            this.colourings.push({name: tr(film.logarithmic ? "as in the film: {1}, logarithmic" : "as in the film: {1}", film.title), by: asInFilm, range: [0, 1], ends: [film.low, film.high], unit: film.unit});
    }

    /** Beds of about one size are seen from one distance, so that a length is as long in each of them. */
    static shareScale(panels) {
        const mostUnlike = 3; // as in films side by side
        const boxes = panels.map((panel) => panel.facts.box), ends = (of, key) => [0, 1, 2].map((k) => of(...boxes.map((box) => box[key][k])));
        const sizes = boxes.map(({low, high}) => Math.hypot(...low.map((from, k) => high[k] - from)));
        if (Math.max(...sizes) > mostUnlike * Math.min(...sizes)) return;
        for (const {viewer} of panels) {
            viewer.camera.box = {low: ends(Math.min, "low"), high: ends(Math.max, "high")};
            viewer.camera.reset();
            viewer.change();
        }
    }

    /** Gives all beds the same colourings, each on a scale that suits all of them. */
    static shareColourings(panels) {
        const common = [];
        for (const one of panels.flatMap((panel) => panel.colourings))
            if (!common.some((other) => other.by === one.by)) common.push({...one, low: Infinity, high: -Infinity});
        const endsOf = (one) => one.ends ?? one.range ?? [0, 0];
        for (const {colourings} of panels)
            for (const one of colourings) {
                const into = common.find((other) => other.by === one.by);
                if (!into) continue;
                into.low = Math.min(into.low, endsOf(one)[0]);
                into.high = Math.max(into.high, endsOf(one)[1]);
            }
        for (const panel of panels) {
            const {lowest, highest} = panel.frames.speed;
            const share = (speed) => Math.log(speed / lowest) / Math.log(highest / lowest);
            const forces = panel.colourings.find((one) => one.by === 5), shared = common.find((one) => one.by === 5);
            if (forces && shared) panel.forces.range = forces.ends = [shared.low, shared.high];
            for (const one of panel.colourings) {
                if (one.by === 5 || one.by === asInFilm) continue;
                const from = common.find((other) => other.by === one.by);
                if (!from || !one.range) continue;
                if (one.ends) one.ends = [from.low, from.high];
                one.range = one.ends ? one.ends.map(share) : [from.low, from.high];
            }
            panel.colour(panel.coloured);
            panel.showForces();
        }
    }

    // The range of speeds in which nearly all grains are: as shares of the logarithmic scale, and in m/s.
    usualSpeeds() {
        const {packed, speed} = this.frames, bytes = [];
        const stride = 4 * Math.max(1, Math.floor(packed.length / 4 / 20000));
        for (let at = 3; at < packed.length; at += stride)
            if ((packed[at] & 0xff) !== 255) bytes.push(Math.max(1, packed[at] & 0xff));
        if (bytes.length === 0) bytes.push(1);
        bytes.sort((a, b) => a - b);
        const at = (share) => (bytes[Math.floor(share * (bytes.length - 1))] - 1) / 253;
        const low = at(0.02), high = Math.max(low + 0.05, at(0.995));
        const speedOf = (share) => speed.lowest * Math.pow(speed.highest / speed.lowest, share);
        return {shares: [low, high], ends: [speedOf(low), speedOf(high)]};
    }

    // The rise in m between two moments that nine in ten grains do not exceed. With the largest rise as the end of the
    // scale, a few flying grains would make all others grey.
    largestRise() {
        const frames = this.frames, rises = [];
        const stride = Math.max(1, Math.floor((frames.grains * frames.times.length) / 20000));
        for (let at = 0; at < frames.grains * (frames.times.length - 1); at += stride) {
            const frame = 1 + Math.floor(at / frames.grains), grain = at % frames.grains;
            if (frames.isPresent(frame, grain) && frames.isPresent(frame - 1, grain))
                rises.push(Math.abs(frames.place(frame, grain)[2] - frames.place(frame - 1, grain)[2]));
        }
        rises.sort((a, b) => a - b);
        return rises[Math.floor(0.9 * rises.length)] || 1e-6;
    }

    // Colours by the same quantity as another run, if this run has it too.
    colourAs(by) {
        if (!this.colourings.some((one) => one.by === by)) return;
        this.part("colour-by").value = by;
        this.colour(by);
    }

    colour(by) {
        this.coloured = by;
        const one = this.colourings.find((other) => other.by === by), legend = this.part("legend");
        this.viewer.colourBy = one.by;
        this.viewer.range = one.range ?? [0, 1];
        legend.hidden = one.by === 0;
        if (one.by > 0) {
            const ramp = by === asInFilm ? this.facts.film.colours : this.facts.ramps[one.ramp];
            const banded = by === asInFilm && this.facts.film.bands > 0;
            this.viewer.setRamp(new Uint8Array(ramp.flatMap((colour) => [...bytesOfColour(colour), 255])), banded);
            const [low, high] = one.ends ?? one.range;
            this.part("legend-low").textContent = `${numberText(low)} ${one.unit}`;
            this.part("legend-high").textContent = `${numberText(high)} ${one.unit}`;
            const stops = ramp.map((colour, k) =>
                banded ? `${colour} ${(100 * k) / ramp.length}% ${(100 * (k + 1)) / ramp.length}%` : colour);
            this.part("legend-bar").style.background = `linear-gradient(to right, ${stops.join(",")})`;
        }
        this.viewer.change();
    }

    // ---- Who is shown ----

    fillSpecies() {
        const list = this.part("species");
        this.facts.species.forEach((species, index) => {
            const select = element("select", {id: `species${this.n}-${index}`});
            for (const [value, words] of [[255, tr("shown")], [128, tr("ghost")], [0, tr("hidden")]])
                select.append(element("option", {value, selected: this.shown[index] === value}, words));
            select.addEventListener("change", () => {
                this.shown[index] = Number(select.value);
                this.updateSpecies();
            });
            const mark = element("span", {className: "swatch"});
            mark.style.background = species.colour;
            list.append(element("label", {for: select.id}, mark, species.name, " ", select));
        });
        this.updateSpecies();
    }

    updateSpecies() {
        const colours = this.facts.species.flatMap((species, index) => [...bytesOfColour(species.colour), this.shown[index]]);
        this.viewer.setSpecies(new Uint8Array(colours));
        if (this.chains) this.showForces();
        this.viewer.change();
    }

    // ---- A slice: what lies before a plane is taken away ----

    bindSlice() {
        const select = this.part("slice"), slider = this.part("slice-at");
        const update = () => {
            const axis = ["x", "y", "z"].indexOf(select.value);
            slider.disabled = axis < 0;
            const normal = [0, 0, 0];
            let distance = 1; // with a zero normal nothing is cut off: 0 > 1 is false everywhere
            if (axis >= 0) {
                const share = Number(slider.value) / 1000, {low, high} = this.facts.box;
                normal[axis] = 1;
                distance = low[axis] + share * (high[axis] - low[axis]);
                slider.setAttribute("aria-valuetext", `${numberText(1000 * distance)} mm`);
            }
            this.viewer.slice = [...normal, distance];
            this.showForces();
            this.viewer.change();
        };
        select.addEventListener("change", update);
        slider.addEventListener("input", update);
        update();
    }

    // ---- The chosen grain ----

    bindChoice() {
        this.input = this.part("grain-id");
        this.part("choose").addEventListener("submit", (event) => {
            event.preventDefault();
            this.choose(this.frames.ids.indexOf(Number(this.input.value)));
        });
        this.follow = this.part("follow");
        this.follow.addEventListener("change", () => this.showTime(this.runTime.now));
        this.part("reset-view").addEventListener("click", () => {
            this.follow.checked = false;
            this.viewer.camera.reset();
            this.turned();
        });
    }

    /** Chooses a grain by its index; -1 chooses none. */
    choose(grain) {
        this.viewer.chosen = grain;
        if (grain >= 0) this.input.value = this.frames.ids[grain];
        this.tellChosen();
        this.viewer.change();
    }

    tellChosen() {
        const words = this.part("grain-says"), {viewer, frames} = this;
        const grain = viewer.chosen, frame = viewer.frame;
        viewer.path = [];
        if (grain < 0) {
            words.textContent = tr("No grain is chosen: click one, or give its id.");
            return;
        }
        const name = tr("Grain {1}, {2}", frames.ids[grain], this.facts.species[frames.species[grain]].name);
        if (!frames.isPresent(frame, grain)) {
            words.textContent = tr("{1}: not in the container at this moment.", name);
            return;
        }
        viewer.path = frames.pathUntil(frame, grain);
        const place = frames.place(frame, grain);
        const inMm = place.map((value) => (1000 * value).toFixed(2)).join(", ");
        const speed = frames.speedAt(frame, grain);
        const parts = [
            tr("diameter {1} mm", numberText(2000 * frames.radii[grain])),
            tr("at ({1}) mm", inMm),
            speed === null
                ? tr("its speed is not known")
                : speed > 0
                  ? tr("speed {1} m/s", speed.toPrecision(2))
                  : tr("speed below {1} m/s", numberText(this.facts.speed.lowest)),
        ];
        const contacts = this.facts.contacts ? frames.contactsAt(frame, grain) : null;
        if (contacts !== null) parts.push(tr("{1} contacts", contacts));
        parts.push(tr("way so far at least {1} mm", numberText(1000 * lengthOf(viewer.path))));
        words.textContent = `${name}: ${parts.join(", ")}. ${this.neighbours(frame, grain)}`;
        if (this.follow.checked) viewer.camera.target = place;
    }

    // Says which grains push this one at a key moment; at other moments, which grains are near.
    neighbours(frame, grain) {
        const mostNamed = 12, pushes = this.forces?.of(frame, grain);
        const listed = (list) => {
            if (!list.length) return tr("nobody");
            const first = list.slice(0, mostNamed).join(", ");
            return list.length > mostNamed ? tr("{1} and others", first) : first;
        };
        if (!pushes)
            return tr("Near neighbours: {1}.", listed(this.frames.nearNeighbours(frame, grain).map((other) => this.frames.ids[other])));
        const named = pushes.map(({other, force}) =>
            tr("{1} with {2} N", other === null ? tr("a wall") : this.frames.ids[other], force.toPrecision(2)));
        return tr("Pushed by: {1}.", listed(named));
    }
}

/** The length of a path's straight pieces in m. It is a lower bound of the grain's way between these places. */
function lengthOf(path) {
    let length = 0;
    for (let k = 1; k < path.length; ++k)
        if (path[k - 1] && path[k])
            length += Math.hypot(...path[k].map((value, axis) => value - path[k - 1][axis]));
    return length;
}

/** Turns and zooms the view and chooses grains, by mouse, finger and keys. */
class Handling {
    constructor(panel) {
        this.panel = panel;
        this.viewer = panel.viewer;
        this.pointers = new Map();
        this.moved = 0;
        const canvas = panel.canvas;
        canvas.addEventListener("pointerdown", (event) => this.down(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => this.up(event));
        canvas.addEventListener("contextmenu", (event) => event.preventDefault());
        canvas.addEventListener("keydown", (event) => this.key(event));
        canvas.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
    }

    down(event) {
        this.panel.canvas.focus({preventScroll: true});
        this.panel.canvas.setPointerCapture(event.pointerId);
        if (!this.pointers.size) this.moved = 0;
        this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    }

    move(event) {
        const pointer = this.pointers.get(event.pointerId);
        if (!pointer) return;
        const dx = event.clientX - pointer.x, dy = event.clientY - pointer.y;
        const height = this.panel.canvas.clientHeight, camera = this.viewer.camera;
        this.moved += Math.abs(dx) + Math.abs(dy);
        if (this.pointers.size === 2) {
            const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
            const before = Math.hypot(pointer.x - other.x, pointer.y - other.y);
            const now = Math.hypot(event.clientX - other.x, event.clientY - other.y);
            if (before > 0 && now > 0) camera.zoom(now / before);
            camera.pan(dx / height / 2, -dy / height / 2);
        } else if (event.shiftKey || event.buttons & 6) {
            camera.pan(dx / height, -dy / height);
        } else {
            camera.orbit((180 * dx) / height, (180 * dy) / height);
        }
        pointer.x = event.clientX;
        pointer.y = event.clientY;
        this.panel.turned();
    }

    up(event) {
        const alone = this.pointers.size === 1;
        this.pointers.delete(event.pointerId);
        const mostForClick = 5; // pixels
        if (event.type !== "pointerup" || !alone || this.moved > mostForClick || event.button !== 0) return;
        const canvas = this.panel.canvas, box = canvas.getBoundingClientRect();
        const x = event.clientX - box.left - canvas.clientLeft, y = event.clientY - box.top - canvas.clientTop;
        this.panel.choose(this.viewer.pick(x, y));
    }

    // The page scrolls unless the bed was clicked before.
    wheel(event) {
        if (document.activeElement !== this.panel.canvas) return;
        event.preventDefault();
        this.viewer.camera.zoom(Math.exp(-0.001 * event.deltaY));
        this.panel.turned();
    }

    key(event) {
        const camera = this.viewer.camera, step = 5; // degrees
        const acts = {
            ArrowLeft: () => camera.orbit(-step, 0),
            ArrowRight: () => camera.orbit(step, 0),
            ArrowUp: () => camera.orbit(0, step),
            ArrowDown: () => camera.orbit(0, -step),
            "+": () => camera.zoom(1.15),
            "-": () => camera.zoom(1 / 1.15),
            Home: () => camera.reset(),
            Escape: () => this.panel.choose(-1),
        };
        if (!acts[event.key]) return;
        event.preventDefault();
        acts[event.key]();
        this.panel.turned();
    }
}

function bytesOfColour(colour) {
    return partsOf(colour).map((part) => Math.round(255 * part));
}
