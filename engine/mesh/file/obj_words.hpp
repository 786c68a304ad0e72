// The words with which a line of an OBJ file can begin.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace grainreel {

inline bool is_obj_word(std::string_view word) {
    static constexpr std::array<std::string_view, 42> words{
        "v",     "vt",    "vn",   "vp",     "f",        "fo",       "l",      "p",          "g",
        "o",     "s",     "mg",   "mtllib", "usemtl",   "usemap",   "maplib", "cstype",     "deg",
        "bmat",  "step",  "curv", "curv2",  "surf",     "parm",     "trim",   "hole",       "scrv",
        "sp",    "end",   "con",  "bevel",  "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj",
        "ctech", "stech", "call", "csh",    "bsp",      "bzp"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace grainreel
