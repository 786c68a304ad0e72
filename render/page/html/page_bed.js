// The bed's moments, unpacked: what the page carries of the trajectory.
//
// The bytes are, for N grains and K moments, little-endian:
//   ids, N int32; species, N uint16; radii in m, N float32;
//   then for each moment: x, y and z, each as N low bytes and N high bytes of a zigzag difference from the moment
//   before (from 0 at first); N bytes of speed; N contact numbers; N bytes of presence; and, where the film colours its
//   grains by a quantity, N bytes of that: 0 where it is not known, else 1 to 255 over the film's range.
// Where a grain is not present, its differences, speed and presence are 0. A speed or contact number that is not known is
// 255. render/page/bed/page_bed.hpp describes the same bytes, which page_bed.cpp writes. A place is low + number (high -
// low) / 65535 along each axis.

/** Stands for a grain that is not present: a speed that is not known, of a grain with 254 contacts. */
const absent = 0xfeff;

/** The state of a present grain in two bytes. It is never `absent`: 254 contacts of an unknown speed become 253. */
function presentState(speed, contacts) {
    const state = speed | (contacts << 8);
    return state === absent ? state - 0x100 : state;
}

class PageBed {
    constructor(facts, bytes) {
        Object.assign(this, facts); // grains, times, low, high, places, speed, ...
        const n = this.grains, k = this.times.length;
        const perGrain = this.film ? 10 : 9;
        if (bytes.length !== 10 * n + k * n * perGrain)
            throw new Error(`there are ${bytes.length} bytes of them in place of ${10 * n + k * n * perGrain}`);
        const view = new DataView(bytes.buffer, bytes.byteOffset);
        this.ids = Int32Array.from({length: n}, (_, i) => view.getInt32(4 * i, true));
        this.species = Uint16Array.from({length: n}, (_, i) => view.getUint16(4 * n + 2 * i, true));
        this.radii = Float32Array.from({length: n}, (_, i) => view.getFloat32(6 * n + 4 * i, true));
        // The data as the graphics card reads it: x, y, z; speed and contact number, each 255 where it is not known;
        // or `absent` for a grain that is not present.
        this.packed = new Uint16Array(4 * n * k);
        this.filmBytes = new Uint8Array(this.film ? n * k : 0);
        this.unpack(bytes.subarray(10 * n), perGrain * n);
    }

    unpack(bytes, size) {
        const n = this.grains, packed = this.packed;
        const last = [new Uint16Array(n), new Uint16Array(n), new Uint16Array(n)];
        for (let frame = 0; frame < this.times.length; ++frame) {
            const from = frame * size, into = frame * 4 * n;
            for (let axis = 0; axis < 3; ++axis) {
                const low = from + 2 * axis * n, high = low + n, before = last[axis];
                for (let i = 0; i < n; ++i) {
                    const zigzag = bytes[low + i] | (bytes[high + i] << 8);
                    before[i] += (zigzag >> 1) ^ -(zigzag & 1);
                    packed[into + 4 * i + axis] = before[i];
                }
            }
            const speed = from + 6 * n, contacts = speed + n, present = contacts + n;
            for (let i = 0; i < n; ++i)
                packed[into + 4 * i + 3] = bytes[present + i] ? presentState(bytes[speed + i], bytes[contacts + i]) : absent;
            if (this.film) this.filmBytes.set(bytes.subarray(present + n, present + 2 * n), frame * n);
        }
    }

    isPresent(frame, grain) {
        return this.packed[4 * (frame * this.grains + grain) + 3] !== absent;
    }

    /** The place of a grain's middle in m. */
    place(frame, grain) {
        const at = 4 * (frame * this.grains + grain);
        return [0, 1, 2].map(
            (axis) => this.low[axis] + (this.packed[at + axis] * (this.high[axis] - this.low[axis])) / 65535,
        );
    }

    /**
     * The speed in m/s; null when it is not known. A byte b from 1 to 254 stands for lowest (highest / lowest)^((b - 1) /
     * 253); 0 for less than lowest.
     */
    speedAt(frame, grain) {
        const byte = this.packed[4 * (frame * this.grains + grain) + 3] & 0xff;
        const {lowest, highest} = this.speed;
        if (byte === 255) return null;
        return byte === 0 ? 0 : lowest * Math.pow(highest / lowest, (byte - 1) / 253);
    }

    /** The number of contacts; null when it is not known. */
    contactsAt(frame, grain) {
        const number = this.packed[4 * (frame * this.grains + grain) + 3] >> 8;
        return number === 255 ? null : number;
    }

    /**
     * The places of the grain from the first moment to `frame`, in m. null stands where it was not present, and between
     * two places where it left a periodic container on one side and came in on the other.
     */
    pathUntil(frame, grain) {
        const path = [];
        for (let k = 0; k <= frame; ++k) {
            const now = this.isPresent(k, grain) ? this.place(k, grain) : null, before = path[path.length - 1];
            if (now && before && this.period > 0 && Math.abs(now[0] - before[0]) > this.period / 2) path.push(null);
            path.push(now);
        }
        return path;
    }

    /**
     * Grains whose surfaces are nearer to this one's than a twentieth of its diameter. The places do
     * not tell whether these grains push each other.
     */
    nearNeighbours(frame, grain) {
        const here = this.place(frame, grain), radius = this.radii[grain], near = [];
        for (let other = 0; other < this.grains; ++other) {
            if (other === grain || !this.isPresent(frame, other)) continue;
            const apart = this.place(frame, other).map((value, axis) => value - here[axis]);
            if (this.period > 0) apart[0] -= this.period * Math.round(apart[0] / this.period);
            if (Math.hypot(...apart) < 1.1 * radius + this.radii[other]) near.push(other);
        }
        return near;
    }

    indexAt(time) {
        return nearestIndex(this.times, time);
    }
}
