#include "engine/handover/decks/decks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace grainreel {

std::string deck_name(PeerEngine engine) {
    return fmt::format("in.{}", key_of(engine));
}

std::string dump_name(PeerEngine engine) {
    return fmt::format("{}.dump", key_of(engine));
}

std::string restart_name(PeerEngine engine) {
    return fmt::format("{}.restart", key_of(engine));
}

std::string restart_line(const CarriedScene& carried) {
    return fmt::format("restart {} {}.*", std::max<std::int64_t>(1000, (carried.last - carried.first) / 10),
                       restart_name(carried.engine));
}

std::string three(const Vec3& v) {
    return fmt::format("{} {} {}", v.x(), v.y(), v.z());
}

std::string processors_line(const CarriedScene& carried) {
    std::string line = "processors";
    for (const int ranks : carried.grid) line += ranks > 0 ? fmt::format(" {}", ranks) : " *";
    return line;
}

std::vector<std::string> variable_lines(const CarriedScene& carried) {
    std::vector<std::string> lines;
    const auto add = [&](const std::string& name, const std::string& expression) {
        lines.push_back(fmt::format("variable {} equal {}", name, expression));
    };
    bool turns = false;
    for (const TurnFormula& turn : carried.turns) turns |= !turn.empty();
    if (carried.drive.empty() && !turns) return lines;
    const std::int64_t shift = carried.shift();
    add("t", time_variable(shift).expression);
    const std::size_t count = carried.drive.variables.size();
    for (std::size_t i = 0; i < count; ++i) {
        const PeerVariable& one = carried.drive.variables[i];
        // The last three are the motion itself (DriveFormula). They are 0 while the grains are packed.
        const bool result = i + 3 >= count;
        add(one.name,
            shift > 0 && result ? fmt::format("(step>={})*({})", shift, one.expression) : one.expression);
    }
    for (std::size_t f = 0; f < carried.turns.size(); ++f) {
        if (carried.turns[f].empty()) continue;
        add(fmt::format("angle{}", f), carried.turns[f].angle);
        add(fmt::format("rate{}", f), carried.turns[f].rate);
    }
    return lines;
}

std::vector<std::string> gravity_lines(const CarriedScene& carried) {
    std::vector<std::string> lines;
    const Vec3& gravity = carried.scene.gravity;
    if (const double size = gravity.norm(); size > 0)
        lines.push_back(fmt::format("fix gravity all gravity {} vector {}", size, three(gravity / size)));
    if (carried.rides())
        lines.push_back(fmt::format("fix ride all gravity v_ride vector {}", three(carried.drive.direction)));
    return lines;
}

namespace {

// Counts the steps, from the first one on, that the engine would compute rightly from this series.
std::int64_t right_ones(const DumpPace& pace, const std::int64_t* steps) {
    for (std::int64_t k = 0; k < pace.count; ++k)
        if (pace.at(k) != steps[k] || pace.next(steps[k]) != steps[k + 1]) return k;
    return pace.count;
}

// The longest series from the first of `count` steps. It goes on as long as some distance `every` is
// possible: (d_k - 1/2) / k <= every < (d_k + 1/2) / k, where d_k is the number of steps from the first to
// the k-th.
DumpPace longest(const std::int64_t* steps, std::int64_t count) {
    DumpPace pace{*steps, static_cast<double>(steps[1] - steps[0]), 1};
    double low = 0, high = INFINITY;
    for (std::int64_t k = 1; k < count; ++k) {
        const auto d = static_cast<double>(steps[k] - steps[0]), n = static_cast<double>(k);
        low = std::max(low, (d - 0.5) / n);
        high = std::min(high, (d + 0.5) / n);
        if (!(low < high)) break;
        const double whole = std::round((low + high) / 2);
        const DumpPace more{*steps, whole >= low && whole < high ? whole : (low + high) / 2, k};
        if (more.every < 1) break;
        pace = more;
    }
    pace.count = right_ones(pace, steps);
    if (pace.count == 0) pace = {*steps, static_cast<double>(steps[1] - steps[0]), 1};
    return pace;
}

}  // namespace

std::int64_t DumpPace::at(std::int64_t k) const {
    return from + static_cast<std::int64_t>(std::floor(static_cast<double>(k) * every + 0.5));
}

std::int64_t DumpPace::next(std::int64_t step) const {
    const double k = std::ceil((static_cast<double>(step - from) + 0.5) / every);
    return from + static_cast<std::int64_t>(std::floor(k * every + 0.5));
}

std::string DumpPace::next_text(std::int64_t shift) const {
    return fmt::format("{}+floor(ceil((step-{}+0.5)/{})*{}+0.5)", from + shift, from + shift, every, every);
}

std::vector<DumpPace> dump_paces(const std::vector<std::int64_t>& steps) {
    std::vector<DumpPace> paces;
    const auto count = static_cast<std::int64_t>(steps.size());
    for (std::int64_t at = 0; at + 1 < count;) {
        paces.push_back(longest(steps.data() + at, count - at));
        at += paces.back().count;
    }
    return paces;
}

}  // namespace grainreel
