#include "engine/scene/film/grain_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

// Solid fraction of a bed between walls that are not far apart, corners and a rough surface counted in.
constexpr double packing = 0.5;

std::vector<std::string> usual_units(Dimension dimension) {
    switch (dimension) {
        case Dimension::length:
            return {"m", "mm", "µm"};
        case Dimension::speed:
            return {"m/s", "mm/s", "µm/s"};
        case Dimension::energy:
            return {"J", "mJ", "µJ", "nJ"};
        case Dimension::force:
            return {"kN", "N", "mN", "µN"};
        case Dimension::mass:
            return {"kg", "g", "mg", "µg"};
        case Dimension::moment:
            return {"N.m", "mN.m", "µN.m", "nN.m"};
        case Dimension::pressure:
            return {"MPa", "kPa", "Pa"};
        case Dimension::number:
            return {""};
        default:
            return {text_of(dimension).unit};
    }
}

// m/s: the drive's; without one that of the fastest listed grain, or that of a fall through the container.
double speed_scale(const Scene& scene) {
    if (scene.drive.present) return scene.drive.top_speed();
    double fastest = std::sqrt(2 * scene.gravity.norm() * scene.container.height);
    for (const ListedGrain& grain : scene.start.grains) fastest = std::max(fastest, grain.velocity.norm());
    return fastest;
}

double smallest_diameter(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Species& species : scene.species) smallest = std::min(smallest, species.diameter.smallest);
    return smallest;
}

// N: what the bed's weight under the drive's peak acceleration presses on a grain of mean volume with.
double force_scale(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    const double peak =
        scene.drive.present ? gravity * (1 + scene.drive.strongest_g_level(gravity)) : gravity;
    const double grains = std::max(1.0, static_cast<double>(scene.grains()));
    const double volume = solid_volume(scene), area = std::pow(volume / grains, 2.0 / 3.0);
    const double pressure = total_mass(scene) / volume * packing * peak * fill_height(scene, packing);
    return pressure * area;
}

}  // namespace

double unit_size(const std::string& unit, Dimension dimension) {
    return unit.empty() ? 1.0 : parse_quantity("1 " + unit, dimension);
}

std::string fitting_unit(double value, Dimension dimension) {
    const std::vector<std::string> units = usual_units(dimension);
    for (const std::string& unit : units)
        if (std::abs(value) >= 0.5 * unit_size(unit, dimension)) return unit;
    return units.back();
}

std::array<double, 2> usual_range(GrainValue value, const Scene& scene) {
    const double speed = speed_scale(scene);
    const double mean_mass = total_mass(scene) / std::max(1.0, static_cast<double>(scene.grains()));
    switch (value) {
        case GrainValue::speed:
            return {0, speed};
        case GrainValue::vertical_velocity:
            return {-speed, speed};
        case GrainValue::start_height:
            return {0, fill_height(scene, packing)};
        case GrainValue::displacement:
            return {0, smallest_diameter(scene)};
        case GrainValue::rise:
            return {-smallest_diameter(scene), smallest_diameter(scene)};
        case GrainValue::spin:
            return {0, 2 * speed / smallest_diameter(scene)};
        case GrainValue::kinetic_energy:
            return {0, 0.5 * mean_mass * speed * speed};
        case GrainValue::coordination:
            return {0, 8};
        case GrainValue::contact_force:
            return {0, 4 * force_scale(scene)};  // the bed comes down hard
        case GrainValue::species:
            break;
    }
    return {0, 0};
}

double usual_flow_speed(const Scene& scene, bool period) {
    if (period) return 0.2 * smallest_diameter(scene) * scene.drive.highest_frequency();
    const auto& outlet = scene.container.outlet;
    const double fall = outlet ? std::sqrt(2 * outlet->half_width * scene.gravity.norm()) : 0;
    return std::max(fall, usual_range(GrainValue::speed, scene)[1]);
}

std::array<double, 2> usual_profile_range(const Scene& scene, const FilmPlot& plot) {
    const double speed = usual_flow_speed(scene, plot.period);
    switch (plot.profile) {
        case ProfileOf::solid_fraction:
            return {0, 0.8};
        case ProfileOf::share:
            return {0, 1};
        case ProfileOf::horizontal_velocity:
        case ProfileOf::vertical_velocity:
            return {-speed, speed};
        case ProfileOf::nothing:
            break;
    }
    return {0, 0};
}

}  // namespace grainreel
