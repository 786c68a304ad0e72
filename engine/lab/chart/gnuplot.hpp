// The program gnuplot, which draws our tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grainreel {

// Runs gnuplot on a file of commands, in its folder. False when there is no gnuplot, or it failed.
bool run_gnuplot(const std::filesystem::path& folder, std::string commands);

// Text as gnuplot takes it: in single quotes, in which nothing but a quote means anything; with a quote in
// double ones. Control characters become spaces.
std::string gnuplot_text(const std::string& text);

// Lines of at most `most` characters, broken at spaces; a longer word is cut. One at least, which may be
// empty.
std::vector<std::string> wrapped(const std::string& text, std::size_t most);

// These lines as gnuplot takes them: it cuts off labels that are longer than the picture.
std::string gnuplot_lines(const std::string& text, std::size_t most);

}  // namespace grainreel
