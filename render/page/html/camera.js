// A camera that turns about a point, with the film's angles. At azimuth 0 it looks along -x; as the azimuth grows, the
// eye moves to the right. The elevation counts from the horizon. z is up, unless the film has another direction, as for
// a drum that lies.
class Camera {
    /**
     * view: {azimuth, elevation, fov} in degrees. If z is not up it also has `up`, and `front`, from where azimuth 0
     * looks. box: {low, high} in m; all of it is in the picture.
     */
    constructor(view, box) {
        this.up = view.up ?? [0, 0, 1];
        this.front = view.front ?? [1, 0, 0];
        this.side = cross(this.up, this.front);
        this.start = view;
        this.box = box;
        this.aspect = 1;
        this.reset();
    }

    reset() {
        this.azimuth = this.start.azimuth;
        this.elevation = this.start.elevation;
        this.target = this.box.low.map((low, axis) => (low + this.box.high[axis]) / 2);
        this.fit();
    }

    /** Takes the distance at which the whole box just fits into the picture. */
    fit() {
        const {forward, right, up} = this.axes();
        const tanY = Math.tan((this.start.fov * Math.PI) / 360), tanX = tanY * this.aspect;
        let distance = 0;
        for (let corner = 0; corner < 8; ++corner) {
            const point = [0, 1, 2].map(
                (axis) => (corner & (1 << axis) ? this.box.high : this.box.low)[axis] - this.target[axis],
            );
            const away = dot(point, forward);
            distance = Math.max(
                distance,
                Math.abs(dot(point, right)) / tanX - away,
                Math.abs(dot(point, up)) / tanY - away,
            );
        }
        this.fitted = this.distance = 1.04 * distance;
    }

    axes() {
        const a = (this.azimuth * Math.PI) / 180, e = (this.elevation * Math.PI) / 180;
        const along = (front, side, up) => [0, 1, 2].map((k) => front * this.front[k] + side * this.side[k] + up * this.up[k]);
        const forward = along(-Math.cos(e) * Math.cos(a), -Math.cos(e) * Math.sin(a), -Math.sin(e));
        const right = along(-Math.sin(a), Math.cos(a), 0);
        return {forward, right, up: cross(right, forward)};
    }

    eye() {
        const {forward} = this.axes();
        return this.target.map((value, axis) => value - this.distance * forward[axis]);
    }

    orbit(right, up) {
        this.azimuth -= right;
        this.elevation = Math.min(89, Math.max(-89, this.elevation + up));
    }

    zoom(factor) {
        this.distance = Math.min(8 * this.fitted, Math.max(0.02 * this.fitted, this.distance / factor));
    }

    /** Moves the point that is looked at; the distances are in heights of the picture. */
    pan(toRight, toTop) {
        const {right, up} = this.axes();
        const height = 2 * this.distance * Math.tan((this.start.fov * Math.PI) / 360);
        this.target = this.target.map((value, axis) => value - height * (toRight * right[axis] + toTop * up[axis]));
    }

    /** The matrix from the lab's axes to the camera's, which looks along -z; column by column. */
    view() {
        const {forward, right, up} = this.axes(), eye = this.eye();
        const back = forward.map((value) => -value);
        return new Float32Array([
            right[0], up[0], back[0], 0,
            right[1], up[1], back[1], 0,
            right[2], up[2], back[2], 0,
            -dot(right, eye), -dot(up, eye), -dot(back, eye), 1,
        ]);
    }

    projection() {
        const f = 1 / Math.tan((this.start.fov * Math.PI) / 360);
        const size = Math.hypot(...this.box.low.map((low, axis) => this.box.high[axis] - low));
        const far = this.distance + 2 * size, near = Math.max(1e-3 * far, this.distance - 2 * size);
        return new Float32Array([
            f / this.aspect, 0, 0, 0,
            0, f, 0, 0,
            0, 0, (far + near) / (near - far), -1,
            0, 0, (2 * far * near) / (near - far), 0,
        ]);
    }
}

function dot(a, b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a, b) {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
