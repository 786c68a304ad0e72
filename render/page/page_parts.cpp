#include "render/page/page_parts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/units.hpp"
#include "render/page/embed.hpp"
#include "render/page/facts/methods.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/live_text.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using NamedLines = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t most_files = 60;            // files that the page lists
constexpr std::size_t most_scene_text = 200'000;  // bytes of the scene's text that the page shows

// The lines as a list. A line without a name continues the one before.
std::string list_html(const NamedLines& lines) {
    std::string html = "<dl>\n";
    for (const auto& [name, text] : lines) {
        if (!name.empty()) html += fmt::format("<dt>{}</dt>", html_text(name));
        html += fmt::format("<dd>{}</dd>\n", html_text(text));
    }
    return html + "</dl>\n";
}

// A chapter whose text is in the page's language.
std::string own_chapter(const std::string& title, const std::string& html) {
    return fmt::format("<section><h2>{}</h2>\n{}</section>\n", html_text(title), html);
}

// A chapter whose text is English on every page.
std::string chapter(const PageWords& say, const char* title, const std::string& html) {
    return fmt::format("<section{}><h2{}>{}</h2>\n{}</section>\n", say.on_english(), say.on_own(),
                       html_text(say(title)), html);
}

std::string copyable(const PageWords& say, const std::string& id, const char* label, const std::string& text,
                     const char* style) {
    return fmt::format(
        "<h3>{0}</h3>\n<pre id=\"{1}\" class=\"{2}\" tabindex=\"0\" aria-label=\"{0}\">{3}</pre>\n"
        "<p class=\"no-print\"><button type=\"button\" data-copies=\"{1}\">{4}</button></p>\n",
        html_text(say(label)), id, style, html_text(text), html_text(say("Copy")));
}

std::string plan_html(const PlannedScene& planned, const PageWords& say) {
    return "<p>What was asked for, what is modelled, and what is left out. The error is that of the "
           "restitution in a "
           "free impact, found by making the impact.</p>\n" +
           list_html(planned.lines) +
           fmt::format(
               "<h3{0}>{1}</h3>\n<pre class=\"columns\" tabindex=\"0\" aria-label=\"{1}\">{2}</pre>\n",
               say.on_own(), html_text(say("Contacts")), html_text(planned.contacts));
}

std::string provenance_html(const ReadRunJson& run, const PageWords& say) {
    std::string html = list_html(origin_lines(run));
    if (run.record.warnings.empty()) return html;
    html += fmt::format("<h3{}>{}</h3>\n<ul>\n", say.on_own(), html_text(say("Warnings of the run")));
    for (const std::string& warning : run.record.warnings)
        html += fmt::format("<li>{}</li>\n", html_text(warning));
    return html + "</ul>\n";
}

std::string scene_html(const fs::path& folder, const PageWords& say, const std::string& n, bool beside,
                       RunOf of) {
    std::string text;
    try {
        text = load_scene_file(folder / "scene.toml");
    } catch (const UserError&) {
        return "";
    }
    if (text.size() > most_scene_text)
        return chapter(say, "Scene",
                       fmt::format("<p>The scene is too long for this page; it is {} in the run's "
                                   "folder.</p>\n",
                                   beside ? "<a href=\"./scene.toml\">scene.toml</a>" : "scene.toml"));
    return chapter(
        say, "Scene",
        (of == RunOf::us
             ? "<p>Every value, defaults too. Saved as a file, <code>grainreel movie FILE</code> runs it "
               "again.</p>\n"
             : std::string()) +
            copyable(say, "scene-text" + n, "scene.toml", text, "plain"));
}

std::string files_html(const fs::path& folder, const std::string& page_name) {
    NamedLines files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        std::error_code ignored;
        if (name.front() == '.' || name == page_name || !entry->is_regular_file(ignored)) continue;
        const std::uintmax_t size = entry->file_size(ignored);
        if (!ignored) files.emplace_back(name, data_size_text(static_cast<double>(size)));
    }
    std::sort(files.begin(), files.end());
    if (files.size() > most_files) files.resize(most_files);
    std::string html = fmt::format(
        "<p>They are not on this page. The links open them while it lies in the run's folder, "
        "{}.</p>\n<ul>\n",
        html_text(folder.filename().string()));
    for (const auto& [name, size] : files)
        html += fmt::format("<li><a href=\"{}\">{}</a>, {}</li>\n", file_link(name), html_text(name), size);
    return html + "</ul>\n";
}

const char* words_of(Container::Shape shape) {
    switch (shape) {
        case Container::Shape::wedge:
            return "in a wedge hopper";
        case Container::Shape::box:
            return "in a box";
        case Container::Shape::cylinder:
            return "in a cylinder";
        case Container::Shape::mesh:
            return "in a vessel";
        case Container::Shape::none:
            break;
    }
    return "in empty space";
}

// Where the grains are; "in the vessel “drum” with “screw”" when walls come from files.
std::string place_words(const FilmedScene& scene, const PageWords& say) {
    const bool vessel = scene.container.shape == Container::Shape::mesh;
    std::vector<std::string> others;
    for (const SceneMesh& mesh : scene.meshes)
        if (!vessel || mesh.name != scene.container.mesh) others.push_back(fmt::format("“{}”", mesh.name));
    const std::string words =
        vessel ? say("in the vessel “{1}”", {scene.container.mesh}) : say(words_of(scene.container.shape));
    if (others.empty()) return words;
    constexpr std::size_t most_named = 4;
    std::string named = others.front();
    for (std::size_t i = 1; i < others.size(); ++i)
        named = i + 1 == others.size() ? say("{1} and {2}", {named, others[i]}) : named + ", " + others[i];
    if (others.size() > most_named) named = say("{1} meshes", {std::to_string(others.size())});
    if (scene.container.shape == Container::Shape::none) return say("with walls of any shape, {1}", {named});
    return say("{1} with {2}", {words, named});
}

// The number of grains in words: "400 sand (and 300 more that are fed)".
std::string number_words(const Species& species, const PageWords& say) {
    const std::string count = std::to_string(species.count), fed = std::to_string(species.fed);
    if (species.fed == 0) return fmt::format("{} {}", count, species.name);
    if (species.count == 0) return say("{1} {2} that are fed", {fed, species.name});
    return say("{1} {2} (and {3} more that are fed)", {count, species.name, fed});
}

std::string drive_words(const FilmedScene& scene, const PageWords& say) {
    const Drive& drive = scene.drive;
    const std::string duration = fmt::format("{:.4g}", scene.run.duration);
    if (!drive.present) return say("without a drive, for {1} s", {duration});
    const double gravity = scene.gravity.norm();
    const std::string frequency = fmt::format("{:.4g}", drive.frequency),
                      amplitude = fmt::format("{:.3g}", 1000 * drive.amplitude),
                      level = gravity > 0 ? fmt::format("{:.3g}", drive.g_level(gravity)) : "";
    const std::string words =
        level.empty() ? say("shaken at {1} Hz (amplitude {2} mm) for {3} s", {frequency, amplitude, duration})
                      : say("shaken at {1} Hz with Γ = {4} (amplitude {2} mm) for {3} s",
                            {frequency, amplitude, duration, level});
    return drive.changes() ? say("{1} and then otherwise", {words}) : words;
}

}  // namespace

std::string lead_text(const FilmedScene& scene, const PageWords& say, RunOf of) {
    std::string species;
    for (const Species& one : scene.species)
        if (one.all() > 0)  // otherwise all its grains are glued to walls
            species = species.empty() ? number_words(one, say)
                                      : say("{1} and {2}", {species, number_words(one, say)});
    const bool told = of == RunOf::us || scene.drive.present;  // else whether it was driven is not known
    return fmt::format("{}, {}, {}", species, place_words(scene, say),
                       told ? drive_words(scene, say) : fmt::format("{:.4g} s", scene.run.duration));
}

std::string lead_html(const FilmedScene& scene, const PageWords& say, RunOf of) {
    return fmt::format("<p class=\"lead\">{}.</p>\n", html_text(lead_text(scene, say, of)));
}

std::string end_html(const FilmedScene& scene, const ReadRunJson& run, double until, const PageWords& say) {
    if (run.status == "complete") return "";
    const std::string at = fmt::format("{:.4g} of {:.4g} s", std::max(0.0, until), scene.run.duration);
    std::string text;
    if (run.status == "failed")
        text = fmt::format("The run failed at {}: {}.", at,
                           run.record.error.empty() ? "see log.txt" : run.record.error);
    else if (run.status == "interrupted")
        text = fmt::format("The run was stopped at {}.", at);
    else if (run.status == "running")
        text = fmt::format("The run goes on; it was at {} when this page was made.", at);
    else if (run.status == "broken off")
        text = fmt::format("The run was broken off at {}: it was killed, or its machine went off.", at);
    else
        text = fmt::format("The run’s status is “{}”; it came to {}.", run.status, at);
    return fmt::format(
        "<p class=\"ended\"{}><strong>{}</strong> This page has what it kept until then.</p>\n",
        say.on_english(), html_text(text));
}

std::string film_html(const PageFilm& film, const std::vector<std::uint8_t>& poster,
                      const PageNote& why_not_tied, const std::string& about, const PageWords& say,
                      const std::string& n, bool beside) {
    const std::string picture =
        poster.empty() ? "" : fmt::format("data:image/jpeg;base64,{}", base64(poster));
    std::string html;
    if (!film.bytes.empty())
        html = fmt::format("<video id=\"film{}\" controls muted playsinline aria-label=\"{}\"{}></video>\n",
                           n, html_text(say("Film of the run: {1}", {about})),
                           picture.empty() ? "" : fmt::format(" poster=\"{}\"", picture));
    if (!picture.empty())
        html += fmt::format("<img class=\"poster\" src=\"{}\" alt=\"{}\"{}>\n", picture,
                            html_text(say("One picture of the run: {1}", {about})),
                            film.bytes.empty() ? "" : " hidden");
    if (html.empty()) html = fmt::format("<p>{}</p>\n", html_text(say("The run has no film and no poster.")));
    for (const PageNote& note : {film.note, film.bytes.empty() ? PageNote() : why_not_tied})
        if (!note.empty()) html += fmt::format("<p class=\"faint\">{}</p>\n", html_text(say(note)));
    if (film.whole_in_folder && beside)
        html += fmt::format("<p class=\"faint no-print\"><a href=\"{}\" title=\"{}\">{}</a></p>\n",
                            file_link(film.file), html_text(say("Opens while this page lies there")),
                            html_text(say("{1} in the run's folder", {film.file})));
    return html;
}

std::string bed_about(const PageBed& bed, const PageMeshes& meshes, const FilmedScene& scene,
                      const PageWords& say) {
    const Vec3 error = 1e6 * bed.error();
    const auto number = [](std::size_t count) { return std::to_string(count); };
    std::string text =
        say("Places are rounded to 16 bits over the box that the grains reach: they are off by {1} µm along "
            "x, {2} µm "
            "along y and {3} µm along z at most. Speeds are right to 2.3 % and come from the run, not from "
            "differences of places. Nothing is interpolated between moments.",
            {fmt::format("{:.2g}", error.x()), fmt::format("{:.2g}", error.y()),
             fmt::format("{:.2g}", error.z())});
    const auto add = [&](const std::string& sentence) { text += " " + sentence; };
    if (bed.moments.size() != bed.all_moments)
        add(say(
            "Of the {1} moments that the run kept these are {2}, evenly spread; the page has no room for the "
            "others.",
            {number(bed.all_moments), number(bed.moments.size())}));
    else if (bed.all_moments == 1)
        add(say("This is the only moment that the run kept."));
    else
        add(say("These are all {1} moments that the run kept.", {number(bed.all_moments)}));
    if (bed.grains < bed.all_grains)
        add(say(
            "Of {1} grains it shows the {2} that lay nearest to the middle of the depth when they were first "
            "seen.",
            {number(bed.all_grains), number(bed.grains)}));
    if (bed.counted == 0)
        add(say("The run kept no contact numbers."));
    else if (bed.counted < bed.moments.size())
        add(say("Contact numbers are known at {1} of them.", {number(bed.counted)}));
    if (bed.has_film_colours && bed.film_coloured < bed.moments.size())
        add(say("What the film's colours stand for is known at {1} of them.", {number(bed.film_coloured)}));
    if (!bed.forces.moments.empty())
        add(say(
            "At {1} of them the page has the pairs that push each other, with their normal forces to 2.3 %.",
            {number(bed.forces.moments.size())}));
    if (scene.container.wall_grains) add(say("Grains that are glued to walls are not shown."));
    std::string html = html_text(text);
    for (std::string note : meshes.notes()) {
        note.front() = 'T';
        html += fmt::format(" <span{}>{}.</span>", say.on_english(), html_text(note));
    }
    return html;
}

namespace {

// The caption's text with the values that the film shows: those of the last row up to its first moment.
// Values that are not known yet are dashes.
std::string text_of_caption(const FilmCaption& caption, const MeasureTable* measures) {
    if (caption.words.empty()) return caption.text;
    std::size_t rows = 0;
    if (measures != nullptr) {
        const std::vector<double> times = measures->all("time_s");
        const double until = caption.from * (1 + 1e-9) + 1e-12;
        rows = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), until) - times.begin());
    }
    return live_text(caption.words, [&](const LiveWords& part) { return live_number(part, measures, rows); });
}

}  // namespace

std::string story_html(const FilmedScene& scene, const fs::path& folder, const PageWords& say) {
    if (scene.film.captions.empty()) return "";
    const std::shared_ptr<const MeasureTable> measures =
        has_values(scene.film.captions) ? read_measures(folder / "measures.csv") : nullptr;
    std::string html = "<ol class=\"story\">\n";
    for (const FilmCaption& caption : scene.film.captions)
        html += fmt::format(
            "<li data-from=\"{0:.9g}\" data-until=\"{1:.9g}\"><button type=\"button\" class=\"no-print\" "
            "data-time=\"{0:.9g}\">{0:.4g} s</button> <span>{2}</span></li>\n",
            caption.from, caption.to, html_text(text_of_caption(caption, measures.get())));
    return own_chapter(say("What to look at"), html + "</ol>\n");
}

std::string chapters_html(const FilmedScene& scene, const ReadRunJson& run,
                          const std::optional<PlannedScene>& planned, const fs::path& folder,
                          const std::string& page_name, const PageWords& say, const std::string& n,
                          RunOf of) {
    std::string html = story_html(scene, folder, say);
    if (planned && of == RunOf::us) {
        html += chapter(say, "What was computed", plan_html(*planned, say));
        const Methods text = methods(scene, planned->plan, run.record, planned->lines);
        html += chapter(say, "To cite",
                        copyable(say, "methods" + n, "Methods", text.paragraph, "wraps") +
                            copyable(say, "bibtex" + n, "BibTeX", text.bibtex, "plain"));
    }
    if (of == RunOf::us) html += chapter(say, "Where it comes from", provenance_html(run, say));
    const bool beside = !page_name.empty();
    html += scene_html(folder, say, n, beside, of);
    return beside ? html + chapter(say, "Files of the run", files_html(folder, page_name)) : html;
}

}  // namespace grainreel
