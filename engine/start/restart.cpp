#include "engine/start/restart.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/start/start_file.hpp"

namespace grainreel {

namespace {

UserError cannot_start(const Scene& scene, const std::string& what) {
    return UserError("{}: '{}' {}", scene.where("start.file"), scene.start.file, what);
}

// Opens the checkpoint; its content is still to be checked.
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

// Whether these can be the counts of the feeds: one number for each feed, in all as many grains as have
// come.
bool could_be_given(const Scene& scene, const std::vector<std::int64_t>& given, const Traffic& traffic) {
    const auto possible = [](std::int64_t count) { return count >= 0 && count < std::int64_t{1} << 31; };
    return given.size() == scene.feeds.size() && std::all_of(given.begin(), given.end(), possible) &&
           (given.empty() || total_of(given) == traffic.came);
}

}  // namespace

UserError damaged_checkpoint(const Scene& scene) {
    return cannot_start(scene, "is damaged; take another checkpoint");
}

// The feeds' counts are written only once they have given anything; the loop's state comes before them.
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
    // CheckpointFile::read() and label_of_checkpoint() rely on this order. Another order needs another
    // kVersion (checkpoint_file.cpp).
    std::ostringstream body;
    write_vector(body, std::vector<char>(kept.begin(), kept.end()));
    write_value(body, header);
    write_value(body, static_cast<std::uint8_t>(loop.is_fresh() ? 1 : 0));
    write_vector(body, std::vector<char>(gathered.begin(), gathered.end()));
    write_state(body, header.step, grains, loop, given);
    write_checkpoint_file(path, body.str());
}

Scene continued(Scene scene, const std::filesystem::path& checkpoint) {
    scene.start = {};
    scene.start.method = Start::Method::file;
    scene.start.file = checkpoint.string();
    scene.start.keep_clock = true;
    return scene;
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
        // The new run's container starts at rest in its rest position, so the grains are moved back with
        // it.
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

namespace {

// The tables that only show or record a run, or that say how its grains came to be.
constexpr std::array kDecideNothing = {"film", "output", "start", "grain"};

bool lies_in(std::string_view key, std::string_view table) {
    return key.substr(0, table.size()) == table &&
           (key.size() == table.size() || key[table.size()] == '.' || key[table.size()] == '[');
}

using Value = std::pair<std::string, std::string>;

// The keys and values in a text that the scene's writer made, in its order. It writes one key on a line.
std::vector<Value> values_of(std::string_view text) {
    std::vector<Value> values;
    std::map<std::string, int> elements;
    std::string table;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (line.starts_with("[[") && line.ends_with("]]")) {
            table = line.substr(2, line.size() - 4);
            table += fmt::format("[{}]", elements[table]++);
        } else if (line.starts_with('[') && line.ends_with(']')) {
            table = line.substr(1, line.size() - 2);
        } else if (const auto equal = line.find(" = "); !line.starts_with('#') && equal != line.npos) {
            values.emplace_back(join_path(table, line.substr(0, equal)), line.substr(equal + 3));
        }
    }
    return values;
}

std::vector<Value> deciding_values_of(std::string_view text) {
    std::vector<Value> values = values_of(text);
    std::erase_if(values, [](const Value& value) { return !decides_future(value.first); });
    return values;
}

using Lookup = std::unordered_map<std::string, std::string>;

std::string value_at(const Lookup& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string() : found->second;
}

bool is_chosen(const KeyDifference& difference) {
    const Key* key = find_key(difference.key);
    return key != nullptr && key->often_chosen;
}

// The place where the user wrote a key. The values of a pair may come from [contact], [contact.wall] or the
// pair's own table.
std::string place_of(const Scene& scene, const std::string& key, const std::string& between) {
    const std::string name = name_of(key);
    const auto written = [&](const std::string& path) { return scene.written.contains(path); };
    for (const std::string& rival : rivals_of(key))
        if (const std::string instead = join_path(parent_of(key), rival); written(instead))
            return scene.where(instead);
    if (between.empty()) return scene.where(key);
    const bool in_pairs = std::any_of(scene.written.begin(), scene.written.end(), [&](const auto& entry) {
        return lies_in(entry.first, "contact.pair") && name_of(entry.first) == name;
    });
    const bool of_wall = between.ends_with("\"wall\"]") && written("contact.wall." + name);
    return scene.where(in_pairs ? "contact" : (of_wall ? "contact.wall." : "contact.") + name);
}

// Shortens a value and keeps it on one line, whatever the file holds.
std::string shown(std::string value) {
    constexpr std::size_t kMost = 60;
    if (value.size() > kMost) value = value.substr(0, kMost) + "...";
    for (char& c : value)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return value;
}

std::string others_text(const std::vector<KeyDifference>& differences) {
    constexpr std::size_t kNamed = 3;
    if (differences.size() < 2) return "";
    std::string text = " (different too: ";
    for (std::size_t i = 1; i < std::min(differences.size(), kNamed + 1); ++i)
        text += fmt::format("{}'{}'", i > 1 ? ", " : "", shown(differences[i].key));
    if (differences.size() > kNamed + 1) text += fmt::format(" and {} more", differences.size() - kNamed - 1);
    return text + ")";
}

}  // namespace

bool decides_future(std::string_view key) {
    const Key* known = find_key(key);
    return (known == nullptr || known->decides) &&
           std::none_of(kDecideNothing.begin(), kDecideNothing.end(),
                        [&](const char* table) { return lies_in(key, table); });
}

std::string scene_to_keep(const Scene& scene, const Plan& plan) {
    Scene kept = scene;
    kept.start = {};  // with listed grains, species would have no counts
    return resolved_scene(kept, plan);
}

namespace {

std::vector<KeyDifference> differences_between(const std::vector<Value>& before,
                                               const std::vector<Value>& after) {
    const Lookup old(before.begin(), before.end()), today(after.begin(), after.end());
    std::vector<KeyDifference> differences;
    for (const auto& [key, value] : after)
        if (value_at(old, key) != value) differences.push_back({key, value_at(old, key), value});
    for (const auto& [key, value] : before)
        if (!today.contains(key)) differences.push_back({key, value, ""});
    return differences;
}

}  // namespace

std::vector<KeyDifference> differences_of_table(std::string_view then, std::string_view now,
                                                std::string_view table) {
    std::vector<Value> before = values_of(then), after = values_of(now);
    for (std::vector<Value>* values : {&before, &after})
        std::erase_if(*values, [&](const Value& value) { return !lies_in(value.first, table); });
    return differences_between(before, after);
}

std::vector<KeyDifference> deciding_differences(std::string_view then, std::string_view now) {
    std::vector<KeyDifference> differences =
        differences_between(deciding_values_of(then), deciding_values_of(now));
    std::stable_partition(differences.begin(), differences.end(),
                          [](const auto& d) { return !is_chosen(d); });
    return differences;
}

namespace {

// Whether the user accepted this difference: since the checkpoint the key went from `then`, in one or more
// changes, to `now`.
bool was_accepted(const KeyDifference& difference, std::int64_t step,
                  const std::vector<AcceptedKey>& accepted) {
    const auto later = [&](const AcceptedKey& one) { return one.step > step && one.key == difference.key; };
    const auto first = std::find_if(accepted.begin(), accepted.end(), later);
    const auto last = std::find_if(accepted.rbegin(), accepted.rend(), later);
    return first != accepted.end() && first->then == difference.then && last->now == difference.now;
}

}  // namespace

std::vector<KeyDifference> differences_of_future(const std::string& kept, const std::string& today,
                                                 std::int64_t step,
                                                 const std::vector<AcceptedKey>& accepted) {
    std::vector<KeyDifference> differences = deciding_differences(kept, today);
    std::erase_if(differences,
                  [&](const KeyDifference& difference) { return was_accepted(difference, step, accepted); });
    return differences;
}

void check_same_future(const std::string& kept, const Scene& scene, const Plan& plan) {
    const std::string today = scene_to_keep(scene, plan);
    const std::vector<KeyDifference> differences = differences_of_future(kept, today, 0, {});
    if (differences.empty()) return;
    const auto& [key, then, now] = differences.front();
    const std::vector<Value> values = deciding_values_of(today);
    const std::string between = value_at({values.begin(), values.end()}, parent_of(key) + ".between");
    const char* advice = is_chosen(differences.front())
                             ? "take the scene.toml of that run, which has what its plan chose"
                             : "put back what it was";
    // Where a run is only continued, the scene does not have this key, and the advice would not help.
    const bool by_scene = scene.written.contains("start.keep_clock");
    throw UserError("{}: '{}'{} is {}, but it was {} in the run that '{}' is from{}; {}{}",
                    place_of(scene, key, between), shown(key), between.empty() ? "" : " of " + shown(between),
                    now.empty() ? "not there" : shown(now), then.empty() ? "not there" : shown(then),
                    scene.start.file, others_text(differences), advice,
                    by_scene ? ", or set start.keep_clock = false to start anew from its grains" : "");
}

}  // namespace grainreel
