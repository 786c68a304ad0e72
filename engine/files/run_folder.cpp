#include "engine/files/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void cannot_make(const fs::path& path, const std::error_code& error) {
    throw UserError("{}: the folder cannot be made: {}; choose another with --out", path.string(),
                    error.message());
}

// Whether something has that name, even a link to nowhere.
bool taken(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored));
}

bool is_empty_folder(const fs::path& path) {
    std::error_code error;
    return is_folder(path) && fs::is_empty(path, error) && !error;
}

bool is_real_folder(const fs::directory_entry& entry) {
    return entry.symlink_status().type() == fs::file_type::directory;
}

using IsOurs = std::function<bool(const fs::directory_entry&)>;

bool is_ours_in_frames(const fs::directory_entry& entry) {
    return !is_real_folder(entry) && is_frame(entry.path().filename());
}

bool is_ours_in_checkpoints(const fs::directory_entry& entry) {
    return !is_real_folder(entry) && is_checkpoint_of_ring(entry.path().filename());
}

// The first entry, by name, that no run has written, or the folder itself when it cannot be read.
std::optional<fs::path> first_foreign(const fs::path& folder, const IsOurs& ours) {
    std::error_code error;
    std::optional<fs::path> first;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (!ours(entry) && (!first || entry.path() < *first)) first = entry.path();
    return error ? folder : first;
}

// In also/, the folder of a format must hold only files of that format.
bool is_ours_in_also(const fs::directory_entry& entry) {
    if (!is_real_folder(entry)) return is_in_also(entry.path().filename());
    return !first_foreign(entry.path(), [](const fs::directory_entry& inside) {
        return !is_real_folder(inside) && is_in_also(inside.path().filename());
    });
}

// Whether the scene in the folder names the file, or whether it is an unfinished copy of such a file.
IsOurs is_ours_in_meshes(const fs::path& run) {
    std::ifstream file = read_plain(run / "scene.toml");
    std::string scene{std::istreambuf_iterator<char>(file), {}};
    return [scene = std::move(scene)](const fs::directory_entry& entry) {
        const fs::path name = entry.path().filename();
        const fs::path whole = name.extension() == ".part" ? name.stem() : name;
        const std::string kept = quoted((fs::path(kMeshFolder) / whole).string());
        return !is_real_folder(entry) && scene.find(kept) != std::string::npos;
    };
}

// The first entry in a run's folder that no run has written. In the folder of a comparison, the folders of
// its runs count as entries of runs.
std::optional<fs::path> foreign_file(const fs::path& run) {
    const std::vector<std::string> panels = read_run_json(run / "run.json").record.panels;
    const auto is_panel = [&](const fs::path& name) { return contains(panels, name.string()); };
    const auto is_ours = [&](const fs::directory_entry& entry) {
        const fs::path name = entry.path().filename();
        return is_real_folder(entry) ? is_folder_of_runs(name) || is_panel(name) : is_file_of_runs(name);
    };
    if (auto foreign = first_foreign(run, is_ours)) return foreign;
    const fs::path frames = run / "frames";
    if (is_real_folder(fs::directory_entry(frames)))
        if (auto foreign = first_foreign(frames, is_ours_in_frames)) return foreign;
    const fs::path checkpoints = run / "checkpoints";
    if (is_real_folder(fs::directory_entry(checkpoints)))
        if (auto foreign = first_foreign(checkpoints, is_ours_in_checkpoints)) return foreign;
    const fs::path also = run / kAlsoFolder;
    if (is_real_folder(fs::directory_entry(also)) && !is_panel(kAlsoFolder))
        if (auto foreign = first_foreign(also, is_ours_in_also)) return foreign;
    const fs::path meshes = run / kMeshFolder;
    if (is_real_folder(fs::directory_entry(meshes)))
        if (auto foreign = first_foreign(meshes, is_ours_in_meshes(run))) return foreign;
    for (const std::string& panel : panels)
        if (panel.find('/') == std::string::npos && is_real_folder(fs::directory_entry(run / panel)))
            if (auto foreign = foreign_file(run / panel)) return foreign;
    return std::nullopt;
}

[[noreturn]] void refuse_in_use(const fs::path& path, const std::string& holder) {
    throw UserError("--out {}: is in use by {}; wait until that ends, or choose another name", path.string(),
                    holder);
}

void check_not_in_use(const fs::path& path) {
    if (const auto holder = FolderLock::holder(path)) refuse_in_use(path, *holder);
}

void check_holds_run(const fs::path& path) {
    if (!taken(path / "run.json")) {
        throw UserError(
            "--out {}: holds no run (no run.json), so --force leaves it alone; choose another name",
            path.string());
    }
}

// --force may replace only a run and nothing else, and no run may be going on there.
void check_replaceable(const fs::path& path) {
    const RunJson record = read_run_json(path / "run.json").record;
    for (const std::string& panel : record.panels)
        if (panel.find('/') == std::string::npos) check_not_in_use(path / panel);
    if (const auto foreign = foreign_file(path)) {
        throw UserError(
            "--out {}: holds {}, which is no file of a run, so --force leaves the folder "
            "alone; move that file away or choose another name",
            path.string(), foreign->lexically_relative(path).string());
    }
}

// The path "a/b" for "a/b/" and "a/b/."
fs::path without_trailing_slash(const fs::path& path) {
    fs::path plain = fs::absolute(path).lexically_normal();
    if (!plain.has_filename()) plain = plain.parent_path();
    return path.is_absolute() ? plain : plain.lexically_proximate(fs::current_path());
}

}  // namespace

RunFolder::RunFolder(const FolderRequest& request) : command_(request.command) {
    if (request.goes_on) {
        lock_ = request.goes_on;
        goes_on_ = true;
        return;
    }
    if (request.out) {
        take(*request.out, request.force);
        return;
    }
    fs::path path = request.base / request.name;
    for (int number = 2; !make(path); ++number)
        path = request.base / fmt::format("{}-{}", request.name, number);
}

void RunFolder::check(const fs::path& out, bool force) {
    if (out.empty()) throw UserError("--out: the name is empty; name a folder, or leave out --out");
    const fs::path path = without_trailing_slash(out);
    if (is_empty_folder(path)) return;
    if (taken(path)) {
        check_not_in_use(path);
        if (!force) {
            throw UserError(
                "--out {}: exists already; choose another name, or --force to replace "
                "it when the new run is complete",
                path.string());
        }
        return check_holds_run(path);
    }
    // The folder is made in the nearest one above it that is there.
    fs::path above = fs::absolute(path).parent_path();
    while (!taken(above) && above != above.parent_path()) above = above.parent_path();
    if (::access((above / "").c_str(), W_OK | X_OK) != 0)
        cannot_make(path, std::error_code(errno, std::generic_category()));
}

void RunFolder::take(const fs::path& out, bool force) {
    check(out, force);
    const fs::path path = without_trailing_slash(out);
    if (is_empty_folder(path)) return adopt(path);
    if (taken(path)) {
        previous_lock_ = locked(path);
        check_replaceable(path);
        move_aside(path);
    }
    if (!make(path)) cannot_make(path, std::make_error_code(std::errc::file_exists));
}

void RunFolder::adopt(const fs::path& path) {
    // The log must not exist yet. So if two runs start together, only one gets the folder.
    const int log = ::open((path / "log.txt").c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (log < 0) {
        throw UserError("--out {}: the folder cannot be used: {}; choose another name", path.string(),
                        std::generic_category().message(errno));
    }
    ::close(log);
    lock_ = locked(path);
    adopted_ = true;
}

RunFolder::Lock RunFolder::locked(const fs::path& path) const {
    std::optional<FolderLock> lock = FolderLock::take(path, command_);
    if (!lock) refuse_in_use(path, FolderLock::holder(path).value_or("another process"));
    return std::make_shared<FolderLock>(std::move(*lock));
}

bool RunFolder::make(const fs::path& path) {
    std::error_code error;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    if (!error) {
        // Test and creation are one call. So if two runs start together, only one gets the name.
        const bool made = fs::create_directory(path, error);
        if (!made && (!error || error == std::errc::file_exists)) return false;
    }
    if (!error && ::access(path.c_str(), W_OK | X_OK) != 0) error = {errno, std::generic_category()};
    if (error) {
        put_back(path);
        cannot_make(path, error);
    }
    lock_ = locked(path);
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
        throw UserError("--out {}: the old run cannot be moved aside: {}; choose another name", path.string(),
                        error.message());
    }
    previous_ = aside;
    previous_lock_->renamed(aside);
}

void RunFolder::put_back(const fs::path& path) {
    if (previous_.empty()) return;
    std::error_code error;
    fs::rename(previous_, path, error);
    if (!error) previous_lock_->renamed(path);
    previous_lock_.reset();
    previous_.clear();
}

void RunFolder::remove_previous() {
    if (previous_.empty() || foreign_file(previous_))
        return;               // somebody has put another file there meanwhile
    std::error_code ignored;  // what cannot be removed stays hidden and does no harm
    fs::remove_all(previous_, ignored);
    previous_.clear();
}

void RunFolder::discard() {
    if (goes_on_ || !lock_->is_there()) return;
    std::error_code ignored;
    if (adopted_) {
        for (const fs::directory_entry& entry : fs::directory_iterator(path(), ignored))
            fs::remove_all(entry.path(), ignored);
        return;
    }
    fs::remove_all(path(), ignored);
    put_back(path());
}

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::error_code& error) {
    throw RunError("{}: the copy of a mesh or path cannot be written: {}", file.string(), error.message());
}

bool holds(const fs::path& file, const std::string& hash) {
    try {
        return is_plain(file) && hash_of_file(file) == hash;
    } catch (const UserError&) {
        return false;
    }
}

// The present place of a file in a folder that was moved aside.
fs::path place_now(const fs::path& file, const fs::path& folder, const fs::path& previous) {
    const fs::path inside = file.lexically_relative(fs::absolute(folder).lexically_normal());
    if (previous.empty() || inside.empty() || *inside.begin() == ".." || is_there(file)) return file;
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
        throw UserError("{}: has changed since it was read; start again", from.string());
    }
    fs::rename(part, to, error);
    if (error) fail(to, error);
}

void keep_mesh_files(const Scene& scene, const fs::path& folder, const fs::path& previous) {
    for (const KeptFile& one : kept_files(scene))
        keep_file(place_now(one.from, folder, previous), one.hash, folder / one.name);
}

}  // namespace grainreel
