#include "render/picture/grains/shown_grains.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

template <class T>
void keep(std::vector<T>& values, const std::vector<std::size_t>& kept) {
    if (values.empty()) return;
    for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];  // kept[k] >= k
    values.resize(kept.size());
}

}  // namespace

std::vector<HalfSpace> kept_by_cut(const FilmCut& cut, const State& frame) {
    if (!cut.present) return {};
    const Vec3& normal = cut.normal;
    // The cut goes with a floor that shakes, not with one that turns.
    const bool turns = !frame.floor().rotation.isApprox(Quaternion::Identity());
    const double offset = cut.at + (turns ? 0 : normal.dot(frame.floor().place));
    std::vector<HalfSpace> kept{{-normal, -offset}};
    if (cut.thickness > 0) kept.push_back({normal, offset - cut.thickness});
    return kept;
}

ShownGrains::ShownGrains(const FilmedScene& scene, const std::vector<std::size_t>& left_out) {
    if (left_out.empty()) return;
    left_out_.resize(scene.species.size(), false);
    for (const std::size_t species : left_out) left_out_[species] = true;
}

ShownGrains ShownGrains::only(const FilmedScene& scene, std::vector<std::int32_t> ids) {
    ShownGrains shown(scene, {});
    shown.only_ = std::move(ids);
    return shown;
}

ShownGrains ShownGrains::beside_cut(const FilmedScene& scene) {
    ShownGrains shown(scene, {});
    shown.cut_ = scene.film.look.cut;
    return shown;
}

const Shot& ShownGrains::of(const Shot& frame) {
    if (!any()) return frame;
    const std::vector<HalfSpace> halves = kept_by_cut(cut_, frame);
    const auto is_kept = [&](std::size_t i) {
        if (!left_out_.empty() && left_out_[frame.species[i]]) return false;
        if (!only_.empty() && !std::binary_search(only_.begin(), only_.end(), frame.id[i])) return false;
        return std::all_of(halves.begin(), halves.end(), [&](const HalfSpace& half) {
            return half.normal.dot(frame.position[i]) - half.distance > -frame.radius[i];
        });
    };
    kept_.clear();
    for (std::size_t i = 0; i < frame.size(); ++i)
        if (is_kept(i)) kept_.push_back(i);
    shown_ = frame;
    keep(shown_.id, kept_);
    keep(shown_.species, kept_);
    keep(shown_.radius, kept_);
    keep(shown_.mass, kept_);
    keep(shown_.position, kept_);
    keep(shown_.velocity, kept_);
    keep(shown_.spin, kept_);
    keep(shown_.orientation, kept_);
    keep(shown_.shape, kept_);
    keep(shown_.displacement, kept_);
    keep(shown_.own, kept_);
    return shown_;
}

// The rest of the file computes the quantity of each grain, and from it the grain's albedo.

namespace {

// J: the energy of translation and of rotation, with the moment of inertia 2/5 m r2 of a solid sphere.
double kinetic_energy(const State& frame, std::size_t i, double density) {
    const double r = frame.radius[i];
    return 0.5 * mass_of(frame, i, density) *
           (frame.velocity[i].squaredNorm() + 0.4 * r * r * frame.spin[i].squaredNorm());
}

}  // namespace

Quantities::Quantities(const FilmedScene& scene, GrainValue by) : by_(by) {
    for (const Species& species : scene.species) density_.push_back(species.density);
}

void Quantities::start_from(const State& frame) {
    if (by_ != GrainValue::start_height) return;
    start_id_ = frame.id;
    start_height_.clear();
    for (const Vec3& position : frame.position) start_height_.push_back((position - frame.floor().place).z());
}

double Quantities::start_height_of(std::int32_t id) const {
    const auto row = row_of_id(start_id_, id);
    return row ? start_height_[*row] : kUnknown;
}

// Contacts may name grains that the frame lacks.
void Quantities::count_touches(const Shot& frame, bool forces) {
    values_.assign(frame.size(), 0);
    const auto add = [&](std::int32_t id, double force) {
        if (id < 0) return;  // a wall
        if (const auto grain = frame.row_of(id)) values_[*grain] += forces ? force : 1;
    };
    for (const Link& touch : frame.touches) {
        add(touch.first, touch.force);
        add(touch.second, touch.force);
    }
}

const std::vector<double>& Quantities::of(const Shot& frame) {
    if (start_height_.empty()) start_from(frame);
    if (by_ == GrainValue::coordination || by_ == GrainValue::contact_force) {
        count_touches(frame, by_ == GrainValue::contact_force);
        return values_;
    }
    values_.assign(frame.size(), kUnknown);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        switch (by_) {
            case GrainValue::speed:
                values_[i] = frame.velocity[i].norm();
                break;
            case GrainValue::vertical_velocity:
                values_[i] = frame.velocity[i].z();
                break;
            case GrainValue::start_height:
                values_[i] = start_height_of(frame.id[i]);
                break;
            case GrainValue::displacement:
                if (!frame.displacement.empty()) values_[i] = frame.displacement[i].norm();
                break;
            case GrainValue::rise:
                if (!frame.displacement.empty()) values_[i] = frame.displacement[i].z();
                break;
            case GrainValue::spin:
                values_[i] = frame.spin[i].norm();
                break;
            case GrainValue::kinetic_energy:
                values_[i] = kinetic_energy(frame, i, density_[frame.species[i]]);
                break;
            case GrainValue::own:
                if (!frame.own.empty()) values_[i] = frame.own[i];
                break;
            default:
                break;
        }
    }
    return values_;
}

namespace {

constexpr Colour pale_grain{0.93, 0.93, 0.93};  // sRGB
constexpr int smooth_steps = 1024;              // steps of a colour map: finer than 8 bits

}  // namespace

Albedo to_albedo(const Colour& colour) {
    return {static_cast<float>(to_linear(colour.red)), static_cast<float>(to_linear(colour.green)),
            static_cast<float>(to_linear(colour.blue))};
}

GrainColours::GrainColours(const FilmedScene& scene)
    : quantities_(scene, scene.film.shows.colour.by), by_species_(!scene.film.shows.colour.of_grains()) {
    if (by_species_) {
        const bool pale = scene.film.shows.colour.of_field();
        for (const Colour& colour : scene.colours)
            steps_.push_back(to_albedo(pale ? mix(colour, pale_grain, 0.8) : colour));
        return;
    }
    for (std::size_t i = 0; i < scene.species.size(); ++i)
        own_.push_back(scene.film.shows.colour.colours(i) ? std::nullopt
                                                          : std::optional(to_albedo(scene.colours.at(i))));
    const ColourScale scale(scene.film.shows.colour);
    low_ = scale.low();
    high_ = scale.high();
    banded_ = scale.bands() > 0;
    logarithmic_ = scale.logarithmic();
    const int count = banded_ ? scale.bands() : smooth_steps;
    for (int i = 0; i < count; ++i) steps_.push_back(to_albedo(scale.at_share(i / (count - 1.0))));
}

// Where a value lies in the range: the same share as on the colour bar.
double GrainColours::share_of(double value) const {
    if (!logarithmic_) return (value - low_) / (high_ - low_);
    return value <= low_ ? 0 : std::log(value / low_) / std::log(high_ / low_);
}

Albedo GrainColours::of_value(double value) const {
    if (std::isnan(value)) return to_albedo(neutral_grain);
    const auto count = static_cast<double>(steps_.size());
    const double share = share_of(value);
    const double step = banded_ ? std::floor(share * count) : std::round(share * (count - 1));
    return steps_[static_cast<std::size_t>(std::clamp(step, 0.0, count - 1))];
}

const std::vector<Albedo>& GrainColours::of(const Shot& frame) {
    colours_.resize(frame.size());
    if (by_species_) {
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const auto species = static_cast<std::size_t>(frame.species[i]);
            GRAINREEL_CHECK(species < steps_.size());
            colours_[i] = steps_[species];
        }
        return colours_;
    }
    const std::vector<double>& values = quantities_.of(frame);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const std::optional<Albedo>& own = own_.at(static_cast<std::size_t>(frame.species[i]));
        colours_[i] = own ? *own : of_value(values[i]);
        if (own) continue;
        clipped_.take(values[i], {low_, high_});
    }
    return colours_;
}

}  // namespace grainreel
