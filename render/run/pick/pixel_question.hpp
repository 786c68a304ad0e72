// Which grain or wall is at a pixel of a film's picture.
#pragma once

#include "engine/inspect/answer.hpp"
#include "engine/inspect/ray.hpp"
#include "engine/inspect/snapshot.hpp"

namespace grainreel {

struct PixelQuestion {
    double x = 0, y = 0;   // of the picture, from its top left corner; a pixel's middle is at + 0.5
    bool through = false;  // what lies behind, too
    double film_time = 0;  // s since the film's first frame: where a camera that moves is then
};

// The ray that a pixel of the film's picture looks along. Throws UserError outside the part that shows the
// bed.
Ray ray_of(const Snapshot& snapshot, const PixelQuestion& question);

// With the scene's film: its size, camera, cut, hidden species. Ghosts are seen through. Throws UserError
// outside the part of the picture that shows the bed.
Answer pixel_answer(const Snapshot& snapshot, const PixelQuestion& question);

}  // namespace grainreel
