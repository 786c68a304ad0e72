#include "engine/scene/chapters/mesh_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <mutex>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/rotation.hpp"
#include "engine/base/text.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Keeps the last few things made, each with its hash as key.
template <class T, std::size_t Most>
class LastMade {
  public:
    template <class Make>
    std::shared_ptr<const T> with(const std::string& hash, const Make& make) {
        const std::lock_guard guard(lock_);
        const auto found =
            std::find_if(made_.begin(), made_.end(), [&](const auto& one) { return one->hash() == hash; });
        if (found != made_.end()) return *found;
        made_.push_back(make());
        if (made_.size() > Most) made_.pop_front();
        return made_.back();
    }

  private:
    std::mutex lock_;
    std::deque<std::shared_ptr<const T>> made_;
};

constexpr std::size_t kSurfaces = 8;

bool is_shipped(const fs::path& file) {
    return file.filename().string().starts_with("shipped:");
}

std::string hash_with_placement(const SceneMesh& mesh) {
    const Vec3 &p = mesh.position, &a = mesh.rotation.axis;
    return fmt::format("{} {} {} {} {} {} {} {} {}", mesh.hash, mesh.scale, p.x(), p.y(), p.z(), a.x(), a.y(),
                       a.z(), mesh.rotation.angle);
}

// If the scene gives a hash of the file, checks that the file has it. The scene in a run's folder gives one.
void check_hash(const Document& document, const std::string& key, const std::string& file,
                const std::string& said, const std::string& found) {
    if (said.empty() || said == found) return;
    document.fail(key, fmt::format("names {}, which is another file now: its hash is {}, but it was {}; put "
                                   "the file back as it was, or start anew without the hash",
                                   excerpt(file, kLongestPath), found, said));
}

// Reads a file. An error then names the place in the scene of the key that names the file.
template <class Read>
auto at_key(const Document& document, const std::string& key, const Read& read) {
    try {
        return read();
    } catch (const UserError& error) {
        document.fail(key, fmt::format("names a file that cannot be used: {}", error.what()));
    }
}

}  // namespace

std::string named_file(Document& document, const Scene& scene, const std::string& path) {
    const fs::path file = document.required_text(path);
    if (file.empty()) document.fail(path, "is empty; write the name of a file");
    if (is_shipped(file)) return file.filename().string();
    const fs::path folder = fs::absolute(fs::path(scene.file)).parent_path().lexically_normal();
    if (const std::string wrong = complaint_of_utf8((folder / file).string()); !wrong.empty())
        document.fail(path, fmt::format("lies at {}; rename the folder", wrong));
    const bool of_checkpoint = fs::path(scene.file).extension() == ".grs";
    constexpr int most_above = 2;
    fs::path from = folder;
    for (int above = 0; above <= (of_checkpoint ? most_above : 0); ++above, from = from.parent_path())
        if (is_there(from / file)) return (from / file).lexically_normal().string();
    document.fail(path, fmt::format("names {}, which does not exist; {}",
                                    excerpt((folder / file).lexically_normal().string(), kLongestPath),
                                    of_checkpoint ? "keep a checkpoint in the folder of its run"
                                                  : "a relative path counts from the scene's folder"));
}

void load_surface(const Document& document, const std::string& table, SceneMesh& mesh) {
    static LastMade<Surface, kSurfaces> surfaces;
    const std::string key = table + ".file";
    const std::string said = mesh.hash;
    mesh.hash = at_key(document, key, [&] { return hash_of_file(mesh.file); });
    check_hash(document, key, mesh.file, said, mesh.hash);
    mesh.surface.of = surfaces.with(hash_with_placement(mesh), [&] {
        return at_key(document, key, [&] {
            LoadedMesh loaded = load_mesh(mesh.file, {mesh.scale, mesh.position, mesh.rotation.quaternion()});
            return std::make_shared<const Surface>(std::move(loaded.mesh), std::move(loaded.facts),
                                                   hash_with_placement(mesh));
        });
    });
}

void load_path(const Document& document, const std::string& table, SceneMesh& mesh) {
    if (mesh.path_file.empty()) return;
    const std::string key = table + ".path", said = mesh.path_hash;
    mesh.path.of = at_key(document, key, [&] { return MotionPath::read(mesh.path_file, mesh.position); });
    mesh.path_hash = mesh.path->hash();
    check_hash(document, key, mesh.path_file, said, mesh.path_hash);
}

std::shared_ptr<const EnclosedRoom> room_of(const std::shared_ptr<const Surface>& surface) {
    static LastMade<EnclosedRoom, 1> rooms;
    return rooms.with(surface->hash(), [&] { return std::make_shared<const EnclosedRoom>(surface); });
}

// The boxes in which meshes move.

namespace {

constexpr int kMoments = 64;  // number of times at which a motion is looked at

// All vertices or, where they are many, the corners of the box around them.
std::vector<Vec3> points_of(const Surface& surface) {
    constexpr std::size_t many = 20'000;
    if (surface.mesh().vertices.size() <= many) return surface.mesh().vertices;
    const Vec3 &low = surface.facts().low, &high = surface.facts().high;
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back((k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z());
    return corners;
}

// Adds the circles along which the points of a turning mesh move.
void take_circles(const SceneMesh& mesh, Extent& extent) {
    const Vec3 &axis = mesh.turn->axis, &through = mesh.turn->through;
    const Vec3 reach = (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    for (const Vec3& point : mesh.surface->mesh().vertices) {
        const Vec3 along = axis.dot(point - through) * axis;
        const double radius = (point - through - along).norm();
        extent.take(through + along - radius * reach);
        extent.take(through + along + radius * reach);
    }
}

void take_turn(const SceneMesh& mesh, double duration, Extent& extent) {
    const double angle = mesh.turn->angle_at(duration);
    if (std::abs(angle) >= std::numbers::pi) return take_circles(mesh, extent);
    for (int k = 0; k <= kMoments; ++k) {
        const Quaternion rotation = rotation_about(mesh.turn->axis, angle * k / kMoments);
        for (const Vec3& point : points_of(*mesh.surface))
            extent.take(mesh.turn->through + rotation * (point - mesh.turn->through));
    }
}

void take_path(const SceneMesh& mesh, double duration, Extent& extent) {
    const std::vector<Vec3> points = points_of(*mesh.surface);
    for (int k = 0; k <= kMoments; ++k) {
        const PathPose pose = mesh.path->at(duration * k / kMoments);
        for (const Vec3& point : points) extent.take(pose.place + pose.rotation * point);
    }
}

// How far a mesh with a velocity goes, limited to a few times its size.
Vec3 way_of(const SceneMesh& mesh, double duration) {
    constexpr double farthest = 5;
    Vec3 way = duration * mesh.velocity;
    const double most = farthest * (mesh.high - mesh.low).norm();
    if (way.norm() > most) way *= most / way.norm();
    return way;
}

}  // namespace

void measure_meshes(Scene& scene) {
    for (SceneMesh& mesh : scene.meshes) {
        mesh.low = mesh.surface->facts().low, mesh.high = mesh.surface->facts().high;
        Extent extent{mesh.low, mesh.high};
        if (mesh.turn) take_turn(mesh, scene.run.duration, extent);
        if (mesh.path) take_path(mesh, scene.run.duration, extent);
        const Vec3 way = way_of(mesh, scene.run.duration);
        extent.take(mesh.low + way);
        extent.take(mesh.high + way);
        mesh.low = extent.low, mesh.high = extent.high;
    }
}

}  // namespace grainreel
