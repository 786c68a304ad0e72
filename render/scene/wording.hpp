// The fixed words of films, in four languages, and how a scene rewords them. All such words are in
// two tables, words that scenes may reword in wording.cpp and phrases in wording_phrases.cpp. Nearly all of
// render includes this header: keep it light.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainreel {

enum class Language { en, de, fr, es };

// In the order of the table. The comment is the English word; {1} and {2} stand for numbers and names.
enum class Word {
    gravity,              // gravity
    vibration,            // vibration
    floor_vibrates,       // floor vibrates
    floor,                // floor
    at_rest,              // at rest
    taps,                 // taps of {1}
    tap_interval,         // every {1}
    before_the_drive,     // before the drive
    settling,             // settling, drive off
    cycle,                // cycle {1}
    phase,                // phase {1}
    real_time,            // real time
    slow_motion,          // slow motion, {1} speed
    time_lapse,           // time lapse, {1}× speed
    on_average,           // on average {1}
    frame_a_period,       // 1 frame a period at phase {1}
    frame_every,          // 1 frame every {1} periods at phase {2}
    moment_a_period,      // 1 moment a period at phase {1}
    moment_every,         // 1 moment every {1} periods at phase {2}
    plays,                // plays {1}×
    mean_of_a_period,     // mean of a period
    mean_of_periods,      // mean of {1} periods
    exposed,              // exposed for {1}
    wall_motion,          // wall motion
    drawn_larger,         // drawn {1}×
    in_the_tray,          // {1} of {2} in the tray
    out,                  // {1} out
    out_of,               // {1} of {2} out
    at_the_start,         // {1} at the start
    fed,                  // {1}, fed
    more_fed,             // {1} more are fed
    glued,                // {1}, glued to walls
    more_species,         // and {1} more
    grain,                // grain {1}
    grains,               // grains {1}
    number_of_grains,     // {1} grains
    paths,                // paths of the last {1}
    mean_velocity,        // mean velocity
    over_a_period,        // {1} over a period
    over_periods,         // {1} over {2} periods
    streamlines,          // streamlines
    this_wide,            // {1}, this wide from {2} on
    force_on_wall,        // mean force on a wall
    contact_force,        // contact force, {1} or more
    time,                 // time
    height,               // height
    across,               // across
    solid_fraction,       // solid fraction
    share,                // share of the solid volume
    horizontal_velocity,  // horizontal velocity
    vertical_velocity,    // vertical velocity
    speed,                // speed
    upward_velocity,      // upward velocity
    start_height,         // height at the start
    displacement,         // displacement in a period
    rise,                 // rise in a period
    spin,                 // spin
    kinetic_energy,       // kinetic energy
    contacts,             // contacts of a grain
    normal_forces,        // normal forces on a grain
    wear,                 // wear of walls
    pressure,             // pressure on walls
    no_vibration,         // no vibration
    changing_drive,       // drive that changes, at first
    end_of_table          // not a word
};

// A word as a scene says it.
struct OwnWord {
    Word word;
    std::string text;
    bool operator==(const OwnWord&) const = default;
};

// The language of a film's fixed words, and the words that the scene has in place of the table's.
struct Wording {
    Language language = Language::en;
    std::vector<OwnWord> own;  // in the order of the table
    bool operator==(const Wording&) const = default;
    // The word, with `parts` in place of {1}, {2} ...
    std::string operator()(Word word, std::initializer_list<std::string_view> parts = {}) const;
};

const std::vector<std::pair<std::string, Language>>& language_words();

// The name of a word's key in [film.wording], "mean_of_a_period", and its English text.
const char* name_of(Word word);
const char* english_of(Word word);

// The label of a column in another language; names in it stay. Labels that the table of wording_phrases.cpp
// lacks stay English.
std::string phrase(Language language, const std::string& english);

// How many parts a text has: 2 for "{1} of {2}"; -1 where a brace is no {1} to {9}.
int parts_in(std::string_view text);

}  // namespace grainreel
