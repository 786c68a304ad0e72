// Gives equal corners one number. STL names the corners of each triangle anew.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

class VertexPool {
  public:
    explicit VertexPool(std::size_t triangles) {
        vertices_.reserve(triangles / 2 + 4);
        std::size_t size = 64;
        while (size < triangles + triangles / 2) size *= 2;
        table_.assign(size, -1);
    }

    std::int32_t number_of(Vec3 place) {
        place += Vec3(0, 0, 0);  // -0 is 0
        std::size_t slot = hash(place) & (table_.size() - 1);
        while (table_[slot] >= 0) {
            if (vertices_[static_cast<std::size_t>(table_[slot])] == place) return table_[slot];
            slot = (slot + 1) & (table_.size() - 1);
        }
        const auto number = static_cast<std::int32_t>(vertices_.size());
        table_[slot] = number;
        vertices_.push_back(place);
        if (2 * vertices_.size() > table_.size()) grow();
        return number;
    }
    std::vector<Vec3>& vertices() { return vertices_; }

  private:
    static std::size_t hash(const Vec3& place) {
        std::uint64_t mixed = 0;
        for (int k = 0; k < 3; ++k) {
            mixed = (mixed ^ std::bit_cast<std::uint64_t>(place[k])) * 0x9e3779b97f4a7c15u;
            mixed ^= mixed >> 29;
        }
        mixed *= 0xbf58476d1ce4e5b9u;
        return static_cast<std::size_t>(mixed ^ (mixed >> 32));
    }

    void grow() {
        table_.assign(2 * table_.size(), -1);
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            std::size_t slot = hash(vertices_[i]) & (table_.size() - 1);
            while (table_[slot] >= 0) slot = (slot + 1) & (table_.size() - 1);
            table_[slot] = static_cast<std::int32_t>(i);
        }
    }

    std::vector<Vec3> vertices_;
    std::vector<std::int32_t> table_;  // open addressing; -1: free
};

}  // namespace grainreel
