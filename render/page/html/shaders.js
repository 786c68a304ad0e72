// A grain is one quad that faces the eye and covers the sphere; each of its pixels finds where its ray meets the
// sphere, and takes colour and depth from there. So spheres that cut each other or a wall meet in exact lines.
const grainVertexShader = `#version 300 es
precision highp float;
precision highp int;
layout(location = 0) in uvec3 place;      // of 65535, over the box
layout(location = 1) in uvec2 state;      // speed, contact number, 255: not known; 255 and 254: not there
layout(location = 2) in uvec3 earlier;    // place in the moment before
layout(location = 3) in float startHeight;
layout(location = 4) in float fullRadius; // m
layout(location = 5) in uint species;
layout(location = 6) in uint pressed;     // sum of forces on it: 0 to 255 over the range that is shown
layout(location = 7) in uint inFilm;      // what the film colours: 1 to 255 over its range; 0 not known
uniform vec3 low, size;                   // m, of the box
uniform mat4 view, projection;
uniform int colourBy;
uniform vec2 range;
uniform sampler2D speciesColours, ramp;   // alpha of a species: 1 shown, 0.5 ghost, 0 hidden
uniform vec4 slice;                       // normal and distance (m) from the origin; nothing lies before it
uniform int chosen;
uniform float shrink;                     // of radii: force chains are seen between small grains
uniform int forcesKnown;                  // at this moment
out vec3 onQuad;                          // m, in the camera's axes
flat out vec3 centre;
flat out float sphere;
flat out vec3 colour;
flat out int grain, isGhost, isChosen;

vec3 placeOf(uvec3 number) { return low + vec3(number) * size / 65535.0; }

vec3 colourFor(vec4 ofSpecies, vec3 now) {
    if (colourBy == 0) return ofSpecies.rgb;
    bool unknown = colourBy == 1 && state.x == 255u || colourBy == 4 && state.y == 255u || colourBy == 5 && forcesKnown == 0 || colourBy == 6 && inFilm == 0u;
    if (unknown) return vec3(0.6); // at this moment
    float value = colourBy == 1 ? float(max(int(state.x) - 1, 0)) / 253.0
                : colourBy == 2 ? startHeight
                : colourBy == 3 ? (now.z - placeOf(earlier).z)
                : colourBy == 4 ? float(state.y)
                : colourBy == 5 ? float(pressed) / 255.0
                : (float(inFilm) - 1.0) / 254.0;
    return texture(ramp, vec2(clamp((value - range.x) / (range.y - range.x), 0.002, 0.998), 0.5)).rgb;
}

void main() {
    vec4 ofSpecies = texelFetch(speciesColours, ivec2(int(species), 0), 0);
    vec3 now = placeOf(place);
    centre = (view * vec4(now, 1.0)).xyz;
    float radius = shrink * fullRadius;
    sphere = radius;
    grain = gl_InstanceID;
    isGhost = ofSpecies.a < 0.75 ? 1 : 0;
    isChosen = gl_InstanceID == chosen ? 1 : 0;
    if (isChosen == 1) isGhost = 0;
    float distance = length(centre);
    bool gone = state == uvec2(255u, 254u) || ofSpecies.a < 0.25 || dot(slice.xyz, now) > slice.w;
    if (gone || distance <= 1.001 * radius) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    colour = colourFor(ofSpecies, now);
    vec3 ahead = centre / distance;
    vec3 across = normalize(cross(ahead, abs(ahead.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    float half_side = 1.02 * radius * distance / sqrt(distance * distance - radius * radius);
    onQuad = centre + half_side * (corner.x * across + corner.y * cross(across, ahead));
    gl_Position = projection * vec4(onQuad, 1.0);
}`;

const grainFragmentShader = `#version 300 es
precision highp float;
precision highp int;
in vec3 onQuad;
flat in vec3 centre;
flat in float sphere;
flat in vec3 colour;
flat in int grain, isGhost, isChosen;
uniform mat4 projection;
uniform vec3 mark;
uniform int picking;                      // 1: the grain's number in place of its colour
out vec4 pixel;

void main() {
    vec3 ray = normalize(onQuad);
    float along = dot(ray, centre);
    vec3 aside = centre - along * ray;
    float rim = length(aside) / sphere;   // 1 where the ray just touches
    float soft = fwidth(rim);
    if (rim >= 1.0) discard;
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (isGhost == 1 && (picking == 1 || ((at.x & 1) + (at.y & 1)) != 0)) discard;
    float behind = sphere * sqrt(1.0 - rim * rim);
    vec3 hit = (along - behind) * ray;
    vec4 clip = projection * vec4(hit, 1.0);
    gl_FragDepth = clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);
    if (picking == 1) {
        int number = grain + 1;
        pixel = vec4(number & 255, (number >> 8) & 255, (number >> 16) & 255, 255) / 255.0;
        return;
    }
    vec3 normal = (hit - centre) / sphere;
    float key = max(dot(normal, normalize(vec3(-0.4, 0.75, 0.55))), 0.0);
    float sky = 0.5 + 0.5 * normal.y;
    float light = (0.40 + 0.18 * sky + 0.52 * key) * (1.0 - 0.35 * pow(rim, 5.0));
    vec3 lit = colour * light + 0.10 * pow(key, 24.0);
    if (isChosen == 1 && rim > 0.72) lit = mark;
    pixel = vec4(lit, clamp((1.0 - rim) / max(soft, 1e-4), 0.0, 1.0));  // alpha: how much of the pixel it covers
}`;

const wallVertexShader = `#version 300 es
precision highp float;
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 colour;
uniform mat4 view, projection;
flat out vec3 paint;
void main() {
    paint = colour;
    gl_Position = projection * view * vec4(place, 1.0);
}`;

const wallFragmentShader = `#version 300 es
precision mediump float;
flat in vec3 paint;
out vec4 pixel;
void main() { pixel = vec4(paint, 1.0); }`;

// A segment is a flat band that faces the eye: edges of walls and ways of grains so many pixels wide, force chains so many
// metres.
const segmentVertexShader = `#version 300 es
precision highp float;
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in float width;      // m; below 0: pixels
layout(location = 3) in vec3 colour;
uniform mat4 view, projection;
uniform float height;                     // of the canvas, pixels
flat out vec3 paint;
flat out float roundness;                 // 1 for a chain, which looks like a rod
out float across;                         // -1 to 1
void main() {
    vec3 a = (view * vec4(from, 1.0)).xyz, b = (view * vec4(to, 1.0)).xyz;
    vec3 here = gl_VertexID < 2 ? a : b;
    vec3 aside = cross(b - a, here);
    aside = length(aside) > 0.0 ? normalize(aside) : vec3(1, 0, 0);
    float pixel = 2.0 * max(-here.z, 1e-6) / (projection[1][1] * height); // m
    float wide = width < 0.0 ? -width * pixel : max(width, pixel);
    paint = colour;
    roundness = width < 0.0 ? 0.0 : 1.0;
    across = (gl_VertexID & 1) == 0 ? 1.0 : -1.0;
    gl_Position = projection * vec4(here + 0.5 * across * wide * aside, 1.0);
}`;

const segmentFragmentShader = `#version 300 es
precision mediump float;
flat in vec3 paint;
flat in float roundness;
in float across;
out vec4 pixel;
void main() {
    float light = mix(1.0, 0.55 + 0.55 * sqrt(max(0.0, 1.0 - across * across)), roundness);
    pixel = vec4(min(paint * light, 1.0), 1.0);
}`;
