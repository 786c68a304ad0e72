#include "engine/files/foreign/byte_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/files/foreign/bytes/packed_bytes.hpp"

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

// What is packed in a way that is not read, by its first bytes.
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

// Whether the digits and the pi of bzip2 follow, and whether lzma's head has a dictionary and a size that can
// be.
bool really(const UnreadPacking& packing, std::string_view head) {
    const auto byte = [head](std::size_t k) {
        return k < head.size() ? static_cast<unsigned char>(head[k]) : 0u;
    };
    if (packing.magic == "BZh"sv)
        return byte(3) >= '1' && byte(3) <= '9' && head.substr(4).starts_with("1AY&SY");
    if (packing.magic != "]\0\0"sv) return true;
    const bool unknown_size = head.substr(5).starts_with("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF");
    const bool sane_size = byte(10) == 0 && byte(11) == 0 && byte(12) == 0;
    return head.size() > 13 && byte(4) < 0x20 && (unknown_size || sane_size);
}

Packing packing_of(const FileBytes& file) {
    char bytes[16];
    const std::string_view head(bytes, file.read_at(0, bytes, sizeof bytes));
    if (head.starts_with("\x1F\x8B")) return Packing::gzip;
    if (head.starts_with("\x28\xB5\x2F\xFD")) return Packing::zstd;
    // A zstd frame that is to be skipped: 0x184D2A50 to 5F.
    if (head.size() >= 4 && (head[0] & 0xF0) == 0x50 && head.substr(1).starts_with("\x2A\x4D\x18"))
        return Packing::zstd;
    for (const UnreadPacking& packing : unread)
        if (head.starts_with(packing.magic) && really(packing, head))
            throw UserError(fmt::format("{0}: packed with {1}, which is not read; unpack it first: {2} {3}",
                                        shown(file.path()), packing.name, packing.remedy,
                                        file.path().filename().string()));
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

FileHead unpacked_head(const fs::path& file) {
    FileHead head;
    head.path = file;
    head.size = FileBytes(file).state().size;
    head.bytes.resize(kHeadBytes);
    head.bytes.resize(open_bytes(file)->read(head.bytes.data(), head.bytes.size()));
    return head;
}

std::string all_bytes(const fs::path& file, std::uint64_t most) {
    const std::unique_ptr<ByteSource> source = open_bytes(file);
    const std::uint64_t on_disk = FileBytes(file).state().size;
    std::string all;
    std::size_t piece =
        static_cast<std::size_t>(std::min<std::uint64_t>(on_disk + 1, std::uint64_t{1} << 26));
    while (true) {
        const std::size_t had = all.size();
        all.resize(had + piece);
        const std::size_t got = source->read(all.data() + had, piece);
        all.resize(had + got);
        if (all.size() > most)
            throw UserError(
                fmt::format("{}: holds more than {} MB, which is the most that is read of such a file",
                            shown(file), most >> 20));
        if (got < piece) return all;
        piece = std::max(piece, std::min(all.size(), std::size_t{1} << 26));
    }
}

}  // namespace grainreel
