#include "engine/run/folder/segregation_text.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "engine/measure/segregation/big_and_small.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

namespace {

// Both indices are 0 when segregated and 1 when mixed. They disagree when they are so far apart.
constexpr double wide_apart = 0.25;

}  // namespace

std::string segregation_text(const Scene& scene, const Measures& from, const Measures& to,
                             const std::string& over) {
    const BigAndSmall kinds = big_and_small(scene.species);
    const std::string &big = scene.species[kinds.big].name, &small = scene.species[kinds.small].name;
    std::vector<std::string> parts;
    const auto say = [&](const std::string& what, const char* column, const char* meaning, bool sign) {
        const double first = from.at(column), last = to.at(column);
        if (!std::isfinite(first) || !std::isfinite(last)) return;
        const auto number = [&](double value) {
            return sign ? fmt::format("{:+.2f}", value) : fmt::format("{:.2f}", value);
        };
        parts.push_back(fmt::format("{} from {} to {}{}", what, number(first), number(last), meaning));
    };
    say(fmt::format("mean height of {} minus {}, over the bed's height,", big, small), "height_difference",
        "", true);
    say(fmt::format("probability that {} lies above {}", big, small), "big_above_small", " (1/2 is mixed)",
        false);
    say("unlike neighbours over chance", "unlike_neighbours", " (1 is mixed)", false);
    say("Lacey mixing index", "lacey", " (1 is mixed)", false);
    if (parts.empty()) return "";
    const bool differ = std::abs(to.at("unlike_neighbours") - to.at("lacey")) > wide_apart;
    return fmt::format("segregation, from the start to the mean over {}: {}{}", over, fmt::join(parts, "; "),
                       differ ? "; neighbours and samples of 32 grains disagree on how mixed it is" : "");
}

}  // namespace grainreel
