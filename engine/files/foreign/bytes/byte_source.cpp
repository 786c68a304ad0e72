#include "engine/files/foreign/bytes/byte_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

class PlainBytes : public ByteSource {
  public:
    explicit PlainBytes(std::unique_ptr<FileBytes> file) : file_(std::move(file)) {}

    std::size_t read(char* to, std::size_t size) override {
        const std::size_t got = file_->read_at(place_, to, size);
        place_ += got;
        return got;
    }
    bool cut_off() const override { return false; }
    void seek(std::uint64_t place) override { place_ = place; }

  private:
    std::unique_ptr<FileBytes> file_;
    std::uint64_t place_ = 0;
};

// A kind of compression that is refused: how such a file begins, its name, and the command that unpacks it.
struct UnreadPacking {
    std::string_view magic;
    const char* name;
    const char* remedy;
};
constexpr UnreadPacking unread[] = {
    {"\xFD"
     "7zXZ\0"sv,
     "xz", "xz -d"},
    {"BZh"sv, "bzip2", "bzip2 -d"},
    {"]\0\0"sv, "lzma", "xz -d --format=lzma"},
    {"\x04\x22\x4D\x18"sv, "lz4", "lz4 -d"},
    {"\x1F\x9D"sv, "compress", "gzip -d"},
    {"PK\x03\x04"sv, "zip", "unzip"},
    {"7z\xBC\xAF\x27\x1C"sv, "7-Zip", "7z x"},
};

// Whether the file is really compressed in this way. The magic alone does not tell, because a text may begin
// with "BZh" or "]" too. In bzip2 a digit and the digits of pi follow the magic. The header of lzma has
// sizes, which must be possible.
bool really(const UnreadPacking& packing, std::string_view head) {
    const auto byte = [head](std::size_t k) {
        return k < head.size() ? static_cast<unsigned char>(head[k]) : 0u;
    };
    if (packing.magic == "BZh"sv)
        return byte(3) >= '1' && byte(3) <= '9' && head.substr(4).starts_with("1AY&SY");
    if (packing.magic != "]\0\0"sv) return true;
    if (head.size() < 14 || byte(4) >= 0x20) return false;
    const bool unknown_size = head.substr(5).starts_with("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF");
    const bool sane_size = byte(10) == 0 && byte(11) == 0 && byte(12) == 0;
    return unknown_size || sane_size;
}

Packing packing_of(const FileBytes& file) {
    char bytes[16];
    const std::string_view head(bytes, file.read_at(0, bytes, sizeof bytes));
    if (head.starts_with("\x1F\x8B")) return Packing::gzip;
    if (head.starts_with("\x28\xB5\x2F\xFD")) return Packing::zstd;
    // The magic of a skippable zstd frame is 0x184D2A50 to 0x184D2A5F.
    if (head.size() >= 4 && (head[0] & 0xF0) == 0x50 && head.substr(1).starts_with("\x2A\x4D\x18"))
        return Packing::zstd;
    for (const UnreadPacking& packing : unread)
        if (head.starts_with(packing.magic) && really(packing, head))
            throw UserError("{0}: packed with {1}, which is not read; unpack it first: {2} {3}",
                            shown(file.path()), packing.name, packing.remedy,
                            shell_word(file.path().filename().string()));
    return Packing::none;
}

}  // namespace

Packing packing_of(const fs::path& file) {
    return packing_of(FileBytes(file));
}

std::unique_ptr<ByteSource> open_bytes(const fs::path& path) {
    auto file = std::make_unique<FileBytes>(path);
    switch (packing_of(*file)) {
        case Packing::gzip:
            return gzip_bytes(std::move(file));
        case Packing::zstd:
            return zstd_bytes(std::move(file));
        case Packing::none:
            break;
    }
    return std::make_unique<PlainBytes>(std::move(file));
}

FileStart unpacked_head(const fs::path& file) {
    FileStart head;
    head.path = file;
    head.size = FileBytes(file).state().size;
    head.bytes.resize(kHeadBytes);
    head.bytes.resize(open_bytes(file)->read(head.bytes.data(), head.bytes.size()));
    return head;
}

std::string all_bytes(const fs::path& file, std::uint64_t most) {
    constexpr std::uint64_t some = std::uint64_t{1} << 20, many = std::uint64_t{1} << 26;
    const std::unique_ptr<ByteSource> source = open_bytes(file);
    const std::uint64_t on_disk = FileBytes(file).state().size;
    const bool packed = packing_of(file) != Packing::none;
    const auto piece = static_cast<std::size_t>(packed ? some : std::min(on_disk + 1, many));
    std::string all;
    if (packed && most <= many)
        all.reserve(static_cast<std::size_t>(most) + piece);  // no copy while it grows
    while (true) {
        const std::size_t had = all.size();
        all.resize(had + piece);
        const std::size_t got = source->read(all.data() + had, piece);
        all.resize(had + got);
        if (all.size() > most)
            throw UserError("{}: holds more than {} MB, which is the most that is read of such a file",
                            shown(file), most >> 20);
        if (got < piece) return all;
    }
}

namespace fs = std::filesystem;

std::string shown(const fs::path& file) {
    constexpr std::size_t most = 400;  // characters
    return excerpt(file.string(), most);
}

FileBytes::FileBytes(const fs::path& file) : path_(file) {
    if (const std::string other = other_than_file(file, true); !other.empty())
        throw UserError("{}: is {}; give an ordinary file", shown(file), other);
    // O_NONBLOCK keeps open() from waiting if a pipe has just taken the file's name.
    file_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat about {};
    if (file_ >= 0 && ::fstat(file_, &about) == 0 && S_ISREG(about.st_mode)) {
        FilesRead::note(path_, state_of(about));
        return;
    }
    const std::string why = file_ < 0 ? std::strerror(errno) : "it is no ordinary file";
    if (file_ >= 0) ::close(file_);
    throw UserError("{}: cannot be opened: {}", shown(file), why);
}

FileBytes::~FileBytes() {
    if (file_ >= 0) ::close(file_);
}

FileState FileBytes::state() const {
    struct stat about {};
    if (::fstat(file_, &about) != 0)
        throw UserError("{}: cannot be read: {}", shown(path_), std::strerror(errno));
    return state_of(about);
}

std::size_t FileBytes::read_at(std::uint64_t place, char* to, std::size_t size) const {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::pread(file_, to + done, size - done, static_cast<off_t>(place + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw UserError("{}: cannot be read from byte {} on: {}", shown(path_), place + done,
                            std::strerror(errno));
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

namespace {

constexpr std::size_t piece_size = std::size_t{1} << 18;  // bytes

}  // namespace

PackedBytes::PackedBytes(std::unique_ptr<FileBytes> file)
    : file_(std::move(file)), piece_(std::make_unique<char[]>(piece_size)) {}

std::size_t PackedBytes::read(char* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
        const std::size_t got = unpack(to + done, size - done);
        if (got == 0) break;
        done += got;
    }
    place_ += done;
    return done;
}

void PackedBytes::seek(std::uint64_t place) {
    if (place < place_) {
        held_ = used_ = 0;
        read_ = place_ = 0;
        cut_off_ = false;
        begin_again();
    }
    std::unique_ptr<char[]> passed_over;
    while (place_ < place) {
        if (!passed_over) passed_over = std::make_unique<char[]>(piece_size);
        const std::size_t size =
            static_cast<std::size_t>(std::min<std::uint64_t>(place - place_, piece_size));
        if (read(passed_over.get(), size) == 0) break;
    }
}

bool PackedBytes::fill() {
    if (left() > 0) return true;
    used_ = 0;
    held_ = file_->read_at(read_, piece_.get(), piece_size);
    read_ += held_;
    return held_ > 0;
}

void PackedBytes::damaged(const std::string& why) const {
    throw UserError(
        "{}: byte {}: the packed content is damaged ({}); copy the file again, or unpack what "
        "is sound by hand",
        shown(file_->path()), read_ - left(), why);
}

// gzip, RFC 1952. A file may have several members, one after the other. Together they are its content.

namespace {

constexpr int gzip_window = 15 + 16;  // for zlib: the largest window, with gzip's header and checksum

class GzipBytes : public PackedBytes {
  public:
    explicit GzipBytes(std::unique_ptr<FileBytes> file) : PackedBytes(std::move(file)) {
        if (inflateInit2(&stream_, gzip_window) != Z_OK) throw std::bad_alloc();
    }
    ~GzipBytes() override { inflateEnd(&stream_); }

  private:
    void begin_again() override {
        inflateReset(&stream_);
        between_ = true;
    }

    // Goes to the next member. Returns whether there is one.
    bool next_member() {
        while (fill()) {
            if (*packed() != 0) break;
            use(1);  // skips zeros, with which tapes and some copies are filled up
        }
        if (left() == 0) return false;
        if (static_cast<unsigned char>(*packed()) != 0x1f)
            damaged("behind a whole part stand bytes that are no gzip");
        inflateReset(&stream_);
        between_ = false;
        return true;
    }

    std::size_t unpack(char* to, std::size_t size) override {
        while (true) {
            if (between_ && !next_member()) return 0;
            if (!fill()) {
                cut_off_ = true;
                return 0;
            }
            constexpr std::size_t most = std::numeric_limits<uInt>::max() / 2;
            const auto room = static_cast<uInt>(std::min(size, most));
            stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed()));
            stream_.avail_in = static_cast<uInt>(left());
            stream_.next_out = reinterpret_cast<Bytef*>(to);
            stream_.avail_out = room;
            const int result = inflate(&stream_, Z_NO_FLUSH);
            use(left() - stream_.avail_in);
            if (result == Z_MEM_ERROR) throw std::bad_alloc();
            if (result == Z_STREAM_END)
                between_ = true;
            else if (result != Z_OK && result != Z_BUF_ERROR)
                damaged(stream_.msg != nullptr ? stream_.msg : "it needs a dictionary");
            if (stream_.avail_out < room) return room - stream_.avail_out;
        }
    }

    z_stream stream_{};
    bool between_ = true;  // between two members, or at the beginning
};

}  // namespace

std::unique_ptr<ByteSource> gzip_bytes(std::unique_ptr<FileBytes> file) {
    return std::make_unique<GzipBytes>(std::move(file));
}

// zstd, RFC 8878. A file may have several frames, one after the other. Together they are its content.

namespace {

class ZstdBytes : public PackedBytes {
  public:
    explicit ZstdBytes(std::unique_ptr<FileBytes> file)
        : PackedBytes(std::move(file)), stream_(ZSTD_createDStream(), &ZSTD_freeDStream) {
        if (!stream_) throw std::bad_alloc();
        ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, largest_window());
    }

  private:
    void begin_again() override {
        ZSTD_DCtx_reset(stream_.get(), ZSTD_reset_session_only);
        wants_ = 0;
    }

    std::size_t unpack(char* to, std::size_t size) override {
        ZSTD_outBuffer out{to, size, 0};
        while (out.pos == 0) {
            // When all is read, zstd may still hold unpacked bytes for which the last call had no room.
            const bool more = fill();
            ZSTD_inBuffer in{packed(), left(), 0};
            if (!more && wants_ == 0) return 0;
            const std::size_t result = ZSTD_decompressStream(stream_.get(), &out, &in);
            use(in.pos);
            if (ZSTD_isError(result)) refuse(result);
            wants_ = result;
            if (!more && out.pos == 0) {
                cut_off_ = true;
                return 0;
            }
        }
        return out.pos;
    }

    // The logarithm of the largest window, which is the memory that the head of a file may ask for: 32 MB for
    // a small file, 128 MB for a larger one.
    int largest_window() const {
        constexpr std::uint64_t small = std::uint64_t{2} << 20;  // bytes
        return packed_size() < small ? 25 : 27;
    }

    [[noreturn]] void refuse(std::size_t result) const {
        if (ZSTD_getErrorCode(result) == ZSTD_error_frameParameter_windowTooLarge)
            damaged(fmt::format(
                "packed by zstd --long with a window above {} MB, which is not read; unpack it by "
                "zstd -d",
                1 << (largest_window() - 20)));
        damaged(ZSTD_getErrorName(result));
    }

    std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream_;
    std::size_t wants_ = 0;  // 0 between two frames
};

}  // namespace

std::unique_ptr<ByteSource> zstd_bytes(std::unique_ptr<FileBytes> file) {
    return std::make_unique<ZstdBytes>(std::move(file));
}

}  // namespace grainreel
