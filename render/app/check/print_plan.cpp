#include "render/app/check/print_plan.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <sstream>

#include "engine/plan/plan_bed.hpp"
#include "render/film/sampling/film_limits.hpp"
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

}  // namespace grainreel
