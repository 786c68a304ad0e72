#include "render/picture/container/container_drawing.hpp"

#include <cmath>
#include <numbers>

#include "render/picture/container/drawing_kit.hpp"
#include "render/picture/container/lab_marks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// degrees, also of a camera that looks straight down
double azimuth_of(const View& view) {
    return std::atan2(-view.right.x(), view.right.y()) * 180 / std::numbers::pi;
}

}  // namespace

double drawn_thickness(const Container& container) {
    return 0.018 * (2 * container.half_width + container.height);
}

namespace {

void draw_ghost(const FilmedScene& scene, const Sketch& lab, Shapes& on) {
    for (const FreeWall& wall : scene.walls)
        if (wall.moves) draw_free_wall_ghost(wall, scene, lab, on);
    const bool floor_only = scene.drive.moves == Drive::Moves::floor;
    if (scene.container.shape == Container::Shape::cylinder)
        draw_cylinder_ghost(scene.container, floor_only, lab, on);
    else if (is_prism(scene.container))
        draw_prism_ghost(scene.container, floor_only, lab, on);
}

void draw_at(const Container& container, const Sketches& sketches, ContainerShapes& shapes) {
    if (container.shape == Container::Shape::cylinder)
        draw_cylinder(container, sketches, shapes);
    else if (is_prism(container))
        draw_prism(container, sketches, shapes);
}

}  // namespace

void draw_container(const FilmedScene& scene, const Views& views, const Frame& frame, const Palette& palette,
                    int picture_height, ContainerShapes& shapes) {
    shapes.behind.clear();
    shapes.before.clear();
    shapes.over.clear();
    const Sketches sketches{{views, palette, picture_height, frame.container()},
                            {views, palette, picture_height, frame.floor()},
                            {views, palette, picture_height, BodyPose()}};
    if (scene.container.tray) {
        BodyPose place;
        place.place.z() = -scene.container.tray->depth;
        const Sketch below{views, palette, picture_height, place};
        draw_at(tray_container(scene), {below, below, below}, shapes);
    }
    draw_at(container_at(scene.container, frame.time), sketches, shapes);
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {  // inside, so over the container's far walls
        const BodyPose pose = frame.body(kFirstPlaneBody + w);
        draw_free_wall(scene.walls[w], scene, {views, palette, picture_height, pose}, shapes);
    }
    draw_lab_marks(scene, sketches, azimuth_of(views.at_rest), shapes.behind);
    if (scene.film.wall_ghost) draw_ghost(scene, sketches.lab, shapes.over);
}

}  // namespace grainreel
