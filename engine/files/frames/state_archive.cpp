#include "engine/files/frames/state_archive.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

#include "engine/base/error.hpp"

namespace grainreel {

std::size_t StateArchive::nearest(double time) const {
    const std::vector<State>& all = moments();
    const auto after = std::lower_bound(all.begin(), all.end(), time, [](const State& moment, double wanted) {
        return moment.time < wanted;
    });
    const auto index = static_cast<std::size_t>(after - all.begin());
    if (index == 0) return 0;
    if (index == all.size()) return index - 1;
    return time - all[index - 1].time <= all[index].time - time ? index - 1 : index;
}

double StateArchive::mean_interval() const {
    const std::vector<State>& all = moments();
    return all.size() < 2 ? 0 : (all.back().time - all.front().time) / static_cast<double>(all.size() - 1);
}

std::vector<std::size_t> StateArchive::between(std::optional<double> from, std::optional<double> to,
                                               std::int64_t every) const {
    constexpr double hair = 1e-9;  // s: tolerance of times
    std::vector<std::size_t> chosen;
    std::int64_t inside = 0;
    for (std::size_t k = 0; k < moments().size(); ++k) {
        const double time = moments()[k].time;
        if (time < from.value_or(time) - hair || time > to.value_or(time) + hair) continue;
        if (inside++ % every == 0) chosen.push_back(k);
    }
    return chosen;
}

void StateArchive::check_time(const char* option, double time, double last, double slack) const {
    const double first = moments().front().time;
    if (std::isnan(first) || std::isnan(last))
        throw UserError(
            fmt::format("{}: the time of {} is not known; leave it out", option, path().string()));
    if (!(time >= first - slack && time <= last + slack))
        throw UserError(fmt::format("{}: {:.6g} s is outside the run, which goes from {:.6g} to {:.6g} s",
                                    option, time, first, last));
}

State StateArchive::first_whole() const {
    for (std::size_t i = 0; i + 1 < moments().size(); ++i) {
        try {
            return grains(i);
        } catch (const DamagedFrame&) {
            continue;  // the damage is reported when the frame is drawn
        }
    }
    return grains(moments().size() - 1);
}

State moment_of(const State& frame) {
    State moment;
    moment.step = frame.step;
    moment.time = frame.time;
    moment.cycles = frame.cycles;
    moment.phase = frame.phase;
    moment.bodies = frame.bodies;
    return moment;
}

State sorted_by_id(const State& frame) {
    std::vector<std::size_t> order(frame.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return frame.id[a] < frame.id[b]; });
    State sorted = moment_of(frame);
    for (const std::size_t i : order) {
        sorted.id.push_back(frame.id[i]);
        sorted.species.push_back(frame.species[i]);
        sorted.radius.push_back(frame.radius[i]);
        if (!frame.mass.empty()) sorted.mass.push_back(frame.mass[i]);
        sorted.position.push_back(frame.position[i]);
        sorted.velocity.push_back(frame.velocity[i]);
        sorted.spin.push_back(frame.spin[i]);
        if (!frame.orientation.empty()) sorted.orientation.push_back(frame.orientation[i]);
    }
    return sorted;
}

}  // namespace grainreel
