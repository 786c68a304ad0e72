// A simulation of one scene: it packs the grains, makes steps with checks of health, and gives frames and
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
#include "engine/measure/deepest_contact.hpp"
#include "engine/measure/measures.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

// A contact with all data that a question about the forces on a grain needs.
struct DetailedContact {
    std::int32_t first, second;  // ids; second is -1 - w for wall w, where the faces come before the meshes
    Vec3 normal;                 // unit, from first to second
    double overlap;              // m
    double normal_force;         // N, on second along the normal; below 0 where the law attracts
    Vec3 tangential;             // N, on second
    Vec3 torque_on_first;        // N m
    Vec3 torque_on_second;       // N m; zero for a wall
    double friction;             // friction coefficient of this pair
    Vec3 point;                  // m
    double smaller_radius;       // m, of the two grains; at a wall the grain's
    double stored_energy;        // J, energy that unloading would give back
    std::int32_t triangle = -1;  // triangle of a mesh that is touched; -1 for other bodies

    Vec3 on_second() const { return normal_force * normal + tangential; }  // N
    Vec3 on_first() const { return -on_second(); }
    // Bodies may also touch without a force, for example when they part after a plastic impact.
    bool pushes() const { return normal_force != 0 || !tangential.isZero(0); }
    // Whether friction is at its limit, so that the surfaces slide.
    bool slides() const {
        constexpr double all = 1 - 1e-6;
        return friction > 0 && normal_force > 0 && tangential.norm() >= all * friction * normal_force;
    }
};

// Progress before the drive starts, for the progress line.
struct PackingProgress {
    enum class Stage { growing, raining, settling };
    Stage stage = Stage::growing;
    double done = 0;  // 0 to 1, share of the wanted radii, of the grains, or of the time limit of settling
    std::int64_t steps = 0;  // so far
};
// Return false to stop.
using PackingWatcher = std::function<bool(const PackingProgress&)>;

struct PackingResult {
    bool finished = true;          // false when the watcher stopped it
    bool settled = true;           // false when the time limit ended settling
    double settle_time = 0;        // s, simulated
    double kinetic_per_grain = 0;  // J, at the end
    double solid_fraction = 0;     // below the bed's top, that is, where 95 % of the centres lie
    // Grains that lay in an exit when the bed was packed, and left at step 0; and their share of the volume
    // of all grains.
    std::size_t left = 0;
    double left_share = 0;
};
// Called with a packed bed, before grains leave through exits and before anything is measured.
using WhenPacked = std::function<void(const PackingResult&)>;

// Throws UserError, as a run would, where the grains of a file or a list do not fit the scene.
void check_start(const Scene& scene, const Plan& plan);

class SimulatedBed {
  public:
    // With `threads` = 0 there is one thread for each processor that this process may use. Takes the grains
    // of a file or a list, and throws UserError if they do not fit the scene.
    SimulatedBed(const Scene& scene, const Plan& plan, int threads);
    // The run of the scene at a checkpoint, which may be its last step. This replaces the scene's own start
    // and pack(). Throws UserError if the checkpoint cannot be used or belongs to another run. With
    // `may_change`, the scene may differ from the scene of the checkpoint. The caller must then have checked
    // that the run can go on with it. `replays` is for computing moments of a run once more: the run then has
    // orientations if the checkpoint has them, whatever the scene says.
    static SimulatedBed at_checkpoint(const Scene& scene, const Plan& plan,
                                      const std::filesystem::path& checkpoint, int threads,
                                      bool may_change = false, bool replays = false);
    // The run of the scene from a packing that save_packing() has kept under the same key, with the result of
    // that pack(). This replaces pack(), and the run has the same bits as one that packs by itself. Empty if
    // the file is missing, damaged or has another key; nothing in it is trusted.
    static std::optional<SimulatedBed> with_packing(const Scene& scene, const Plan& plan,
                                                    const std::filesystem::path& file, const std::string& key,
                                                    int threads, PackingResult& result);
    ~SimulatedBed();
    SimulatedBed(SimulatedBed&&) noexcept;
    SimulatedBed& operator=(SimulatedBed&&) noexcept;

    // Places the grains (layers and radius growth, or rain, then settling), if they are not placed yet.
    // Exits do not act on this: grains that then lie in one leave at step 0. Afterwards step() is 0. If the
    // scene goes on from a checkpoint (start.keep_clock), it is that step.
    PackingResult pack(const PackingWatcher& watcher, const WhenPacked& when_packed = {});
    PackingResult pack();
    // Everything that decides the result of pack(), as text. Two scenes with the same key have the same
    // packing to the bit, in this program on this processor. Empty if nothing is packed, or if a contact law
    // acts that a user of the library has written. The text leaves out what the scene says of film, output
    // and duration. It has all that the scene says of the drive if radii grow, because the walls already move
    // while they grow. Otherwise it has only whether there is a drive, what this moves, and the offset and
    // velocity of what it moves at step 0.
    std::string packing_key() const;
    // Writes the file for with_packing(). Call it when the bed is packed (WhenPacked), or after pack() if no
    // grain has left, before any step. Throws RunError if it cannot be written.
    void save_packing(const std::filesystem::path& file, const std::string& key,
                      const PackingResult& result) const;

    // Runs up to step `target`. Throws RunError if the run is not healthy.
    void advance(std::int64_t target);

    // The contact that has overlapped most so far, and a line about it for the user where it overlapped more
    // than told_overlap(), a share of the smaller radius; else empty. It is seen by the checks of health, at
    // most every 200 steps, and by note_overlap(), which looks now.
    const DeepestContact& deepest_contact() const;
    void note_overlap();
    double told_overlap() const;
    std::string overlap_text() const;
    // For a run that goes on: the one of the run up to there. One of a later step does not count.
    void set_deepest_contact(DeepestContact former);

    // These two remove and add grains at the step that has been reached, once the run is packed. New grains
    // must touch nothing. insert() returns the id of the first of them.
    void remove(const std::vector<std::int32_t>& ids);
    std::int32_t insert(const std::vector<ComingGrain>& grains);
    // The account of grains since the start of the drive, and the grains that have left since the last call.
    const Traffic& traffic() const;
    std::vector<Departure> take_departures();

    std::int64_t step() const;
    std::size_t grains() const;  // number of grains that are there now
    int threads() const;

    State frame() const;
    Measures measures() const;                         // all columns of measures.csv
    const std::vector<std::string>& measured() const;  // their names
    // One of these columns. Computes only what it needs.
    double measure(const std::string& column) const;
    // Fields on grids: their sets, which stay the same, and their present values in the same order.
    std::vector<const FieldSet*> field_sets() const;
    std::vector<FieldValues> fields() const;
    std::uint64_t state_hash() const;  // hash of every bit that decides the future

    // Contacts whose normal force is above 0 now, for contacts.nc; by rising `first`, then `second`.
    using SavedContact = grainreel::SavedContact;
    std::vector<SavedContact> contacts() const;
    // All contacts that touch now, with their forces on the grains, in the same order.
    std::vector<DetailedContact> contact_forces() const;

    // Writes everything needed to go on bit-identically, under a temporary name that is then changed.
    void save_checkpoint(const std::filesystem::path& path) const;

  private:
    struct Impl;
    explicit SimulatedBed(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// Number of threads that are worth using on so many processors. A thread with too few grains waits longer
// than it works.
int useful_threads(int processors, std::int64_t grains);

// Number of threads of a run that has the processors for itself: as many as the scene allows, or all that
// this process may use.
int engine_threads(const Scene& scene);

}  // namespace grainreel
