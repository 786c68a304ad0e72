#include "render/app/study/page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/lists.hpp"
#include "render/app/study/results/drawing.hpp"
#include "render/app/study/results/points.hpp"
#include "render/app/study/results/summary.hpp"
#include "render/app/study/results/warnings.hpp"
#include "render/page/embed.hpp"

namespace grainreel {
namespace {

using Status = MemberResult::Status;

constexpr std::size_t most_warnings = 20;  // warnings that the page lists

constexpr const char* style = R"(
:root { color-scheme: light dark; --line: #8886; }
body { font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 72rem; padding: 1rem; }
h1 { font-size: 1.6rem; line-height: 1.2; } h2 { font-size: 1.2rem; margin-top: 2rem; }
.charts { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 28rem), 1fr)); }
.members { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 15rem), 1fr)); }
figure { margin: 0; border: 1px solid var(--line); border-radius: 4px; overflow: hidden; }
figure img, figure video { display: block; width: 100%; height: auto; background: white; }
figcaption { padding: .4rem .6rem; font-size: .9rem; overflow-wrap: anywhere; }
.table { overflow-x: auto; } table { border-collapse: collapse; }
.charts img { background: white; }
th, td { padding: .3rem .7rem; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap; }
th { min-width: 6rem; vertical-align: bottom; white-space: normal; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
li { overflow-wrap: anywhere; }
@media (prefers-color-scheme: dark) {
body { background: #12151b; color: #e8eaee; } a { color: #8cc4ff; }
.charts img { filter: invert(.9) hue-rotate(180deg); }
}
@media print {
:root { color-scheme: light; }
body { max-width: none; padding: 0; font-size: 10pt; background: white; color: black; }
.charts { grid-template-columns: 1fr 1fr; } .members { grid-template-columns: repeat(3, 1fr); }
.charts img { filter: none; }
figure, tr { break-inside: avoid; } h2 { break-after: avoid; }
.table { overflow: visible; } table { font-size: 8pt; width: 100%; } th, td { padding: .15rem .35rem; }
td { white-space: nowrap; } th { min-width: 0; } thead { display: table-header-group; }
a { color: inherit; text-decoration: none; } .no-print { display: none; }
}
)";

std::size_t count_of(const std::vector<MemberResult>& results, Status status) {
    return static_cast<std::size_t>(std::count_if(results.begin(), results.end(),
                                                  [&](const MemberResult& r) { return r.status == status; }));
}

std::string summary(const Study& study, const std::vector<MemberResult>& results) {
    std::string text = fmt::format("{} of {} of {} complete", count_of(results, Status::complete),
                                   counted(results.size(), "member"), study.scene.filename().string());
    if (const std::size_t failed = count_of(results, Status::failed); failed > 0)
        text += fmt::format(", {} failed", failed);
    const std::size_t left = count_of(results, Status::missing) + count_of(results, Status::incomplete);
    if (left > 0) text += fmt::format(", {} are not there yet", left);
    return text + ".";
}

// What is seen on a chart: for each series its first and its last point.
std::string chart_words(const Study& study, const StudyChart& chart, const std::vector<ChartSeries>& all) {
    const Variation& axis = study.variations[chart.x];
    const auto words = [](const SeedSummary& y) {
        const std::string some = came_up_text(y);
        return summary_text(y) + (some.empty() ? "" : " (" + some + ")");
    };
    const auto place = [&](double x) {
        return axis.numeric ? fmt::format("{:.4g}", x) : axis.values.at(static_cast<std::size_t>(x)).words;
    };
    std::string text = fmt::format("A chart of {} against {}", y_title(study, chart), x_title(study, chart));
    const char* between = ": ";
    for (const ChartSeries& series : all) {
        std::vector<ChartPoint> points = series.points;
        std::erase_if(points, [](const ChartPoint& point) { return !point.y.is_seen(); });
        if (points.empty()) continue;
        text += between + (series.name.empty() ? "" : "for " + series.name + " ");
        text += fmt::format("{} at {}", words(points.front().y), place(points.front().x));
        if (points.size() > 1)
            text += fmt::format(", {} at {}", words(points.back().y), place(points.back().x));
        between = "; ";
    }
    return text;
}

// A sentence for each chart in which no member has a value.
std::string charts_without_points(const Study& study, const std::vector<Member>& members,
                                  const std::vector<MemberResult>& results) {
    std::string text;
    for (const StudyChart& chart : study.charts) {
        bool seen = false;
        for (const ChartSeries& series : chart_series(study, members, results, chart))
            for (const ChartPoint& point : series.points)
                seen = seen || point.y.is_seen() || point.y.members == 0;
        if (!seen)
            text += fmt::format("<p>No chart of {}: it came up in no member.</p>\n",
                                html_text(y_title(study, chart)));
    }
    return text;
}

// What the marks of all charts are, each sentence once.
std::string legend_of(const Study& study, const std::vector<Member>& members,
                      const std::vector<MemberResult>& results) {
    std::vector<std::string> sentences;
    std::string text;
    for (const StudyChart& chart : study.charts)
        for (const std::string& sentence : legend_sentences(study.measures[chart.y].average,
                                                            chart_series(study, members, results, chart))) {
            if (contains(sentences, sentence)) continue;
            sentences.push_back(sentence);
            text += html_text(sentence) + ". ";
        }
    return text.empty() ? "" : "<p>" + text + "</p>\n";
}

std::string chart_figures(const Study& study, const std::vector<Member>& members,
                          const std::vector<MemberResult>& results, const std::vector<std::string>& stems) {
    std::string text;
    for (const StudyChart& chart : study.charts) {
        const std::string stem = chart_stem(chart);
        if (!contains(stems, stem)) continue;
        const std::vector<ChartSeries> series = chart_series(study, members, results, chart);
        text += fmt::format(
            "<figure><a href=\"charts/{0}.svg\"><img src=\"charts/{0}.svg\" alt=\"{1}\"></a><figcaption "
            "class=\"no-print\"><a href=\"charts/{0}.csv\">table</a>, <a "
            "href=\"charts/{0}.png\">PNG</a></figcaption></figure>\n",
            html_text(stem), html_text(chart_words(study, chart, series)));
    }
    text += charts_without_points(study, members, results);
    if (text.empty()) return "";
    return fmt::format("<h2>Charts</h2>\n{}<div class=\"charts\">\n{}</div>\n",
                       legend_of(study, members, results), text);
}

// The index of the first member of each setting, in the order of settings.
std::vector<std::size_t> first_members(const std::vector<Member>& members) {
    std::vector<std::size_t> firsts;
    for (std::size_t m = 0; m < members.size(); ++m)
        if (members[m].seed_index == 0) firsts.push_back(m);
    return firsts;
}

// What the numbers of the table are, where it needs saying.
std::string table_words(const Study& study, const std::vector<std::vector<SeedSummary>>& columns) {
    std::string text;
    if (!study.has_intervals()) text += "One seed for each setting, so means and medians have no interval. ";
    bool brackets = false, cut = false;
    for (const std::vector<SeedSummary>& column : columns)
        for (const SeedSummary& one : column) {
            brackets = brackets || (std::isnan(one.value) && std::isfinite(one.of_some) && !one.is_bound);
            cut = cut || one.cut_at_zero;
        }
    if (study.has_intervals() && study.joins_by(SeedAverage::mean)) text += "\u00b1 is a 95 % interval. ";
    if (study.joins_by(SeedAverage::median))
        text += "A median has an interval from six seeds on, and is known while more than half came up. ";
    if (brackets) text += "A number in brackets is the mean of the seeds in which the measure came up. ";
    if (cut) text += "Intervals of what cannot be negative are cut off at zero. ";
    return text.empty() ? "" : "<p>" + text + "</p>\n";
}

std::string settings_table(const Study& study, const std::vector<Member>& members,
                           const std::vector<MemberResult>& results) {
    if (study.measures.empty()) return "";
    std::string text = "<h2>Settings</h2>\n<div class=\"table\"><table>\n<thead><tr>";
    for (const Variation& variation : study.variations)
        text += fmt::format("<th>{}</th>", html_text(variation.shown));
    for (const StudyMeasure& measure : study.measures)
        text += fmt::format("<th>{}{}</th>", html_text(measure.title()),
                            measure.average == SeedAverage::median ? "<br><small>median</small>" : "");
    text += "<th>complete</th></tr></thead>\n";
    const std::vector<std::size_t> firsts = first_members(members);
    std::vector<std::vector<SeedSummary>> columns(study.measures.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
        for (const std::size_t m : firsts)
            columns[i].push_back(scaled(setting_summary(study, members, results, members[m].setting, i),
                                        study.measures[i].shown().factor));
    std::vector<std::vector<std::string>> cells;
    for (const std::vector<SeedSummary>& column : columns) cells.push_back(column_texts(column));
    for (std::size_t row = 0; row < firsts.size(); ++row) {
        const std::size_t m = firsts[row];
        text += "<tr>";
        for (std::size_t i = 0; i < study.variations.size(); ++i)
            text += fmt::format("<td>{}</td>", html_text(study.variations[i].values[members[m].at[i]].words));
        for (std::size_t i = 0; i < study.measures.size(); ++i) {
            const std::string some = came_up_text(columns[i][row]);
            text += fmt::format("<td class=\"number\">{}{}</td>", cells[i][row],
                                some.empty() ? "" : "<br><small>" + some + "</small>");
        }
        text += fmt::format("<td class=\"number\">{} of {}</td></tr>\n",
                            setting_complete(members, results, members[m].setting),
                            study.seed_count(members[m].at));
    }
    return text + "</table></div>\n" + table_words(study, columns);
}

// The film of a member or its poster, whichever is there.
std::string picture_of(const Member& member, const StudyFolder& folder, const std::string& about) {
    const std::string inside = "members/" + member.name + "/";
    const bool own = std::filesystem::exists(folder.member(member) / "poster.png");
    const std::string poster = own ? inside + "poster.png" : "posters/" + member.name + ".png";
    for (const char* film : {"movie.mp4", "movie.webm"})
        if (std::filesystem::exists(folder.member(member) / film))
            return fmt::format("<video controls preload=\"none\" poster=\"{}\" src=\"{}{}\"></video>",
                               html_text(poster), html_text(inside), film);
    if (!own && !std::filesystem::exists(folder.poster(member))) return "";
    return fmt::format("<a href=\"{0}\"><img loading=\"lazy\" src=\"{0}\" alt=\"{1}\"></a>",
                       html_text(poster), html_text("End of the run: " + about));
}

std::string posters(const Study& study, const std::vector<Member>& members, const StudyFolder& folder) {
    std::string text;
    for (const std::size_t m : first_members(members)) {
        const std::string setting = shown_setting(study, members[m]);
        const std::string about = members[m].seed ? fmt::format("{}{}seed {}", setting,
                                                                setting.empty() ? "" : ", ", *members[m].seed)
                                                  : setting;
        const std::string picture = picture_of(members[m], folder, about);
        if (!picture.empty())
            text +=
                fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", picture, html_text(about));
    }
    return text.empty() ? "" : fmt::format("<h2>Members</h2>\n<div class=\"members\">\n{}</div>\n", text);
}

std::string failures(const Study& study, const std::vector<Member>& members,
                     const std::vector<MemberResult>& results) {
    std::string text;
    for (std::size_t m = 0; m < members.size(); ++m)
        if (results[m].status == Status::failed)
            text += fmt::format("<li>{}: {}</li>\n", html_text(member_text(study, members[m])),
                                html_text(results[m].error));
    return text.empty() ? "" : fmt::format("<h2>Failed</h2>\n<ul>\n{}</ul>\n", text);
}

std::string warnings(const Study& study, const std::vector<Member>& members,
                     const std::vector<MemberResult>& results) {
    const std::vector<SharedWarning> all = shared_warnings(results);
    std::string text;
    for (std::size_t i = 0; i < std::min(all.size(), most_warnings); ++i)
        text += fmt::format("<li>{} ({})</li>\n", html_text(all[i].text),
                            html_text(members_text(study, members, all[i].members)));
    if (all.size() > most_warnings)
        text += fmt::format("<li>and {} more, which stand in run.json of the members</li>\n",
                            all.size() - most_warnings);
    return text.empty() ? "" : fmt::format("<h2>Warnings</h2>\n<ul>\n{}</ul>\n", text);
}

std::string methods_part(const Methods& methods) {
    if (methods.paragraph.empty()) return "";
    return fmt::format(
        "<h2>Methods</h2>\n<p>{}</p>\n<p>All parameters of all settings: <a "
        "href=\"parameters.csv\">parameters.csv</a>. The sources as BibTeX: <a "
        "href=\"sources.bib\">sources.bib</a>; the paragraph alone: <a "
        "href=\"methods.txt\">methods.txt</a>.</p>\n",
        html_text(methods.paragraph));
}

}  // namespace

std::string study_page(const Study& study, const std::vector<Member>& members,
                       const std::vector<MemberResult>& results, const StudyFolder& folder,
                       const std::vector<std::string>& charts, const std::vector<std::string>& notes,
                       const Methods& methods) {
    std::string told;
    for (const std::string& note : notes) told += fmt::format("<p>{}.</p>\n", html_text(note));
    return fmt::format(
               "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
               "name=\"viewport\" "
               "content=\"width=device-width, "
               "initial-scale=1\">\n<title>{0}</title>\n<style>{1}</style>\n</head>\n"
               "<body>\n<h1>{0}</h1>\n<p>{2} All of them: <a href=\"study.csv\">study.csv</a>, a row for "
               "each; a row for each setting: <a "
               "href=\"settings.csv\">settings.csv</a>.</p>\n",
               html_text(study.title), style, html_text(summary(study, results))) +
           chart_figures(study, members, results, charts) + settings_table(study, members, results) + told +
           methods_part(methods) + posters(study, members, folder) + failures(study, members, results) +
           warnings(study, members, results) + "</body>\n</html>\n";
}

}  // namespace grainreel
