// Keeps imports in the user's cache folder and finds them again.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/base/error.hpp"
#include "engine/base/own_folder.hpp"
#include "engine/base/program.hpp"
#include "engine/files/foreign/raw_series.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/import/import_run.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{4} << 30;  // for all imports together
constexpr const char* kImports = "imports";                     // name of their folder in the cache folder
constexpr const char* kUnfinished = ".part";

// The folder of imports for a user without a cache folder.
fs::path temporary_imports() {
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    if (error)
        throw UserError(fmt::format(
            "the temporary folder, in which files of other programs are imported, cannot be used: "
            "{}; set TMPDIR, or XDG_CACHE_HOME, to a folder of yours",
            error.message()));
    return temporary / fmt::format("grainreel-imports-{}", ::geteuid());
}

// The folder of all imports, which is made if it does not exist. Everybody can make a folder in the temporary
// folder, so one that is not the user's alone is refused.
fs::path import_folder() {
    const fs::path kept = cache_folder() / kImports;
    if (make_own_cache_folder(kImports).empty() && ::access(kept.c_str(), W_OK) == 0) return kept;
    const fs::path imports = temporary_imports();
    const std::string fault = make_own_folder(imports);
    if (!fault.empty())
        throw UserError(
            fmt::format("{}: {}, so that files of other programs cannot be imported there; remove "
                        "it, or set XDG_CACHE_HOME to a folder of yours",
                        imports.string(), fault));
    return imports;
}

// All files on which the import may depend.
std::vector<fs::path> files_behind(const fs::path& from, const ReadingOptions& options) {
    std::vector<fs::path> files;
    const auto add = [&](const fs::path& path) {
        std::error_code ignored;
        std::vector<fs::path> more{path};
        if (is_pattern(path))
            more = files_of_pattern(path);
        else if (fs::is_directory(path, ignored))
            more = files_in(path);
        files.insert(files.end(), more.begin(), more.end());
    };
    add(from);
    std::error_code ignored;
    if (!is_pattern(from) && fs::is_regular_file(from, ignored)) {
        if (!options.one) files = series_of(from).files;
        for (const char* suffix : {".fstat", ".restart"}) {
            fs::path beside = from;
            files.push_back(beside.replace_extension(suffix));
        }
    }
    for (const std::string& one : options.walls) add(one);
    for (const std::string& one : options.contacts) add(one);
    if (!options.container.empty()) files.push_back(options.container);
    return files;
}

// All options as a text for the key. An import made with an option that is missing here would be found again
// for any value of it.
std::string text_of(const ReadingOptions& o) {
    std::string text = fmt::format("{} {} {} {} {} {} {} {}", o.one, o.units, o.radius.value_or(0),
                                   o.time_step.value_or(0), o.density.value_or(0), o.walls_scale.value_or(0),
                                   o.container.string(), o.moves_with_container);
    for (const auto& [name, value] : o.columns) text += fmt::format("|c {}={}", name, value);
    for (const auto& [name, value] : o.radius_of_type) text += fmt::format("|r {}={}", name, value);
    for (const auto& [name, value] : o.species) text += fmt::format("|s {}={}", name, value);
    for (const std::string& one : o.walls) text += "|w " + one;
    for (const std::string& one : o.contacts) text += "|k " + one;
    return text;
}

// The key of an import: its options and, for each file, the name, size, inode and time of the last change.
std::string key_of(const ImportRequest& request) {
    std::string text = request.program_version + "\n" + fs::absolute(request.from).string() + "\n" +
                       text_of(request.reading);
    for (const fs::path& file : files_behind(request.from, request.reading)) {
        struct stat facts {};
        if (::stat(file.c_str(), &facts) != 0) continue;
        text += fmt::format("\n{} {} {} {}.{}", fs::absolute(file).string(), facts.st_size, facts.st_ino,
                            facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec);
    }
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::uintmax_t size_of(const fs::path& folder) {
    std::uintmax_t bytes = 0;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error))
        if (entry.is_regular_file(error)) bytes += entry.file_size(error);
    return bytes;
}

// Whether this is the folder of an import, finished or not. Its name is a key, and .PROCESS.part follows
// while it is being made. Only such folders are counted and removed.
bool is_import(const fs::path& folder) {
    constexpr std::size_t kKey = 32;
    const std::string name = folder.filename().string();
    const std::size_t digits = name.find_first_not_of("0123456789abcdef");
    const bool named = digits == std::string::npos
                           ? name.size() == kKey
                           : digits == kKey && name[kKey] == '.' && folder.extension() == kUnfinished;
    std::error_code error;
    return named && is_own(folder) && fs::symlink_status(folder, error).type() == fs::file_type::directory;
}

// Whether another process may be working on an unfinished import. One older than a day was left by a process
// that was killed.
bool is_being_made(const fs::path& folder) {
    std::error_code error;
    return folder.extension() == kUnfinished &&
           fs::file_time_type::clock::now() - fs::last_write_time(folder, error) < std::chrono::hours(24);
}

// Removes the imports that were not used for the longest time.
void make_room(const fs::path& imports, const fs::path& keep) {
    struct One {
        fs::path folder;
        fs::file_time_type used;
        std::uintmax_t bytes;
    };
    std::vector<One> all;
    std::uintmax_t bytes = 0;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(imports, error)) {
        if (!is_import(entry.path())) continue;
        all.push_back({entry.path(), entry.last_write_time(error), size_of(entry.path())});
        bytes += all.back().bytes;
    }
    std::sort(all.begin(), all.end(), [](const One& a, const One& b) { return a.used < b.used; });
    for (const One& one : all) {
        if (bytes <= kMostBytes) return;
        if (one.folder == keep || is_being_made(one.folder)) continue;
        fs::remove_all(one.folder, error);
        bytes -= one.bytes;
    }
}

Imported found(const fs::path& folder) {
    Imported run;
    run.folder = folder;
    std::ifstream news(folder / kImportNews);
    for (std::string line; std::getline(news, line);)
        if (!line.empty()) run.news.push_back(line);
    std::error_code ignored;
    fs::last_write_time(folder.parent_path(), fs::file_time_type::clock::now(), ignored);
    return run;
}

// The name of the run that is made of these files.
std::string run_name_of(const fs::path& from) {
    std::string name = from.filename().string();
    if (name.empty() || name == "." || name == "..")
        name = fs::absolute(from).lexically_normal().parent_path().filename().string();
    for (char& c : name)
        if (std::string("*?[]").find(c) != std::string::npos) c = '_';
    return name;
}

}  // namespace

UnfinishedImport::UnfinishedImport(const ImportRequest& request) {
    const fs::path part = import_folder() / fmt::format("{}.{}{}", key_of(request), ::getpid(), kUnfinished);
    std::error_code ignored;
    fs::remove_all(part, ignored);
    if (const std::string fault = make_own_folder(part); !fault.empty())
        throw RunError(fmt::format("{}: cannot be made: {}", part.string(), fault));
    folder_ = part / run_name_of(request.from);
}

UnfinishedImport::~UnfinishedImport() {
    std::error_code ignored;
    fs::remove_all(folder_.parent_path(), ignored);
}

void UnfinishedImport::touch() const {
    std::error_code ignored;
    fs::last_write_time(folder_.parent_path(), fs::file_time_type::clock::now(), ignored);
}

Imported cached_import(ImportRequest request) {
    const fs::path imports = import_folder(), place = imports / key_of(request);
    const std::string name = run_name_of(request.from);
    std::error_code error;
    const auto is_there = [&] {
        std::error_code ignored;
        return was_own_folder(place) && fs::exists(place / name / "scene.toml", ignored) &&
               fs::exists(place / name / kImportNews, ignored);
    };
    if (is_there()) return found(place / name);
    // The first process to finish keeps the name.
    const UnfinishedImport part(request);
    request.folder = part.folder();
    Imported run = import_run(request);
    if (!is_there()) {  // else another process has finished it, and its reader may be at it
        fs::remove_all(place, error);
        fs::rename(part.folder().parent_path(), place, error);
    }
    if (error && !fs::exists(place / name / "scene.toml"))
        throw RunError(fmt::format("{}: cannot be made: {}", place.string(), error.message()));
    make_room(imports, place);
    run.folder = place / name;
    return run;
}

ImportsKept imports_kept() {
    std::error_code error;
    ImportsKept kept;
    kept.most_bytes = kMostBytes;
    kept.folder = own_cache_folder(kImports);
    if (kept.folder.empty()) kept.folder = temporary_imports();
    if (!fs::exists(fs::symlink_status(kept.folder, error))) return kept;
    kept.fault = fault_of_own_folder(kept.folder);
    if (!kept.fault.empty()) return kept;
    for (const fs::directory_entry& entry : fs::directory_iterator(kept.folder, error)) {
        if (!is_import(entry.path())) continue;
        ++kept.imports;
        kept.bytes += size_of(entry.path());
    }
    return kept;
}

}  // namespace grainreel
