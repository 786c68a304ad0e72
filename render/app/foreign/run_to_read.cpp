#include "render/app/foreign/run_to_read.hpp"

#include <fmt/format.h>

#include "build_info.hpp"
#include "engine/base/error.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/foreign/raw_series.hpp"
#include "engine/handover/bring_back.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/run/import/import_run.hpp"
#include "render/app/messages/reporter.hpp"

namespace grainreel {

namespace fs = std::filesystem;

fs::path folder_around(const fs::path& path) {
    std::error_code ignored;
    if (!is_pattern(path) && fs::is_directory(path, ignored)) {
        const fs::path whole = fs::absolute(path).lexically_normal();
        return whole.has_filename() ? whole.parent_path() : whole.parent_path().parent_path();
    }
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

RunToRead run_to_read(const fs::path& path, const ReadingOptions& reading, Reporter& reporter) {
    if (!is_foreign(path)) {
        if (const std::string option = given_reading(reading); !option.empty())
            throw UserError(
                fmt::format("{}: is for files of other programs, and {} is a run of ours or is not there",
                            option, path.string()));
        if (is_handover(path)) {
            const ShareWatcher watcher(reporter, Progress::Stage::paging);
            const BroughtBack back = bring_back(
                path, build_info::version, [&](double done) { return watcher("reading the dump", done); });
            for (const std::string& line : back.news) reporter.info(line);
        }
        return {path, path.parent_path(), false};
    }
    ImportRequest request;
    request.from = path;
    request.reading = reading;
    request.program_version = fmt::format("{} ({})", build_info::version, build_info::commit);
    const ShareWatcher watcher(reporter, Progress::Stage::paging);
    request.watcher = [&](double done) { return watcher("reading " + path.filename().string(), done); };
    const ImportedRun run = cached_import(request);
    for (const std::string& line : run.news) reporter.info(line);
    return {run.folder, folder_around(path), true};
}

}  // namespace grainreel
