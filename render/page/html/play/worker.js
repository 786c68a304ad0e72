// Runs in a worker, behind the engine's own script: the bed packs and moves here, at the pace that the page asks for.
// Messages to it are {does, ...}, those from it {is, ...}.
const mostAtOnce = 24; // ms that the engine may take before messages are looked at
const mostOwed = 0.2; // s of the clock on the wall; what a slow machine owes beyond that is forgotten
const betweenMeasures = 100; // ms

let engine = null;
let isRunning = false, stepsLeft = null; // null: until told otherwise
let pace = 1; // simulated seconds a second
let plan = null, now = {time: 0, step: 0}, origin = null;
let wantsFrame = null, measuredAt = 0, isMeasured = false;
let sent = {step: -1, pairs: false}; // what the page has
const worked = {simulated: 0, busy: 0, since: 0, shown: 0};

function ask(name, types = [], values = []) {
    const answer = JSON.parse(engine.ccall(name, "string", types, values));
    if (answer.error !== undefined) throw new Error(answer.error);
    return answer;
}

function copyOf(Kind, address, count) {
    return new Kind(engine.HEAPU8.buffer.slice(address, address + count * Kind.BYTES_PER_ELEMENT));
}

const does = {
    async begin({wasm, request}) {
        if (!engine) {
            engine = await GrainreelEngine({wasmBinary: wasm, packing: (stage, done) => postMessage({is: "packing", stage, done})});
        }
        isRunning = false;
        plan = ask("play_begin", ["string"], [JSON.stringify(request)]);
        postMessage({is: "planned", plan});
        const packed = ask("play_pack");
        postMessage({is: "packed", packed});
        now = {time: 0, step: 0};
        sendFrame(true);
        sendMeasures();
    },
    go({on, steps = null}) {
        isRunning = on;
        stepsLeft = steps;
        origin = null;
        if (on) work();
    },
    pace(message) {
        pace = message.pace;
        origin = null;
    },
    frame({pairs}) {
        wantsFrame = {pairs};
        sendWanted();
    },
    turn({key, value}) {
        plan = ask("play_turn", ["string", "number"], [key, value]);
        postMessage({is: "turned", plan});
    },
    shake({how}) {
        ask("play_shake", ["number"], [how]);
    },
    tilt({angle}) {
        ask("play_tilt", ["number"], [angle]);
    },
    scene() {
        postMessage({is: "scene", text: ask("play_scene").text});
    },
    // For tests: so many steps without a break, and the hash of the state.
    steps({count}) {
        for (let left = count; left > 0;) {
            const {made, over} = ask("play_run", ["number", "number"], [left, 1000]);
            left -= made;
            if (over) break;
        }
        postMessage({is: "hash", ...ask("play_hash")});
    },
};

onmessage = async ({data}) => {
    try {
        await does[data.does](data);
    } catch (problem) {
        isRunning = false;
        postMessage({is: "error", text: problem.message ?? String(problem)});
    }
};

// The steps that are due by the clock on the wall.
function stepsDue() {
    const wall = performance.now();
    if (!origin) origin = {wall, time: now.time};
    const due = origin.time + ((wall - origin.wall) / 1000) * pace - now.time;
    if (due > mostOwed * pace) {
        origin = {wall: wall - 1000 * mostOwed, time: now.time};
        return Math.floor((mostOwed * pace) / plan.step);
    }
    return Math.max(0, Math.floor(due / plan.step));
}

function work() {
    if (!isRunning) return;
    try {
        const due = stepsDue(), steps = stepsLeft === null ? due : Math.min(due, stepsLeft);
        let over = false;
        if (steps > 0) {
            const begin = performance.now();
            const run = ask("play_run", ["number", "number"], [steps, mostAtOnce]);
            over = run.over;
            const busy = performance.now() - begin;
            worked.simulated += run.made * plan.step;
            worked.busy += busy;
            now = {time: now.time + run.made * plan.step, step: now.step + run.made};
            isMeasured = false;
            if (stepsLeft !== null && (stepsLeft -= run.made) <= 0) over = true;
        }
        sendWanted();
        if (performance.now() - measuredAt > betweenMeasures) sendMeasures();
        if (over) {
            isRunning = false;
            sendMeasures();
            postMessage({is: "stopped", over: stepsLeft === null});
            return;
        }
    } catch (problem) {
        isRunning = false;
        postMessage({is: "error", text: problem.message ?? String(problem)});
        return;
    }
    setTimeout(work, 0);
}

// The page waits for a picture that differs from the one that it has.
function sendWanted() {
    if (!wantsFrame || (sent.step === now.step && (sent.pairs || !wantsFrame.pairs))) return;
    const {pairs} = wantsFrame;
    wantsFrame = null;
    sendFrame(pairs);
}

function sendFrame(withPairs) {
    const frame = ask("play_frame", ["number"], [withPairs ? 1 : 0]), n = frame.grains;
    now = {time: frame.time, step: frame.step};
    sent = {step: frame.step, pairs: withPairs};
    const message = {
        is: "frame", time: frame.time, step: frame.step, cycles: frame.cycles, bodies: frame.bodies, there: frame.there,
        packed: copyOf(Uint16Array, frame.packed, 4 * n),
        radii: copyOf(Float32Array, frame.radii, n),
        species: copyOf(Uint16Array, frame.species, n),
        pairs: withPairs ? copyOf(Int32Array, frame.pairsAt, 2 * frame.pairs) : null,
        forces: withPairs ? copyOf(Float32Array, frame.forcesAt, frame.pairs) : null,
    };
    const buffers = ["packed", "radii", "species", "pairs", "forces"].filter((name) => message[name]).map((name) => message[name].buffer);
    postMessage(message, buffers);
}

function sendMeasures() {
    measuredAt = performance.now();
    if (isMeasured) return;
    isMeasured = true;
    const seconds = (measuredAt - worked.since) / 1000;
    const rates = {could: worked.busy > 0 ? (1000 * worked.simulated) / worked.busy : null, does: seconds > 0 ? worked.simulated / seconds : 0};
    postMessage({is: "measures", time: now.time, values: ask("play_measures").values, rates: isRunning ? rates : null});
    if (seconds > 1) Object.assign(worked, {simulated: 0, busy: 0, since: measuredAt});
}
