// Finds out which settings of a study begin with the same packing. The cache lets one of them pack for all.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class PackingSharing {
  public:
    // To be called for each setting when it is planned.
    void add_setting(const Scene& scene, const Plan& plan);

    // "4 settings share one packing", or why settings that differ in the drive alone do not share theirs.
    // Empty where there is nothing to say: a single setting, or none that packs.
    std::string text() const;

  private:
    static constexpr std::size_t kMost =
        200;  // limit for the settings that are looked at, since each costs some milliseconds

    std::size_t settings_ = 0, packing_ = 0;  // settings that were looked at, and those of them that pack
    std::set<std::string> packings_;
    std::set<std::string> without_drive_;  // packings of the scenes without their drives
    bool grows_ = false;                   // whether the radii of some setting grow
};

}  // namespace grainreel
