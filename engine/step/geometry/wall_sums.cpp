#include "engine/step/geometry/wall_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainreel {

namespace {

// The bound: 2^52 for each contact (WallTally::count()), times 2^24 contacts, times 2^44 steps.
bool is_count(WideInt count) {
    constexpr WideInt kMost = static_cast<WideInt>(1) << 120;
    return count >= -kMost && count <= kMost;
}

}  // namespace

bool are_sound(const std::vector<WideInt>& slices) {
    return std::all_of(slices.begin(), slices.end(), is_count);
}

bool are_sound(const std::vector<FaceSums>& faces) {
    const auto all = [](const std::array<WideInt, 3>& counts) {
        return std::all_of(counts.begin(), counts.end(), is_count);
    };
    const auto fit = [](const std::array<WideInt, 3>& counts) {
        return std::all_of(counts.begin(), counts.end(), [](WideInt count) {
            return count >= std::numeric_limits<std::int64_t>::min() / 2 &&
                   count <= std::numeric_limits<std::int64_t>::max() / 2;
        });
    };
    return std::all_of(faces.begin(), faces.end(), [&](const FaceSums& face) {
        return all(face.force) && all(face.moment) && fit(face.last_force) && fit(face.last_moment);
    });
}

bool is_sound(const WallSums& sums, std::size_t faces, const WallScale& scale) {
    const auto is_unit = [](double unit) { return std::isfinite(unit) && unit > 0; };
    return is_unit(scale.force) && is_unit(scale.length) && sums.faces.size() == faces &&
           sums.slices.size() == faces * static_cast<std::size_t>(scale.slices) && are_sound(sums.faces) &&
           are_sound(sums.slices);
}

void WallTally::add_to(WallSums& all) const {
    all.faces.resize(sums_.size());
    all.slices.resize(slices_.size());
    for (std::size_t f = 0; f < sums_.size(); ++f)
        for (int a = 0; a < 3; ++a) {
            all.faces[f].force[a] += sums_[f].force[a];
            all.faces[f].moment[a] += sums_[f].moment[a];
            all.faces[f].last_force[a] += now_[f].force[a];
            all.faces[f].last_moment[a] += now_[f].moment[a];
        }
    for (std::size_t s = 0; s < slices_.size(); ++s) all.slices[s] += slices_[s];
}

void WallTally::take(const WallSums& before) {
    sums_ = before.faces;
    slices_ = before.slices;
    for (std::size_t f = 0; f < sums_.size(); ++f)
        for (int a = 0; a < 3; ++a) {
            now_[f].force[a] = static_cast<std::int64_t>(sums_[f].last_force[a]);
            now_[f].moment[a] = static_cast<std::int64_t>(sums_[f].last_moment[a]);
        }
}

}  // namespace grainreel
