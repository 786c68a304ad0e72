// Films of one encoder, put one behind the other without encoding again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/film/codec/codec.hpp"

namespace grainreel {

struct FilmPiece {
    std::filesystem::path file;
    std::string name;         // for messages
    std::int64_t frames = 0;  // that it is to have
};

// What kept pieces from being joined: none, or asked to stop.
enum class JoinEnd { joined, stopped };

// Writes the pieces, in their order, as one film of so many frames a second, in the container of `codec`.
// `to` is replaced once all of it is there, and nothing else is left beside it. Every packet stays as it is
// but for its times. Throws UserError naming the piece that cannot be read, has other frames than it is to
// have or at other times, or is coded otherwise than the first one; RunError when writing fails. go_on: asked
// now and then; false: stop.
JoinEnd join_films(const std::vector<FilmPiece>& pieces, const Codec& codec, double rate,
                   const std::filesystem::path& to, const std::function<bool()>& go_on);

}  // namespace grainreel
