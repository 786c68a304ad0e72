#include "engine/scene/chapters/container_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"

namespace grainreel {
namespace {

using namespace keys;
using Shape = Outlet::Shape;

// The size of a slot or of a hole, across.
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
    throw UserError(fmt::format("{}: '{}' {}", scene.where("container.outlet." + key), key, what));
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

}  // namespace grainreel
