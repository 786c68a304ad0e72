#include "engine/start/restart.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string_view>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/start/continuation.hpp"
#include "engine/start/start_file.hpp"

namespace grainreel {

namespace {

constexpr std::string_view kName = "grainrs";  // of every version, whose digit follows
constexpr char kVersion = 'b';

template <class Grain, class Each>
void transfer_grains(Grain& g, const Each& each) {
    each(g.id), each(g.species), each(g.place), each(g.motion), each(g.load);
    each(g.wall_work), each(g.orientation), each(g.derivatives);
}

UserError cannot_start(const Scene& scene, const std::string& what) {
    return UserError(fmt::format("{}: '{}' {}", scene.where("start.file"), scene.start.file, what));
}

std::string read_whole(const Scene& scene) {
    std::ifstream in = read_plain(scene.start.file);
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(scene.start.file, failed);
    std::string bytes(failed ? 0 : size, '\0');
    if (failed || !in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        throw cannot_start(scene, "cannot be read; give the checkpoint.grs or final.csv of an earlier run");
    return bytes;
}

// What follows name, version and checksum, once these are right.
std::string_view body_of(const Scene& scene, std::string_view bytes) {
    if (bytes.size() > kName.size() && bytes[kName.size()] != kVersion)
        throw cannot_start(scene,
                           "is a checkpoint of another version of grainreel; give the final.csv beside it");
    std::uint64_t sum = 0;
    constexpr std::size_t prologue = kName.size() + sizeof kVersion + sizeof sum;
    if (bytes.size() <= prologue) throw damaged_checkpoint(scene);
    std::memcpy(&sum, bytes.data() + prologue - sizeof sum, sizeof sum);
    bytes.remove_prefix(prologue);
    if (sum != XXH64(bytes.data(), bytes.size(), 0)) throw damaged_checkpoint(scene);
    return bytes;
}

// As many values of each kind as there are grains.
bool has_all_values(const Grains& g) {
    const auto all = [&](const auto& values) { return values.size() == g.size(); };
    return all(g.species) && all(g.place) && all(g.motion) && all(g.load) && all(g.wall_work) &&
           (g.orientation.empty() || all(g.orientation)) && (g.derivatives.empty() || all(g.derivatives));
}

struct Saved {
    std::string scene;
    CheckpointHeader header;
    bool fresh = false;
    std::string gathered;
    Grains grains;
};

Saved read_saved(const Scene& scene, Bytes& in) {
    Saved saved;
    std::vector<char> text, gathered;
    std::int64_t step = 0;
    std::uint8_t fresh = 0;
    read_vector(in, text);
    read_value(in, saved.header);
    read_value(in, fresh);
    read_vector(in, gathered);
    read_value(in, step);
    transfer_grains(saved.grains, Reading{in});
    const CheckpointHeader& h = saved.header;
    if (in.failed() || h.step != step || step < 0 || fresh > 1 || !std::isfinite(h.start_energy) ||
        !h.wall_offset.allFinite() || !h.wall_velocity.allFinite() || !has_all_values(saved.grains))
        throw damaged_checkpoint(scene);
    saved.scene.assign(text.begin(), text.end());
    saved.fresh = fresh == 1;
    saved.gathered.assign(gathered.begin(), gathered.end());
    return saved;
}

std::int64_t total_of(const std::vector<std::int64_t>& given) {
    return std::accumulate(given.begin(), given.end(), std::int64_t{0});
}

// One number for each feed, and as many grains in all as have come.
bool could_be_given(const Scene& scene, const std::vector<std::int64_t>& given, const Traffic& traffic) {
    const auto possible = [](std::int64_t count) { return count >= 0 && count < std::int64_t{1} << 31; };
    return given.size() == scene.feeds.size() && std::all_of(given.begin(), given.end(), possible) &&
           (given.empty() || total_of(given) == traffic.came);
}

}  // namespace

UserError damaged_checkpoint(const Scene& scene) {
    return cannot_start(scene, "is damaged; take another checkpoint");
}

// What feeds have given stands there once they have given anything: the loop's account stands before it then.
void write_state(std::ostream& out, std::int64_t step, const Grains& grains, const StepLoop& loop,
                 const std::vector<std::int64_t>& given) {
    write_value(out, step);
    transfer_grains(grains, Writing{out});
    loop.save(out);
    if (total_of(given) > 0) write_vector(out, given);
}

void save_checkpoint(const std::filesystem::path& path, const Scene& scene, const Plan& plan,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop,
                     const std::string& gathered, const std::vector<std::int64_t>& given) {
    std::ostringstream body;
    const std::string kept = scene_to_keep(scene, plan);
    write_vector(body, std::vector<char>(kept.begin(), kept.end()));
    write_value(body, header);
    write_value(body, static_cast<std::uint8_t>(loop.is_fresh() ? 1 : 0));
    write_vector(body, std::vector<char>(gathered.begin(), gathered.end()));
    write_state(body, header.step, grains, loop, given);
    const std::string bytes = body.str();
    const std::uint64_t sum = XXH64(bytes.data(), bytes.size(), 0);

    const std::filesystem::path temporary = path.string() + ".part";
    make_way(temporary);
    std::ofstream file(temporary, std::ios::binary);
    file.write(kName.data(), static_cast<std::streamsize>(kName.size()));
    write_value(file, kVersion);
    write_value(file, sum);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    std::error_code failed;
    if (file) std::filesystem::rename(temporary, path, failed);
    if (!file || failed) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw RunError(fmt::format("{}: the checkpoint cannot be written; is the disk full?", path.string()));
    }
}

bool is_checkpoint(const std::filesystem::path& path) {
    std::ifstream in = read_plain(path);
    std::string name(kName.size(), '\0');
    in.read(name.data(), static_cast<std::streamsize>(name.size()));
    return in && name == kName;
}

bool is_whole_checkpoint(const std::filesystem::path& path) {
    Scene scene;
    scene.start.file = path.string();
    try {
        return !body_of(scene, read_whole(scene)).empty();
    } catch (const UserError&) {
        return false;
    }
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
    if (failed || !in || name != kName || version != kVersion || length > size) return std::nullopt;
    CheckpointLabel label;
    label.scene.resize(length);
    in.read(label.scene.data(), static_cast<std::streamsize>(length));
    CheckpointHeader header;
    in.read(reinterpret_cast<char*>(&header), sizeof header);
    label.step = header.step;
    label.wall_offset = header.wall_offset;
    return in && label.step >= 0 ? std::optional(label) : std::nullopt;
}

CheckpointHeader continue_from_checkpoint(const Scene& scene, const Plan& plan, Grains& grains,
                                          StepLoop& loop, std::string& gathered,
                                          std::vector<std::int64_t>& given, bool may_change) {
    const std::string bytes = read_whole(scene);
    Bytes in(body_of(scene, bytes));
    Saved saved = read_saved(scene, in);
    if (!may_change) check_same_future(saved.scene, scene, plan);
    check_grains_possible(scene, saved.grains);
    check_masses(scene, saved.grains);
    grains = std::move(saved.grains);
    loop.load(in, saved.header.step);
    given.assign(scene.feeds.size(), 0);
    if (in.left() > 0) read_vector(in, given);
    if (!could_be_given(scene, given, loop.traffic())) throw damaged_checkpoint(scene);
    if (!loop.traffic().any()) {
        check_grains_numbered(scene, grains);
        check_grains_match(scene, grains);
    } else {
        check_sizes_match(scene, grains);
    }
    loop.set_fresh(saved.fresh);
    gathered = std::move(saved.gathered);
    if (in.failed() || in.left() > 0 || grains.derivatives.empty() == loop.carries_derivatives())
        throw damaged_checkpoint(scene);
    return saved.header;
}

Grains grains_from_checkpoint(const Scene& scene) {
    const std::string bytes = read_whole(scene);
    Bytes in(body_of(scene, bytes));
    const Saved saved = read_saved(scene, in);
    check_grains_possible(scene, saved.grains);
    Grains grains;
    grains.reserve(saved.grains.size());
    const std::vector<std::int32_t> number = numbers_without_gaps(saved.grains.id);
    for (std::size_t i = 0; i < saved.grains.size(); ++i) {
        const Place& place = saved.grains.place[i];
        const Motion& motion = saved.grains.motion[i];
        const std::int32_t species = saved.grains.species[i];
        // The container starts from rest position and at rest; its grains come along.
        grains.add(number[i], species, place.position - saved.header.wall_offset, place.radius,
                   scene.species[species].density);
        grains.motion.back().velocity = motion.velocity - saved.header.wall_velocity;
        grains.motion.back().spin = motion.spin;
    }
    grains.orientation = saved.grains.orientation;
    return grains;
}

std::vector<KeptContacts> contacts_from_checkpoint(const Scene& scene, const ContactRules& rules,
                                                   const WallParts& walls) {
    const std::string bytes = read_whole(scene);
    Bytes in(body_of(scene, bytes));
    const Saved saved = read_saved(scene, in);
    check_grains_possible(scene, saved.grains);
    std::vector<KeptContacts> kept = read_contacts(in, rules, saved.grains, walls);
    if (in.failed()) throw damaged_checkpoint(scene);
    return kept;
}

}  // namespace grainreel
