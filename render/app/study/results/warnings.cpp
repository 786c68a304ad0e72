#include "render/app/study/results/warnings.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>

#include "engine/base/counted.hpp"

namespace grainreel {
namespace {

// A text in pieces: words and numbers in turn, words first.
struct Pieces {
    std::vector<std::string> words, numbers;

    explicit Pieces(const std::string& text) {
        const auto is_digit = [&](std::size_t at) {
            return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
        };
        std::string word;
        for (std::size_t i = 0; i < text.size();) {
            if (!is_digit(i)) {
                word += text[i++];
                continue;
            }
            std::size_t end = i;
            while (is_digit(end) || (text[end] == '.' && is_digit(end + 1))) ++end;
            if (text[end] == 'e' && is_digit(end + 1 + (text[end + 1] == '-' ? 1 : 0))) {
                end += text[end + 1] == '-' ? 2 : 1;
                while (is_digit(end)) ++end;
            }
            words.push_back(word), numbers.push_back(text.substr(i, end - i));
            word.clear();
            i = end;
        }
        words.push_back(word);
    }
};

// Warnings with the same words: the smallest and the largest of each number, as they are written.
struct Group {
    std::vector<std::string> least, most;
    std::vector<std::size_t> members;
    void take(const Pieces& pieces, std::size_t member) {
        if (members.empty()) least = most = pieces.numbers;
        const auto value = [](const std::string& number) { return std::strtod(number.c_str(), nullptr); };
        for (std::size_t i = 0; i < least.size(); ++i) {
            if (value(pieces.numbers[i]) < value(least[i])) least[i] = pieces.numbers[i];
            if (value(pieces.numbers[i]) > value(most[i])) most[i] = pieces.numbers[i];
        }
        if (members.empty() || members.back() != member) members.push_back(member);
    }
    std::string text(const std::vector<std::string>& words) const {
        std::string all = words.front();
        for (std::size_t i = 0; i < least.size(); ++i)
            all += least[i] + (least[i] == most[i] ? "" : " to " + most[i]) + words[i + 1];
        return all;
    }
};

std::string remedy_for_gaps(const StudyMeasure& measure) {
    if (!measure.reduction.has_threshold()) return "Its column is empty there, or its window has no row";
    return fmt::format(
        "The threshold was not reached; a longer run.duration{} reduce = \"share\"{} may tell more",
        measure.average == SeedAverage::median ? " or" : ",",
        measure.average == SeedAverage::median ? "" : " or average = \"median\"");
}

// A line for each measure to which some complete members have no value.
std::vector<std::string> gaps_of(const Study& study, const std::vector<MemberResult>& results) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < study.measures.size(); ++i) {
        std::size_t complete = 0, gaps = 0;
        for (const MemberResult& result : results)
            if (result.status == MemberResult::Status::complete)
                ++complete, gaps += std::isnan(result.values[i]) ? 1 : 0;
        if (gaps == 0) continue;
        const bool median = study.measures[i].average == SeedAverage::median;
        lines.push_back(
            fmt::format("{} came up in {} of {} complete members; settings in which it {} have no {}. {}",
                        study.measures[i].name, complete - gaps, complete,
                        median ? "came up in half or less" : "did not come up everywhere",
                        median ? "median" : "mean", remedy_for_gaps(study.measures[i])));
    }
    return lines;
}

}  // namespace

std::vector<SharedWarning> shared_warnings(const std::vector<MemberResult>& results) {
    std::vector<std::vector<std::string>> order;  // words, by the first member that has them
    std::map<std::vector<std::string>, Group> groups;
    for (std::size_t m = 0; m < results.size(); ++m)
        for (const std::string& warning : results[m].warnings) {
            const Pieces pieces(warning);
            Group& group = groups[pieces.words];
            if (group.members.empty()) order.push_back(pieces.words);
            group.take(pieces, m);
        }
    std::vector<SharedWarning> all;
    for (const std::vector<std::string>& words : order)
        all.push_back({groups[words].text(words), groups[words].members});
    return all;
}

std::string members_text(const Study& study, const std::vector<Member>& members,
                         const std::vector<std::size_t>& which) {
    if (which.size() == members.size() && which.size() > 1) return "all members";
    std::string text;
    std::size_t last = members.size();  // setting
    for (const std::size_t m : which) {
        const bool same = last == members[m].setting;
        last = members[m].setting;
        const std::string setting = shown_setting(study, members[m]);
        if (!same) text += (text.empty() ? "" : "; ") + setting;
        if (!members[m].seed) continue;
        text += same ? fmt::format(", {}", *members[m].seed)
                     : fmt::format("{}seed {}", setting.empty() ? "" : ", ", *members[m].seed);
    }
    return text;
}

std::vector<std::string> study_warnings(const Study& study, const std::vector<Member>& members,
                                        const std::vector<MemberResult>& results) {
    constexpr std::size_t most = 3;
    std::vector<std::string> lines = gaps_of(study, results);
    const std::vector<SharedWarning> all = shared_warnings(results);
    for (std::size_t i = 0; i < std::min(all.size(), most); ++i)
        lines.push_back(fmt::format("{}: {}", members_text(study, members, all[i].members), all[i].text));
    if (all.size() > most)
        lines.push_back(
            fmt::format("{} more of the members are in index.html", counted(all.size() - most, "warning")));
    return lines;
}

}  // namespace grainreel
