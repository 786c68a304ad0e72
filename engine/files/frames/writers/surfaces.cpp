// Two writers of triangles, both of the last frame: glTF 2.0 (.glb) and binary STL (.stl). In glTF each
// species has one sphere mesh. In small beds each grain is a node that shows it; in large ones the spheres
// are instances (EXT_mesh_gpu_instancing), which not all programs read. Lengths are in m and y points up.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

using Json = nlohmann::ordered_json;

// Turns a vector from axes with z up into axes with y up.
Vec3 turned(const Vec3& v) {
    return {v.x(), v.z(), -v.y()};
}

// The colours of species in films (Okabe and Ito 2008), as linear light.
constexpr double kColours[][3] = {{0.094, 0.456, 0.807}, {0.665, 0.112, 0.0},   {0.0, 0.342, 0.171},
                                  {0.604, 0.191, 0.386}, {0.871, 0.776, 0.055}, {0.0, 0.168, 0.445},
                                  {0.791, 0.347, 0.0}};

class Glb {
  public:
    Glb() {
        json_["asset"] = {{"version", "2.0"}, {"generator", "grainreel"}};
        for (const char* list : {"nodes", "meshes", "materials", "accessors", "bufferViews"})
            json_[list] = Json::array();
    }
    // Adds float vectors of `width` numbers each and returns the number of their accessor.
    std::size_t floats(const std::vector<float>& values, std::size_t width, bool bounds) {
        Json accessor = {{"bufferView", view(values.data(), values.size() * sizeof(float))},
                         {"componentType", 5126},
                         {"count", values.size() / width},
                         {"type", width == 4   ? "VEC4"
                                  : width == 3 ? "VEC3"
                                               : "SCALAR"}};
        if (bounds) {
            std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width)),
                high = low;
            for (std::size_t i = 0; i < values.size(); ++i) {
                low[i % width] = std::min(low[i % width], values[i]);
                high[i % width] = std::max(high[i % width], values[i]);
            }
            accessor["min"] = low;
            accessor["max"] = high;
        }
        json_["accessors"].push_back(accessor);
        return json_["accessors"].size() - 1;
    }
    std::size_t indices(const std::vector<std::uint32_t>& values) {
        json_["accessors"].push_back(
            {{"bufferView", view(values.data(), values.size() * sizeof(std::uint32_t))},
             {"componentType", 5125},
             {"count", values.size()},
             {"type", "SCALAR"}});
        return json_["accessors"].size() - 1;
    }
    std::size_t material(const std::string& name, const double (&rgb)[3], double alpha) {
        Json one = {{"name", name},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {rgb[0], rgb[1], rgb[2], alpha}},
                      {"metallicFactor", 0},
                      {"roughnessFactor", 0.6}}},
                    {"doubleSided", true}};
        if (alpha < 1) one["alphaMode"] = "BLEND";
        json_["materials"].push_back(one);
        return json_["materials"].size() - 1;
    }
    std::size_t mesh(const std::string& name, const std::vector<float>& places,
                     const std::vector<float>& normals, const std::vector<std::uint32_t>& corners,
                     std::size_t material_number) {
        Json attributes = {{"POSITION", floats(places, 3, true)}};
        if (!normals.empty()) attributes["NORMAL"] = floats(normals, 3, false);
        json_["meshes"].push_back(
            {{"name", name},
             {"primitives",
              {{{"attributes", attributes}, {"indices", indices(corners)}, {"material", material_number}}}}});
        return json_["meshes"].size() - 1;
    }
    std::size_t node(Json one) {
        json_["nodes"].push_back(std::move(one));
        return json_["nodes"].size() - 1;
    }
    // Adds a node that is part of the scene itself, and not of another node.
    void root(Json one) { roots_.push_back(node(std::move(one))); }
    // A program without this extension must not open the file: it would draw one sphere of 1 m a species.
    void need_instances() {
        json_["extensionsUsed"] = json_["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    }

    // The whole file: "glTF", version and length, then the chunk "JSON" and the chunk "BIN".
    std::string bytes() {
        json_["scenes"] = {{{"nodes", roots_}}};
        json_["scene"] = 0;
        json_["buffers"] = {{{"byteLength", buffer_.size()}}};
        std::string text = json_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string out;
        const auto add = [&](std::size_t value) {
            const auto number = static_cast<std::uint32_t>(value);
            out.append(reinterpret_cast<const char*>(&number), sizeof(number));
        };
        add(0x46546C67);
        add(2);
        add(12 + 8 + text.size() + 8 + buffer_.size());
        add(text.size());
        add(0x4E4F534A);
        out += text;
        add(buffer_.size());
        add(0x004E4942);
        return out + buffer_;
    }

  private:
    std::size_t view(const void* data, std::size_t size) {
        json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}});
        buffer_.append(static_cast<const char*>(data), size);
        buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
        return json_["bufferViews"].size() - 1;
    }

    Json json_, roots_ = Json::array();
    std::string buffer_;
};

struct Sphere {
    std::vector<float> places;
    std::vector<std::uint32_t> corners;
};

// A sphere of 320 triangles: each triangle of an icosahedron is divided into four, twice.
Sphere unit_sphere() {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<Vec3> points;
    for (const Vec3& v :
         {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g),
          Vec3(0, -1, -g), Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)})
        points.push_back(v.normalized());
    std::vector<std::uint32_t> faces{0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                     4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                     6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    for (int parting = 0; parting < 2; ++parting) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> between;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] =
                between.emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
            if (is_new) points.push_back((points[a] + points[b]).normalized());
            return found->second;
        };
        std::vector<std::uint32_t> smaller;
        for (std::size_t k = 0; k < faces.size(); k += 3) {
            const std::uint32_t a = faces[k], b = faces[k + 1], c = faces[k + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            smaller.insert(smaller.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
        }
        faces = std::move(smaller);
    }
    Sphere sphere;
    for (const Vec3& p : points)
        for (int axis = 0; axis < 3; ++axis) sphere.places.push_back(static_cast<float>(p[axis]));
    sphere.corners = std::move(faces);
    return sphere;
}

class Gltf final : public StateWriter {
  public:
    explicit Gltf(std::filesystem::path path) : path_(std::move(path)) {}

    void begin(const StoredWorld& world, const StateSupply&) override { world_ = world; }
    void frame(const State& frame, const std::vector<Link>&) override { last_ = frame; }
    void end() override {
        if (!last_) throw RunError(path_.string() + ": there is no frame");
        Glb glb;
        const Sphere sphere = unit_sphere();
        for (std::size_t s = 0; s < world_.species.size(); ++s) add_species(s, sphere, glb);
        const double glass[3] = {0.75, 0.8, 0.85};
        for (const WorldSurface& surface : surfaces_of(world_)) {
            const TriangleMesh mesh = moved(surface, *last_);
            std::vector<float> places;
            std::vector<std::uint32_t> corners;
            for (const Vec3& vertex : mesh.vertices)
                for (int axis = 0; axis < 3; ++axis)
                    places.push_back(static_cast<float>(turned(vertex)[axis]));
            for (const TriangleMesh::Triangle& t : mesh.triangles)
                for (const std::int32_t v : t) corners.push_back(static_cast<std::uint32_t>(v));
            const std::size_t number =
                glb.mesh(surface.name, places, {}, corners, glb.material(surface.name, glass, 0.3));
            glb.root({{"name", surface.name}, {"mesh", number}});
        }
        TextFile(path_).write(glb.bytes());
    }

  private:
    static constexpr std::size_t kMostNodes = 5000;  // viewers stay quick with so many

    void add_species(std::size_t s, const Sphere& sphere, Glb& glb) const {
        std::vector<std::size_t> grains;
        for (std::size_t i = 0; i < last_->size(); ++i)
            if (static_cast<std::size_t>(last_->species[i]) == s) grains.push_back(i);
        if (grains.empty()) return;
        const std::string& name = world_.species[s].name;
        const std::size_t colour = glb.material(name, kColours[s % std::size(kColours)], 1);
        const std::size_t mesh = glb.mesh(name, sphere.places, sphere.places, sphere.corners, colour);
        if (last_->size() <= kMostNodes)
            add_nodes(name, mesh, grains, glb);
        else
            add_instances(name, mesh, grains, glb);
    }

    // A node for each grain, under one of the species' name.
    void add_nodes(const std::string& name, std::size_t mesh, const std::vector<std::size_t>& grains,
                   Glb& glb) const {
        Json children = Json::array();
        for (const std::size_t i : grains) {
            const Vec3 place = turned(last_->position[i]);
            const auto size = static_cast<float>(last_->radius[i]);
            children.push_back(glb.node({{"mesh", mesh},
                                         {"translation",
                                          {static_cast<float>(place.x()), static_cast<float>(place.y()),
                                           static_cast<float>(place.z())}},
                                         {"scale", {size, size, size}}}));
        }
        glb.root({{"name", name}, {"children", children}});
    }

    void add_instances(const std::string& name, std::size_t mesh, const std::vector<std::size_t>& grains,
                       Glb& glb) const {
        std::vector<float> places, sizes;
        for (const std::size_t i : grains) {
            for (int axis = 0; axis < 3; ++axis) {
                places.push_back(static_cast<float>(turned(last_->position[i])[axis]));
                sizes.push_back(static_cast<float>(last_->radius[i]));
            }
        }
        glb.need_instances();
        glb.root({{"name", name},
                  {"mesh", mesh},
                  {"extensions",
                   {{"EXT_mesh_gpu_instancing",
                     {{"attributes",
                       {{"TRANSLATION", glb.floats(places, 3, false)},
                        {"SCALE", glb.floats(sizes, 3, false)}}}}}}}});
    }

    std::filesystem::path path_;
    StoredWorld world_;
    std::optional<State> last_;
};

// Binary STL of the walls, where they are in the last frame.
class Stl final : public StateWriter {
  public:
    explicit Stl(std::filesystem::path path) : path_(std::move(path)) {}

    void begin(const StoredWorld& world, const StateSupply&) override {
        surfaces_ = surfaces_of(world);
        if (surfaces_.empty())
            throw UserError(path_.string() + ": the run has no walls, and STL has nothing but walls");
    }
    void frame(const State& frame, const std::vector<Link>&) override { last_ = frame; }
    void end() override {
        if (!last_) throw RunError(path_.string() + ": there is no frame");
        std::string bytes(80, '\0');
        const std::string head = "walls by grainreel, in m";
        std::memcpy(bytes.data(), head.data(), head.size());
        std::uint32_t count = 0;
        std::string rows;
        for (const WorldSurface& surface : surfaces_) {
            const TriangleMesh mesh = moved(surface, *last_);
            for (const TriangleMesh::Triangle& t : mesh.triangles) {
                const auto corner = [&](std::size_t k) { return mesh.vertices[t[k]]; };
                const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
                for (const Vec3& v : {normal, corner(0), corner(1), corner(2)})
                    for (int axis = 0; axis < 3; ++axis) add(rows, static_cast<float>(v[axis]));
                add(rows, std::uint16_t{0});
                ++count;
            }
        }
        add(bytes, count);
        TextFile(path_).write(bytes + rows);
    }

  private:
    template <class T>
    static void add(std::string& to, T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        to.append(raw, sizeof(T));
    }

    std::filesystem::path path_;
    std::vector<WorldSurface> surfaces_;
    std::optional<State> last_;
};

}  // namespace

WriteFormat gltf_format() {
    return {"gltf", "glTF 2.0 (.glb) of the last frame: spheres and walls", ".glb", make_writer<Gltf>};
}

WriteFormat stl_format() {
    return {"stl", "walls as binary STL, where they are in the last frame", ".stl", make_writer<Stl>};
}

}  // namespace grainreel
