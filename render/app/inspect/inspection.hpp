// Does the work of the verb `inspect` once its options are read: opens the run, brings the moment back if it
// was not kept (by simulating it again from a checkpoint), and finds the answer. Each kind of question is a
// function in engine/questions; here the right one is chosen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/questions/answer.hpp"
#include "engine/questions/asked_moment.hpp"
#include "engine/questions/column_figures.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/picture/gl/provider.hpp"

namespace grainreel {

// The options as they were typed. At most one question is set; without one the answer is an overview of the
// moment.
struct InspectRequest {
    std::filesystem::path run;
    ReadingOptions reading;
    Assignments sets;  // values given to keys of [film]

    MomentRequest moment;
    double phase = 0;                      // in periods, from 0 to 1; added to moment.cycle
    std::optional<double> average, every;  // average: number of periods; every: s between moments
    bool over_time = false, no_replay = false;

    std::optional<std::int64_t> grain;  // id of a grain
    std::optional<std::string> wall, where, profile, slice, histogram;
    std::optional<std::string> steady;  // name of a column of measures.csv
    std::string fields;                 // grid of the means of fields: kept, rz; empty: not asked
    bool discharge = false;             // rate of the outflow
    bool parameters = false;            // the table of all parameters
    ColumnsRequest columns;             // figures of columns of measures.csv; no column: not asked
    std::optional<double> compare;      // s, time of the earlier moment
    std::vector<double> pixel;          // x, y of a pixel; empty: not asked
    // through: all that lies behind the pixel, not only what is seen there.
    bool through = false, largest_overlap = false, pairs = false;
    std::string mean;  // a quantity whose mean over a series is wanted
    int bins = 20;
    std::size_t limit = 10;

    std::filesystem::path picture;    // file of the picture; empty: none
    std::optional<double> film_time;  // s of the film, for the place of a moving camera
    gl::Provider gl = gl::Provider::automatic;

    bool json = false, csv = false;  // how the answer is printed

    // Whether the question is to the whole run and not to a moment.
    bool of_columns() const {
        return steady || discharge || parameters || !fields.empty() || !columns.columns.empty();
    }
    bool series() const { return over_time || every.has_value(); }
    bool draws() const { return !picture.empty() || !pixel.empty(); }
};

// Finds the answer, and draws the picture when one is asked for. Tells the reporter what is damaged and how
// far the work is. Throws UserError for a question that cannot be answered.
Answer inspected(const InspectRequest& request, Reporter& reporter);

}  // namespace grainreel
