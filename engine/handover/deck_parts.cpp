#include "engine/handover/deck_parts.hpp"

#include <algorithm>

#include <fmt/format.h>

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
        // Nothing moves while the grains are packed.
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

}  // namespace grainreel
