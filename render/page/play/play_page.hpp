// The page on which a bed is computed while one looks: one file with the engine, the scene, its knobs and the
// scripts (render/page/html/play).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/page/play/web_engine.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

constexpr std::int64_t kMostPlayedGrains = 20000;

// The scene as a page plays it: without what only a film or files need, and long enough to go on, unless
// grains come or walls move on their own. Throws UserError for what a page cannot play.
FilmedScene played_scene(FilmedScene scene);

struct PlayPage {
    const FilmedScene& scene;  // as played_scene() gives it
    const Plan& plan;
    const WebEngine& engine;
    bool soft = false;  // whether stiffness and step are those of play, not the scene's own
};

// Writes the page; an earlier one is replaced. Gives its size in bytes. Throws RunError.
std::size_t write_play_page(const PlayPage& page, const std::filesystem::path& out);

}  // namespace grainreel
