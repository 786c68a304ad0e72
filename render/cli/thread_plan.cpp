#include "render/cli/thread_plan.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace grainreel {

namespace {

int affinity() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;  // more than 1024 processors: nobody's laptop
    return std::max(1, CPU_COUNT(&set));
}

// Processors a cgroup allows, as a share of time; 0 when there is no limit. Version 2 writes "quota period"
// or "max period" in one file, version 1 uses two.
double cgroup_quota() {
    std::string quota;
    double period = 0;
    if (std::ifstream v2("/sys/fs/cgroup/cpu.max"); v2 >> quota >> period) {
        return quota == "max" || period <= 0 ? 0 : std::stod(quota) / period;
    }
    double microseconds = 0;
    std::ifstream v1_quota("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"),
        v1_period("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
    if (v1_quota >> microseconds && v1_period >> period && microseconds > 0 && period > 0)
        return microseconds / period;
    return 0;
}

}  // namespace

int available_processors() {
    const double quota = cgroup_quota();
    const int allowed = affinity();
    return quota > 0 ? std::clamp(static_cast<int>(std::ceil(quota)), 1, allowed) : allowed;
}

ThreadPlan plan_threads(int processors, bool film) {
    if (!film) return {processors, 1, 1};
    // On one or two processors the engine keeps its threads and the film's take turns with them; beyond, the
    // film gets processors of its own.
    const int share = std::max(1, processors / 6);
    return {processors <= 2 ? processors : processors - processors / 3, share, share};
}

}  // namespace grainreel
