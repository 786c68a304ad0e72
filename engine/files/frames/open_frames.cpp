#include "engine/files/frames/open_frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstring>
#include <mutex>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/state_archive.hpp"

// All readers in the order in which they are asked. NAME stands for a function ReadFormat NAME_reader() in
// engine/files/frames/readers; foreign_reader() is in engine/files/foreign.
#define GRAINREEL_FRAME_READERS(one) \
    one(run_folder) one(trajectory) one(checkpoint) one(grain_table) one(foreign)

namespace grainreel {

namespace fs = std::filesystem;

#define GRAINREEL_DECLARE(name) ReadFormat name##_reader();
GRAINREEL_FRAME_READERS(GRAINREEL_DECLARE)
#undef GRAINREEL_DECLARE

namespace {

FileStart head_of(const fs::path& path) {
    FileStart head;
    head.path = path;
    if (is_pattern(path)) return head;
    std::error_code error;
    head.folder = is_folder(path);
    if (head.folder) return head;
    if (const std::string other = other_than_file(path, true); !other.empty())
        throw UserError("{}: is {}, from which no frames are read; give a file or a folder", path.string(),
                        other);
    std::ifstream in = read_plain(path);
    if (!in) throw UserError("{}: cannot be opened; is there such a file?", path.string());
    head.size = fs::file_size(path, error);
    head.bytes.resize(std::min<std::uintmax_t>(error ? 0 : head.size, kHeadBytes));
    in.read(head.bytes.data(), static_cast<std::streamsize>(head.bytes.size()));
    head.bytes.resize(static_cast<std::size_t>(in.gcount()));
    return head;
}

[[noreturn]] void refuse(const fs::path& path) {
    std::vector<std::string> known;
    for (const auto& reader : own_readers()) known.emplace_back(reader->about());
    for (const ReadFormat& reader : frame_readers()) known.emplace_back(reader.about);
    throw UserError("{}: holds no frames that can be read; give {}", path.string(),
                    fmt::join(known, ", or "));
}

}  // namespace

const std::vector<ReadFormat>& frame_readers() {
#define GRAINREEL_LIST(name) name##_reader(),
    static const std::vector<ReadFormat> all{GRAINREEL_FRAME_READERS(GRAINREEL_LIST)};
#undef GRAINREEL_LIST
    return all;
}

const ReadFormat* reader_of(const fs::path& path) {
    const FileStart head = head_of(path);
    for (const ReadFormat& reader : frame_readers())
        if (reader.takes(head)) return &reader;
    return nullptr;
}

namespace {

// Opens the file by a reader that the calling program has added; null where none reads it. Most programs add
// no reader.
std::unique_ptr<StateArchive> open_by_own_reader(const fs::path& path, const OpenRequest& request) {
    const std::vector<std::shared_ptr<const OwnReader>> readers = own_readers();
    if (readers.empty()) return nullptr;
    const FileStart head = head_of(path);
    for (const std::shared_ptr<const OwnReader>& reader : readers)
        if (request.format.empty() ? reader->takes(head) : request.format == reader->name())
            return reader->open(path, request);
    return nullptr;
}

}  // namespace

std::unique_ptr<StateArchive> open_frames(const fs::path& path, const OpenRequest& request) {
    if (std::unique_ptr<StateArchive> own = open_by_own_reader(path, request)) {
        if (own->moments().empty()) throw UserError("{}: holds no frame", path.string());
        return own;
    }
    if (request.format.empty()) {
        const ReadFormat* reader = reader_of(path);
        if (reader == nullptr) refuse(path);
        std::unique_ptr<StateArchive> frames = reader->open(path, request);
        if (!frames->moments().empty()) return frames;
        const std::vector<std::string> damage = frames->damage();
        throw UserError(damage.empty() ? fmt::format("{}: holds no frame yet", path.string())
                                       : damage.front());
    }
    for (const ReadFormat& reader : frame_readers())
        if (request.format == reader.name) return reader.open(path, request);
    throw UserError("{}: there is no reader called {}", path.string(), request.format);
}

}  // namespace grainreel
namespace grainreel {

namespace {

struct GivenReaders {
    std::mutex guard;
    std::vector<std::shared_ptr<const OwnReader>> all;
};

GivenReaders& given_readers() {
    static GivenReaders readers;
    return readers;
}

}  // namespace

void add_own_reader(std::shared_ptr<const OwnReader> reader) {
    GivenReaders& given = given_readers();
    const std::string name = reader->name();
    const std::scoped_lock lock(given.guard);
    std::erase_if(given.all, [&](const auto& one) { return one->name() == name; });
    given.all.insert(given.all.begin(), std::move(reader));
}

std::vector<std::shared_ptr<const OwnReader>> own_readers() {
    GivenReaders& given = given_readers();
    const std::scoped_lock lock(given.guard);
    return given.all;
}

}  // namespace grainreel
