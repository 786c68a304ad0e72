// The keys of container.outlet and container.tray, and their checks.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/container_keys.hpp"

namespace grainreel {

namespace {

using namespace keys;
using Shape = Outlet::Shape;

// The key of a slot's width or a hole's diameter.
BoundKey<Outlet> size(const char* name, Shape shape, const char* about) {
    return bound_by<Outlet>(
        quantity(name, Dimension::length, positive, note("one of the two"), about),
        [shape](Document& document, const Scene&, const std::string& path, Outlet& outlet) {
            if (!document.has(path)) return;
            outlet.half_width = document.required_quantity(path) / 2;
            outlet.shape = shape;
        },
        [](const Outlet& outlet, const Scene&) { return as_toml(2 * outlet.half_width, Dimension::length); });
}

const char* not_of_slot(const Outlet& outlet) {
    return outlet.shape == Shape::slot && outlet.half_width > 0 ? "'width' says how wide the slot is"
                                                                : nullptr;
}

const KeyTable<Outlet>& outlet_table() {
    static const KeyTable<Outlet> table{
        size("width", Shape::slot, "Of a slot over the whole depth; wedge, box.")
            .unwritten_if([](const Outlet& outlet) { return outlet.shape != Shape::slot; }),
        size("diameter", Shape::hole, "Of a round hole; box, cylinder.")
            .excludes({"width"})
            .useless_for(not_of_slot),
        quantity("opens", &Outlet::opens, Dimension::time, not_negative, initial(),
                 "When, since the drive started; until then the floor is closed."),
        quantity("exit_depth", &Outlet::exit_depth, Dimension::length, positive,
                 note("half of the container's height"),
                 "Below the floor's rest position: grains that have fallen so deep leave the run.")
            .usually(
                [](Outlet& outlet, const Scene& scene) { outlet.exit_depth = 0.5 * scene.container.height; }),
    };
    return table;
}

void read_outlet(Document& document, const Scene& scene, const std::string& path, Container& container) {
    if (!document.has(path)) return;
    if (!document.is_table(path)) {
        if (document.text(path) != "closed")
            document.fail(path, fmt::format("is {}; write {{ width = \"20 mm\" }} for a slot, {{ diameter = "
                                            "\"20 mm\" }} for a round hole, or \"closed\"",
                                            document.written_value(path)));
        return;
    }
    Outlet outlet;
    outlet_table().read(document, scene, path, outlet);
    if (outlet.half_width == 0)
        document.fail(path,
                      "has no size; write width = \"20 mm\" for a slot, or diameter = \"20 mm\" for a "
                      "round hole");
    container.outlet = outlet;
}

[[noreturn]] void fail(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError("{}: '{}' {}", scene.where("container.outlet." + key), key, what);
}

void check_shape(const Scene& scene, const std::string& size) {
    const bool slot = scene.container.outlet->shape == Shape::slot;
    if (slot && scene.container.shape == Container::Shape::cylinder)
        fail(scene, size, "is that of a slot, but a cylinder has a round hole; write 'diameter'");
    if (!slot && scene.container.shape == Container::Shape::wedge)
        fail(scene, size, "is that of a round hole, but a wedge has a slot; write 'width'");
}

}  // namespace

BoundKey<Container> outlet_key() {
    const auto write = [](const Container& container, const Scene& scene) {
        return container.outlet ? outlet_table().inline_text(scene, *container.outlet) : quoted("closed");
    };
    return bound_by<Container>(
               entry("outlet", KeyKind::text, literal("\"closed\""),
                     "Or a table: an opening in the middle of the floor, through which grains leave."),
               read_outlet, write)
        .holding(outlet_table());
}

void check_outlet(const Scene& scene) {
    const Container& c = scene.container;
    if (!c.outlet) return;
    const bool slot = c.outlet->shape == Shape::slot;
    const std::string size = slot ? "width" : "diameter";
    check_shape(scene, size);
    const double wide = 2 * c.outlet->half_width, floor = 2 * c.floor_half_width();
    const bool box_with_hole = !slot && c.shape == Container::Shape::box && !c.periodic_depth;
    const double room = box_with_hole ? std::min(floor, c.depth) : floor;
    if (clearly_more(wide, room))
        fail(scene, size,
             fmt::format("of {:.6g} m is wider than the floor, {:.6g} m; narrow the outlet", wide, room));
    const Species& big = *std::max_element(
        scene.species.begin(), scene.species.end(),
        [](const Species& a, const Species& b) { return a.diameter.largest < b.diameter.largest; });
    const double largest = big.diameter.largest;
    if (clearly_less(wide, largest))
        fail(scene, size,
             fmt::format(
                 "of {:.6g} m lets no grain of \"{}\" pass, which is up to {:.6g} m wide; widen the outlet",
                 wide, big.name, largest));
    const double stroke = 2 * scene.drive.largest_amplitude() * std::abs(scene.drive.direction.z());
    const double least = stroke + 0.5 * largest;
    if (clearly_less(c.outlet->exit_depth, least))
        fail(scene, "exit_depth",
             fmt::format("is {:.6g} m, where a grain of \"{}\" may still touch the floor; make it at least "
                         "{:.6g} m",
                         c.outlet->exit_depth, big.name, least));
}

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

[[noreturn]] void fail_tray(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError("{}: '{}' {}", scene.where("container.tray." + key), key, what);
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
        throw UserError("{}: 'tray' is of no use below a closed floor; add 'outlet', or remove it",
                        scene.where("container.tray"));
    if (clearly_less(c.tray->half_width, c.floor_half_width()))
        fail_tray(scene, "width",
                  fmt::format("of {:.6g} m is less than that of the container's floor, {:.6g} m; widen it",
                              2 * c.tray->half_width, 2 * c.floor_half_width()));
    const double room = tray_container(scene).height, largest = largest_diameter(scene);
    if (room < largest - kSameDecimals * c.tray->depth)
        fail_tray(
            scene, "depth",
            fmt::format("of {:.6g} m leaves {:.6g} m below the floor where that is lowest, less than the "
                        "largest grain, {:.6g} m; deepen it",
                        c.tray->depth, room, largest));
}

}  // namespace grainreel
