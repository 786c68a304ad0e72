#include "render/film/compare/comparison_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/units.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "render/picture/words/captions.hpp"
#include "render/picture/words/missing_letters.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// The clock by which the moments were chosen.
const Clock& schedule_clock(const Comparison& all) {
    return all.members[all.reference]->clock();
}

// The smallest size of this shape in which plots have room; empty when none of the sizes that are tried is
// large enough.
std::string size_with_plots(const std::vector<Panel>& panels, Film film) {
    constexpr int parts = 8, most = 5;  // steps in eighths of the size; up to five times the size
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

// A segment's own words hold in a panel if the segments chose the moments, and if the segment is in motion or
// the panel's drive has the frequency of the reference. Otherwise the words are found from the moments that
// the panel shows.
std::vector<std::string> playback_of(const ShotSource& source, const Comparison& all) {
    const std::vector<FilmSegment>& segments = all.pictures.segments;
    const Drive &drive = source.scene().drive, &reference = all.members[all.reference]->scene().drive;
    const Wording& say = source.scene().film.wording;
    const std::vector<State> moments = source.moments(all.pictures);
    std::vector<std::string> captions;
    for (std::size_t k = 0; k < segments.size(); ++k) {
        std::vector<State> inside;
        for (std::size_t i = 0; i < moments.size(); ++i)
            if (all.pictures.instants[i].segment == static_cast<int>(k)) inside.push_back(moments[i]);
        const bool as_planned =
            all.by_schedule && (segments[k].kind == FilmSegment::Kind::motion ||
                                (drive.present && drive.frequency == reference.frequency));
        const double rate = all.film.film.rate;
        captions.push_back(
            as_planned ? playback_caption(played(segments[k], rate, schedule_clock(all)), drive, rate, say)
                       : pacing_caption(inside, drive, rate, say));
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

// If a finished run chose the moments, or cannot give every moment, then the scenes that are run beside it
// also show single moments.
void warn_of_single_moments(Comparison& all) {
    std::set<std::string> said;
    for (const auto& member : all.members) {
        if (!member->archive()) continue;
        if (const auto warning = periods_warning(member->scene(), *member->archive());
            warning && said.insert(*warning).second)
            all.warnings.push_back(*warning);
    }
    const bool all_any = std::all_of(all.members.begin(), all.members.end(),
                                     [](const auto& member) { return member->source().has_any_moment(); });
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

namespace {

// Keys and tables that the whole film has once: those about its file, its time, and what stands around the
// panels.
constexpr std::array of_the_whole = {"film.size",    "film.rate",        "film.for",        "film.format",
                                     "film.quality", "film.preset",      "film.max_size",   "film.sheet",
                                     "film.segment", "film.transparent", "film.background", "film.title",
                                     "film.words",   "film.axes",        "film.caption",    "title",
                                     "run.duration", "run.threads"};

bool is_or_is_in(const std::string& key, const std::string& table) {
    return key.rfind(table, 0) == 0 &&
           (key.size() == table.size() || key[table.size()] == '.' || key[table.size()] == '[');
}

// Splits a text at commas outside of brackets and quotes. A quote within a word is no quote: 5' does not
// begin one.
std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts(1);
    int depth = 0;
    char quote = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote == '"' && c == '\\' && i + 1 < text.size()) {
            parts.back() += c;
            parts.back() += text[++i];
            continue;
        }
        const bool begins =
            quote == 0 && (c == '"' || c == '\'') && (depth > 0 || trimmed(parts.back(), " \t").empty());
        if (begins)
            quote = c;
        else if (c == quote)
            quote = 0;
        else if (quote == 0 && (c == '[' || c == '{'))
            ++depth;
        else if (quote == 0 && (c == ']' || c == '}'))
            --depth;
        if (c == ',' && depth <= 0 && quote == 0)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    for (std::string& part : parts) part = std::string(trimmed(part, " \t"));
    return parts;
}

// The value without its quotes: "20 Hz" of "\"20 Hz\"".
std::string bare(const std::string& value) {
    const bool quoted =
        value.size() >= 2 && (value.front() == '"' || value.front() == '\'') && value.back() == value.front();
    return quoted ? value.substr(1, value.size() - 2) : value;
}

bool is_number(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789.eE+-_") == std::string::npos;
}

// The key that the value was given to, "species[1].density" for "species.big.density"; empty for a table.
std::string path_of(const Assignment& value, const FilmedScene& scene) {
    std::string longest;
    for (const auto& [path, where] : scene.written)
        if (where.file == value.place() && find_key(path, filmed_scene_keys()) != nullptr &&
            path.size() > longest.size())
            longest = path;
    return longest;
}

std::string value_of_key(const std::string& text, const std::string& path) {
    const Key* key = path.empty() ? nullptr : find_key(path, filmed_scene_keys());
    const bool measured =
        key != nullptr && key->dimension != Dimension::number &&
        (key->kind == KeyKind::quantity || key->kind == KeyKind::diameter || key->kind == KeyKind::gravity);
    return measured && is_number(text) ? fmt::format("{} {}", text, text_of(key->dimension).unit) : text;
}

// What a label calls a key: "g level" for "drive.g_level", "density of big" for "species.big.density". In
// other languages than English the species stands in brackets.
std::string words_of_key(const std::string& key, Language language) {
    std::string name = name_of(key);
    std::replace(name.begin(), name.end(), '_', ' ');
    name = phrase(language, name);
    const std::string table = parent_of(key);
    if (table.rfind("species.", 0) != 0) return name;
    const std::string species = table.substr(std::string("species.").size());
    return language == Language::en ? name + " of " + species : fmt::format("{} ({})", name, species);
}

// The value with its symbol, as frames show it; empty for a key without a symbol.
std::string with_symbol(const std::string& path, const FilmedScene& scene) {
    if (path == "drive.frequency") return "f = " + frequency_text(scene.drive.frequency);
    if (path == "drive.g_level") return fmt::format("Γ = {:.4g}", scene.drive.g_level(scene.gravity.norm()));
    if (path == "drive.amplitude") return "a = " + length_text(scene.drive.amplitude);
    return "";
}

}  // namespace

std::vector<Assignment> read_vary(const std::string& typed) {
    const Assignment all(typed, "--vary");
    const std::string key = all.key();
    if (typed.find('=') == std::string::npos || key.empty())
        throw UserError("--vary {}: write KEY=VALUE,VALUE, as in drive.g_level=2,4", excerpt(typed));
    const std::string place = "--vary " + excerpt(key);
    for (const char* const shared : of_the_whole)
        if (is_or_is_in(key, shared))
            throw UserError("{}: is the same for all panels; vary another key", place);
    std::vector<std::string> values = split(all.value());
    if (values.size() < 2)
        throw UserError("{}: has one value; give two or more, with commas between them", place);
    std::vector<Assignment> assignments;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i].empty()) throw UserError("{}: value {} is empty; take a comma away", place, i + 1);
        if (std::find(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values[i]) !=
            values.begin() + static_cast<std::ptrdiff_t>(i))
            throw UserError("{}: has {} twice", place, excerpt(values[i]));
        assignments.push_back({fmt::format("{}={}", key, values[i]), place});
    }
    return assignments;
}

std::vector<std::string> labels_of(const std::vector<Assignment>& values,
                                   const std::vector<FilmedScene>& scenes) {
    std::vector<std::string> symbols, words;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string path = path_of(values[i], scenes[i]);
        words.push_back(fmt::format("{} = {}", words_of_key(values[i].key(), scenes[i].film.wording.language),
                                    value_of_key(bare(values[i].value()), path)));
        symbols.push_back(with_symbol(path, scenes[i]));
    }
    const std::set<std::string> different(symbols.begin(), symbols.end());
    return different.size() == symbols.size() && different.count("") == 0 ? symbols : words;
}

bool changes_the_scene(const Assignment& value) {
    const std::string key = value.key();
    return !is_or_is_in(key, "film") && !is_or_is_in(key, "output") && key != "run.seed";
}

std::string name_with(const std::string& name, const Assignment& value) {
    constexpr std::size_t longest = 40;
    std::string slug = name_of(value.key()) + "-" + bare(value.value());
    for (char& c : slug) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) == 0 && c != '.' && c != '-' && c != '+' && c != '_') c = '_';
    }
    return name + "-" + slug.substr(0, longest);
}

}  // namespace grainreel
