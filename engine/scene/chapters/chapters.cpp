// The keys that stand in a scene file before its first table (title and gravity), and functions that several
// chapters use. A new key of this kind needs an entry in top_level_table().
#include "engine/scene/chapters/chapters.hpp"

#include <cmath>

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

namespace {

using namespace keys;

void read_gravity(Document& document, const Scene&, const std::string& path, Scene& scene) {
    if (document.is_array(path)) {
        scene.gravity = *document.vector(path);
    } else if (const auto downwards = document.quantity(path)) {
        scene.gravity = Vec3(0, 0, *downwards == 0 ? 0 : -*downwards);
    }
}

const KeyTable<Scene>& top_level_table() {
    static const KeyTable<Scene> table{
        text("title", &Scene::title, note("the file's name"), "Shown on the film unless it has its own.")
            .usually([](Scene& into, const Scene& scene) { into.title = scene.name; })
            .decides_nothing(),
        bound_by<Scene>(of_dimension(entry("gravity", KeyKind::gravity, literal("9.81"),
                                           "Downwards along -z; or a vector [x, y, z]; 0 for none."),
                                     Dimension::acceleration, not_negative),
                        read_gravity, [](const Scene& from, const Scene&) { return as_toml(from.gravity); }),
    };
    return table;
}

}  // namespace

void list_top_level(Keys& all) {
    top_level_table().list(all, "");
}

void read_top_level(Document& document, Scene& scene) {
    top_level_table().read(document, scene, "", scene);
}

void write_top_level(SceneText& out, const Scene& scene) {
    top_level_table().write(out, scene, scene);
}

void make_unit(const Document& document, const std::string& path, Vec3& direction) {
    const double length = direction.norm();
    if (length == 0) document.fail(path, "must not be zero; write for example [0, 0, 1]");
    // A direction that is a unit vector already is not divided again, since rounding would change its last
    // bits. So a scene that the program has written reads back exactly as it was.
    if (std::abs(length - 1) >= 1e-15) direction /= length;
}

void check_corners(const Document& document, const std::string& table, const Vec3& low, const Vec3& high) {
    if ((high - low).minCoeff() <= 0)
        document.fail(table + ".low",
                      "must lie below 'high' along x, y and z; exchange the two, or widen the box");
}

}  // namespace grainreel
