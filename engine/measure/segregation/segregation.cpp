#include "engine/measure/segregation/segregation.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/walls/wall_bodies.hpp"

namespace grainreel {

namespace {

using Indices = std::span<std::int32_t>;

// Axis of the longest edge of the box around the grains.
int longest_axis(Indices grains, const std::vector<Vec3>& position) {
    Vec3 low = position[grains[0]], high = low;
    for (const std::int32_t i : grains) {
        low = low.cwiseMin(position[i]);
        high = high.cwiseMax(position[i]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    return axis;
}

// Sum over `samples` samples of (share - p)^2.
double summed_variance(Indices grains, int samples, const std::vector<Vec3>& position,
                       const std::vector<std::uint8_t>& marked, double p) {
    if (samples == 1) {
        double hits = 0;
        for (const std::int32_t i : grains) hits += marked[i];
        const double share = hits / static_cast<double>(grains.size());
        return (share - p) * (share - p);
    }
    const int axis = longest_axis(grains, position);
    const int left = samples / 2;
    const auto middle = grains.size() * left / samples;
    // The index decides between equal places, so that the cut does not depend on the order of the grains.
    std::nth_element(grains.begin(), grains.begin() + static_cast<std::ptrdiff_t>(middle), grains.end(),
                     [&](std::int32_t a, std::int32_t b) {
                         return std::pair(position[a][axis], a) < std::pair(position[b][axis], b);
                     });
    return summed_variance(grains.first(middle), left, position, marked, p) +
           summed_variance(grains.subspan(middle), samples - left, position, marked, p);
}

}  // namespace

namespace {

int samples_of(std::size_t count) {
    return std::max(2, static_cast<int>(count) / kLaceySample);
}

}  // namespace

double grains_per_sample(std::size_t count) {
    return static_cast<double>(count) / samples_of(count);
}

Samples take_samples(const std::vector<Vec3>& position, const std::vector<std::uint8_t>& marked) {
    const double count = static_cast<double>(position.size());
    const int samples = samples_of(position.size());
    Samples taken;
    taken.share = std::accumulate(marked.begin(), marked.end(), 0.0) / count;
    taken.grains = grains_per_sample(position.size());
    if (count < samples) return taken;
    std::vector<std::int32_t> grains(position.size());
    std::iota(grains.begin(), grains.end(), 0);
    taken.variance = summed_variance(grains, samples, position, marked, taken.share) / samples;
    return taken;
}

double lacey_index(const Samples& samples) {
    if (samples.rare_grains() < kLeastOfRareKind) return kUnknown;
    const double segregated = samples.segregated_variance(), random = segregated / samples.grains;
    return (segregated - samples.variance) / (segregated - random);
}

double intensity_of_segregation(const Samples& samples) {
    const double segregated = samples.segregated_variance();
    return segregated > 0 ? samples.variance / segregated : kUnknown;
}

double share_above(std::vector<double>& these, std::vector<double>& those) {
    if (these.empty() || those.empty()) return kUnknown;
    std::sort(these.begin(), these.end());
    std::sort(those.begin(), those.end());
    std::size_t lower = 0,
                not_higher = 0;  // numbers of `those` that are lower, or not higher, than the present height
    double above = 0;
    for (const double height : these) {
        while (lower < those.size() && those[lower] < height) ++lower;
        while (not_higher < those.size() && those[not_higher] <= height) ++not_higher;
        above += 0.5 * static_cast<double>(lower + not_higher);
    }
    return above / (static_cast<double>(these.size()) * static_cast<double>(those.size()));
}

double bed_height(std::vector<double>& heights) {
    if (heights.empty()) return 0;
    const auto at =
        heights.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), at, heights.end());
    return *at;
}

BigAndSmall big_and_small(const std::vector<Species>& species) {
    GRAINREEL_CHECK(species.size() > 1);
    BigAndSmall kinds;
    for (std::size_t s = 1; s < species.size(); ++s) {
        if (species[s].diameter.mean > species[kinds.big].diameter.mean) kinds.big = s;
        if (species[s].diameter.mean < species[kinds.small].diameter.mean) kinds.small = s;
    }
    if (kinds.big == kinds.small) kinds.small = 1;
    return kinds;
}

SideWalls::SideWalls(const Scene& scene) {
    const bool stands = !turns_over(scene);  // in a container that turns over, left and right mean nothing
    for (const Face& face : container_faces(scene.container, scene.drive))
        if (stands && (face.kind == Face::Kind::cylinder || face.normal.y() != 0)) faces_.push_back(face);
    if (scene.species.empty()) return;
    gap_ =
        std::min_element(scene.species.begin(), scene.species.end(), [](const Species& a, const Species& b) {
            return a.diameter.mean < b.diameter.mean;
        })->diameter.mean;
}

Side SideWalls::side_of(const Place& grain, const DrivePose& pose) const {
    const bool beside = std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
        return distance_to(face, face.displacement(pose), grain.position).distance < grain.radius + gap_;
    });
    if (!beside) return Side::none;
    return grain.position.y() < pose.offset.y() ? Side::left : Side::right;
}

std::vector<double> heights_above(const Grains& grains, double floor, std::optional<std::size_t> species) {
    std::vector<double> heights;
    for (std::size_t i = 0; i < grains.size(); ++i)
        if (!species || static_cast<std::size_t>(grains.species[i]) == *species)
            heights.push_back(grains.place[i].position.z() - floor);
    return heights;
}

std::vector<double> mean_heights(const Grains& grains, std::size_t species, double floor) {
    std::vector<double> mean(species, 0), count(species, 0);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const auto s = static_cast<std::size_t>(grains.species[i]);
        mean[s] += grains.place[i].position.z() - floor;
        count[s] += 1;
    }
    for (std::size_t s = 0; s < species; ++s) mean[s] /= count[s];
    return mean;
}

}  // namespace grainreel
