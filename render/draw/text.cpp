#include "render/draw/text.hpp"

#include <pango/pangocairo.h>

namespace grainreel {
namespace {

struct Unref {
    void operator()(gpointer object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

struct FreeOptions {
    void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};

// One a thread, as font maps want it; to make one costs more than to write a word with it.
PangoContext* text_context() {
    thread_local const std::unique_ptr<PangoFontMap, Unref> map(
        pango_cairo_font_map_new_for_font_type(CAIRO_FONT_TYPE_FT));
    thread_local const std::unique_ptr<PangoContext, Unref> context = [] {
        std::unique_ptr<PangoContext, Unref> made(pango_font_map_create_context(map.get()));
        const std::unique_ptr<cairo_font_options_t, FreeOptions> options(cairo_font_options_create());
        cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
        cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
        cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
        pango_cairo_context_set_font_options(made.get(), options.get());
        pango_context_set_round_glyph_positions(made.get(), FALSE);
        return made;
    }();
    return context.get();
}

Layout make_layout(const std::string& text, const TextStyle& style, double wrap, int lines) {
    Layout layout(pango_layout_new(text_context()));
    PangoFontDescription* font = pango_font_description_new();
    pango_font_description_set_family(font, "DejaVu Sans");
    pango_font_description_set_weight(font, style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(font, style.size * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font);
    pango_font_description_free(font);
    pango_layout_set_text(layout.get(), text.c_str(), static_cast<int>(text.size()));
    if (wrap > 0) {
        pango_layout_set_width(layout.get(), static_cast<int>(wrap * PANGO_SCALE));
        pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
        pango_layout_set_height(layout.get(), -lines);
        pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_END);
    }
    return layout;
}

TextSize size_of(PangoLayout* layout) {
    PangoRectangle logical;
    pango_layout_get_extents(layout, nullptr, &logical);
    return {static_cast<double>(logical.width) / PANGO_SCALE,
            static_cast<double>(logical.height) / PANGO_SCALE};
}

}  // namespace

TextSize measure_text(const std::string& text, const TextStyle& style, double wrap, int lines) {
    return size_of(make_layout(text, style, wrap, lines).get());
}

TextSize draw_text(cairo_t* on, double x, double y, const std::string& text, const TextStyle& style,
                   const Colour& colour, double wrap, int lines) {
    const Layout layout = make_layout(text, style, wrap, lines);
    cairo_set_source_rgb(on, colour.red, colour.green, colour.blue);
    cairo_move_to(on, x, y);
    pango_cairo_show_layout(on, layout.get());
    return size_of(layout.get());
}

}  // namespace grainreel
