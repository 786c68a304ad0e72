// Reads from a member's folder what became of it.
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
    std::string error;  // error of a failed member
    std::vector<std::string> warnings;
    std::vector<double> values;  // for complete members, one for each measure; NaN where there is no value
    double simulated = 0;        // s
    double particle_steps_per_second = 0;
    bool has_film = false;
};

std::string to_string(MemberResult::State state);

// Reads run.json and measures.csv in the member's folder. A member with damaged files counts as incomplete.
MemberResult read_result(const std::filesystem::path& folder, const std::vector<StudyMeasure>& measures);

}  // namespace grainreel
