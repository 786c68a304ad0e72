#include "engine/state/checkpoint_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>
#include <algorithm>

#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

constexpr std::string_view kName = "grainrs";  // the same in every version; kVersion follows
constexpr char kVersion = 'd';

template <class Grain, class Each>
void transfer_grains(Grain& g, const Each& each) {
    each(g.id), each(g.species), each(g.place), each(g.motion), each(g.load);
    each(g.wall_work), each(g.orientation), each(g.derivatives);
}

bool read_whole(const std::filesystem::path& path, std::string& bytes) {
    std::ifstream in = read_plain(path);
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(path, failed);
    try {
        bytes.assign(failed ? 0 : size, '\0');
    } catch (const std::exception&) {  // a damaged size that is larger than memory
        return false;
    }
    return !failed && in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// Cuts off name, version and checksum if these are right.
CheckpointFile::Fault take_prologue(std::string_view& bytes) {
    if (bytes.size() > kName.size() && bytes[kName.size()] != kVersion)
        return CheckpointFile::Fault::other_version;
    std::uint64_t sum = 0;
    constexpr std::size_t prologue = kName.size() + sizeof kVersion + sizeof sum;
    if (bytes.size() <= prologue) return CheckpointFile::Fault::damaged;
    std::memcpy(&sum, bytes.data() + prologue - sizeof sum, sizeof sum);
    bytes.remove_prefix(prologue);
    return sum == XXH64(bytes.data(), bytes.size(), 0) ? CheckpointFile::Fault::none
                                                       : CheckpointFile::Fault::damaged;
}

// Whether there are as many values of each kind as grains.
bool has_all_values(const Grains& g) {
    const auto all = [&](const auto& values) { return values.size() == g.size(); };
    return all(g.species) && all(g.place) && all(g.motion) && all(g.load) && all(g.wall_work) &&
           (g.orientation.empty() || all(g.orientation)) && (g.derivatives.empty() || all(g.derivatives));
}

}  // namespace

CheckpointFile::CheckpointFile(const std::filesystem::path& path) {
    fault_ = read_whole(path, bytes_) ? read() : Fault::unreadable;
}

CheckpointFile::Fault CheckpointFile::read() {
    std::string_view body = bytes_;
    if (const Fault fault = take_prologue(body); fault != Fault::none) return fault;
    Bytes in(body);
    std::vector<char> text, more;
    std::int64_t step = 0;
    std::uint8_t is_fresh = 0;
    read_vector(in, text);
    read_value(in, header);
    read_value(in, is_fresh);
    read_vector(in, more);
    read_value(in, step);
    transfer_grains(grains, Reading{in});
    const CheckpointHeader& h = header;
    if (in.failed() || h.step != step || step < 0 || is_fresh > 1 || !std::isfinite(h.start_energy) ||
        !h.wall_offset.allFinite() || !h.wall_velocity.allFinite() || !has_all_values(grains))
        return Fault::damaged;
    scene.assign(text.begin(), text.end());
    fresh = is_fresh == 1;
    gathered.assign(more.begin(), more.end());
    rest_ = body.substr(body.size() - in.left());
    return Fault::none;
}

bool is_checkpoint(const std::filesystem::path& path) {
    std::ifstream in = read_plain(path);
    std::string name(kName.size(), '\0');
    in.read(name.data(), static_cast<std::streamsize>(name.size()));
    return in && name == kName;
}

bool begins_checkpoint(std::string_view bytes) {
    return bytes.starts_with(kName);
}

bool is_whole_checkpoint(const std::filesystem::path& path) {
    std::string bytes;
    if (!read_whole(path, bytes)) return false;
    std::string_view body = bytes;
    return take_prologue(body) == CheckpointFile::Fault::none;
}

std::optional<CheckpointLabel> label_of_checkpoint(const std::filesystem::path& path) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(path, failed);
    std::ifstream in = read_plain(path);
    std::string name(kName.size(), '\0');
    char version = 0;
    std::uint64_t sum = 0, length = 0;
    in.read(name.data(), static_cast<std::streamsize>(name.size()));
    in.get(version);
    in.read(reinterpret_cast<char*>(&sum), sizeof sum);
    in.read(reinterpret_cast<char*>(&length), sizeof length);
    constexpr std::uint64_t longest_scene = 64u << 20;  // bytes
    if (failed || !in || name != kName || version != kVersion ||
        length > std::min<std::uint64_t>(size, longest_scene))
        return std::nullopt;
    CheckpointLabel label;
    label.scene.resize(length);
    in.read(label.scene.data(), static_cast<std::streamsize>(length));
    CheckpointHeader header;
    in.read(reinterpret_cast<char*>(&header), sizeof header);
    label.step = header.step;
    label.wall_offset = header.wall_offset;
    return in && label.step >= 0 ? std::optional(label) : std::nullopt;
}

void write_grains(std::ostream& out, const Grains& grains) {
    transfer_grains(grains, Writing{out});
}

void write_checkpoint_file(const std::filesystem::path& path, const std::string& body) {
    const std::uint64_t sum = XXH64(body.data(), body.size(), 0);
    const std::filesystem::path temporary = path.string() + ".part";
    make_way(temporary);
    std::ofstream file(temporary, std::ios::binary);
    file.write(kName.data(), static_cast<std::streamsize>(kName.size()));
    write_value(file, kVersion);
    write_value(file, sum);
    file.write(body.data(), static_cast<std::streamsize>(body.size()));
    file.close();
    std::error_code failed;
    if (file) std::filesystem::rename(temporary, path, failed);
    if (!file || failed) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw RunError("{}: the checkpoint cannot be written; is the disk full?", path.string());
    }
}

}  // namespace grainreel
