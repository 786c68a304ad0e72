#include "render/film/sources/film_needs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/state/container_faces.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

std::optional<std::string> lacking_elsewhere(const FilmedScene& scene) {
    const FilmShows& shows = scene.film.shows;
    const std::string begin = "another engine computes the run, and ";
    if (scene.film.look.rotation) return begin + "its dumps have no orientations; let film.rotation be false";
    if (needs_touches(shows))
        return begin +
               "its dumps have no contacts; let film.colour.by be something else and film.force_chains false";
    if (shows.wall_forces.wanted)
        return begin + "forces on walls are not measured there; let film.wall_forces be false";
    if (shows_wear(scene))
        return begin + "wear of walls is not measured there; let film.walls.colour be \"plain\"";
    return std::nullopt;
}

namespace {

using Lines = std::vector<std::string>;
using Kind = StoredRun::Kind;

void check_orientations(const FilmedScene& scene, const StoredRun& run) {
    if (!scene.film.look.rotation || run.supply().orientations) return;
    if (run.kind() == Kind::imported)
        throw UserError("{}: its files say no orientations; let film.rotation be false", scene.title);
    throw UserError(
        "{}: has no orientations, and the film shows rotation; run it with "
        "output.orientation = true, or let film.rotation be false",
        run.name_of("trajectory.nc"));
}

// Frames the picture by how high the grains got: for a finished run this need not be estimated.
void frame_what_is_reached(FilmedScene& scene, const StoredRun& run) {
    Camera& camera = scene.film.camera;
    if (camera.frame == FramingScope::reach && !camera.reach && !camera.position)
        camera.reach = known_reach(run);
}

void look_at_contacts(const FilmedScene& scene, const StoredRun& run, Lines& lines) {
    const std::optional<Lack> lack = run.lack_of(Part::contacts);
    if (!needs_touches(scene.film.shows) || !lack) return;
    if (lack->damaged) throw UserError(lack->what);
    const bool back = run.brings_all_back();
    if (lack->some)
        lines.push_back(
            fmt::format("{}; {}", lack->what,
                        back ? "contacts are brought back" : "the last frames are drawn without contacts"));
    if (lack->some || back) return;
    const char* const advice = "let film.colour.by be something else and film.force_chains false";
    if (run.kind() == Kind::imported)
        throw UserError("{}: its files say no contacts; name files that do by --contacts, or {}",
                        run.path().filename().string(), advice);
    throw UserError("{}: has no contacts.nc; {}; {}", run.path().string(),
                    run.kind() == Kind::elsewhere
                        ? "another engine computed the run, and its dumps have no contacts"
                        : "the run was not told to keep contacts (output.contacts = true)",
                    advice);
}

// Leaves out plots and live words. Empty plots, and words without values, would look like a result of the
// run.
void leave_out_measures(FilmedScene& scene, const std::string& why, Lines& lines) {
    FilmShows& shows = scene.film.shows;
    Lines left_out;
    if (std::erase_if(shows.plots, [](const FilmPlot& plot) { return !plot.is_profile(); }) > 0)
        left_out.emplace_back("plots");
    if (std::exchange(shows.wall_forces.wanted, false)) left_out.emplace_back("forces on walls");
    if (needs_measures(shows)) {
        shows.live_words.clear();
        left_out.emplace_back("live words");
    }
    if (std::erase_if(scene.film.captions, [](const FilmCaption& one) { return has_values(one.words); }) > 0)
        left_out.emplace_back("captions with values");
    lines.push_back(fmt::format("{}; {} are left out", why, fmt::join(left_out, " and ")));
}

void check_columns(const FilmedScene& scene, const StoredRun& run) {
    const auto need = [&](const std::string& name, const std::string& what) {
        if (name.empty() || run.measures()->find(name)) return;
        if (run.kind() == Kind::imported && (name == "kinetic_J" || name == "rotational_J"))
            throw UserError(
                "{}: {} {}, which needs masses, and the files say none; give them by --density "
                "(2500 kg/m3 is glass), or take that out of the film",
                scene.title, what, name);
        if (run.kind() == Kind::imported)
            throw UserError("{}: {} {}, which is known of runs of ours alone; take that out of the film",
                            scene.title, what, name);
        if (run.kind() == Kind::elsewhere)
            throw UserError(
                "{}: {} {}, which is measured in runs of our own engine alone; take "
                "that out of the film",
                run.path().string(), what, name);
        throw UserError(
            "{}: lacks the column {}, which {}; take that out of the film, or run "
            "the scene again with it",
            run.name_of("measures.csv"), name, what);
    };
    need("time_s", "every run has");
    for (const FilmPlot& plot : scene.film.shows.plots) need(plot.column, "film.plot shows");
    for (const LiveWords& part : scene.film.shows.live_words) need(part.column, "film.text shows");
    for (const FilmCaption& caption : scene.film.captions)
        for (const LiveWords& part : caption.words) need(part.column, "film.caption shows");
    if (!scene.film.shows.wall_forces.wanted) return;
    for (const std::string& face : face_names(scene)) need(face + "_force_z_N", "film.wall_forces shows");
}

void look_at_measures(FilmedScene& scene, const StoredRun& run, Lines& lines) {
    if (!needs_measures(scene.film)) return;
    const bool rows = run.measures() && run.measures()->rows() > 0;
    const std::optional<Lack> lack = run.lack_of(Part::measures);
    if (!rows) return leave_out_measures(scene, lack->what, lines);
    check_columns(scene, run);
    if (lack) lines.push_back(lack->what + "; plots and live words stand still from there on");
}

// Sets the colour range of an import to the largest value of all moments. Its scene knows no bed and no
// motion from which a range could be estimated.
void fit_range_of_import(FilmedScene& scene, const StoredRun& run) {
    FilmWalls& walls = scene.film.look.walls;
    const bool by_pressure = walls.colour == FilmWalls::Colour::pressure;
    double most = 0;
    bool any = false;
    for (const State& moment : run.moments())
        for (const MeshWear& mesh : *run.worn(moment.time))
            for (const double value : by_pressure ? mesh.pressure : mesh.wear) {
                if (std::isnan(value)) continue;
                any = true;
                if (std::isfinite(value)) most = std::max(most, value);
            }
    if (!any)
        throw UserError("{}: its walls say no {} of their triangles, and the film colours walls by it",
                        scene.title, by_pressure ? "stress" : "wear");
    if (!walls.fixed && most > 0) walls.range = {1e-3 * most, most};
}

// Walls without the colours of their wear would look as if nothing had touched them.
void look_at_wear(FilmedScene& scene, const StoredRun& run) {
    if (!shows_wear(scene)) return;
    const bool imported = run.kind() == Kind::imported;
    std::string why;
    if (const std::optional<Lack> lack = run.lack_of(Part::wear)) {
        why = lack->what;
        if (!lack->damaged)
            why = imported ? fmt::format(
                                 "{}: its walls say no stress or wear of their triangles, and the film "
                                 "colours walls by it; name files that do by --walls",
                                 scene.title)
                           : why +
                                 ", and the film colours walls by it; run the scene with "
                                 "output.instruments = [\"wear\"]";
    } else if (imported) {
        try {
            fit_range_of_import(scene, run);
        } catch (const UserError& none) {
            why = none.what();
        }
    }
    if (!why.empty())
        throw UserError(why + ", or draw walls without colours, by --set film.walls.colour=plain");
}

// A line where kept frames have no other frame a period before them.
void look_for_earlier_frames(const StoredRun& run, Lines& lines) {
    const std::vector<State>& moments = run.moments();
    const Clock& clock = run.clock();
    const double first = moments.front().cycles + run.periods() - 1e-3;
    std::size_t lack = 0;
    for (const State& moment : moments)
        lack += moment.cycles >= first &&
                !run.index_near(clock.time(clock.step_at(moment.cycles - run.periods())));
    if (lack > 0)
        lines.push_back(fmt::format(
            "{}: {} of its {} frames have none a period before them, and are drawn without displacements; "
            "run the scene with an output.trajectory_interval that divides the period",
            run.name_of("trajectory.nc"), lack, moments.size()));
}

}  // namespace

std::vector<std::string> do_without(FilmedScene& scene, const StoredRun& run) {
    Lines lines;
    const bool elsewhere = run.kind() == Kind::elsewhere;
    if (const auto lack = lacking_elsewhere(scene); lack && elsewhere)
        throw UserError("{}: {}", run.path().string(), *lack);
    check_orientations(scene, run);
    frame_what_is_reached(scene, run);
    look_at_contacts(scene, run, lines);
    look_at_measures(scene, run, lines);
    if (scene.film.shows.outflow)
        if (const auto lack = run.lack_of(Part::outflow))
            lines.push_back(lack->what + "; how much has flowed out is left out");
    look_at_wear(scene, run);
    if (run.brings_all_back()) return lines;
    const char* const why = elsewhere ? "the moments that another engine wrote are single ones"
                                      : "frames that a run kept are single moments; let them be brought "
                                        "back, or run the scene again with `movie`";
    for (std::string& line : single_moment_warnings(scene, why)) lines.push_back(std::move(line));
    if (needs_displacement(scene.film.shows)) look_for_earlier_frames(run, lines);
    return lines;
}

}  // namespace grainreel
