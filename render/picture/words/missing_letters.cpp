// Finds letters that no font has, their scripts, and the packages with fonts for them.
#include "render/picture/words/missing_letters.hpp"

#include <glib.h>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/lists.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_named = 20;  // letters of a script named in a message

struct Script {
    GUnicodeScript script;
    const char* name;
};
constexpr Script east_asian[] = {{G_UNICODE_SCRIPT_HAN, "Chinese"},
                                 {G_UNICODE_SCRIPT_BOPOMOFO, "Chinese"},
                                 {G_UNICODE_SCRIPT_HIRAGANA, "Japanese"},
                                 {G_UNICODE_SCRIPT_KATAKANA, "Japanese"},
                                 {G_UNICODE_SCRIPT_HANGUL, "Korean"}};
constexpr Script others[] = {
    {G_UNICODE_SCRIPT_LATIN, "Latin"},         {G_UNICODE_SCRIPT_GREEK, "Greek"},
    {G_UNICODE_SCRIPT_CYRILLIC, "Cyrillic"},   {G_UNICODE_SCRIPT_ARABIC, "Arabic"},
    {G_UNICODE_SCRIPT_HEBREW, "Hebrew"},       {G_UNICODE_SCRIPT_DEVANAGARI, "Devanagari"},
    {G_UNICODE_SCRIPT_BENGALI, "Bengali"},     {G_UNICODE_SCRIPT_GURMUKHI, "Gurmukhi"},
    {G_UNICODE_SCRIPT_GUJARATI, "Gujarati"},   {G_UNICODE_SCRIPT_TAMIL, "Tamil"},
    {G_UNICODE_SCRIPT_TELUGU, "Telugu"},       {G_UNICODE_SCRIPT_KANNADA, "Kannada"},
    {G_UNICODE_SCRIPT_MALAYALAM, "Malayalam"}, {G_UNICODE_SCRIPT_SINHALA, "Sinhala"},
    {G_UNICODE_SCRIPT_THAI, "Thai"},           {G_UNICODE_SCRIPT_LAO, "Lao"},
    {G_UNICODE_SCRIPT_KHMER, "Khmer"},         {G_UNICODE_SCRIPT_MYANMAR, "Burmese"},
    {G_UNICODE_SCRIPT_TIBETAN, "Tibetan"},     {G_UNICODE_SCRIPT_GEORGIAN, "Georgian"},
    {G_UNICODE_SCRIPT_ARMENIAN, "Armenian"},   {G_UNICODE_SCRIPT_ETHIOPIC, "Ethiopic"}};

bool is_emoji(gunichar letter) {
    return letter >= 0x1f000 && letter <= 0x1faff;
}

// The script of a letter and the package with a font for it. The caller fills in the letter itself.
MissingLetters kind_of(gunichar letter) {
    const GUnicodeScript script = g_unichar_get_script(letter);
    for (const Script& known : east_asian)
        if (known.script == script) return {"", known.name, "fonts-noto-cjk"};
    for (const Script& known : others)
        if (known.script == script) return {"", known.name, "fonts-noto-core"};
    if (is_emoji(letter)) return {"", "emoji", "fonts-noto-color-emoji"};
    return {"", script == G_UNICODE_SCRIPT_COMMON ? "signs" : "another script", "fonts-noto"};
}

std::string text_of(gunichar letter) {
    char bytes[6];
    return {bytes, static_cast<std::size_t>(g_unichar_to_utf8(letter, bytes))};
}

std::string words_of(const MissingLetters& missing) {
    const std::u32string_view::size_type letters =
        static_cast<std::size_t>(g_utf8_strlen(missing.letters.c_str(), -1));
    const char* const end =
        g_utf8_offset_to_pointer(missing.letters.c_str(), static_cast<glong>(std::min(letters, most_named)));
    return fmt::format("{}{} ({})", std::string(missing.letters.c_str(), end),
                       letters > most_named ? "..." : "", missing.script);
}

void add_missing(std::vector<MissingLetters>& all, const MissingLetters& one) {
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const auto& known) { return known.script == one.script; });
    if (same == all.end())
        all.push_back(one);
    else if (same->letters.find(one.letters) == std::string::npos)
        same->letters += one.letters;
}

}  // namespace

std::vector<MissingLetters> missing_letters(const std::string& text) {
    std::vector<MissingLetters> missing;
    if (has_fonts_for(text)) return missing;
    for (const char* at = text.c_str(); *at != '\0'; at = g_utf8_next_char(at)) {
        const gunichar letter = g_utf8_get_char(at);
        if (!g_unichar_isprint(letter) || has_fonts_for(text_of(letter))) continue;
        MissingLetters one = kind_of(letter);
        one.letters = text_of(letter);
        add_missing(missing, one);
    }
    return missing;
}

std::string missing_letters_warning(const std::vector<std::pair<std::string, std::string>>& texts) {
    std::vector<MissingLetters> all;
    std::string place;
    for (const auto& [where, text] : texts)
        for (const MissingLetters& one : missing_letters(text)) {
            if (all.empty()) place = where;
            for (const char* at = one.letters.c_str(); *at != '\0'; at = g_utf8_next_char(at))
                add_missing(all, {text_of(g_utf8_get_char(at)), one.script, one.package});
        }
    if (all.empty()) return "";
    std::vector<std::string> words, packages;
    for (const MissingLetters& one : all) {
        words.push_back(words_of(one));
        if (!contains(packages, one.package)) packages.push_back(one.package);
    }
    return fmt::format(
        "{}: no font here has {}, so boxes stand in their place; on Debian: apt-get install {}", place,
        fmt::join(words, ", "), fmt::join(packages, " "));
}

std::vector<std::pair<std::string, std::string>> texts_of_film(const FilmedScene& scene) {
    std::vector<std::pair<std::string, std::string>> texts;
    const Film& film = scene.film;
    if (film.words == WordPlace::none) return texts;
    const auto take = [&](const std::string& key, const std::string& text) {
        if (!text.empty()) texts.emplace_back(scene.where(key), text);
    };
    // A film without a title of its own has the scene's title.
    take(film.title == scene.title ? "title" : "film.title", shown_title(film));
    for (std::size_t i = 0; i < scene.species.size() && film.word_kinds.legend; ++i)
        take(fmt::format("species[{}].name", i), scene.species[i].name);
    for (std::size_t i = 0; i < film.captions.size() && film.word_kinds.captions; ++i)
        take(fmt::format("film.caption[{}].text", i), film.captions[i].text);
    for (const LiveWords& words : film.shows.live_words) take("film.text", words.words);
    return texts;
}

const std::vector<ScriptSample>& script_samples() {
    static const std::vector<ScriptSample> samples{
        {"Latin", "aß"},     {"Greek", "Γµ"},     {"Cyrillic", "ж"},    {"Arabic", "ع"},
        {"Hebrew", "א"},     {"Chinese", "振动"}, {"Japanese", "かカ"}, {"Korean", "한"},
        {"Devanagari", "स"}, {"Bengali", "ব"},    {"Tamil", "த"},       {"Thai", "ก"},
        {"Georgian", "ა"},   {"Armenian", "ա"},   {"Ethiopic", "አ"},    {"emoji", "🎬"}};
    return samples;
}

}  // namespace grainreel
