// Draws the pictures of the public library (grainreel/picture.hpp): turns scenes, frames and settings into
// those of the renderer. The public header has types of its own; engine/library/internal.hpp converts between
// them and ours.
#include "engine/library/internal.hpp"

#include "grainreel/picture.hpp"

#include <fmt/format.h>
#include <png.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"
#include "engine/measure/columns.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// rgba: 4 bytes a pixel, rows from the top. The file is written as `path`.part and renamed when it is whole.
// Throws RunError that names the file and the reason. Films have a faster way (render/film/codec/png.hpp),
// which needs more libraries.
void write_png_file(const std::filesystem::path& path, int width, int height,
                    const std::vector<std::uint8_t>& rgba) {
    std::filesystem::path part = path;
    part += ".part";
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(width);
    png.height = static_cast<png_uint_32>(height);
    png.format = PNG_FORMAT_RGBA;
    std::error_code error;
    errno = 0;
    if (png_image_write_to_file(&png, part.c_str(), 0, rgba.data(), 0, nullptr) == 0) {
        const std::string why = errno != 0 ? std::strerror(errno) : png.message;
        std::filesystem::remove(part, error);
        throw RunError(fmt::format("{}: cannot be written: {}", path.string(), why));
    }
    std::filesystem::rename(part, path, error);
    if (!error) return;
    const std::string why = error.message();
    std::filesystem::remove(part, error);
    throw RunError(fmt::format("{}: cannot be written: {}", path.string(), why));
}

// Adds species that only the frame has, as "type 2" and so on. Counts the grains of species that the scene
// gives no grains, and enlarges each species' largest diameter to that in the frame.
void name_species(const Frame& frame, std::vector<Species>& species) {
    std::vector<bool> counted;
    for (const Species& one : species) counted.push_back(one.all() > 0);
    const auto unknown = [&](std::size_t kind) { return kind >= counted.size() || !counted[kind]; };
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto kind = static_cast<std::size_t>(frame.species[i]);
        while (species.size() <= kind) {
            species.emplace_back();
            species.back().name = "type " + std::to_string(species.size());
        }
        if (unknown(kind)) ++species[kind].count;
        double& largest = species[kind].diameter.largest;
        largest = std::max(largest, 2 * frame.radius[i]);
    }
}

// Lists the frame's grains in the scene, and gives its container the size of the box around them.
void list_grains(const Frame& frame, Scene& scene) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
        ListedGrain grain;
        grain.species = static_cast<std::size_t>(frame.species[i]);
        grain.position = frame.position[i];
        scene.start.grains.push_back(grain);
    }
    const Vec3 size = extent_of(scene).size();
    scene.container.depth = size.x();
    scene.container.half_width = 0.5 * size.y();
    scene.container.height = size.z();
}

// A film for frames that come without one: it has all defaults, and the species have the palette's colours.
// What the scene itself says of its film and colours is ignored. The frame adds species that the scene lacks.
// If the scene has neither a container nor listed grains, the frame also tells how much room the grains take.
FilmedScene with_plain_film(const Scene& scene, const Frame& frame) {
    FilmedScene filmed{scene, {}, {}};
    name_species(frame, filmed.species);
    if (filmed.container.shape == Container::Shape::none && filmed.start.grains.empty())
        list_grains(frame, filmed);
    while (filmed.colours.size() < filmed.species.size())
        filmed.colours.push_back(default_colour(filmed.colours));
    return filmed;
}

}  // namespace
}  // namespace grainreel

namespace grainreel::v1 {
namespace {

FilmedScene filmed_scene(const Scene& scene, const std::vector<std::string>& settings) {
    const Scene::Impl& read = scene.impl();
    Assignments all;
    // A painter's setting may take the place of a key of the scene's settings that it excludes. The two have
    // places of different kinds, which tells the reader so (Document::set).
    for (const std::string& one : read.settings)
        all.push_back({one, "the scene's setting " + Assignment(one).key()});
    all.insert(all.end(), settings.begin(), settings.end());
    return read_filmed_scene_text(read.text, read.file, all, measurable_in);
}

// A TOML string: quotes, backslashes and control characters escaped.
std::string toml_text(const std::string& text) {
    std::string toml = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            toml += fmt::format("\\{}", c);
        else if (static_cast<unsigned char>(c) < 0x20)
            toml += fmt::format("\\u{:04x}", static_cast<int>(c));
        else
            toml += c;
    }
    return toml + '"';
}

// Sets film and colours by the settings, which are read as keys of a scene with these species and nothing
// else.
void take_settings(FilmedScene& scene, const std::vector<std::string>& settings) {
    std::string text = fmt::format("[film]\ntitle = {}\n", toml_text(scene.title));
    text += "[container]\nshape = \"none\"\n[run]\nduration = \"1 s\"\n";
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        text += fmt::format(
            "[[species]]\nname = {0}\ndiameter = \"1 mm\"\ndensity = \"1 g/cm3\"\n[[grain]]\nspecies = {0}\n"
            "position = [\"{1} m\", \"0 m\", \"0 m\"]\n",
            toml_text(scene.species[s].name), s);
    const FilmedScene said =
        read_filmed_scene_text(text, "settings of a painter", Assignments(settings), measurable_in);
    scene.film = said.film;
    scene.colours = said.colours;
}

// The scene for walls that the caller gives, with the boxes of its meshes filled in.
grainreel::Scene scene_with_walls(const grainreel::World& world) {
    grainreel::Scene scene = scene_of(world);
    for (SceneMesh& mesh : scene.meshes) {
        const TriangleMesh& triangles = mesh.surface->mesh();
        MeshFacts facts = mesh.surface->facts();
        facts.low = facts.high = triangles.vertices.front();
        for (const Vec3& point : triangles.vertices) {
            facts.low = facts.low.cwiseMin(point);
            facts.high = facts.high.cwiseMax(point);
        }
        mesh.low = facts.low;
        mesh.high = facts.high;
        mesh.surface.of = std::make_shared<const Surface>(triangles, facts, mesh.name);
    }
    return scene;
}

FilmedScene plain_scene(const grainreel::Scene& scene, const grainreel::Frame& frame,
                        const std::vector<std::string>& settings) {
    FilmedScene filmed = with_plain_film(scene, frame);
    take_settings(filmed, settings);
    return filmed;
}

// Threads of the software rasteriser: more than a few are of no use for one picture.
int raster_threads() {
    return std::clamp(usable_processors(), 1, 8);
}

}  // namespace

void Picture::write_png(const std::filesystem::path& file) const {
    if (width < 1 || height < 1 ||
        rgba.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4)
        throw Error(fmt::format("{}: a picture of {} x {} pixels has {} bytes; 4 a pixel were expected",
                                file.string(), width, height, rgba.size()));
    told([&] { write_png_file(file, width, height, rgba); });
}

struct Painter::Impl {
    Impl(FilmedScene filmed, std::size_t kinds)
        : scene(std::move(filmed)), species(kinds), renderer(scene, raster_threads()) {}

    FilmedScene scene;
    std::size_t species;
    Renderer renderer;
};

Painter::Painter(const Scene& scene, const std::vector<std::string>& settings)
    : impl_(told([&] {
          return std::make_unique<Impl>(filmed_scene(scene, settings), scene.impl().scene.species.size());
      })) {}

Painter::Painter(const World& world, const Frame& first, const std::vector<std::string>& settings)
    : impl_(told([&] {
          const grainreel::Frame frame = inside(first, world.species.size(), "the first frame of a painter");
          FilmedScene filmed = plain_scene(scene_with_walls(inside(world)), frame, settings);
          for (const Mesh& wall : world.walls)
              (wall.glass ? filmed.film.look.walls.glass : filmed.film.look.walls.solid).push_back(wall.name);
          return std::make_unique<Impl>(std::move(filmed), world.species.size());
      })) {}

Painter::Painter(const FrameFile& file, const std::vector<std::string>& settings)
    : impl_(told([&] {
          const FrameArchive& frames = *file.impl().archive;
          const grainreel::Frame last = frames.grains(frames.moments().size() - 1);
          const grainreel::Scene scene = frames.scene() ? *frames.scene() : scene_with_walls(frames.world());
          FilmedScene filmed = plain_scene(scene, last, settings);
          const std::size_t kinds = filmed.species.size();
          return std::make_unique<Impl>(std::move(filmed), kinds);
      })) {}

Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;

Picture Painter::draw(const Frame& frame, const std::string& words) {
    const grainreel::Frame inner = inside(frame, impl_->species, "a frame to draw");
    const grainreel::Picture& drawn =
        told([&]() -> const grainreel::Picture& { return impl_->renderer.draw(inner, words); });
    return {drawn.width, drawn.height, drawn.rgba};
}

}  // namespace grainreel::v1
