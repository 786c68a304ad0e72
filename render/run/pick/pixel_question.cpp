#include "render/run/pick/pixel_question.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/draw/camera/camera_path.hpp"
#include "render/draw/camera/exaggeration.hpp"
#include "render/draw/grains/shown_grains.hpp"
#include "render/draw/words/layout.hpp"

namespace grainreel {
namespace {

View view_of(const Scene& scene, const Frame& shown, double film_time) {
    const View view = CameraPath(scene, plan_layout(scene)).at(film_time);
    return scene.film.camera.follow ? view.moved_by(shown.container().place) : view;
}

bool is_ghost(const Scene& scene, std::int32_t species) {
    const auto& ghosts = scene.film.shows.ghosts;
    return std::find(ghosts.begin(), ghosts.end(), static_cast<std::size_t>(species)) != ghosts.end();
}

AnswerTable table_of(const Snapshot& s, const Frame& shown, const Ray& ray, bool through) {
    AnswerTable table{"pixel",
                      "At that pixel, the nearest first",
                      {{"id", Dimension::number, "empty of a wall"},
                       {"what", Dimension::number, "species or wall"},
                       {"seen", Dimension::number, "no: it lies behind another"},
                       {"distance", Dimension::length, "from the eye"},
                       {"height", Dimension::length, "of the point above the floor"}},
                      {}};
    std::vector<KeptHalf> kept;
    for (const HalfSpace& half : kept_by_cut(s.scene.film.look.cut, shown))
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
        const bool ghost = is_ghost(s.scene, species);
        add(static_cast<std::int64_t>(shown.id[one.grain]),
            s.scene.species.at(static_cast<std::size_t>(species)).name + (ghost ? " (ghost)" : ""), !covered,
            one.from);
        covered |= !ghost;
    }
    if (const auto wall = wall_behind(ray, s.scene, shown); wall && (!covered || through))
        add(AnswerCell(), wall->name, !covered, wall->at);
    return table;
}

}  // namespace

Ray ray_of(const Snapshot& s, const PixelQuestion& question) {
    Exaggeration exaggeration(s.scene.film.exaggerate);
    const View view = view_of(s.scene, exaggeration.shown(s.frame), question.film_time);
    const double x = question.x - view.port.x, y = question.y - view.port.y;
    if (!(x >= 0 && y >= 0 && x < view.port.width && y < view.port.height))
        throw UserError(fmt::format(
            "{:g},{:g} is outside the part of the picture that shows the bed, from {},{} to {},{}",
            question.x, question.y, view.port.x, view.port.y, view.port.x + view.port.width - 1,
            view.port.y + view.port.height - 1));
    const double right = (x + 0.5 - 0.5 * view.port.width) / view.focal;
    const double up = (0.5 * view.port.height - y - 0.5) / view.focal;
    const Vec3 aside = right * view.right + up * view.up;
    if (view.orthographic) return {view.eye + aside, view.forward};
    return {view.eye, view.forward + aside};
}

Answer pixel_answer(const Snapshot& s, const PixelQuestion& question) {
    Exaggeration exaggeration(s.scene.film.exaggerate);
    ShownGrains not_hidden(s.scene, s.scene.film.shows.hidden);
    const Frame& shown = not_hidden.of(exaggeration.shown(s.frame));
    Answer answer{{table_of(s, shown, ray_of(s, question), question.through)}, {}};
    if (answer.tables[0].rows.empty()) answer.notes.emplace_back("nothing is at that pixel");
    return answer;
}

}  // namespace grainreel
