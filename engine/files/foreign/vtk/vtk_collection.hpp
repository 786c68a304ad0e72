// The moments that a collection names: .pvd and .series of ParaView, or the one of a .vtm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/vtk/vtk_parts.hpp"

namespace grainreel {

// The files of one time.
struct CollectionMoment {
    std::optional<std::int64_t> step{};
    std::optional<double> time{};
    std::vector<VtkPartFile> files{};
    bool operator==(const CollectionMoment&) const = default;
};

struct CollectionList {
    std::string format;
    std::string program{};
    std::vector<CollectionMoment> moments{};
    std::int64_t replaced = 0;  // files that were named again for the same time; the later ones count
};

// In the order in which the times first appear. Throws UserError with the line.
CollectionList collection_list(const std::filesystem::path& file);

// Whether a file begins as such a list does.
bool takes_collection(const FileHead& head);

}  // namespace grainreel
