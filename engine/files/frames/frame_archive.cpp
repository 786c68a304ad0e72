#include "engine/files/frames/frame_archive.hpp"

#include <algorithm>

namespace grainreel {

std::vector<std::string> FrameSupply::lacks() const {
    std::vector<std::string> names;
    const auto add = [&](bool has, const char* name) {
        if (!has) names.emplace_back(name);
    };
    add(velocities, "velocities");
    add(spins, "spins");
    add(orientations, "orientations");
    add(contact_numbers, "contact numbers");
    add(contacts, "contacts");
    add(measures, "measures");
    return names;
}

std::size_t FrameArchive::nearest(double time) const {
    const std::vector<Frame>& all = moments();
    const auto after = std::lower_bound(all.begin(), all.end(), time, [](const Frame& moment, double wanted) {
        return moment.time < wanted;
    });
    const auto index = static_cast<std::size_t>(after - all.begin());
    if (index == 0) return 0;
    if (index == all.size()) return index - 1;
    return time - all[index - 1].time <= all[index].time - time ? index - 1 : index;
}

Frame FrameArchive::first_whole() const {
    for (std::size_t i = 0; i + 1 < moments().size(); ++i) {
        try {
            return grains(i);
        } catch (const DamagedFrame&) {
            continue;  // the damage is reported when the frame is drawn
        }
    }
    return grains(moments().size() - 1);
}

std::vector<std::size_t> FrameArchive::before(std::size_t index, double duration) const {
    constexpr double room = 1.001;
    const std::vector<Frame>& all = moments();
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < index; ++i)
        if (all[i].time >= all[index].time - room * duration) frames.push_back(i);
    return frames;
}

Frame moment_of(const Frame& frame) {
    Frame moment;
    moment.step = frame.step;
    moment.time = frame.time;
    moment.cycles = frame.cycles;
    moment.phase = frame.phase;
    moment.bodies = frame.bodies;
    return moment;
}

}  // namespace grainreel
