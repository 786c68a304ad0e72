// The container as a cut-away. Walls have a visible thickness. Walls that the eye sees from inside are solid
// and lie behind the grains; walls that it sees from outside are bare glass edges over the grains.
//
// The container is convex and the grains are inside. So what lies behind the grains is painted first, and
// what lies in front of them is painted after them. This keeps every edge smooth. WallOrder takes the painted
// faces and corrects the picture where grains reach through a wall or are outside.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/state/state.hpp"
#include "render/picture/base/canvas.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m: how thick walls, floor and lid are drawn.
double drawn_thickness(const Container& container);

// The walls on one side of the grains: as they are painted, and as faces in space.
struct WallSide {
    struct Face {
        std::vector<Vec3> corners;  // m, where it is now
        double alpha;
        Vec3 inward{0, 0, 0};  // unit, towards the grains; 0 for a face that grains do not darken
        double taken = 0;      // how much of its light others may take from it, 0 to 1
        int wall = 0;          // number of the wall that it belongs to; faces of a round wall have the same
        int container = 0;     // number of the container: walls of one darken each other where they meet
    };
    Shapes shapes;
    std::vector<Face> faces;
    int container = 0;  // the number that new faces get
    void clear() {
        shapes.clear();
        faces.clear();
        container = 0;
    }
};

struct ContainerShapes {
    // The walls behind the grains, which are painted first, and those in front of them, painted after.
    WallSide behind, before;
    Shapes over;  // painted over everything
};

// The camera's view before it follows the container (at_rest) and in the present frame (now). moves: whether
// the camera moves in the course of the film. clear: film.walls.glass = true.
struct Views {
    View at_rest, now;
    bool moves = false;
    bool clear = false;   // all walls are glass
    bool bright = false;  // inner walls stand out from a dark background, so that shadows are seen on them
};

// frame: the frame as it is shown, with the motion exaggerated. picture_height: pixels; decides how wide
// lines are.
void draw_container(const FilmedScene& scene, const Views& views, const State& frame, const Palette& palette,
                    int picture_height, ContainerShapes& shapes);

// m: the height at which a grain that falls below everything else leaves the run, by entering a box or by
// leaving one. Empty without boxes.
std::optional<double> exit_level(const FilmedScene& scene);

// Grains that leave the run below an outlet are gone from one frame to the next. So that they do not vanish
// in mid-air, they fade while they fall the last part of the way. This gives the strength of grains in each
// row of a port of this height, counted from the top, 0 to 255. It is empty if nothing fades: with a tray;
// without an outlet and without a box below all meshes through which grains leave; and if the eye looks down
// so steeply that rows with grains of the bed would fade too. meshes: m, their outermost points.
std::vector<std::uint32_t> exit_fade(const FilmedScene& scene, const View& view, int height,
                                     const std::vector<Vec3>& meshes = {});

}  // namespace grainreel
