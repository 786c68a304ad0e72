// Draws the bed in three dimensions with WebGL 2. One call draws all grains, one the faces of walls, one all segments
// (edges, the way of a grain, force chains), and each mesh takes five at most. All moments lie on the graphics card.
// To show another one, only the walls' corners and the segments are sent, and at a key moment a byte for each grain.
const numbersASegment = 10; // from, to, width, colour
const shrunk = 0.35; // factor of the radii while force chains are shown

class Viewer {
    /** Throws an Error, with words for the reader, when the browser lacks what is needed. */
    constructor(canvas, frames, walls, camera) {
        this.canvas = canvas;
        this.frames = frames;
        this.walls = walls;
        this.camera = camera;
        this.gl = canvas.getContext("webgl2", {alpha: false, antialias: true, preserveDrawingBuffer: false});
        if (!this.gl) throw new Error("this browser has no WebGL 2, or it is switched off");
        this.frame = 0;
        this.chosen = -1;
        this.colourBy = 0;
        this.range = [0, 1];
        this.slice = [0, 0, 0, 1];
        this.path = []; // way of the chosen grain, m
        this.grains = makeProgram(this.gl, grainVertexShader, grainFragmentShader);
        this.wall = makeProgram(this.gl, wallVertexShader, wallFragmentShader);
        this.segment = makeProgram(this.gl, segmentVertexShader, segmentFragmentShader);
        this.chains = []; // [from, to, width in m]
        this.pressed = null; // a byte for each grain; null when forces are not known
        this.loadGrains();
        this.loadWalls();
        this.loadSegments();
        this.meshes = null;
        this.speciesTexture = this.gl.createTexture();
        this.rampTexture = this.gl.createTexture();
    }

    /** Takes other moments of the same run, with their walls. */
    take(frames, walls) {
        this.frames = frames;
        this.walls = walls;
        for (const buffer of this.grainBuffers) this.gl.deleteBuffer(buffer);
        this.gl.deleteVertexArray(this.grainArray);
        this.loadGrains();
    }

    /** Takes the meshes of walls: the bed's facts about them, and their bytes. They belong to all moments. */
    setMeshes(facts, bytes) {
        this.meshes = new Meshes(this.gl, facts, bytes);
    }

    loadGrains() {
        const gl = this.gl, frames = this.frames;
        this.grainArray = gl.createVertexArray();
        this.grainBuffers = [];
        const makeBuffer = () => this.grainBuffers[this.grainBuffers.push(gl.createBuffer()) - 1];
        gl.bindVertexArray(this.grainArray);
        this.moments = makeBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, this.moments);
        gl.bufferData(gl.ARRAY_BUFFER, frames.packed, gl.STATIC_DRAW);
        const perGrain = (location, values, pointer) => {
            gl.bindBuffer(gl.ARRAY_BUFFER, makeBuffer());
            gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
            pointer(location);
            gl.enableVertexAttribArray(location);
            gl.vertexAttribDivisor(location, 1);
        };
        const floats = (location) => gl.vertexAttribPointer(location, 1, gl.FLOAT, false, 0, 0);
        perGrain(3, this.startHeights(), floats);
        perGrain(4, frames.radii, floats);
        perGrain(5, frames.species, (location) => gl.vertexAttribIPointer(location, 1, gl.UNSIGNED_SHORT, 0, 0));
        this.pressedBuffer = makeBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, this.pressedBuffer);
        gl.bufferData(gl.ARRAY_BUFFER, frames.grains, gl.DYNAMIC_DRAW);
        gl.vertexAttribIPointer(6, 1, gl.UNSIGNED_BYTE, 0, 0);
        this.filmBuffer = makeBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, this.filmBuffer);
        gl.bufferData(gl.ARRAY_BUFFER, frames.film ? frames.filmBytes : new Uint8Array(frames.grains), gl.STATIC_DRAW);
        for (const location of [0, 1, 2, 6, 7]) {
            gl.enableVertexAttribArray(location);
            gl.vertexAttribDivisor(location, 1);
        }
    }

    /** bytes: the force on each grain as a byte; null when forces are not known at this moment. */
    setPressed(bytes) {
        const gl = this.gl;
        this.pressed = bytes;
        if (!bytes) return;
        gl.bindBuffer(gl.ARRAY_BUFFER, this.pressedBuffer);
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, bytes);
    }

    /** The height in m of each grain in the first moment that has it. */
    startHeights() {
        const frames = this.frames, heights = new Float32Array(frames.grains);
        for (let grain = 0; grain < frames.grains; ++grain) {
            let frame = 0;
            while (frame + 1 < frames.times.length && !frames.isPresent(frame, grain)) ++frame;
            heights[grain] = frames.place(frame, grain)[2];
        }
        return heights;
    }

    loadWalls() {
        const gl = this.gl;
        this.wallArray = gl.createVertexArray();
        gl.bindVertexArray(this.wallArray);
        this.wallBuffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, this.wallBuffer);
        for (const location of [0, 1]) {
            gl.enableVertexAttribArray(location);
            gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 24, 12 * location);
        }
    }

    // Draws instances of a band of four corners; each has numbersASegment floats.
    loadSegments() {
        const gl = this.gl;
        this.segmentArray = gl.createVertexArray();
        gl.bindVertexArray(this.segmentArray);
        this.segmentBuffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, this.segmentBuffer);
        let at = 0;
        for (const [location, size] of [[0, 3], [1, 3], [2, 1], [3, 3]]) {
            gl.enableVertexAttribArray(location);
            gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * numbersASegment, 4 * at);
            gl.vertexAttribDivisor(location, 1);
            at += size;
        }
    }

    /** rgba: four bytes for each species; alpha is 255 for shown, 128 for ghost, 0 for hidden. */
    setSpecies(rgba) {
        this.texture(this.speciesTexture, rgba, this.gl.NEAREST);
    }

    /** rgba: four bytes for each step of the ramp. banded: whether each step is one colour. */
    setRamp(rgba, banded = false) {
        this.texture(this.rampTexture, rgba, banded ? this.gl.NEAREST : this.gl.LINEAR);
    }

    texture(texture, rgba, filter) {
        const gl = this.gl;
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, rgba.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
        for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, filter);
        for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
            gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    }

    /** Draws with the next picture of the screen, once. */
    change() {
        if (this.waiting) return;
        this.waiting = true;
        requestAnimationFrame(() => {
            this.waiting = false;
            this.draw();
        });
    }

    fitCanvas() {
        const scale = Math.min(2, devicePixelRatio || 1);
        const width = Math.max(1, Math.round(this.canvas.clientWidth * scale));
        const height = Math.max(1, Math.round(this.canvas.clientHeight * scale));
        if (this.canvas.width !== width || this.canvas.height !== height) {
            this.canvas.width = width;
            this.canvas.height = height;
        }
        const aspect = width / height;
        if (Math.abs(aspect - this.camera.aspect) > 1e-3) {
            const zoom = this.camera.fitted / this.camera.distance;
            this.camera.aspect = aspect;
            this.camera.fit();
            this.camera.zoom(zoom);
        }
    }

    draw() {
        const gl = this.gl;
        if (gl.isContextLost()) return;
        this.fitCanvas();
        this.colours = wallColours();
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, this.canvas.width, this.canvas.height);
        gl.clearColor(...this.colours.background, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.DEPTH_TEST);
        this.drawGrains(false);
        this.drawWalls();
    }

    drawGrains(picking) {
        const gl = this.gl, frames = this.frames, program = this.grains;
        const size = 8 * frames.grains, before = Math.max(0, this.frame - 1);
        gl.useProgram(program.program);
        gl.bindVertexArray(this.grainArray);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.moments);
        gl.vertexAttribIPointer(0, 3, gl.UNSIGNED_SHORT, 8, size * this.frame);
        gl.vertexAttribIPointer(1, 2, gl.UNSIGNED_BYTE, 8, size * this.frame + 6);
        gl.vertexAttribIPointer(2, 3, gl.UNSIGNED_SHORT, 8, size * before);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.filmBuffer);
        gl.vertexAttribIPointer(7, 1, gl.UNSIGNED_BYTE, 1, frames.film ? frames.grains * this.frame : 0);
        gl.uniform3fv(program.at("low"), frames.low);
        gl.uniform3fv(program.at("size"), frames.high.map((high, axis) => high - frames.low[axis]));
        gl.uniformMatrix4fv(program.at("view"), false, this.camera.view());
        gl.uniformMatrix4fv(program.at("projection"), false, this.camera.projection());
        gl.uniform1i(program.at("colourBy"), this.colourBy);
        gl.uniform2fv(program.at("range"), this.range);
        gl.uniform4fv(program.at("slice"), this.slice);
        gl.uniform1i(program.at("chosen"), this.chosen);
        gl.uniform3fv(program.at("mark"), (this.colours ?? wallColours()).mark);
        gl.uniform1i(program.at("picking"), picking ? 1 : 0);
        gl.uniform1f(program.at("shrink"), this.chains.length ? shrunk : 1);
        gl.uniform1i(program.at("forcesKnown"), this.pressed ? 1 : 0);
        [this.speciesTexture, this.rampTexture].forEach((texture, unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, texture);
        });
        gl.uniform1i(program.at("speciesColours"), 0);
        gl.uniform1i(program.at("ramp"), 1);
        gl.activeTexture(gl.TEXTURE0);
        if (!picking) gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, frames.grains);
        gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    }

    drawWalls() {
        const gl = this.gl, program = this.wall, frames = this.frames;
        const {faces, edges} = this.walls.vertices(
            frames.times[this.frame], frames.bodies[this.frame], this.camera.eye(), this.colours);
        const data = new Float32Array(faces.flat());
        gl.useProgram(program.program);
        gl.bindVertexArray(this.wallArray);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.wallBuffer);
        gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
        gl.uniformMatrix4fv(program.at("view"), false, this.camera.view());
        gl.uniformMatrix4fv(program.at("projection"), false, this.camera.projection());
        gl.enable(gl.POLYGON_OFFSET_FILL);
        gl.polygonOffset(1, 1);
        gl.drawArrays(gl.TRIANGLES, 0, faces.length);
        gl.disable(gl.POLYGON_OFFSET_FILL);
        const poses = frames.bodies[this.frame];
        if (this.meshes) this.meshes.drawSolid(poses, this.sight(), this.colours);
        this.drawSegments(edges);
        if (this.meshes) this.meshes.drawGlass(poses, this.sight(), this.colours);
    }

    // The view of the camera and the size of the canvas.
    sight() {
        const pen = Math.min(2, devicePixelRatio || 1); // pixels of the canvas
        return {eye: this.camera.eye(), view: this.camera.view(), projection: this.camera.projection(),
                height: this.canvas.height, pen};
    }

    // Draws all segments. edges: [from, to, colour].
    drawSegments(edges) {
        const gl = this.gl, program = this.segment, mark = this.colours.mark;
        const pen = Math.min(2, devicePixelRatio || 1); // pixels of the canvas
        const numbers = [];
        for (const [from, to, colour] of edges) numbers.push(...from, ...to, -1.2 * pen, ...colour);
        for (let i = 1; i < this.path.length; ++i)
            if (this.path[i - 1] && this.path[i]) numbers.push(...this.path[i - 1], ...this.path[i], -1.5 * pen, ...mark);
        for (const [from, to, width] of this.chains) numbers.push(...from, ...to, width, ...this.colours.chain);
        gl.useProgram(program.program);
        gl.bindVertexArray(this.segmentArray);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.segmentBuffer);
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.DYNAMIC_DRAW);
        gl.uniformMatrix4fv(program.at("view"), false, this.camera.view());
        gl.uniformMatrix4fv(program.at("projection"), false, this.camera.projection());
        gl.uniform1f(program.at("height"), this.canvas.height);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, numbers.length / numbersASegment);
    }

    /** The index of the grain at a pixel of the canvas, counted from its upper left in CSS pixels; -1 for none. */
    pick(x, y) {
        const gl = this.gl, width = this.canvas.width, height = this.canvas.height;
        const column = Math.floor((x * width) / this.canvas.clientWidth);
        const row = height - 1 - Math.floor((y * height) / this.canvas.clientHeight);
        this.makeIds(width, height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.ids.framebuffer);
        gl.viewport(0, 0, width, height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(column, row, 1, 1);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.DEPTH_TEST);
        this.drawGrains(true);
        const pixel = new Uint8Array(4);
        gl.readPixels(column, row, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        gl.disable(gl.SCISSOR_TEST);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        return (pixel[0] | (pixel[1] << 8) | (pixel[2] << 16)) - 1;
    }

    // Makes room for the picture of the grains' numbers, as large as the canvas.
    makeIds(width, height) {
        const gl = this.gl;
        if (this.ids && this.ids.width === width && this.ids.height === height) return;
        if (this.ids) for (const buffer of this.ids.buffers) gl.deleteRenderbuffer(buffer);
        const framebuffer = this.ids?.framebuffer ?? gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        const attach = (format, point) => {
            const buffer = gl.createRenderbuffer();
            gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
            gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
            gl.framebufferRenderbuffer(gl.FRAMEBUFFER, point, gl.RENDERBUFFER, buffer);
            return buffer;
        };
        const buffers = [attach(gl.RGBA8, gl.COLOR_ATTACHMENT0), attach(gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT)];
        this.ids = {framebuffer, buffers, width, height};
    }

    /** The place of a grain's middle on the canvas, in CSS pixels from its upper left corner. */
    pixelOf(grain) {
        const place = [...this.frames.place(this.frame, grain), 1];
        const times = (matrix, vector) =>
            [0, 1, 2, 3].map((row) => vector.reduce((sum, value, column) => sum + matrix[4 * column + row] * value, 0));
        const clip = times(this.camera.projection(), times(this.camera.view(), place));
        return [
            ((clip[0] / clip[3] + 1) / 2) * this.canvas.clientWidth,
            ((1 - clip[1] / clip[3]) / 2) * this.canvas.clientHeight,
        ];
    }
}

function makeProgram(gl, vertex, fragment) {
    const program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
        const logs = gl.getAttachedShaders(program).map((shader) => gl.getShaderInfoLog(shader) ?? "");
        throw new Error(`the graphics card refused the drawing program: ${logs.join(" ").trim()}`);
    }
    const places = new Map();
    const at = (name) => {
        if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
        return places.get(name);
    };
    return {program, at};
}

/** Red, green and blue from 0 to 1 of "#rrggbb". */
function partsOf(colour) {
    return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255);
}

function wallColours() {
    const background = partsOf(colourOf("--bed")), solid = partsOf(colourOf("--wall")), ink = partsOf(colourOf("--ink"));
    const mix = (a, b, share) => a.map((value, i) => value + share * (b[i] - value));
    return {
        background,
        inner: mix(background, solid, 0.3),
        outer: mix(background, solid, 0.7),
        cut: solid,
        pane: mix(background, solid, 0.1),
        edge: mix(solid, ink, 0.6),
        glass: mix(background, ink, 0.45),
        mark: partsOf(colourOf("--mark")),
        chain: partsOf(colourOf("--chain")),
    };
}
