// The search for the value of a key at which a measure has a wanted value: [[vary]] with `until`. It looks at
// what has been run so far, and says what to run next or why it ends, so a search that was stopped goes on.
#pragma once

#include <string>
#include <vector>

#include "render/app/study/results/summary.hpp"

namespace grainreel {

// A value of the key that has been tried.
struct TriedValue {
    double x = 0;
    SeedSummary y;
};

struct SearchStep {
    enum class Verdict {
        go_on,          // run `next`
        reached,        // the bracket is as narrow as wanted
        not_in_range,   // the measure is on one side of the wanted value at both ends
        not_monotonic,  // a value between two others is beyond both by more than the intervals allow
        seeds_too_few,  // the seeds' interval holds the wanted value, so they cannot tell which half it is in
        unknown,        // a measure came up in some seeds only, or in none
    };
    Verdict verdict = Verdict::go_on;
    double next = 0;
    // The values between which the wanted one lies, as far as is known; where the seeds cannot tell more, the
    // 95 % interval that follows from theirs. The estimate lies between them, on a straight line.
    double low = 0, high = 0, estimate = 0;
    // The interval reaches beyond that end of the range that was searched, so the end is no bound.
    bool open_low = false, open_high = false;
    double first = 0, last = 0;  // ends of the range
    bool turns = false;          // the measure rises and falls; with one seed this may be its scatter
};

// tried: the runs so far, without order; at least both ends of the range. wanted: of the measure. within: how
// narrow the bracket must become. Bisection: the middle of the bracket is next. A value decides only if the
// 95 % interval of its seeds does not hold the wanted value; with one seed there is no interval, and the
// value alone decides, and a measure that rises and falls does not end the search.
//
// Where the seeds cannot tell more, the interval is that of the undecided value, carried over along the
// straight line through the ends of the bracket: half of it is half the interval of the measure divided by
// the slope.
SearchStep next_step(std::vector<TriedValue> tried, double wanted, double within);

// The step in words. key: "contact.friction"; unit: of the key.
std::string search_text(const SearchStep& step, const std::string& key, const std::string& unit,
                        bool has_interval);

// The text of search.json: what was searched, and what is known of it.
std::string search_json(const StudySearch& search, const SearchStep& step, const std::string& key,
                        const std::string& unit, const StudyMeasure& measure);

}  // namespace grainreel
