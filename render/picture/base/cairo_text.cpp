#include "render/picture/base/cairo_text.hpp"

#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>
#include <pango/pangofc-fontmap.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace grainreel {

namespace {

struct Unref {
    void operator()(gpointer object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

struct FreeOptions {
    void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};

struct DestroyConfig {
    void operator()(FcConfig* config) const { FcConfigDestroy(config); }
};
using Config = std::unique_ptr<FcConfig, DestroyConfig>;

// The two files that all words are written with, where distributions have them; null when they are not there.
Config own_fonts() {
    for (const std::string folder :
         {"/usr/share/fonts/truetype/dejavu/", "/usr/share/fonts/dejavu-sans-fonts/", "/usr/share/fonts/TTF/",
          "/usr/share/fonts/dejavu/"}) {
        Config config(FcConfigCreate());
        const auto add = [&](const char* name) {
            const std::string file = folder + name;
            return FcConfigAppFontAddFile(config.get(), reinterpret_cast<const FcChar8*>(file.c_str())) ==
                   FcTrue;
        };
        if (add("DejaVuSans.ttf") && add("DejaVuSans-Bold.ttf")) return config;
    }
    return nullptr;
}

// One a thread, as font maps want it; to make one costs more than to write a word with it. `own`: of the
// fonts by file, so that words do not depend on what else is installed; else of all the system's.
PangoContext* make_context(bool own) {
    const std::unique_ptr<PangoFontMap, Unref> map(
        pango_cairo_font_map_new_for_font_type(CAIRO_FONT_TYPE_FT));
    if (const Config config = own ? own_fonts() : nullptr)
        pango_fc_font_map_set_config(PANGO_FC_FONT_MAP(map.get()), config.get());
    PangoContext* made = pango_font_map_create_context(map.get());
    const std::unique_ptr<cairo_font_options_t, FreeOptions> options(cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(made, options.get());
    pango_context_set_round_glyph_positions(made, FALSE);
    return made;
}
using Context = std::unique_ptr<PangoContext, Unref>;
PangoContext* own_context() {
    thread_local const Context context(make_context(true));
    return context.get();
}
PangoContext* system_context() {
    thread_local const Context context(make_context(false));
    return context.get();
}

Layout layout_in(PangoContext* context, const std::string& text, const TextStyle& style, double wrap,
                 int lines) {
    Layout layout(pango_layout_new(context));
    PangoFontDescription* font = pango_font_description_new();
    pango_font_description_set_family(font, "DejaVu Sans");
    pango_font_description_set_weight(font, style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(font, style.size * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font);
    pango_font_description_free(font);
    pango_layout_set_text(layout.get(), text.c_str(), static_cast<int>(text.size()));
    if (style.centred) pango_layout_set_alignment(layout.get(), PANGO_ALIGN_CENTER);
    if (wrap > 0) {
        pango_layout_set_width(layout.get(), static_cast<int>(wrap * PANGO_SCALE));
        pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
        pango_layout_set_height(layout.get(), -lines);
        pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_END);
    }
    return layout;
}

constexpr double least_shrink = 0.7;  // of letters, before a word breaks

// The size at which the longest word is no wider than the lines, if that is not much smaller.
double size_for_words(const std::string& text, const TextStyle& style, double wrap) {
    const double longest = longest_word(text, style);
    if (wrap <= 0 || longest <= wrap || longest * least_shrink > wrap) return style.size;
    return 0.999 * style.size * wrap / longest;
}

// Letters that the fonts by file lack, as in a title in Chinese, come from the system's.
Layout make_layout(const std::string& text, const TextStyle& style, double wrap, int lines) {
    Layout layout = layout_in(own_context(), text, style, wrap, lines);
    if (pango_layout_get_unknown_glyphs_count(layout.get()) == 0) return layout;
    return layout_in(system_context(), text, style, wrap, lines);
}

Layout make_wrapped(const std::string& text, const TextStyle& style, double wrap, int lines) {
    if (wrap <= 0) return make_layout(text, style, 0, 1);
    TextStyle fitting = style;
    fitting.size = size_for_words(text, style, wrap);
    return make_layout(text, fitting, wrap, lines);
}

TextSize size_of(PangoLayout* layout) {
    PangoRectangle logical;
    pango_layout_get_extents(layout, nullptr, &logical);
    return {static_cast<double>(logical.width) / PANGO_SCALE,
            static_cast<double>(logical.height) / PANGO_SCALE};
}

}  // namespace

bool has_fonts_for(const std::string& text) {
    const TextStyle style;
    return pango_layout_get_unknown_glyphs_count(make_layout(text, style, 0, 1).get()) == 0;
}

double longest_word(const std::string& text, const TextStyle& style) {
    double longest = 0;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        longest = std::max(longest, measure_text(text.substr(from, to - from), style).width);
        from = to + 1;
    }
    return longest;
}

TextSize measure_text(const std::string& text, const TextStyle& style, double wrap, int lines) {
    return size_of(make_wrapped(text, style, wrap, lines).get());
}

TextSize draw_text(cairo_t* on, double x, double y, const std::string& text, const TextStyle& style,
                   const Colour& colour, double wrap, int lines) {
    const Layout layout = make_wrapped(text, style, wrap, lines);
    cairo_set_source_rgb(on, colour.red, colour.green, colour.blue);
    cairo_move_to(on, x, y);
    pango_cairo_show_layout(on, layout.get());
    return size_of(layout.get());
}

CairoSurface blank_surface(const Rectangle& part, const Colour& colour, double alpha) {
    CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, part.width, part.height));
    const CairoContext on(cairo_create(surface.get()));
    fill_surface(on.get(), colour, alpha);
    return surface;
}

void fill_surface(cairo_t* on, const Colour& colour, double alpha) {
    cairo_set_operator(on, CAIRO_OPERATOR_SOURCE);
    cairo_set_source_rgba(on, colour.red, colour.green, colour.blue, alpha);
    cairo_paint(on);
    cairo_set_operator(on, CAIRO_OPERATOR_OVER);
}

void copy_surface(cairo_surface_t* from, const Rectangle& to, Picture& picture) {
    copy_part(from, {0, 0, to.width, to.height}, to.x, to.y, picture);
}

void copy_part(cairo_surface_t* from, const Rectangle& part, int x, int y, Picture& picture) {
    cairo_surface_flush(from);
    const unsigned char* pixels = cairo_image_surface_get_data(from);
    const int stride = cairo_image_surface_get_stride(from);
    for (int j = part.y; j < part.y + part.height; ++j) {
        const auto* row =
            reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(j) * stride);
        std::uint8_t* out = picture.pixel(x + part.x, y + j);
        for (int i = part.x; i < part.x + part.width; ++i, out += 4) {
            out[0] = static_cast<std::uint8_t>(row[i] >> 16);
            out[1] = static_cast<std::uint8_t>(row[i] >> 8);
            out[2] = static_cast<std::uint8_t>(row[i]);
            out[3] = static_cast<std::uint8_t>(row[i] >> 24);
        }
    }
    divide_by_alpha(picture, {x + part.x, y + part.y, part.width, part.height});
}

namespace {

// How strong the halo is at each pixel around one of the words', 0 to 1.
struct Stamp {
    int reach = 0;
    std::vector<float> strength;  // rows of 2 reach + 1
};

Stamp make_stamp(double reach) {
    constexpr double kFade = 1.2;  // pixels, over which it ends
    Stamp stamp;
    stamp.reach = static_cast<int>(std::ceil(reach + 0.5 * kFade));
    for (int y = -stamp.reach; y <= stamp.reach; ++y)
        for (int x = -stamp.reach; x <= stamp.reach; ++x) {
            const double inside = reach + 0.5 * kFade - std::hypot(x, y);
            stamp.strength.push_back(static_cast<float>(std::clamp(inside / kFade, 0.0, 1.0)));
        }
    return stamp;
}

const std::uint32_t* row_of(cairo_surface_t* surface, int y) {
    const unsigned char* pixels = cairo_image_surface_get_data(surface);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
    return reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(y) * stride);
}

// Over a pixel's own alpha: strokes of small letters are thinner than a pixel and never opaque.
constexpr float kGain = 2.2f;

// The halo's alpha, 0 to 255, in the part. Most of a surface is empty: only what is not casts one.
std::vector<float> halo_in(cairo_surface_t* from, const Rectangle& part, const Stamp& stamp) {
    std::vector<float> halo(static_cast<std::size_t>(part.width) * part.height, 0);
    const int r = stamp.reach, wide = cairo_image_surface_get_width(from),
              high = cairo_image_surface_get_height(from);
    for (int y = std::max(0, part.y - r); y < std::min(high, part.y + part.height + r); ++y) {
        const std::uint32_t* row = row_of(from, y);
        for (int x = std::max(0, part.x - r); x < std::min(wide, part.x + part.width + r); ++x) {
            const float alpha = std::min(255.0f, kGain * static_cast<float>(row[x] >> 24));
            if (alpha == 0) continue;
            for (int j = std::max(y - r, part.y); j <= std::min(y + r, part.y + part.height - 1); ++j)
                for (int i = std::max(x - r, part.x); i <= std::min(x + r, part.x + part.width - 1); ++i) {
                    const float strength =
                        stamp.strength[static_cast<std::size_t>((j - y + r) * (2 * r + 1) + (i - x + r))];
                    float& at = halo[static_cast<std::size_t>(j - part.y) * part.width + (i - part.x)];
                    at = std::max(at, alpha * strength);
                }
        }
    }
    return halo;
}

}  // namespace

Halo halo_of(const TypeScale& type, const Palette& palette) {
    return {palette.background, std::max(2.0, 0.18 * type.minor)};
}

void copy_part_on_halo(cairo_surface_t* from, const Rectangle& part, int x, int y, const Halo& halo,
                       Picture& picture) {
    cairo_surface_flush(from);
    const std::vector<float> strength = halo_in(from, part, make_stamp(halo.reach));
    const float colour[3] = {static_cast<float>(halo.colour.red), static_cast<float>(halo.colour.green),
                             static_cast<float>(halo.colour.blue)};
    std::size_t at = 0;
    for (int j = 0; j < part.height; ++j) {
        const std::uint32_t* row = row_of(from, part.y + j) + part.x;
        std::uint8_t* out = picture.pixel(x + part.x, y + part.y + j);
        for (int i = 0; i < part.width; ++i, out += 4) {
            const float left = strength[at++] * (1 - static_cast<float>(row[i] >> 24) / 255);
            for (int c = 0; c < 3; ++c)
                out[c] = static_cast<std::uint8_t>(static_cast<float>((row[i] >> (16 - 8 * c)) & 255) +
                                                   left * colour[c] + 0.5f);
            out[3] = static_cast<std::uint8_t>(static_cast<float>(row[i] >> 24) + left + 0.5f);
        }
    }
    divide_by_alpha(picture, {x + part.x, y + part.y, part.width, part.height});
}

}  // namespace grainreel
