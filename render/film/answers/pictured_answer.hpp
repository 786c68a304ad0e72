// Questions that need the film of a run: which grain or wall is at a pixel of its picture, and a picture of a
// moment with the answer in it. Both are shown as the film would show the moment.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/questions/answer.hpp"
#include "engine/questions/ray.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/picture/marks/force_marks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Finds what is at a pixel of a moment's picture. The picture has the film's size, camera, cut and hidden
// species; ghosts, which are seen through, do not count.
class PixelPicker {
  public:
    // film_time: s since the film's first frame; it decides where a moving camera stands. Snapshot and scene
    // must outlive this object.
    PixelPicker(const Snapshot& snapshot, const FilmedScene& scene, double film_time);

    // The ray through the middle of a pixel. x, y: its number, counted from 0 at the picture's top left
    // corner. Throws UserError for a place outside the part of the picture that shows the bed.
    Ray ray(double x, double y) const;
    // Tells what is at a pixel, the nearest thing first. With `through`, what lies behind it is told too.
    // Throws as ray() does.
    Answer at(double x, double y, bool through) const;

  private:
    const Snapshot& snapshot_;
    const FilmedScene& scene_;
    State shown_;
    View view_;
};

// What the picture of an answer points out.
struct AnswerMarks {
    // Ids, rising. These grains get a ring; all others become pale and transparent.
    std::vector<std::int32_t> grains;
    std::vector<PointForce> forces;  // drawn as arrows
    std::string words;               // words beside the grains; empty: the words of the film
    bool lines = true;  // lines from these grains to those that they touch, where contacts are known
};

// Draws the moment as the scene's film would show it, with the answer's marks. What the film takes from
// earlier moments and from measures is left out. A cut or a hidden species is not applied where it would
// remove a grain of the answer. Throws RunError when the file cannot be written.
void draw_answer(const Snapshot& snapshot, const FilmedScene& scene, const AnswerMarks& marks,
                 double film_time, const std::filesystem::path& file, gl::Provider provider);

// To be called before the question is answered. Throws UserError unless the file's name ends in .png, its
// folder exists and the file does not exist yet.
void check_picture_file(const std::filesystem::path& file);

}  // namespace grainreel
