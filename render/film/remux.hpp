// From the fragmented MP4 that survives a kill to an ordinary one with its index in front.
#pragma once

#include <filesystem>
#include <string>

namespace grainreel {

// Copies the film's packets to `path`.part, syncs it and renames it over `path`. Throws RunError, naming the
// file and the reason, and leaves the fragmented film as it was.
void remux_for_streaming(const std::filesystem::path& path);

// A path as FFmpeg wants it: a colon in a name must not look like a protocol.
std::string ffmpeg_url(const std::filesystem::path& path);

}  // namespace grainreel
