#include "engine/files/foreign/gsd/gsd_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <system_error>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

constexpr std::uint64_t magic = 0x65DF65DF65DF65DFu;
constexpr std::uint64_t header_size = 256, entry_size = 32, name_size = 64;

// Number of bytes of a value by the number of its type, or 0 for an unknown type.
std::uint64_t size_of_type(std::uint8_t type) {
    constexpr std::array<std::uint8_t, 12> sizes{0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 1};
    return type < sizes.size() ? sizes[type] : 0;
}

template <class T>
T value_at(const std::string& bytes, std::size_t place) {
    T value;
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
}

std::string text_at(const std::string& bytes, std::size_t place, std::size_t size) {
    const std::string text = bytes.substr(place, size);
    return text.substr(0, text.find('\0'));
}

template <class T>
void convert(const std::string& bytes, std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<double>(value_at<T>(bytes, i * sizeof(T)));
}

// Whether a file of `all` bytes has room for `count` items of `size` bytes from `place` on.
bool fits(std::uint64_t place, std::uint64_t count, std::uint64_t size, std::uint64_t all) {
    return place <= all && (size == 0 || count <= (all - place) / size);
}

}  // namespace

// A range of bytes in the file.
struct GsdFile::Block {
    std::uint64_t begin = 0, end = 0;
};

GsdFile::GsdFile(const std::filesystem::path& file) : file_(file) {
    if (packing_of(file) != Packing::none)
        throw UserError("{}: a GSD file is not read while it is packed; unpack it", file.string());
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    source_ = open_bytes(file);
    read_header();
}

void GsdFile::fault(std::uint64_t place, const std::string& what) const {
    throw UserError("{}: byte {}: {}", file_.string(), place, what);
}

std::string GsdFile::bytes_at(std::uint64_t place, std::uint64_t size) const {
    if (!fits(place, size, 1, size_)) fault(place, "the file ends too early; was it copied to the end?");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    source_->seek(place);
    if (source_->read(bytes.data(), bytes.size()) != bytes.size())
        fault(place, "the file ends too early; was it copied to the end?");
    return bytes;
}

void GsdFile::read_header() {
    const std::string header = bytes_at(0, header_size);
    if (value_at<std::uint64_t>(header, 0) != magic) fault(0, "is no GSD file");
    index_place_ = value_at<std::uint64_t>(header, 8);
    index_entries_ = value_at<std::uint64_t>(header, 16);
    names_place_ = value_at<std::uint64_t>(header, 24);
    names_size_ = value_at<std::uint64_t>(header, 32);
    const auto version = value_at<std::uint32_t>(header, 44);
    layer_ = version >> 16;
    application_ = text_at(header, 48, 64);
    schema_ = text_at(header, 112, 64);
    if (layer_ != 1 && layer_ != 2 && version != 3)
        fault(44,
              fmt::format("the file layer {}.{} of GSD is not read; 1 and 2 are", layer_, version & 0xffff));
    if (!fits(index_place_, index_entries_, entry_size, size_) ||
        !fits(names_place_, names_size_, name_size, size_))
        fault(8, "the header points outside of the file; was it copied to the end?");
    names_size_ *= name_size;
    read_names();
    read_index();
}

// The names: 64 bytes for each in layer 1, one after the other in layer 2.
void GsdFile::read_names() {
    const std::string bytes = bytes_at(names_place_, names_size_);
    for (std::size_t begin = 0; begin < bytes.size();) {
        const std::string name = text_at(bytes, begin, layer_ == 2 ? bytes.size() : name_size);
        if (name.empty()) break;
        names_.push_back(name);
        begin += layer_ == 2 ? name.size() + 1 : name_size;
    }
}

void GsdFile::read_index() {
    const std::string bytes = bytes_at(index_place_, index_entries_ * entry_size);
    std::vector<Block> blocks{{0, header_size},
                              {index_place_, index_place_ + bytes.size()},
                              {names_place_, names_place_ + names_size_}};
    for (std::size_t offset = 0; offset < bytes.size(); offset += entry_size) {
        const std::uint64_t place = index_place_ + offset;
        const auto frame = value_at<std::uint64_t>(bytes, offset);
        GsdChunk chunk{
            value_at<std::uint64_t>(bytes, offset + 8), value_at<std::uint64_t>(bytes, offset + 16),
            value_at<std::uint32_t>(bytes, offset + 24), value_at<std::uint8_t>(bytes, offset + 30)};
        const auto name = value_at<std::uint16_t>(bytes, offset + 28);
        if (chunk.place == 0) break;
        const std::uint64_t size = size_of_type(chunk.type);
        if (size == 0) fault(place, fmt::format("a chunk has the type {}, which does not exist", chunk.type));
        if (name >= names_.size())
            fault(place, fmt::format("a chunk has the name {} of {}", name, names_.size()));
        if (frame >= index_entries_) fault(place, fmt::format("a chunk is of frame {}", frame));
        if (!fits(chunk.place, chunk.rows, size * chunk.columns, size_))
            fault(place, fmt::format("the chunk {} lies outside of the file; was it copied to the end?",
                                     names_[name]));
        if (chunk.columns > 0 && chunk.rows > 0)
            blocks.push_back({chunk.place, chunk.place + chunk.rows * chunk.columns * size});
        frames_ = std::max(frames_, static_cast<std::size_t>(frame) + 1);
        chunks_[names_[name]][frame] = chunk;
    }
    hold_apart(std::move(blocks));
}

void GsdFile::hold_apart(std::vector<Block> blocks) const {
    std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.begin < b.begin; });
    std::uint64_t end = 0;
    for (const Block& block : blocks) {
        if (block.begin < end) fault(block.begin, "two chunks lie over each other; the file is damaged");
        end = block.end;
    }
}

const GsdChunk* GsdFile::find(const std::string& name, std::size_t frame) const {
    const auto named = chunks_.find(name);
    if (named == chunks_.end()) return nullptr;
    const auto chunk = named->second.find(frame);
    return chunk == named->second.end() ? nullptr : &chunk->second;
}

std::vector<double> GsdFile::numbers(const GsdChunk& chunk) const {
    const std::uint64_t count = chunk.rows * chunk.columns;
    const std::string bytes = bytes_at(chunk.place, count * size_of_type(chunk.type));
    std::vector<double> values(static_cast<std::size_t>(count));
    switch (chunk.type) {
        case 1:
            convert<std::uint8_t>(bytes, values);
            break;
        case 2:
            convert<std::uint16_t>(bytes, values);
            break;
        case 3:
            convert<std::uint32_t>(bytes, values);
            break;
        case 4:
            convert<std::uint64_t>(bytes, values);
            break;
        case 5:
            convert<std::int8_t>(bytes, values);
            break;
        case 6:
            convert<std::int16_t>(bytes, values);
            break;
        case 7:
            convert<std::int32_t>(bytes, values);
            break;
        case 8:
            convert<std::int64_t>(bytes, values);
            break;
        case 9:
            convert<float>(bytes, values);
            break;
        case 10:
            convert<double>(bytes, values);
            break;
        default:
            convert<std::uint8_t>(bytes, values);
            break;
    }
    return values;
}

std::vector<std::string> GsdFile::texts(const GsdChunk& chunk) const {
    const std::string bytes = bytes_at(chunk.place, chunk.rows * chunk.columns * size_of_type(chunk.type));
    std::vector<std::string> texts;
    if (size_of_type(chunk.type) != 1 || chunk.columns == 0) return texts;
    for (std::size_t begin = 0; begin < bytes.size(); begin += chunk.columns)
        texts.push_back(text_at(bytes, begin, chunk.columns));
    return texts;
}

}  // namespace grainreel
