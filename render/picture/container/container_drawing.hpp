// The container as a cut-away: walls of visible thickness, behind the grains where the eye looks at their
// inner side and as bare glass edges over the grains where it looks at them from outside.
//
// The container is convex and the grains are inside: what lies behind the grains is painted before them, what
// lies in front after them, and every edge stays smooth. For grains that reach through a wall or are outside,
// WallOrder takes the painted faces and puts that right.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m: how thick walls, floor and lid are drawn.
double drawn_thickness(const Container& container);

// Walls on one side of the grains, as painted and as faces in space.
struct WallSide {
    struct Face {
        std::vector<Vec3> corners;  // m, where it is now
        double alpha;
    };
    Shapes shapes;
    std::vector<Face> faces;
    void clear() {
        shapes.clear();
        faces.clear();
    }
};

struct ContainerShapes {
    WallSide behind, before;  // to be painted before and after the grains
    Shapes over;              // over everything
};

// The camera, before it follows anything and now; `moves`: it does not stand all the film.
struct Views {
    View at_rest, now;
    bool moves = false;
};

// The frame as it is to be shown, with the motion exaggerated. picture_height: pixels; line widths follow
// from it.
void draw_container(const FilmedScene& scene, const Views& views, const Frame& frame, const Palette& palette,
                    int picture_height, ContainerShapes& shapes);

// Grains that leave the run below an outlet are gone from one frame to the next. So that they do not vanish
// in mid-air, they fade while they fall the last part of the way.

// m: the height at which a grain that falls below all else leaves, into a box or out of one. Empty without
// boxes.
std::optional<double> exit_level(const FilmedScene& scene);

// How strong grains are in each row of a port so high, counted from the top, 0 to 255. Empty where all
// are as they are: without an outlet or a box that they leave into or out of below a vessel, with a tray, and
// where the eye looks down so steeply that rows with grains of the bed would fade too. meshes: m, their
// outermost points.
std::vector<std::uint32_t> exit_fade(const FilmedScene& scene, const View& view, int height,
                                     const std::vector<Vec3>& meshes = {});

}  // namespace grainreel
