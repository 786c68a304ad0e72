#include "engine/measure/fields/coarse_graining.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"

namespace grainreel {
namespace {

// Pairs of axes of a symmetric tensor, in the order of its components.
constexpr std::array<std::array<int, 2>, 6> upper{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
constexpr std::size_t motion_width = 1 + 3 + upper.size();
constexpr std::size_t contact_width = 9;

// Mass, momentum and the products m v v of one grain.
std::array<double, motion_width> motion_of(const FieldGrain& grain) {
    std::array<double, motion_width> all{grain.mass};
    for (int a = 0; a < 3; ++a) all[1 + a] = grain.mass * grain.velocity[a];
    for (std::size_t c = 0; c < upper.size(); ++c)
        all[4 + c] = grain.mass * grain.velocity[upper[c][0]] * grain.velocity[upper[c][1]];
    return all;
}

// Force times branch, row by row.
std::array<double, contact_width> product_of(const Vec3& force, const Vec3& branch) {
    std::array<double, contact_width> all{};
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) all[3 * a + b] = force[a] * branch[b];
    return all;
}

// Adds numbers to a cell. GCC makes vector instructions of it only with the copy: the cell might be one of
// the numbers.
template <std::size_t Width>
void add_to(double* cell, const std::array<double, Width>& numbers, double weight) {
    std::array<double, Width> sum;
    for (std::size_t k = 0; k < Width; ++k) sum[k] = cell[k] + weight * numbers[k];
    std::copy(sum.begin(), sum.end(), cell);
}

}  // namespace

CoarseGraining::CoarseGraining(const Scene& scene, const FieldOutput& fields, int phases)
    : grid_(make_field_grid(scene, fields)),
      shares_(inside_shares(grid_, scene)),
      footprint_(grid_, FieldKernel(fields.kernel, fields.width, grid_.dimensions())),
      species_(scene.species.size()) {
    const auto cells = static_cast<std::size_t>(grid_.cells());
    motion_.assign(static_cast<std::size_t>(phases), CellValues(cells * motion_width));
    solid_.resize(cells * (1 + species_));
    contact_.resize(cells * contact_width);
}

void CoarseGraining::clear() {
    for (CellValues& phase : motion_) std::fill(phase.begin(), phase.end(), 0.0);
    std::fill(solid_.begin(), solid_.end(), 0.0);
    std::fill(contact_.begin(), contact_.end(), 0.0);
    moments_ = 0;
}

// Whether the cell of a place belongs to the grid and is partly inside the container.
bool CoarseGraining::is_inside(const Vec3& place) const {
    std::array<std::int64_t, 3> at{};
    for (int k = 0; k < 3; ++k) {
        const GridAxis& axis = grid_.axes[k];
        if (!axis.resolved || axis.periodic) continue;
        const double cell = std::floor((place[k] - axis.low) / axis.cell);
        if (!(cell >= 0 && cell < static_cast<double>(axis.count))) return false;
        at[k] = static_cast<std::int64_t>(cell);
    }
    return shares_[grid_.index(at[0], at[1], at[2])] > 0;
}

void CoarseGraining::add_grain(const FieldGrain& grain, double* motion) {
    const std::span<const CellWeight> cells = footprint_.of_point(grain.position, grain.radius);
    const std::array<double, motion_width> numbers = motion_of(grain);
    double inside = 0;
    for (const CellWeight& cell : cells) {
        add_to(motion + static_cast<std::size_t>(cell.cell) * motion_width, numbers, cell.weight);
        inside += cell.weight * shares_[cell.cell];
    }
    if (!is_inside(grain.position)) return;
    const double scale = 1 / (inside * grid_.cell_volume());
    for (const CellWeight& cell : cells) {
        if (shares_[cell.cell] <= 0) continue;
        double* const solid = solid_.data() + static_cast<std::size_t>(cell.cell) * (1 + species_);
        solid[0] += scale * cell.weight * grain.mass;
        solid[1 + static_cast<std::size_t>(grain.species)] += scale * cell.weight * grain.volume;
    }
}

void CoarseGraining::add(const FieldState& state, int phase) {
    double* const motion = motion_.at(phase).data();
    for (const FieldGrain& grain : state.grains) add_grain(grain, motion);
    for (const FieldBranch& contact : state.contacts) add_contact(contact);
    ++moments_;
}

void CoarseGraining::add_contact(const FieldBranch& contact) {
    const auto at = [&](std::int64_t cell) {
        return contact_.data() + static_cast<std::size_t>(cell) * contact_width;
    };
    if (footprint_.differ(contact.radius, contact.other_radius)) {
        for (const CellWay& cell :
             footprint_.of_changing_line(contact.begin, contact.branch, contact.radius, contact.other_radius))
            add_to(at(cell.cell), product_of(contact.force, cell.way), 1);
        return;
    }
    const std::array<double, contact_width> product = product_of(contact.force, contact.branch);
    for (const CellWeight& cell : footprint_.of_line(contact.begin, contact.branch, contact.radius))
        add_to(at(cell.cell), product, cell.weight);
}

void CoarseGraining::save(std::ostream& out) const {
    write_value(out, moments_);
    for (const CellValues& phase : motion_) write_vector(out, phase);
    write_vector(out, solid_);
    write_vector(out, contact_);
}

void CoarseGraining::load(Bytes& in) {
    const auto read = [&](CellValues& sums) {
        CellValues found;
        read_vector(in, found);
        const auto finite = [](double value) { return std::isfinite(value); };
        if (in.failed() || found.size() != sums.size() || !std::all_of(found.begin(), found.end(), finite))
            return in.fail();
        sums = std::move(found);
    };
    read_value(in, moments_);
    if (moments_ < 0) in.fail();
    for (CellValues& phase : motion_) read(phase);
    read(solid_);
    read(contact_);
}

CoarseFields CoarseGraining::mean() const {
    GRAINREEL_CHECK(moments_ > 0);
    const double share = 1 / static_cast<double>(moments_);
    const auto cells = static_cast<std::size_t>(grid_.cells());
    CoarseFields fields;
    fields.density.assign(cells, 0);
    fields.solid_fraction.assign(species_, CellValues(cells));
    fields.velocity.assign(3, CellValues(cells, kUnknown));
    fields.temperature.assign(cells, kUnknown);
    fields.kinetic_stress.assign(upper.size(), CellValues(cells));
    fields.contact_stress.assign(contact_width, CellValues(cells));
    for (std::size_t cell = 0; cell < cells; ++cell) {
        fields.density[cell] = share * solid_[cell * (1 + species_)];
        for (std::size_t s = 0; s < species_; ++s)
            fields.solid_fraction[s][cell] = share * solid_[cell * (1 + species_) + 1 + s];
        for (std::size_t c = 0; c < contact_width; ++c)
            fields.contact_stress[c][cell] = share * contact_[cell * contact_width + c];
        double mass = 0, heat = 0;
        std::array<double, 3> momentum{};
        for (const CellValues& phase : motion_) {
            const double* const sums = phase.data() + cell * motion_width;
            if (sums[0] <= 0) continue;
            mass += sums[0];
            for (std::size_t a = 0; a < 3; ++a) momentum[a] += sums[1 + a];
            for (std::size_t c = 0; c < upper.size(); ++c) {
                const auto a = static_cast<std::size_t>(upper[c][0]),
                           b = static_cast<std::size_t>(upper[c][1]);
                double moved = sums[4 + c] - sums[1 + a] * sums[1 + b] / sums[0];
                if (a == b) moved = std::max(0.0, moved), heat += moved;
                fields.kinetic_stress[c][cell] += share * moved;
            }
        }
        if (mass <= 0 || shares_[cell] <= 0) continue;
        for (std::size_t a = 0; a < 3; ++a) fields.velocity[a][cell] = momentum[a] / mass;
        fields.temperature[cell] = heat / (3 * mass);
    }
    return fields;
}

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
        profile.push_back(weight > 0 ? sum / weight : kUnknown);
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
        for (std::vector<double>& one : profiles) one[place] = all > 0 ? one[place] / all : kUnknown;
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
