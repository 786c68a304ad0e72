// Draws walls as in the film: they are solid when the eye looks at their inner side; those that would hide the
// grains show only their edges.
//
// Bodies have poses, moment by moment: slabs and meshes go with them.
//
// A slab is {body, inner, outer, seams, from, until}: a flat convex piece of wall, m, in the frame of its body
// (render/page/bed/slabs.hpp). outer is the other side of its thickness, corner by corner, or empty for a pane. A slab
// may be there only from one time (s) until another.
const leastOfDisc = 12; // corners
const firstPlaneBody = 2; // as in engine/state/body.hpp

class Walls {
    constructor(slabs, box) {
        const middle = box.low.map((low, axis) => (low + box.high[axis]) / 2);
        this.slabs = slabs.map((slab) => ({...slab, normal: outwardNormal(slab, middle)}));
    }

    /** Gives faces, as corners of triangles [x, y, z, red, green, blue], and edges, as [from, to, colour]. */
    vertices(time, places, eye, colours) {
        const faces = [], edges = [];
        for (const slab of this.slabs) {
            if (time < (slab.from ?? -Infinity) || time >= (slab.until ?? Infinity)) continue;
            const pose = poseOf(places, slab.body);
            const moved = (points) => points.map((point) => movedBy(pose, point));
            const inner = moved(slab.inner), outer = moved(slab.outer);
            const toEye = eye.map((value, axis) => value - inner[0][axis]);
            const solid = dot(toEye, turnedBy(pose.turn, slab.normal)) < 0;
            if (solid) addSolid(faces, slab, inner, outer, colours);
            addEdges(edges, inner, outer, solid ? colours.edge : colours.glass, slab.seams);
        }
        return {faces, edges};
    }
}

/** The pose of a body. places: for each body [x, y, z] in m; for a turned one a unit quaternion w, x, y, z follows. */
function poseOf(places, body) {
    const [x, y, z, ...turn] = places[body] ?? [0, 0, 0];
    return {place: [x, y, z], turn: turn.length ? turn : null};
}

/** A vector turned by a unit quaternion, or unchanged when there is none. */
function turnedBy(turn, vector) {
    if (!turn) return vector;
    const [w, ...axis] = turn;
    const twice = cross(axis, vector).map((value) => 2 * value), aside = cross(axis, twice);
    return vector.map((value, k) => value + w * twice[k] + aside[k]);
}

/** movedBy() moves a point from its place at rest to where the body is now, atRest() moves it back; m. */
function movedBy({place, turn}, point) {
    return turnedBy(turn, point).map((value, axis) => value + place[axis]);
}

function atRest({place, turn}, point) {
    return turnedBy(turn && [turn[0], -turn[1], -turn[2], -turn[3]], point.map((value, axis) => value - place[axis]));
}

/** The motion of movedBy() as a matrix, column by column. */
function matrixOf({place, turn}) {
    const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => [...turnedBy(turn, axis), 0]);
    return new Float32Array([...columns.flat(), ...place, 1]);
}

function outwardNormal(slab, middle) {
    const [a, b, c] = slab.inner;
    const along = b.map((value, axis) => value - a[axis]), other = c.map((value, axis) => value - a[axis]);
    const normal = cross(along, other);
    const away = slab.outer.length ? slab.outer[0].map((value, axis) => value - a[axis])
                                   : a.map((value, axis) => value - middle[axis]);
    return dot(normal, away) < 0 ? normal.map((value) => -value) : normal;
}

function addSolid(faces, slab, inner, outer, colours) {
    const isPlane = slab.body >= firstPlaneBody;
    fan(faces, inner, outer.length || isPlane ? colours.inner : colours.pane);
    if (!outer.length) return;
    fan(faces, outer, colours.outer);
    for (let i = 0; i < inner.length; ++i) {
        if (slab.seams?.includes(i)) continue;
        const j = (i + 1) % inner.length;
        fan(faces, [inner[i], inner[j], outer[j], outer[i]], colours.cut);
    }
}

function fan(faces, points, colour) {
    for (let i = 1; i + 1 < points.length; ++i)
        for (const point of [points[0], points[i], points[i + 1]]) faces.push([...point, ...colour]);
}

// seams: numbers of the inner sides that are shared with the next piece of a round wall; they get no line. A disc gets
// its rims, and no lines between its corners.
function addEdges(edges, inner, outer, colour, seams = []) {
    const line = (from, to) => edges.push([from, to, colour]);
    for (let i = 0; i < inner.length; ++i) {
        if (seams.includes(i)) continue;
        const j = (i + 1) % inner.length;
        line(inner[i], inner[j]);
        if (outer.length) line(outer[i], outer[j]);
        if (outer.length && !seams.length && inner.length < leastOfDisc) line(inner[i], outer[i]);
    }
}
