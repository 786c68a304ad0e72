#include "engine/questions/along_ray.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace grainreel {
namespace {

AnswerTable table_of(const Snapshot& s, const Frame& shown, const Ray& ray, const AlongRay& along,
                     bool through) {
    AnswerTable table{"pixel",
                      "At that pixel, the nearest first",
                      {{"id", Dimension::number, "empty of a wall"},
                       {"what", Dimension::number, "species or wall"},
                       {"seen", Dimension::number, "no: it lies behind another"},
                       {"distance", Dimension::length, "from the eye"},
                       {"height", Dimension::length, "of the point above the floor"}},
                      {}};
    const double length = ray.direction.norm();
    bool covered = false;
    const auto add = [&](AnswerCell id, const std::string& what, bool seen, double at) {
        table.rows.push_back({std::move(id), what, seen ? "yes" : "no", at * length,
                              (ray.at(at) - floor_offset(s.scene, shown)).z()});
    };
    const std::vector<MeshOnRay> meshes = meshes_on(ray, s.scene, shown, along.kept);
    auto mesh = meshes.begin();
    // Meshes are glass: they hide nothing.
    const auto add_meshes = [&](double before) {
        for (; mesh != meshes.end() && mesh->at < before && (!covered || through); ++mesh)
            add(AnswerCell(), fmt::format("{}, triangle {}", s.scene.meshes[mesh->mesh].name, mesh->triangle),
                !covered, mesh->at);
    };
    for (const GrainOnRay& one : grains_on(ray, shown, along.kept)) {
        add_meshes(one.from);
        if (covered && !through) break;
        const std::int32_t species = shown.species[one.grain];
        const bool ghost = std::count(along.seen_through.begin(), along.seen_through.end(), species) > 0;
        add(static_cast<std::int64_t>(shown.id[one.grain]),
            s.scene.species.at(static_cast<std::size_t>(species)).name + (ghost ? " (ghost)" : ""), !covered,
            one.from);
        covered |= !ghost;
    }
    add_meshes(std::numeric_limits<double>::infinity());
    if (const auto wall = wall_behind(ray, s.scene, shown); wall && (!covered || through))
        add(AnswerCell(), wall->name, !covered, wall->at);
    return table;
}

}  // namespace

Answer along_ray_answer(const Snapshot& snapshot, const Frame& shown, const Ray& ray, const AlongRay& along,
                        bool through) {
    Answer answer{{table_of(snapshot, shown, ray, along, through)}, {}};
    if (answer.tables[0].rows.empty()) answer.notes.emplace_back("nothing is at that pixel");
    return answer;
}

}  // namespace grainreel
