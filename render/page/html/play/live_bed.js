// The bed that moves now, in place of moments that were kept: what it was a picture ago, and what it is.

class LiveBed extends BedMoments {
    /** facts: {low, high, speed, period}. frame: the first one from the worker. */
    constructor(facts, frame) {
        super();
        const {low, high, speed, period} = facts;
        const grains = frame.radii.length;
        Object.assign(this, {low, high, speed, period, grains, film: null, filmBytes: new Uint8Array(0)});
        this.ids = Int32Array.from({length: grains}, (_, id) => id);
        this.packed = new Uint16Array(8 * grains);
        this.packed.set(frame.packed);
        this.times = [frame.time, frame.time];
        this.bodies = [frame.bodies, frame.bodies];
        this.trail = [];
        this.take(frame);
    }

    /** Takes the next picture. Gives whether grains have come, whose sizes the graphics card does not have yet. */
    take(frame) {
        const n = this.grains, came = frame.there > (this.there ?? frame.there);
        this.packed.copyWithin(0, 4 * n);
        this.packed.set(frame.packed, 4 * n);
        this.times = [this.times[1], frame.time];
        this.bodies = [this.bodies[1], frame.bodies];
        this.radii = frame.radii;
        this.species = frame.species;
        this.there = frame.there;
        return came;
    }

    /** Remembers where a grain has been, for its way. */
    remember(grain) {
        const most = 900; // places
        if (this.followed !== grain) this.trail = [];
        this.followed = grain;
        if (grain < 0 || !this.isPresent(1, grain)) return;
        const place = this.place(1, grain), before = this.trail[this.trail.length - 1];
        if (before && this.period > 0 && Math.abs(place[0] - before[0]) > this.period / 2) this.trail.push(null);
        this.trail.push(place);
        if (this.trail.length > most) this.trail.shift();
    }

    pathUntil() {
        return this.trail;
    }
}

class LiveForces extends Forces {
    constructor(grains) {
        super();
        this.grains = grains;
        this.moments = [1];
        this.at = new Map();
        this.range = [1e-9, 1];
    }

    take(frame) {
        this.at.clear();
        if (!frame.pairs) return;
        const first = new Uint32Array(frame.forces.length), second = new Uint32Array(frame.forces.length);
        for (let i = 0; i < first.length; ++i) {
            first[i] = frame.pairs[2 * i];
            second[i] = frame.pairs[2 * i + 1] < 0 ? 0xffffff : frame.pairs[2 * i + 1];
        }
        this.at.set(1, {first, second, force: frame.forces});
        const before = this.range[1];
        this.setRange();
        this.range = [this.range[1] / 300, Math.max(this.range[1], 0.9 * before)]; // colours do not flicker
        if (!(this.range[0] > 0)) this.range = [1e-9, 1];
    }
}

class LivePanel extends BedPanel {
    // Scales stay as they are while the bed moves.
    findColourings() {
        const {low, high} = this.facts.box, {lowest, highest} = this.facts.speed;
        const heights = this.viewer.startHeights();
        const from = heights.reduce((a, b) => Math.min(a, b)), to = heights.reduce((a, b) => Math.max(a, b));
        const speeds = [0.5, 1].map((share) => lowest * Math.pow(highest / lowest, share));
        this.colourings = [
            {name: tr("species"), by: 0},
            {name: tr("height at start"), by: 2, range: [from, to > from ? to : high[2] - low[2]], unit: "m", ramp: "sequential"},
            {name: tr("speed (logarithmic)"), by: 1, range: [0.5, 1], ends: speeds, unit: "m/s", ramp: "sequential"},
            {name: tr("contact number"), by: 4, range: [0, 8], unit: "", ramp: "sequential"},
            {name: tr("force (logarithmic)"), by: 5, range: [0, 1], ends: this.forces.range, unit: "N", ramp: "sequential"},
        ];
    }

    /** Whether the picture shows who pushes whom. */
    wantsPairs() {
        return this.chains.checked || this.viewer.colourBy >= 4 || this.viewer.chosen >= 0;
    }

    showFrame(frame) {
        const {frames, viewer, forces} = this;
        const came = frames.take(frame);
        if (came) viewer.take(frames, viewer.walls);
        else viewer.refresh();
        forces.take(frame);
        viewer.frame = 1;
        frames.remember(viewer.chosen);
        viewer.path = viewer.chosen >= 0 ? frames.trail : [];
        if (viewer.chosen >= 0 && this.follow.checked && frames.isPresent(1, viewer.chosen))
            viewer.camera.target = frames.place(1, viewer.chosen);
        this.showForces();
        viewer.draw();
    }

    /** Says what is known of the moment; not with every picture, since screen readers speak it. */
    showTime(time) {
        this.viewer.frame = 1;
        this.part("bed-says").textContent = tr("{1} s since the drive began.", time.toFixed(2));
        this.tellChosen();
        this.viewer.change();
    }

    sayForces(known, strong) {
        this.part("forces-say").textContent =
            this.viewer.chains.length ? tr("Bands join grains that push each other. The widest stand for {1} N and more.", numberText(strong)) : "";
    }
}
