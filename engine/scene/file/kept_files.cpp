#include "engine/scene/file/kept_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace grainreel {

namespace fs = std::filesystem;

namespace {

std::string name_for(const fs::path& file, const std::vector<KeptFile>& taken) {
    const auto is_taken = [&](const std::string& name) {
        return std::any_of(taken.begin(), taken.end(), [&](const KeptFile& one) { return one.name == name; });
    };
    const std::string stem = file.stem().string(), end = file.extension().string();
    std::string name = fmt::format("{}/{}{}", kMeshFolder, stem, end);
    for (int number = 2; is_taken(name); ++number)
        name = fmt::format("{}/{}-{}{}", kMeshFolder, stem, number, end);
    return name;
}

// The name that a file has, which is kept from here on.
std::string keep(const std::string& file, const std::string& hash, std::vector<KeptFile>& kept) {
    const fs::path path = file;
    if (file.empty() || path.filename().string().starts_with("shipped:")) return file;
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const KeptFile& one) {
        return one.hash == hash && fs::path(one.from).filename() == path.filename();
    });
    if (same != kept.end()) return same->name;
    kept.push_back({file, hash, name_for(path, kept)});
    return kept.back().name;
}

}  // namespace

std::vector<KeptFile> kept_files(const Scene& scene) {
    std::vector<KeptFile> kept;
    for (const SceneMesh& mesh : scene.meshes) {
        keep(mesh.file, mesh.hash, kept);
        keep(mesh.path_file, mesh.path_hash, kept);
    }
    return kept;
}

Scene naming_kept_files(Scene scene) {
    std::vector<KeptFile> kept;
    for (SceneMesh& mesh : scene.meshes) {
        mesh.file = keep(mesh.file, mesh.hash, kept);
        mesh.path_file = keep(mesh.path_file, mesh.path_hash, kept);
    }
    return scene;
}

}  // namespace grainreel
