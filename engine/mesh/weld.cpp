#include "engine/mesh/weld.hpp"

#include <array>
#include <cmath>

namespace grainreel {
namespace {

// Vertices by cells, hashed. A cell is eight reaches wide: most vertices look into one or two of them, and no
// cell can have many that are not joined.
class Cells {
  public:
    Cells(const Welding& welding, std::size_t count)
        : welding_(welding), width_(8 * welding.reach), next_(welding.vertices.size(), -1) {
        std::size_t size = 64;
        while (size < count + count / 2) size *= 2;
        heads_.assign(size, -1);
    }

    // The first vertex that this one can be joined with; -1: none.
    std::int32_t match(std::int32_t vertex) const {
        const Vec3& place = welding_.vertices[static_cast<std::size_t>(vertex)];
        std::array<std::int64_t, 3> low{}, high{};
        for (int k = 0; k < 3; ++k) {
            low[static_cast<std::size_t>(k)] = cell(place[k] - welding_.reach);
            high[static_cast<std::size_t>(k)] = cell(place[k] + welding_.reach);
        }
        std::int32_t found = -1;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    for (std::int32_t i = heads_[slot(x, y, z)]; i >= 0;
                         i = next_[static_cast<std::size_t>(i)])
                        if ((found < 0 || i < found) && fits(i, vertex)) found = i;
        return found;
    }

    void add(std::int32_t vertex) {
        const Vec3& place = welding_.vertices[static_cast<std::size_t>(vertex)];
        std::int32_t& head = heads_[slot(cell(place.x()), cell(place.y()), cell(place.z()))];
        next_[static_cast<std::size_t>(vertex)] = head;
        head = vertex;
    }

  private:
    std::int64_t cell(double x) const { return static_cast<std::int64_t>(std::floor(x / width_)); }

    std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
        std::uint64_t mixed = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u;
        mixed = (mixed ^ (mixed >> 29) ^ static_cast<std::uint64_t>(y)) * 0xbf58476d1ce4e5b9u;
        mixed = (mixed ^ (mixed >> 31) ^ static_cast<std::uint64_t>(z)) * 0x94d049bb133111ebu;
        return static_cast<std::size_t>(mixed ^ (mixed >> 30)) & (heads_.size() - 1);
    }

    bool fits(std::int32_t i, std::int32_t j) const {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        double reach = welding_.reach;
        if (!welding_.room.empty()) reach = std::min({reach, welding_.room[a], welding_.room[b]});
        return (welding_.vertices[a] - welding_.vertices[b]).squaredNorm() <= reach * reach;
    }

    const Welding& welding_;
    double width_;
    std::vector<std::int32_t> heads_, next_;
};

}  // namespace

std::vector<std::int32_t> joined(const Welding& welding, const std::vector<std::int32_t>& which) {
    std::vector<std::int32_t> place(welding.vertices.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<std::int32_t>(i);
    Cells cells(welding, which.size());
    for (const std::int32_t vertex : which) {
        const std::int32_t match = cells.match(vertex);
        if (match < 0)
            cells.add(vertex);
        else
            place[static_cast<std::size_t>(vertex)] = match;
    }
    return place;
}

std::int64_t replace_vertices(TriangleMesh& mesh, const std::vector<std::int32_t>& place_of) {
    std::int64_t gone = 0;
    for (std::size_t i = 0; i < place_of.size(); ++i) gone += place_of[i] != static_cast<std::int32_t>(i);
    if (gone == 0) return 0;
    for (TriangleMesh::Triangle& triangle : mesh.triangles)
        for (std::int32_t& corner : triangle) corner = place_of[static_cast<std::size_t>(corner)];
    return gone;
}

void drop_unused_vertices(TriangleMesh& mesh) {
    std::vector<std::int32_t> number(mesh.vertices.size(), -1);
    std::vector<Vec3> vertices;
    vertices.reserve(mesh.vertices.size());
    for (TriangleMesh::Triangle& triangle : mesh.triangles)
        for (std::int32_t& corner : triangle) {
            std::int32_t& now = number[static_cast<std::size_t>(corner)];
            if (now < 0) {
                now = static_cast<std::int32_t>(vertices.size());
                vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
            }
            corner = now;
        }
    mesh.vertices = std::move(vertices);
}

}  // namespace grainreel
