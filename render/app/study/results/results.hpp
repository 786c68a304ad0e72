// The results of members: what became of each one, read from its folder, and the table of all, study.csv.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/numbers.hpp"
#include "render/app/study/file/members.hpp"
#include "render/app/study/study.hpp"

namespace grainreel {

// What one member says of one measure.
struct SeedValue {
    double value = kUnknown;
    // s; a first passage without a value comes later than that. NaN: not known.
    double until = kUnknown;
};

struct MemberResult {
    enum class Status {
        missing,     // it has not been run
        incomplete,  // it was stopped or killed, or it is being run
        failed,      // a blow-up, a full disk, a mistake
        complete,
    };
    Status status = Status::missing;
    std::string error;  // error of a failed member
    std::vector<std::string> warnings;
    std::vector<double> values;  // for complete members, one for each measure; NaN where there is no value
    // The same for first passages that did not come up: the time (s) until which they were looked for. Empty
    // for none.
    std::vector<double> until;
    double simulated = 0;           // s
    std::optional<double> settled;  // s for which its bed settled before the drive
    double particle_steps_per_second = 0;
    bool has_film = false;

    SeedValue seed_value(std::size_t measure) const;
};

std::string to_string(MemberResult::Status status);

// Reads run.json and measures.csv in the member's folder. A member with damaged files counts as incomplete,
// and so does a run that was planned for fewer than `steps` steps and is still to go on.
MemberResult read_result(const std::filesystem::path& folder, const std::vector<StudyMeasure>& measures,
                         std::int64_t steps = 0);

// A cell as RFC 4180 asks: in quotes when it has a comma, a quote or a line break.
std::string csv_cell(const std::string& text);
// The shortest decimal number that reads back to the same bits; empty for NaN.
std::string csv_number(double value);

// The text of study.csv: a row for each member, in their order. The columns are the keys with their units,
// the seed (if the study gives seeds), the state, the measures, the number of warnings, the error and the
// folder.
std::string study_table(const Study& study, const std::vector<Member>& members,
                        const std::vector<MemberResult>& results);

// The text of units.csv, "column,unit,meaning": a row for each measure, whose columns in study.csv and
// settings.csv are all in this unit.
std::string unit_table(const Study& study);

// The text of settings.csv: a row for each setting. The columns are the keys with their units, the numbers of
// members and of complete ones, and for each measure NAME (its mean, or what else it asks for), NAME_low and
// NAME_high (its 95 % interval), NAME_came_up (how many complete members have a value) and NAME_at_least (a
// bound, where passages did not come up in all).
std::string setting_table(const Study& study, const std::vector<Member>& members,
                          const std::vector<MemberResult>& results);

}  // namespace grainreel
