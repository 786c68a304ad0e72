#include "render/app/check/study_estimate.hpp"

#include <algorithm>
#include <functional>
#include <queue>

#include "render/app/check/check_parts.hpp"
#include "render/app/estimate/disk_estimate.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double usual_lattice = 1e7;  // grain-steps a second
// What the poster of a setting's first seed costs.
constexpr double poster_seconds = 0.5, poster_bytes = 0.5e6;

}  // namespace

void StudyEstimate::add_setting(const FilmedScene& scene, const Plan& plan) {
    const ThreadPlan threads{1, 1, 1, true};
    if (settings_.empty()) {
        machine_.lattice_one = machine_.lattice_team = usual_lattice;
        if (measured_) {
            // A team on all processors shares caches and clock rate as the members will.
            machine_ = machine_figures(scene, plan, {jobs_, 1, 1, true}, films_);
            const int team = std::min(jobs_, machine_.processors);
            side_by_side_ =
                std::clamp(machine_.lattice_team / (machine_.lattice_one * team), 0.3, 1.0) * team / jobs_;
        }
    }
    const std::vector<SegmentCount> film =
        films_ ? count_film(scene, plan.clock, plan.steps) : std::vector<SegmentCount>();
    MemberEstimate member;
    member.seconds = estimate_cost(scene, plan, film, threads, machine_).total_seconds / side_by_side_;
    member.bytes = estimate_disk(scene, plan, frames_of(film)).all();
    settings_.push_back(member);
}

MemberEstimate StudyEstimate::of(const Member& member) const {
    MemberEstimate estimate = settings_.at(member.setting);
    if (member.seed_index == 0) {
        estimate.seconds += poster_seconds;
        estimate.bytes += poster_bytes;
    }
    return estimate;
}

double StudyEstimate::wall_seconds(const std::vector<const Member*>& members) const {
    std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
    for (int job = 0; job < jobs_; ++job) free_at.push(0);
    double end = 0;
    for (const Member* member : members) {
        const double done = free_at.top() + of(*member).seconds;
        free_at.pop();
        free_at.push(done);
        end = std::max(end, done);
    }
    return end;
}

}  // namespace grainreel
