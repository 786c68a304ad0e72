#include "render/run/compare/comparison_words.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "render/film/sampling/pacing.hpp"
#include "render/film/sampling/sampler.hpp"

namespace grainreel {

namespace {

bool of_schedule(const Comparison& all) {
    return std::all_of(all.sources.begin(), all.sources.end(), [](const auto& source) {
        return dynamic_cast<const LivePanel*>(source.get()) != nullptr;
    });
}

}  // namespace

// Its drive may be unlike that of the reference, and its moments then come otherwise; where it is like that,
// or does not matter, the segment says it best.
std::vector<std::string> playback_of(const ComparePanel& source, const Comparison& all) {
    const std::vector<FilmSegment>& segments = all.film.film.segments;
    const Drive &drive = source.scene().drive, &reference = all.sources[all.reference]->scene().drive;
    const std::vector<Frame> moments = source.moments(all.instants, segments);
    std::vector<std::string> captions;
    for (std::size_t k = 0; k < segments.size(); ++k) {
        std::vector<Frame> inside;
        for (std::size_t i = 0; i < moments.size(); ++i)
            if (all.instants[i].segment == static_cast<int>(k)) inside.push_back(moments[i]);
        const bool as_planned =
            of_schedule(all) && (segments[k].kind == FilmSegment::Kind::motion ||
                                 (drive.present && drive.frequency == reference.frequency));
        captions.push_back(as_planned ? playback_caption(segments[k], drive, all.film.film.rate)
                                      : pacing_caption(inside, drive, all.film.film.rate));
    }
    return captions;
}

void warn_of_pace(Comparison& all) {
    if (of_schedule(all)) return;
    std::set<std::string> said;
    for (const auto& source : all.sources) {
        const auto warning =
            pacing_warning(source->moments(all.instants, all.film.film.segments), source->scene().drive);
        if (warning && said.insert(*warning).second) all.warnings.push_back(*warning);
    }
}

void warn_of_what_is_left_out(const PanelLayout& layout, Comparison& all) {
    bool axes = false;
    for (const auto& source : all.sources) axes = axes || source->scene().film.axes;
    if (axes) all.warnings.emplace_back("film.axes: films side by side have no axes");
    if (!layout.plots_fit)
        all.warnings.push_back(
            fmt::format("--size: {}x{} has no room for plots under {} panels; they are left out",
                        all.film.film.width, all.film.film.height, all.panels.size()));
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
