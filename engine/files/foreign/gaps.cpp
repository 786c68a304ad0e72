#include "engine/files/foreign/gaps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace grainreel {

void Gaps::add(const Gaps& other) {
    velocities += other.velocities;
    spins += other.spins;
    orientations += other.orientations;
    masses += other.masses;
    if (first < 0) first = other.first;
}

namespace {

// "1 mass is", "2 masses are".
std::string are(std::int64_t count, const char* one, const char* more) {
    return fmt::format("{} {}", count, count == 1 ? one : more);
}

}  // namespace

std::vector<std::string> Gaps::words(const std::string& name, const std::string& where) const {
    std::vector<std::string> unknown;
    if (velocities > 0) unknown.push_back(are(velocities, "velocity", "velocities"));
    if (spins > 0) unknown.push_back(are(spins, "spin", "spins"));
    std::vector<std::string> lines;
    if (!unknown.empty())
        lines.push_back(
            fmt::format("{}: {} {} no number, or none that a grain can have{}; what is not known stays so: "
                        "grey in films, "
                        "nan in exports, in no mean",
                        name, fmt::join(unknown, " and "), velocities + spins == 1 ? "is" : "are",
                        first < 0 ? "" : fmt::format(" (first: grain {} in {})", first, where)));
    if (masses > 0)
        lines.push_back(fmt::format("{}: {} no number above 0; the density of the species is taken", name,
                                    are(masses, "mass is", "masses are")));
    if (orientations > 0)
        lines.push_back(fmt::format("{}: {} no rotation; these grains are drawn as if they had not turned",
                                    name, are(orientations, "orientation is", "orientations are")));
    return lines;
}

}  // namespace grainreel
