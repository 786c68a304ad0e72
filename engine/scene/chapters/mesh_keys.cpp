// The keys of [[mesh]].

#include <fmt/format.h>
#include <array>

#include "engine/mesh/surface.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/container_keys.hpp"
#include "engine/scene/chapters/mesh_files.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

namespace {

using namespace keys;
using M = SceneMesh;

const KeyTable<AxisRotation>& rotation_table() {
    using R = AxisRotation;
    static const KeyTable<R> table{
        vector("axis", &R::axis, Dimension::number, required(),
               "Along the axis, any length; by the right-hand rule."),
        quantity("angle", &R::angle, Dimension::angle, any, required(), "By how much."),
    };
    return table;
}

BoundKey<M> rotation_key() {
    const auto read = [](Document& document, const Scene& scene, const std::string& path, M& mesh) {
        if (!document.has(path)) return;
        if (!document.is_table(path))
            document.fail(path, fmt::format("is {}; write {{ axis = [0, 0, 1], angle = \"90 deg\" }}",
                                            document.written_value(path)));
        rotation_table().read(document, scene, path, mesh.rotation);
        make_unit(document, path + ".axis", mesh.rotation.axis);
        if (mesh.rotation.angle == 0) mesh.rotation = {};
    };
    return bound_by<M>(entry("rotation", KeyKind::text, note("none"),
                             "A table: turned about the file's origin, before it is moved."),
                       read,
                       [](const M& mesh, const Scene& scene) {
                           return mesh.rotation.angle == 0
                                      ? std::string()
                                      : rotation_table().inline_text(scene, mesh.rotation);
                       })
        .holding(rotation_table());
}

BoundKey<M> file_key(const char* name, std::string M::*member, Fallback fallback, const char* about) {
    const auto read = [member](Document& document, const Scene& scene, const std::string& path, M& mesh) {
        if (document.has(path)) mesh.*member = named_file(document, scene, path);
    };
    return bound_by<M>(of_length(entry(name, KeyKind::text, std::move(fallback), about), kLongestPath), read,
                       [member](const M& mesh, const Scene&) {
                           return (mesh.*member).empty() ? std::string() : quoted(mesh.*member);
                       })
        .decides_nothing();  // the file's hash decides instead
}

BoundKey<M> hash_key(const char* name, std::string M::*member, const char* about) {
    return text(name, member, note("not checked"), about).unwritten_if([member](const M& mesh) {
        return (mesh.*member).empty();
    });
}

bool stands_still(const M& mesh) {
    return mesh.velocity.isZero(0);
}

const KeyTable<M>& mesh_table() {
    static const KeyTable<M> table{
        text("name", &M::name, note("mesh 1, mesh 2, ..."),
             "A wall whose shape comes from a file, beside the container or without any; for "
             "[[contact.pair]], "
             "columns and messages.")
            .usually([](M& mesh, const Scene& scene) {
                mesh.name = fmt::format("mesh {}", scene.meshes.size() + 1);
            })
            .decides_nothing(),
        file_key("file", &M::file, required(),
                 "Triangles: STL, OBJ or PLY; relative to the scene's folder. A run keeps a copy.")
            .needed(),
        hash_key("hash", &M::hash, "XXH64 of the file, as a run's scene has it; another file is refused."),
        quantity("scale", &M::scale, Dimension::number, positive_or_tiny, initial(),
                 "Factor for the lengths in the file; 0.001 where they are in mm."),
        vector("position", &M::position, Dimension::length, initial(), "Where the file's origin comes to."),
        rotation_key(),
        flag("driven", &M::driven, note("true for the container's mesh that has no other motion"),
             "Follows the drive. A mesh has one motion at most: this, `turn`, `velocity` or `path`."),
        turn_key(&M::turn, "Or a table: turns steadily about an axis."),
        vector("velocity", &M::velocity, Dimension::speed, initial(), "Steady, from the start.")
            .unwritten_if(stands_still),
        file_key("path", &M::path_file, note("none"),
                 "CSV of a motion: time_s, x_m, y_m, z_m from where it rests and, if wanted, qw, qx, qy, qz, "
                 "which turn it about its position."),
        hash_key("path_hash", &M::path_hash, "XXH64 of the path's file; another file is refused."),
    };
    return table;
}

bool is_vessel(Document& document, const M& mesh) {
    return document.has("container.mesh") && document.text("container.mesh") == mesh.name;
}

// A mesh may have only one kind of motion.
void settle_motion(Document& document, const std::string& table, M& mesh) {
    struct Motion {
        const char* key;
        bool said;
    };
    const std::array motions{Motion{"driven", mesh.driven}, Motion{"turn", mesh.turn.has_value()},
                             Motion{"velocity", !mesh.velocity.isZero(0)},
                             Motion{"path", !mesh.path_file.empty()}};
    const char* first = nullptr;
    for (const Motion& motion : motions) {
        if (!motion.said) continue;
        if (first != nullptr)
            document.fail(fmt::format("{}.{}", table, motion.key),
                          fmt::format("stands beside '{}', but a mesh has one motion; take one out", first));
        first = motion.key;
    }
    if (mesh.driven && !document.has("drive"))
        document.fail(table + ".driven", "follows a drive, but there is none; add [drive] or remove it");
    if (!document.has(table + ".driven"))
        mesh.driven = first == nullptr && is_vessel(document, mesh) && document.has("drive");
    if (mesh.path_file.empty()) document.refuse(table + ".path_hash", "there is no 'path'");
}

}  // namespace

void list_meshes(Keys& all) {
    mesh_table().list(all, "mesh[]");
}

void read_meshes(Document& document, Scene& scene) {
    for (std::size_t i = 0; i < document.size("mesh"); ++i) {
        const std::string table = fmt::format("mesh[{}]", i);
        M mesh;
        mesh_table().read(document, scene, table, mesh);
        settle_motion(document, table, mesh);
        load_surface(document, table, mesh);
        load_path(document, table, mesh);
        for (const std::string& line : mesh.surface->facts().mended)
            scene.notes.push_back(
                fmt::format("{}: mesh \"{}\": {}", document.place(table + ".file"), mesh.name, line));
        scene.meshes.push_back(std::move(mesh));
    }
}

void write_meshes(SceneText& out, const Scene& scene) {
    mesh_table().write_elements(out, scene, "mesh", scene.meshes);
}

// The keys of [[exit]].

namespace {

using namespace keys;

const KeyTable<ExitBox>& exit_table() {
    using E = ExitBox;
    static const KeyTable<E> table{
        vector("low", &E::low, Dimension::length, required(),
               "Lowest corner of a box that does not move: a grain whose centre is in it leaves the run."),
        vector("high", &E::high, Dimension::length, required(), "Highest corner."),
        flag("outside", &E::outside, initial(), "Grains leave when they are not in the box."),
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
