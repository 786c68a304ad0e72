// Runs the program gnuplot, which draws the tables of charts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grainreel {

// Runs gnuplot on these commands, in this folder. Its words reach nobody. False when there is no gnuplot, or
// when it failed; the commands given to gnuplot by hand then tell why.
bool run_gnuplot(const std::filesystem::path& folder, std::string commands);

// Text as gnuplot reads it. It is in single quotes, where only a quote has a meaning; text with a quote is
// in double quotes. Control characters become spaces.
std::string gnuplot_text(const std::string& text);

// Breaks a text at spaces into lines of at most `most` characters; a longer word is cut. There is at least
// one line, which may be empty.
std::vector<std::string> wrapped(const std::string& text, std::size_t most);

// The text in such lines, as gnuplot reads them: it cuts off labels that are longer than the picture.
std::string gnuplot_lines(const std::string& text, std::size_t most);

}  // namespace grainreel
