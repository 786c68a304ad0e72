#include "engine/run/import/import_doubts.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <optional>

#include "engine/mesh/surface.hpp"

namespace grainreel {

namespace {

double size_of(const SceneMesh& mesh) {
    const MeshFacts& facts = mesh.surface->facts();
    return (facts.high - facts.low).maxCoeff();
}

// Says that the files may be in mm: their grains are as large as boulders where lengths count as m. Says
// nothing where the user gave the units.
std::optional<std::string> doubt_about_grains(double largest, const ImportRequest& request,
                                              const UnitSystem& units) {
    constexpr double too_large = 0.3;  // m
    const bool in_metres = units.real && units.length == 1;
    if (!in_metres || !request.reading.units.empty() || largest < too_large) return std::nullopt;
    return fmt::format("{}: its grains are up to {:.4g} m large; where it is in mm, g and s, give --units mm",
                       request.from.string(), largest);
}

// Says that the walls may be in another unit than the grains. They are thousands of grains wide, or all of
// them are smaller than a grain.
std::optional<std::string> doubt_about_walls(double largest, const Scene& scene, const ImportRequest& request,
                                             const ForeignArchive& archive) {
    constexpr double too_large = 3000;  // diameters of the largest grain
    const std::vector<MovingWall>& walls = archive.walls();
    const std::size_t first = scene.meshes.size() - walls.size();
    for (std::size_t w = 0; w < walls.size() && !walls[w].is_box; ++w) {
        const double size = size_of(scene.meshes[first + w]);
        if (!(largest > 0) || size <= too_large * largest) continue;
        return fmt::format(  // walls are in one unit, so one is told of
            "{}: the wall \"{}\" is {:.4g} m large, beside grains of {:.4g} m; where its file is in mm, give "
            "--walls-scale {:g}",
            request.from.string(), scene.meshes[first + w].name, size, largest,
            0.001 * request.reading.walls_scale.value_or(archive.units().length));
    }
    double size = 0;
    for (std::size_t w = 0; w < walls.size(); ++w) size = std::max(size, size_of(scene.meshes[first + w]));
    if (walls.empty() || size >= largest) return std::nullopt;
    return fmt::format(
        "{}: its walls are {:.4g} m large, smaller than a grain ({:.4g} m); see --units, which is about "
        "grains and walls, and --walls-scale, which is about walls alone",
        request.from.string(), size, largest);
}

}  // namespace

std::vector<std::string> doubts_about_sizes(const Scene& scene, const ImportRequest& request,
                                            const ForeignArchive& archive) {
    double largest = 0;  // m, diameter of a grain
    for (const Species& one : scene.species) largest = std::max(largest, one.diameter.largest);
    std::vector<std::string> doubts;
    const auto add = [&](std::optional<std::string> doubt) {
        if (doubt) doubts.push_back(std::move(*doubt));
    };
    add(doubt_about_grains(largest, request, archive.units()));
    add(doubt_about_walls(largest, scene, request, archive));
    return doubts;
}

}  // namespace grainreel
