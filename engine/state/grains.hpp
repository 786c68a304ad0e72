// The grains as the step loop holds them: arrays in spatial order, reordered at each rebuild of the
// neighbour list. `id` identifies a grain; its index does not.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/system/processor.hpp"
#include "engine/base/team.hpp"
#include "engine/base/vector.hpp"

namespace grainreel {

// Records have 32 or 64 bytes, so that the contact pass needs one aligned load per grain for each kind of
// record. Motion and load have the same layout, number by number, for the integration. Vector code reads
// records by offset, so their members must keep their order.
struct alignas(32) Place {
    Vec3 position;  // m
    double radius;  // m
};
struct alignas(64) Motion {
    Vec3 velocity;           // m/s
    double inverse_mass;     // 1/kg
    Vec3 spin;               // rad/s; zero and not read in scenes without friction
    double inverse_inertia;  // 1/(kg m2)
};

// The motion of a grain as mixed precision reads it. The step loop keeps it relative to a frame in free
// flight, so that little is lost by rounding.
struct alignas(32) RoundedMotion {
    float velocity[3], inverse_mass;  // m/s, 1/kg
    float spin[3], radius;            // rad/s, m
};

// Force and torque of the last evaluation, without gravity.
struct alignas(64) Load {
    Vec3 force{0, 0, 0};  // N
    double zero = 0;
    Vec3 torque{0, 0, 0};  // N m
    double zero_too = 0;
};

// Higher derivatives that a predictor-corrector carries along.
struct Derivatives {
    Vec3 acceleration{0, 0, 0}, jerk{0, 0, 0};            // m/s2, m/s3
    Vec3 spin_acceleration{0, 0, 0}, spin_jerk{0, 0, 0};  // rad/s2, rad/s3
};

// Number of grains from which on they do not stay in a processor's own cache.
constexpr std::size_t kLargeBed = 50'000;

struct Grains {
    std::vector<std::int32_t> id;
    std::vector<std::int32_t> species;
    LargeArray<Place> place;
    LargeArray<Motion> motion;
    LargeArray<Load> load;
    LargeArray<RoundedMotion> rounded;     // empty unless a law reads it
    LargeArray<double> wall_work;          // J, done by moving walls on this grain since the drive started
    std::vector<Quaternion> orientation;   // empty unless asked for
    std::vector<Derivatives> derivatives;  // empty unless the integrator has them

    std::size_t size() const { return id.size(); }

    // Makes room for `count` grains.
    void reserve(std::size_t count);
    // Adds a grain at rest; `density` is in kg/m3.
    void add(std::int32_t grain_id, std::int32_t grain_species, const Vec3& position, double radius,
             double density);
    // Sets the radius (m), and with it mass and inertia of a solid sphere; `density` is in kg/m3.
    void set_radius(std::size_t i, double radius, double density);
    double mass(std::size_t i) const { return 1 / motion[i].inverse_mass; }
    double inertia(std::size_t i) const { return 1 / motion[i].inverse_inertia; }

    // Puts the grains in a new order: order[new index] = old index. All members of a team call it. The loads
    // must have been used up, because their memory serves as room for the copies.
    void reorder(const std::vector<std::int32_t>& order, const TeamMember& me);
};

}  // namespace grainreel
