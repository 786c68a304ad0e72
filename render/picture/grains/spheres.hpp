// Paints the grains of a frame, and the grains glued to walls, as lit spheres: one layer of the picture.
#pragma once

#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/spheres/light/lamp.hpp"
#include "render/picture/spheres/light/sphere_layer.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The grains that are glued to walls. They are drawn in the colour of their species, but greyer.
class GluedSpheres {
  public:
    explicit GluedSpheres(const FilmedScene& scene);

    struct Seen {
        Vec3 centre;    // m, where it is now
        double radius;  // m
    };
    // The glued grains that are drawn. Those on the side walls (normal along y) are always drawn. Those on
    // any other wall are drawn only if the eye sees that wall from inside; else they would hide the bed.
    std::vector<Seen> seen(const View& view, const State& frame) const;
    const Albedo& colour() const { return colour_; }

  private:
    struct Glued {
        Vec3 at_rest;   // m
        Vec3 inward;    // unit vector into the container
        double radius;  // m
        std::size_t body;
        bool at_side;  // seen from everywhere
    };
    std::vector<Glued> glued_;
    Albedo colour_{};
};

// The light of a style: studio, flat or dark. colours_are_read: readers compare colours with a colour bar, so
// light and shade may not change them much.
Lamp lamp_of(const FilmLook& look, bool colours_are_read);

// Paints grains frame after frame. The renderer has one of these, and a second one if the film has ghosts:
// grains through which the others are seen.
class SpherePainter {
  public:
    // width, height: pixels of the part of the picture that shows the grains. If `ghosts` is true, it paints
    // only the grains of species that the scene shows as ghosts. If it is false, it paints all grains.
    SpherePainter(const FilmedScene& scene, int width, int height, Team& team, bool ghosts);

    // From the next take() on, a painter of ghosts paints all grains except these, whatever their species.
    // `ids` must rise. With an empty list the species decide again.
    void paint_all_but(const std::vector<std::int32_t>& ids) { not_painted_ = ids; }

    // Tells the film's first frame, from which colours by the height at the start are taken.
    void start_from(const State& frame) { grain_colours_.start_from(frame); }

    const ClippedCount& clipped() const { return grain_colours_.clipped(); }

    // For each frame these are called in this order: take(), find_visible(), find_order(), find_neighbours(),
    // light().
    void take(const View& view, const Shot& frame);
    void find_visible(const SolidDepth& solid = {});
    // The projection and the cutting planes of the frame that take() was given.
    const Sight& sight() const { return sight_; }
    const Cut& cut() const { return cut_; }
    const Visibility& visibility() const { return layer_.visibility(); }
    // walls: the walls as they were painted behind and in front of the grains.
    void find_order(const View& view, const ContainerShapes& walls);
    void find_neighbours();
    const Layer& light();
    // Light the walls behind the grains, and the solid meshes. Call them after find_neighbours().
    void light_walls(WallLight& walls, float corner_reach);
    void light_meshes(WallLight& walls, const MeshPixels& meshes);
    // Whether walls are darkened at all.
    bool takes_light() const { return lamp_.occlusion || lamp_.shadows; }
    double seen_share(std::size_t grain) const { return layer_.visibility().seen_share(grain); }
    // The pixels where a grain reaches through a wall. There, one layer of walls behind the grains and one in
    // front would hide the wrong things.
    const std::vector<WallPixel>& wall_pixels() const { return layer_.wall_order().pixels(); }

  private:
    void add_glued(const View& view, const State& frame);
    void open_bed(const View& view, const State& frame);
    void mark_rotation(const View& view, const State& frame);
    void mark_painted(const State& frame);

    GrainColours grain_colours_;
    GluedSpheres glued_;
    Team& team_;
    std::vector<std::uint8_t> painted_;      // for each species; empty: all are painted
    std::vector<std::int32_t> not_painted_;  // ids; empty: by species
    SphereLayer layer_;
    std::vector<WallFace> faces_;  // of the last find_order()
    Spheres spheres_;
    FilmLook look_;
    Sight sight_;
    Cut cut_;
    Lamp lamp_, wall_lamp_;
    const Vec3 up_;
};

}  // namespace grainreel
