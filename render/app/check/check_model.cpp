// What `check` says about the model: what is computed and how, each kind of contact, and walls that come from
// files.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "engine/lab/chart/accuracy/single_contact.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/contact_kinds.hpp"
#include "engine/scene/bed.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

std::string stiffness_text(const PairPlan& pair) {
    return pair.modulus > 0 ? fmt::format("{:.3g} Pa", pair.modulus)
                            : fmt::format("{:.3g} N/m", pair.loading_stiffness);
}

}  // namespace

void print_model(const FilmedScene& scene, const Plan& plan, Listing& list) {
    std::vector<std::string> in, out;
    const auto any = [&](auto&& is) {
        const auto of = [&](const PairPlan& pair) { return is(pair.model); };
        return std::any_of(plan.grain.begin(), plan.grain.end(), of) ||
               std::any_of(plan.wall.begin(), plan.wall.end(), of) ||
               std::any_of(plan.mesh.begin(), plan.mesh.end(), of);
    };
    const auto note = [&](bool used, const char* what) {
        if (used) in.push_back(what);
    };
    const auto normal = [&](NormalForce law) {
        return any([&](const ContactModel& m) { return m.normal == law; });
    };
    const auto tangential = [&](TangentialLaw law) {
        return any([&](const ContactModel& m) { return m.tangential == law; });
    };
    const bool by_speed = normal(NormalForce::walton_braun_speed) || normal(NormalForce::walton_braun_table);
    const bool corrected = normal(NormalForce::walton_braun_corrected);
    note(normal(NormalForce::walton_braun) || corrected || by_speed,
         "normal force: Walton-Braun latching spring");
    note(corrected, "corrections of onset, peak and exit");
    note(by_speed, "restitution that depends on speed");
    note(normal(NormalForce::spring_dashpot), "normal force: linear spring and dashpot");
    note(normal(NormalForce::hertz), "normal force: Hertz with dashpot");
    note(tangential(TangentialLaw::incremental_slip), "friction: Walton's incremental slip");
    note(tangential(TangentialLaw::linear_spring), "friction: linear spring with Coulomb's cap");
    note(tangential(TangentialLaw::mindlin), "friction: Mindlin's spring with Coulomb's cap");
    const bool rubs = plan.rubs();
    (plan.rolls() ? in : out).push_back("rolling resistance");
    note(scene.run.precision == Precision::mixed, "contact laws in single precision");
    (rubs ? in : out).push_back("spin and torque");
    if (!rubs) out.push_back("friction");
    (scene.gravity.norm() > 0 ? in : out).push_back("gravity");
    (plan.moving_walls ? in : out).push_back("moving walls");
    for (const char* absent : {"air", "cohesion", "wear and breakage"}) out.push_back(absent);
    if (normal(NormalForce::walton_braun) || corrected) out.push_back("restitution that depends on speed");
    list.line("modelled", fmt::format("{}", fmt::join(in, ", ")));
    list.line("left out", fmt::format("{}", fmt::join(out, ", ")));
}

namespace {

// A row of the table of contacts.
struct Kind {
    std::string name, restitution;
    const PairPlan* pair;
    const Species* first;
    const Species* second;  // null for a wall
};

// The restitution as text: "0.5", or the range over the sizes of both grains, "0.29 to 0.82".
std::string restitution_text(const Plan& plan, const PairPlan& pair, const Species& a, const Species* b) {
    const RestitutionRange range = restitution_range(plan, pair, a, b);
    const std::string low = fmt::format("{:.3g}", range.low), high = fmt::format("{:.3g}", range.high);
    return low == high ? low : low + " to " + high;
}

std::vector<Kind> kinds_of(const FilmedScene& scene, const Plan& plan, const Species* glued) {
    std::vector<Kind> kinds;
    const auto add = [&](const std::string& name, const PairPlan& pair, const Species& a, const Species* b) {
        kinds.push_back({name, restitution_text(plan, pair, a, b), &pair, &a, b});
    };
    for (std::size_t a = 0; a < scene.species.size(); ++a) {
        const Species& first = scene.species[a];
        if (first.all() == 0) continue;  // all its grains are glued to walls
        for (std::size_t b = a; b < scene.species.size(); ++b) {
            const Species& second = scene.species[b];
            if (second.all() > 0 &&
                (a != b || first.all() > 1))  // a single grain never meets another one of its species
                add(first.name + " - " + second.name, plan.between(a, b), first, &second);
        }
        const Container::Shape shape = scene.container.shape;
        const bool has_faces = shape != Container::Shape::none && shape != Container::Shape::mesh;
        if (has_faces || !scene.walls.empty()) add(first.name + " - wall", plan.wall[a], first, nullptr);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            add(fmt::format("{} - {}", first.name, scene.meshes[m].name),
                plan.mesh[m * scene.species.size() + a], first, nullptr);
        if (glued) add(first.name + " - glued", plan.glued[a], first, glued);
    }
    return kinds;
}

}  // namespace

void print_contacts(const FilmedScene& scene, const Plan& plan, std::ostream& out) {
    const bool rough = !plan.glued.empty();
    const Species glued = rough ? glued_species(scene) : Species();
    std::size_t widest = 8, longest = 6;
    const std::vector<Kind> kinds = kinds_of(scene, plan, rough ? &glued : nullptr);
    for (const Species& s : scene.species) widest = std::max(widest, 2 * s.name.size() + 3);
    for (const SceneMesh& mesh : scene.meshes)
        for (const Species& s : scene.species)
            widest = std::max(widest, s.name.size() + mesh.name.size() + 3);
    for (const Kind& kind : kinds) longest = std::max(longest, kind.restitution.size());
    fmt::print(out, "{:<13}{:<{}}{:>14}  {:<13}{:>{}}{:>8}{:>10}{:>12}{:>9}\n", "contacts", "", widest,
               "stiffness", "chosen for", "e", longest, "error", "friction", "duration", "steps");
    for (const Kind& kind : kinds) {
        const PairPlan& pair = *kind.pair;
        fmt::print(out, "{:<13}{:<{}}{:>14}  {:<13}{:>{}}{:>8}{:>10.3g}{:>12}{:>9.1f}\n", "", kind.name,
                   widest, stiffness_text(pair), pair.stiffness_reason, kind.restitution, longest,
                   promised_error_text(promised_restitution_error(plan, pair, *kind.first, kind.second)),
                   pair.friction, span_text(pair.contact_time), pair.contact_time / plan.clock.step);
    }
}

namespace {

std::string vector_text(const Vec3& v) {
    return fmt::format("({:.3g}, {:.3g}, {:.3g})", v.x(), v.y(), v.z());
}

std::string counted(std::int64_t count, const char* one, const char* many) {
    return fmt::format("{} {}", grouped(count), count == 1 ? one : many);
}

// "drum: drum.stl, binary STL, 720 triangles, 200 mm x 300 mm x 200 mm from (...) to (...) m"
std::string shape_text(const SceneMesh& mesh) {
    const MeshFacts& facts = mesh.surface->facts();
    const Vec3 size = facts.high - facts.low;
    std::string text = fmt::format("{}: {}, {}, {}, {} x {} x {} from {} to {} m", mesh.name,
                                   std::filesystem::path(mesh.file).filename().string(), facts.format,
                                   counted(facts.triangles, "triangle", "triangles"), metres_text(size.x()),
                                   metres_text(size.y()), metres_text(size.z()), vector_text(facts.low),
                                   vector_text(facts.high));
    if (mesh.scale != 1) text += fmt::format(", scaled by {:.4g}", mesh.scale);
    return text;
}

std::string slender_text(const MeshFacts& facts) {
    if (facts.slender == 0) return "";
    return fmt::format(", {} slender (lower than a thousandth of their longest side)",
                       counted(facts.slender, "triangle", "triangles"));
}

// "2 solids, closed"; "1 part, open: 4 edges of one triangle alone"
std::string edges_text(const MeshFacts& facts) {
    if (facts.closed()) return counted(facts.solids, "solid", "solids") + ", closed" + slender_text(facts);
    std::string text = counted(facts.solids, "part", "parts");
    if (facts.open_edges > 0)
        text += ", open: " + counted(facts.open_edges, "edge", "edges") + " of one triangle alone";
    if (facts.crowded_edges > 0)
        text += ", " + counted(facts.crowded_edges, "edge", "edges") + " of more than two triangles";
    return text + slender_text(facts);
}

}  // namespace

std::string turn_text(const BodyTurn& turn) {
    std::string text =
        fmt::format("turns at {:.4g} rpm about the axis {} through {} m", turn.rate * 30 / std::numbers::pi,
                    vector_text(turn.axis), vector_text(turn.through));
    if (turn.from > 0) text += fmt::format(", from {:.4g} s", turn.from);
    if (turn.over > 0) text += fmt::format(", begun over {:.4g} s", turn.over);
    if (std::isfinite(turn.until)) text += fmt::format(", until {:.4g} s", turn.until);
    return text;
}

std::string motion_text(const SceneMesh& mesh) {
    std::vector<std::string> parts;
    if (mesh.driven) parts.emplace_back("moves with the drive");
    if (mesh.turn) parts.push_back(turn_text(*mesh.turn));
    if (mesh.velocity.norm() > 0) parts.push_back(fmt::format("moves at {} m/s", vector_text(mesh.velocity)));
    if (mesh.path)
        parts.push_back(
            fmt::format("follows {} from {:.4g} to {:.4g} s, at up to {:.3g} m/s{}",
                        std::filesystem::path(mesh.path_file).filename().string(), mesh.path->first(),
                        mesh.path->last(), mesh.path->top_speed(),
                        mesh.path->turns() ? fmt::format(" and {:.3g} rad/s", mesh.path->top_spin()) : ""));
    return parts.empty() ? "stands still" : fmt::format("{}", fmt::join(parts, "; "));
}

void print_meshes(const Scene& scene, Listing& list) {
    for (const SceneMesh& mesh : scene.meshes) {
        list.line("mesh", shape_text(mesh));
        list.line("", edges_text(mesh.surface->facts()));
        for (const std::string& line : mesh.surface->facts().mended) list.line("", "mended: " + line);
        list.line("", motion_text(mesh));
    }
}

}  // namespace grainreel
