// How long lists last: until grains and walls may have moved farther than the lists reach.
//
// Displacements are measured relative to the free flight of the bed since the neighbour lists were made. This
// is safe whatever the bed does: two grains come closer by at most the sum of their displacements relative to
// any common frame.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"
#include "engine/step/motion/scheme.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// How far and how fast the points of walls move. Lists last until they may have moved too far.
class WallWays {
  public:
    // The surroundings must outlive this object, and their meshes must stay the same.
    explicit WallWays(const Surroundings& around);

    // The largest displacement (m) of any point of any wall between two poses, relative to a frame displaced
    // by `flown`.
    double farthest(const DrivePose& before, const DrivePose& now, const Vec3& flown) const;
    // The largest speed (m/s) of any point of any wall relative to a frame with the velocity `frame`.
    double fastest(const DrivePose& now, const Vec3& frame) const;

  private:
    // A body's points lie within `radius` (m) of an axis through `centre`, about which it turns.
    struct Swing {
        Vec3 centre{0, 0, 0};  // m, at rest
        double radius = 0;
    };
    static Swing swing_of(const Face& face);
    static Swing swing_of(const MeshWall& mesh);

    const Surroundings& around_;
    std::vector<Swing> of_meshes_;
};

// How far the contact lists reach, and how much of that has been used up since their last refresh. Every
// thread has its own copy, and all copies are equal. Checkpoints hold it as it lies in memory.
struct Reach {
    double skin = 0;          // m
    double moved = 0;         // m; no grain has moved farther relative to the bed's free flight
    double fastest = 0;       // m/s, the largest speed of the last step
    std::int64_t parted = 0;  // contacts that were computed in vain, summed over the steps
    Vec3 drift{0, 0, 0};      // m, displacement of the free flight at the refresh
    DrivePose pose;           // pose of the walls at the refresh
};

class ListLife {
  public:
    static constexpr double kLastsWell = 1000;  // steps that lists with the right skin last

    ListLife(const Surroundings& around, int threads);

    // Begins anew, with the first skin.
    void restart();
    void set_step(double time) { listed_step_ = time; }

    double skin() const { return skin_; }  // m, of the neighbour lists
    // While one thread sets the skin of the lists that are to be made, the others may still read skin().
    // `lasted` is the number of steps that the last lists have lasted.
    void set_next_skin(double lasted);
    double next_skin() const { return next_skin_; }
    void use_next_skin() { skin_ = next_skin_; }
    // Notes that neighbour lists have been made at `time` (steps) from the grains as they are.
    void note_listing(const Grains& grains, const DrivePose& pose, double time);
    // Steps that the neighbour lists have lasted. Lists that expired because grains came count as having
    // lasted well.
    double lasted(double time) const;

    // The displacement (m) of the free flight since the neighbour lists were made. `time` is in steps, and
    // `step` in s.
    Vec3 drift(double time, double step) const;
    // The mean velocity of the free flight since the last forces, m/s.
    Vec3 frame(const Evaluation& at, double step) const;

    Reach& reach(int thread) { return threads_[thread].reach; }
    const Reach& reach(int thread) const { return threads_[thread].reach; }
    // Counts one more evaluation. `fastest` (m/s) holds the largest components of all grains' velocities
    // relative to the frame, and `parted` is the number of contacts that were computed in vain. Returns
    // whether the contact lists must be refreshed. That is so when they no longer reach far enough, or when
    // parted contacts have cost about as much as a refresh. All threads get the same answer, because they
    // count the same numbers.
    bool contacts_expired(int thread, const Vec3& fastest, std::int64_t parted, std::int64_t grains,
                          const Evaluation& at, const Vec3& drift);
    // How far (m) walls have moved since the contact lists were refreshed, beside the free flight.
    double wall_way(int thread, const Evaluation& at, const Vec3& drift) const;
    // Sets the skin so that the contact lists last for some 48 steps at the present speeds.
    void set_reach(int thread, const DrivePose& now, const Vec3& drift, const Vec3& frame, double step);
    // Measures how far the grains [begin, end) have moved. Every thread does so for its own grains. After a
    // barrier, each thread may ask lists_expired() whether the neighbour lists must be made anew.
    void measure(int thread, const Grains& grains, std::int32_t begin, std::int32_t end, const Vec3& drift);
    bool lists_expired(int thread, const DrivePose& now, const Vec3& drift) const;

    // Leaves grains out. `index` holds the new index of each grain, below 0 for a grain that leaves.
    void leave_out(const std::vector<std::int32_t>& index);
    // Adds a grain that is in no list. All lists then expire at the end of the next step.
    void add_unlisted();

    // Calls each() for everything that is saved except the reach, in the order of the file.
    template <class Life, class Each>
    static void transfer(Life& life, const Each& each) {
        each(life.listed_at_), each(life.listed_velocity_), each(life.listed_pose_), each(life.listed_step_);
        each(life.skin_);
    }
    // Whether the values that were read could have been saved.
    bool is_sound(std::int32_t grains, const Reach& reach) const;

  private:
    struct alignas(64) Thread {
        Reach reach;
        double farthest = 0;  // m, largest displacement of the thread's grains since they were listed
    };
    double farthest() const;

    static constexpr float kNowhere = 1e6;  // m, coordinate at which unlisted grains count as listed
    static constexpr double kLeastSkin = 0.5, kMostSkin = 2.8;  // in units of the skin of the surroundings

    const Surroundings& around_;
    const WallWays ways_;
    std::vector<Thread> threads_;
    double skin_, next_skin_;  // m
    // State of the grains and walls when the neighbour lists were made.
    std::vector<Eigen::Vector3f> listed_at_;  // m; floats to save memory, and their rounding is counted
    Vec3 listed_velocity_{0, 0, 0};
    DrivePose listed_pose_;
    double listed_step_ = 0;  // steps
};

}  // namespace grainreel
