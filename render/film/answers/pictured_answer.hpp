// Which grain or wall is at a pixel of a film's picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/questions/answer.hpp"
#include "engine/questions/ray.hpp"
#include "engine/questions/snapshot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/picture/marks/force_marks.hpp"
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

// The picture of a moment with the answer to a question in it.

// What the picture points out.
struct AnswerMarks {
    std::vector<std::int32_t> grains;  // ids, rising: ringed, and all others are pale and seen through
    std::vector<PointForce> forces;    // arrows
    std::string words;                 // beside the grains; empty: those of the film
    bool lines = true;  // lines from these grains to those that they touch, where contacts are known
};

// As the scene's film would show the moment, with that in it. What the film takes from earlier moments and
// from measures is left out; a cut or a hidden species gives way where it would take away a grain of the
// answer. Throws UserError where the file is there already.
void draw_answer(const Snapshot& snapshot, const FilmedScene& scene, const AnswerMarks& marks,
                 double film_time, const std::filesystem::path& file, gl::Provider provider);

// The same mistakes, before anything is asked.
void check_picture_file(const std::filesystem::path& file);

}  // namespace grainreel
