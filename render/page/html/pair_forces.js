// Unpacks which grains push each other at key moments.
//
// The bytes are, for each key moment of P pairs: low, middle and high bytes of the first grain's place in the list of
// grains, as its difference from the pair before (P each); low, middle and high bytes of the second grain's place itself,
// or of 2^24 - 1 - face for a wall; P bytes of normal force: b from 1 on stands for lowest (highest / lowest)^((b - 1) / 253).
// PairForcesWriter (render/page/bed/page_bed.cpp) writes them.
const firstOfWalls = 0xffffff - 1000; // numbers above this one are those of walls

class PairForces {
    /** facts: {moments, pairs, lowest, highest} from the bed's facts. grains: their number. */
    constructor(facts, bytes, grains) {
        const bytesAPair = 7, all = facts.pairs.reduce((sum, pairs) => sum + pairs, 0);
        if (bytes.length !== bytesAPair * all)
            throw new Error(`there are ${bytes.length} bytes of forces in place of ${bytesAPair * all}`);
        Object.assign(this, facts);
        this.grains = grains;
        this.at = new Map(); // by moment: {first, second, force}
        let from = 0;
        facts.moments.forEach((moment, k) => {
            this.at.set(moment, this.unpack(bytes.subarray(from, (from += bytesAPair * facts.pairs[k])), facts.pairs[k]));
        });
        this.setRange();
    }

    unpack(bytes, pairs) {
        const first = new Uint32Array(pairs), second = new Uint32Array(pairs), force = new Float32Array(pairs);
        const number = (plane, i) =>
            bytes[plane * pairs + i] | (bytes[(plane + 1) * pairs + i] << 8) | (bytes[(plane + 2) * pairs + i] << 16);
        for (let i = 0, before = 0; i < pairs; ++i) {
            before = first[i] = before + number(0, i);
            second[i] = number(3, i);
            force[i] = this.ofByte(bytes[6 * pairs + i]);
        }
        return {first, second, force};
    }

    ofByte(byte) {
        return byte === 0 ? 0 : this.lowest * Math.pow(this.highest / this.lowest, (byte - 1) / 253);
    }

    /** For each grain, the sum of the normal forces on it in N; null when forces are not known at this moment. */
    sums(moment) {
        const pairs = this.at.get(moment);
        if (!pairs) return null;
        const sums = new Float32Array(this.grains);
        for (let i = 0; i < pairs.force.length; ++i) {
            sums[pairs.first[i]] += pairs.force[i];
            if (pairs.second[i] < this.grains) sums[pairs.second[i]] += pairs.force[i];
        }
        return sums;
    }

    // The range of sums, in N, in which nearly all lie.
    setRange() {
        const all = this.moments.flatMap((moment) => [...this.sums(moment)].filter((sum) => sum > 0)).sort((a, b) => a - b);
        const at = (share) => all[Math.floor(share * (all.length - 1))] ?? 1;
        this.range = [at(0.05), Math.max(1.01 * at(0.05), at(0.995))];
    }

    /** The forces on a grain, [{other, force}], the strongest first; other is null for a wall. null when not known. */
    of(moment, grain) {
        const pairs = this.at.get(moment);
        if (!pairs) return null;
        const found = [];
        for (let i = 0; i < pairs.force.length; ++i) {
            if (pairs.first[i] !== grain && pairs.second[i] !== grain) continue;
            const other = pairs.first[i] === grain ? pairs.second[i] : pairs.first[i];
            found.push({other: other > firstOfWalls ? null : other, force: pairs.force[i]});
        }
        return found.sort((a, b) => b.force - a.force);
    }

    /** The key moment before (by = -1) or after (by = 1) a moment; null when there is none. */
    next(moment, by) {
        const those = this.moments.filter((one) => (by < 0 ? one < moment : one > moment));
        return those.length ? (by < 0 ? those[those.length - 1] : those[0]) : null;
    }
}

/**
 * The chains that the viewer draws, by rising force: [from, to, force] for the strongest `most` pairs of grains; places
 * are in m. shows(grain): whether the grain is visible.
 */
function chainsOf(forces, frames, moment, shows, most) {
    const pairs = forces.at.get(moment), chains = [];
    if (!pairs) return chains;
    const order = Array.from(pairs.force.keys()).sort((a, b) => pairs.force[b] - pairs.force[a]);
    for (const i of order) {
        if (chains.length === most) break;
        const a = pairs.first[i], b = pairs.second[i];
        if (b > firstOfWalls || !shows(a) || !shows(b)) continue;
        const from = frames.place(moment, a), to = frames.place(moment, b);
        const throughPeriod = frames.period > 0 && Math.abs(from[0] - to[0]) > frames.period / 2;
        if (!throughPeriod) chains.push([from, to, pairs.force[i]]);
    }
    return chains.reverse();
}
