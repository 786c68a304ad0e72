#include "engine/files/mesh_copies.hpp"

#include <fmt/format.h>

#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/scene/file/kept_files.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::error_code& error) {
    throw RunError(
        fmt::format("{}: the copy of a mesh or path cannot be written: {}", file.string(), error.message()));
}

bool holds(const fs::path& file, const std::string& hash) {
    try {
        return is_plain(file) && hash_of_file(file) == hash;
    } catch (const UserError&) {
        return false;
    }
}

// Where a file is that lay in a folder which has been moved aside.
fs::path place_now(const fs::path& file, const fs::path& folder, const fs::path& previous) {
    const fs::path inside = file.lexically_relative(fs::absolute(folder).lexically_normal());
    std::error_code ignored;
    if (previous.empty() || inside.empty() || *inside.begin() == ".." || fs::exists(file, ignored))
        return file;
    return previous / inside;
}

}  // namespace

void keep_file(const fs::path& from, const std::string& hash, const fs::path& to) {
    if (holds(to, hash)) return;
    if (const std::error_code error = make_plain_folder(to.parent_path())) fail(to.parent_path(), error);
    const fs::path part = to.string() + ".part";
    std::error_code error;
    make_way(part);
    fs::copy_file(from, part, error);
    if (error) fail(to, error);
    if (!holds(part, hash)) {
        fs::remove(part, error);
        throw UserError(fmt::format("{}: has changed since it was read; start again", from.string()));
    }
    fs::rename(part, to, error);
    if (error) fail(to, error);
}

void keep_mesh_files(const Scene& scene, const fs::path& folder, const fs::path& previous) {
    for (const KeptFile& one : kept_files(scene))
        keep_file(place_now(one.from, folder, previous), one.hash, folder / one.name);
}

}  // namespace grainreel
