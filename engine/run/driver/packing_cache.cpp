#include "engine/run/driver/packing_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <system_error>
#include <vector>

#include "engine/base/system/own_folder.hpp"
#include "engine/base/system/program.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{2} << 30;  // bytes of all packings together
constexpr const char* kPackings = "packings";                   // name of their folder in the cache folder
constexpr const char* kEnd = ".grs";

struct One {
    fs::path file;
    fs::file_time_type used;
    std::uintmax_t bytes;
};

// Whether a file has the name of a packing, finished or not: 32 digits of a hash and ".grs", perhaps with
// more behind it. Only such files are counted and removed.
bool is_packing(const fs::path& file) {
    constexpr std::size_t kHash = 32;
    const std::string name = file.filename().string();
    return name.find_first_not_of("0123456789abcdef") == kHash && name.compare(kHash, 4, kEnd) == 0 &&
           is_own(file);
}

std::vector<One> all_in(const fs::path& folder) {
    std::vector<One> all;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code gone;
        const bool plain = at->is_regular_file(gone);
        const One one{at->path(), at->last_write_time(gone), at->file_size(gone)};
        if (plain && !gone && is_packing(one.file)) all.push_back(one);
    }
    return all;
}

// Whether another run may still be writing this file. A file older than a day was left by a run that was
// killed.
bool is_being_made(const One& one) {
    return one.file.extension() != kEnd &&
           fs::file_time_type::clock::now() - one.used < std::chrono::hours(24);
}

void make_room(const fs::path& folder, const fs::path& keep) {
    std::vector<One> all = all_in(folder);
    std::uintmax_t bytes = 0;
    for (const One& one : all) bytes += one.bytes;
    std::sort(all.begin(), all.end(), [](const One& a, const One& b) { return a.used < b.used; });
    for (const One& one : all) {
        const bool left_over = one.file.extension() != kEnd && !is_being_made(one);
        if (!left_over && (bytes <= kMostBytes || one.file == keep || is_being_made(one))) continue;
        std::error_code ignored;
        fs::remove(one.file, ignored);
        bytes -= one.bytes;
    }
}

}  // namespace

fs::path place_of_packing(const std::string& key) {
    const fs::path cache = cache_folder();
    if (cache.empty() || key.empty()) return {};
    const XXH128_hash_t hash = XXH3_128bits(key.data(), key.size());
    return cache / kPackings / fmt::format("{:016x}{:016x}{}", hash.high64, hash.low64, kEnd);
}

bool is_own_packing(const fs::path& place) {
    return !own_cache_folder(kPackings).empty() && is_own(place);
}

void note_packing_used(const fs::path& place) {
    std::error_code ignored;
    fs::last_write_time(place, fs::file_time_type::clock::now(), ignored);
}

std::string keep_packing(const fs::path& place, const std::function<void(const fs::path&)>& write) {
    static std::atomic<int> number = 0;  // several runs of one process pack at the same time
    const fs::path part = place.string() + fmt::format(".{}-{}.new", ::getpid(), number++);
    std::error_code error;
    try {
        if (const std::string fault = make_own_cache_folder(kPackings); !fault.empty()) return fault;
        write(part);
        fs::rename(part, place, error);
        if (!error) {
            make_room(place.parent_path(), place);
            return "";
        }
        fs::remove(part, error);
        return fmt::format("{}: cannot be made", place.string());
    } catch (const std::exception& problem) {
        fs::remove(part, error);
        return problem.what();
    }
}

PackingsKept packings_kept() {
    PackingsKept kept;
    kept.folder = own_cache_folder(kPackings);
    kept.most_bytes = kMostBytes;
    for (const One& one : all_in(kept.folder)) {
        kept.packings += one.file.extension() == kEnd ? 1 : 0;
        kept.bytes += one.bytes;
    }
    return kept;
}

}  // namespace grainreel
