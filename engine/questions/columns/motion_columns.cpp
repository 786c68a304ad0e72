// Where a grain is, how it moves, what it is, and its way.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/numbers.hpp"
#include "engine/questions/columns/grain_columns.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double id(const Snapshot& s, std::size_t i) {
    return static_cast<double>(s.frame.id[i]);
}

double species(const Snapshot& s, std::size_t i) {
    return static_cast<double>(s.frame.species[i]);
}

template <int axis>
double place(const Snapshot& s, std::size_t i) {
    return s.frame.position[i][axis];
}

double height(const Snapshot& s, std::size_t i) {
    return s.height(i);
}

double from_axis(const Snapshot& s, std::size_t i) {
    const Vec3 from = s.frame.position[i] - container_offset(s.scene, s.frame);
    return std::hypot(from.x(), from.y());
}

template <int axis>
double velocity(const Snapshot& s, std::size_t i) {
    return s.frame.velocity[i][axis];
}

double speed(const Snapshot& s, std::size_t i) {
    return s.frame.velocity[i].norm();
}

template <int axis>
double spin_about(const Snapshot& s, std::size_t i) {
    return s.frame.spin[i][axis];
}

double spin(const Snapshot& s, std::size_t i) {
    return s.frame.spin[i].norm();
}

double radius(const Snapshot& s, std::size_t i) {
    return s.frame.radius[i];
}

double diameter(const Snapshot& s, std::size_t i) {
    return 2 * s.frame.radius[i];
}

double mass(const Snapshot& s, std::size_t i) {
    return s.mass(i);
}

// J, of a solid sphere.
double rotational_energy(const Snapshot& s, std::size_t i) {
    const double r = s.frame.radius[i];
    return 0.5 * s.mass(i) * 0.4 * r * r * s.frame.spin[i].squaredNorm();
}

double kinetic_energy(const Snapshot& s, std::size_t i) {
    return 0.5 * s.mass(i) * s.frame.velocity[i].squaredNorm() + rotational_energy(s, i);
}

double potential_energy(const Snapshot& s, std::size_t i) {
    return -s.mass(i) * s.scene.gravity.dot(s.frame.position[i]);
}

std::optional<std::size_t> place_at_start(const Snapshot& s, std::size_t i) {
    const auto& ids = s.start.id;
    const auto at = std::lower_bound(ids.begin(), ids.end(), s.frame.id[i]);
    if (at == ids.end() || *at != s.frame.id[i]) return std::nullopt;
    return static_cast<std::size_t>(at - ids.begin());
}

double start_height(const Snapshot& s, std::size_t i) {
    const auto start = place_at_start(s, i);
    return start ? (s.start.position[*start] - floor_offset(s.scene, s.start)).z() : none;
}

// Against the container, which moves itself.
double rise(const Snapshot& s, std::size_t i) {
    return s.height(i) - start_height(s, i);
}

double moved(const Snapshot& s, std::size_t i) {
    const auto start = place_at_start(s, i);
    if (!start) return none;
    return ((s.frame.position[i] - container_offset(s.scene, s.frame)) -
            (s.start.position[*start] - container_offset(s.scene, s.start)))
        .norm();
}

double period_displacement(const Snapshot& s, std::size_t i) {
    return s.frame.displacement.empty() ? none : s.frame.displacement[i].norm();
}

double period_rise(const Snapshot& s, std::size_t i) {
    return s.frame.displacement.empty() ? none : s.frame.displacement[i].z();
}

}  // namespace

std::vector<GrainColumn> motion_columns() {
    using enum Dimension;
    return {
        {"id", number, "number of the grain", of_each<id>},
        {.name = "species",
         .dimension = number,
         .about = "its species",
         .of = of_each<species>,
         .is_species = true,
         .coloured_as = "species"},
        {"x", length, "along the depth", of_each<place<0>>},
        {"y", length, "across", of_each<place<1>>},
        {"z", length, "upwards, from the floor's place at rest", of_each<place<2>>},
        {"height", length, "of the centre above the floor where that is now", of_each<height>},
        {"r", length, "of the centre from the container's upright axis", of_each<from_axis>},
        {"vx", Dimension::speed, "velocity along the depth", of_each<velocity<0>>, Needs::velocities},
        {"vy", Dimension::speed, "velocity across", of_each<velocity<1>>, Needs::velocities},
        {.name = "vz",
         .dimension = Dimension::speed,
         .about = "velocity upwards",
         .of = of_each<velocity<2>>,
         .needs = Needs::velocities,
         .coloured_as = "vertical-velocity",
         .also = "vertical_velocity"},
        {.name = "speed",
         .dimension = Dimension::speed,
         .about = "magnitude of the velocity",
         .of = of_each<grainreel::speed>,
         .needs = Needs::velocities,
         .coloured_as = "speed"},
        {"wx", Dimension::spin, "spin about x", of_each<spin_about<0>>, Needs::spins},
        {"wy", Dimension::spin, "spin about y", of_each<spin_about<1>>, Needs::spins},
        {"wz", Dimension::spin, "spin about z", of_each<spin_about<2>>, Needs::spins},
        {.name = "spin",
         .dimension = Dimension::spin,
         .about = "magnitude of the spin",
         .of = of_each<grainreel::spin>,
         .needs = Needs::spins,
         .coloured_as = "spin"},
        {"radius", length, "radius", of_each<radius>},
        {"diameter", length, "diameter", of_each<diameter>},
        {"mass", Dimension::mass, "mass", of_each<grainreel::mass>},
        {.name = "kinetic_energy",
         .dimension = energy,
         .about = "of translation and rotation",
         .of = of_each<kinetic_energy>,
         .needs = Needs::velocities,
         .coloured_as = "kinetic-energy"},
        {"rotational_energy", energy, "the part of rotation in it", of_each<rotational_energy>, Needs::spins},
        {"potential_energy", energy, "0 at the floor's place at rest", of_each<potential_energy>},
        {.name = "start_height",
         .dimension = length,
         .about = "height at the run's first moment",
         .of = of_each<start_height>,
         .coloured_as = "start-height"},
        {"rise", length, "height gained since then", of_each<rise>},
        {"moved", length, "distance from its place in the container then", of_each<moved>},
        {.name = "period_displacement",
         .dimension = length,
         .about = "how far it came in the last period of the drive",
         .of = of_each<period_displacement>,
         .needs = Needs::period,
         .coloured_as = "displacement",
         .also = "displacement"},
        {.name = "period_rise",
         .dimension = length,
         .about = "the upward part of that",
         .of = of_each<period_rise>,
         .needs = Needs::period,
         .coloured_as = "rise"},
    };
}

}  // namespace grainreel
