// Camera: where it stands and how it moves, and how the walls' motion is shown.
#include <fmt/format.h>

#include "engine/scene/text/reader_parts.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel {
namespace {

constexpr double least_field_of_view = 0.1;  // degrees; the eye stands 600 picture heights away

void read_place(Document& document, Camera& camera) {
    const char* const stands = "the camera stands at 'position' and looks at 'target'";
    camera.position = document.vector("film.camera.position");
    camera.target = document.vector("film.camera.target");
    if (camera.position)
        for (const char* key : {"film.camera.azimuth", "film.camera.elevation", "film.camera.key",
                                "film.camera.frame", "film.camera.reach"})
            document.refuse(key, stands);
    camera.frame = chosen<CameraFrame>(document, "film.camera.frame", camera_frame_words, CameraFrame::reach);
    if (camera.frame != CameraFrame::reach)
        document.refuse("film.camera.reach", "'frame' does not ask how high the grains get");
    camera.reach = document.quantity("film.camera.reach");
    camera.azimuth = document.quantity("film.camera.azimuth").value_or(camera.azimuth);
    camera.elevation = document.quantity("film.camera.elevation").value_or(camera.elevation);
    camera.field_of_view = document.quantity("film.camera.field_of_view").value_or(camera.field_of_view);
    if (camera.field_of_view > 0 && camera.field_of_view < least_field_of_view)
        document.fail("film.camera.field_of_view",
                      fmt::format("must be 0, orthographic, or at least {}, but is {}; write 0",
                                  least_field_of_view, document.written_value("film.camera.field_of_view")));
    if (camera.position && camera.field_of_view == 0)
        document.fail("film.camera.field_of_view",
                      "is 0, orthographic, where the picture does not depend on 'position'; give azimuth and "
                      "elevation instead");
    camera.zoom = document.quantity("film.camera.zoom").value_or(camera.zoom);
    camera.follow = document.flag("film.camera.follow").value_or(camera.follow);
}

void read_orbit(Document& document, Camera& camera) {
    if (document.has("film.camera.key"))
        document.refuse("film.camera.orbit", "the camera goes by its keys; let their azimuth turn");
    camera.orbit = document.quantity("film.camera.orbit").value_or(camera.orbit);
    if (camera.orbit == 0) document.refuse("film.camera.orbit_time", "without 'orbit' nothing turns");
    camera.orbit_time = document.quantity("film.camera.orbit_time");
}

void read_keys(Document& document, Camera& camera) {
    for (std::size_t i = 0; i < document.size("film.camera.key"); ++i) {
        const std::string table = fmt::format("film.camera.key[{}]", i);
        CameraKey key;
        key.time = document.required_quantity(table + ".time");
        if (!camera.keys.empty() && key.time <= camera.keys.back().time)
            document.fail(table + ".time",
                          fmt::format("is {:.6g} s, not later than the key before, {:.6g} s; put "
                                      "the keys in order",
                                      key.time, camera.keys.back().time));
        key.azimuth = document.quantity(table + ".azimuth");
        key.elevation = document.quantity(table + ".elevation");
        key.zoom = document.quantity(table + ".zoom");
        key.target = document.vector(table + ".target");
        camera.keys.push_back(key);
    }
}

}  // namespace

void read_camera(Document& document, Film& film) {
    read_place(document, film.camera);
    read_orbit(document, film.camera);
    read_keys(document, film.camera);
    film.words = chosen<WordPlace>(document, "film.words", word_place_words, WordPlace::automatic);
    film.axes = document.flag("film.axes").value_or(film.camera.moves());
    film.wall_ghost = document.flag("film.wall_ghost").value_or(film.wall_ghost);
    film.exaggerate = document.quantity("film.exaggerate").value_or(film.exaggerate);
}

}  // namespace grainreel
