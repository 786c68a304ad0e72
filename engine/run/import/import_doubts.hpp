// What an import doubts: sizes of grains and walls that speak for another unit of length than the one that
// was taken.
#pragma once

#include <string>
#include <vector>

#include "engine/run/import/import_run.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// A line for each doubt, with the option that settles it. scene: that of the import, whose last meshes are
// the archive's walls.
std::vector<std::string> doubts_about_sizes(const Scene& scene, const ImportRequest& request,
                                            const ForeignArchive& archive);

}  // namespace grainreel
