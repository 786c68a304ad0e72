#include "engine/scene/chapters/container_keys.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

using namespace keys;

const KeyTable<Tray>& tray_table() {
    static const KeyTable<Tray> table{
        quantity("depth", &Tray::depth, Dimension::length, positive, note("the container's height"),
                 "Of its floor below the container's floor at rest.")
            .usually([](Tray& tray, const Scene& scene) { tray.depth = scene.container.height; }),
        bound_by<Tray>(
            quantity("width", Dimension::length, positive, note("that of the container"),
                     "Along y; the diameter below a cylinder. A tray is as deep along x as the container."),
            [](Document& document, const Scene& scene, const std::string& path, Tray& tray) {
                tray.half_width =
                    document.has(path) ? document.required_quantity(path) / 2 : scene.container.half_width;
            },
            [](const Tray& tray, const Scene&) { return as_toml(2 * tray.half_width, Dimension::length); }),
    };
    return table;
}

void read_tray(Document& document, const Scene& scene, const std::string& path, Container& container) {
    if (!document.has(path)) return;
    if (!document.is_table(path)) {
        if (document.text(path) != "none")
            document.fail(path, fmt::format("is {}; write {{ depth = \"60 mm\" }}, or \"none\"",
                                            document.written_value(path)));
        return;
    }
    Tray tray;
    tray_table().read(document, scene, path, tray);
    container.tray = tray;
}

[[noreturn]] void fail(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError(fmt::format("{}: '{}' {}", scene.where("container.tray." + key), key, what));
}

}  // namespace

BoundKey<Container> tray_key() {
    const auto write = [](const Container& container, const Scene& scene) {
        return container.tray ? tray_table().inline_text(scene, *container.tray) : std::string();
    };
    return bound_by<Container>(entry("tray", KeyKind::text, literal("\"none\""),
                                     "Or a table: a tray below the outlet catches what flows out, so that no "
                                     "grain leaves. It stands still, and its walls reach up to the floor."),
                               read_tray, write)
        .holding(tray_table());
}

void check_tray(const Scene& scene) {
    const Container& c = scene.container;
    if (!c.tray) return;
    if (!c.outlet)
        throw UserError(
            fmt::format("{}: 'tray' is of no use below a closed floor; add 'outlet', or remove it",
                        scene.where("container.tray")));
    if (clearly_less(c.tray->half_width, c.floor_half_width()))
        fail(scene, "width",
             fmt::format("of {:.6g} m is less than that of the container's floor, {:.6g} m; widen it",
                         2 * c.tray->half_width, 2 * c.floor_half_width()));
    const double room = tray_container(scene).height, largest = largest_diameter(scene);
    if (room < largest - kSameDecimals * c.tray->depth)
        fail(scene, "depth",
             fmt::format("of {:.6g} m leaves {:.6g} m below the floor where that is lowest, less than the "
                         "largest grain, {:.6g} m; deepen it",
                         c.tray->depth, room, largest));
}

}  // namespace grainreel
