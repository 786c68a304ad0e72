// Draws a chart for print with gnuplot: with the letters, lines and size that it has on paper.
//
// gnuplot draws the charts of studies and of the verb `chart` too, so the program needs only one such tool.
// The commands of each chart stay beside it, so that users can change letters or words there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace grainreel {

struct Paper {
    std::vector<std::string> forms{"pdf"};  // pdf, svg, png
    double width_mm = 85;                   // a column of a journal
    double dpi = 300;                       // dots an inch of png files
    std::string font = "DejaVu Sans";
    double letters = 8;  // height of letters, in points

    double height_mm() const;
};

// How many letters fit along the lower axis (across), along the upright axis, and into an entry
// of the key; and how many entries of the key stand in a row.
struct PaperLines {
    std::size_t across, upright, key, keys_a_line;
};
PaperLines lines_on(const Paper& paper);

// Commands that gnuplot needs before anything is plotted: encoding, frame, grid, places of names.
std::string paper_style();

// Draws a chart's files, STEM.pdf and so on, in `folder`. commands: gnuplot's commands before `plot`. plots:
// the arguments of `plot`. All commands stay in STEM.gp. Returns the files. Throws RunError when there is no
// gnuplot.
std::vector<std::filesystem::path> draw_on_paper(const std::filesystem::path& folder, const std::string& stem,
                                                 const std::string& commands, const std::string& plots,
                                                 const Paper& paper);

// Gives an SVG file a width and height in mm and keeps its proportions. Where its font is missing, any font
// without serifs may be used. Throws RunError when the file is not one of gnuplot's.
void say_size_in_mm(const std::filesystem::path& svg, double width_mm);

// Gives gnuplot's SVG file this title in place of "Gnuplot"; browsers and readers for the blind tell it.
void say_title(const std::filesystem::path& svg, const std::string& title);

// Makes a PNG file tell printers its pixels an inch (pHYs). Throws RunError like say_size_in_mm().
void say_dots(const std::filesystem::path& png, double dpi);

}  // namespace grainreel
