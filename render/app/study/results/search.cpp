#include "render/app/study/results/search.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace grainreel {
namespace {

using Verdict = SearchStep::Verdict;

bool has_interval(const SeedSummary& y) {
    return std::isfinite(y.low) && std::isfinite(y.high);
}

// -1 where the measure is below the wanted value, 1 where it is above, 0 where its interval holds it.
int side_of(const SeedSummary& y, double wanted) {
    const double low = has_interval(y) ? y.low : y.value, high = has_interval(y) ? y.high : y.value;
    return low > wanted ? 1 : high < wanted ? -1 : 0;
}

// How far the mean of one lies above that of the other, beyond both intervals; 0 where they overlap.
double beyond(const SeedSummary& one, const SeedSummary& other) {
    const double low = has_interval(one) ? one.low : one.value,
                 high = has_interval(other) ? other.high : other.value;
    return std::max(0.0, low - high);
}

// Whether the measure rises and falls among the values that were tried, by more than the intervals allow.
bool turns(const std::vector<TriedValue>& tried) {
    bool rises = false, falls = false;
    for (std::size_t i = 0; i < tried.size(); ++i)
        for (std::size_t k = i + 1; k < tried.size(); ++k) {
            rises = rises || beyond(tried[k].y, tried[i].y) > 0;
            falls = falls || beyond(tried[i].y, tried[k].y) > 0;
        }
    return rises && falls;
}

// Where the straight line between two values has the wanted one.
double on_the_line(const TriedValue& one, const TriedValue& other, double wanted) {
    if (one.y.value == other.y.value) return 0.5 * (one.x + other.x);
    const double share = (wanted - one.y.value) / (other.y.value - one.y.value);
    return one.x + std::clamp(share, 0.0, 1.0) * (other.x - one.x);
}

// Narrows the bracket to what the seeds of an undecided value tell: where the line through it, as steep as
// the bracket, has the wanted value, and how far half of its interval reaches along that line.
void narrow(SearchStep& step, const TriedValue& undecided, double steepness, double wanted) {
    if (!has_interval(undecided.y) || steepness == 0) return;
    const double x = undecided.x + (wanted - undecided.y.value) / steepness;
    const double half = 0.5 * (undecided.y.high - undecided.y.low) / std::abs(steepness);
    step.open_low = x - half<step.first, step.open_high = x + half> step.last;
    step.estimate = std::clamp(x, step.low, step.high);
    step.low = std::max(step.low, x - half);
    step.high = std::min(step.high, x + half);
}

// The values that are left for the wanted one.
struct Bracket {
    std::size_t begin = 0, end = 0;
    const TriedValue* undecided = nullptr;  // a value whose interval holds the wanted one
};

// The narrowest bracket: the last value on the side of the first, and the first one on the side of the last.
Bracket bracket_of(const std::vector<TriedValue>& tried, double wanted) {
    const int first = side_of(tried.front().y, wanted), last = side_of(tried.back().y, wanted);
    Bracket all{0, tried.size() - 1, nullptr};
    all.undecided = first == 0 ? &tried.front() : last == 0 ? &tried.back() : nullptr;
    for (std::size_t i = 1; i + 1 < tried.size(); ++i) {
        const int side = side_of(tried[i].y, wanted);
        if (side == 0)
            all.undecided = &tried[i];
        else if (side == first)
            all.begin = i;
        else
            all.end = std::min(all.end, i);
    }
    return all;
}

}  // namespace

SearchStep next_step(std::vector<TriedValue> tried, double wanted, double within) {
    std::sort(tried.begin(), tried.end(), [](const TriedValue& a, const TriedValue& b) { return a.x < b.x; });
    SearchStep step;
    step.low = step.first = tried.front().x, step.high = step.last = tried.back().x;
    step.estimate = on_the_line(tried.front(), tried.back(), wanted);
    const auto ends = [&](Verdict verdict) {
        step.verdict = verdict;
        return step;
    };
    for (const TriedValue& one : tried)
        if (!std::isfinite(one.y.value)) return ends(Verdict::unknown);
    step.turns = turns(tried);
    const int first = side_of(tried.front().y, wanted), last = side_of(tried.back().y, wanted);
    const bool by_seeds = has_interval(tried.front().y) && has_interval(tried.back().y);
    if (first != 0 && first == last)
        return ends(step.turns && by_seeds ? Verdict::not_monotonic : Verdict::not_in_range);
    const Bracket bracket = bracket_of(tried, wanted);
    const TriedValue &one = tried[bracket.begin], &other = tried[bracket.end];
    step.low = one.x, step.high = other.x;
    step.estimate = on_the_line(one, other, wanted);
    if (step.high - step.low <= within * (1 + 1e-9)) return ends(Verdict::reached);
    if (step.turns && by_seeds) return ends(Verdict::not_monotonic);
    if (bracket.undecided != nullptr) {
        narrow(step, *bracket.undecided, (other.y.value - one.y.value) / (other.x - one.x), wanted);
        return ends(Verdict::seeds_too_few);
    }
    step.next = 0.5 * (step.low + step.high);
    return step;
}

namespace {

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::go_on:
            return "goes-on";
        case Verdict::reached:
            return "reached";
        case Verdict::not_in_range:
            return "not-in-range";
        case Verdict::not_monotonic:
            return "not-monotonic";
        case Verdict::seeds_too_few:
            return "seeds-too-few";
        case Verdict::unknown:
            break;
    }
    return "unknown";
}

// "2.5 to 4 mm", "at least 2.5 mm", or "anywhere" where the interval has no end within the range.
std::string interval_words(const SearchStep& step, const std::string& behind) {
    if (step.open_low && step.open_high) return "anywhere in the range that was searched";
    if (step.open_high) return fmt::format("at least {:.4g}{}", step.low, behind);
    if (step.open_low) return fmt::format("at most {:.4g}{}", step.high, behind);
    return fmt::format("in {:.4g} to {:.4g}{}", step.low, step.high, behind);
}

std::string scatter_words(const SearchStep& step, bool has_interval) {
    if (!step.turns) return "";
    return has_interval ? "; the measure rises and falls elsewhere, so there may be other values"
                        : "; the values of one seed rise and fall, which may be scatter: more seeds tell";
}

}  // namespace

std::string search_text(const SearchStep& step, const std::string& key, const std::string& unit,
                        bool has_interval) {
    const std::string behind = unit.empty() ? "" : " " + unit;
    const std::string bracket = fmt::format("{:.4g} and {:.4g}{}", step.low, step.high, behind);
    switch (step.verdict) {
        case Verdict::go_on:
            return fmt::format("{} lies between {}; next is {:.4g}{}", key, bracket, step.next, behind);
        case Verdict::reached:
            return fmt::format(
                "{} = {:.4g}{}, between {}{}{}", key, step.estimate, behind, bracket,
                has_interval ? "" : "; one seed has no interval, so another seed may give another value",
                scatter_words(step, has_interval));
        case Verdict::not_in_range:
            return fmt::format(
                "{} is not between {}: the measure is on one side of the wanted value at both ends; "
                "choose another 'from' or 'to'{}",
                key, bracket, has_interval ? "" : ", or give more seeds");
        case Verdict::not_monotonic:
            return fmt::format(
                "stopped: the measure rises and falls between {:.4g} and {:.4g}{}, so there may be several "
                "values{}; choose a range in which it only rises or falls",
                step.first, step.last, behind,
                step.low == step.first && step.high == step.last ? " or none"
                                                                 : "; one lies between " + bracket);
        case Verdict::seeds_too_few:
            return fmt::format(
                "stopped: {} is about {:.4g}{}, {} (95 %); the interval of the seeds holds the wanted value, "
                "so these seeds tell no more; give more seeds{}",
                key, step.estimate, behind, interval_words(step, behind),
                step.open_low || step.open_high ? ", or a wider range" : "");
        case Verdict::unknown:
            break;
    }
    return "stopped: the measure did not come up in all seeds, so it has no mean; give another window, "
           "threshold or "
           "range";
}

std::string search_json(const StudySearch& search, const SearchStep& step, const std::string& key,
                        const std::string& unit, const StudyMeasure& measure) {
    using Json = nlohmann::ordered_json;
    Json json;
    json["key"] = key, json["unit"] = unit;
    json["measure"] = measure.name, json["measure_unit"] = measure.unit;
    json["wanted"] = search.wanted, json["within"] = search.within;
    json["verdict"] = name_of(step.verdict);
    const bool known = step.verdict != Verdict::unknown && step.verdict != Verdict::not_in_range;
    json["estimate"] = known ? Json(step.estimate) : Json(nullptr);
    json["low"] = step.open_low ? Json(nullptr) : Json(step.low);
    json["high"] = step.open_high ? Json(nullptr) : Json(step.high);
    json["rises_and_falls"] = step.turns;
    return json.dump(2) + "\n";
}

}  // namespace grainreel
