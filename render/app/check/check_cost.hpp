// Estimates what a study will cost. A study runs members: each of its settings with several seeds.
#pragma once

#include <vector>

#include "engine/plan/plan.hpp"
#include "render/app/estimate/cost_estimate.hpp"
#include "render/app/study/file/members.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What one member costs on one thread.
struct MemberEstimate {
    double seconds = 0, bytes = 0;
};

// Call add_setting() for each setting in its order, then ask for members.
class StudyEstimate {
  public:
    // measured: whether the speed of this machine is measured. If not, that of a usual machine is assumed,
    // which is enough for comparing members.
    StudyEstimate(int jobs, bool films, bool measured) : jobs_(jobs), films_(films), measured_(measured) {}

    void add_setting(const FilmedScene& scene, const Plan& plan);
    MemberEstimate of(const Member& member) const;
    // Time in s until the last of these members is done, when `jobs` of them run at a time and each starts as
    // soon as another one ends.
    double wall_seconds(const std::vector<const Member*>& members) const;

  private:
    int jobs_;
    bool films_, measured_;
    MachineFigures machine_;
    double side_by_side_ = 1;  // speed of one of several jobs, divided by the speed of a job that runs alone
    std::vector<MemberEstimate> settings_;
};

}  // namespace grainreel
