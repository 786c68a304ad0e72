// The picture of a moment with the answer to a question in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/questions/snapshot.hpp"
#include "engine/state/point_force.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/picture/marks/point_forces.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

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
