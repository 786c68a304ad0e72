// Draws two layers of meshes: one is laid under the grains and one over them, so that each pixel has the
// right order.
//
// Solid triangles are drawn first, with four samples a pixel. Grains behind them are not drawn at all, since
// Visibility takes the depth of the solid triangles. Where the outlines of a grain and of a solid triangle
// meet, the share of the pixel that lies in front of the grain goes into the layer over the grains. Then
// glass is thinly laid over whatever is behind it, and lines are drawn along edges where no solid plane is in
// front of them. Threads work on bands of rows; the picture does not depend on the team's size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/mesh/mesh_projection.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/visibility.hpp"

namespace grainreel {

class MeshPainter {
  public:
    MeshPainter(int width, int height);

    // sRGB, 0 to 255.
    struct Inks {
        std::array<float, 3> glass{}, line{};
    };

    // Draws the solid triangles. Call draw_rest() after it.
    void draw_solid(const MeshProjection& meshes, const Sight& sight, Team& team);
    // m: z of the solid triangle in the middle of each pixel.
    SolidDepth depth() const { return {away_.data(), stride_}; }
    MeshPixels pixels(const MeshProjection& meshes) const {
        return {away_.data(), number_.data(), stride_, meshes.planes().data()};
    }
    // Darkens the solid triangles. Call it between draw_solid() and draw_rest().
    void darken(const WallLight& light, Team& team);
    // Draws what depends on the grains. seen: grains that were drawn with depth().
    void draw_rest(const MeshProjection& meshes, const Sight& sight, const Visibility& seen, const Inks& inks,
                   Team& team);

    // The layers under and over the grains.
    const Layer& behind() const { return behind_; }
    const Layer& before() const { return before_; }

  private:
    static constexpr int kBand = MeshProjection::kBand;
    // A pixel that shows two surfaces, one of which is nearer by a step: some samples see the nearer one, and
    // the others the farther one.
    struct Mixed {
        int x, y;
        std::uint32_t near, far;    // colours, multiplied by the share of the samples
        float near_away, far_away;  // m, z
    };
    // The columns in which something is drawn; the high end is excluded.
    struct Columns {
        int x0 = 0, x1 = 0;
        bool empty() const { return x0 >= x1; }
        void take(int low, int high) {
            *this = empty() ? Columns{low, high} : Columns{std::min(x0, low), std::max(x1, high)};
        }
    };
    struct BandState {
        Columns solid, over;  // columns that were drawn last
        std::vector<Mixed> mixed;
    };
    // The rows of the band on which one thread works.
    struct Worker {
        std::vector<float> near[kMeshSamples], near_middle;
        std::vector<std::uint32_t> colour[kMeshSamples];
        std::vector<std::uint32_t> row;
        std::vector<float> glass;
        std::vector<std::uint8_t> line_behind, line_before;
        std::vector<std::uint64_t> bits;
        std::vector<float> crossings;
        RowBits edges;
    };
    struct Job {
        const MeshProjection& meshes;
        const Sight& sight;
        const Visibility& seen;
        const Inks& inks;
    };

    void draw_solid_band(int band, const MeshProjection& meshes, const Sight& sight, Worker& worker);
    static void fill(const MeshSection& section, std::uint32_t colour, const MeshRows& rows, int y0, int y1,
                     std::vector<float>& crossings);
    void take_mixed(int y, const MeshRows& rows, const Columns& columns, const Sight& sight, float apart,
                    const Worker& worker, std::vector<Mixed>& mixed);
    void draw_rest_band(int band, const Job& job, Worker& worker);
    void draw_line(const ScreenLine& line, int y0, int y1, const Job& job, Worker& worker) const;
    bool hidden_by_solid(const Eigen::Vector3f& at, int x, int y, const Job& job) const;
    // m: z of the grain that is seen in a pixel, or else beside it; infinite where there is none.
    static float grain_depth(const Visibility& seen, int x, int y);
    void bring_forward(int y, const Job& job, Worker& worker, const Columns& columns);
    void split_mixed(const Mixed& pixel, const Visibility& seen, Worker& worker);
    void lay_glass_and_lines(int y, const Columns& columns, const Inks& inks, Worker& worker);
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x);
    }
    int bands() const { return (height_ + kBand - 1) / kBand; }

    const int width_, height_;
    const std::size_t stride_;
    Layer behind_, before_;
    std::vector<float> away_;            // rows of `stride_`
    std::vector<std::uint32_t> number_;  // number of the solid triangle seen in the pixel's middle, or 0
    std::vector<BandState> states_;
    std::vector<Worker> workers_;
};

}  // namespace grainreel
