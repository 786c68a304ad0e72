#include "render/film/compare/comparison_words.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "render/film/sampling/sampler.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/choice.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "render/picture/words/missing_letters.hpp"

namespace grainreel {

namespace {

// That the moments were chosen by.
const Clock& schedule_clock(const Comparison& all) {
    return all.members[all.reference]->clock();
}

// The smallest of this shape in which plots have room, as far as one looks; empty beyond.
std::string size_with_plots(const std::vector<Panel>& panels, Film film) {
    constexpr int parts = 8, most = 5;  // of the size; times the size
    const int width = film.width, height = film.height;
    for (int k = parts + 1; k <= most * parts; ++k) {
        film.width = (k * width + parts - 1) / parts / 2 * 2;
        film.height = (k * height + parts - 1) / parts / 2 * 2;
        const PanelLayout layout = layout_of(panels, film);
        if (!layout.places.empty() && layout.plots_fit) return fmt::format("{}x{}", film.width, film.height);
    }
    return "";
}

}  // namespace

// Its drive may be unlike that of the reference, and its moments then come otherwise; where it is like that,
// or does not matter, the segment says it best.
std::vector<std::string> playback_of(const FrameSource& source, const Comparison& all) {
    const std::vector<FilmSegment>& segments = all.pictures.segments;
    const Drive &drive = source.scene().drive, &reference = all.members[all.reference]->scene().drive;
    const std::vector<Frame> moments = source.moments(all.pictures);
    std::vector<std::string> captions;
    for (std::size_t k = 0; k < segments.size(); ++k) {
        std::vector<Frame> inside;
        for (std::size_t i = 0; i < moments.size(); ++i)
            if (all.pictures.instants[i].segment == static_cast<int>(k)) inside.push_back(moments[i]);
        const bool as_planned =
            all.by_schedule && (segments[k].kind == FilmSegment::Kind::motion ||
                                (drive.present && drive.frequency == reference.frequency));
        const double rate = all.film.film.rate;
        captions.push_back(as_planned
                               ? playback_caption(played(segments[k], rate, schedule_clock(all)), drive, rate)
                               : pacing_caption(inside, drive, rate));
    }
    return captions;
}

void warn_of_pace(Comparison& all) {
    if (all.by_schedule) return;
    std::set<std::string> said;
    for (const auto& member : all.members) {
        const auto warning = pacing_warning(member->source().moments(all.pictures), member->scene().drive);
        if (warning && said.insert(*warning).second) all.warnings.push_back(*warning);
    }
}

// Where the moments are those of a finished run, scenes that are run beside it show them too.
void warn_of_single_moments(Comparison& all) {
    std::set<std::string> said;
    for (const auto& member : all.members) {
        if (!member->archive()) continue;
        if (const auto warning = periods_warning(member->scene(), *member->archive());
            warning && said.insert(*warning).second)
            all.warnings.push_back(*warning);
    }
    const bool all_any = std::all_of(all.members.begin(), all.members.end(),
                                     [](const auto& member) { return member->source().supply().any_moment; });
    if (all.by_schedule && all_any) return;
    for (const auto& member : all.members) {
        if (!member->run()) continue;
        for (std::string& line :
             single_moment_warnings(member->scene(), "beside a finished run, frames are single moments"))
            all.warnings.push_back(std::move(line));
    }
}

void warn_of_missing_letters(Comparison& all) {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const Panel& panel : all.panels) {
        for (auto& text : texts_of_film(panel.scene)) texts.push_back(std::move(text));
        if (panel.scene.film.word_kinds.captions)
            texts.emplace_back("the captions of the panels", panel.caption);
    }
    if (std::string line = missing_letters_warning(texts); !line.empty())
        all.warnings.push_back(std::move(line));
}

void warn_of_what_is_left_out(const PanelLayout& layout, Comparison& all) {
    bool axes = false, words = false;
    for (const auto& member : all.members) {
        axes = axes || member->scene().film.axes;
        words = words || member->scene().film.words == WordPlace::none ||
                member->scene().film.words == WordPlace::plates;
    }
    if (axes) all.warnings.emplace_back("film.axes: films side by side have no axes");
    if (words) all.warnings.emplace_back("film.words: films side by side have their words beside the panels");
    if (layout.plots_fit) return;
    const Film& film = all.film.film;
    const std::string enough = size_with_plots(all.panels, film);
    all.warnings.push_back(fmt::format("{}: {}x{} has no room for plots under {} panels; they are left out{}",
                                       all.film.where("film.size"), film.width, film.height,
                                       all.panels.size(),
                                       enough.empty() ? "" : fmt::format(", and fit from {}", enough)));
}

std::string playback_of_all(const std::vector<Panel>& panels, std::size_t segment) {
    std::vector<std::string> all;
    for (const Panel& panel : panels) {
        const std::string words = panel.playback.at(segment);
        if (all.empty() || words != all.back()) all.push_back(words);
    }
    return fmt::format("{}", fmt::join(all, " | "));
}

}  // namespace grainreel
