// Binary STL of the walls, where they are in the last of the frames.
#include <cstring>
#include <filesystem>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/frame_writer.hpp"
#include "engine/files/frames/world.hpp"

namespace grainreel {

namespace {

class Stl final : public FrameWriter {
  public:
    explicit Stl(std::filesystem::path path) : path_(std::move(path)) {}

    void begin(const World& world, const FrameSupply&) override {
        surfaces_ = surfaces_of(world);
        if (surfaces_.empty())
            throw UserError(path_.string() + ": the run has no walls, and STL has nothing but walls");
    }
    void frame(const Frame& frame) override { last_ = frame; }
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
                const auto corner = [&](std::size_t k) {
                    return mesh.vertices[static_cast<std::size_t>(t[k])];
                };
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
    std::optional<Frame> last_;
};

std::unique_ptr<FrameWriter> make(const std::filesystem::path& path) {
    return std::make_unique<Stl>(path);
}

}  // namespace

FrameFormat stl_format() {
    return {"stl", "walls as binary STL, where they are in the last frame", ".stl", make};
}

}  // namespace grainreel
