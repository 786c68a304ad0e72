// What grains do to each face and mesh, summed over all steps: force, moment, and how the pressure spreads
// over height.
//
// The sums are the same bits at any number of threads, in whatever order contacts are computed, and however a
// run is cut into pieces: they are sums of whole numbers. A force is rounded once, to a multiple of a
// quantum; that rounding is unbiased and below 1e-14 of what a wall's spring would give over a grain's
// radius.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/base/vector.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

__extension__ typedef __int128 WideInt;

// What a count is worth, and how height is divided.
struct WallScale {
    double force = 1;   // N; a power of two
    double length = 1;  // m; a moment counts in force times length; a power of two
    double slice = 0;   // m, height of a slice; the lowest begins at height 0 of the scene
    int slices = 0;
    double period = 0;  // m, of x; 0 for none
};

// Over the evaluations of the forces, each with the share of a step that its forces act.
struct FaceSums {
    std::array<WideInt, 3> force{}, moment{};            // of all evaluations before the last
    std::array<WideInt, 3> last_force{}, last_moment{};  // of the last
    bool operator==(const FaceSums&) const = default;
};

struct WallSums {
    WallScale scale;
    double felt = 0;              // of the last forces: the share that the grains have felt
    std::vector<FaceSums> faces;  // in the order of the surroundings': of faces, then of meshes
    std::vector<WideInt> slices;  // face after face: normal forces by height, the last among them
};

// Whether sums that were read can have been counted: of so many faces, and no larger than any run makes them.
bool is_sound(const WallSums& sums, std::size_t faces, const WallScale& scale);
bool are_sound(const std::vector<FaceSums>& faces);
bool are_sound(const std::vector<WideInt>& slices);

// The sums of one thread.
class WallTally {
  public:
    // bases: m, the height of each wall's point at rest; of the faces, then of the meshes.
    void begin(const std::vector<double>& bases, const WallScale& scale) {
        scale_ = scale;
        now_.assign(bases.size(), {});
        sums_.assign(bases.size(), {});
        slices_.assign(bases.size() * static_cast<std::size_t>(scale.slices), 0);
        base_ = bases;
        set_share(1);
    }
    void begin(const std::vector<Face>& faces, const WallScale& scale) {
        std::vector<double> bases;
        for (const Face& face : faces) bases.push_back(face.point.z());
        begin(bases, scale);
    }

    // Forgets all evaluations but the last one, whose forces are still to act.
    void begin_anew() {
        sums_.assign(sums_.size(), {});
        slices_.assign(slices_.size(), {});
    }

    // Before the forces of an evaluation; share: of a step, that they act.
    void begin_evaluation(double share) {
        for (std::size_t f = 0; f < now_.size(); ++f)
            for (int a = 0; a < 3; ++a) {
                sums_[f].force[a] += now_[f].force[a];
                sums_[f].moment[a] += now_[f].moment[a];
            }
        now_.assign(now_.size(), {});
        set_share(share);
    }

    // A contact. force: N, on the face; normal: N; arm: m, from the face's point to the contact; couple: N m,
    // on the face beside the force.
    void add(std::int32_t face, const Vec3& force, double normal, Vec3 arm,
             const Vec3& couple = Vec3(0, 0, 0)) {
        const auto f = static_cast<std::size_t>(face);
        if (scale_.period > 0) arm.x() = nearest_image(arm.x(), scale_.period);
        const Vec3 moment = arm.cross(force) + couple;
        for (int a = 0; a < 3; ++a) {
            now_[f].force[a] += count(force[a] * per_force_);
            now_[f].moment[a] += count(moment[a] * per_moment_);
        }
        if (scale_.slices == 0) return;
        const double height = (arm.z() + base_[f]) * per_slice_;
        const int slice = height > 0 ? static_cast<int>(std::min(height, scale_.slices - 1.0)) : 0;
        slices_[f * static_cast<std::size_t>(scale_.slices) + static_cast<std::size_t>(slice)] +=
            count(normal * per_force_);
    }

    const WallScale& scale() const { return scale_; }
    // Adds this thread's counts to those of all.
    void add_to(WallSums& all) const;
    // Takes what was counted before, in place of nothing.
    void take(const WallSums& before);

  private:
    struct Now {
        std::array<std::int64_t, 3> force{}, moment{};
    };
    void set_share(double share) {
        per_force_ = share / scale_.force;
        per_moment_ = per_force_ / scale_.length;
        per_slice_ = scale_.slice > 0 ? 1 / scale_.slice : 0;
    }
    // Two thousand contacts at the bound still fit. It is 16 times what a wall gives a grain that is in it
    // up to its centre, which stops the run.
    static std::int64_t count(double x) {
        constexpr double kMost = 0x1p52;
        return std::llrint(std::clamp(x, -kMost, kMost));
    }

    WallScale scale_;
    double per_force_ = 1, per_moment_ = 1, per_slice_ = 0;
    std::vector<Now> now_;
    std::vector<FaceSums> sums_;
    std::vector<WideInt> slices_;
    std::vector<double> base_;  // m, height of a face's point at rest
};

}  // namespace grainreel
