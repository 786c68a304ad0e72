// Converts values of the program into public ones of the library, and back.
#include "engine/library/internal.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/files/damage.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/state/container_faces.hpp"
#include "grainreel/contact_law.hpp"

namespace grainreel::v1 {

Vec3 inside(const Vector& v) {
    return {v.x, v.y, v.z};
}
Vector outside(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
Quaternion inside(const Rotation& r) {
    return {r.w, r.x, r.y, r.z};
}
Rotation outside(const Quaternion& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

namespace {

template <class To, class From>
std::vector<To> each_inside(const std::vector<From>& from) {
    std::vector<To> to;
    to.reserve(from.size());
    for (const From& one : from) to.push_back(inside(one));
    return to;
}

template <class To, class From>
std::vector<To> each_outside(const std::vector<From>& from) {
    std::vector<To> to;
    to.reserve(from.size());
    for (const From& one : from) to.push_back(outside(one));
    return to;
}

void check_lengths(const Frame& frame, const std::string& who) {
    const std::size_t n = frame.id.size();
    const auto check = [&](std::size_t size, const char* array, bool may_be_empty) {
        if (size == n || (may_be_empty && size == 0)) return;
        throw Error(
            fmt::format("{}: has {} ids and {} entries of {}; give one a grain", who, n, size, array));
    };
    check(frame.species.size(), "species", false);
    check(frame.radius.size(), "radius", false);
    check(frame.position.size(), "position", false);
    check(frame.velocity.size(), "velocity", true);
    check(frame.spin.size(), "spin", true);
    check(frame.orientation.size(), "orientation", true);
    check(frame.mass.size(), "mass", true);
}

void check_ids(const Frame& frame, const std::string& who) {
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
        if (frame.id[i] < 0) throw Error(fmt::format("{}: has id {}; ids start at 0", who, frame.id[i]));
        if (i > 0 && frame.id[i] <= frame.id[i - 1])
            throw Error(fmt::format("{}: id {} follows id {}; give grains by rising id, each once", who,
                                    frame.id[i], frame.id[i - 1]));
    }
}

void check_masses(const Frame& frame, const std::string& who) {
    for (std::size_t i = 0; i < frame.mass.size(); ++i)
        if (!std::isfinite(frame.mass[i]) || frame.mass[i] <= 0)
            throw Error(fmt::format("{}: grain {} has a mass of {} kg; give all grains one above 0, or none",
                                    who, frame.id[i], frame.mass[i]));
}

BodyPose pose_inside(const Pose& pose) {
    return {inside(pose.place), inside(pose.rotation).normalized(), inside(pose.velocity), inside(pose.spin)};
}

void check_poses(const std::vector<BodyPose>& bodies, const std::string& who) {
    for (std::size_t k = 0; k < bodies.size(); ++k)
        if (!bodies[k].place.allFinite() || !bodies[k].rotation.coeffs().allFinite())
            throw Error(fmt::format("{}: the pose of body {} is no place and rotation", who, k));
}

void check_species(const Frame& frame, std::size_t species, const std::string& who) {
    for (std::size_t i = 0; i < frame.id.size(); ++i)
        if (frame.species[i] < 0 || static_cast<std::size_t>(frame.species[i]) >= species)
            throw Error(fmt::format("{}: grain {} has the species {}; there {} {}, counted from 0", who,
                                    frame.id[i], frame.species[i], species == 1 ? "is" : "are", species));
}

}  // namespace

void take_poses(grainreel::State& frame, std::size_t given, std::size_t bodies, const std::string& who) {
    if (given > 0 && given < bodies)
        throw Error(
            fmt::format("{}: has {} poses in `bodies`; give none, or {}: container, floor and {} walls", who,
                        given, bodies, bodies - kFirstPlaneBody));
    frame.bodies.resize(bodies);
}

void check_moment(const grainreel::State& frame, const std::string& who) {
    grainreel::State moment = moment_of(frame);
    if (std::isnan(moment.time)) moment.time = 0;
    if (const std::optional<std::string> fault = moment_fault(moment))
        throw Error(fmt::format("{}: {}", who, *fault));
}

Frame outside(const grainreel::State& from) {
    Frame frame;
    frame.step = from.step;
    frame.time = from.time;
    frame.cycles = from.cycles;
    frame.id = from.id;
    frame.species = from.species;
    frame.radius = from.radius;
    frame.position = each_outside<Vector>(from.position);
    frame.velocity = each_outside<Vector>(from.velocity);
    frame.spin = each_outside<Vector>(from.spin);
    frame.orientation = each_outside<Rotation>(from.orientation);
    frame.mass = from.mass;
    for (const BodyPose& pose : from.bodies)
        frame.bodies.push_back(
            {outside(pose.place), outside(pose.rotation), outside(pose.velocity), outside(pose.spin)});
    return frame;
}

grainreel::State inside(const Frame& from, std::size_t species, const std::string& who) {
    check_lengths(from, who);
    check_ids(from, who);
    check_species(from, species, who);
    check_masses(from, who);
    grainreel::State frame;
    frame.step = from.step;
    frame.time = from.time;
    frame.cycles = from.cycles;
    frame.phase = std::isfinite(from.cycles) ? from.cycles - std::floor(from.cycles) : 0;
    frame.id = from.id;
    frame.species = from.species;
    frame.radius = from.radius;
    frame.position = each_inside<Vec3>(from.position);
    frame.velocity = each_inside<Vec3>(from.velocity);
    frame.spin = each_inside<Vec3>(from.spin);
    frame.velocity.resize(frame.size(), Vec3(0, 0, 0));
    frame.spin.resize(frame.size(), Vec3(0, 0, 0));
    for (const Rotation& one : from.orientation) frame.orientation.push_back(inside(one).normalized());
    frame.mass = from.mass;
    if (!from.bodies.empty()) frame.bodies.clear();
    for (const Pose& pose : from.bodies) frame.bodies.push_back(pose_inside(pose));
    while (frame.bodies.size() < kFirstPlaneBody) frame.bodies.emplace_back();
    check_poses(frame.bodies, who);
    if (const std::optional<std::string> fault = grains_fault(frame, species))
        throw Error(fmt::format("{}: {}", who, *fault));
    return frame;
}

World outside(const grainreel::StoredWorld& from) {
    World world;
    world.title = from.title;
    for (const WorldSpecies& one : from.species) {
        world.species.push_back(one.name);
        world.density.push_back(one.density > 0 ? one.density : kUnknown);
    }
    for (std::size_t k = kFirstPlaneBody; k < from.bodies.size(); ++k) {
        Mesh& mesh = world.walls.emplace_back();
        mesh.name = from.bodies[k].name;
        mesh.points = each_outside<Vector>(from.bodies[k].mesh.vertices);
        mesh.triangles = from.bodies[k].mesh.triangles;
    }
    return world;
}

namespace {

TriangleMesh mesh_inside(const Mesh& from) {
    TriangleMesh mesh;
    mesh.vertices = each_inside<Vec3>(from.points);
    mesh.triangles = from.triangles;
    if (mesh.empty()) throw Error(fmt::format("wall \"{}\": has no triangle", from.name));
    for (const Vec3& point : mesh.vertices)
        if (!point.allFinite()) throw Error(fmt::format("wall \"{}\": a point is no number", from.name));
    const auto points = static_cast<std::int32_t>(mesh.vertices.size());
    for (const TriangleMesh::Triangle& triangle : mesh.triangles)
        for (const std::int32_t corner : triangle)
            if (corner < 0 || corner >= points)
                throw Error(fmt::format("wall \"{}\": a triangle names point {}; there are {}", from.name,
                                        corner, points));
    MeshFacts facts;
    mend(mesh, facts);
    if (mesh.empty()) throw Error(fmt::format("wall \"{}\": no triangle has an area", from.name));
    return mesh;
}

// Checks the last species.
void check_species_of_world(const std::vector<WorldSpecies>& species) {
    const WorldSpecies& last = species.back();
    for (std::size_t s = 0; s + 1 < species.size(); ++s)
        if (species[s].name == last.name)
            throw Error(fmt::format("a world has two species with the name \"{}\"; give each its own",
                                    excerpt(last.name)));
    if (!std::isnan(last.density) && !(last.density > 0 && std::isfinite(last.density)))
        throw Error(
            fmt::format("the species \"{}\" of a world has the density {} kg/m3; give one above 0, or "
                        "NaN where it is not known",
                        excerpt(last.name), last.density));
}

}  // namespace

grainreel::StoredWorld inside(const World& from) {
    if (from.species.empty()) throw Error("a world has no species; name one at least");
    if (!from.density.empty() && from.density.size() != from.species.size())
        throw Error(fmt::format("a world has {} species and {} densities; give one each, or none",
                                from.species.size(), from.density.size()));
    grainreel::StoredWorld world;
    world.title = from.title;
    for (std::size_t s = 0; s < from.species.size(); ++s) {
        WorldSpecies& one = world.species.emplace_back();
        one.name = from.species[s];
        if (!from.density.empty()) one.density = from.density[s];
        check_species_of_world(world.species);
    }
    world.bodies = {{"container", {}, {}}, {"floor", {}, {}}};
    for (const Mesh& wall : from.walls) world.bodies.push_back({wall.name, {}, mesh_inside(wall)});
    return world;
}

namespace {

// What messages begin with that name no file but look like one: "step 7700 (0.05 s)", "a frame for
// out/x.csv".
constexpr std::array<std::string_view, 6> no_files{"--",    "setting ", "settings of ",
                                                   "step ", "a frame ", "the first frame "};

// Whether the text before the first ": " of a message may name a file at all.
bool may_be_a_file(const std::string& text) {
    return text.find_first_of("\n\"'") == std::string::npos &&
           std::none_of(no_files.begin(), no_files.end(),
                        [&](std::string_view start) { return text.starts_with(start); });
}

// Whether it looks like a file without a line number behind it: it has a folder, or an extension such as
// ".csv". "threads" in "threads: must be at least 0" has neither.
bool looks_like_a_file(const std::string& text) {
    if (text.find('/') != std::string::npos) return true;
    const std::string extension = std::filesystem::path(text).extension().string();
    const auto is = [](int (*kind)(int)) { return [kind](unsigned char c) { return kind(c) != 0; }; };
    return extension.size() > 1 && std::all_of(extension.begin() + 1, extension.end(), is(std::isalnum)) &&
           std::any_of(extension.begin() + 1, extension.end(), is(std::isalpha));
}

// Takes a number such as ":12" off the end of `text`. Returns the number, or 0 where there is none.
int number_cut_off(std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon + 1 == text.size()) return 0;
    int number = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data() + colon + 1, end, number);
    if (error != std::errc() || stopped != end || number < 1) return 0;
    text.resize(colon);
    return number;
}

}  // namespace

std::string in_words_of_library(std::string message) {
    // The first text that fits is taken, so a longer text comes before a shorter one that it begins with.
    static constexpr std::pair<std::string_view, std::string_view> words[] = {
        {", or --force to replace it when the new run is complete", ""},
        {", or --force to replace it", ""},
        {"; choose another with --out", "; choose another"},
        {"write --set ", "write "},
        {"--set ", "the setting "},
        {"--time-step", "ReadOptions::time_step"},
        {"--columns", "ReadOptions::columns"},
        {"--units", "ReadOptions::units"},
        {"--radius", "ReadOptions::radius"},
        {"--density", "ReadOptions::density"},
    };
    constexpr std::string_view set = "--set ", out = "--out ";
    if (message.starts_with(set)) message.replace(0, set.size(), "setting ");
    if (message.starts_with(out)) {
        message.erase(0, out.size());
        // A name without a folder and an extension would not look like a file.
        if (!looks_like_a_file(message.substr(0, message.find(": ")))) message.insert(0, "./");
    }
    for (const auto& [option, instead] : words)
        for (std::size_t at = message.find(option); at != std::string::npos; at = message.find(option, at))
            message.replace(at, option.size(), instead), at += instead.size();
    return message;
}

Error::Error(const std::string& message, Kind kind) : std::runtime_error(message), kind_(kind) {
    std::string place = message.substr(0, message.find(": "));
    if (place.size() == message.size() || !may_be_a_file(place)) return;
    const int last = number_cut_off(place);
    const int before = last > 0 ? number_cut_off(place) : 0;
    line_ = before > 0 ? before : last;
    column_ = before > 0 ? last : 0;
    if (last > 0 || looks_like_a_file(place)) file_ = place;
}

void Frame::add(const Vector& where, double r, std::int32_t kind) {
    id.push_back(id.empty() ? 0 : id.back() + 1);
    species.push_back(kind);
    radius.push_back(r);
    position.push_back(where);
    velocity.emplace_back();
    spin.emplace_back();
    if (!orientation.empty()) orientation.emplace_back();
    if (!mass.empty()) mass.push_back(0);
}

Mesh Mesh::plate(const std::string& name, const Vector& corner, const Vector& first, const Vector& second) {
    const Vec3 at = inside(corner), a = inside(first), b = inside(second);
    return {
        name, {corner, outside(at + a), outside(at + a + b), outside(at + b)}, {{0, 1, 2}, {0, 2, 3}}, false};
}

Mesh Mesh::box(const std::string& name, const Vector& low, const Vector& high) {
    Mesh mesh;
    mesh.name = name;
    mesh.glass = true;
    for (int k = 0; k < 8; ++k)
        mesh.points.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
    mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 2, 6}, {0, 6, 4},
                      {1, 5, 7}, {1, 7, 3}, {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6}};
    return mesh;
}

Mesh Mesh::from_file(const std::filesystem::path& file, double scale) {
    const TriangleMesh read = told([&] { return load_mesh(file, {scale}).mesh; });
    Mesh mesh;
    mesh.name = file.stem().string();
    for (const Vec3& point : read.vertices) mesh.points.push_back(outside(point));
    mesh.triangles = read.triangles;
    return mesh;
}

ContactLaw::~ContactLaw() = default;
double ContactLaw::stored_energy(const Touch&, ContactMemory) const {
    return kUnknown;
}

FrameSource::~FrameSource() = default;
FrameReader::~FrameReader() = default;

}  // namespace grainreel::v1
