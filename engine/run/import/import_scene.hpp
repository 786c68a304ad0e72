// Writes scene.toml of an imported run: its grains, walls and times, as far as its files say them. It has no
// contact law and no motion except that of walls.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

// What frames together say of the grains.
struct ImportSurvey {
    struct Species {
        std::string type;                  // the word that the files have for it
        double smallest = 0, largest = 0;  // m, diameters, or 0 without grains
        std::int64_t most = 0;             // the most grains in one frame
    };
    std::vector<Species> species = std::vector<Species>(1);
    Vec3 low = Vec3::Constant(1e300),
         high = Vec3::Constant(-1e300);  // m, corners of the box around all grains
    std::vector<std::int32_t> ids{};     // all different ids, rising
    std::size_t places = 0;              // that a file needs for grains: as many as there are ids
    bool masses = false;                 // some grain's mass is not that of its species' density

    // Adds a frame, whose species are those of these types, and of this world.
    void add(const State& frame, const std::vector<std::string>& types, const StoredWorld& world);
    // The corners of the box around all grains; those of a box of 1 m without grains.
    Vec3 lowest() const { return ids.empty() ? Vec3(Vec3::Constant(-0.5)) : low; }
    Vec3 highest() const { return ids.empty() ? Vec3(Vec3::Constant(0.5)) : high; }
    // Whether files that were begun for `all` can hold these grains. box: whether the files depend on the box
    // around the grains.
    bool within(const ImportSurvey& all, bool box) const;
};

// Writes a file of the import. Throws RunError where it cannot be written.
void write_import_text(const std::filesystem::path& file, const std::string& text);

// Tables of scene.toml for walls and their motions, as text.
struct ImportWalls {
    std::string top;     // keys that stand before all tables
    std::string tables;  // [container], [drive], [[mesh]]
};

// Writes files with the shapes and motions of walls into the folder. Throws RunError where one cannot be
// written. news: gets what was assumed.
ImportWalls write_import_walls(const std::filesystem::path& folder, const ForeignArchive& archive,
                               const ReadingOptions& options, std::vector<std::string>& news);

// The text of scene.toml. news: gets what was assumed.
std::string import_scene_text(const ForeignArchive& archive, const ImportSurvey& survey,
                              const ReadingOptions& options, const ImportWalls& walls,
                              std::vector<std::string>& news);

}  // namespace grainreel
