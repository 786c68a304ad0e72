#include "render/draw/sphere_shaders.hpp"

#include <fmt/format.h>

#include "render/draw/light.hpp"

namespace grainreel {
namespace {

// View coordinates: x right, y up, z away from the eye. `slope` is where a pixel's line of sight goes:
// (x, y) at z = 1 under perspective, (x, y) in metres under an orthographic camera.
const char* const header = R"(#version 330 core
uniform int orthographic;
uniform vec2 centre;   // pixels, of the port, from the bottom left
uniform float focal;   // pixels a unit of slope
vec2 slope_at(vec2 pixel) { return (pixel - centre) / focal; }

// Distance along z at which the line of sight meets the sphere, or -1. The discriminant comes from the point of
// closest approach, which keeps its digits when the sphere is small and far away (Haines et al. 2019).
float meet(vec4 sphere, vec2 slope) {
    vec3 ray = vec3(slope, 1.0);
    float along, square;
    vec3 miss;
    if (orthographic != 0) {
        along = sphere.z;
        square = 1.0;
        miss = vec3(sphere.xy - slope, 0.0);
    } else {
        square = dot(ray, ray);
        along = dot(sphere.xyz, ray) / square;
        miss = sphere.xyz - along * ray;
    }
    float rest = sphere.w * sphere.w - dot(miss, miss);
    if (rest < 0.0) return -1.0;
    float half_chord = sqrt(rest / square);
    float entry = along - half_chord;
    return entry > 0.0 ? entry : along + half_chord;  // from within, the far side
}
)";

// An octagon around the silhouette: seen from the eye the sphere is exactly the circle in which the tangent
// cone cuts the plane through its centre across the line of sight. Where the octagon would reach the eye's
// plane the whole picture is taken instead, so a sphere close up never vanishes.
const char* const nearest_vertex = R"(
layout(location = 0) in vec4 sphere;
uniform vec2 size;  // pixels
flat out vec4 grain;
flat out uint number;
void main() {
    grain = sphere;
    number = uint(gl_InstanceID + 1);
    float angle = 0.78539816 * float(gl_VertexID);
    vec2 turn = 1.0824 * vec2(cos(angle), sin(angle));  // 1 / cos(pi / 8): around the circle
    vec2 scale = 2.0 * focal / size;
    if (orthographic != 0) {
        gl_Position = vec4((sphere.xy + sphere.w * turn) * scale, 0.0, 1.0);
        return;
    }
    float away = length(sphere.xyz);
    vec3 axis = sphere.xyz / away;
    float ratio = min(sphere.w / away, 0.9999);
    float reach = sphere.w / sqrt(1.0 - ratio * ratio);
    float nearest = sphere.z - 1.0824 * reach * sqrt(max(0.0, 1.0 - axis.z * axis.z));
    if (sphere.z + sphere.w <= 0.0) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // behind the eye
    } else if (nearest < 0.01 * away || ratio > 0.999) {
        gl_Position = vec4(2.0 * turn, 0.0, 1.0);
    } else {
        vec3 side = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
        vec3 other = cross(axis, side);
        vec3 corner = sphere.xyz + reach * (turn.x * side + turn.y * other);
        gl_Position = vec4(corner.xy * scale, 0.0, corner.z);
    }
}
)";

// A miss writes the farthest depth, which fails the depth test: cheaper than discard.
const char* const nearest_fragment = R"(
flat in vec4 grain;
flat in uint number;
uniform vec2 depth_range;  // m, stored as 0 and 1
out uint seen;
void main() {
    float away = meet(grain, slope_at(gl_FragCoord.xy));
    seen = number;
    gl_FragDepth = away < 0.0 ? 1.0
        : clamp((away - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 0.9999999);
}
)";

const char* const light_vertex = R"(
uniform vec4 box;  // where grains are, in clip coordinates: low corner, high corner
void main() {
    vec2 at = vec2((gl_VertexID & 1) == 0 ? box.x : box.z, (gl_VertexID & 2) == 0 ? box.y : box.w);
    gl_Position = vec4(at, 0.0, 1.0);
}
)";

// Where all four neighbours show the same grain one sample at the centre serves. Elsewhere the grains seen
// around are met again at eight points of the pixel: exact silhouettes and lines of intersection, and each
// grain is lit once, at the mean of its points.
const char* const light_fragment = R"(
uniform usampler2D seen;
uniform samplerBuffer spheres, crowding, colours;
uniform vec3 world_up;  // in view coordinates
out vec4 result;

const vec2 points[8] = vec2[8](
    vec2(0.0625, -0.1875), vec2(-0.0625, 0.1875), vec2(0.3125, 0.0625), vec2(-0.1875, -0.3125),
    vec2(-0.3125, 0.3125), vec2(-0.4375, -0.0625), vec2(0.1875, 0.4375), vec2(0.4375, -0.4375));

vec3 lit(int i, vec4 sphere, vec2 slope) {
    vec3 ray = orthographic != 0 ? vec3(0.0, 0.0, 1.0) : vec3(slope, 1.0);
    float square = dot(ray, ray);
    float along = orthographic != 0 ? sphere.z : dot(sphere.xyz, ray) / square;
    vec3 foot = orthographic != 0 ? vec3(slope, along) : along * ray;
    vec3 miss = foot - sphere.xyz;
    float rest = max(sphere.w * sphere.w - dot(miss, miss), 0.0);
    float half_chord = sqrt(rest / square);
    float back = along - half_chord > 0.0 ? -half_chord : half_chord;
    vec3 normal = (miss + back * ray) / sphere.w;
    float facing = clamp(abs(dot(normal, ray)) * inversesqrt(square), 0.0, 1.0);

    vec4 around = texelFetch(crowding, i);
    float open = clamp(1.0 - CROWDING * (around.w + dot(around.xyz, normal)), 0.25, 1.0);
    vec3 to_light = normalize(KEY_DIRECTION);
    float open_to_light = clamp(1.0 - CROWDING * (around.w + dot(around.xyz, to_light)), 0.3, 1.0);
    float fall = dot(normal, to_light);
    float key = KEY * max(0.0, 0.15 + 0.85 * fall) * mix(open_to_light, 1.0, 0.35);
    float ambient = mix(GROUND, SKY, 0.5 + 0.5 * dot(normal, world_up)) * open;
    float edge = smoothstep(0.0, RIM_WIDTH, facing);
    vec3 halfway = normalize(to_light - ray * inversesqrt(square));
    float shine = SHINE * pow(max(0.0, dot(normal, halfway)), SHINE_POWER) * open_to_light;
    return texelFetch(colours, i).rgb * (ambient + key) * mix(RIM, 1.0, edge) + shine;
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(seen, 0) - 1;
    uint own = texelFetch(seen, here, 0).x;
    uint left = texelFetch(seen, ivec2(max(here.x - 1, 0), here.y), 0).x;
    uint right = texelFetch(seen, ivec2(min(here.x + 1, last.x), here.y), 0).x;
    uint below = texelFetch(seen, ivec2(here.x, max(here.y - 1, 0)), 0).x;
    uint above = texelFetch(seen, ivec2(here.x, min(here.y + 1, last.y)), 0).x;
    result = vec4(0.0);
    if ((own | left | right | below | above) == 0u) return;
    if (own == left && own == right && own == below && own == above) {
        int i = int(own) - 1;
        result = vec4(lit(i, texelFetch(spheres, i), slope_at(gl_FragCoord.xy)), 1.0);
        return;
    }
    uint grain[5] = uint[5](own, left, right, below, above);
    if (left == own) grain[1] = 0u;
    if (right == own || right == left) grain[2] = 0u;
    if (below == own || below == left || below == right) grain[3] = 0u;
    if (above == own || above == left || above == right || above == below) grain[4] = 0u;
    float nearest[8] = float[8](1e30, 1e30, 1e30, 1e30, 1e30, 1e30, 1e30, 1e30);
    int winner[8] = int[8](-1, -1, -1, -1, -1, -1, -1, -1);
    for (int k = 0; k < 5; ++k) {
        if (grain[k] == 0u) continue;
        vec4 sphere = texelFetch(spheres, int(grain[k]) - 1);
        for (int s = 0; s < 8; ++s) {
            float away = meet(sphere, slope_at(gl_FragCoord.xy + points[s]));
            bool closer = away >= 0.0 && away < nearest[s];
            nearest[s] = closer ? away : nearest[s];
            winner[s] = closer ? k : winner[s];
        }
    }
    for (int k = 0; k < 5; ++k) {
        if (grain[k] == 0u) continue;
        vec2 sum = vec2(0.0);
        float hits = 0.0;
        for (int s = 0; s < 8; ++s)
            if (winner[s] == k) { sum += points[s]; hits += 1.0; }
        if (hits == 0.0) continue;
        int i = int(grain[k]) - 1;
        vec3 colour = lit(i, texelFetch(spheres, i), slope_at(gl_FragCoord.xy + sum / hits));
        result += vec4(colour, 1.0) * (hits / 8.0);
    }
}
)";

std::string light_constants() {
    const auto& to_key = light::key_direction;
    return fmt::format("const vec3 KEY_DIRECTION = vec3({:.4f}, {:.4f}, {:.4f});\n", to_key[0], to_key[1],
                       to_key[2]) +
           fmt::format("const float KEY = {:.4f}, SKY = {:.4f}, GROUND = {:.4f}, RIM = {:.4f};\n", light::key,
                       light::sky, light::ground, light::rim) +
           fmt::format("const float RIM_WIDTH = {:.4f}, SHINE = {:.4f}, SHINE_POWER = {:.4f}, CROWDING = {:.4f};\n",
                       light::rim_width, light::shine, light::shine_power, light::crowding);
}

}  // namespace

ShaderPair nearest_grain_shaders() {
    return {std::string(header) + nearest_vertex, std::string(header) + nearest_fragment};
}

ShaderPair grain_light_shaders() {
    return {std::string("#version 330 core\n") + light_vertex,
            std::string(header) + light_constants() + light_fragment};
}

}  // namespace grainreel
