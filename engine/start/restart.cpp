#include "engine/start/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"
#include "engine/start/continuation.hpp"
#include "engine/start/start_file.hpp"

namespace grainreel {

namespace {

UserError cannot_start(const Scene& scene, const std::string& what) {
    return UserError(fmt::format("{}: '{}' {}", scene.where("start.file"), scene.start.file, what));
}

// Nothing in it is believed yet.
CheckpointFile read_saved(const Scene& scene) {
    CheckpointFile file(scene.start.file);
    switch (file.fault()) {
        case CheckpointFile::Fault::unreadable:
            throw cannot_start(scene,
                               "cannot be read; give the checkpoint.grs or final.csv of an earlier run");
        case CheckpointFile::Fault::other_version:
            throw cannot_start(
                scene, "is a checkpoint of another version of grainreel; give the final.csv beside it");
        case CheckpointFile::Fault::damaged:
            throw damaged_checkpoint(scene);
        case CheckpointFile::Fault::none:
            break;
    }
    return file;
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
    write_grains(out, grains);
    loop.save(out);
    if (total_of(given) > 0) write_vector(out, given);
}

void save_checkpoint(const std::filesystem::path& path, const Scene& scene, const Plan& plan,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop,
                     const std::string& gathered, const std::vector<std::int64_t>& given) {
    save_checkpoint(path, scene_to_keep(scene, plan), header, grains, loop, gathered, given);
}

void save_checkpoint(const std::filesystem::path& path, const std::string& kept,
                     const CheckpointHeader& header, const Grains& grains, const StepLoop& loop,
                     const std::string& gathered, const std::vector<std::int64_t>& given) {
    std::ostringstream body;
    write_vector(body, std::vector<char>(kept.begin(), kept.end()));
    write_value(body, header);
    write_value(body, static_cast<std::uint8_t>(loop.is_fresh() ? 1 : 0));
    write_vector(body, std::vector<char>(gathered.begin(), gathered.end()));
    write_state(body, header.step, grains, loop, given);
    write_checkpoint_file(path, body.str());
}

CheckpointHeader continue_from_checkpoint(const Scene& scene, const Plan& plan, Grains& grains,
                                          StepLoop& loop, std::string& gathered,
                                          std::vector<std::int64_t>& given, bool may_change) {
    CheckpointFile saved = read_saved(scene);
    Bytes in(saved.rest());
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
    const CheckpointFile saved = read_saved(scene);
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
    const CheckpointFile saved = read_saved(scene);
    Bytes in(saved.rest());
    check_grains_possible(scene, saved.grains);
    std::vector<KeptContacts> kept = read_contacts(in, rules, saved.grains, walls);
    if (in.failed()) throw damaged_checkpoint(scene);
    return kept;
}

}  // namespace grainreel
