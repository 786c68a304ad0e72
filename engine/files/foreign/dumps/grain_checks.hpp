// What text and binary dumps hold their grains to.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

// Whether a grain cannot be without a finite number there: ids, places, radii. Computes and fixes may be nan.
bool must_be_finite(const std::string& column);

// A row whose id is no whole number, or one that a row before it has. `id` of a table of grains; none where
// it has no ids, or where all are good.
struct BadId {
    std::size_t row = 0;
    double id = 0;
    std::string words() const;
};
std::optional<BadId> bad_id(const RawTable& grains);

}  // namespace grainreel
