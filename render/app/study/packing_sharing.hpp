// Which settings of a study begin with the same packing, so that one packs for all by the cache.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class PackingSharing {
  public:
    // Settings are told as they are planned.
    void add_setting(const Scene& scene, const Plan& plan);

    // "4 settings share one packing", or why settings that differ in the drive alone do not share theirs.
    // Empty where there is nothing to say: a single setting, or none that packs.
    std::string text() const;

  private:
    static constexpr std::size_t kMost = 200;  // settings that are looked at: each costs some milliseconds

    std::size_t settings_ = 0, packing_ = 0;  // those that were looked at, and those of them that pack
    std::set<std::string> packings_;
    std::set<std::string> without_drive_;  // scenes but for their drives
    bool grows_ = false;                   // a setting's radii grow
};

}  // namespace grainreel
