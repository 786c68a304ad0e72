// What an engine said when it failed, with the deck's line at which it did.
#pragma once

#include <filesystem>
#include <string>

namespace grainreel {

// "in.lammps:7: ERROR: Unrecognized pair style 'x' (at `pair_style x`)". output: the file of what it printed,
// its commands among it (-echo both). Empty where that has no error; a file that cannot be read has none.
std::string engine_error(const std::filesystem::path& output, const std::filesystem::path& deck);

}  // namespace grainreel
