#include "engine/questions/grain_columns.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

// Numbers of these columns: that of any wall, then those of species and walls; of a grain -2 - id.
constexpr int kAnyWall = 100'000, kFirstSpecies = kAnyWall + 1, kFirstWall = 2 * kAnyWall, kFirstId = -2;

std::string spaced(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

// Whether the grain that a touch is with, or the wall, is the one that is meant.
bool is_meant(const Snapshot& s, int number, std::int32_t other) {
    if (number <= kFirstId) return other == kFirstId - number;
    if (number == kAnyWall) return other < 0;
    if (number >= kFirstWall) return other == -1 - (number - kFirstWall);
    const auto place = other >= 0 ? s.place_of(other) : std::nullopt;
    return place && s.frame.species[*place] == number - kFirstSpecies;
}

}  // namespace

int touches_column(const Snapshot& snapshot, std::string_view who) {
    if (!snapshot.has(Needs::contacts))
        throw UserError(
            "'touches' needs contacts, and the run kept none; run it with output.contacts = true");
    const std::string name(who);
    std::int32_t id = 0;
    const auto [end, failure] = std::from_chars(who.data(), who.data() + who.size(), id);
    if (failure == std::errc() && end == who.data() + who.size() && id >= 0) {
        if (!snapshot.place_of(id)) throw UserError(fmt::format("touches: no grain has the id {}", id));
        return kFirstId - id;
    }
    const auto& species = snapshot.scene.species;
    for (std::size_t k = 0; k < species.size(); ++k)
        if (species[k].name == name) return kFirstSpecies + static_cast<int>(k);
    if (name == "wall") return kAnyWall;
    const std::vector<std::string> walls = wall_names(snapshot.scene);
    for (std::size_t k = 0; k < walls.size(); ++k)
        if (spaced(walls[k]) == spaced(name)) return kFirstWall + static_cast<int>(k);
    std::vector<std::string> all{"wall"};
    for (const Species& one : species) all.push_back(one.name);
    all.insert(all.end(), walls.begin(), walls.end());
    throw UserError(fmt::format("touches: '{}' is no species, no wall and no id of a grain; there are {}",
                                excerpt(name), fmt::join(all, ", ")));
}

bool is_touches_column(int number) {
    return number >= kAnyWall || number <= kFirstId;
}

std::vector<double> values_of_touches(const Snapshot& s, int number, const GrainList& grains) {
    std::vector<double> found(s.frame.size(), 0), values;
    const auto note = [&](std::int32_t one, std::int32_t other) {
        if (one < 0 || !is_meant(s, number, other)) return;
        if (const auto place = s.place_of(one)) found[*place] = 1;
    };
    for (const Touch& touch : s.frame.touches) {
        note(touch.first, touch.second);
        note(touch.second, touch.first);
    }
    for (const std::size_t i : grains) values.push_back(found[i]);
    return values;
}

}  // namespace grainreel
