// The program gnuplot, which draws our tables.
#pragma once

#include <filesystem>
#include <string>

namespace grainreel {

// Runs gnuplot on a file of commands, in its folder. False when there is no gnuplot, or it failed.
bool run_gnuplot(const std::filesystem::path& folder, std::string commands);

// Text as gnuplot takes it: in single quotes, in which nothing but a quote means anything. Control characters
// become spaces.
std::string gnuplot_text(const std::string& text);

// The same in lines of at most `most` characters, broken at spaces: gnuplot cuts off labels that are longer
// than the picture. A longer word is cut.
std::string gnuplot_lines(const std::string& text, std::size_t most);

}  // namespace grainreel
