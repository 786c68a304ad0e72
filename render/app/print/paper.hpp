// Charts for print: the paper that gnuplot draws on.
//
// gnuplot draws the charts of studies and of `chart` already, so these are drawn by it too. Its commands stay
// beside each chart, and whoever needs other letters or other words changes them there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace grainreel {

struct Paper {
    std::vector<std::string> forms{"pdf"};  // pdf, svg, png
    double width_mm = 85;                   // a column of a journal
    double dpi = 300;                       // of png

    double height_mm() const;
};

// How many letters of 8 points fit on a line.
struct PaperLines {
    std::size_t across, upright, key, keys_a_line;
};
PaperLines lines_on(const Paper& paper);

// Commands for gnuplot, to be given before anything is plotted: encoding, frame, grid, places of names.
std::string paper_style();

// Draws a chart's files, STEM.pdf and so on, in `folder`. commands: what goes before `plot`. plots: what
// goes behind it. They stay as STEM.gp. Gives the files. Throws RunError without gnuplot.
std::vector<std::filesystem::path> draw_on_paper(const std::filesystem::path& folder, const std::string& stem,
                                                 const std::string& commands, const std::string& plots,
                                                 const Paper& paper);

// The width and height of an SVG file become mm, in the proportions that it has. Its letters may be of any
// font without serifs where theirs is missing. Throws RunError where the file is none of gnuplot's.
void say_size_in_mm(const std::filesystem::path& svg, double width_mm);

// A PNG file tells printers its pixels an inch (pHYs). Throws RunError as above.
void say_dots(const std::filesystem::path& png, double dpi);

}  // namespace grainreel
