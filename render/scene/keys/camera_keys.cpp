// The keys of [film.camera] and [[film.camera.key]]: where the camera stands and how it moves.
#include <fmt/format.h>

#include <cmath>

#include "engine/base/numbers.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/film.hpp"
#include "render/scene/keys/film_keys.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

using namespace keys;

constexpr double least_field_of_view = 0.1;  // degrees; the eye stands 600 picture heights away
const Range magnification{0.001, 10000, false, false};
const Range quarter_turns{-90, 90, false, false};

const char* beside_position(const Camera& camera) {
    return camera.position ? "the camera stands at 'position' and looks at 'target'" : nullptr;
}

const char* without_reach(const Camera& camera) {
    if (const char* reason = beside_position(camera)) return reason;
    return camera.frame != FramingScope::reach ? "'frame' does not ask how high the grains get" : nullptr;
}

const char* without_orbit(const Camera& camera) {
    return camera.orbit == 0 ? "without 'orbit' nothing turns" : nullptr;
}

// The upward direction: against gravity, so that a slope is seen as a slope; z without gravity and where it
// points straight upwards.
Vec3 usual_up(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    const bool tilted = scene.gravity.x() != 0 || scene.gravity.y() != 0;
    if (gravity <= 0 || !tilted) return {0, 0, 1};
    return (Vec3(0, 0, 0) - scene.gravity) / gravity;  // so that no component is -0
}

enum Place { of_position, of_frame, of_angles };  // groups of keys, in the order in which they are written

const KeyTable<Camera>& camera_table() {
    using C = Camera;
    static const KeyTable<C> table{
        quantity("azimuth", &C::azimuth, Dimension::degrees, any, initial(),
                 "About z; 0 looks along -x at the wide face, positive goes to the right.")
            .useless_for(beside_position)
            .written_at(of_angles),
        quantity("elevation", &C::elevation, Dimension::degrees, quarter_turns, initial(),
                 "Above the horizon.")
            .useless_for(beside_position)
            .written_at(of_angles),
        quantity("field_of_view", &C::field_of_view, Dimension::degrees, {0, 120, false, false}, initial(),
                 "Vertical; 0 for orthographic.")
            .written_at(of_angles),
        quantity("zoom", &C::zoom, Dimension::number, magnification, initial(),
                 "Times the automatic size. At 1 the picture lies between the margins for words, otherwise "
                 "it fills the frame, as film.words says.")
            .written_at(of_angles),
        flag("follow", &C::follow, initial(), "Stand in the container's own frame.").written_at(of_angles),
        choice("frame", &C::frame, camera_frame_words, initial(),
               "Framed: all of the container, the bed at rest, or what the grains reach.")
            .useless_for(beside_position)
            .read_at(-1)
            .written_at(of_frame),
        quantity("reach", &C::reach, Dimension::length, positive,
                 note("of a live run estimated, of a finished one measured"),
                 "Height above the floor that the grains reach.")
            .useless_for(without_reach)
            .written_at(of_frame),
        vector("position", &C::position, Dimension::length,
               note("by azimuth, elevation and automatic framing"),
               "Where the camera stands; nothing is framed then.")
            .excludes({"azimuth", "elevation", "frame", "reach", "key"})
            .read_at(-2),
        vector("target", &C::target, Dimension::length, note("the container's middle"),
               "The middle of the picture, and what an orbit turns about."),
        vector("up", &C::up, Dimension::number, note("against gravity"),
               "The picture's upward direction; azimuth is about it.")
            .usually([](C& camera, const Scene& scene) { camera.up = usual_up(scene); })
            .unwritten_if([](const C& camera) { return camera.up == Vec3(0, 0, 1); }),
        quantity("orbit", &C::orbit, Dimension::degrees, any, initial(),
                 "Turned about the vertical through the target; negative to the left.")
            .unwritten_if(without_orbit)
            .written_at(of_angles),
        quantity("orbit_time", &C::orbit_time, Dimension::time, positive, note("the film's length"),
                 "Film time in which the orbit is turned; it goes on after that.")
            .useless_for(without_orbit)
            .written_at(of_angles),
    };
    return table;
}

const KeyTable<CameraKey>& moment_table() {
    using K = CameraKey;
    const Fallback between = note("film.camera's at first, then between keys");
    static const KeyTable<K> table{
        quantity("time", &K::time, Dimension::time, not_negative, required(),
                 "Film time at which the camera is there; smoothly in between."),
        quantity("azimuth", &K::azimuth, Dimension::degrees, any, between,
                 "As film.camera.azimuth; beyond 360 it turns on."),
        quantity("elevation", &K::elevation, Dimension::degrees, quarter_turns, between,
                 "As film.camera.elevation."),
        quantity("zoom", &K::zoom, Dimension::number, magnification, between, "As film.camera.zoom."),
        vector("target", &K::target, Dimension::length, between, "As film.camera.target."),
    };
    return table;
}

void check_field_of_view(const Document& document, const Camera& camera) {
    const char* const path = "film.camera.field_of_view";
    if (camera.field_of_view > 0 && camera.field_of_view < least_field_of_view)
        document.fail(path, fmt::format("must be 0, orthographic, or at least {}, but is {}; write 0",
                                        least_field_of_view, document.written_value(path)));
    if (camera.position && camera.field_of_view == 0)
        document.fail(path,
                      "is 0, orthographic, where the picture does not depend on 'position'; give azimuth and "
                      "elevation instead");
}

void read_moments(Document& document, const Scene& scene, Camera& camera) {
    for (std::size_t i = 0; i < document.size("film.camera.key"); ++i) {
        const std::string table = fmt::format("film.camera.key[{}]", i);
        CameraKey key;
        moment_table().read(document, scene, table, key);
        if (!camera.keys.empty() && !clearly_more(key.time, camera.keys.back().time))
            document.fail(table + ".time",
                          fmt::format("is {:.6g} s, not later than the key before, {:.6g} s; put "
                                      "the keys in order",
                                      key.time, camera.keys.back().time));
        camera.keys.push_back(key);
    }
}

}  // namespace

void list_camera(Keys& all) {
    camera_table().list(all, "film.camera");
    moment_table().list(all, "film.camera.key[]");
}

void read_camera(Document& document, FilmedScene& scene) {
    Camera& camera = scene.film.camera;
    if (document.has("film.camera.key"))
        document.refuse("film.camera.orbit", "the camera goes by its keys; let their azimuth turn");
    camera_table().read(document, scene, "film.camera", camera);
    if (camera.up.norm() < 1e-9)
        document.fail("film.camera.up", "has no direction; write for example [0, 0, 1]");
    // A written scene has a unit vector already, which must stay the same to the bit.
    constexpr double rounding = 1e-12;
    if (std::abs(camera.up.norm() - 1) > rounding) camera.up.normalize();
    if (const char* reason = beside_position(camera)) document.refuse("film.camera.key", reason);
    check_field_of_view(document, camera);
    read_moments(document, scene, camera);
}

void write_camera(SceneText& out, const FilmedScene& scene) {
    const Camera& camera = scene.film.camera;
    out.table("film.camera");
    camera_table().write(out, scene, camera);
    for (const CameraKey& key : camera.keys) {
        out.element("film.camera.key");
        moment_table().write(out, scene, key);
    }
}

}  // namespace grainreel
