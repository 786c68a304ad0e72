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
    // reach: how far from its surface a sphere can be found, in its radii.
    void fill(const std::vector<ViewSphere>& spheres, const Lamp& lamp, float reach);

    // Calls visit(index) for every sphere whose surface may be within `reach` of its radii of `s`, also for
    // `s` itself. reach: at most that of fill(). visit may be called more than once for a large sphere.
    template <class Visit>
    void around(const ViewSphere& s, float reach, const Visit& visit) const {
        const Place at = place(s);
        const float wide = s.radius + (1 + reach) * widest_small_;
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

    // Whether a sphere may be within its own reach of `s`.
    bool may_reach(const ViewSphere& s) const {
        return overlaps(place(s), s.radius + (1 + reach_) * widest_any_);
    }

    // Calls visit(index) for spheres that may stand between `s` and any part of the lamp, in layers of cells
    // towards it, until enough() is true after a layer. spread: tangent of half the angle of the lamp.
    template <class Visit, class Enough>
    void towards_lamp(const ViewSphere& s, float spread, const Visit& visit, const Enough& enough) const {
        const Place at = place(s);
        const float foot = at[2] - s.radius;
        for (int w = cell(foot - widest_small_, 2); w < cells_[2] && !enough(); ++w) {
            const float top = low_[2] + static_cast<float>(w + 1) / per_cell_;
            const float wide = s.radius + spread * std::max(top - foot, 0.0f);
            Place beside = at;
            beside[2] = top;
            if (!overlaps(beside, wide + widest_any_)) continue;
            const float look = wide + widest_small_;
            for (int u = cell(at[0] - look, 0); u <= cell(at[0] + look, 0); ++u)
                for (int v = cell(at[1] - look, 1); v <= cell(at[1] + look, 1); ++v)
                    if (top_[column(u, v)] >= w) visit_row(u, v, w, w, visit);
        }
    }
    bool empty() const { return start_.empty(); }
    void clear() { start_.clear(); }

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
    bool overlaps(const Place& at, float wide) const {
        for (int a = 0; a < 3; ++a)
            if (at[a] + wide < low_[a] || at[a] - wide > low_[a] + static_cast<float>(cells_[a]) / per_cell_)
                return false;
        return true;
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
    float widest_small_ = 0;  // m: the largest radius of these spheres
    float widest_any_ = 0;    // m: the largest radius of all
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
    // A wall gives ambient light to grains up to this distance from their surface.
    static constexpr float kWallReach = 2.0f;

    // All spheres. It is empty where nothing is seen or no light is taken.
    const LightGrid& grid() const { return grid_; }

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
