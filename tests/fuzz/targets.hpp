// Readers that are given damaged input, by name. Each attempt reads what it is given as far as a user could
// make the program read it. It catches what the readers promise to throw (UserError, RunError) and nothing
// else: any other end is a finding.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel::fuzz {

struct Target {
    const char* name;   // "foreign"
    const char* about;  // "files of other programs", for messages
    void (*attempt)(std::string_view bytes);
};

Target foreign_target();
Target mesh_target();
Target scene_target();
Target expression_target();
Target study_target();

inline std::vector<Target> targets() {
    return {foreign_target(), mesh_target(), scene_target(), expression_target(), study_target()};
}

}  // namespace grainreel::fuzz
