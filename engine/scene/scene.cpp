#include "engine/scene/scene.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/rotation.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {

double Container::base() const {
    return shape == Shape::mesh ? room->base() : 0;
}

double Container::floor_half_width() const {
    return std::max(0.0, half_width_at(base()));
}

double Container::half_width_at(double z) const {
    if (shape == Shape::mesh) return room->half_width_at(z);
    if (shape != Shape::wedge) return half_width;
    return half_width - std::max(0.0, slant_height - z) * math::tan(half_angle);
}

double Container::volume() const {
    return volume_below(height);
}

double Container::volume_below(double z) const {
    if (shape == Shape::mesh) return room->volume_below(z);
    if (shape == Shape::cylinder) return std::numbers::pi * half_width * half_width * z;
    const double slanted = shape == Shape::wedge ? std::min(slant_height, z) : 0.0;
    const double mean_width = floor_half_width() + half_width_at(slanted);  // twice the mean half-width
    return depth * (slanted * mean_width + (z - slanted) * 2 * half_width);
}

bool SceneContacts::rubs() const {
    const auto has_friction = [](const PairContact& pair) { return pair.tangential != TangentialLaw::none; };
    return std::any_of(grain.begin(), grain.end(), has_friction) ||
           std::any_of(wall.begin(), wall.end(), has_friction) ||
           std::any_of(mesh.begin(), mesh.end(), has_friction);
}

Quaternion AxisRotation::quaternion() const {
    return rotation_about(axis, angle);
}

const TriangleMesh& SceneMesh::shape() const {
    return surface->mesh();
}

bool SceneMesh::operator==(const SceneMesh& other) const {
    return name == other.name && hash == other.hash && scale == other.scale && position == other.position &&
           rotation == other.rotation && driven == other.driven && turn == other.turn &&
           velocity == other.velocity && path_hash == other.path_hash;
}

const SceneMesh* Scene::mesh_named(const std::string& mesh) const {
    const auto found = std::find_if(meshes.begin(), meshes.end(),
                                    [&](const SceneMesh& one) { return !mesh.empty() && one.name == mesh; });
    return found == meshes.end() ? nullptr : &*found;
}

// A grain comes at the end of its interval, so none comes at the very beginning.
std::int64_t Feed::due(double time) const {
    constexpr double most = 4e9;        // grains; more cannot be numbered
    constexpr double rounding = 1e-12;  // as a share of rate times time
    const double passed = std::max(0.0, std::min(time, until.value_or(time)) - from);
    const auto grains = static_cast<std::int64_t>(std::min(most, rate * passed * (1 + rounding)));
    return std::min(grains, count.value_or(grains));
}

namespace {

double speed_of(double amplitude, double frequency) {
    return amplitude * 2 * std::numbers::pi * frequency;
}

double level_of(double amplitude, double frequency, double gravity) {
    const double omega = 2 * std::numbers::pi * frequency;
    return gravity > 0 ? amplitude * omega * omega / gravity : std::numeric_limits<double>::infinity();
}

// The largest value in all stages and in the drive before them, which counts unless a stage replaces it at
// once.
template <class Of>
double largest(const Drive& drive, const Of& of) {
    const bool replaced = drive.changes() && drive.stages.front().from <= 0;
    double value = replaced ? 0 : of(drive.amplitude, drive.frequency);
    for (const DriveStage& stage : drive.stages)
        value = std::max(value, of(stage.amplitude, stage.frequency));
    return value;
}

}  // namespace

double Drive::speed() const {
    return speed_of(amplitude, frequency);
}

double Drive::g_level(double gravity) const {
    return level_of(amplitude, frequency, gravity);
}

double Drive::highest_frequency() const {
    return largest(*this, [](double, double f) { return f; });
}

double Drive::largest_amplitude() const {
    return largest(*this, [](double a, double) { return a; });
}

double Drive::top_speed() const {
    return largest(*this, speed_of);
}

double Drive::strongest_g_level(double gravity) const {
    return largest(*this, [&](double a, double f) { return level_of(a, f, gravity); });
}

std::int64_t Scene::grains() const {
    return std::accumulate(species.begin(), species.end(), std::int64_t{0},
                           [](std::int64_t sum, const Species& s) { return sum + s.all(); });
}

std::int64_t Scene::grains_at_start() const {
    return std::accumulate(species.begin(), species.end(), std::int64_t{0},
                           [](std::int64_t sum, const Species& s) { return sum + s.count; });
}

std::string Scene::where(const std::string& key) const {
    // Looks for the key itself, then for its parents, up to the first that the file has written.
    for (std::string path = key; !path.empty();) {
        if (const auto found = written.find(path); found != written.end()) {
            const Location& at = found->second;
            if (at.line == 0) return at.file;
            return at.file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
        }
        const auto cut = path.find_last_of(".[");
        path = cut == std::string::npos ? std::string() : path.substr(0, cut);
    }
    return file.empty() ? file : file + ":1:1";
}

std::vector<std::string> Scene::instruments() const {
    std::vector<std::string> all = output.instruments;
    for (const std::string& wished : wishes.instruments)
        if (!contains(all, wished)) all.push_back(wished);
    return all;
}

}  // namespace grainreel
