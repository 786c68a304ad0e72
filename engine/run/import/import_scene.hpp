// The scene.toml of an imported run: its species and walls, no contacts and no motion but that of the walls.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/files/foreign/foreign_archive.hpp"

namespace grainreel {

// What all frames together say.
struct ImportSurvey {
    Vec3 low{0, 0, 0}, high{0, 0, 0};       // m, of all grains with their radii
    std::vector<double> smallest, largest;  // m, diameters by species; 0 where there are none
    std::vector<std::int64_t> most;         // grains of a species in one frame
    std::int64_t ids = 0;                   // different ids
};

// Writes scene.toml into the folder, and meshes and paths of walls beside it. Throws RunError where that
// cannot be written. news: what was taken for granted.
void write_import_scene(const std::filesystem::path& folder, const ForeignArchive& archive,
                        const ImportSurvey& survey, const ReadingOptions& options,
                        std::vector<std::string>& news);

}  // namespace grainreel
