#include "engine/files/frames/state_archive.hpp"

#include <algorithm>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/base/typed_time.hpp"

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

namespace {

std::vector<double> times_of(const std::vector<State>& moments) {
    std::vector<double> times;
    for (const State& moment : moments) times.push_back(moment.time);
    return times;
}

}  // namespace

double StateArchive::step_length() const {
    const State &one = moments().front(), &other = moments().back();
    const double steps = static_cast<double>(other.step - one.step);
    return steps > 0 && other.time > one.time ? (other.time - one.time) / steps : 0;
}

double StateArchive::room_beside(std::size_t index) const {
    return grainreel::room_beside(times_of(moments()), index, step_length());
}

double StateArchive::mean_interval() const {
    const std::vector<State>& all = moments();
    return all.size() < 2 ? 0 : (all.back().time - all.front().time) / static_cast<double>(all.size() - 1);
}

std::vector<std::size_t> StateArchive::between(std::optional<double> from, std::optional<double> to,
                                               std::int64_t every) const {
    std::vector<std::size_t> chosen;
    std::int64_t inside = 0;
    for (const std::size_t k : typed_span(times_of(moments()), step_length(), from, to))
        if (inside++ % every == 0) chosen.push_back(k);
    return chosen;
}

void StateArchive::check_time(const char* option, double time, double last, double slack) const {
    const double first = moments().front().time;
    if (std::isnan(first) || std::isnan(last))
        throw UserError("{}: the time of {} is not known; leave it out", option, path().string());
    if (!(time >= first - slack && time <= last + slack))
        throw UserError("{}: {:.6g} s is outside the run, which goes from {:.6g} to {:.6g} s", option, time,
                        first, last);
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
        if (!frame.shape.empty()) sorted.shape.push_back(frame.shape[i]);
    }
    return sorted;
}

}  // namespace grainreel
