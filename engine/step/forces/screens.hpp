// Which contacts do not count in a step, because another wall is nearer in the same direction or stands in
// the way. patches.hpp has the two rules for the places of one mesh; here they hold for all walls of a grain:
// its meshes, and its meshes and faces. (Faces do not screen each other.) A mesh also stands between two
// grains, and between a grain and a glued grain.
//
// If two places have the same distance, the place on the wall with the lower number counts. The choice
// depends on the grain alone, so neither the threads nor the order of lists matter. Only what ScreenWatch
// lists is looked at.
//
// Where a contact ends because another wall's place counts instead of its own, the new contact goes on with
// its history, if both have the same law and the same parameters. Otherwise it begins as a new one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/state/grains.hpp"
#include "engine/step/geometry/patches.hpp"
#include "engine/step/lists/histories.hpp"
#include "engine/step/lists/screen_watch.hpp"

namespace grainreel {

struct ForceInput;  // law_input.hpp
struct ThreadContacts;
class Halo;

class Screens {
  public:
    // A history that a new contact goes on with.
    struct Heir {
        std::int32_t grain, wall;  // the wall that it touches now
        Vec3 normal;
        std::array<double, Histories::kMostNumbers> numbers;  // those of the laws
    };

    // Finds the contacts that do not count with grains and walls as they are in `in`. Call it before any
    // contact of the step. Grains of other threads are read from the copies in `halo`; without it, from the
    // grains themselves.
    void find(const ForceInput& in, const ThreadContacts& contacts, Halo* halo);

    // Whether the contact of two bodies of a group does not count. Contacts with meshes are not asked here:
    // leave_out() takes their patches away.
    bool screens(std::int32_t group, std::int32_t first, std::int32_t second) const {
        return !gone_.empty() && holds({group, first, second});
    }
    bool any() const { return !gone_.empty(); }
    // Leaves out the patches of a mesh that do not count for a grain. `wall` numbers it after the faces.
    void leave_out(std::int32_t grain, std::int32_t wall, Patches& patches) const;
    // The history with which a new contact of this normal goes on, or nullptr.
    const Heir* heir(std::int32_t grain, std::int32_t wall, const Vec3& normal) const;
    const std::vector<Heir>& heirs() const { return heirs_; }

  private:
    // A place at which a grain touches a wall.
    struct Spot {
        std::int32_t wall, triangle;  // -1 for a face
        TouchedPlace place;
        std::int64_t order;  // the distance in steps so small that only equal walls share one
        bool counts = true;
    };
    // A contact that touched in the last step.
    struct Before {
        std::int32_t wall, group, place;
        Vec3 normal;
        bool goes_on = false;
    };
    struct LeftOut {
        std::int32_t grain, wall, triangle;
    };
    bool holds(const ScreenWatch::Pair& pair) const;
    void look_between(const ForceInput& in, const ThreadContacts& contacts, Halo* halo);
    void look_at(const ForceInput& in, const ThreadContacts& contacts, const ScreenWatch::Grain& watched);
    void find_spots(const ForceInput& in, const ThreadContacts& contacts, const ScreenWatch::Grain& watched);
    void add_face(const ForceInput& in, const ThreadContacts& contacts, std::int32_t grain,
                  std::int32_t face);
    void add_mesh(const ForceInput& in, const ThreadContacts& contacts, std::int32_t grain,
                  std::int32_t mesh);
    void add_spot(const Place& grain, std::int32_t wall, std::int32_t triangle, const TouchedPlace& touched);
    bool is_screened(const ForceInput& in, const Place& grain, const Spot& spot) const;
    void leave_to_heirs(const ForceInput& in, const ThreadContacts& contacts, std::int32_t grain);

    Patches patches_;
    std::vector<Spot> spots_;
    std::vector<Before> before_;
    std::vector<ScreenWatch::Pair> gone_;  // pairs, grains with glued grains, grains with faces; rising
    std::vector<LeftOut> left_out_;        // patches of meshes
    std::vector<Heir> heirs_;
};

}  // namespace grainreel
