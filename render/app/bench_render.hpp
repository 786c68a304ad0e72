// The case `render` of `grainreel bench`: measures how long the stages of drawing a bed at rest take.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/app/messages/reporter.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct BenchRenderRequest {
    int grains = 10125;
    std::string style = "studio";  // a film's style, or "plain"
    Film film;                     // the film's settings for that style
    int threads = 0;               // 0: as many threads as there are processors
    int repeats = 1;
    std::optional<std::filesystem::path> out;  // folder for the picture and the files for other renderers
    bool json = false;
};

// Draws a bed at rest again and again and prints how many milliseconds a frame takes in each stage. Returns
// the exit status.
int bench_render(const BenchRenderRequest& request, Reporter& reporter);

}  // namespace grainreel
