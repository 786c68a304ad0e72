// The picture of a moment with the answer to a question in it.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/inspect/answer.hpp"
#include "engine/inspect/snapshot.hpp"
#include "render/gl/provider.hpp"

namespace grainreel {

// Ids that an answer names: of its tables' columns "id", and of contacts "first" and "second".
std::vector<std::int32_t> grains_in(const Answer& answer);

// As the scene's film would show the moment, with rings around these grains, the other ones seen through, and
// lines where something pushes them, as wide as it does, where forces are known. What the film takes from
// earlier moments and from measures is left out. Throws UserError where the file is there already.
void draw_answer(const Snapshot& snapshot, const std::vector<std::int32_t>& ids, double film_time,
                 const std::filesystem::path& file, gl::Provider provider);

// The same mistakes, before anything is asked.
void check_picture_file(const std::filesystem::path& file);

}  // namespace grainreel
