// What is seen on a study's charts, in words.
#include "render/app/study/results/points.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace grainreel {
namespace {

// What there is on a chart.
struct Seen {
    std::size_t least = 0, most = 0;  // complete members of a point
    bool bars = false, rings = false, cut = false;
    bool gaps = false, bounds = false, some = false;  // points that did not come up in all seeds
    explicit Seen(const std::vector<ChartSeries>& series) {
        for (const ChartSeries& each : series)
            for (const ChartPoint& point : each.points) take(point.y);
    }

  private:
    void take(const SeedSummary& y) {
        if (!y.is_seen()) return;
        least = most == 0 ? y.members : std::min(least, y.members);
        most = std::max(most, y.members);
        bars = bars || !std::isnan(y.low);
        cut = cut || y.cut_at_zero;
        rings = rings || (y.values.size() > 1 && y.values.size() <= few_values);
        gaps = gaps || !y.came_up_everywhere();
        bounds = bounds || (std::isnan(y.value) && y.is_bound);
        some = some || (std::isnan(y.value) && !y.is_bound);
    }
};

std::string points_sentence(SeedAverage average, const Seen& seen) {
    const std::string n = seen.least == seen.most ? fmt::format("{}", seen.most)
                                                  : fmt::format("{} to {}", seen.least, seen.most);
    if (average == SeedAverage::share)
        return fmt::format("Points are shares of n = {} seed{}", n, seen.most == 1 ? "" : "s");
    if (seen.most == 1) return "Points are values of one seed, so there is no interval";
    return fmt::format("Points are {}s over n = {} seeds", name_of(average), n);
}

std::string bars_sentence(SeedAverage average, const Seen& seen) {
    if (average == SeedAverage::median && !seen.bars)
        return seen.most > 1 ? "There are no bars, since a 95 % interval of the median needs six seeds" : "";
    if (!seen.bars) return "";
    switch (average) {
        case SeedAverage::median:
            return "Bars are 95 % intervals of the median, by order statistics";
        case SeedAverage::share:
            return "Bars are 95 % intervals of the share, after Wilson";
        case SeedAverage::mean:
            break;
    }
    return "Bars are 95 % intervals of the mean, by Student\u2019s t";
}

void replace_all(std::string& text, const std::string& part, const std::string& other) {
    for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + other.size()))
        text.replace(i, part.size(), other);
}

std::string for_latex(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\\')
            escaped += "\\textbackslash{}";
        else if (c == '~' || c == '^')
            escaped += fmt::format("\\{}{{}}", c);
        else if (std::string_view("#$%&_{}").find(c) != std::string_view::npos)
            escaped += fmt::format("\\{}", c);
        else
            escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    const std::pair<const char*, const char*> signs[] = {
        {"\u0393", "$\\Gamma$"},   {"\u00b5", "$\\mu$"}, {"\u2212", "$-$"},      {"\u2265", "$\\ge$"},
        {"\u2191", "$\\uparrow$"}, {"\u2019", "'"},      {"\u00b7", "$\\cdot$"}, {"\u00b1", "$\\pm$"}};
    for (const auto& [sign, words] : signs) replace_all(escaped, sign, words);
    return escaped;
}

}  // namespace

const char* name_of(SeedAverage average) {
    return average == SeedAverage::median ? "median" : average == SeedAverage::share ? "share" : "mean";
}

std::vector<std::string> legend_sentences(SeedAverage average, const std::vector<ChartSeries>& series) {
    const Seen seen(series);
    if (seen.most == 0) return {};
    std::vector<std::string> all{points_sentence(average, seen)};
    if (const std::string bars = bars_sentence(average, seen); !bars.empty()) all.push_back(bars);
    if (seen.cut) all.emplace_back("Bars are cut off at zero, since the quantity cannot be negative");
    if (seen.rings) all.emplace_back("Small rings are the single seeds");
    if (seen.gaps)
        all.emplace_back(
            "Open symbols have a number beside them, such as 1 of 3: the measure came up in so many seeds");
    if (seen.some) all.emplace_back("Those without \u2191 are means of these seeds alone");
    if (seen.bounds)
        all.emplace_back(
            "\u2191 and \u2265 stand at a lower bound: what did not come up by the end of a run comes later");
    if (series.size() > 1) all.emplace_back("Points of several series stand a little aside of each other");
    return all;
}

std::string chart_caption(const Study& study, const StudyChart& chart,
                          const std::vector<ChartSeries>& series) {
    std::string text = chart.title.empty() ? "" : chart.title + ": ";
    text += fmt::format("{} against {}.", y_title(study, chart), x_title(study, chart));
    for (const std::string& sentence : legend_sentences(study.measures[chart.y].average, series))
        text += " " + sentence + ".";
    if (study.search && study.search->found && chart.y == study.search->measure)
        text += " The broken line is the wanted value, the grey band what is left of the range.";
    if (chart.reference) text += fmt::format(" Black open circles: {}.", chart.reference_label);
    return for_latex(text) + "\n";
}

}  // namespace grainreel
