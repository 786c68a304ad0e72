// A line of MercuryDPM's .restart: keys, each with the words behind it, "position 0 0 1 radius 0.5".
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

    // The words before the first number: "TSP BP".
    const std::string& first_word() const { return first_word_; }
    // The numbers behind a key, without regard to case; of doubled keys those of the last that has `count`.
    // Null where there is none of that many.
    const std::vector<double>* find(std::string_view key, std::size_t count) const;
    std::optional<double> number(std::string_view key) const;
    std::optional<Vec3> vector(std::string_view key) const;
    // The numbers that stand behind the first words.
    const std::vector<double>& first_numbers() const;

  private:
    std::string first_word_;
    std::vector<std::pair<std::string, std::vector<double>>> entries_;  // keys in small letters
};

// Infinite walls as far as they can be drawn: cut to the box.

// The part of the plane through `place` that lies in the box, whose edges are along the axes. `outwards` is
// its normal, away from the grains; the surface looks the other way. Of a plane beside the box as much as the
// box has before it; empty where the normal is none.
TriangleMesh plane_in_box(const Vec3& place, const Vec3& outwards, const WorldCell& box);

}  // namespace grainreel
