// One scene in motion: packing, then the step loop, with health checks. What leaves it are frames and
// measures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/frame.hpp"
#include "engine/measure/measures.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

// A contact with all that a question about the forces on a grain needs.
struct ContactForce {
    std::int32_t first, second;  // ids; second is -1 - face for a wall
    Vec3 normal;                 // unit, from first to second
    double overlap;              // m
    double normal_force;         // N, on second along the normal; below 0 where the law attracts
    Vec3 tangential;             // N, on second
    Vec3 torque_on_first;        // N m
    Vec3 torque_on_second;       // N m; zero for a wall
    double friction;             // coefficient of this pair
    Vec3 point;                  // m
    double smaller_radius;       // m, of the two; of a wall that of the grain
    double stored_energy;        // J, that unloading would give back
    std::int32_t triangle = -1;  // of a mesh: where it is touched

    Vec3 on_second() const { return normal_force * normal + tangential; }  // N
    Vec3 on_first() const { return -on_second(); }
    // Bodies may also touch without a force: springs that are latched, and grains that part.
    bool pushes() const { return normal_force != 0 || !tangential.isZero(0); }
    // Whether friction is all used up, so that the surfaces slide.
    bool slides() const {
        constexpr double all = 1 - 1e-6;
        return friction > 0 && normal_force > 0 && tangential.norm() >= all * friction * normal_force;
    }
};

// What happens before the drive starts, for the progress line.
struct PackingProgress {
    enum class Stage { growing, raining, settling };
    Stage stage = Stage::growing;
    double done = 0;  // 0 to 1: share of the wanted radii, of the grains, or of the time limit of settling
    std::int64_t steps = 0;  // so far
};
// Return false to stop.
using PackingWatcher = std::function<bool(const PackingProgress&)>;

struct PackingResult {
    bool finished = true;          // false when the watcher stopped it
    bool settled = true;           // false when the time limit ended settling
    double settle_time = 0;        // s, simulated
    double kinetic_per_grain = 0;  // J, at the end
    double solid_fraction = 0;     // of the bed below the height under which 95 % of the centres lie
};

// Throws UserError, as a run would, where the grains of a file or a list do not fit the scene.
void check_start(const Scene& scene, const Plan& plan);

class Simulation {
  public:
    // threads: 0 takes what the machine gives. Takes the grains of a file or a list, and throws UserError
    // where they do not fit the scene.
    Simulation(const Scene& scene, const Plan& plan, int threads);
    // The run of the scene as a checkpoint of it has it, which may be its last step. Takes the place of the
    // scene's own start and of pack(). Throws UserError where the checkpoint cannot be used, or is of another
    // run. may_change: the scene may be another one from then on, which the caller has checked. replays: it
    // has orientations where the checkpoint has them, whatever the scene says.
    static Simulation at_checkpoint(const Scene& scene, const Plan& plan,
                                    const std::filesystem::path& checkpoint, int threads,
                                    bool may_change = false, bool replays = false);
    // The run of the scene from a packing that save_packing() has kept under the same key, and what its
    // pack() gave. Takes the place of pack(); from here on the run is the one that packs by itself, bit by
    // bit. None where the file is none, is damaged or has another key; nothing in it is believed.
    static std::optional<Simulation> with_packing(const Scene& scene, const Plan& plan,
                                                  const std::filesystem::path& file, const std::string& key,
                                                  int threads, PackingResult& result);
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    // Places the grains (layers and radius growth, or rain, then settling), if they are not there already.
    // Afterwards step() is 0, or the file's step when the scene keeps its clock.
    PackingResult pack(const PackingWatcher& watcher);
    PackingResult pack();
    // All that decides how pack() leaves the grains, as text: two scenes with the same key have the same
    // packing to the bit, in this program on this processor. Empty where nothing is packed, or where a
    // caller's law acts. The keys of film, output and duration are not in it. The drive's are where radii
    // grow, because the walls already move then; else only whether and what it moves.
    std::string packing_key() const;
    // After pack(), before any step: what with_packing() takes. Throws RunError when it cannot be written.
    void save_packing(const std::filesystem::path& file, const std::string& key,
                      const PackingResult& result) const;

    // Runs up to step `target`. Throws RunError when the run stopped being healthy.
    void advance(std::int64_t target);

    // At the step that has been reached. New grains must touch nothing; returns the id of the first of them.
    // Both once the run is packed.
    void remove(const std::vector<std::int32_t>& ids);
    std::int32_t insert(const std::vector<NewGrain>& grains);
    // What came and left since the start of the drive, and who has left since the last call.
    const Traffic& traffic() const;
    std::vector<Departure> take_departures();

    std::int64_t step() const;
    std::size_t grains() const;  // that are there now
    int threads() const;

    Frame frame() const;
    Measures measures() const;                         // all columns of measures.csv
    const std::vector<std::string>& measured() const;  // their names
    // One of them. Looks at no more than that needs.
    double measure(const std::string& column) const;
    // On grids: what the observers give, which stays the same, and the values now in the same order.
    std::vector<const FieldSet*> field_sets() const;
    std::vector<FieldValues> fields() const;
    std::uint64_t state_hash() const;  // of every bit that decides the future

    // Contacts that carry force now, for contacts.nc; by rising `first`, then `second`.
    using SavedContact = grainreel::SavedContact;
    std::vector<SavedContact> contacts() const;
    // All contacts that touch now, with what they do to the grains; in the same order.
    std::vector<ContactForce> contact_forces() const;

    // Everything needed to go on bit-identically; written to a temporary name and renamed.
    void save_checkpoint(const std::filesystem::path& path) const;

  private:
    struct Impl;
    explicit Simulation(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// How many of these processors to use. A thread with too few grains waits longer than it works.
int useful_threads(int processors, std::int64_t grains);

// How many threads a run takes that has the processors for itself: those that the scene grants it, or all
// that this process may use.
int engine_threads(const Scene& scene);

}  // namespace grainreel
