#include "render/film/answers/pictured_answer.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/questions/ray.hpp"
#include "render/film/codec/png.hpp"
#include "render/film/production/picture_files.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

View view_of(const FilmedScene& scene, const State& shown, double film_time) {
    const View view = CameraPath(scene, plan_layout(scene)).at(film_time);
    return scene.film.camera.follow ? view.moved_by(way_of_container(scene, shown)) : view;
}

AlongRay along(const FilmedScene& scene, const State& shown) {
    AlongRay along;
    for (const HalfSpace& half : kept_by_cut(scene.film.look.cut, shown))
        along.kept.push_back({half.normal, half.distance});
    for (const std::size_t species : scene.film.shows.ghosts)
        along.seen_through.push_back(static_cast<std::int32_t>(species));
    return along;
}

}  // namespace

PixelPicker::PixelPicker(const Snapshot& s, const FilmedScene& scene, double film_time)
    : snapshot_(s), scene_(scene) {
    Exaggeration exaggeration(scene.film.exaggerate);
    ShownGrains not_hidden(scene, scene.film.shows.hidden);
    const Shot as_asked(s.frame);
    const Shot& shown = exaggeration.shown(as_asked);
    view_ = view_of(scene, shown, film_time);
    shown_ = not_hidden.of(shown);
}

Ray PixelPicker::ray(double at_x, double at_y) const {
    const double x = at_x - view_.port.x, y = at_y - view_.port.y;
    if (!(x >= 0 && y >= 0 && x < view_.port.width && y < view_.port.height))
        throw UserError(
            "{:g},{:g} is outside the part of the picture that shows the bed, from {},{} to {},{}", at_x,
            at_y, view_.port.x, view_.port.y, view_.port.x + view_.port.width - 1,
            view_.port.y + view_.port.height - 1);
    const double right = (x + 0.5 - 0.5 * view_.port.width) / view_.focal;
    const double up = (0.5 * view_.port.height - y - 0.5) / view_.focal;
    const Vec3 aside = right * view_.right + up * view_.up;
    if (view_.orthographic) return {view_.eye + aside, view_.forward};
    return {view_.eye, view_.forward + aside};
}

Answer PixelPicker::at(double x, double y, bool through) const {
    return along_ray_answer(snapshot_, shown_, ray(x, y), along(scene_, shown_), through);
}

namespace {

bool is_among(const std::vector<std::int32_t>& ids, std::int32_t id) {
    return std::binary_search(ids.begin(), ids.end(), id);
}

// Says whether the film's cut takes away one of the grains with these ids.
bool cut_hides(const Snapshot& snapshot, const FilmCut& cut, const std::vector<std::int32_t>& ids) {
    const std::vector<HalfSpace> halves = kept_by_cut(cut, snapshot.frame);
    return std::any_of(ids.begin(), ids.end(), [&](std::int32_t id) {
        const std::optional<std::size_t> grain = snapshot.place_of(id);
        return grain && std::any_of(halves.begin(), halves.end(), [&](const HalfSpace& half) {
                   return half.normal.dot(snapshot.frame.position[*grain]) < half.distance;
               });
    });
}

// The scene as it is drawn for a single moment, without anything that needs earlier moments.
FilmedScene scene_of_moment(FilmedScene scene, const Snapshot& snapshot, const AnswerMarks& marks) {
    FilmShows& shows = scene.film.shows;
    shows.plots.clear();
    shows.wall_forces = {};
    if (needs_measures(shows)) shows.live_words.clear(), shows.text.clear();
    if (needs_displacement(shows)) {
        shows.colour = {}, shows.highlight_if = {}, shows.arrows = {}, shows.streamlines = {};
    }
    if (!snapshot.contacts && needs_touches(shows)) shows.colour = {}, shows.highlight_if = {};
    if (!snapshot.worn) scene.film.look.walls.colour = FilmWalls::Colour::plain;
    scene.film.captions.clear();  // they tell the film's story, not the answer
    shows.trails = {};
    shows.highlighted = marks.grains;
    shows.force_chains = snapshot.contacts && marks.lines && !marks.grains.empty();
    if (!marks.words.empty()) shows.live_words = {{marks.words, "", "", 1}};
    for (const std::int32_t id : marks.grains)
        if (const auto grain = snapshot.place_of(id))
            std::erase(shows.hidden, static_cast<std::size_t>(snapshot.frame.species[*grain]));
    if (cut_hides(snapshot, scene.film.look.cut, marks.grains)) scene.film.look.cut = {};
    return scene;
}

}  // namespace

void check_picture_file(const std::filesystem::path& file) {
    if (file.extension() != ".png") throw UserError("--png {}: name a file that ends in .png", file.string());
    check_folder_around(file, "--png " + file.string());
    if (is_there(file)) throw UserError("--png {}: exists already; choose another name", file.string());
}

void draw_answer(const Snapshot& snapshot, const FilmedScene& filmed, const AnswerMarks& marks,
                 double film_time, const std::filesystem::path& file, gl::Provider provider) {
    const FilmedScene scene = scene_of_moment(filmed, snapshot, marks);
    Shot shot = snapshot.frame;
    shot.displacement = snapshot.displacement;
    shot.touches = snapshot.touches;
    shot.worn = snapshot.worn;
    shot.flowed_out = snapshot.flowed_out;
    if (scene.film.shows.force_chains)
        std::erase_if(shot.touches, [&](const Link& touch) {
            return !is_among(marks.grains, touch.first) && !is_among(marks.grains, touch.second);
        });
    Renderer renderer(scene, drawing_threads(scene.run.threads).raster, provider);
    renderer.point_out({marks.grains, marks.forces});
    renderer.start_from(snapshot.start);
    write_png(file, renderer.draw(shot, "", film_time), texts_of(scene.name, scene.film.title, shot, ""),
              scene.film.transparent);
}

}  // namespace grainreel
