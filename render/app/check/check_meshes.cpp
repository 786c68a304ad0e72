// Walls that come from files: what was read, what was mended, how they move.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "engine/mesh/surface.hpp"
#include "render/app/check/check_parts.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

std::string vector_text(const Vec3& v) {
    return fmt::format("({:.3g}, {:.3g}, {:.3g})", v.x(), v.y(), v.z());
}

std::string counted(std::int64_t count, const char* one, const char* many) {
    return fmt::format("{} {}", grouped(count), count == 1 ? one : many);
}

// "drum: drum.stl, binary STL, 720 triangles, 200 mm x 300 mm x 200 mm"
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
