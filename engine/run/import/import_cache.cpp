// Keeps imports in the user's cache folder and finds them again.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <xxhash.h>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/file_state.hpp"
#include "engine/base/system/own_folder.hpp"
#include "engine/base/system/program.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/file_groups.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/import/import_run.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{4} << 30;  // for all imports together
constexpr const char* kImports = "imports";                     // name of their folder in the cache folder
constexpr const char* kUnfinished = ".part";
constexpr const char* kSeal = ".seal";  // name of the file with the state of an import when it was finished

// The folder of imports for a user without a cache folder; empty where no temporary folder can be used.
fs::path temporary_imports() {
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    return error ? fs::path() : temporary / fmt::format("grainreel-imports-{}", ::geteuid());
}

// The same, made if it does not exist. Everybody can make a folder in the temporary folder, so one that is
// not the user's alone is refused.
fs::path own_temporary_imports() {
    const fs::path imports = temporary_imports();
    if (imports.empty())
        throw UserError(
            "the temporary folder, in which files of other programs are imported, cannot be used; set "
            "TMPDIR, "
            "or XDG_CACHE_HOME, to a folder of yours");
    const std::string fault = make_own_folder(imports);
    if (!fault.empty())
        throw UserError(
            "{}: {}, so that files of other programs cannot be imported there; remove "
            "it, or set XDG_CACHE_HOME to a folder of yours",
            imports.string(), fault);
    return imports;
}

// The folder of imports in the user's cache folder, made if it does not exist; empty where it cannot be
// written.
fs::path cached_imports() {
    const fs::path kept = cache_folder() / kImports;
    return make_own_cache_folder(kImports).empty() && ::access(kept.c_str(), W_OK) == 0 ? kept : fs::path();
}

// The files that the import begins with. Others that these name, such as pieces of a list, are found when
// they are read; the seal of an import has them all.
std::vector<fs::path> files_behind(const fs::path& from, const ReadingOptions& options) {
    std::vector<fs::path> files;
    const auto add = [&](const fs::path& path) {
        std::vector<fs::path> more{path};
        if (is_pattern(path))
            more = files_of_pattern(path);
        else if (is_folder(path))
            more = files_in(path);
        files.insert(files.end(), more.begin(), more.end());
    };
    add(from);
    if (!is_pattern(from) && is_plain(from)) {
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

// Without the number of the device, which may change when a disk is mounted again.
std::string text_of(const FileState& state) {
    return fmt::format("{} {} {} {}", state.size, state.inode, state.changed, state.touched);
}

// The key of an import: its options and, for each file, the name, size, inode and times of the last changes.
std::string key_of(const ImportRequest& request) {
    std::string text = request.program_version + "\n" + fs::absolute(request.from).string() + "\n" +
                       text_of(request.reading);
    for (const fs::path& file : files_behind(request.from, request.reading)) {
        if (const std::optional<FileState> state = state_of_file(file))
            text += fmt::format("\n{} {}", fs::absolute(file).string(), text_of(*state));
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

// The hash of a file's content; of a large file only both ends are hashed.
std::uint64_t hash_of(const fs::path& path) {
    constexpr std::size_t piece = std::size_t{1} << 20;
    constexpr std::uint64_t most = std::uint64_t{32} << 20;  // bytes at each end
    const FileBytes file(path);
    const std::uint64_t size = file.state().size;
    std::vector<char> bytes(std::min<std::uint64_t>(size, piece));
    std::uint64_t hash = 0, place = 0;
    while (place < size) {
        if (place >= most && place + most < size) place = size - most;
        const std::size_t got = file.read_at(place, bytes.data(), bytes.size());
        if (got == 0) break;
        hash = XXH3_64bits_withSeed(bytes.data(), got, hash);
        place += got;
    }
    return hash;
}

// All files in the folder of an import, with size, time of change and content. Empty where it holds anything
// else than files and folders of the user, such as a link or a pipe.
std::string files_of_import(const fs::path& folder) {
    std::vector<std::string> files;
    if (!was_own_folder(folder)) return {};
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::file_type type = entry->symlink_status(error).type();
        if (!is_own(entry->path())) return {};
        if (type == fs::file_type::directory) continue;
        if (type != fs::file_type::regular) return {};
        const std::optional<FileState> state = state_of_file(entry->path());
        if (!state) return {};
        try {
            files.push_back(fmt::format("{} {} {} {:016x}\n",
                                        entry->path().lexically_relative(folder).string(), state->size,
                                        state->changed, hash_of(entry->path())));
        } catch (const UserError&) {  // it cannot be read
            return {};
        }
    }
    if (error) return {};
    std::sort(files.begin(), files.end());
    std::string all;
    for (const std::string& file : files) all += file;
    return all;
}

// The seal of an import: the states of all files that it was made of, as they were when they were read, and
// the files that were made. An import is taken only where all of them are still the same; else it is made
// anew.
void write_seal(const fs::path& place, const std::string& name, const FilesRead& read) {
    std::string sources;
    std::size_t count = 0;
    for (const auto& [file, state] : read.all()) {
        if (file.string().starts_with(place.string())) continue;  // made by the import itself
        sources += fmt::format("{}\n{}\n", file.string(), text_of(state));
        ++count;
    }
    replace_file(place / kSeal, fmt::format("{}\n", count) + sources + files_of_import(place / name));
}

bool is_sealed(const fs::path& place, const std::string& name) {
    if (!was_own_folder(place) || !is_own(place / kSeal)) return false;
    std::ifstream seal = read_plain(place / kSeal);
    std::string line, file;
    std::getline(seal, line);
    for (std::int64_t left = whole_in(line).value_or(0); left > 0; --left) {
        if (!std::getline(seal, file) || !std::getline(seal, line)) return false;
        const std::optional<FileState> state = state_of_file(file);
        if (!state || text_of(*state) != line) return false;
    }
    const std::string files(std::istreambuf_iterator<char>(seal), {});
    return !files.empty() && files == files_of_import(place / name);
}

// The import in a folder of imports; none where there is none that can be believed.
std::optional<Imported> kept_import(const fs::path& place, const std::string& name) {
    if (!is_sealed(place, name)) return std::nullopt;
    Imported run;
    run.folder = place / name;
    std::ifstream news = read_plain(run.folder / kImportNews);
    for (std::string line; std::getline(news, line);)
        if (!line.empty()) run.news.push_back(line);
    std::error_code ignored;
    fs::last_write_time(place, fs::file_time_type::clock::now(), ignored);
    return run;
}

// Makes the import in a folder of the process's own and then gives it its name. The first process to finish
// keeps the name.
Imported new_import(const fs::path& place, const std::string& name, ImportRequest request) {
    const UnfinishedImport unfinished(place, name);
    const fs::path part = unfinished.folder().parent_path();
    request.folder = unfinished.folder();
    std::error_code error;
    try {
        const FilesRead sources;
        Imported run = import_run(request);
        write_seal(part, name, sources);
        if (!is_sealed(place, name)) {  // else another process has finished it, and its reader may be at it
            fs::remove_all(place, error);
            fs::rename(part, place, error);
        }
        if (error && !is_sealed(place, name))
            throw RunError("{}: cannot be made: {}", place.string(), error.message());
        make_room(place.parent_path(), place);
        run.folder = place / name;
        return run;
    } catch (const UserError& mistake) {
        throw UserError(named_as(mistake.what(), request.folder, request.from));
    }
}

// The name of the folder of a run that is made of these files.
std::string name_of_import(const fs::path& from) {
    std::string name = from.filename().string();
    if (name.empty() || name == "." || name == "..")
        name = fs::absolute(from).lexically_normal().parent_path().filename().string();
    for (char& c : name)
        if (std::string("*?[]").find(c) != std::string::npos) c = '_';
    return name == kSeal ? name + "_" : name;
}

}  // namespace

UnfinishedImport::UnfinishedImport(const fs::path& place, const std::string& name) {
    const fs::path part = place.string() + fmt::format(".{}{}", ::getpid(), kUnfinished);
    std::error_code ignored;
    fs::remove_all(part, ignored);
    if (const std::string fault = make_own_folder(part); !fault.empty())
        throw RunError("{}: cannot be made: {}", part.string(), fault);
    folder_ = part / name;
}

UnfinishedImport::UnfinishedImport(const ImportRequest& request)
    : UnfinishedImport(
          (cached_imports().empty() ? own_temporary_imports() : cached_imports()) / key_of(request),
          name_of_import(request.from)) {}

UnfinishedImport::~UnfinishedImport() {
    std::error_code ignored;
    fs::remove_all(folder_.parent_path(), ignored);
}

void UnfinishedImport::touch() const {
    std::error_code ignored;
    fs::last_write_time(folder_.parent_path(), fs::file_time_type::clock::now(), ignored);
}

std::string named_as(std::string text, const fs::path& folder, const fs::path& from) {
    const std::string path = folder.string();
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at)) {
        const std::size_t behind = at + path.size();
        const bool inside = behind < text.size() && text[behind] == '/';
        const std::string name = from.string() + (inside ? ": " : "");
        text.replace(at, path.size() + (inside ? 1 : 0), name);
        at += name.size();
    }
    return text;
}

Imported cached_import(ImportRequest request) {
    const std::string name = name_of_import(request.from), key = key_of(request);
    const fs::path cache = cached_imports(), temporary = temporary_imports();
    if (!cache.empty())
        if (std::optional<Imported> kept = kept_import(cache / key, name)) return *kept;
    if (was_own_folder(temporary))
        if (std::optional<Imported> kept = kept_import(temporary / key, name)) return *kept;
    bool stopped = false;
    if (request.watcher)
        request.watcher = [&stopped, watcher = request.watcher](double done) {
            return !(stopped = stopped || !watcher(done));
        };
    if (!cache.empty()) {
        try {
            return new_import(cache / key, name, request);
        } catch (const RunError&) {  // such as a full disk; there may be room in the temporary folder
            if (stopped) throw;
        }
    }
    return new_import(own_temporary_imports() / key, name, request);
}

ImportsKept imports_kept() {
    std::error_code error;
    ImportsKept kept;
    kept.most_bytes = kMostBytes;
    kept.folder = own_cache_folder(kImports);
    if (kept.folder.empty()) kept.folder = temporary_imports();
    if (kept.folder.empty()) kept.fault = "there is no folder for them";
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
