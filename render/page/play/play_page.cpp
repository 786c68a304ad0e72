#include "render/page/play/play_page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/play/knobs.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/body.hpp"
#include "engine/step/surroundings.hpp"
#include "render/page/bed/page_bed.hpp"
#include "render/page/bed/page_meshes.hpp"
#include "render/page/bed/slabs.hpp"
#include "render/page/embed.hpp"
#include "render/page/facts/page_facts.hpp"
#include "render/page/page_measures.hpp"
#include "render/page/page_parts.hpp"
#include "render/page/page_words.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double long_enough = 600;  // s; nobody plays longer with one bed
constexpr std::size_t most_mesh_bytes = 400'000;

// Whether the scene's end decides what happens before it.
bool has_an_end(const Scene& scene) {
    const bool moves =
        std::any_of(scene.meshes.begin(), scene.meshes.end(), [](const SceneMesh& m) { return m.moves(); });
    const bool planes = std::any_of(scene.walls.begin(), scene.walls.end(),
                                    [](const ScenePlane& p) { return !p.velocity.isZero(0); });
    return moves || planes || !scene.feeds.empty();
}

[[noreturn]] void refuse(const Scene& scene, const std::string& key, const std::string& what) {
    throw UserError(fmt::format("{}: {}", scene.where(key), what));
}

void check_playable(const Scene& scene) {
    if (scene.start.method == Start::Method::file)
        refuse(scene, "start.file",
               "a page cannot start from a file; let it pack the grains, as with start.method = \"layers\"");
    for (const SceneMesh& mesh : scene.meshes)
        if (!fs::path(mesh.file).filename().string().starts_with("shipped:") || !mesh.path_file.empty())
            refuse(
                scene, "mesh",
                fmt::format("a page has no room for the mesh '{}' of a file; take one that the program ships",
                            mesh.name));
    if (scene.grains() > kMostPlayedGrains)
        refuse(scene, "species",
               fmt::format("{} grains are too many for a page, which takes {}; take fewer, as by --set "
                           "species.{}.count=1000",
                           scene.grains(), kMostPlayedGrains, scene.species.front().name));
}

// ---- Facts for the scripts ----

// The box of places: what the film looks at, with room for grains that fly or flow out.
Extent room_of(const FilmedScene& scene) {
    Extent box = box_of(slabs_of(scene), scene);
    const Vec3 size = box.high - box.low;
    box.low -= 0.3 * size;
    box.high += 0.3 * size + Vec3(0, 0, scene.container.lid ? 0 : 0.7 * size.z());
    return box;
}

double highest_speed(const FilmedScene& scene, const Extent& room) {
    const double fall = std::sqrt(2 * scene.gravity.norm() * (room.high.z() - room.low.z()));
    return std::max({fall, 4 * scene.drive.top_speed(), 0.1});
}

Json bed_facts(const FilmedScene& scene, const Plan& plan, const PageMeshes& meshes) {
    const Extent room = room_of(scene);
    PageBed bed;
    State rest;
    rest.bodies = poses_of(bodies_of(scene), make_surroundings(scene, plan).motion.at(0));
    bed.moments = {rest};
    bed.grains = static_cast<std::size_t>(scene.grains());
    bed.low = room.low;
    bed.high = room.high;
    bed.highest_speed = highest_speed(scene, room);
    bed.lowest_speed = bed.highest_speed / kByteSpan;
    bed.counted = 1;
    return Json::parse(bed_facts_json(scene, bed, meshes));
}

// What is measured: the film's plots, how the big lie above the small, energy, contacts; the first have
// charts.
std::vector<std::string> measured_in(const FilmedScene& scene, std::size_t& charted) {
    std::vector<std::string> names;
    const std::vector<MeasureColumn> known = measure_columns(scene);
    const std::vector<std::string> asked = scene.instruments();
    const auto add = [&](const std::string& name) {
        const auto found =
            std::find_if(known.begin(), known.end(), [&](const MeasureColumn& c) { return c.name == name; });
        if (found == known.end() || std::find(names.begin(), names.end(), name) != names.end()) return;
        const bool is_on = found->instrument.empty() ||
                           std::find(asked.begin(), asked.end(), found->instrument) != asked.end();
        if (is_on && why_column_is_empty(scene, name).empty()) names.push_back(name);
    };
    for (const FilmPlot& plot : scene.film.shows.plots) add(plot.column);
    add("height_difference");
    add("kinetic_J");
    add("contact_number");
    charted = std::min<std::size_t>(4, names.size());
    for (const char* more : {"big_above_small", "lacey", "bed_top_m", "gravitational_J", "drive_g_level"})
        add(more);
    return names;
}

void add_measures(Json& facts, const FilmedScene& scene) {
    std::size_t charted = 0;
    std::vector<std::string> names = measured_in(scene, charted);
    facts["charts"] =
        std::vector<std::string>(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(charted));
    names.insert(names.begin(), "time_s");
    const MeasureTable table(names);
    facts["columns"] = Json::parse(all_measures_json(table, page_measures(scene, table)))["columns"];
    facts["columns"].erase(0);
    for (Json& column : facts["columns"]) column.erase("smooth");
}

struct ShownUnit {
    std::string unit;
    double size = 1;
};

ShownUnit unit_of(const Knob& knob) {
    if (knob.dimension == Dimension::length) {
        const std::string unit = fitting_unit(knob.low, Dimension::length);
        return {unit, unit_size(unit, Dimension::length)};
    }
    if (knob.dimension == Dimension::acceleration) return {"m/s²", 1};
    const std::string unit = text_of(knob.dimension).unit;
    return {unit == "1" ? "" : unit, 1};
}

std::string label_of(const Knob& knob, const PageWords& say) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 8> labels{
        {{"drive.frequency", "frequency of shaking"},
         {"drive.g_level", "Γ, its acceleration over gravity"},
         {"contact.friction", "friction between grains"},
         {"contact.wall.friction", "friction at walls"},
         {"contact.restitution", "bounciness (restitution)"},
         {"contact.wall.restitution", "bounciness at walls"},
         {"gravity", "gravity"},
         {"run.seed", "another throw of the grains (seed)"}}};
    if (!knob.label.empty()) return knob.label;
    for (const auto& [key, words] : labels)
        if (key == knob.key) return say(words);
    const std::string name = knob.key.substr(8, knob.key.rfind('.') - 8);  // species.NAME.count
    return knob.whole ? say("number of {1}", {name}) : say("diameter of {1}", {name});
}

Json knobs_json(const FilmedScene& scene, const PageWords& say) {
    Json list = Json::array();
    for (const Knob& knob : knobs_of(scene)) {
        const ShownUnit shown = unit_of(knob);
        Json one = {{"key", knob.key},
                    {"label", label_of(knob, say)},
                    {"unit", shown.unit},
                    {"size", shown.size},
                    {"low", knob.low},
                    {"high", knob.high},
                    {"whole", knob.whole},
                    {"anew", knob.packs_anew},
                    {"value", knob_value(scene, knob.key)}};
        if (knob.key == "gravity")
            one["presets"] = {{{"name", "Moon"}, {"value", 1.62}},
                              {{"name", "Mars"}, {"value", 3.71}},
                              {{"name", "Earth"}, {"value", 9.81}}};
        list.push_back(std::move(one));
    }
    return list;
}

Json facts_of(const PlayPage& page, const PageMeshes& meshes, const PageWords& say) {
    const FilmedScene& scene = page.scene;
    Json facts = {{"name", scene.name},
                  {"planned", resolved_scene(scene, page.plan)},
                  {"open", written_scene(scene)},
                  {"bed", bed_facts(scene, page.plan, meshes)},
                  {"knobs", knobs_json(scene, say)},
                  {"frequency", scene.drive.present ? Json(scene.drive.frequency) : Json()},
                  {"tilts", scene.gravity.norm() > 0},
                  {"call", program_call() + " movie"},
                  {"worker", page_files().play_worker}};
    add_measures(facts, scene);
    return facts;
}

// ---- Words ----

std::string about_html(const PlayPage& page, const PageWords& say) {
    const Plan& plan = page.plan;
    std::string text =
        say("This page has the engine of grainreel in it, compiled for browsers, and computes every contact "
            "of every grain. Nothing is sent anywhere.");
    text += " " + (page.soft ? say("To be quick, its grains are softer than those of a film: that is the "
                                   "only thing that differs.")
                             : say("Its grains are as stiff as the scene asks for."));
    return fmt::format(
        "<p>{}</p>\n<p id=\"overlap-says\">{}</p>\n", html_text(text),
        html_text(say("Grains overlap by {1} % of their diameter at most, by the plan; one step is {2} µs.",
                      {fmt::format("{:.2g}", 100 * plan.expected_overlap),
                       fmt::format("{:.3g}", 1e6 * plan.clock.step)})));
}

std::string challenge_html(const Scene& scene) {
    return scene.challenge.empty()
               ? ""
               : fmt::format("<p class=\"challenge\">{}</p>\n", html_text(scene.challenge));
}

}  // namespace

FilmedScene played_scene(FilmedScene scene) {
    check_playable(scene);
    if (!has_an_end(scene)) scene.run.duration = std::max(scene.run.duration, long_enough);
    scene.output.fields = {};
    scene.output.also = {};
    scene.run.threads = 0;
    return scene;
}

std::size_t write_play_page(const PlayPage& page, const fs::path& out) {
    const PageWords say(page.scene.film.wording);
    const PageFiles& files = page_files();
    const PageMeshes meshes =
        page.scene.meshes.empty() ? PageMeshes() : page_meshes(page.scene, most_mesh_bytes);
    const std::string title = page.scene.title.empty() ? page.scene.name : page.scene.title;
    const std::string facts =
        facts_of(page, meshes, say).dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::string html =
        filled(say.in(files.play),
               {{"title", html_text(title)},
                {"lang", say.code()},
                {"style", std::string(files.style) + std::string(files.play_style)},
                {"lead", lead_html(page.scene, say)},
                {"challenge", challenge_html(page.scene)},
                {"bed", filled(say.in(files.bed), {{"n", ""}, {"about", ""}})},
                {"charts", filled(say.in(files.charts), {{"about", ""}})},
                {"take_about", html_text(say("A scene file with the knobs as they stand, for a film."))},
                {"about", about_html(page, say)},
                {"facts", json_in_html(say.with_words(facts))},
                {"script", files.playing_script(!page.scene.meshes.empty())},
                {"blobs", blob("engine-script", zlib_packed(page.engine.script)) +
                              blob("engine-wasm", zlib_packed(page.engine.wasm)) +
                              blob("meshes-bytes", meshes.packed)}});
    replace_file(out, html);
    return html.size();
}

}  // namespace grainreel
