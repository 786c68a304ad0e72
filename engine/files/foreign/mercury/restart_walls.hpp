// Lines and walls of MercuryDPM's .restart. A line has keys with words after them: "position 0 0 1 radius
// 0.5".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

class RestartLine {
  public:
    explicit RestartLine(std::string_view line);

    // The words before the first number, "TSP BP".
    const std::string& first_word() const { return first_word_; }
    // The `count` numbers after a key, ignoring case; null where there are not that many. If a key comes
    // twice, the last one with so many numbers counts.
    const std::vector<double>* find(std::string_view key, std::size_t count) const;
    std::optional<double> number(std::string_view key) const;
    std::optional<Vec3> vector(std::string_view key) const;
    // The numbers after the first words.
    const std::vector<double>& first_numbers() const;

  private:
    std::string first_word_;
    std::vector<std::pair<std::string, std::vector<double>>> entries_;  // with keys in lower case
};

// The part of an infinite plane through `place` that lies in the box, whose edges are along the axes.
// `outwards` is the normal that points away from the grains; the front of the surface faces the other way. If
// the plane is outside the box, the box's cross-section, moved onto the plane. Empty where the normal has no
// length.
TriangleMesh plane_in_box(const Vec3& place, const Vec3& outwards, const WorldCell& box);

}  // namespace grainreel
