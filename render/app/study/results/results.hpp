// What became of a member: read from its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/app/study/study.hpp"

namespace grainreel {

struct MemberResult {
    enum class State {
        missing,     // it has not been run
        incomplete,  // it was stopped or killed, or it is being run
        failed,      // a blow-up, a full disk, a mistake
        complete,
    };
    State state = State::missing;
    std::string error;  // of a failed one
    std::vector<std::string> warnings;
    std::vector<double> values;  // one a measure; NaN where there is nothing to tell. Of complete ones
    double simulated = 0;        // s
    double particle_steps_per_second = 0;
    bool has_film = false;
};

std::string to_string(MemberResult::State state);

// From run.json and measures.csv in the member's folder. What is damaged counts as incomplete.
MemberResult read_result(const std::filesystem::path& folder, const std::vector<StudyMeasure>& measures);

}  // namespace grainreel
