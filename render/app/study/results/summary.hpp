// One measure over the seeds of a setting: the mean, the median or the share, with its 95 % interval. Where a
// measure came up in some seeds only, there is no mean. Then the number of these seeds is told, and if the
// others are known to be later, a bound.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/questions/statistics.hpp"
#include "render/app/study/file/members.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {

struct SeedSummary {
    static constexpr double kNone = kUnknown;

    std::size_t members = 0;  // number of complete members
    std::size_t count = 0;    // so many of them have a value
    // The mean, or what else the measure asks for. NaN where it is not known, because some members have no
    // value.
    double value = kNone;
    // Ends of the 95 % interval, NaN for none. A median may have no upper end; then `high` is infinite.
    double low = kNone, high = kNone;
    // Where `value` is NaN: what is known all the same, the mean of the values that there are, or a bound
    // below the true one. NaN for nothing.
    double of_some = kNone;
    bool is_bound = false;
    bool cut_at_zero = false;    // the interval would have reached below zero
    std::vector<double> values;  // of the seeds; without those that are not finite, and none of a share

    bool came_up_everywhere() const { return count == members; }
    bool is_seen() const { return std::isfinite(value) || std::isfinite(of_some); }  // whether a chart has it
};

// Passages that did not come up count as later than the end of their window. The interval of the median is
// that of the order statistics (Conover, Practical Nonparametric Statistics, 1999, 3.2) and needs six seeds;
// that of a share is Wilson's (J. Am. Stat. Assoc. 22, 1927, 209).
SeedSummary summary_of(SeedAverage average, const std::vector<SeedValue>& seeds);
// The same for a measure: where it cannot be negative, its interval is cut off at zero.
SeedSummary summary_of_measure(const StudyMeasure& measure, const std::vector<SeedValue>& seeds);
// The same numbers in another unit.
SeedSummary scaled(SeedSummary all, double factor);

// members: in the order of make_members().

// The number of complete members of a setting.
std::size_t setting_complete(const std::vector<Member>& members, const std::vector<MemberResult>& results,
                             std::size_t setting);
SeedSummary setting_summary(const Study& study, const std::vector<Member>& members,
                            const std::vector<MemberResult>& results, std::size_t setting,
                            std::size_t measure);

// The summary as text: "0.412 ± 0.031", "0.80 (0.38 to 0.96)", "≥ 2.6", or a dash. The half of an interval
// has two digits, and the mean as many decimals.
std::string summary_text(const SeedSummary& summary);
// The same for a column of a table: numbers without an interval have as many decimals as the longest of them.
std::vector<std::string> column_texts(const std::vector<SeedSummary>& column);
// "came up in 1 of 5", where that is not all; else empty.
std::string came_up_text(const SeedSummary& summary);

// The mean with half of its 95 % interval. For one value it is the value alone, for none a dash.
std::string interval_text(const MeanInterval& interval);

}  // namespace grainreel
