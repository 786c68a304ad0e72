// Rain: where above the bed its grains appear, and how many a second.
#pragma once

#include "engine/scene/scene.hpp"

namespace grainreel {

// Heights of centres over the bed's surface; m. They appear between the two.
struct RainLayer {
    double low = 0, high = 0;
};
RainLayer rain_layer(const Scene& scene);

// m: the deepest fall of a grain of the rain.
double rain_drop(const Scene& scene);

// 1/s: as the scene says, or as many as fill a twentieth of the layer that they fall through.
double rain_rate(const Scene& scene);

// s: how long the next grain may find no place before there is none, five times a fall through the layer.
double rain_patience(const Scene& scene);
// s: twice as long as it rains where every grain finds its place at once, and that patience.
double rain_limit(const Scene& scene);

}  // namespace grainreel
