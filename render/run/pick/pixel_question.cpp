#include "render/run/pick/pixel_question.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/camera/exaggeration.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

View view_of(const FilmedScene& scene, const Frame& shown, double film_time) {
    const View view = CameraPath(scene, plan_layout(scene)).at(film_time);
    return scene.film.camera.follow ? view.moved_by(shown.container().place) : view;
}

bool is_ghost(const FilmedScene& scene, std::int32_t species) {
    const auto& ghosts = scene.film.shows.ghosts;
    return std::find(ghosts.begin(), ghosts.end(), static_cast<std::size_t>(species)) != ghosts.end();
}

AnswerTable table_of(const FilmedScene& scene, const Frame& shown, const Ray& ray, bool through) {
    AnswerTable table{"pixel",
                      "At that pixel, the nearest first",
                      {{"id", Dimension::number, "empty of a wall"},
                       {"what", Dimension::number, "species or wall"},
                       {"seen", Dimension::number, "no: it lies behind another"},
                       {"distance", Dimension::length, "from the eye"},
                       {"height", Dimension::length, "of the point above the floor"}},
                      {}};
    std::vector<KeptHalf> kept;
    for (const HalfSpace& half : kept_by_cut(scene.film.look.cut, shown))
        kept.push_back({half.normal, half.distance});
    const double length = ray.direction.norm();
    bool covered = false;
    const auto add = [&](AnswerCell id, const std::string& what, bool seen, double at) {
        table.rows.push_back(
            {std::move(id), what, seen ? "yes" : "no", at * length, (ray.at(at) - shown.floor().place).z()});
    };
    for (const GrainOnRay& one : grains_on(ray, shown, kept)) {
        if (covered && !through) break;
        const std::int32_t species = shown.species[one.grain];
        const bool ghost = is_ghost(scene, species);
        add(static_cast<std::int64_t>(shown.id[one.grain]),
            scene.species.at(static_cast<std::size_t>(species)).name + (ghost ? " (ghost)" : ""), !covered,
            one.from);
        covered |= !ghost;
    }
    if (const auto wall = wall_behind(ray, scene, shown); wall && (!covered || through))
        add(AnswerCell(), wall->name, !covered, wall->at);
    return table;
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
    Answer answer{{table_of(scene_, shown_, ray(x, y), through)}, {}};
    if (answer.tables[0].rows.empty()) answer.notes.emplace_back("nothing is at that pixel");
    return answer;
}

}  // namespace grainreel
