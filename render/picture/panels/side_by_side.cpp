// Draws panels side by side: finds the layout of panels and words, which depend on each other, and draws what
// changes with each frame.
#include "render/picture/panels/side_by_side.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/base/error.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/pdf_page.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/panels/panel_words.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

double title_height(const Writer& measure, const Film& film) {
    const std::string title = shown_title(film);
    if (title.empty()) return 0.5 * measure.type.margin;
    const double inner = film.width - 2 * measure.type.margin;
    return measure.write(0, 0, title, measure.title(), measure.palette.ink, inner, 2).height +
           measure.type.margin;
}

double caption_height(const Writer& measure, const std::vector<Panel>& panels, double width) {
    double height = 0;
    for (const Panel& panel : panels) {
        if (panel.caption.empty() || !panel.scene.film.word_kinds.captions) continue;
        height = std::max(height, caption_block(measure, panel.caption, width).height);
    }
    return height > 0 ? height + 0.3 * measure.type.gap : 0;
}

FilmedScene panel_scene(const Panel& panel, const PanelLayout::Place& place, const Film& film) {
    FilmedScene scene = panel.scene;
    scene.film.width = place.port.width;
    scene.film.height = place.port.height;
    scene.film.background = film.background;
    scene.film.transparent = film.transparent;
    for (CameraKey& key : scene.film.camera.keys)
        if (key.zoom) *key.zoom *= place.zoom / scene.film.camera.zoom;
    scene.film.camera.zoom = place.zoom;
    return scene;
}

// The whole pixels around a block, and `beyond` pixels more on each side.
Rectangle whole_pixels(const WordBlock& block, const Rectangle& within, int beyond) {
    const int x = std::max(0, static_cast<int>(std::floor(block.x)) - beyond),
              y = std::max(0, static_cast<int>(std::floor(block.y)) - beyond);
    const int right = static_cast<int>(std::ceil(block.x + block.size.width)) + 2 + beyond;
    const int low = static_cast<int>(std::ceil(block.y + block.size.height)) + 2 + beyond;
    return {within.x + x, within.y + y, std::min(right, within.width) - x, std::min(low, within.height) - y};
}

}  // namespace

PanelLayout layout_of(const std::vector<Panel>& panels, const Film& film) {
    const TypeScale type = panel_type(film);
    const Palette palette = palette_of(film);
    const Writer measure{nullptr, type, palette};
    const Common common = common_of(panels);
    WordHeights words;
    words.top = title_height(measure, film);
    std::vector<WordBlock> blocks = common_blocks(measure, panels, common, 1, film);
    words.bottom = flow(blocks, type, film.width);
    // Words wrap at the width of the panels, and the panels depend on the height of the words. So this is
    // repeated until panels become no narrower. scales: whether each panel has a scale of its own.
    bool scales = false;
    const std::vector<Panel> own = without_common(panels, common);
    for (double width = film.width, foot_width = film.width;;) {
        words.caption = caption_height(measure, panels, width);
        words.pace = pace_height(measure, panels, common, width);
        words.note = notes_height(measure, own, width);
        words.foot = foot_height(measure, panels, common, scales, foot_width);
        PanelLayout layout = plan_panels(panels, film, words);
        if (layout.places.empty()) return layout;
        const PanelLayout::Place& place = layout.places.front();
        if (place.caption.width >= width && place.foot.width >= foot_width && (scales || layout.scale > 0))
            return layout;
        width = std::min<double>(width, place.caption.width);
        foot_width = std::min<double>(foot_width, place.foot.width);
        scales = scales || layout.scale == 0;
    }
}

struct SideBySide::Impl {
    Impl(const std::vector<Panel>& panels, const Film& film, int raster_threads, gl::Provider provider);

    // Draws a part of the picture anew: it is made blank, and then write(Writer) fills it.
    template <class Write>
    void renew(const Rectangle& part, const Write& write);
    void write_still_words();
    void write_all_words(const std::vector<ShotPtr>& frames, std::size_t segment, std::size_t clock);
    void write_changing_words(const Shot& frame, const std::string& playback);
    void write_note(std::size_t panel, const Shot& frame);
    const std::string& pace_of(std::size_t panel, std::size_t segment) const;
    void write_pace(std::size_t panel, const std::string& words);
    void draw_plots(const std::vector<ShotPtr>& frames);

    const std::vector<Panel> panels;
    const Film film;
    const bool clear;  // whether the background is transparent
    Palette palette;
    TypeScale type;
    Common common;
    PanelLayout layout;
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<WordBlock> blocks;
    PanelPlots plots;
    std::vector<FilmedScene> scenes;                 // one for each panel
    std::vector<std::vector<std::string>> playback;  // captions of time of each panel in each segment
    std::vector<std::string> notes, paces;           // words that are in the picture now
    bool plots_drawn = false;
    Picture picture;
    PdfPage* page = nullptr;  // words are drawn on it while there is one
};

SideBySide::Impl::Impl(const std::vector<Panel>& all, const Film& whole, int raster_threads,
                       gl::Provider provider)
    : panels(all),
      film(whole),
      clear(film.transparent),
      palette(palette_of(film)),
      type(panel_type(film)),
      common(common_of(panels)),
      layout(layout_of(panels, film)),
      plots(panels, layout, type, palette),
      picture(film.width, film.height) {
    GRAINREEL_CHECK(layout.places.size() == panels.size());
    const std::vector<Panel> own = without_common(panels, common);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const FilmedScene scene = panel_scene(own[i], layout.places[i], film);
        scenes.push_back(scene);
        playback.push_back(panels[i].playback);
        renderers.push_back(
            std::make_unique<Renderer>(scene, bare_layout(scene.film), raster_threads, provider));
    }
    const Writer measure{nullptr, type, palette};
    std::vector<Panel> drawn = panels;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        drawn[i].scene = scenes[i];
        drawn[i].scene.film.captions = panels[i].scene.film.captions;
    }
    blocks = common_blocks(measure, drawn, common, layout.scale, film);
    flow(blocks, type, film.width);
    renew({0, 0, film.width, film.height}, [](const Writer&) {});
    write_still_words();
}

template <class Write>
void SideBySide::Impl::renew(const Rectangle& part, const Write& write) {
    if (part.width <= 0 || part.height <= 0) return;
    if (page) return draw_part(page->on(), part, [&] { write(Writer{page->on(), type, palette}); });
    const CairoSurface surface = blank_surface(part, palette.background, clear ? 0 : 1);
    const CairoContext on(cairo_create(surface.get()));
    write(Writer{on.get(), type, palette});
    const Rectangle all{0, 0, part.width, part.height};
    if (clear)
        copy_part_on_halo(surface.get(), all, part.x, part.y, halo_of(type, palette), picture);
    else
        copy_part(surface.get(), all, part.x, part.y, picture);
}

void SideBySide::Impl::write_still_words() {
    renew(layout.top, [&](const Writer& on) {
        const std::string title = shown_title(film);
        if (title.empty()) return;
        cairo_translate(on.on, 0, 0.6 * type.margin);
        write_in_middle(on, title, on.title(), palette.ink, film.width, 2);
    });
    renew(layout.bottom, [&](const Writer& on) {
        for (const WordBlock& block : blocks)
            if (!block.changes) block.draw(on, block.x, block.y, Shot(), "");
    });
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const PanelLayout::Place& place = layout.places[i];
        renew(place.caption, [&](const Writer& on) {
            if (!scenes[i].film.word_kinds.captions) return;
            caption_block(on, panels[i].caption, place.caption.width);
        });
        const double scale = framed_scale(scenes[i], bare_layout(scenes[i].film));
        renew(place.foot, [&](const Writer& on) {
            draw_foot(on, {scenes[i], panels[i].caption}, common, scale, layout.scale == 0, place.foot.width);
        });
    }
}

void SideBySide::Impl::write_changing_words(const Shot& frame, const std::string& words) {
    const int beyond = clear ? static_cast<int>(std::ceil(halo_of(type, palette).reach)) + 1 : 0;
    for (const WordBlock& block : blocks) {
        if (!block.changes) continue;
        const Rectangle part = whole_pixels(block, layout.bottom, beyond);
        renew(part, [&](const Writer& on) {
            block.draw(on, block.x + layout.bottom.x - part.x, block.y + layout.bottom.y - part.y, frame,
                       words);
        });
    }
}

void SideBySide::Impl::write_note(std::size_t panel, const Shot& frame) {
    const Rectangle& part = layout.places[panel].note;
    notes.resize(layout.places.size());
    std::string note = panel_note(scenes[panel], frame);
    if (part.height <= 0 || note == notes[panel]) return;
    const Writer measure{nullptr, type, palette};
    // Notes begin where the longest note would begin if centred, so that words do not move with their values.
    const auto width_of = [&](const std::string& text) {
        return note_block(measure, text, 0, 0, part.width - 2, panel_note_lines).width;
    };
    double widest = width_of(note);
    for (const std::string& longest : longest_panel_notes(scenes[panel]))
        widest = std::max(widest, width_of(longest));
    const double x = std::max(1.0, 0.5 * (part.width - widest));
    renew(part, [&](const Writer& on) { note_block(on, note, x, 0, part.width - 2, panel_note_lines); });
    notes[panel] = std::move(note);
}

const std::string& SideBySide::Impl::pace_of(std::size_t panel, std::size_t segment) const {
    static const std::string nothing;
    return segment < playback[panel].size() ? playback[panel][segment] : nothing;
}

void SideBySide::Impl::write_pace(std::size_t panel, const std::string& words) {
    paces.resize(layout.places.size());
    const Rectangle& part = layout.places[panel].pace;
    if (common.playback || words == paces[panel]) return;
    renew(part, [&](const Writer& on) { pace_block(on, words, part.width); });
    paces[panel] = words;
}

void SideBySide::Impl::draw_plots(const std::vector<ShotPtr>& frames) {
    if (!plots.take(frames) && plots_drawn) return;
    for (PanelPlots::Placed& placed : plots.all())
        renew(placed.place, [&](const Writer& on) { placed.plot->draw(on.on, 0, 0); });
    plots_drawn = true;
}

void SideBySide::Impl::write_all_words(const std::vector<ShotPtr>& frames, std::size_t segment,
                                       std::size_t clock) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
        write_note(i, *frames[i]);
        write_pace(i, playback_text(scenes[i].film, *frames[i], pace_of(i, segment)));
    }
    draw_plots(frames);
    write_changing_words(*frames[clock], pace_of(0, segment));
}

SideBySide::SideBySide(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                       gl::Provider provider)
    : impl_(std::make_unique<Impl>(panels, film, raster_threads, provider)) {}

SideBySide::~SideBySide() = default;

void SideBySide::start_from(const std::vector<ShotPtr>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) impl_->renderers.at(i)->start_from(*frames[i]);
}

void SideBySide::remember(const std::vector<ShotPtr>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) impl_->renderers.at(i)->remember(*frames[i]);
}

const Picture& SideBySide::draw(const std::vector<ShotPtr>& frames, std::size_t segment, std::size_t clock,
                                double film_time) {
    Impl& m = *impl_;
    GRAINREEL_CHECK(frames.size() == m.renderers.size() && clock < frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Picture& panel = m.renderers[i]->draw(*frames[i], "", film_time);
        const Rectangle& port = m.layout.places[i].port;
        for (int y = 0; y < port.height; ++y)
            std::memcpy(m.picture.pixel(port.x, port.y + y), panel.pixel(0, y),
                        static_cast<std::size_t>(port.width) * 4);
    }
    m.write_all_words(frames, segment, clock);
    return m.picture;
}

void SideBySide::draw_page(PdfPage& page, const std::vector<ShotPtr>& frames, std::size_t segment,
                           std::size_t clock, double film_time) {
    Impl& m = *impl_;
    GRAINREEL_CHECK(frames.size() == m.renderers.size() && clock < frames.size());
    if (!m.clear) fill_surface(page.on(), m.palette.background);
    for (std::size_t i = 0; i < frames.size(); ++i)
        draw_part(page.on(), m.layout.places[i].port,
                  [&] { m.renderers[i]->draw_page(page, *frames[i], "", film_time); });
    // What the picture says so far is forgotten, so all words are drawn.
    m.notes.clear();
    m.paces.clear();
    m.plots_drawn = false;
    m.page = &page;
    m.write_still_words();
    m.write_all_words(frames, segment, clock);
    m.page = nullptr;
}

const PanelLayout& SideBySide::layout() const {
    return impl_->layout;
}
std::string SideBySide::last_note() const {
    std::string notes;
    for (std::size_t i = 0; i < impl_->renderers.size(); ++i)
        if (const std::string note = impl_->renderers[i]->last_note(); !note.empty())
            notes += fmt::format("{}panel {}: {}", notes.empty() ? "" : "; ", i + 1, note);
    return notes;
}
std::string SideBySide::gl_description() const {
    return impl_->renderers.front()->gl_description();
}
std::string SideBySide::gl_note() const {
    return impl_->renderers.front()->gl_note();
}

}  // namespace grainreel
