#include "render/app/study/results/summary.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::string with_minus(std::string text) {
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string rounded_text(double value) {
    return with_minus(fmt::format("{:.3g}", value));
}

// The number k of the k-th smallest and k-th largest of n values between which the median lies with a
// probability of 95 % or more; 0 where n is too small.
std::size_t rank_of_bounds(std::size_t n) {
    constexpr double tail = 0.025;
    double term = std::pow(0.5, static_cast<double>(n)), sum = 0;
    std::size_t rank = 0;
    while (sum + term <= tail) {
        sum += term;
        term *= static_cast<double>(n - rank) / static_cast<double>(rank + 1);
        ++rank;
    }
    return rank;
}

// Sorted values, with infinity for passages that did not come up.
std::vector<double> in_order(const std::vector<SeedValue>& seeds) {
    std::vector<double> all;
    for (const SeedValue& seed : seeds) all.push_back(std::isfinite(seed.value) ? seed.value : infinite);
    std::sort(all.begin(), all.end());
    return all;
}

// The earliest end of a window in which a passage did not come up.
double earliest_end(const std::vector<SeedValue>& seeds) {
    double end = infinite;
    for (const SeedValue& seed : seeds)
        if (!std::isfinite(seed.value)) end = std::min(end, seed.until);
    return end;
}

void take_median(const std::vector<SeedValue>& seeds, SeedSummary& all) {
    const std::vector<double> order = in_order(seeds);
    const std::size_t n = order.size();
    const double median = 0.5 * (order[(n - 1) / 2] + order[n / 2]);
    if (!std::isfinite(median)) {
        all.of_some = earliest_end(seeds), all.is_bound = true;
        return;
    }
    all.value = median;
    const std::size_t rank = rank_of_bounds(n);
    if (rank > 0) all.low = order[rank - 1], all.high = order[n - rank];
}

void take_mean(SeedSummary& all) {
    const MeanInterval interval = mean_interval(all.values);
    all.value = interval.mean;
    if (all.count > 1) all.low = interval.mean - interval.half, all.high = interval.mean + interval.half;
}

// Wilson's interval of a share.
void take_share(SeedSummary& all) {
    constexpr double z = 1.959963984540054;  // 97.5 % of the normal distribution lie below
    const auto n = static_cast<double>(all.count);
    all.value = mean_of_values(all.values);
    const double centre = (all.value + z * z / (2 * n)) / (1 + z * z / n);
    const double half =
        z / (1 + z * z / n) * std::sqrt(all.value * (1 - all.value) / n + z * z / (4 * n * n));
    all.low = std::max(0.0, centre - half), all.high = std::min(1.0, centre + half);
    all.values.clear();  // each is 0 or 1, and says nothing that the share does not say
}

}  // namespace

SeedSummary summary_of(SeedAverage average, const std::vector<SeedValue>& seeds) {
    SeedSummary all;
    all.members = seeds.size();
    bool later = true;  // whether all that have no value are known to be later
    double sum = 0;     // of the values, and of the ends of the windows in place of later ones
    for (const SeedValue& seed : seeds) {
        const bool has_value = std::isfinite(seed.value);
        if (has_value) all.values.push_back(seed.value);
        later = later && (has_value || std::isfinite(seed.until));
        sum += has_value ? seed.value : seed.until;
    }
    all.count = all.values.size();
    if (all.members == 0) return all;
    if (average == SeedAverage::median && later) {
        take_median(seeds, all);
    } else if (all.came_up_everywhere()) {
        average == SeedAverage::share ? take_share(all) : take_mean(all);
    } else {
        all.is_bound = later;
        all.of_some = later ? sum / static_cast<double>(all.members) : mean_of_values(all.values);
    }
    return all;
}

SeedSummary summary_of_measure(const StudyMeasure& measure, const std::vector<SeedValue>& seeds) {
    SeedSummary all = summary_of(measure.average, seeds);
    if (measure.from_zero && all.low < 0) all.low = 0, all.cut_at_zero = true;
    return all;
}

SeedSummary scaled(SeedSummary all, double factor) {
    for (double* number : {&all.value, &all.low, &all.high, &all.of_some}) *number *= factor;
    for (double& value : all.values) value *= factor;
    return all;
}

namespace {

// The complete members of a setting.
std::vector<const MemberResult*> complete_in(const std::vector<Member>& members,
                                             const std::vector<MemberResult>& results, std::size_t setting) {
    std::vector<const MemberResult*> complete;
    const auto first = std::partition_point(members.begin(), members.end(),
                                            [&](const Member& m) { return m.setting < setting; });
    for (auto m = first; m != members.end() && m->setting == setting; ++m) {
        const MemberResult& result = results[m - members.begin()];
        if (result.status == MemberResult::Status::complete) complete.push_back(&result);
    }
    return complete;
}

}  // namespace

std::size_t setting_complete(const std::vector<Member>& members, const std::vector<MemberResult>& results,
                             std::size_t setting) {
    return complete_in(members, results, setting).size();
}

SeedSummary setting_summary(const Study& study, const std::vector<Member>& members,
                            const std::vector<MemberResult>& results, std::size_t setting,
                            std::size_t measure) {
    std::vector<SeedValue> seeds;
    for (const MemberResult* result : complete_in(members, results, setting))
        seeds.push_back(result->seed_value(measure));
    return summary_of_measure(study.measures[measure], seeds);
}

std::string interval_text(const MeanInterval& interval) {
    if (interval.count == 0) return "–";
    if (interval.count == 1) return with_minus(fmt::format("{:.4g}", interval.mean));
    const double half = interval.half;
    if (!(half > 0) || !std::isfinite(half))
        return fmt::format("{} ± {:.2g}", with_minus(fmt::format("{:.4g}", interval.mean)), half);
    // Two digits of the half: 0.0312 has three decimals, 312 is rounded to tens.
    const int decimals = 1 - static_cast<int>(std::floor(std::log10(half) + 1e-12));
    const double digit = std::pow(10, -decimals);
    const auto rounded = [&](double value) {
        const double shown = std::round(value / digit) * digit;
        return with_minus(fmt::format("{:.{}f}", shown == 0 ? 0 : shown, std::max(0, decimals)));
    };
    if (std::abs(interval.mean) >= 1e6 || half < 1e-4)
        return fmt::format("{} ± {:.2g}", with_minus(fmt::format("{:.4g}", interval.mean)), half);
    return fmt::format("{} ± {}", rounded(interval.mean), rounded(half));
}

std::string summary_text(const SeedSummary& all) {
    if (std::isnan(all.value)) {
        if (!std::isfinite(all.of_some)) return "–";
        return all.is_bound ? fmt::format("≥ {}", rounded_text(all.of_some))
                            : fmt::format("({})", rounded_text(all.of_some));
    }
    if (std::isnan(all.low)) return rounded_text(all.value);
    const double above = all.high - all.value, below = all.value - all.low;
    if (std::isfinite(above) && std::abs(above - below) <= 1e-9 * std::abs(above))
        return interval_text({all.count, all.value, above});
    return fmt::format("{} ({} to {})", rounded_text(all.value), rounded_text(all.low),
                       std::isfinite(all.high) ? rounded_text(all.high) : "∞");
}

std::vector<std::string> column_texts(const std::vector<SeedSummary>& column) {
    std::vector<std::string> texts;
    const auto decimals_of = [](const std::string& text) {
        const std::size_t point = text.find('.');
        return point == std::string::npos ? std::size_t{0} : text.size() - point - 1;
    };
    std::size_t decimals = 0;
    const auto is_plain = [](const SeedSummary& one) {
        return std::isfinite(one.value) && std::isnan(one.low);
    };
    bool powers = false;  // some number is written with a power of ten
    for (const SeedSummary& one : column) {
        texts.push_back(summary_text(one));
        if (!is_plain(one)) continue;
        powers = powers || texts.back().find('e') != std::string::npos;
        decimals = std::max(decimals, decimals_of(texts.back()));
    }
    for (std::size_t i = 0; i < column.size() && !powers; ++i)
        if (is_plain(column[i])) texts[i] = with_minus(fmt::format("{:.{}f}", column[i].value, decimals));
    return texts;
}

std::string came_up_text(const SeedSummary& all) {
    if (all.came_up_everywhere()) return "";
    return fmt::format("came up in {} of {}", all.count, all.members);
}

}  // namespace grainreel
