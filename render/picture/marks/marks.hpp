// What is drawn over the grains, and the legend that explains it: a field, lines of force, trails, arrows and
// streamlines of the flow, forces on walls, and rings around chosen grains. A new kind of mark is drawn in
// Marks::draw() and explained in marks_block().
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "render/picture/base/canvas.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/marks/field_marks.hpp"
#include "render/picture/marks/force_marks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The paths of chosen grains through the last frames.
class Trails {
  public:
    explicit Trails(const FilmedScene& scene);

    // Takes frames in the order of time. A frame that is taken again adds nothing, and an earlier one starts
    // the trails anew.
    void take(const State& frame);

    struct Point {
        double age;  // 0: now, 1: as old as trails get
        Vec3 at;     // m
    };
    // The path of each grain, with the newest point first; with a drive, without the shaking. A path ends
    // where a grain left through a periodic wall and came back at the opposite one.
    std::vector<std::vector<Point>> paths() const;

  private:
    struct PastFrame {
        double time;
        std::vector<std::int32_t> id;  // rising
        std::vector<Vec3> at;
    };
    bool chosen(std::int32_t id, std::int32_t species) const;

    std::vector<bool> species_;
    std::vector<std::int32_t> grains_;
    double duration_, smoothing_, longest_jump_;  // s, s, m; smoothing_ 0: as it was
    std::deque<PastFrame> past_;                  // the newest first
};

bool has_marks(const FilmShows& look);
// N: from this force on, the line of a contact has its full width.
double widest_force(const FilmedScene& scene);
// Pixels: the full width of a contact's line.
double widest_line(int picture_height);

class Marks {
  public:
    Marks(const FilmedScene& scene, const Palette& palette);

    // See Renderer::start_from().
    void start_from(const State& frame);
    // Takes a frame that is not drawn but belongs to the trails.
    void remember(const State& frame);
    // Tells which share of a grain of the frame is seen.
    using SeenShare = std::function<double(std::size_t grain)>;
    // Adds the marks to the shapes that are painted after the grains. Frames come in the order of time.
    void draw(const View& view, const Shot& frame, const SeenShare& seen, Shapes& on);
    // How many of the field's cells lie beyond the ends of the colour bar.
    ClippedCount clipped() const { return field_ ? field_->clipped() : ClippedCount(); }

  private:
    void draw_chains(const View& view, const Shot& frame, Shapes& on) const;
    void draw_trails(const View& view, Shapes& on) const;
    void draw_rings(const View& view, const Shot& frame, const SeenShare& seen, Shapes& on);
    void draw_ring(const View& view, const Vec3& at, double radius, double strength, Shapes& on) const;
    // Draws a line on a wider one of the background's colour, so that it can be seen on any grain.
    void outlined(Shapes& on, const std::vector<Pixel>& points, bool closed, double width,
                  const Colour& colour, double strength = 1) const;

    const FilmedScene& scene_;
    const Palette palette_;
    const double pen_;  // pixels
    std::optional<FieldLayer> field_;
    FlowMarks flow_;
    std::optional<WallForceMarks> wall_forces_;
    Trails trails_;
    Quantities condition_;  // the quantity by which grains are ringed
};

}  // namespace grainreel
