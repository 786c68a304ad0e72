// The live page's HTML.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/page/report.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Its scripts ask for the rest: live.js.
std::string live_page(const FilmedScene& scene, const std::filesystem::path& folder,
                      const std::optional<PlannedScene>& planned);
// Until the run has told its scene: asks again by itself.
std::string waiting_page(const std::string& title);

}  // namespace grainreel
