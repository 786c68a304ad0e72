// The case `render` of `grainreel bench`: the drawing of a bed at rest, by stage.
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
    Film film;                     // as that style has it
    int threads = 0;               // 0: as many as there are processors
    int repeats = 1;
    std::optional<std::filesystem::path> out;  // where the picture and what other renderers need is kept
    bool json = false;
};

// Draws a bed at rest again and again and prints milliseconds a frame by stage. Returns the exit status.
int bench_render(const BenchRenderRequest& request, Reporter& reporter);

}  // namespace grainreel
