// The keys of [[exit]].
#include <fmt/format.h>

#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;

const KeyTable<ExitBox>& exit_table() {
    using E = ExitBox;
    static const KeyTable<E> table{
        vector("low", &E::low, Dimension::length, required(),
               "Lowest corner of a box that does not move: a grain whose centre is in it leaves the run."),
        vector("high", &E::high, Dimension::length, required(), "Highest corner."),
        flag("outside", &E::outside, initial(), "Grains leave where they are not in the box."),
    };
    return table;
}

}  // namespace

void list_exits(Keys& all) {
    exit_table().list(all, "exit[]");
}

void read_exits(Document& document, Scene& scene) {
    exit_table().read_elements(document, scene, "exit", scene.exits);
    for (std::size_t i = 0; i < scene.exits.size(); ++i)
        check_corners(document, fmt::format("exit[{}]", i), scene.exits[i].low, scene.exits[i].high);
}

void write_exits(SceneText& out, const Scene& scene) {
    exit_table().write_elements(out, scene, "exit", scene.exits);
}

}  // namespace grainreel
