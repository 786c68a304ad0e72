// Draws lit grains on a layer without a background. It first finds which grains are seen (Visibility), what
// walls hide of them (WallOrder) and which grains take light from which (Neighbourhood). Then it lights each
// pixel once, and a pixel on an edge once for each grain that shares it. Hot code.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/neighbourhood.hpp"
#include "render/picture/spheres/light/wall_light.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"
#include "render/picture/spheres/visibility.hpp"
#include "render/picture/spheres/wall_order.hpp"

namespace grainreel {

// What is drawn, with one entry for each grain. `poles` and `painted` may be empty, and so are `shapes` and
// `around` if all grains are spheres. Where they are not, `spheres` are what takes light from others: a ball
// inside each grain, and after them more balls inside of grains that are long or flat.
struct Spheres {
    std::vector<ViewSphere> spheres;
    std::vector<ViewShape> shapes;
    std::vector<ViewSphere> around;            // spheres around the shapes
    std::vector<std::array<float, 3>> albedo;  // linear
    std::vector<std::array<float, 3>> poles;   // unit: axes of two-tone grains, in view coordinates
    std::vector<std::uint8_t> painted;  // 0: the grain hides others and takes their light, but has no colour

    DrawnGrains drawn() const { return {shapes.empty() ? spheres : around, shapes}; }
};

struct PaintJob {
    const Sight& sight;
    const Cut& cut;
    const Lamp& lamp;
    const Spheres& spheres;
    const Visibility& visibility;
    const Neighbourhood& neighbourhood;
    const std::vector<std::uint32_t>& slot_of;
};

// Lights a few rows of the picture.
class BandPainter {
  public:
    // Lights rows y0 to y1 (excluded) of the layer.
    void paint(const PaintJob& job, int y0, int y1, Layer& layer);

  private:
    // Pixels of a row between two edges, which show one grain and nothing else.
    struct Run {
        std::uint32_t grain;
        int x, y, count;
    };
    // The part of a pixel that one grain takes.
    struct Part {
        std::uint32_t grain, pixel;  // indices of the grain and of the pixel in soft_
        float x, y, share;           // pixels
    };
    // A pixel put together from its parts.
    struct Soft {
        int x, y;
        float red = 0, green = 0, blue = 0, share = 0;
    };

    void paint_row(const PaintJob& job, int y, Layer& layer);
    void take_edge(const PaintJob& job, int x, int y);
    void settle_edges(const PaintJob& job);
    template <class Of, class Light>
    void for_each_grain(const PaintJob& job, const std::vector<Of>& all, std::vector<Of>& sorted,
                        const Light& light);
    void light_runs(const PaintJob& job, Layer& layer);
    void light_parts(const PaintJob& job);
    void add_parts(std::size_t begin, std::size_t end);
    void light(const PaintJob& job, std::uint32_t grain, const LitPoints& points);
    NeighbourSpan nearest(const PaintJob& job, const ViewSphere& own, const NeighbourSpan& all,
                          const LitPoints& points);
    void encode(Layer& layer) const;
    void make_room(std::size_t points);
    void pad(std::size_t points);

    RowBits edges_;
    std::vector<Run> runs_, sorted_runs_;
    std::vector<Part> parts_, sorted_;
    // count_: number of entries of each grain shown, 0 outside of for_each_grain(). met_: grains that have
    // entries.
    std::vector<std::uint32_t> count_, met_;
    std::vector<Soft> soft_;
    EdgeBlock block_;
    std::uint32_t block_who_[kCandidates][kPointBlock] = {};
    int block_x_[kPointBlock] = {}, block_y_[kPointBlock] = {};
    int block_size_ = 0;
    std::vector<float> x_, y_, red_, green_, blue_;
    std::vector<NearGrain> near_;
};

class SphereLayer {
  public:
    SphereLayer(int width, int height) : visibility_(width, height), layer_(width, height) {}

    // These are called in this order. The picture does not depend on the team's size.
    void find_visible(const Sight& sight, const Cut& cut, const Spheres& spheres, Team& team,
                      const SolidDepth& solid = {});
    // faces: in view coordinates.
    void find_order(const Sight& sight, const Cut& cut, const Spheres& spheres,
                    const std::vector<WallFace>& faces, Team& team);
    void find_neighbours(const Cut& cut, const Lamp& lamp, const Spheres& spheres, Team& team);
    const Layer& light(const Sight& sight, const Cut& cut, const Lamp& lamp, const Spheres& spheres,
                       Team& team);

    const Visibility& visibility() const { return visibility_; }
    const Neighbourhood& neighbourhood() const { return neighbourhood_; }
    const WallOrder& wall_order() const { return wall_order_; }
    LightTakers takers(const Sight& sight, const Cut& cut, const Lamp& lamp, const Spheres& spheres) const {
        return {sight, lamp, cut, spheres.spheres, neighbourhood_.grid(), visibility_};
    }

  private:
    Visibility visibility_;
    WallOrder wall_order_;
    Neighbourhood neighbourhood_;
    Layer layer_;
    std::vector<std::uint32_t> slot_of_;  // for each grain: its place among those shown
    std::vector<BandPainter> painters_;   // one for each thread
};

}  // namespace grainreel
