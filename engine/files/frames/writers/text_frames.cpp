#include "engine/files/frames/writers/text_frames.hpp"

namespace grainreel {

WorldCell box_of(const World& world, const Frame& frame) {
    Vec3 low = Vec3::Constant(0), high = low;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 reach = frame.radius[i] * Vec3::Ones();
        low = i == 0 ? Vec3(frame.position[i] - reach) : Vec3(low.cwiseMin(frame.position[i] - reach));
        high = i == 0 ? Vec3(frame.position[i] + reach) : Vec3(high.cwiseMax(frame.position[i] + reach));
    }
    if (frame.size() == 0) high = Vec3::Ones();
    WorldCell box;
    box.origin = low;
    for (int axis = 0; axis < 3; ++axis)
        box.edges[static_cast<std::size_t>(axis)] = (high - low)[axis] * Vec3::Unit(axis);
    if (!world.cell) return box;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        if (!world.cell->periodic[edge]) continue;
        box.edges[edge] = world.cell->edges[edge];
        box.origin[static_cast<Eigen::Index>(edge)] = world.cell->origin[static_cast<Eigen::Index>(edge)];
        box.periodic[edge] = true;
    }
    return box;
}

std::string one_word(const std::string& name) {
    std::string word = name.empty() ? "grain" : name;
    for (char& c : word)
        if (static_cast<unsigned char>(c) <= ' ' || c == '"' || c == ',') c = '_';
    return word;
}

}  // namespace grainreel
