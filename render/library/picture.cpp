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
#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/container_faces.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/shown_values.hpp"

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
        throw RunError("{}: cannot be written: {}", path.string(), why);
    }
    std::filesystem::rename(part, path, error);
    if (!error) return;
    const std::string why = error.message();
    std::filesystem::remove(part, error);
    throw RunError("{}: cannot be written: {}", path.string(), why);
}

// Adds species that only the frame has, as "type 2" and so on. Counts the grains of species that the scene
// gives no grains, and enlarges each species' largest diameter to that in the frame.
void name_species(const State& frame, std::vector<Species>& species) {
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
void list_grains(const State& frame, Scene& scene) {
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
FilmedScene with_plain_film(const Scene& scene, const State& frame) {
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

constexpr const char* settings_name = "settings of a painter";

// The message without a place in the text that film_text() makes: the caller has never seen it.
std::string without_place(const std::string& message) {
    const std::string begin = std::string(settings_name) + ':';
    if (!message.starts_with(begin)) return message;
    const std::size_t end = message.find(": ");
    return end == std::string::npos ? message : settings_name + message.substr(end);
}

// A scene as text that has these species and nothing else. Each has one grain: as high as the highest in the
// frame, and as fast as the fastest. From these follow the ranges of colours where no setting says them.
std::string film_text(const grainreel::Scene& scene, const grainreel::State& frame) {
    std::string text = fmt::format("[film]\ntitle = {}\n", toml_text(scene.title));
    text += "[container]\nshape = \"none\"\n[run]\nduration = \"1 s\"\n";
    std::vector<double> high(scene.species.size(), 0), fast = high, large = high;
    double largest = 1e-3;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto s = static_cast<std::size_t>(frame.species[i]);
        if (s >= high.size()) continue;
        high[s] = std::max(high[s], (frame.position[i] - frame.floor().place).z());
        fast[s] = std::max(fast[s], frame.velocity[i].norm());
        large[s] = std::max(large[s], 2 * frame.radius[i]);
        largest = std::max(largest, large[s]);
    }
    for (std::size_t s = 0; s < scene.species.size(); ++s) {
        const std::string name = toml_text(scene.species[s].name);
        const double density = scene.species[s].density;
        text += fmt::format("[[species]]\nname = {}\ndiameter = \"{} m\"\ndensity = \"{} kg/m3\"\n", name,
                            large[s] > 0 ? large[s] : 1e-3,
                            density > 0 && std::isfinite(density) ? density : kGlassDensity);
        text += fmt::format("[[grain]]\nspecies = {}\nposition = [\"{} m\", \"0 m\", \"{} m\"]\n", name,
                            2 * largest * static_cast<double>(s), high[s]);
        text += fmt::format("velocity = [\"{} m/s\", \"0 m/s\", \"0 m/s\"]\n", fast[s]);
    }
    return text;
}

// Throws UserError where the film shows what frames of the library do not have. own: what the scene's film
// shows without settings; its marks are only left out.
void refuse_unknown(const FilmShows& shows, const FilmShows& own = {}) {
    const auto wants = [&](bool (*needs)(const FilmShows&)) { return needs(shows) && !needs(own); };
    const char* what = wants(needs_touches)        ? "contacts"
                       : wants(needs_displacement) ? "displacements over a period of the drive"
                       : wants(needs_measures)     ? "measures"
                                                   : nullptr;
    if (what != nullptr)
        throw UserError("a painter draws frames alone and knows no {0}; take out the setting that shows {0}",
                        what);
}

// Throws UserError for a colour of grains that needs what frames do not have. Reading the settings would ask
// for a range or a drive first.
void refuse_unknown_colour(const std::vector<std::string>& settings) {
    for (const std::string& one : settings) {
        const std::size_t is = one.find('=');
        if (is == std::string::npos || trimmed(one.substr(0, is)) != "film.colour.by") continue;
        FilmShows shows;
        for (const auto& [word, value] : grain_value_words)
            if (trimmed(one.substr(is + 1), " \t\"'") == word) shows.colour.by = value;
        refuse_unknown(shows);
    }
}

// Sets film and colours by the settings, which are read as keys of a scene with these species and nothing
// else. frame: where the grains are at first.
void take_settings(FilmedScene& scene, const grainreel::State& frame,
                   const std::vector<std::string>& settings) {
    refuse_unknown_colour(settings);
    try {
        const FilmedScene said = read_filmed_scene_text(film_text(scene, frame), settings_name,
                                                        Assignments(settings), measurable_in);
        scene.film = said.film;
        scene.colours = said.colours;
    } catch (const UserError& error) {
        throw UserError(without_place(error.what()));
    }
    refuse_unknown(scene.film.shows);
}

// The scene for walls that the caller gives, with the boxes of its meshes filled in.
grainreel::Scene scene_with_walls(const grainreel::StoredWorld& world) {
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

// shown: a frame whose grains all fit into the picture. first: the frame from which the ranges of colours
// follow.
FilmedScene plain_scene(const grainreel::Scene& scene, const grainreel::State& shown,
                        const grainreel::State& first, const std::vector<std::string>& settings) {
    FilmedScene filmed = with_plain_film(scene, shown);
    take_settings(filmed, first, settings);
    return filmed;
}

// Throws Error where the text cannot be written into a picture. what: the text, for the message.
void check_words(const std::string& text, const std::string& what) {
    if (const std::string complaint = complaint_of_utf8(text); !complaint.empty())
        throw Error(fmt::format("{}: {}", what, complaint));
    if (text.find('\0') != std::string::npos)
        throw Error(fmt::format("{}: has a byte of 0; leave it out", what));
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
    Impl(FilmedScene filmed, std::size_t kinds, std::size_t moved)
        : scene(std::move(filmed)), species(kinds), bodies(moved), renderer(scene, raster_threads()) {}

    FilmedScene scene;
    std::size_t species, bodies;
    Renderer renderer;
};

Painter::Painter(const Scene& scene, const std::vector<std::string>& settings)
    : impl_(told([&] {
          FilmedScene filmed = filmed_scene(scene, settings);
          if (!settings.empty()) refuse_unknown(filmed.film.shows, filmed_scene(scene, {}).film.shows);
          return std::make_unique<Impl>(std::move(filmed), scene.impl().scene.species.size(),
                                        kFirstPlaneBody);
      })) {}

Painter::Painter(const World& world, const Frame& first, const std::vector<std::string>& settings)
    : impl_(told([&] {
          check_words(world.title, "the title of a world");
          for (const std::string& name : world.species) check_words(name, "the name of a species");
          const grainreel::StoredWorld inner = inside(world);
          const std::string who = "the first frame of a painter";
          grainreel::State frame = inside(first, world.species.size(), who);
          take_poses(frame, first.bodies.size(), inner.bodies.size(), who);
          FilmedScene filmed = plain_scene(scene_with_walls(inner), frame, frame, settings);
          for (const Mesh& wall : world.walls)
              (wall.glass ? filmed.film.look.walls.glass : filmed.film.look.walls.solid).push_back(wall.name);
          return std::make_unique<Impl>(std::move(filmed), world.species.size(), inner.bodies.size());
      })) {}

Painter::Painter(const FrameFile& file, const std::vector<std::string>& settings)
    : impl_(told([&] {
          const StateArchive& frames = *file.impl().archive;
          const grainreel::State last = frames.grains(frames.moments().size() - 1);
          const grainreel::State first = frames.moments().size() > 1 ? frames.first_whole() : last;
          const grainreel::Scene scene = frames.scene() ? *frames.scene() : scene_with_walls(frames.world());
          FilmedScene filmed = plain_scene(scene, last, first, settings);
          const std::size_t kinds = filmed.species.size();
          return std::make_unique<Impl>(std::move(filmed), kinds, kFirstPlaneBody);
      })) {}

Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;

Picture Painter::draw(const Frame& frame, const std::string& words) {
    const std::string who = "a frame to draw";
    check_words(words, "the words of a picture");
    grainreel::State inner = inside(frame, impl_->species, who);
    take_poses(inner, frame.bodies.size(), std::max(impl_->bodies, inner.bodies.size()), who);
    const Shot shot(std::move(inner));
    const grainreel::Picture& drawn =
        told([&]() -> const grainreel::Picture& { return impl_->renderer.draw(shot, words); });
    return {drawn.width, drawn.height, drawn.rgba};
}

}  // namespace grainreel::v1
