// The keys of [[wall]].
#include <fmt/format.h>

#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;

const KeyTable<FreeWall>& wall_table() {
    using W = FreeWall;
    static const KeyTable<W> table{
        text("name", &W::name, note("wall 1, wall 2, ..."),
             "A plane anywhere, beside the container's faces or without any; for messages.")
            .usually([](W& wall, const Scene& scene) {
                wall.name = fmt::format("wall {}", scene.walls.size() + 1);
            })
            .decides_nothing(),
        vector("point", &W::point, Dimension::length, required(), "Any point of it."),
        vector("normal", &W::normal, Dimension::number, required(), "Towards the grains; any length."),
        vector("velocity", &W::velocity, Dimension::speed, initial(), "Steady, from the start."),
        flag("moves", &W::moves, initial(), "Follows the drive as well."),
    };
    return table;
}

}  // namespace

void list_walls(Keys& all) {
    wall_table().list(all, "wall[]");
}

void read_walls(Document& document, Scene& scene) {
    for (std::size_t i = 0; i < document.size("wall"); ++i) {
        const std::string path = fmt::format("wall[{}]", i);
        FreeWall wall;
        wall_table().read(document, scene, path, wall);
        make_unit(document, path + ".normal", wall.normal);
        if (wall.moves && !document.has("drive"))
            document.fail(path + ".moves", "follows a drive, but there is none; add [drive] or remove it");
        scene.walls.push_back(wall);
    }
}

void write_walls(SceneText& out, const Scene& scene) {
    wall_table().write_elements(out, scene, "wall", scene.walls);
}

}  // namespace grainreel
