#include "engine/measure/fields/profile.hpp"

#include <cmath>
#include <limits>

#include "engine/base/error.hpp"

namespace grainreel {

std::vector<double> profile_of(const CellValues& values, const CellValues& weights, const FieldGrid& grid,
                               ProfileAxis axis) {
    GRAINREEL_CHECK(grid.axes[0].count == 1 && values.size() == weights.size());
    const bool across = axis == ProfileAxis::across;
    const std::int64_t places = grid.axes[across ? 1 : 2].count, others = grid.axes[across ? 2 : 1].count;
    std::vector<double> profile;
    for (std::int64_t place = 0; place < places; ++place) {
        double sum = 0, weight = 0;
        for (std::int64_t other = 0; other < others; ++other) {
            const auto cell =
                static_cast<std::size_t>(across ? grid.index(0, place, other) : grid.index(0, other, place));
            if (std::isnan(values[cell]) || !(weights[cell] > 0)) continue;
            sum += weights[cell] * values[cell];
            weight += weights[cell];
        }
        profile.push_back(weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN());
    }
    return profile;
}

std::vector<std::vector<double>> solid_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis) {
    std::vector<std::vector<double>> profiles;
    for (const CellValues& solid : fields.solid_fraction)
        profiles.push_back(profile_of(solid, by.shares(), by.grid(), axis));
    return profiles;
}

std::vector<std::vector<double>> share_profiles(const CoarseFields& fields, const CoarseGraining& by,
                                                ProfileAxis axis) {
    std::vector<std::vector<double>> profiles = solid_profiles(fields, by, axis);
    for (std::size_t place = 0; !profiles.empty() && place < profiles.front().size(); ++place) {
        double all = 0;
        for (const std::vector<double>& one : profiles) all += one[place];
        for (std::vector<double>& one : profiles)
            one[place] = all > 0 ? one[place] / all : std::numeric_limits<double>::quiet_NaN();
    }
    return profiles;
}

std::vector<double> velocity_profile(const CoarseFields& fields, const CoarseGraining& by, ProfileAxis axis,
                                     std::size_t component) {
    CellValues mass = fields.density;
    for (std::size_t cell = 0; cell < mass.size(); ++cell) mass[cell] *= by.shares()[cell];
    return profile_of(fields.velocity.at(component), mass, by.grid(), axis);
}

}  // namespace grainreel
