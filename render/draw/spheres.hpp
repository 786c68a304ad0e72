// From a frame's grains to a layer of lit spheres.
#pragma once

#include "engine/base/team.hpp"
#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "render/draw/grain_colours.hpp"
#include "render/draw/view.hpp"
#include "render/spheres/sphere_layer.hpp"

namespace grainreel {

class SpherePainter {
  public:
    // width, height: pixels of the port. threads: >= 1.
    SpherePainter(const Scene& scene, int width, int height, int threads);

    // See Renderer.
    void start_from(const Frame& frame) { grain_colours_.start_from(frame); }

    // One after the other.
    void take(const View& view, const Frame& frame);
    void find_visible();
    void find_neighbours();
    const Layer& light();

    Team& team() { return team_; }

  private:
    void open_bed(const View& view, const Frame& frame);
    void mark_rotation(const View& view, const Frame& frame);

    GrainColours grain_colours_;
    Team team_;
    SphereLayer layer_;
    Spheres spheres_;
    FilmLook look_;
    Sight sight_;
    Cut cut_;
    Lamp lamp_;
};

}  // namespace grainreel
