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

// Four lines of sight at once, through pixel positions.
struct Sight {
    vec4 x, y, inverse;  // slopes; 1 / length squared of the direction
};
Sight sight(vec4 pixel_x, vec4 pixel_y) {
    vec4 x = (pixel_x - centre.x) / focal, y = (pixel_y - centre.y) / focal;
    return Sight(x, y, 1.0 / (x * x + y * y + 1.0));
}

// Distance along z at which they meet the sphere, or a very long way. The discriminant comes from the point of
// closest approach (see visibility.cpp).
vec4 meet(vec4 sphere, Sight to) {
    if (orthographic != 0) {
        vec4 dx = sphere.x - to.x, dy = sphere.y - to.y;
        vec4 rest = sphere.w * sphere.w - (dx * dx + dy * dy);
        return mix(sphere.z - sqrt(max(rest, 0.0)), vec4(2e30), lessThan(rest, vec4(0.0)));
    }
    vec4 along = (sphere.x * to.x + sphere.y * to.y + sphere.z) * to.inverse;
    vec4 dx = sphere.x - along * to.x, dy = sphere.y - along * to.y, dz = sphere.z - along;
    vec4 rest = sphere.w * sphere.w - (dx * dx + dy * dy + dz * dz);
    vec4 half_chord = sqrt(max(rest, 0.0) * to.inverse);
    vec4 entry = along - half_chord;
    vec4 away = mix(along + half_chord, entry, greaterThan(entry, vec4(0.0)));  // from within, the far side
    return mix(away, vec4(2e30), lessThan(min(rest, away), vec4(0.0)));
}
)";

const char* const light_vertex = R"(
uniform vec4 box;  // where grains are, in clip coordinates: low corner, high corner
void main() {
    vec2 at = vec2((gl_VertexID & 1) == 0 ? box.x : box.z, (gl_VertexID & 2) == 0 ? box.y : box.w);
    gl_Position = vec4(at, 0.0, 1.0);
}
)";

// Away from edges one sample at the pixel's centre serves. On an edge the grains that the pixel and its
// neighbours show are met again at eight points: exact silhouettes and lines of intersection, and each grain
// is lit once, at the mean of its points. All spelt out in vectors of four: indexed arrays are slow on
// llvmpipe.
const char* const light_fragment = R"(
uniform usampler2D seen;
uniform samplerBuffer spheres, crowding, colours;
uniform vec3 world_up;  // in view coordinates
out vec4 result;

const uint EDGE = 0x80000000u;
const vec4 X1 = vec4(0.0625, -0.0625, 0.3125, -0.1875), Y1 = vec4(-0.1875, 0.1875, 0.0625, -0.3125);
const vec4 X2 = vec4(-0.3125, -0.4375, 0.1875, 0.4375), Y2 = vec4(0.3125, -0.0625, 0.4375, -0.4375);

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

// sRGB from linear light, by square roots alone: within 0.3 % of the exact curve (C. Taylor, chilliant.com 2012).
vec3 encoded(vec3 linear) {
    vec3 a = sqrt(linear), b = sqrt(a), c = sqrt(b);
    return clamp(0.585122381 * a + 0.783140355 * b - 0.368262736 * c, 0.0, 1.0);
}

struct Nearest {
    vec4 away1, away2;    // at the eight points
    vec4 owner1, owner2;  // which candidate is nearest there
};

void compete(inout Nearest best, Sight sight1, Sight sight2, uint grain, float candidate) {
    vec4 sphere = texelFetch(spheres, int(grain) - 1);
    vec4 away1 = meet(sphere, sight1), away2 = meet(sphere, sight2);
    bvec4 closer1 = lessThan(away1, best.away1), closer2 = lessThan(away2, best.away2);
    best.away1 = mix(best.away1, away1, closer1);
    best.away2 = mix(best.away2, away2, closer2);
    best.owner1 = mix(best.owner1, vec4(candidate), closer1);
    best.owner2 = mix(best.owner2, vec4(candidate), closer2);
}

uint at(ivec2 pixel, ivec2 last) { return texelFetch(seen, clamp(pixel, ivec2(0), last), 0).x & ~EDGE; }

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    uint mark = texelFetch(seen, here, 0).x;
    if (mark == 0u) discard;
    bool edge = (mark & EDGE) != 0u;
    uint first = mark & ~EDGE, second = 0u, third = 0u, fourth = 0u;
    Nearest best = Nearest(vec4(1e30), vec4(1e30), vec4(0.0), vec4(0.0));
    if (edge) {
        // Different grains only, moved up: neighbouring pixels then run the same, few steps together.
        ivec2 last = textureSize(seen, 0) - 1;
        second = at(here - ivec2(1, 0), last);
        third = at(here + ivec2(1, 0), last);
        fourth = at(here - ivec2(0, 1), last);
        uint fifth = at(here + ivec2(0, 1), last);
        second = second == first ? 0u : second;
        third = third == first || third == second ? 0u : third;
        fourth = fourth == first || fourth == second || fourth == third ? 0u : fourth;
        fifth = fifth == first || fifth == second || fifth == third || fifth == fourth ? 0u : fifth;
        if (fourth == 0u) { fourth = fifth; fifth = 0u; }
        if (third == 0u) { third = fourth; fourth = fifth; fifth = 0u; }
        if (second == 0u) { second = third; third = fourth; fourth = fifth; }
        if (first == 0u) { first = second; second = third; third = fourth; fourth = 0u; }
        Sight sight1 = sight(gl_FragCoord.x + X1, gl_FragCoord.y + Y1);
        Sight sight2 = sight(gl_FragCoord.x + X2, gl_FragCoord.y + Y2);
        compete(best, sight1, sight2, first, 1.0);
        if (second != 0u) compete(best, sight1, sight2, second, 2.0);
        if (third != 0u) compete(best, sight1, sight2, third, 3.0);
        if (fourth != 0u) compete(best, sight1, sight2, fourth, 4.0);
    }
    result = vec4(0.0);
    uint grain = first;
    for (float candidate = 1.0; candidate < 4.5; candidate += 1.0) {
        float hits = 8.0;
        vec2 middle = vec2(0.0);
        if (edge) {
            vec4 won1 = vec4(equal(best.owner1, vec4(candidate))), won2 = vec4(equal(best.owner2, vec4(candidate)));
            hits = dot(won1, vec4(1.0)) + dot(won2, vec4(1.0));
            middle = vec2(dot(won1, X1) + dot(won2, X2), dot(won1, Y1) + dot(won2, Y2)) / max(hits, 1.0);
        }
        if (hits > 0.0) {
            int i = int(grain) - 1;
            vec3 colour = lit(i, texelFetch(spheres, i), slope_at(gl_FragCoord.xy + middle));
            result += vec4(colour, 1.0) * (hits * 0.125);
        }
        grain = second;
        second = third;
        third = fourth;
        fourth = 0u;
        if (grain == 0u) break;
    }
    if (result.a > 0.0) result.rgb = encoded(result.rgb / result.a) * result.a;
}
)";

std::string light_constants() {
    const auto& to_key = light::key_direction;
    return fmt::format("const vec3 KEY_DIRECTION = vec3({:.4f}, {:.4f}, {:.4f});\n", to_key[0], to_key[1],
                       to_key[2]) +
           fmt::format("const float KEY = {:.4f}, SKY = {:.4f}, GROUND = {:.4f}, RIM = {:.4f};\n", light::key,
                       light::sky, light::ground, light::rim) +
           fmt::format(
               "const float RIM_WIDTH = {:.4f}, SHINE = {:.4f}, SHINE_POWER = {:.4f}, CROWDING = {:.4f};\n",
               light::rim_width, light::shine, light::shine_power, light::crowding);
}

}  // namespace

ShaderPair grain_light_shaders() {
    return {std::string("#version 330 core\n") + light_vertex,
            std::string(header) + light_constants() + light_fragment};
}

}  // namespace grainreel
