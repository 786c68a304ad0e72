// A file of a run's folder, for whoever asks for it by name.
#pragma once

#include <filesystem>
#include <string>

#include "render/page/live/server.hpp"

namespace grainreel {

// path: of the request, "/measures.csv". 404 for all that is no plain file right in the folder: paths, hidden
// files, links, folders.
WatchAnswer run_file(const std::filesystem::path& folder, const std::string& path);

}  // namespace grainreel
