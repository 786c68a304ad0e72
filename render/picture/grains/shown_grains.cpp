#include "render/picture/grains/shown_grains.hpp"

#include <algorithm>
#include <utility>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

template <class T>
void keep(std::vector<T>& values, const std::vector<std::size_t>& kept) {
    if (values.empty()) return;
    for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];  // kept[k] >= k
    values.resize(kept.size());
}

}  // namespace

std::vector<HalfSpace> kept_by_cut(const FilmCut& cut, const Frame& frame) {
    if (!cut.present) return {};
    const Vec3& normal = cut.normal;
    // The cut goes with a floor that shakes, not with one that turns.
    const bool turns = !frame.floor().rotation.isApprox(Quaternion::Identity());
    const double at = cut.at + (turns ? 0 : normal.dot(frame.floor().place));
    std::vector<HalfSpace> kept{{-normal, -at}};
    if (cut.thickness > 0) kept.push_back({normal, at - cut.thickness});
    return kept;
}

ShownGrains::ShownGrains(const FilmedScene& scene, const std::vector<std::size_t>& left_out) {
    if (left_out.empty()) return;
    left_out_.resize(scene.species.size(), false);
    for (const std::size_t species : left_out) left_out_[species] = true;
}

ShownGrains ShownGrains::only(const FilmedScene& scene, std::vector<std::int32_t> ids) {
    ShownGrains shown(scene, {});
    shown.only_ = std::move(ids);
    return shown;
}

ShownGrains ShownGrains::beside_cut(const FilmedScene& scene) {
    ShownGrains shown(scene, {});
    shown.cut_ = scene.film.look.cut;
    return shown;
}

const Frame& ShownGrains::of(const Frame& frame) {
    if (!any()) return frame;
    const std::vector<HalfSpace> halves = kept_by_cut(cut_, frame);
    const auto is_kept = [&](std::size_t i) {
        if (!left_out_.empty() && left_out_[static_cast<std::size_t>(frame.species[i])]) return false;
        if (!only_.empty() && !std::binary_search(only_.begin(), only_.end(), frame.id[i])) return false;
        return std::all_of(halves.begin(), halves.end(), [&](const HalfSpace& half) {
            return half.normal.dot(frame.position[i]) - half.distance > -frame.radius[i];
        });
    };
    kept_.clear();
    for (std::size_t i = 0; i < frame.size(); ++i)
        if (is_kept(i)) kept_.push_back(i);
    shown_ = frame;
    keep(shown_.id, kept_);
    keep(shown_.species, kept_);
    keep(shown_.radius, kept_);
    keep(shown_.position, kept_);
    keep(shown_.velocity, kept_);
    keep(shown_.spin, kept_);
    keep(shown_.orientation, kept_);
    keep(shown_.displacement, kept_);
    return shown_;
}

}  // namespace grainreel
