#include "render/app/check/print_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/measure/flow/beverloo.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/plan_bed.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/state/glued_grains.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

std::string start_text(const FilmedScene& scene, const Plan& plan) {
    if (scene.start.packs() && scene.grains_at_start() == 0) return "empty; all grains come by [[feed]]";
    const std::string settling =
        fmt::format("then settling for {} at most", span_text(scene.start.settle_limit));
    switch (scene.start.method) {
        case Start::Method::layers:
            return "layers, " + settling;
        case Start::Method::rain:
            return fmt::format("rain of {:.4g} grains a second for {}, {}", rain_rate(scene),
                               span_text(static_cast<double>(scene.grains_at_start()) / rain_rate(scene)),
                               settling);
        case Start::Method::file:
            return fmt::format("from {}{}{}", scene.start.file, plan.start.text.empty() ? "" : "; ",
                               plan.start.text);
        case Start::Method::grains:
            break;
    }
    return "the grains as listed";
}

void print_time(const FilmedScene& scene, const Plan& plan, Listing& list) {
    const std::int64_t period = plan.clock.steps_per_period;
    list.line("step",
              fmt::format("{}{}, chosen for: {}", span_text(plan.clock.step),
                          period > 0 ? fmt::format(", {} a period", grouped(period)) : "", plan.step_reason));
    list.line("steps", fmt::format("{} for {}", grouped(plan.steps), span_text(plan.clock.time(plan.steps))));
    list.line("start", start_text(scene, plan));
    list.line(
        "overlap",
        fmt::format("up to {:.2g} % of the smaller diameter expected{}, with impacts at {:.3g} m/s; most "
                    "contacts stay below {:.2g} %",
                    100 * plan.expected_overlap, scene.species.size() > 1 ? " (" + plan.deepest + ")" : "",
                    plan.impact_speed, 100 * std::max(scene.run.overlap, plan.usual_overlap)));
}

// Whether a warning is about a mesh that was mended. The lines about that mesh say so already.
bool is_of_mended_mesh(const Scene& scene, const std::string& warning) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const SceneMesh& mesh) {
        const std::vector<std::string>& mended = mesh.surface->facts().mended;
        return std::any_of(mended.begin(), mended.end(), [&](const std::string& line) {
            return warning.ends_with(fmt::format(": mesh \"{}\": {}", mesh.name, line));
        });
    });
}

}  // namespace

void print_plan(const FilmedScene& scene, const Plan& plan, std::ostream& out) {
    Listing list(out);
    print_setup(scene, plan, list);
    list.gap();
    print_model(scene, plan, list);
    list.gap();
    print_contacts(scene, plan, out);
    print_time(scene, plan, list);
    list.gap();
    const std::vector<SegmentCount> film = count_film(scene, plan.clock, plan.steps);
    check_schedule(scene, film);
    print_files(scene, plan, film, list);
    print_cost(scene, plan, film, list);
    std::vector<std::string> warnings = plan.warnings;
    std::erase_if(warnings, [&](const std::string& line) { return is_of_mended_mesh(scene, line); });
    for (std::string& line : pace_warnings(scene, plan.clock)) warnings.push_back(std::move(line));
    for (std::string& line : strobe_warnings(scene.film, scene.drive, scene.run.duration))
        warnings.push_back(std::move(line));
    for (std::string& line : film_warnings(scene, frames_of(film))) warnings.push_back(std::move(line));
    if (!warnings.empty()) list.gap();
    for (const std::string& line : warnings) list.line("warning", line);
    const std::vector<std::string> hints = film_hints(scene);
    if (!hints.empty() && warnings.empty()) list.gap();
    for (const std::string& line : hints) list.line("hint", line);
}

PlanWords plan_words(const FilmedScene& scene, const Plan& plan) {
    std::ostringstream printed, contacts;
    Listing list(printed);
    print_setup(scene, plan, list);
    print_model(scene, plan, list);
    print_time(scene, plan, list);
    print_contacts(scene, plan, contacts);
    return {list.lines(), contacts.str()};
}

// From here on: the first chapter, which is about the experiment (grains, container, drive).

namespace {

std::string diameter_text(const SizeSpread& d) {
    switch (d.kind) {
        case SizeSpread::Kind::fixed:
            return metres_text(d.mean);
        case SizeSpread::Kind::uniform:
            return fmt::format("{} to {}", metres_text(d.smallest), metres_text(d.largest));
        case SizeSpread::Kind::normal:
            break;
    }
    return fmt::format("{} +- {}", metres_text(d.mean), metres_text(d.deviation));
}

std::string vessel_text(const Container& c) {
    const double low = c.base(), high = c.height;
    return fmt::format("the mesh {}, with room for {:.3g} l from z = {} to {}, width {}, depth {}, {}",
                       c.mesh, 1e3 * c.volume(), metres_text(low), metres_text(high),
                       metres_text(2 * c.half_width), metres_text(c.depth),
                       c.room->open_above() ? "open above" : "closed above");
}

std::string container_text(const Container& c) {
    const std::string top = c.lid ? "closed by a lid" : "open above";
    switch (c.shape) {
        case Container::Shape::wedge:
            return fmt::format(
                "wedge, {:.4g} deg from the vertical up to {}, width {} at the floor and {} above, depth "
                "{}{}, "
                "height {}, {}",
                c.half_angle * 180 / std::numbers::pi, metres_text(c.slant_height),
                metres_text(2 * c.floor_half_width()), metres_text(2 * c.half_width), metres_text(c.depth),
                c.periodic_depth ? " (periodic)" : "", metres_text(c.height), top);
        case Container::Shape::box:
            return fmt::format("box, width {}, depth {}{}, height {}, {}", metres_text(2 * c.half_width),
                               metres_text(c.depth), c.periodic_depth ? " (periodic)" : "",
                               metres_text(c.height), top);
        case Container::Shape::mesh:
            return vessel_text(c);
        case Container::Shape::none:
            return "none";
        case Container::Shape::cylinder:
            break;
    }
    return fmt::format("cylinder, diameter {}, height {}, {}", metres_text(2 * c.half_width),
                       metres_text(c.height), top);
}

std::string rough_text(const FilmedScene& scene) {
    const WallGrains& layer = *scene.container.wall_grains;
    const Species& species = scene.species[layer.species];
    const std::size_t count = glue_grains(scene, container_faces(scene.container, scene.drive)).size();
    return fmt::format("{} {} of {} glued to {}", grouped(static_cast<std::int64_t>(count)), species.name,
                       diameter_text(species.diameter), fmt::join(layer.faces, ", "));
}

std::string wall_text(const ScenePlane& wall) {
    std::string text = fmt::format("{}: plane towards ({:.3g}, {:.3g}, {:.3g})", wall.name, wall.normal.x(),
                                   wall.normal.y(), wall.normal.z());
    if (wall.velocity.norm() > 0) text += fmt::format(", moving at {:.3g} m/s", wall.velocity.norm());
    return wall.moves ? text + ", follows the drive" : text;
}

std::string box_text(const Vec3& low, const Vec3& high) {
    return fmt::format("the box from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m", low.x(),
                       low.y(), low.z(), high.x(), high.y(), high.z());
}

std::string feed_text(const FilmedScene& scene, const Feed& feed) {
    const double end = std::min(feed.until.value_or(scene.run.duration), scene.run.duration);
    return fmt::format("{} {} at {:.4g} 1/s, from {:.4g} to {:.4g} s", grouped(feed.due(scene.run.duration)),
                       scene.species[feed.species].name, feed.rate, feed.from, end);
}

std::string drive_text(const FilmedScene& scene) {
    const Drive& d = scene.drive;
    if (!d.present) return "none";
    const double g = scene.gravity.norm();
    const std::string level = g > 0 ? fmt::format(", Γ = {:.4g}", d.g_level(g)) : "";
    const std::string along = d.direction == Vec3(0, 0, 1)
                                  ? "up and down"
                                  : fmt::format("along ({:.3g}, {:.3g}, {:.3g})", d.direction.x(),
                                                d.direction.y(), d.direction.z());
    const std::string ramp = d.ramp > 0 ? fmt::format("grows over {:.3g} periods", d.ramp) : "starts at once";
    const std::string phase = d.phase != 0 ? fmt::format(", phase {:.4g} deg", d.phase * 360) : "";
    return fmt::format("{} {}, {:.4g} Hz, amplitude {}{}, top speed {:.3g} m/s{}, {}",
                       d.moves == Drive::Moves::container ? "container" : "floor", along, d.frequency,
                       metres_text(d.amplitude), level, d.speed(), phase, ramp);
}

// "from 2.01 s over 3 periods: 12 Hz, amplitude 5 mm, Γ = 3"
std::string stage_text(const FilmedScene& scene, const DriveSchedule& schedule, std::size_t number) {
    const DriveStage& stage = scene.drive.stages[number - 1];
    const double begins = schedule.begins(number), settled = schedule.settled(number);
    std::string text = fmt::format("from {:.6g} s", begins);
    if (settled > begins) text += fmt::format(" over {} periods, until {:.6g} s", stage.over, settled);
    if (stage.kind == DriveStage::Kind::rest) return text + ": at rest";
    const bool taps = stage.kind == DriveStage::Kind::taps;
    text += fmt::format(": {}{:.4g} Hz, amplitude {}", taps ? "taps of " : "", stage.frequency,
                        metres_text(stage.amplitude));
    const double gravity = scene.gravity.norm();
    const Drive of_stage{true, stage.frequency, stage.amplitude};
    if (gravity > 0) text += fmt::format(", Γ = {:.4g}", of_stage.g_level(gravity));
    if (taps) text += fmt::format(", one every {:.4g} s", stage.interval);
    const double peak = peak_acceleration_of_change(schedule, number) / gravity;
    if (gravity > 0 && peak > 0) text += fmt::format("; at most Γ = {:.4g} in the change", peak);
    return text;
}

void print_stages(const FilmedScene& scene, Listing& list) {
    if (!scene.drive.changes()) return;
    const DriveSchedule schedule(scene.drive);
    for (std::size_t k = 1; k <= scene.drive.stages.size(); ++k)
        list.line("", stage_text(scene, schedule, k));
}

}  // namespace

void print_setup(const FilmedScene& scene, const Plan& plan, Listing& list) {
    list.line("scene", fmt::format("{} ({})", scene.title, scene.file));
    list.line("grains", fmt::format("{}, {:.3g} kg", grouped(scene.grains()), total_mass(scene)));
    for (const Species& s : scene.species) {
        if (s.all() == 0) continue;  // all its grains are glued to walls
        list.line("", fmt::format("{} {} of {}, {:.4g} kg/m3{}", grouped(s.all()), s.name,
                                  diameter_text(s.diameter), s.density,
                                  s.fed > 0 ? fmt::format(", {} of them fed", grouped(s.fed)) : ""));
    }
    for (const Feed& feed : scene.feeds) list.line("feed", feed_text(scene, feed));
    list.line("container", container_text(scene.container));
    if (scene.container.turn) list.line("", turn_text(*scene.container.turn));
    if (scene.container.wall_grains) list.line("", rough_text(scene));
    if (const auto& tray = scene.container.tray)
        list.line("", fmt::format("tray {} below the floor, width {}", metres_text(tray->depth),
                                  metres_text(2 * tray->half_width)));
    for (const ScenePlane& wall : scene.walls) list.line("", wall_text(wall));
    print_meshes(scene, list);
    for (const ExitBox& box : scene.exits)
        list.line("exit", box_text(box.low, box.high) +
                              (box.outside ? ": grains leave outside of it" : ": grains leave in it"));
    if (const auto& region = scene.start.region) list.line("filled", box_text(region->low, region->high));
    if (scene.start.method != Start::Method::grains)
        list.line("bed",
                  fmt::format("about {} high at rest, {:.0f} % of the container's height",
                              metres_text(plan.bed_height),
                              100 * plan.bed_height / (scene.container.height - scene.container.base())));
    list.line("gravity", fmt::format("{:.4g} m/s2", scene.gravity.norm()));
    if (const auto rate = beverloo_rate(scene))
        list.line("outflow",
                  fmt::format("Beverloo's law expects {:.4g} kg/s: {}", *rate, beverloo_words(scene)));
    list.line("drive", drive_text(scene));
    print_stages(scene, list);
}

std::string metres_text(double metres) {
    const double size = std::abs(metres);
    if (size >= 1) return fmt::format("{:.4g} m", metres);
    if (size >= 1e-3 || size == 0) return fmt::format("{:.4g} mm", metres * 1e3);
    return fmt::format("{:.3g} \u00b5m", metres * 1e6);
}

std::string span_text(double seconds) {
    if (seconds >= 5400) return fmt::format("{:.1f} h", seconds / 3600);
    if (seconds >= 90) return fmt::format("{:.1f} min", seconds / 60);
    if (seconds >= 0.1) return fmt::format("{:.3g} s", seconds);
    return seconds >= 1e-3 ? fmt::format("{:.3g} ms", seconds * 1e3)
                           : fmt::format("{:.3g} \u00b5s", seconds * 1e6);
}

std::string grouped(std::int64_t count) {
    std::string digits = fmt::format("{}", count);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

}  // namespace grainreel
