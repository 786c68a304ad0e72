#include "engine/mesh/winding.hpp"

#include <algorithm>
#include <vector>

#include "engine/mesh/mesh_edges.hpp"

namespace grainreel {
namespace {

std::size_t index(std::int32_t i) {
    return static_cast<std::size_t>(i);
}

// A patch is a set of triangles connected by edges that have exactly two triangles.
struct Patch {
    std::vector<std::int32_t> triangles;
    std::int64_t turned = 0;
    bool closed = true, orientable = true;
};

class Winder {
  public:
    explicit Winder(TriangleMesh& mesh)
        : mesh_(mesh),
          opposite_(3 * mesh.triangles.size(), -1),
          patch_of_(mesh.triangles.size(), -1),
          turned_(mesh.triangles.size(), 0) {}

    Winding run() {
        const EdgeTable edges(mesh_);
        pair_up(edges);
        std::int32_t patches = 0;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            if (patch_of_[t] < 0) settle(flood(static_cast<std::int32_t>(t), patches++));
        result_.solids = patches - joined_by_crowded_edges(edges, patches);
        return result_;
    }

  private:
    void pair_up(const EdgeTable& edges) {
        edges.each([&](std::int32_t, std::span<const EdgeSide> sides) {
            result_.open_edges += sides.size() == 1;
            result_.crowded_edges += sides.size() > 2;
            if (sides.size() != 2) return;
            opposite_[index(sides[0].side)] = sides[1].side;
            opposite_[index(sides[1].side)] = sides[0].side;
        });
    }

    Patch flood(std::int32_t seed, std::int32_t number) {
        Patch patch;
        patch.triangles.push_back(seed);
        patch_of_[index(seed)] = number;
        for (std::size_t next = 0; next < patch.triangles.size(); ++next) {
            const std::int32_t t = patch.triangles[next];
            patch.turned += turned_[index(t)];
            for (std::int32_t side = 3 * t; side < 3 * t + 3; ++side) {
                const std::int32_t other = opposite_[index(side)];
                if (other < 0) {
                    patch.closed = false;
                    continue;
                }
                const char turned = turned_[index(t)] ^ char(begin_of(mesh_, side) == begin_of(mesh_, other));
                const std::size_t there = index(other / 3);
                if (patch_of_[there] >= 0) {
                    patch.orientable = patch.orientable && turned_[there] == turned;
                    continue;
                }
                patch_of_[there] = number;
                turned_[there] = turned;
                patch.triangles.push_back(other / 3);
            }
        }
        return patch;
    }

    void settle(const Patch& patch) {
        if (!patch.orientable || patch.turned == 0) return;
        const auto count = static_cast<std::int64_t>(patch.triangles.size());
        const bool useless = 4 * std::min(patch.turned, count - patch.turned) > count;
        const char wanted =
            patch.closed && useless ? char(six_volumes(patch) > 0) : char(2 * patch.turned <= count);
        for (const std::int32_t t : patch.triangles)
            if (turned_[index(t)] == wanted) {
                std::swap(mesh_.triangles[index(t)][1], mesh_.triangles[index(t)][2]);
                ++result_.flipped;
            }
    }

    // Six times the volume inside, with the triangles turned as the flood fill has found. It is negative if
    // they face inwards.
    double six_volumes(const Patch& patch) const {
        const Vec3& origin = mesh_.vertices[index(mesh_.triangles[index(patch.triangles[0])][0])];
        double sum = 0;
        for (const std::int32_t t : patch.triangles) {
            const TriangleMesh::Triangle& corners = mesh_.triangles[index(t)];
            const Vec3 a = mesh_.vertices[index(corners[0])] - origin,
                       b = mesh_.vertices[index(corners[1])] - origin,
                       c = mesh_.vertices[index(corners[2])] - origin;
            sum += (turned_[index(t)] ? -1 : 1) * a.dot(b.cross(c));
        }
        return sum;
    }

    std::int32_t joined_by_crowded_edges(const EdgeTable& edges, std::int32_t patches) {
        if (result_.crowded_edges == 0) return 0;
        DisjointSets sets(index(patches));
        std::int32_t joins = 0;
        edges.each([&](std::int32_t, std::span<const EdgeSide> sides) {
            for (std::size_t i = 1; sides.size() > 2 && i < sides.size(); ++i)
                joins += sets.join(patch_of_[index(sides[0].side / 3)], patch_of_[index(sides[i].side / 3)]);
        });
        return joins;
    }

    TriangleMesh& mesh_;
    Winding result_;
    std::vector<std::int32_t>
        opposite_;  // the opposite side of each side; -1 if the edge does not have two triangles
    std::vector<std::int32_t> patch_of_;
    std::vector<char> turned_;  // whether a triangle is turned relative to the first triangle of its patch
};

}  // namespace

Winding wind_alike(TriangleMesh& mesh) {
    return Winder(mesh).run();
}

}  // namespace grainreel
