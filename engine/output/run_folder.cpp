#include "engine/output/run_folder.hpp"

#include <unistd.h>

#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void cannot_make(const fs::path& path, const std::error_code& error) {
    throw UserError(fmt::format("{}: the folder cannot be made: {}; choose another with --out", path.string(),
                                error.message()));
}

// Something of that name is there, be it a link to nowhere.
bool taken(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
}

// "a/b/" and "a/b/." mean "a/b".
fs::path without_trailing_slash(const fs::path& path) {
    fs::path plain = fs::absolute(path).lexically_normal();
    if (!plain.has_filename()) plain = plain.parent_path();
    return path.is_absolute() ? plain : plain.lexically_proximate(fs::current_path());
}

}  // namespace

RunFolder::RunFolder(const RunFolderRequest& request) {
    if (request.out) {
        const fs::path path = without_trailing_slash(*request.out);
        if (taken(path)) {
            if (!request.force) {
                throw UserError(
                    fmt::format("--out {}: exists already; choose another name, or --force to replace "
                                "it when the new run is complete",
                                path.string()));
            }
            if (!taken(path / "run.json")) {
                throw UserError(fmt::format(
                    "--out {}: holds no run (no run.json), so --force leaves it alone; choose another name",
                    path.string()));
            }
            move_aside(path);
        }
        if (!make(path)) cannot_make(path, std::make_error_code(std::errc::file_exists));
        return;
    }
    fs::path path = request.base / request.name;
    for (int number = 2; !make(path); ++number)
        path = request.base / fmt::format("{}-{}", request.name, number);
}

bool RunFolder::make(const fs::path& path) {
    std::error_code error;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    if (!error) {
        // The test and the taking in one: of two runs that start together, one gets the name.
        const bool made = fs::create_directory(path, error);
        if (!made && (!error || error == std::errc::file_exists)) return false;
    }
    if (!error && ::access(path.c_str(), W_OK | X_OK) != 0) error = {errno, std::generic_category()};
    if (error) {
        std::error_code ignored;
        if (!previous_.empty()) fs::rename(previous_, path, ignored);
        cannot_make(path, error);
    }
    path_ = path;
    return true;
}

void RunFolder::move_aside(const fs::path& path) {
    const std::string hidden = "." + path.filename().string() + ".old-";
    int number = 1;
    while (taken(path.parent_path() / (hidden + std::to_string(number)))) ++number;
    const fs::path aside = path.parent_path() / (hidden + std::to_string(number));
    std::error_code error;
    fs::rename(path, aside, error);
    if (error) {
        throw UserError(fmt::format("--out {}: the old run cannot be moved aside: {}; choose another name",
                                    path.string(), error.message()));
    }
    previous_ = aside;
}

void RunFolder::remove_previous() {
    std::error_code ignored;  // what cannot be removed stays, hidden, and harms nobody
    if (!previous_.empty()) fs::remove_all(previous_, ignored);
    previous_.clear();
}

void RunFolder::discard() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    if (!previous_.empty()) fs::rename(previous_, path_, ignored);
    previous_.clear();
}

}  // namespace grainreel
