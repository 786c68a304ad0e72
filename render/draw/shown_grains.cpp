#include "render/draw/shown_grains.hpp"

namespace grainreel {
namespace {

template <class T>
void keep(std::vector<T>& values, const std::vector<std::size_t>& kept) {
    if (values.empty()) return;
    for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];  // kept[k] >= k
    values.resize(kept.size());
}

}  // namespace

ShownGrains::ShownGrains(const Scene& scene, const std::vector<std::size_t>& left_out)
    : left_out_(scene.species.size(), false) {
    for (const std::size_t species : left_out) left_out_[species] = any_ = true;
}

const Frame& ShownGrains::of(const Frame& frame) {
    if (!any_) return frame;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < frame.size(); ++i)
        if (!left_out_[static_cast<std::size_t>(frame.species[i])]) kept.push_back(i);
    shown_ = frame;
    keep(shown_.id, kept);
    keep(shown_.species, kept);
    keep(shown_.radius, kept);
    keep(shown_.position, kept);
    keep(shown_.velocity, kept);
    keep(shown_.spin, kept);
    keep(shown_.orientation, kept);
    keep(shown_.displacement, kept);
    return shown_;
}

}  // namespace grainreel
