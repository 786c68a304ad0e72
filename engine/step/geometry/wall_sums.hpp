// The force and moment of the grains on each face and mesh, and their pressure by height, summed over all
// steps.
//
// The sums are sums of whole numbers. So they have the same bits for any number of threads, in whatever order
// contacts are computed, and however a run is cut into pieces. A force is rounded once, to a multiple of a
// quantum; this rounding is unbiased and below 1e-14 of the force of a wall's spring at an overlap of a
// grain's radius.
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

// The units of the counts, and the slices of height.
struct WallScale {
    double force = 1;   // N; a power of two
    double length = 1;  // m; a moment counts in force times length; a power of two
    double slice = 0;   // m, height of a slice; the lowest begins at height 0 of the scene
    int slices = 0;
    double period = 0;  // m, of x; 0 for none
};

// Sums over the evaluations of the forces. Each evaluation is weighted by the share of a step for which its
// forces act. Checkpoints hold these sums as they lie in memory.
struct FaceSums {
    std::array<WideInt, 3> force{}, moment{};            // sums of all evaluations before the last
    std::array<WideInt, 3> last_force{}, last_moment{};  // those of the last evaluation
    bool operator==(const FaceSums&) const = default;
};

struct WallSums {
    WallScale scale;
    double felt = 0;              // share of the last forces that has acted on the grains
    std::vector<FaceSums> faces;  // faces, then meshes, in the order of the surroundings
    std::vector<WideInt>
        slices;  // normal forces by height, face after face, including those of the last evaluation
};

// Whether sums from a file could have been counted: they have `faces` faces, and no run makes them larger.
bool is_sound(const WallSums& sums, std::size_t faces, const WallScale& scale);
bool are_sound(const std::vector<FaceSums>& faces);
bool are_sound(const std::vector<WideInt>& slices);

// The sums of one thread.
class WallTally {
  public:
    // `bases` holds the height of each wall's point at rest (m), of the faces, then of the meshes.
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

    // Call this before the forces of an evaluation. `share` is the share of a step for which these forces
    // act.
    void begin_evaluation(double share) {
        for (std::size_t f = 0; f < now_.size(); ++f)
            for (int a = 0; a < 3; ++a) {
                sums_[f].force[a] += now_[f].force[a];
                sums_[f].moment[a] += now_[f].moment[a];
            }
        now_.assign(now_.size(), {});
        set_share(share);
    }

    // Adds a contact. `force` (N) acts on the face, and `normal` (N) is its normal part. `arm` (m) leads from
    // the face's point to the contact. `couple` (N m) is a further torque on the face.
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
    // Adds this thread's counts to the sums of all threads.
    void add_to(WallSums& all) const;
    // Begins with the sums of an earlier tally instead of zeros.
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
    // The sum of two thousand contacts at the bound kMost still fits. The bound is 16 times the force on a
    // grain that is in the wall up to its centre, and such a grain stops the run.
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
