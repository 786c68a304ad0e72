// Tells the engine of a film: its text, its colours, and its wishes (what the engine shall measure and keep
// for it). Also the reader of [film] and of the colours of species, which works beside the engine's reader
// and checks the film against the scene.
#include "render/scene/filmed_scene.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/json_schema.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/scene/film.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

// The wishes of a film. The engine measures what the film shows, and keeps orientations where the film shows
// how grains turn.
Wishes wishes_of(const FilmedScene& scene) {
    Wishes wishes;
    const auto take_instrument = [&](const std::string& name) {
        std::vector<std::string>& taken = wishes.instruments;
        if (!contains(taken, name)) taken.push_back(name);
    };
    const auto take = [&](const std::string& name) {
        for (const MeasureColumn& column : scene.measurable.columns)
            if (column.name == name && !column.instrument.empty()) take_instrument(column.instrument);
    };
    const FilmShows& shows = scene.film.shows;
    if (shows.wall_forces.wanted) take_instrument("walls");
    if (shows_wear(scene)) take_instrument("wear");
    for (const FilmPlot& plot : shows.plots) take(plot.column);
    for (const LiveWords& words : shows.live_words) take(words.column);
    for (const FilmCaption& caption : scene.film.captions)
        for (const LiveWords& words : caption.words) take(words.column);
    wishes.orientation = scene.film.look.rotation;
    return wishes;
}

}  // namespace

void tell_engine(FilmedScene& scene) {
    SceneText text;
    write_film(text, scene);
    scene.film_text = text.take();
    for (std::size_t i = 0; i < scene.species.size() && i < scene.colours.size(); ++i)
        scene.species[i].colour_text = quoted(colour_text(scene.colours[i]));
    scene.wishes = wishes_of(scene);
}

std::string resolved_scene(const FilmedScene& scene, const Plan& plan) {
    FilmedScene told = scene;
    tell_engine(told);
    return resolved_scene(static_cast<const Scene&>(told), plan);
}

// From here on: reading a scene with its film.

namespace {

// The smallest distance from the camera to where it looks, as a share of the scene's size. Below it rounding
// decides the direction.
constexpr double closest_camera = 1e-6;

[[noreturn]] void fail(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError("{}: '{}' {}", scene.where(key), name_of(key), what);
}

void check_film(const FilmedScene& scene) {
    const Film& film = scene.film;
    const Camera& camera = film.camera;
    const Extent extent = extent_of(scene);
    const Vec3 looks_at = camera.target.value_or(extent.middle());
    if (camera.position && (*camera.position - looks_at).norm() <= closest_camera * extent.size().norm())
        fail(scene, "film.camera.position", "is where the camera looks; move it, or the target");
    if (film.wall_ghost && !scene.drive.present)
        fail(scene, "film.wall_ghost",
             "shows where the walls rest, but nothing moves; add [drive] or take it out");
    if (film.exaggerate == 1) return;
    if (!scene.drive.present)
        fail(scene, "film.exaggerate",
             "enlarges the container's motion, but nothing moves; add [drive] or take it out");
    const bool floor_only = scene.drive.moves == Drive::Moves::floor;
    const bool wall_apart = std::any_of(scene.walls.begin(), scene.walls.end(), [](const ScenePlane& wall) {
        return !wall.moves || wall.velocity != Vec3(0, 0, 0);
    });
    const bool mesh_apart = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                        [](const SceneMesh& mesh) { return !mesh.driven; });
    if (floor_only || wall_apart || mesh_apart || scene.container.turn)
        fail(scene, "film.exaggerate",
             "needs walls that all move together, or grains would be drawn inside those that do not; take it "
             "out");
}

// Fills the film of the scene, while the engine's reader fills the rest.
class FilmReader final : public TableReader {
  public:
    explicit FilmReader(FilmedScene& scene) : scene_(scene) {}

    const std::vector<Key>& keys() const override { return filmed_scene_keys(); }
    void read_species(Document& document, std::size_t species) override {
        const std::string path = fmt::format("species[{}].colour", species);
        own_.push_back(document.has(path));
        scene_.colours.push_back(own_.back() ? read_colour(document, path, "\"orange\" or \"#e69f00\"")
                                             : Colour());
    }
    void read_tables(Document& document) override {
        choose_colours();
        read_film(document, scene_);
        tell_engine(scene_);
    }
    void check() const override { check_film(scene_); }

  private:
    // Species without a colour of their own get colours that the others leave.
    void choose_colours() {
        std::vector<Colour> taken;
        for (std::size_t i = 0; i < own_.size(); ++i)
            if (own_[i]) taken.push_back(scene_.colours[i]);
        for (std::size_t i = 0; i < own_.size(); ++i) {
            if (own_[i]) continue;
            scene_.colours[i] = default_colour(taken);
            taken.push_back(scene_.colours[i]);
        }
    }

    FilmedScene& scene_;
    std::vector<bool> own_;  // whether the scene says the species' colour
};

FilmedScene read(const NamedText& from, const Assignments& sets, const MeasurableIn& measurable) {
    FilmedScene scene;
    FilmReader film(scene);
    read_scene_into(scene, from, sets, measurable, &film);
    return scene;
}

}  // namespace

const std::vector<Key>& filmed_scene_keys() {
    static const std::vector<Key> keys = [] {
        std::vector<Key> all = scene_keys(), film;
        list_film(film);
        const auto feeds = std::find_if(all.begin(), all.end(),
                                        [](const Key& key) { return key.path.starts_with("feed[]"); });
        all.insert(feeds, film.begin(), film.end());
        return all;
    }();
    return keys;
}

std::string scene_schema() {
    return json_schema(filmed_scene_keys(), "A scene for grainreel");
}

FilmedScene read_filmed_scene(const std::filesystem::path& file, const Assignments& sets,
                              const MeasurableIn& measurable) {
    return read(text_of_scene(file), sets, measurable);
}

FilmedScene read_filmed_scene_text(std::string_view text, const std::filesystem::path& file,
                                   const Assignments& sets, const MeasurableIn& measurable) {
    return read({std::string(text), file}, sets, measurable);
}

}  // namespace grainreel
