#include "engine/files/trajectory/trajectory_layout.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <algorithm>
#include <cmath>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

constexpr const char *mesh_dimension = "mesh", *vertex_dimension = "vertex", *triangle_dimension = "triangle";

// The meshes as they lie in the file, one after the other.
struct Flat {
    std::vector<int> body, vertex_count, triangle_count;
    std::vector<double> vertices;  // x, y, z, x, y, z ...
    std::vector<int> triangles;    // three vertices of each

    std::array<int, 2> sum() const {
        Checksum sum;
        for (const std::vector<int>* counts : {&body, &vertex_count, &triangle_count})
            sum.add(counts->data(), counts->size());
        sum.add(vertices.data(), vertices.size());
        sum.add(triangles.data(), triangles.size());
        return sum.words();
    }
    bool operator==(const Flat&) const = default;
};

Flat flat(const std::vector<TrajectoryMesh>& meshes) {
    Flat all;
    for (const auto& [body, shape] : meshes) {
        all.body.push_back(static_cast<int>(body));
        all.vertex_count.push_back(static_cast<int>(shape.vertices.size()));
        all.triangle_count.push_back(static_cast<int>(shape.triangles.size()));
        for (const Vec3& vertex : shape.vertices)
            all.vertices.insert(all.vertices.end(), vertex.begin(), vertex.end());
        for (const TriangleMesh::Triangle& triangle : shape.triangles)
            all.triangles.insert(all.triangles.end(), triangle.begin(), triangle.end());
    }
    return all;
}

[[noreturn]] void damaged(const std::filesystem::path& path, const std::string& what) {
    throw UserError("{}: the shapes of its meshes are damaged: {}; copy the file again", path.string(), what);
}

// The length of a dimension. Throws UserError where it is too large for the file's size, which is damage.
std::size_t length_of(const NetcdfFile& file, const std::filesystem::path& path, const char* dimension) {
    const std::size_t length = file.length(dimension);
    std::error_code error;
    if (length > std::filesystem::file_size(path, error) / sizeof(int) || error)
        damaged(path, fmt::format("it claims {} of the dimension `{}`", length, dimension));
    return length;
}

Flat read_flat(const NetcdfFile& file, const std::filesystem::path& path) {
    const std::size_t meshes = length_of(file, path, mesh_dimension),
                      vertices = length_of(file, path, vertex_dimension),
                      triangles = length_of(file, path, triangle_dimension);
    Flat all{std::vector<int>(meshes), std::vector<int>(meshes), std::vector<int>(meshes),
             std::vector<double>(3 * vertices), std::vector<int>(3 * triangles)};
    const auto get = [&](const TrajectoryVariable& variable, std::vector<std::size_t> count, auto& values) {
        if (variable.dimension != nullptr) count.push_back(3);
        file.get(file.find_variable(variable.name), std::vector<std::size_t>(count.size(), 0), count,
                 values.data());
    };
    get(mesh_body_variable, {meshes}, all.body);
    get(mesh_vertices_variable, {meshes}, all.vertex_count);
    get(mesh_triangles_variable, {meshes}, all.triangle_count);
    get(vertex_variable, {vertices}, all.vertices);
    get(triangle_variable, {triangles}, all.triangles);
    std::array<int, 2> words{};
    file.get(file.find_variable(mesh_checksum), {0}, {2}, words.data());
    if (words != all.sum()) damaged(path, "their checksum is not that of their numbers");
    return all;
}

// Checks for what no program can have written, even where the checksum is right.
void check(const Flat& all, const std::filesystem::path& path, std::size_t bodies) {
    std::size_t vertices = 0, triangle = 0;
    for (std::size_t m = 0; m < all.body.size(); ++m) {
        const int own = all.vertex_count[m], faces = all.triangle_count[m];
        if (all.body[m] < 0 || static_cast<std::size_t>(all.body[m]) >= bodies ||
            (m > 0 && all.body[m] <= all.body[m - 1]))
            damaged(path, fmt::format("mesh {} is of body {}", m, all.body[m]));
        if (own < 0 || faces < 0 || triangle + static_cast<std::size_t>(faces) > all.triangles.size() / 3)
            damaged(path, fmt::format("mesh {} has {} triangles", m, faces));
        for (const std::size_t end = triangle + static_cast<std::size_t>(faces); triangle < end; ++triangle)
            for (std::size_t k = 3 * triangle; k < 3 * triangle + 3; ++k)
                if (all.triangles[k] < 0 || all.triangles[k] >= own)
                    damaged(path, fmt::format("a triangle of mesh {} has the vertex {} of {}", m,
                                              all.triangles[k], own));
        vertices += static_cast<std::size_t>(own);
    }
    if (3 * vertices != all.vertices.size() || 3 * triangle != all.triangles.size())
        damaged(path, "their counts do not add up");
    const auto far = [](double x) { return !(std::abs(x) <= kFarthestPlace); };
    if (std::any_of(all.vertices.begin(), all.vertices.end(), far)) damaged(path, "a vertex is no place");
}

}  // namespace

void define_meshes(NetcdfFile& file, const std::vector<TrajectoryMesh>& meshes, int spatial, int checksum) {
    const Flat all = flat(meshes);
    const int mesh = file.dimension(mesh_dimension, meshes.size()),
              vertex = file.dimension(vertex_dimension, all.vertices.size() / 3),
              triangle = file.dimension(triangle_dimension, all.triangles.size() / 3),
              corner = file.dimension("corner", 3);
    const auto define = [&](const TrajectoryVariable& of, const std::vector<int>& shape) {
        const int variable = file.variable(of.name, of.type, shape, of.units);
        file.attribute(variable, "long_name", of.about);
        if (*of.comment != 0) file.attribute(variable, "comment", of.comment);
    };
    define(mesh_body_variable, {mesh});
    define(mesh_vertices_variable, {mesh});
    define(mesh_triangles_variable, {mesh});
    define(vertex_variable, {vertex, spatial});
    define(triangle_variable, {triangle, corner});
    const int sum = file.variable(mesh_checksum, NC_INT, {checksum}, "1");
    file.attribute(sum, "long_name", mesh_checksum_about);
    file.attribute(sum, "comment", checksum_comment);
}

void write_meshes(NetcdfFile& file, const std::vector<TrajectoryMesh>& meshes) {
    const Flat all = flat(meshes);
    for (const auto& [variable, counts] : {std::pair{&mesh_body_variable, &all.body},
                                           {&mesh_vertices_variable, &all.vertex_count},
                                           {&mesh_triangles_variable, &all.triangle_count}})
        file.put(file.find_variable(variable->name), {0}, {counts->size()}, counts->data());
    file.put(file.find_variable(vertex_variable.name), {0, 0}, {all.vertices.size() / 3, 3},
             all.vertices.data());
    file.put(file.find_variable(triangle_variable.name), {0, 0}, {all.triangles.size() / 3, 3},
             all.triangles.data());
    file.put(file.find_variable(mesh_checksum), {0}, {2}, all.sum().data());
}

std::vector<TrajectoryMesh> read_meshes(const NetcdfFile& file, const std::filesystem::path& path,
                                        std::size_t bodies) {
    std::vector<TrajectoryMesh> meshes;
    if (!file.has_variable(mesh_body_variable.name)) return meshes;
    const Flat all = read_flat(file, path);
    check(all, path, bodies);
    const double* vertex = all.vertices.data();
    const int* corner = all.triangles.data();
    for (std::size_t m = 0; m < all.body.size(); ++m) {
        TrajectoryMesh& mesh = meshes.emplace_back();
        mesh.body = static_cast<std::size_t>(all.body[m]);
        for (int v = 0; v < all.vertex_count[m]; ++v, vertex += 3) mesh.shape.vertices.emplace_back(vertex);
        for (int t = 0; t < all.triangle_count[m]; ++t, corner += 3)
            mesh.shape.triangles.push_back({corner[0], corner[1], corner[2]});
    }
    return meshes;
}

bool same_meshes(const std::vector<TrajectoryMesh>& a, const std::vector<TrajectoryMesh>& b) {
    return flat(a) == flat(b);
}

TrajectoryInfo trajectory_info(const Scene& scene, const Plan& plan, const std::string& version) {
    TrajectoryInfo info;
    info.title = scene.title;
    info.program_version = version;
    for (const Species& species : scene.species) info.species.push_back(species.name);
    info.capacity = static_cast<std::size_t>(plan.capacity);
    info.traffic = plan.traffic;
    for (const ScenePlane& wall : scene.walls) info.bodies.push_back(wall.name);
    for (const SceneMesh& mesh : scene.meshes) {
        info.meshes.push_back({kFirstPlaneBody + info.bodies.size(), mesh.shape()});
        info.bodies.push_back(mesh.name);
    }
    info.container_turns = scene.container.turn.has_value();
    info.orientation = scene.keeps_orientations();
    info.contact_numbers = true;
    info.cell.origin = extent_of(scene).low;
    if (scene.container.periodic_depth) info.cell.length.x() = scene.container.depth;
    info.facts = file_facts(scene);
    return info;
}

}  // namespace grainreel
