#include "engine/questions/snapshot.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "engine/state/container_faces.hpp"

namespace grainreel {

bool Snapshot::has(Needs what) const {
    switch (what) {
        case Needs::contacts:
            return contacts;
        case Needs::forces:
            return forces.has_value();
        case Needs::period:
            return !frame.displacement.empty() || frame.size() == 0;
        case Needs::nothing:
            break;
    }
    return true;
}

double Snapshot::density(std::size_t i) const {
    return scene.species.at(static_cast<std::size_t>(frame.species[i])).density;
}

double Snapshot::mass(std::size_t i) const {
    return density(i) * 4.0 / 3.0 * std::numbers::pi * std::pow(frame.radius[i], 3);
}

double Snapshot::mean_diameter() const {
    double sum = 0;
    for (const double radius : frame.radius) sum += 2 * radius;
    return sum / static_cast<double>(frame.size());
}

double Snapshot::height(std::size_t i) const {
    return (frame.position[i] - frame.floor().place).z();
}

std::optional<std::size_t> Snapshot::place_of(std::int64_t id) const {
    const auto at = std::lower_bound(frame.id.begin(), frame.id.end(), id);
    if (at == frame.id.end() || *at != id) return std::nullopt;
    return static_cast<std::size_t>(at - frame.id.begin());
}

std::string name_of_body(const Snapshot& snapshot, std::int32_t id) {
    if (id >= 0) {
        const std::optional<std::size_t> place = snapshot.place_of(id);
        if (!place) return "unknown";
        return snapshot.scene.species.at(static_cast<std::size_t>(snapshot.frame.species[*place])).name;
    }
    const std::vector<Face> faces = faces_of(snapshot.scene);
    const auto face = static_cast<std::size_t>(-1 - static_cast<std::int64_t>(id));
    return face < faces.size() ? faces[face].name : fmt::format("wall {}", face);
}

}  // namespace grainreel
