// Finds how much grains darken the walls that they lie on or throw their shadow on, and how much walls darken
// each other where they meet: a share of its colour for each pixel that shows a wall. Hot code.
//
// A pixel's place in space is known from its plane, so it is lit with the formulas of the grains and with the
// grid of the grains. No map lies between, whose cells one could see.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/neighbourhood.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"
#include "render/picture/spheres/visibility.hpp"
#include "render/picture/spheres/wall_order.hpp"

namespace grainreel {

// The plane of a solid triangle, in view coordinates (m), with its unit normal towards the eye.
struct SurfacePlane {
    Eigen::Vector3f normal;
    float distance;
};

// What meshes show in the middle of each pixel, in rows of `stride` numbers.
struct MeshPixels {
    const float* away;            // m, z
    const std::uint32_t* number;  // of the plane, from 1 on; 0 where there is no mesh
    std::size_t stride;
    const SurfacePlane* planes;
};

// The grains that take light, as they were drawn.
struct LightTakers {
    const Sight& sight;
    const Lamp& lamp;
    const Cut& cut;
    const std::vector<ViewSphere>& spheres;
    const LightGrid& grid;
    const Visibility& seen;
};

class WallLight {
  public:
    WallLight(int width, int height);

    // Lights the inner faces among the walls behind the grains. faces: in view coordinates, in the order in
    // which they are painted. corner_reach: m, how far walls darken each other. The result does not depend on
    // the team's size.
    void light_faces(const LightTakers& by, const std::vector<WallFace>& faces, float corner_reach,
                     Team& team);
    void light_meshes(const LightTakers& by, const MeshPixels& meshes, Team& team);

    // Darkens a row of pixels. Their alpha stays, so that what is transparent stays so.
    void darken(int y, std::uint32_t* pixels) const;
    // 255 where nothing is taken.
    const std::uint8_t* row(int y) const { return shares_.data() + static_cast<std::size_t>(y) * width_; }

  private:
    static constexpr int kTile = kWallRow;
    struct Face {
        SurfacePlane plane;  // normal towards the grains
        float taken, tone, wall, container, opacity;
        std::vector<Eigen::Vector2d> outline;  // pixels
        int y0, y1;
    };
    // One thread's rows of a tile, and the grains near it.
    struct Worker {
        std::array<WallRow, kTile> rows;
        std::uint32_t any = 0;  // rows that show a wall, as bits
        std::vector<NearGrain> occluders, casters;
        std::vector<CornerPlane> corners;
        std::vector<std::uint64_t> met_by;  // for each grain: number of the last search that met it
        std::uint64_t search = 0;
        float container_low, container_high;  // the numbers of the containers that the tile shows
    };
    // The faces that pixels show, from 1 on, or 0; and how much of them is bare of what is painted later.
    struct Numbers {
        std::vector<std::uint16_t> face;
        std::vector<std::uint8_t> bare;
        std::vector<std::uint16_t> shown;  // of each tile: the rows in which there is a face, as bits
    };
    struct Job {
        const LightTakers& by;
        float corner_reach;
    };

    template <class Shows, class Fill>
    void light(const Job& job, int layers, Team& team, const Shows& shows, const Fill& fill);
    void set_faces(const Sight& sight, const Lamp& lamp, const std::vector<WallFace>& faces);
    int tiles_across() const { return (width_ + kTile - 1) / kTile; }
    std::size_t tile_of(int x, int y) const {
        return static_cast<std::size_t>(y / kTile * tiles_across() + x / kTile);
    }
    void number_row(int y);
    void number_band(int y0);
    void fill_from_faces(const Numbers& numbers, const Sight& sight, int x, int y, WallRow& row) const;
    void light_tile(const Job& job, int x, int y0, int rows, bool first, Worker& worker);
    static ViewSphere around(const Sight& sight, Worker& worker, int rows);
    static bool outside(const NearGrain& near, const Worker& worker);
    static void find_occluders(const LightTakers& by, const ViewSphere& tile, Worker& worker);
    static void find_casters(const LightTakers& by, const ViewSphere& tile, Worker& worker);
    std::uint32_t bare_rows(const Visibility& seen, int x, int y, int rows, int count) const;

    const int width_, height_;
    std::vector<WallFace> last_;
    Sight last_sight_;
    std::vector<Face> faces_;
    std::vector<CornerPlane> corners_;  // sorted by container and wall
    // The upper face of each pixel, and the one below it while the upper one is not wholly there.
    std::array<Numbers, 2> numbers_;
    std::vector<std::uint8_t> shares_;
    std::vector<Layer::Span> spans_;  // pixels of a row that may be darkened
    std::vector<Worker> workers_;
};

}  // namespace grainreel
