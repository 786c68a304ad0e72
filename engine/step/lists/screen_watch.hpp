// What forces/screens.hpp must look at in each step until the next refresh: grains that may touch several
// walls where a user means one, and pairs of grains between which a mesh may stand. A refresh lists them, and
// rather too many than too few. In a scene without meshes nothing is listed, and in most scenes with meshes
// next to nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace grainreel {

struct ContactRules;    // contact_rules.hpp
struct Nearby;          // candidates.hpp
struct ThreadContacts;  // thread_contacts.hpp

struct ScreenWatch {
    // An own grain near several walls, of which one at least is a mesh. Its walls are walls[first] and those
    // after it: numbers of faces, then of meshes, numbered after the faces; rising.
    struct Grain {
        std::int32_t grain, first, count;
    };
    // Two grains, or a grain and a glued grain, with the group of their contact.
    struct Pair {
        std::int32_t group, first, second;
        bool operator==(const Pair&) const = default;
        auto operator<=>(const Pair&) const = default;
    };
    std::vector<Grain> grains;  // rising
    std::vector<std::int32_t> walls;
    std::vector<Pair> pairs;  // rising

    bool empty() const { return grains.empty() && pairs.empty(); }
    void clear() { grains.clear(), walls.clear(), pairs.clear(); }
    std::span<const std::int32_t> walls_of(const Grain& one) const {
        return std::span(walls).subspan(static_cast<std::size_t>(one.first),
                                        static_cast<std::size_t>(one.count));
    }
};

// Lists what a thread must look at. Call it when the thread's candidates and meshes are listed.
void list_screens(const ContactRules& rules, const Nearby& nearby, ThreadContacts& contacts);

}  // namespace grainreel
