// What to say to somebody whose film does not fit under its cap.
#pragma once

#include <cstdint>
#include <string>

namespace grainreel {

// In words, which film of the same scene has `share` of its bytes: "--size 854x480, or 180 of its 352
// frames". Bytes go with the number of frames, and with the pixels to the power 0.7 (the wedge at 640x360 and
// 1280x720, quality 24: 4 times the pixels, 2.8 times the bytes). A tenth is kept in hand.
std::string smaller_film(int width, int height, std::int64_t frames, double share);

}  // namespace grainreel
