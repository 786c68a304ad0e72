#include "render/film/answers/pixel_question.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/questions/ray.hpp"
#include "render/picture/base/way_of_container.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/camera/exaggeration.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/words/layout.hpp"

namespace grainreel {
namespace {

View view_of(const FilmedScene& scene, const Frame& shown, double film_time) {
    const View view = CameraPath(scene, plan_layout(scene)).at(film_time);
    return scene.film.camera.follow ? view.moved_by(way_of_container(scene, shown)) : view;
}

AlongRay along(const FilmedScene& scene, const Frame& shown) {
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
    const Frame& shown = exaggeration.shown(s.frame);
    view_ = view_of(scene, shown, film_time);
    shown_ = not_hidden.of(shown);
}

Ray PixelPicker::ray(double at_x, double at_y) const {
    const double x = at_x - view_.port.x, y = at_y - view_.port.y;
    if (!(x >= 0 && y >= 0 && x < view_.port.width && y < view_.port.height))
        throw UserError(fmt::format(
            "{:g},{:g} is outside the part of the picture that shows the bed, from {},{} to {},{}", at_x,
            at_y, view_.port.x, view_.port.y, view_.port.x + view_.port.width - 1,
            view_.port.y + view_.port.height - 1));
    const double right = (x + 0.5 - 0.5 * view_.port.width) / view_.focal;
    const double up = (0.5 * view_.port.height - y - 0.5) / view_.focal;
    const Vec3 aside = right * view_.right + up * view_.up;
    if (view_.orthographic) return {view_.eye + aside, view_.forward};
    return {view_.eye, view_.forward + aside};
}

Answer PixelPicker::at(double x, double y, bool through) const {
    return along_ray_answer(snapshot_, shown_, ray(x, y), along(scene_, shown_), through);
}

}  // namespace grainreel
