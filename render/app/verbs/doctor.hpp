// What this machine has of the things that the program needs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grainreel {

struct Finding {
    std::string what;      // "OpenGL by OSMesa"
    std::string state;     // what was found, or why it was not
    bool good = true;      // it is there and enough
    bool needed = true;    // without it there are no films; otherwise something less is missing
    std::string remedy{};  // what to do when it is not good
};

// Each is found by using it: a context is made, an encoder is opened, a lattice is stepped.
std::vector<Finding> find_processors();  // number, vector instructions, speed
std::vector<Finding> find_drawing();     // OpenGL
std::vector<Finding> find_films();       // an encoder a format
std::vector<Finding> find_programs();    // gnuplot
std::vector<Finding> find_imports();
std::vector<Finding> find_packings();  // that runs have kept for later ones                               //
                                       // copies of other programs' files
std::vector<Finding> find_letters();   // scripts that words on films can have
std::vector<Finding> find_room(const std::filesystem::path& out);  // memory, and disk where films go

}  // namespace grainreel
