#include "engine/files/foreign/dumps/index_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>
#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/own_folder.hpp"

namespace grainreel {

namespace {

constexpr std::size_t compared = 4096;  // bytes before the end that Growth compares

}  // namespace

std::uint64_t hash_before(const FileBytes& file, std::uint64_t place, std::size_t bytes) {
    const std::uint64_t from = place - std::min<std::uint64_t>(place, bytes);
    std::vector<char> read(static_cast<std::size_t>(place - from));
    const std::size_t got = file.read_at(from, read.data(), read.size());
    return XXH64(read.data(), got, got);
}

Growth::Growth(const std::filesystem::path& file) : file_(file) {
    const FileBytes bytes(file_);
    state_ = bytes.state();
    end_hash_ = hash_before(bytes, state_.size, compared);
}

bool Growth::look() {
    const FileBytes bytes(file_);
    const FileState now = bytes.state();
    if (now == state_) return false;
    if (!now.same_file(state_))
        throw UserError("{}: another file has this name now; begin again with it", shown(file_));
    if (now.size < state_.size)
        throw UserError(
            "{}: became shorter, from {} to {} bytes, while it was followed; begin again with "
            "it",
            shown(file_), state_.size, now.size);
    if (hash_before(bytes, state_.size, compared) != end_hash_)
        throw UserError("{}: was written anew while it was followed; begin again with it", shown(file_));
    state_ = now;
    end_hash_ = hash_before(bytes, state_.size, compared);
    return true;
}

namespace {

namespace fs = std::filesystem;

// An index file has an Identity, then this line, then the values that index_bytes() writes. Whoever changes
// their order changes the number, so that an older file is not misread.
constexpr std::string_view magic = "grainreel index 2\n";
constexpr std::size_t hashed = 65536;        // bytes at each end of the file
constexpr const char* kIndices = "indices";  // name of their folder in the cache folder

// What identifies the file that an index belongs to.
struct Identity {
    std::uint64_t inode = 0, size = 0;
    std::int64_t changed = 0, touched = 0;
    std::uint64_t head_hash = 0, end_hash = 0;
};

Identity identity_of(const FileBytes& file, const FileState& state) {
    const std::uint64_t head = std::min<std::uint64_t>(state.size, hashed);
    return {state.inode,
            state.size,
            state.changed,
            state.touched,
            hash_before(file, head, hashed),
            hash_before(file, state.size, hashed)};
}

template <class Way>
void each_of(Way& way, auto& identity) {
    way(identity.inode);
    way(identity.size);
    way(identity.changed);
    way(identity.touched);
    way(identity.head_hash);
    way(identity.end_hash);
}

// Frames as plain numbers, because structs have gaps with arbitrary bytes.
void write_frames(std::ostream& out, const TextIndex& index) {
    std::vector<std::int64_t> numbers;
    std::vector<double> times;
    for (const DumpFrame& f : index.frames) {
        for (const std::uint64_t place : {f.place, f.end})
            numbers.push_back(static_cast<std::int64_t>(place));
        for (const std::int64_t number : {f.line, f.step, f.rows, std::int64_t{f.time ? 1 : 0}})
            numbers.push_back(number);
        times.push_back(f.time.value_or(0));
    }
    write_vector(out, numbers);
    write_vector(out, times);
}

bool read_frames(Bytes& in, TextIndex& index) {
    constexpr std::size_t width = 6;
    std::vector<std::int64_t> numbers;
    std::vector<double> times;
    read_vector(in, numbers);
    read_vector(in, times);
    if (in.failed() || numbers.size() != width * times.size()) return false;
    std::uint64_t before = 0;
    for (std::size_t k = 0; k < times.size(); ++k) {
        const std::int64_t* const n = numbers.data() + width * k;
        DumpFrame frame{
            static_cast<std::uint64_t>(n[0]), static_cast<std::uint64_t>(n[1]), n[2], n[3], {}, n[4]};
        if (n[5] != 0) frame.time = times[k];
        if (frame.place < before || frame.end <= frame.place || frame.rows < 0) return false;
        before = frame.end;
        index.frames.push_back(frame);
    }
    return before <= index.end;
}

// A frame that is cut off, as plain numbers.
std::vector<std::int64_t> numbers_of(const std::optional<CutFrame>& cut) {
    if (!cut) return {};
    return {cut->line, cut->step ? 1 : 0, cut->step.value_or(0), cut->in_head ? 1 : 0,
            cut->rows, cut->of,           cut->in_row ? 1 : 0,   cut->in_number ? 1 : 0};
}

std::optional<CutFrame> cut_of(const std::vector<std::int64_t>& n) {
    if (n.size() != 8) return std::nullopt;
    CutFrame cut{n[0], {}, n[3] != 0, n[4], n[5], n[6] != 0, n[7] != 0};
    if (n[1] != 0) cut.step = n[2];
    return cut;
}

void write_text(std::ostream& out, std::string_view text) {
    write_vector(out, std::vector<char>(text.begin(), text.end()));
}

std::string read_text(Bytes& in) {
    std::vector<char> text;
    read_vector(in, text);
    return {text.begin(), text.end()};
}

std::optional<std::string> bytes_of(const fs::path& path) {
    std::ifstream in = read_plain(path);
    if (!in) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(in), {});
}

// Whether an index made for the state `then` fits the file as it is now.
bool serves(const Identity& then, const FileBytes& file, const FileState& now) {
    if (then.inode != now.inode || then.size > now.size) return false;
    if (then.size == now.size && (then.changed != now.changed || then.touched != now.touched)) return false;
    const FileState before{then.size, now.device, then.inode, then.changed, then.touched};
    const Identity again = identity_of(file, before);
    return again.head_hash == then.head_hash && again.end_hash == then.end_hash;
}

std::optional<KeptIndex> index_in(const fs::path& path, const FileBytes& file, const FileState& now) {
    const std::optional<std::string> all = bytes_of(path);
    if (!all) return std::nullopt;
    Bytes in(*all);
    Identity then;
    const Reading read{in};
    each_of(read, then);
    if (in.failed() || !serves(then, file, now)) return std::nullopt;
    std::optional<TextIndex> index = index_of_bytes(std::string_view(*all).substr(all->size() - in.left()));
    // The content of a packed file is longer than the file, but at most so many times.
    constexpr std::uint64_t most_packed = 2000;
    if (index && index->end / most_packed > now.size) return std::nullopt;
    if (!index) return std::nullopt;
    return KeptIndex{std::move(*index), then.size == now.size};
}

// Whether an index may be believed: it is a file that not everybody may write, and the user or the owner of
// the dump has made it. Both may lie in a folder in which everybody may make files.
bool is_believed(const fs::path& index, const fs::path& file) {
    struct stat one {
    }, other{};
    return ::lstat(index.c_str(), &one) == 0 && S_ISREG(one.st_mode) && (one.st_mode & S_IWOTH) == 0 &&
           ::stat(file.c_str(), &other) == 0 && (one.st_uid == ::geteuid() || one.st_uid == other.st_uid);
}

}  // namespace

std::string index_bytes(const TextIndex& index) {
    std::ostringstream out;
    out << magic;
    write_value(out, static_cast<std::uint64_t>(index.names.size()));
    for (const std::string& name : index.names) write_text(out, name);
    for (const bool flag : {index.pairs, index.timed, index.unended, index.stream_cut})
        write_value(out, flag ? 1 : 0);
    write_text(out, index.units);
    write_value(out, index.end);
    write_value(out, index.end_line);
    write_vector(out, numbers_of(index.cut));
    write_frames(out, index);
    std::string bytes = out.str();
    const std::uint64_t sum = XXH64(bytes.data(), bytes.size(), 0);
    return bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

std::optional<TextIndex> index_of_bytes(std::string_view bytes) {
    std::uint64_t sum = 0;
    if (bytes.size() < magic.size() + sizeof sum || !bytes.starts_with(magic)) return std::nullopt;
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes.remove_suffix(sizeof sum);
    if (XXH64(bytes.data(), bytes.size(), 0) != sum) return std::nullopt;
    Bytes in(bytes.substr(magic.size()));
    TextIndex index;
    std::uint64_t names = 0;
    read_value(in, names);
    for (std::uint64_t k = 0; k < names && !in.failed(); ++k) index.names.push_back(read_text(in));
    for (bool* const flag : {&index.pairs, &index.timed, &index.unended, &index.stream_cut}) {
        int value = 0;
        read_value(in, value);
        *flag = value != 0;
    }
    index.units = read_text(in);
    read_value(in, index.end);
    read_value(in, index.end_line);
    std::vector<std::int64_t> cut;
    read_vector(in, cut);
    index.cut = cut_of(cut);
    if (in.failed() || !read_frames(in, index) || in.left() != 0) return std::nullopt;
    return index;
}

std::vector<fs::path> index_places(const fs::path& file) {
    std::error_code error;
    const fs::path whole = fs::canonical(file, error);
    if (error) return {};
    std::vector<fs::path> places{whole.parent_path() /
                                 ("." + whole.filename().string() + ".grainreel-index")};
    const std::string name = whole.string();
    if (const fs::path indices = own_cache_folder(kIndices); !indices.empty())
        places.push_back(indices /
                         fmt::format("{:016x}.grainreel-index", XXH64(name.data(), name.size(), 0)));
    return places;
}

std::optional<KeptIndex> kept_index(const fs::path& file, const FileState& state) {
    const FileBytes bytes(file);
    for (const fs::path& place : index_places(file))
        if (is_believed(place, file))
            if (std::optional<KeptIndex> kept = index_in(place, bytes, state)) return kept;
    return std::nullopt;
}

void keep_index(const fs::path& file, const FileState& state, const TextIndex& index) {
    std::ostringstream out;
    const Identity identity = identity_of(FileBytes(file), state);
    const Writing write{out};
    each_of(write, identity);
    const std::string all = out.str() + index_bytes(index);
    for (const fs::path& place : index_places(file)) {
        // The folder of the file exists; the one in the cache may have to be made.
        if (place.parent_path().filename() == kIndices) make_own_cache_folder(kIndices);
        try {
            replace_file(place, all);
            return;
        } catch (const RunError&) {  // try the next path
        }
    }
}

}  // namespace grainreel
