// What gnuplot's files do not say by themselves: how large they are on paper.
#pragma once

#include <filesystem>

namespace grainreel {

// The width and height of an SVG file become mm, in the proportions that it has. Its letters may be of any
// font without serifs where theirs is missing. Throws RunError where the file is none of gnuplot's.
void say_size_in_mm(const std::filesystem::path& svg, double width_mm);

// A PNG file tells printers its pixels an inch (pHYs). Throws RunError as above.
void say_dots(const std::filesystem::path& png, double dpi);

}  // namespace grainreel
