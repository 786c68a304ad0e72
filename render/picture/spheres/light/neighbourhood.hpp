// Finds for each grain that is seen the grains near it, which take ambient light from it, and the grains
// between it and the key light, which throw shadows on it. The file is hot.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/spheres/light/lamp.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

namespace grainreel {

// Spheres in cells whose third axis points to the key light. The spheres near a grain, and those between it
// and the light, are both found along short rows of cells.
class LightGrid {
  public:
    // reach: how far from its surface a sphere must be found, in its radii.
    void fill(const std::vector<ViewSphere>& spheres, const Lamp& lamp, float reach);

    // Calls visit(index) for every sphere that may be within its own reach of `s`, also for `s` itself. visit
    // may be called more than once for a large sphere.
    template <class Visit>
    void around(const ViewSphere& s, const Visit& visit) const {
        const Place at = place(s);
        const float wide = s.radius + widest_;
        for (int u = cell(at[0] - wide, 0); u <= cell(at[0] + wide, 0); ++u)
            for (int v = cell(at[1] - wide, 1); v <= cell(at[1] + wide, 1); ++v)
                visit_row(u, v, cell(at[2] - wide, 2), cell(at[2] + wide, 2), visit);
    }

    // Calls visit(index) for spheres that may stand between `s` and the light, in layers of cells towards the
    // light, until enough() is true after a layer. beside: m, how far beside `s` they may stand.
    template <class Visit, class Enough>
    void towards_light(const ViewSphere& s, float beside, const Visit& visit, const Enough& enough) const {
        const Place at = place(s);
        const float wide = s.radius + beside + widest_small_;
        const int u0 = cell(at[0] - wide, 0), u1 = cell(at[0] + wide, 0);
        const int v0 = cell(at[1] - wide, 1), v1 = cell(at[1] + wide, 1);
        int top = -1;
        for (int u = u0; u <= u1; ++u)
            for (int v = v0; v <= v1; ++v) top = std::max(top, top_[column(u, v)]);
        for (int w = cell(at[2] - widest_small_, 2); w <= top && !enough(); ++w)
            for (int u = u0; u <= u1; ++u)
                for (int v = v0; v <= v1; ++v) visit_row(u, v, w, w, visit);
    }

    // m: the height along the direction of the key light.
    float height(const ViewSphere& s) const { return place(s)[2]; }

  private:
    using Place = std::array<float, 3>;
    Place place(const ViewSphere& s) const {
        Place p;
        for (int a = 0; a < 3; ++a) p[a] = axis_[a][0] * s.x + axis_[a][1] * s.y + axis_[a][2] * s.z;
        return p;
    }
    int cell(float coordinate, int axis) const {
        return static_cast<int>(
            std::clamp((coordinate - low_[axis]) * per_cell_, 0.0f, static_cast<float>(cells_[axis] - 1)));
    }
    std::size_t column(int u, int v) const { return static_cast<std::size_t>(u) * cells_[1] + v; }
    template <class Visit>
    void visit_row(int u, int v, int first, int last, const Visit& visit) const {
        const std::size_t row = column(u, v) * cells_[2];
        for (std::uint32_t k = start_[row + first]; k < start_[row + last + 1]; ++k) visit(item_[k]);
    }
    void set_axes(const Lamp& lamp);
    void set_cells(const std::vector<ViewSphere>& spheres, float reach);
    // Calls visit(cell) for the cells that a sphere is put into.
    template <class Visit>
    void for_cells(const ViewSphere& s, const Visit& visit) const;

    float axis_[3][3] = {};
    Place low_{};
    std::array<int, 3> cells_{1, 1, 1};
    float per_cell_ = 1;  // 1/m
    float reach_ = 0;
    float small_ = 0;         // m: radius up to which a sphere is put into the cell of its centre alone
    float widest_ = 0;        // m: how far from its centre such a sphere has to be found
    float widest_small_ = 0;  // m: the largest radius of these spheres
    std::vector<std::uint32_t> start_, item_;
    std::vector<int> top_;  // a column's last cell that holds something, or -1
};

// Finds occluders and casters of the grains that are seen.
class Neighbourhood {
  public:
    // shown: indices of the grains that are seen. Grains that are cut away take no light.
    void update(const std::vector<ViewSphere>& spheres, const Cut& cut, const Lamp& lamp,
                const std::vector<std::uint32_t>& shown, Team& team);

    // The grains that take light from shown[slot]: occluders around it, and casters towards the lamp.
    NeighbourSpan occluders(std::size_t slot) const { return span(occluders_[slot]); }
    NeighbourSpan casters(std::size_t slot) const { return span(casters_[slot]); }

    // A grain takes ambient light from others up to this distance from its surface, in its radii.
    static constexpr float kReach = 1.0f;

  private:
    struct Range {
        std::uint32_t pool = 0, count = 0;
        std::size_t first = 0;
    };
    struct Pool {
        std::vector<NearGrain> all;
        std::vector<std::uint32_t> found;
        std::vector<std::uint64_t> met_by;  // for each grain: number of the last search that met it
        std::uint64_t search = 0;
        void forget_met() { ++search; }
        bool has_met(std::uint32_t j) { return std::exchange(met_by[j], search) == search; }
    };
    NeighbourSpan span(const Range& range) const {
        return {pools_[range.pool].all.data() + range.first, static_cast<int>(range.count)};
    }
    void find_occluders(std::size_t slot, std::uint32_t pool);
    void find_casters(std::size_t slot, std::uint32_t pool);
    float weight(const ViewSphere& own, const ViewSphere& other) const;

    // The arguments of the update that is under way.
    const std::vector<ViewSphere>* spheres_ = nullptr;
    const std::vector<std::uint32_t>* shown_ = nullptr;
    Cut cut_;
    Lamp lamp_;

    LightGrid grid_;
    std::vector<Pool> pools_;  // one for each thread
    std::vector<Range> occluders_, casters_;
};

}  // namespace grainreel
