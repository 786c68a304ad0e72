// A folder for Blender (3.4 or newer): bed.bin with every frame, and bed.py, which builds the moving bed from
// it:
//     blender --python bed.py            (or blender -b --python bed.py -- --render 10 picture.png)
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/frame_writer.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/files/frames/writers/blender_script.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

class Blender final : public FrameWriter {
  public:
    explicit Blender(const fs::path& folder) : folder_(folder) {
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error) throw RunError(fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
        out_.open(folder_ / "bed.bin", std::ios::binary | std::ios::trunc);
    }

    void begin(const World& world, const FrameSupply&) override {
        surfaces_ = surfaces_of(world);
        head_["program"] = "grainreel";
        head_["title"] = world.title;
        for (const WorldSpecies& species : world.species) head_["species"].push_back(species.name);
        head_["walls"] = nlohmann::json::array();
        for (const WorldSurface& surface : surfaces_) {
            nlohmann::json one = {{"name", surface.name},
                                  {"vertices", nlohmann::json::array()},
                                  {"triangles", surface.shape.triangles}};
            for (const Vec3& v : surface.shape.vertices) one["vertices"].push_back({v.x(), v.y(), v.z()});
            head_["walls"].push_back(one);
        }
        head_["frames"] = nlohmann::json::array();
    }
    // The numbers of a frame: species and id (int32 each a grain), then x y z radius (float32 each a grain).
    void frame(const Frame& frame) override {
        nlohmann::json poses = nlohmann::json::array();
        for (const WorldSurface& surface : surfaces_) {
            const BodyPose pose = frame.body(surface.body);
            poses.push_back({pose.place.x(), pose.place.y(), pose.place.z(), pose.rotation.w(),
                             pose.rotation.x(), pose.rotation.y(), pose.rotation.z()});
        }
        head_["frames"].push_back(
            {{"time", frame.time}, {"grains", frame.size()}, {"offset", place_}, {"walls", poses}});
        std::string bytes;
        const auto add = [&](const void* data, std::size_t size) {
            bytes.append(static_cast<const char*>(data), size);
        };
        add(frame.species.data(), frame.size() * sizeof(std::int32_t));
        add(frame.id.data(), frame.size() * sizeof(std::int32_t));
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3& x = frame.position[i];
            const float row[4] = {static_cast<float>(x.x()), static_cast<float>(x.y()),
                                  static_cast<float>(x.z()), static_cast<float>(frame.radius[i])};
            add(row, sizeof(row));
        }
        out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        place_ += bytes.size();
        if (!out_)
            throw RunError(
                fmt::format("{}: cannot be written; is the disk full?", (folder_ / "bed.bin").string()));
    }
    void end() override {
        out_.close();
        if (!out_)
            throw RunError(
                fmt::format("{}: cannot be written; is the disk full?", (folder_ / "bed.bin").string()));
        TextFile(folder_ / "bed.json").write(head_.dump());
        TextFile(folder_ / "bed.py").write(blender_script());
    }

  private:
    fs::path folder_;
    std::ofstream out_;
    nlohmann::json head_;
    std::vector<WorldSurface> surfaces_;
    std::uint64_t place_ = 0;
};

std::unique_ptr<FrameWriter> make(const fs::path& path) {
    return std::make_unique<Blender>(path);
}

}  // namespace

FrameFormat blender_format() {
    return {"blender", "folder for Blender: all frames, and a script that builds the moving bed", "-blender",
            make};
}

}  // namespace grainreel
