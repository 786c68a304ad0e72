#include "engine/handover/back/trim_dump.hpp"

#include <charconv>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/handover/back/dump_tail.hpp"
#include "engine/handover/deck_parts.hpp"

namespace grainreel {

namespace fs = std::filesystem;

std::optional<std::int64_t> newest_restart(const fs::path& folder, PeerEngine engine) {
    const std::string begin = restart_name(engine) + ".";
    std::optional<std::int64_t> newest;
    std::error_code missing;
    for (const fs::directory_entry& one : fs::directory_iterator(folder, missing)) {
        const std::string name = one.path().filename().string();
        if (!name.starts_with(begin)) continue;
        std::int64_t step = 0;
        const char* const end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + begin.size(), end, step);
        if (read.ec == std::errc() && read.ptr == end) newest = std::max(newest.value_or(0), step);
    }
    return newest;
}

void trim_dump(const fs::path& dump, std::int64_t step) {
    DumpTail tail(dump);
    std::uintmax_t kept = 0;
    while (const std::optional<DumpRows> rows = tail.next()) {
        if (rows->step > step) break;
        kept = tail.taken();
    }
    std::error_code failed;
    fs::resize_file(dump, kept, failed);
    if (failed) throw RunError(fmt::format("{}: cannot be cut: {}", dump.string(), failed.message()));
}

}  // namespace grainreel
