// The keys of [container].
#include "engine/scene/chapters/container_keys.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/mesh_files.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

namespace {

using namespace keys;
using C = Container;
using Shape = Container::Shape;

const ChoiceWords<Shape> shape_words{{"wedge", Shape::wedge},
                                     {"box", Shape::box},
                                     {"cylinder", Shape::cylinder},
                                     {"mesh", Shape::mesh},
                                     {"none", Shape::none}};
const ChoiceWords<bool> top_words{{"lid", true}, {"open", false}};

// Says why keys about the container mean nothing if there is no container, or if its shape comes from a mesh.
const char* without_container(const C& container) {
    if (container.shape == Shape::mesh) return "the mesh that 'mesh' names says the container's whole shape";
    return container.shape == Shape::none ? "there is no container" : nullptr;
}

// Makes the function that says why a key means nothing: `reason` unless the container is one of `shapes`.
BoundKey<C>::Useless only_of(std::initializer_list<Shape> shapes, const char* reason) {
    return [shapes = std::vector<Shape>(shapes), reason](const C& container) -> const char* {
        if (const char* none = without_container(container)) return none;
        const bool has = contains(shapes, container.shape);
        return has ? nullptr : reason;
    };
}

const char* without_floor(const C& container) {
    if (container.shape == Shape::mesh)
        return "a mesh has no floor of its own; grains leave through [[exit]]";
    return without_container(container);
}

const char* without_faces(const C& container) {
    if (container.shape == Shape::mesh) return "grains can be glued to no mesh";
    return without_container(container);
}

const char* turned_elsewhere(const C& container) {
    if (container.shape == Shape::mesh) return "a mesh is turned by the 'turn' of its own [[mesh]]";
    return without_container(container);
}

const char* not_of_wedge_or_box(const C& container) {
    if (container.shape == Shape::cylinder) return "a cylinder has a 'diameter'";
    return without_container(container);
}

const char* not_of_box(const C& container) {
    if (container.shape == Shape::wedge) return "a wedge has a 'half_width'";
    return not_of_wedge_or_box(container);
}

BoundKey<C> length(const char* name, double C::*member, Fallback fallback, const char* about) {
    return quantity(name, member, Dimension::length, positive, std::move(fallback), about).needed();
}

BoundKey<C> mesh_key() {
    const auto read = [](Document& document, const Scene& scene, const std::string& path, C& container) {
        container.mesh = document.required_text(path);
        if (scene.mesh_named(container.mesh) != nullptr) return;
        std::string known;
        for (const SceneMesh& mesh : scene.meshes)
            known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", excerpt(mesh.name));
        document.fail(
            path, fmt::format("names \"{}\", which is no [[mesh]]; {}", excerpt(container.mesh),
                              known.empty() ? std::string("there is none; add one") : "there is " + known));
    };
    return bound_by<C>(
               entry("mesh", KeyKind::text, note("required; mesh"),
                     "Name of the [[mesh]] that is the container. Its room is what is enclosed on all "
                     "sides, lid or not; sizes follow from it."),
               read, [](const C& container, const Scene&) { return quoted(container.mesh); })
        .needed()
        .useless_for([](const C& container) {
            return container.shape == Shape::mesh ? nullptr : "only shape = \"mesh\" has it";
        });
}

// The scene gives a whole width, but half of it is kept.
BoundKey<C> width(const char* name, Fallback fallback, const char* about) {
    return bound_by<C>(
               quantity(name, Dimension::length, positive, std::move(fallback), about),
               [](Document& document, const Scene&, const std::string& path, C& container) {
                   container.half_width = document.required_quantity(path) / 2;
               },
               [](const C& container, const Scene&) {
                   return as_toml(2 * container.half_width, Dimension::length);
               })
        .needed();
}

// Reads the floor's width, another way to give the height of a wedge's slants; the height is kept and
// written. The half-width and the angle have been read before.
BoundKey<C> floor_width_key() {
    const auto read = [](Document& document, const Scene&, const std::string& path, C& container) {
        if (!document.has(path)) document.fail_missing("container.slant_height");
        const double taken = container.half_width - document.required_quantity(path) / 2;
        if (taken <= 0)
            document.fail(path, fmt::format("must be less than the {:.6g} m between the walls; narrow it, or "
                                            "raise half_width",
                                            2 * container.half_width));
        container.slant_height = taken / math::tan(container.half_angle);
    };
    const auto useless = [](const C& container) -> const char* {
        if (const char* reason = only_of({Shape::wedge}, "only a wedge has slanted walls")(container))
            return reason;
        return container.slant_height > 0 ? "'slant_height' is given" : nullptr;
    };
    return bound_by<C>(quantity("floor_width", Dimension::length, positive, note("from `slant_height`"),
                                "Of the floor along y, in place of `slant_height`."),
                       read, [](const C&, const Scene&) { return std::string(); })
        .excludes({"slant_height"})
        .useless_for(useless)
        .never_written();
}

// The order of reading and writing: slanted walls, width, depth, then keys of every shape.
enum Place { of_slant = 1, of_width, of_depth, of_all };

const KeyTable<C>& container_table() {
    static const KeyTable<C> table{
        choice(
            "shape", &C::shape, shape_words, required(),
            "mesh: that of a [[mesh]]; none: empty space. The origin is the middle of the floor; x along the "
            "depth, y across, z up."),
        mesh_key(),
        length("height", &C::height, note("required; wedge, box, cylinder"), "Floor to lid or rim.")
            .useless_for(without_container)
            .placed_at(of_all),
        length("depth", &C::depth, note("required; wedge, box"), "Front to back, along x.")
            .useless_for(not_of_wedge_or_box)
            .placed_at(of_depth),
        length("half_width", &C::half_width, note("required; wedge"),
               "At and above the slanted part, from the middle to the wall.")
            .useless_for(only_of({Shape::wedge}, "only a wedge has a half-width"))
            .placed_at(of_width),
        quantity("half_angle", &C::half_angle, Dimension::angle, positive, note("required; wedge"),
                 "Between slanted wall and the vertical.")
            .needed()
            .useless_for(only_of({Shape::wedge}, "only a wedge has slanted walls"))
            .placed_at(of_slant),
        quantity("slant_height", &C::slant_height, Dimension::length, positive,
                 note("required, or `floor_width`; wedge"), "Height of the slanted part.")
            .useless_for(only_of({Shape::wedge}, "only a wedge has slanted walls"))
            .placed_at(of_slant),
        floor_width_key().placed_at(of_depth),
        width("width", note("required; box"), "Along y.").useless_for(not_of_box).placed_at(of_width),
        width("diameter", note("required; cylinder"), "Inside.")
            .useless_for(only_of({Shape::cylinder}, "only a cylinder has a diameter"))
            .placed_at(of_width),
        choice("top", &C::lid, top_words, initial(), "Sealed, or open above.")
            .useless_for(without_container)
            .placed_at(of_all),
        outlet_key().useless_for(without_floor).placed_at(of_all),
        tray_key().useless_for(without_floor).placed_at(of_all),
        wall_grains_key().useless_for(without_faces).placed_at(of_all),
        turn_key(&C::turn, "Or a table: all walls turn steadily about an axis, a cylinder's about its own.")
            .useless_for(turned_elsewhere)
            .placed_at(of_all),
        flag("periodic_depth", &C::periodic_depth, initial(),
             "No front and back walls: what leaves at one enters at the other.")
            .useless_for(not_of_wedge_or_box)
            .placed_at(of_depth),
    };
    return table;
}

// Finds the sizes of a mesh's room. Half-width and depth are the largest that the room has at any height.
void measure_room(const Document& document, const Scene& scene, C& c) {
    constexpr int levels = 64;
    c.room.of = room_of(scene.vessel()->surface.of);
    const EnclosedRoom& room = *c.room;
    if (!room.encloses_anything())
        document.fail(
            "container.mesh",
            fmt::format("names \"{}\", which encloses nothing: from no place in it do walls stand on "
                        "all sides; close it, stand it upright by 'rotation', or write shape = "
                        "\"none\" and start.region",
                        excerpt(c.mesh)));
    c.half_width = c.depth = 0;
    for (int k = 0; k <= levels; ++k) {
        const double z = room.base() + (room.top() - room.base()) * k / levels;
        c.half_width = std::max(c.half_width, room.half_width_at(z));
        c.depth = std::max(c.depth, 2 * room.half_depth_at(z));
    }
    c.height = room.top();
    c.lid = !room.open_above();
    if (c.height <= 0)
        document.fail(
            "container.mesh",
            fmt::format("names \"{}\", which lies below z = 0, its top at {:.6g} m; raise it by its "
                        "'position'",
                        excerpt(c.mesh), c.height));
}

}  // namespace

void list_container(Keys& all) {
    container_table().list(all, "container");
}

void read_container(Document& document, Scene& scene) {
    container_table().read(document, scene, "container", scene.container);
    if (scene.container.shape == Shape::mesh) measure_room(document, scene, scene.container);
}

void write_container(SceneText& out, const Scene& scene) {
    out.table("container");
    container_table().write(out, scene, scene.container);
}

void size_empty_space(Scene& scene) {
    C& c = scene.container;
    if (c.shape != Shape::none) return;
    const Extent extent = extent_of(scene);
    c.depth = extent.size().x();
    c.half_width = 0.5 * extent.size().y();
    c.height = extent.size().z();
    c.lid = false;
}

using namespace keys;

const KeyTable<BodyTurn>& turn_table() {
    using T = BodyTurn;
    static const KeyTable<T> table{
        vector("axis", &T::axis, Dimension::number, required(),
               "Along the axis, any length; turns by the right-hand rule."),
        vector("through", &T::through, Dimension::length, initial(), "A point of the axis, in the scene."),
        quantity("rate", &T::rate, Dimension::spin, any, required(),
                 "How fast: \"30 rpm\", \"2 rad/s\", \"90 degree/s\"; below 0 the other way round."),
        quantity("from", &T::from, Dimension::time, not_negative, literal("\"0 s\""),
                 "When it begins, since the start of the run."),
        quantity("over", &T::over, Dimension::time, not_negative, literal("\"0 s\""),
                 "How long the rate takes to rise, as the drive's ramp does, and to fall; 0: at once."),
        quantity("until", &T::until, Dimension::time, positive, note("the run's end"),
                 "When it begins to end.")
            .unwritten_if([](const T& turn) { return std::isinf(turn.until); }),
    };
    return table;
}

BodyTurn read_turn(Document& document, const Scene& scene, const std::string& path) {
    if (!document.is_table(path))
        document.fail(path, fmt::format("is {}; write {{ axis = [0, 1, 0], rate = \"30 rpm\" }}",
                                        document.written_value(path)));
    BodyTurn turn;
    turn_table().read(document, scene, path, turn);
    make_unit(document, path + ".axis", turn.axis);
    if (clearly_less(turn.until, turn.from + turn.over))
        document.fail(path + ".until",
                      fmt::format("is {:.6g} s, but the turn has begun wholly at {:.6g} s only; raise it, or "
                                  "shorten 'over'",
                                  turn.until, turn.from + turn.over));
    return turn;
}

}  // namespace grainreel
