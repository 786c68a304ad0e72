// One moment of a run with all that is known about it, for questions.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/measure/flow/flowed_out.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct MeshWear;  // engine/measure/walls/mesh_wear.hpp

// What only the engine knows about a moment.
struct SnapshotForces {
    std::vector<DetailedContact> contacts;  // all contacts that touch
    // Acceleration (m/s2) of each grain of the frame, from its motion to the next step. Empty with an
    // integrator whose steps do not tell it.
    std::vector<Vec3> acceleration;
};

// What a question may need and a snapshot may lack. forces: SnapshotForces, which only a moment that was
// brought back (computed again from a checkpoint) has. period: how far grains moved in the last period of the
// drive (Snapshot::displacement). Some files of other programs have no velocities or spins.
enum class Needs { nothing, contacts, forces, period, velocities, spins };

struct Snapshot {
    const Scene& scene;
    State frame;
    bool contacts = false;             // whether touches are known
    State start;                       // the run's first moment
    std::vector<Link> touches{};       // contacts of the moment
    std::vector<Vec3> displacement{};  // m, of each grain over the last period; empty where not known
    // Pressure and wear of the meshes, and what has flowed out; only of a kept moment whose film shows them.
    std::shared_ptr<const std::vector<MeshWear>> worn{};
    std::optional<FlowedOut> flowed_out{};
    std::optional<SnapshotForces> forces{};  // only where the moment was brought back
    std::optional<MeasuredRow> measured{};   // measures at the moment, or the row nearest to it in time
    double bin_width = 0;                    // m, of bins along lengths; 0: the mean diameter of the grains
    bool velocities = true, spins = true;    // whether they are known; unknown velocities are NaN

    bool has(Needs what) const;
    double mass(std::size_t i) const;  // kg, of grain i of the frame
    double mean_diameter() const;      // m, of the grains in the frame
    double bin() const { return bin_width > 0 ? bin_width : mean_diameter(); }  // m
    double height(std::size_t i) const;  // m, of the grain's centre above the floor as it is now
    // Place in the frame of the grain with this id; empty when there is none.
    std::optional<std::size_t> place_of(std::int64_t id) const;
};

// How far (m) the drive has moved the container, and its floor, from their places at rest. A turn of the
// container does not count.
Vec3 container_offset(const Scene& scene, const State& frame);
Vec3 floor_offset(const Scene& scene, const State& frame);

// Names of all walls by their numbers (-1 - wall): the faces ("left slant"), then the meshes.
std::vector<std::string> wall_names(const Scene& scene);

// The index of the scene's mesh that a wall's number means; empty for a face.
std::optional<std::size_t> mesh_of_wall(const Scene& scene, std::int32_t wall);

// The species of a grain ("small") or, for a wall's number, its name ("floor"), as in contacts.nc.
std::string name_of_body(const Snapshot& snapshot, std::int32_t id);

// How far each grain moved in a period of the drive: the vector (m) from its place in `before` to its place
// now, divided by the number of periods in between; NaN for a grain that was not there before. `depth` (m,
// along x) is the length after which a periodic container repeats; 0 for none.
std::vector<Vec3> displacement_since(const State& before, const State& now, int periods, double depth);

// The same grains in two frames. Ids rise in both, and some grains may have come or gone between them.

inline constexpr std::size_t kNoRow = static_cast<std::size_t>(-1);

// For each grain of `frame`, its row in `other`; kNoRow where it is not there.
inline std::vector<std::size_t> rows_in(const State& other, const State& frame) {
    std::vector<std::size_t> rows(frame.size(), kNoRow);
    std::size_t row = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        while (row < other.size() && other.id[row] < frame.id[i]) ++row;
        if (row < other.size() && other.id[row] == frame.id[i]) rows[i] = row;
    }
    return rows;
}

}  // namespace grainreel
