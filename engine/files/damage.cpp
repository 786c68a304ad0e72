#include "engine/files/damage.hpp"

#include <fmt/format.h>
#include <xxhash.h>
#include <cmath>

namespace grainreel {

void Checksum::add_bytes(const void* bytes, std::size_t count) {
    sum_ = XXH64(bytes, count, sum_);
}

namespace {

// The largest numbers that a frame may have beside those of the header.
constexpr double most_cycles = 1e15;  // periods of the drive
constexpr double float_room = 1e-4;   // error in the length of a unit quaternion stored as floats
constexpr double double_room = 1e-9;  // the same stored as doubles

bool within(double value, double limit) {
    return std::abs(value) <= limit;  // false for NaN
}

bool within(const Vec3& v, double limit) {
    return within(v.x(), limit) && within(v.y(), limit) && within(v.z(), limit);
}

// unknown: whether a number that is NaN counts as within.
bool moves_within(const Vec3& v, double limit, bool unknown) {
    return unknown ? !(v.array().abs() > limit).any() : within(v, limit);
}

std::string vector_text(const Vec3& v) {
    return fmt::format("({:.3g}, {:.3g}, {:.3g})", v.x(), v.y(), v.z());
}

std::optional<std::string> grain_fault(const State& f, std::size_t i, std::size_t species, bool unknown) {
    if (f.id[i] < 0 || (i > 0 && f.id[i] <= f.id[i - 1]))
        return fmt::format("the id {} stands where ids should rise", f.id[i]);
    const auto says = [&](const std::string& what) { return fmt::format("grain {} has {}", f.id[i], what); };
    if (f.species[i] < 0 || static_cast<std::size_t>(f.species[i]) >= species)
        return says(fmt::format("the type {} of {}", static_cast<std::int64_t>(f.species[i]) + 1, species));
    if (!(f.radius[i] > 0 && f.radius[i] <= kLargestRadius))
        return says(fmt::format("a radius of {:.3g} m", f.radius[i]));
    if (!within(f.position[i], kFarthestPlace))
        return says(fmt::format("the position {} m", vector_text(f.position[i])));
    if (!moves_within(f.velocity[i], kFastest, unknown))
        return says(fmt::format("the velocity {} m/s", vector_text(f.velocity[i])));
    if (!moves_within(f.spin[i], kFastestSpin, unknown))
        return says(fmt::format("the spin {} rad/s", vector_text(f.spin[i])));
    if (!f.orientation.empty() && !within(f.orientation[i].norm() - 1, float_room))
        return says("an orientation that is no unit quaternion");
    if (!f.shape.empty() && !is_possible(f.shape[i])) return says("a shape that no grain has");
    if (!f.mass.empty() && !(f.mass[i] > 0 && std::isfinite(f.mass[i])))
        return says(fmt::format("a mass of {:.3g} kg", f.mass[i]));
    if (!f.contact_number.empty() && f.contact_number[i] < 0)
        return says(fmt::format("{} contacts", f.contact_number[i]));
    return std::nullopt;
}

}  // namespace

std::optional<std::string> moment_fault(const State& f) {
    if (!within(f.time, kLongestTime)) return fmt::format("its time is {:.3g} s", f.time);
    if (!within(f.cycles, most_cycles)) return fmt::format("it is {} periods after the start", f.cycles);
    if (!(f.phase >= 0 && f.phase <= 1)) return fmt::format("its phase is {:.3g} turns", f.phase);
    for (const BodyPose& body : f.bodies) {
        if (!within(body.place, kFarthestPlace))
            return fmt::format("a wall is {} m off", vector_text(body.place));
        if (!within(body.velocity, kFastest))
            return fmt::format("a wall has the velocity {} m/s", vector_text(body.velocity));
        if (!within(body.spin, kFastestSpin))
            return fmt::format("a wall has the spin {} rad/s", vector_text(body.spin));
        if (!within(body.rotation.norm() - 1, double_room))
            return "a wall has a rotation that is no unit quaternion";
    }
    return std::nullopt;
}

std::optional<std::string> grains_fault(const State& frame, std::size_t species, bool unknown) {
    for (std::size_t i = 0; i < frame.size(); ++i)
        if (auto fault = grain_fault(frame, i, species, unknown)) return fault;
    return std::nullopt;
}

}  // namespace grainreel
