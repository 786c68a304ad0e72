#include "render/scene/film.hpp"

#include <algorithm>

namespace grainreel {

bool Camera::framed_by_user() const {
    return position || target || zoom != 1 ||
           std::any_of(keys.begin(), keys.end(), [](const CameraKey& key) { return key.zoom || key.target; });
}

}  // namespace grainreel
