#include "engine/measure/flow/beverloo.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {
namespace {

constexpr double of_hole = 0.58, of_slot = 1.03, empty_edge = 1.4;  // C of both, and k

bool is_upright(const Scene& scene) {
    const Vec3& g = scene.gravity;
    return g.z() < 0 && math::hypot(g.x(), g.y()) < 1e-9 * -g.z() && !scene.container.turn;
}

}  // namespace

std::optional<double> beverloo_rate(const Scene& scene) {
    const Container& container = scene.container;
    if (!container.outlet || !is_upright(scene)) return std::nullopt;
    const double edge = empty_edge * mean_diameter(scene), volume = solid_volume(scene);
    const double free_width = 2 * container.outlet->half_width - edge;
    if (!(free_width > 0) || !(volume > 0)) return std::nullopt;
    const double density = kFlowingFraction * total_mass(scene) / volume;
    const double base = density * std::sqrt(scene.gravity.norm());
    if (container.outlet->shape == Outlet::Shape::hole) return of_hole * base * math::pow(free_width, 2.5);
    const double length = container.depth - (container.periodic_depth ? 0 : edge);
    if (!(length > 0)) return std::nullopt;
    return of_slot * base * length * math::pow(free_width, 1.5);
}

std::string beverloo_words(const Scene& scene) {
    const Outlet& outlet = *scene.container.outlet;
    const double d = mean_diameter(scene);
    const bool ends = !scene.container.periodic_depth;
    if (outlet.shape == Outlet::Shape::hole)
        return fmt::format("W = {} ρ √g (D - {} d)^(5/2) with D = {:.4g} mm, d = {:.4g} mm", of_hole,
                           empty_edge, 2000 * outlet.half_width, 1000 * d);
    return fmt::format("W = {} ρ √g {} (B - {} d)^(3/2) with B = {:.4g} mm, L = {:.4g} mm, d = {:.4g} mm",
                       of_slot, ends ? fmt::format("(L - {} d)", empty_edge) : "L", empty_edge,
                       2000 * outlet.half_width, 1000 * scene.container.depth, 1000 * d);
}

std::string why_no_beverloo(const Scene& scene) {
    if (beverloo_rate(scene)) return "";
    if (!scene.container.outlet) return "it is for an outlet in the floor (container.outlet)";
    if (!is_upright(scene)) return "it is for gravity along -z and a vessel that does not turn";
    return fmt::format("the outlet is too small for grains of {:.4g} mm", 1000 * mean_diameter(scene));
}

std::size_t first_with(const std::vector<double>& gone, double mass) {
    return static_cast<std::size_t>(std::lower_bound(gone.begin(), gone.end(), mass) - gone.begin());
}

std::optional<double> mean_outflow_rate(const std::vector<double>& times, const std::vector<double>& gone) {
    if (times.empty() || times.size() != gone.size() || !(gone.back() > 0)) return std::nullopt;
    const std::size_t begin = first_with(gone, 0.1 * gone.back()), end = first_with(gone, 0.7 * gone.back());
    if (!(times[end] > times[begin])) return std::nullopt;
    return (gone[end] - gone[begin]) / (times[end] - times[begin]);
}

}  // namespace grainreel
