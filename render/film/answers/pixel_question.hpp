// Which grain or wall is at a pixel of a film's picture.
#pragma once

#include "engine/questions/answer.hpp"
#include "engine/questions/ray.hpp"
#include "engine/questions/snapshot.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A moment as the scene's film shows it: its size, camera, cut, hidden species. Ghosts are seen through.
class PixelPicker {
  public:
    // film_time: s since the film's first frame: where a camera that moves is then. Snapshot and scene must
    // outlive this.
    PixelPicker(const Snapshot& snapshot, const FilmedScene& scene, double film_time);

    // The ray that a pixel looks along; x, y: of the picture, from its top left corner, a pixel's middle at
    // + 0.5. Throws UserError outside the part of the picture that shows the bed.
    Ray ray(double x, double y) const;
    // What is there, the nearest first; through: what lies behind, too. Throws as above.
    Answer at(double x, double y, bool through) const;

  private:
    const Snapshot& snapshot_;
    const FilmedScene& scene_;
    Frame shown_;
    View view_;
};

}  // namespace grainreel
