// The parts of a film (render --part), put together as one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/run/folder/listener.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

struct JoinRequest {
    std::vector<std::filesystem::path> parts;  // folders, in any order
    std::filesystem::path out;                 // the film's file
    bool force = false;                        // a file of that name is replaced
};

// Joins the parts into one film, which has the bytes of the same film drawn in one go with --parts. False
// when asked to stop. Throws UserError with one line where parts are missing, doubled, of another run, drawn
// or encoded otherwise, incomplete or damaged; RunError when the film cannot be written. In all these cases
// nothing has the film's name that had not before.
bool join_parts(const JoinRequest& request, RunListener& listener);

// Whether parts in that format can be joined to such a file. Throws UserError where it is in the way, or has
// another ending.
void check_joined(const std::filesystem::path& film, FilmFormat format, bool force);

}  // namespace grainreel
