// The words and plots around panels: blocks that hold for all panels, and blocks of single panels.
#include "render/picture/panels/panel_words.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/measure/columns.hpp"
#include "render/picture/words/caption_band.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// Shares of the picture's width.
constexpr double longest_bar = 0.14, common_colour_bar = 0.2, common_marks = 0.17;
constexpr int pace_lines = 4;

// Writes what is true of the drives in all panels; what differs is in their captions. frame: null to measure
// the longest lines.
TextSize common_drive(const Writer& writer, const FilmedScene& scene, const Common& common,
                      const State* frame, double x, double y) {
    const WordKinds& kinds = scene.film.word_kinds;
    State shown = frame ? *frame : State();
    if (!scene.drive.present) shown.cycles = scene.drive.ramp;  // drives may grow at different rates
    TextSize size;
    if (kinds.shaking) {
        const ShakingParts parts{common.frequency, common.g_level};
        const std::string numbers = kinds.drive ? ""
                                    : frame     ? shaking_text(scene, shown, parts)
                                                : longest_shaking_text(scene, parts);
        size = shaking_block(writer, scene, numbers, nullptr, x, y);
    }
    if (!kinds.drive) return size;
    std::vector<std::string> lines = frame ? drive_lines(scene, shown) : longest_drive_lines(scene);
    const bool levels = scene.gravity.norm() > 0;
    const auto keep = [&](std::size_t from_end, bool wanted) {
        if (!wanted) lines.erase(lines.end() - static_cast<std::ptrdiff_t>(from_end));
    };
    if (!scene.drive.changes()) {
        keep(levels ? 3 : 2, common.frequency);
        if (levels) keep(2, common.g_level);
        keep(1, common.amplitude);
    }
    for (const std::string& line : lines) {
        writer.write_below(size, x, y, line, writer.main(), writer.palette.ink);
    }
    return size;
}

WordBlock dial(const Writer& measure, const Drive& drive) {
    const double radius = 2.2 * measure.type.main;
    return {dial_block(measure, drive, nullptr, radius, 0, 0), true,
            [drive, radius](const Writer& on, double x, double y, const Shot& frame, const std::string&) {
                dial_block(on, drive, nullptr, radius, x, y);
                dial_block(on, drive, &frame, radius, x, y);
            }};
}

// common_marks_of() gives the kinds of marks that mean the same in all panels, own_marks_of() the others.
// scale: pixels a metre; 0 where panels have scales of their own.
MarkKinds common_marks_of(const Common& common, double scale) {
    MarkKinds kinds = common.marks;
    kinds.arrows = kinds.arrows && scale > 0;
    kinds.wall_forces = kinds.wall_forces && scale > 0;
    return kinds;
}
MarkKinds own_marks_of(const Common& common, double scale) {
    const MarkKinds kinds = common_marks_of(common, scale);
    return {!kinds.arrows, !kinds.streamlines, !kinds.wall_forces,
            !kinds.trails, !kinds.chains,      !kinds.rings};
}

WordBlock playback_block(const Writer& measure, const Film& film) {
    const double wrap = 13 * measure.type.minor;
    const TextSize line = measure.write(0, 0, "1 frame", measure.minor(), measure.palette.faint_ink);
    return {
        {wrap, 3 * line.height},
        true,
        [film, wrap](const Writer& on, double x, double y, const Shot& frame, const std::string& playback) {
            on.write(x, y, playback_text(film, frame, playback), on.minor(), on.palette.faint_ink, wrap, 3);
        }};
}

// The captions that all scenes share, in a row of their own. end: simulated time (s) at which they end.
WordBlock captions_block(const Writer& measure, const Film& film, double end, double width) {
    const double inner = width - 2 * measure.type.margin;
    const CaptionPlan plan = plan_captions(film, inner);
    return {{inner, static_cast<double>(plan.band())},
            true,
            [film, plan, inner, end](const Writer& on, double x, double y, const Shot& frame,
                                     const std::string&) {
                cairo_save(on.on);
                cairo_translate(on.on, x, y);
                draw_caption(on, plan, caption_at(film, end, frame), inner);
                cairo_restore(on.on);
            }};
}

}  // namespace

std::vector<WordBlock> common_blocks(const Writer& measure, const std::vector<Panel>& panels,
                                     const Common& common, double scale, const Film& whole) {
    const double width = whole.width;
    FilmedScene scene = panels.front().scene;
    scene.drive.present = common.clock;
    const WordKinds& kinds = scene.film.word_kinds;
    std::vector<WordBlock> blocks;
    if (common.captions) {
        Film film = scene.film;
        film.width = whole.width, film.height = whole.height;
        blocks.push_back(captions_block(measure, film, scene.run.duration, width));
    }
    blocks.push_back({widest_clock(measure, scene), true,
                      [scene](const Writer& on, double x, double y, const Shot& frame, const std::string&) {
                          clock_block(on, scene, frame, x, y);
                      }});
    if (common.clock && kinds.dial) blocks.push_back(dial(measure, scene.drive));
    if (common.frequency || common.g_level || common.amplitude) {
        blocks.push_back(
            {common_drive(measure, scene, common, nullptr, 0, 0),
             scene.drive.changes() || drive_lines_change(scene.drive),
             [scene, common](const Writer& on, double x, double y, const Shot& frame, const std::string&) {
                 common_drive(on, scene, common, &frame, x, y);
             }});
    }
    if (common.exaggerated && scene.film.exaggerate != 1) {
        blocks.push_back({exaggeration_block(measure, scene.film, 0, 0), false,
                          [film = scene.film](const Writer& on, double x, double y, const Shot&,
                                              const std::string&) { exaggeration_block(on, film, x, y); }});
    }
    if (common.playback && kinds.playback) blocks.push_back(playback_block(measure, scene.film));
    if (common.species) {
        blocks.push_back({legend_block(measure, scene, 0, 0, 0), false,
                          [scene](const Writer& on, double x, double y, const Shot&, const std::string&) {
                              legend_block(on, scene, x, y, 0);
                          }});
    }
    if (common.colours && has_colour_bar(scene.film)) {
        const double wide = common_colour_bar * width;
        blocks.push_back({colour_bar_block(measure, scene, 0, 0, wide), false,
                          [scene, wide](const Writer& on, double x, double y, const Shot&,
                                        const std::string&) { colour_bar_block(on, scene, x, y, wide); }});
    }
    const double wrap = std::max(common_marks * width, 15 * measure.type.minor);
    const FilmedScene marked = marked_by(scene, common_marks_of(common, scale));
    const double pixels = std::max(scale, 1.0);
    if (const TextSize size = marks_block(measure, marked, pixels, 0, 0, wrap); size.height > 0) {
        blocks.push_back(
            {size, false,
             [marked, pixels, wrap](const Writer& on, double x, double y, const Shot&, const std::string&) {
                 marks_block(on, marked, pixels, x, y, wrap);
             }});
    }
    if (scale > 0 && kinds.scale) {
        // The block is as wide as the bar may get, since the rows must not depend on the scale.
        const double longest = longest_bar * width;
        blocks.push_back({{longest, scale_block(measure, scale, 0, 0, longest).height},
                          false,
                          [scale, longest](const Writer& on, double x, double y, const Shot&,
                                           const std::string&) { scale_block(on, scale, x, y, longest); }});
    }
    std::erase_if(blocks, [](const WordBlock& block) { return block.size.height <= 0; });
    return blocks;
}

double flow(std::vector<WordBlock>& blocks, const TypeScale& type, double width) {
    if (blocks.empty()) return 0;
    const double inner = width - 2 * type.margin, gap = 2 * type.gap;
    double y = 0.5 * type.margin;
    for (std::size_t first = 0; first < blocks.size();) {
        double used = blocks[first].size.width, height = blocks[first].size.height;
        std::size_t next = first + 1;
        for (; next < blocks.size() && used + gap + blocks[next].size.width <= inner; ++next) {
            used += gap + blocks[next].size.width;
            height = std::max(height, blocks[next].size.height);
        }
        // The row stands in the middle. Its blocks are a little apart where there is room.
        const auto gaps = static_cast<double>(next - first - 1);
        const double more = gaps > 0 ? std::min((inner - used) / gaps, 3 * type.main) : 0;
        double x = type.margin + 0.5 * (inner - used - gaps * more);
        for (; first < next; ++first) {
            blocks[first].x = x;
            blocks[first].y = y;
            x += blocks[first].size.width + gap + more;
        }
        y += height + type.gap;
    }
    return y - type.gap + 0.5 * type.margin;
}

double notes_height(const Writer& measure, const std::vector<Panel>& panels, double width) {
    double height = 0;
    for (const Panel& panel : panels)
        for (const std::string& note : longest_panel_notes(panel.scene))
            height = std::max(height, note_block(measure, note, 0, 0, width, panel_note_lines).height);
    return height;
}

std::string panel_note(const FilmedScene& scene, const Shot& frame) {
    return joined(note_text(scene, frame), caption_at(scene.film, scene.run.duration, frame));
}

std::vector<std::string> longest_panel_notes(const FilmedScene& scene) {
    const std::string note = longest_note(scene);
    std::vector<std::string> notes;
    if (!note.empty()) notes.push_back(note);
    if (scene.film.word_kinds.captions)
        for (const FilmCaption& caption : scene.film.captions)
            notes.push_back(joined(note, longest_caption(caption)));
    return notes;
}

double pace_height(const Writer& measure, const std::vector<Panel>& panels, const Common& common,
                   double width) {
    double height = 0;
    if (common.playback) return height;
    for (const Panel& panel : panels) {
        if (!panel.scene.film.word_kinds.playback) continue;
        for (const std::string& words : panel.playback)
            height = std::max(height, pace_block(measure, words, width).height);
    }
    return height;
}

TextSize pace_block(const Writer& writer, const std::string& words, double width) {
    return write_in_middle(writer, words, writer.minor(), writer.palette.faint_ink, width, pace_lines);
}

TextSize write_in_middle(const Writer& writer, const std::string& text, const TextStyle& style,
                         const Colour& colour, double width, int lines) {
    return writer.write(0, 0, text, {style.size, style.bold, true}, colour, width, lines);
}

TextSize caption_block(const Writer& writer, const std::string& caption, double width) {
    TextSize size;
    TextStyle style = writer.strong();
    style.centred = true;
    for (const std::string& line : lines_of(caption)) {
        writer.write_below(size, 0, 0, line, style, writer.palette.ink, width, 3);
        style = {writer.main().size, writer.main().bold, true};
    }
    return size;
}

namespace {

// Shares of a panel's width, for a scale bar and for a colour bar.
constexpr double longest_own_bar = 0.3, own_colour_bar = 0.7;

double own_bar_height(const Writer& measure, const Panel& panel, const Common& common) {
    if (common.colours) return 0;
    return colour_bar_block(measure, panel.scene, 0, 0, 1000).height;
}

}  // namespace

double foot_height(const Writer& measure, const std::vector<Panel>& panels, const Common& common, bool scales,
                   double width) {
    double row = 0, bar = 0, marks = 0;
    for (const Panel& panel : panels) {
        if (scales && panel.scene.film.word_kinds.scale)
            row = std::max(row, scale_block(measure, 1, 0, 0, 100).height);
        if (!common.species) row = std::max(row, legend_block(measure, panel.scene, 0, 0, 0).height);
        bar = std::max(bar, own_bar_height(measure, panel, common));
        const FilmedScene marked = marked_by(panel.scene, own_marks_of(common, scales ? 0 : 1));
        marks = std::max(marks, marks_block(measure, marked, 1, 0, 0, width).height);
    }
    return row + bar + marks;
}

void draw_foot(const Writer& writer, const Panel& panel, const Common& common, double scale, bool bar,
               double width) {
    const Writer measure{nullptr, writer.type, writer.palette};
    const double longest = longest_own_bar * width, gap = 3 * writer.type.gap;
    const bool scales = bar && panel.scene.film.word_kinds.scale;
    const TextSize legend = common.species ? TextSize{} : legend_block(measure, panel.scene, 0, 0, 0);
    const TextSize length = scales ? scale_block(measure, scale, 0, 0, longest) : TextSize{};
    const double both = legend.width + length.width + (legend.width > 0 && length.width > 0 ? gap : 0);
    double y = 0;
    if (own_bar_height(measure, panel, common) > 0)
        y = colour_bar_block(writer, panel.scene, 0.5 * (1 - own_colour_bar) * width, 0,
                             own_colour_bar * width)
                .height;
    const double x = 0.5 * (width - both);
    if (!common.species) legend_block(writer, panel.scene, x, y, 0);
    if (scales) scale_block(writer, scale, x + both - length.width, y, longest);
    y += std::max(legend.height, length.height);
    marks_block(writer, marked_by(panel.scene, own_marks_of(common, bar ? 0 : 1)), scale, 0, y, width);
}

namespace {

// The name of the quantity that a plot shows. Plots with the same name can be compared.
std::string quantity_of(const FilmPlot& plot) {
    return plot.is_profile() ? std::to_string(static_cast<int>(plot.profile)) + (plot.period ? "p" : "")
                             : plot.column;
}

// SI: the largest value that any panel expects. It decides the unit, so that all panels show the quantity in
// one unit.
double expected_of(const std::vector<Panel>& panels, const std::string& quantity) {
    double largest = 0;
    for (const Panel& panel : panels)
        for (const FilmPlot& plot : panel.scene.film.shows.plots)
            if (!plot.is_profile() && quantity_of(plot) == quantity)
                largest = std::max(largest, axis_of_column(panel.scene, plot.column).expected);
    return largest;
}

}  // namespace

PanelPlots::PanelPlots(const std::vector<Panel>& panels, const PanelLayout& layout, const TypeScale& type,
                       const Palette& palette) {
    TypeScale small = type;
    small.main = type.minor;
    double end = 0;
    for (const Panel& panel : panels) end = std::max(end, panel.scene.run.duration);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const std::vector<Rectangle>& places = layout.places[i].plots;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const FilmedScene& scene = panels[i].scene;
            const FilmPlot& plot = scene.film.shows.plots[k];
            plots_.push_back({make_side_plot(scene, plot, places[k], end, small, palette,
                                             expected_of(panels, quantity_of(plot))),
                              quantity_of(plot), places[k], i});
        }
    }
}

bool PanelPlots::take(const std::vector<ShotPtr>& frames) {
    bool changed = false;
    for (Placed& placed : plots_) changed |= placed.plot->take(*frames[placed.panel]);
    if (changed) share_limits();
    return changed;
}

void PanelPlots::share_limits() {
    for (Placed& placed : plots_) {
        std::optional<std::array<double, 2>> all;
        for (const Placed& other : plots_) {
            const auto own = other.plot->limits();
            if (other.quantity != placed.quantity || !own) continue;
            all = all ? std::array{std::min((*all)[0], (*own)[0]), std::max((*all)[1], (*own)[1])} : *own;
        }
        if (all) placed.plot->show(*all);
    }
}

}  // namespace grainreel
