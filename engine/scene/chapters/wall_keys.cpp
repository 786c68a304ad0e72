// The keys of [[wall]], and where a plane may not be.

#include <fmt/format.h>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "engine/scene/keys/keys.hpp"

namespace grainreel {

namespace {

using namespace keys;

const KeyTable<ScenePlane>& wall_table() {
    using W = ScenePlane;
    static const KeyTable<W> table{
        text("name", &W::name, note("wall 1, wall 2, ..."),
             "Name of a plane, for messages. It may be anywhere, with a container or without one.")
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
        ScenePlane wall;
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

namespace {

[[noreturn]] void fail_at(const Scene& scene, std::size_t wall, const char* key, const std::string& what) {
    const std::string path = fmt::format("wall[{}].{}", wall, key);
    throw UserError("{}: '{}' {}", scene.where(path), name_of(path), what);
}

// In a container with a periodic depth a plane must be the same after each period along x, so its normal may
// not have a part along x.
void check_planes_of_period(const Scene& scene) {
    constexpr double rounding = 1e-9;
    if (!scene.container.periodic_depth) return;
    for (std::size_t k = 0; k < scene.walls.size(); ++k)
        if (const Vec3& normal = scene.walls[k].normal; std::abs(normal.x()) > rounding)
            fail_at(scene, k, "normal",
                    fmt::format(
                        "is [{:.4g}, {:.4g}, {:.4g}], but a plane that leans along x would jump where the "
                        "depth is periodic; make its first number 0, or take out container.periodic_depth",
                        normal.x(), normal.y(), normal.z()));
}

// A plane that grains may touch, and whether the drive moves it.
struct Flat {
    std::string name;
    Vec3 point, normal;
    bool driven = false;
    Vec3 velocity{0, 0, 0};
};

// The plane faces of the container. They turn with it, so a turning container has none that stays in place.
std::vector<Flat> flat_faces(const Scene& scene) {
    const Container& c = scene.container;
    std::vector<Flat> faces;
    if (c.shape == Container::Shape::none || c.shape == Container::Shape::mesh || c.turn) return faces;
    const bool driven = scene.drive.present && scene.drive.moves == Drive::Moves::container;
    const auto add = [&](const char* name, const Vec3& point, const Vec3& normal) {
        faces.push_back({fmt::format("the container's {}", name), point, normal, driven});
    };
    add("floor", {0, 0, 0}, {0, 0, 1});
    faces.back().driven = scene.drive.present;
    if (c.lid) add("lid", {0, 0, c.height}, {0, 0, -1});
    if (c.shape == Container::Shape::cylinder) return faces;
    add("left wall", {0, -c.half_width, 0}, {0, 1, 0});
    add("right wall", {0, c.half_width, 0}, {0, -1, 0});
    if (c.shape == Container::Shape::wedge) {
        const double cosine = math::cos(c.half_angle), sine = math::sin(c.half_angle);
        add("left slant", {0, -c.half_width, c.slant_height}, {0, cosine, sine});
        add("right slant", {0, c.half_width, c.slant_height}, {0, -cosine, sine});
    }
    if (!c.periodic_depth) {
        add("back", {-c.depth / 2, 0, 0}, {1, 0, 0});
        add("front", {c.depth / 2, 0, 0}, {-1, 0, 0});
    }
    return faces;
}

// Whether a grain that touches one of them touches the other, now and later: they have one normal, lie less
// than `hair` apart, and move alike along the normal.
bool are_one(const Flat& one, const Flat& other, const Vec3& drive, double hair) {
    constexpr double rounding = 1e-6;
    if ((one.normal - other.normal).norm() > rounding) return false;
    if (std::abs(one.normal.dot(other.point - one.point)) > hair) return false;
    if (one.driven != other.driven && std::abs(drive.dot(one.normal)) > rounding) return false;
    return std::abs((one.velocity - other.velocity).dot(one.normal)) < rounding;
}

// Two planes in one place would each push a grain that touches them: it would bounce off a wall of twice the
// stiffness.
void check_planes_apart(const Scene& scene) {
    const double hair = 0.01 * smallest_diameter(scene);
    std::vector<Flat> flats = flat_faces(scene);
    for (std::size_t k = 0; k < scene.walls.size(); ++k) {
        const ScenePlane& wall = scene.walls[k];
        const Flat mine{fmt::format("\"{}\"", excerpt(wall.name)), wall.point, wall.normal, wall.moves,
                        wall.velocity};
        for (const Flat& other : flats)
            if (are_one(other, mine, scene.drive.present ? scene.drive.direction : Vec3(0, 0, 0), hair))
                fail_at(scene, k, "point",
                        fmt::format(
                            "puts the plane where {} is, and grains would touch both; take one of the two "
                            "out, or move this one by {:.2g} m or more",
                            other.name, hair));
        flats.push_back(mine);
    }
}

}  // namespace

void check_walls(const Scene& scene) {
    check_planes_of_period(scene);
    check_planes_apart(scene);
}

}  // namespace grainreel
