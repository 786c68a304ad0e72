// Draws walls from meshes. The graphics card has their triangles and lines once; they are moved to where their body is.
//
// The bytes are, for each mesh of V vertices, T triangles and E edges: x, y and z of the vertices, each as V low bytes and V
// high bytes of a zigzag difference from the vertex before, in 65535ths of the mesh's box; the three corners of triangles
// and the two ends of edges, each as low, middle and high bytes of a zigzag difference from the one before.
//
// The first triangles are solid wherever they are seen from. Then come those that are glass, and last those that are solid on
// the side of their normal and glass on the other one, so that the grains behind them are seen.

// Draws a triangle of a mesh, given in its body's frame. The light is computed from the triangle's plane, so the page
// carries no normals.
const meshVertexShader = `#version 300 es
precision highp float;
layout(location = 0) in vec3 place;
uniform mat4 pose, view, projection;
out vec3 seen;                            // m, in the camera's axes
void main() {
    vec4 here = view * pose * vec4(place, 1.0);
    seen = here.xyz;
    gl_Position = projection * here;
}`;

const meshFragmentShader = `#version 300 es
precision highp float;
in vec3 seen;
uniform vec3 paint;
uniform vec2 cover;                       // how much a face hides that is seen from ahead, and one seen along
out vec4 pixel;
void main() {
    vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
    float ahead = abs(dot(normal, normalize(seen)));
    if (dot(normal, seen) > 0.0) normal = -normal;
    float light = 0.86 + 0.16 * dot(normal, normalize(vec3(-0.4, 0.75, 0.55)));
    float along = (1.0 - ahead) * (1.0 - ahead);
    pixel = vec4(min(paint * light, 1.0), mix(cover.x, cover.y, along));
}`;

// An edge of a mesh, as a segment is drawn (shaders.js). Its colour tells whether it is on solid walls or on glass.
const meshEdgeVertexShader = `#version 300 es
precision highp float;
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 solidSide;   // sum of the normals that meet here; 0: it is solid from all sides
uniform mat4 pose, view, projection;
uniform vec3 eye;                         // m, in the body's frame
uniform float height, wide;               // of the canvas and of the line, pixels
uniform vec3 solid, glass;                // colours
flat out vec3 paint;
flat out float roundness;
out float across;
void main() {
    vec3 a = (view * pose * vec4(from, 1.0)).xyz, b = (view * pose * vec4(to, 1.0)).xyz;
    vec3 here = gl_VertexID < 2 ? a : b;
    vec3 aside = cross(b - a, here);
    aside = length(aside) > 0.0 ? normalize(aside) : vec3(1, 0, 0);
    float pixel = 2.0 * max(-here.z, 1e-6) / (projection[1][1] * height); // m
    paint = dot(solidSide, eye - from) < 0.0 ? glass : solid;
    roundness = 0.0;
    across = (gl_VertexID & 1) == 0 ? 1.0 : -1.0;
    gl_Position = projection * vec4(here + 0.5 * across * wide * pixel * aside, 1.0);
}`;

/** Unpacks what is drawn of each mesh. facts: [{body, name, vertices, triangles, glass, sided, edges, low, high}]. */
function unpackMeshes(facts, bytes) {
    let at = 0;
    const planes = (count, each) => {
        const numbers = new Int32Array(count);
        for (let plane = 0; plane < each; ++plane)
            for (let i = 0; i < count; ++i) numbers[i] |= bytes[at++] << (8 * plane);
        return numbers.map((number) => (number >>> 1) ^ -(number & 1));
    };
    const size = ({vertices, triangles, edges}) => 6 * vertices + 9 * triangles + 6 * edges;
    const wanted = facts.reduce((sum, one) => sum + size(one), 0);
    if (bytes.length !== wanted) throw new Error(`there are ${bytes.length} bytes of meshes in place of ${wanted}`);
    const corners = (count, each) => {
        const list = new Uint32Array(each * count);
        for (let corner = 0; corner < each; ++corner)
            planes(count, 3).reduce((before, change, i) => (list[each * i + corner] = before + change), 0);
        return list;
    };
    return facts.map((one) => {
        const places = new Float32Array(3 * one.vertices);
        for (let axis = 0; axis < 3; ++axis) {
            const low = one.low[axis], step = (one.high[axis] - low) / 65535;
            let number = 0;
            planes(one.vertices, 2).forEach((change, i) => {
                number = (number + change) & 0xffff;
                places[3 * i + axis] = low + number * step;
            });
        }
        return {...one, places, corners: corners(one.triangles, 3), ends: corners(one.edges, 2)};
    });
}

/**
 * For each edge 9 numbers: its two ends in m, and the sum of the unit normals of the triangles that meet at it. The sum
 * is set to 0 when one of them is solid from both sides.
 */
function edgesWithSides(mesh) {
    const {places, corners, ends} = mesh, vertices = places.length / 3;
    const key = (a, b) => Math.min(a, b) * vertices + Math.max(a, b);
    const numbers = new Float32Array((9 * ends.length) / 2), found = new Map();
    const place = (vertex) => [places[3 * vertex], places[3 * vertex + 1], places[3 * vertex + 2]];
    for (let k = 0; k < ends.length / 2; ++k) {
        numbers.set([...place(ends[2 * k]), ...place(ends[2 * k + 1])], 9 * k);
        found.set(key(ends[2 * k], ends[2 * k + 1]), k);
    }
    const solidToo = new Set(); // edges of a triangle that is solid from both sides
    const solid = mesh.triangles - mesh.glass - mesh.sided;
    for (let t = 0; t < mesh.triangles; ++t) {
        const three = corners.subarray(3 * t, 3 * t + 3);
        const mine = [0, 1, 2].map((e) => found.get(key(three[e], three[(e + 1) % 3]))).filter((k) => k !== undefined);
        if (!mine.length) continue;
        const [a, b, c] = [...three].map(place);
        const normal = cross(b.map((value, axis) => value - a[axis]), c.map((value, axis) => value - a[axis]));
        const length = Math.hypot(...normal) || 1;
        for (const k of mine) {
            if (t < solid) solidToo.add(k);
            for (let axis = 0; axis < 3; ++axis) numbers[9 * k + 6 + axis] += normal[axis] / length;
        }
    }
    for (const k of solidToo) numbers.fill(0, 9 * k + 6, 9 * k + 9);
    return numbers;
}

class Meshes {
    /** gl: the viewer's WebGL context. */
    constructor(gl, facts, bytes) {
        this.gl = gl;
        this.faces = makeProgram(gl, meshVertexShader, meshFragmentShader);
        this.lines = makeProgram(gl, meshEdgeVertexShader, segmentFragmentShader);
        this.meshes = unpackMeshes(facts, bytes).map((mesh) => this.load(mesh));
    }

    load(mesh) {
        const gl = this.gl, faces = gl.createVertexArray(), lines = gl.createVertexArray();
        gl.bindVertexArray(faces);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, mesh.places, gl.STATIC_DRAW);
        gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
        gl.enableVertexAttribArray(0);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.corners, gl.STATIC_DRAW);
        gl.bindVertexArray(lines);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, edgesWithSides(mesh), gl.STATIC_DRAW);
        for (const location of [0, 1, 2]) {
            gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 36, 12 * location);
            gl.enableVertexAttribArray(location);
            gl.vertexAttribDivisor(location, 1);
        }
        gl.bindVertexArray(null);
        const {body, name, triangles, glass, sided, edges} = mesh;
        return {body, name, faces, lines, edges, solid: triangles - glass - sided, glass, sided};
    }

    /** Draws solid faces and the lines. view: {eye, view, projection, height, pen} of the viewer. */
    drawSolid(poses, view, colours) {
        const gl = this.gl;
        gl.enable(gl.POLYGON_OFFSET_FILL);
        gl.polygonOffset(1, 1);
        this.drawFaces(poses, view, {paint: colours.outer, ...opaque}, (mesh) => [0, mesh.solid]);
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl.BACK);
        this.drawFaces(poses, view, {paint: colours.inner, ...opaque}, (mesh) => [mesh.solid + mesh.glass, mesh.sided]);
        gl.disable(gl.CULL_FACE);
        gl.disable(gl.POLYGON_OFFSET_FILL);
        this.drawLines(poses, view, colours);
    }

    /** Draws the glass in front of the grains. Call it when everything solid has been drawn. */
    drawGlass(poses, view, colours) {
        const gl = this.gl;
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        gl.depthMask(false);
        this.drawFaces(poses, view, {paint: colours.glass, ...glass}, (mesh) => [mesh.solid, mesh.glass]);
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl.FRONT);
        this.drawFaces(poses, view, {paint: colours.glass, ...glass}, (mesh) => [mesh.solid + mesh.glass, mesh.sided]);
        gl.disable(gl.CULL_FACE);
        gl.depthMask(true);
        gl.disable(gl.BLEND);
    }

    // part: for each mesh, the first triangle and the number of triangles.
    drawFaces(poses, view, look, part) {
        const gl = this.gl, program = this.faces;
        gl.useProgram(program.program);
        gl.uniformMatrix4fv(program.at("view"), false, view.view);
        gl.uniformMatrix4fv(program.at("projection"), false, view.projection);
        gl.uniform3fv(program.at("paint"), look.paint);
        gl.uniform2fv(program.at("cover"), look.cover);
        for (const mesh of this.meshes) {
            const [first, count] = part(mesh);
            if (!count) continue;
            gl.uniformMatrix4fv(program.at("pose"), false, matrixOf(poseOf(poses, mesh.body)));
            gl.bindVertexArray(mesh.faces);
            gl.drawElements(gl.TRIANGLES, 3 * count, gl.UNSIGNED_INT, 12 * first);
        }
    }

    drawLines(poses, view, colours) {
        const gl = this.gl, program = this.lines;
        gl.useProgram(program.program);
        gl.uniformMatrix4fv(program.at("view"), false, view.view);
        gl.uniformMatrix4fv(program.at("projection"), false, view.projection);
        gl.uniform1f(program.at("height"), view.height);
        gl.uniform1f(program.at("wide"), 1.2 * view.pen);
        gl.uniform3fv(program.at("solid"), colours.edge);
        gl.uniform3fv(program.at("glass"), colours.glass);
        for (const mesh of this.meshes) {
            if (!mesh.edges) continue;
            const pose = poseOf(poses, mesh.body);
            gl.uniformMatrix4fv(program.at("pose"), false, matrixOf(pose));
            gl.uniform3fv(program.at("eye"), atRest(pose, view.eye));
            gl.bindVertexArray(mesh.lines);
            gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, mesh.edges);
        }
    }
}

const opaque = {cover: [1, 1]}, glass = {cover: [0.1, 0.35]}; // how much a face hides, seen from ahead and seen along
