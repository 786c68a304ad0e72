#include "render/app/study/file/members.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>
#include <algorithm>
#include <map>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/reach.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

// Which value of each variation the setting of that number has.
std::vector<std::size_t> place_in_grid(const Study& study, std::size_t setting) {
    std::vector<std::size_t> places(study.variations.size());
    for (std::size_t i = places.size(); i-- > 0;) {
        places[i] = setting % study.variations[i].values.size();
        setting /= study.variations[i].values.size();
    }
    return places;
}

// A hash of everything on which the numbers of a run depend, up to its end.
std::uint64_t hash_of(FilmedScene scene, const Plan& plan, std::optional<std::uint64_t> seed) {
    scene.film = Film();
    scene.title.clear();
    scene.name.clear();
    scene.run.threads = 1;
    if (seed) scene.run.seed = *seed;
    scene.run.duration = 1;
    const std::string text = resolved_scene(scene, plan);
    return XXH64(text.data(), text.size(), 0);
}

std::string stem_of_member(const Study& study, const Member& member, std::uint64_t hash) {
    std::string name;
    for (std::size_t i = 0; i < member.at.size(); ++i)
        name += fmt::format("{}-{}_", name_of(study.variations[i].key),
                            study.variations[i].values[member.at[i]].words);
    if (member.seed) name += fmt::format("seed-{}_", *member.seed);
    return fmt::format("{}_{:016x}", file_name_part(name.substr(0, name.size() - 1)), hash);
}

std::vector<MemberFile> files_of(const Scene& scene) {
    const Scene kept = naming_kept_files(scene);
    std::vector<MemberFile> files;
    const auto add = [&](std::size_t mesh, const char* key, const std::string& from, const std::string& name,
                         const std::string& hash) {
        if (from != name) files.push_back({fmt::format("mesh[{}].{}", mesh, key), from, hash});
    };
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh &mesh = scene.meshes[m], &there = kept.meshes[m];
        add(m, "file", mesh.file, there.file, mesh.hash);
        add(m, "path", mesh.path_file, there.path_file, mesh.path_hash);
    }
    return files;
}

// Throws for two members that are the same run. The error names the first value that is written differently.
[[noreturn]] void fail_for_twins(const Study& study, const Member& one, const Member& other) {
    std::string place = study.file.string();
    for (std::size_t i = other.at.size(); i-- > 0;)
        if (one.at[i] != other.at[i]) place = study.variations[i].values[other.at[i]].place;
    throw UserError("{}: the members {} and {} are the same run; leave one out", place,
                    member_text(study, one), member_text(study, other));
}

// The scene as text, without its drive and all else that has no part in the packing.
std::string text_without_drive(Scene scene) {
    scene.drive = {};
    scene.title.clear();
    scene.film_text.clear();
    scene.output = {};
    scene.run.duration = 1;
    return written_scene(scene);
}

}  // namespace

std::size_t count_members(const Study& study, bool many_are_meant) {
    double count = 1;
    const Variation* longest = nullptr;
    if (!study.has_variants()) count = static_cast<double>(std::max<std::size_t>(1, study.seeds.size()));
    for (const Variation& variation : study.variations) {
        double values = 0;  // number of values; for variants, the number of their members
        for (std::size_t i = 0; i < variation.values.size(); ++i)
            values += variation.key == variant_axis ? static_cast<double>(study.seed_count({i})) : 1;
        count *= values;
        if (longest == nullptr || variation.values.size() > longest->values.size()) longest = &variation;
    }
    const std::size_t limit = many_are_meant ? most_members : most_members_unasked;
    if (count > static_cast<double>(limit))
        throw UserError(
            "{}: the study would have {:.15g} members, more than {}; {}",
            longest != nullptr ? longest->place : study.file.string(), count, limit,
            many_are_meant ? "split it in several" : "vary less, or say --yes when that is meant");
    return static_cast<std::size_t>(count);
}

namespace {

// What the pictures of all settings share, so that they can be compared: the height that they reach, which is
// the highest of all; where their words stand; and how large a length is.
class SharedPictures {
  public:
    void add_setting(const FilmedScene& scene) { scenes_.push_back(scene); }

    // The keys for the pictures of each setting.
    std::vector<Assignments> keys() {
        std::vector<Assignments> all(scenes_.size());
        if (scenes_.size() < 2) return all;
        const Assignments reach = share_reach(), gutters = share_gutters();
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k] = reach;
            all[k].insert(all[k].end(), gutters.begin(), gutters.end());
        }
        if (!gutters.empty()) share_scale(all);
        return all;
    }

  private:
    // None where a setting's camera frames something else.
    Assignments share_reach() {
        double highest = 0;  // m
        for (const FilmedScene& scene : scenes_) {
            const Camera& camera = scene.film.camera;
            const std::optional<double> reach = camera.reach ? camera.reach : estimated_reach(scene);
            if (camera.frame != FramingScope::reach || camera.position || !reach) return {};
            highest = std::max(highest, *reach);
        }
        for (FilmedScene& scene : scenes_) scene.film.camera.reach = highest;
        return {fmt::format("film.camera.reach={:.6g}", highest)};
    }

    // None where the user places the words, and where there are so many settings that it would take seconds.
    Assignments share_gutters() {
        constexpr std::size_t most = 60;
        if (scenes_.size() > most) return {};
        for (const FilmedScene& scene : scenes_)
            if (scene.film.gutters.wanted || scene.film.words == WordPlace::none) return {};
        const FilmGutters gutters = gutters_for_all(scenes_);
        for (FilmedScene& scene : scenes_) scene.film.gutters = gutters;
        return gutter_keys(gutters);
    }

    // Draws all at the scale of the smallest, unless it would be too small to see at the others' scale.
    void share_scale(std::vector<Assignments>& keys) const {
        constexpr double most_unlike = 3, alike = 1.001;  // as panels side by side
        std::vector<double> scales;
        for (const FilmedScene& scene : scenes_) {
            const Film& film = scene.film;
            if (film.words != WordPlace::automatic || film.camera.framed_by_user() || film.camera.moves())
                return;
            scales.push_back(framed_scale(scene, plan_layout(scene)));
        }
        const auto [least, most] = std::minmax_element(scales.begin(), scales.end());
        if (*most > most_unlike * *least || *most < alike * *least) return;
        for (std::size_t k = 0; k < keys.size(); ++k) {
            keys[k].emplace_back("film.words=gutters");
            keys[k].emplace_back(fmt::format("film.camera.zoom={:.6g}", *least / scales[k]));
        }
    }

    std::vector<FilmedScene> scenes_;
};

}  // namespace

std::size_t count_settings(const Study& study) {
    std::size_t settings = 1;
    for (const Variation& variation : study.variations) settings *= variation.values.size();
    return settings;
}

Member setting_of(const Study& study, std::size_t number) {
    Member member;
    member.setting = number;
    member.at = place_in_grid(study, number);
    member.sets = study.sets;
    for (std::size_t i = 0; i < member.at.size(); ++i) {
        const Assignments more = study.variations[i].assignments(member.at[i]);
        member.sets.insert(member.sets.end(), more.begin(), more.end());
    }
    return member;
}

std::vector<Member> make_members(const Study& study, const AcceptSetting& accept) {
    count_members(study, true);  // throws when there are too many
    const std::size_t settings = count_settings(study);
    std::vector<Member> members;
    SharedPictures pictures;
    std::map<std::pair<std::string, double>, std::size_t> known;  // the member with each hash and duration
    for (std::size_t setting = 0; setting < settings; ++setting) {
        Member member = setting_of(study, setting);
        const FilmedScene scene =
            read_filmed_scene_text(study.scene_text, study.scene, member.sets, measurable_in);
        const Plan plan = plan_with_film(scene);
        accept(scene, plan);
        pictures.add_setting(scene);
        // Members read a copy of the scene, and relative paths would count from the folder of the copy.
        if (scene.start.method == Start::Method::file) {
            member.start_file = std::filesystem::absolute(scene.start.file).string();
            member.sets.push_back("start.file=" + grainreel::quoted(member.start_file));
        }
        member.files = files_of(scene);
        const Seeds& seeds = study.seeds_of(member.at);
        for (std::size_t s = 0; s < study.seed_count(member.at); ++s) {
            Member seeded = member;
            seeded.seed_index = s;
            if (!seeds.empty()) {
                seeded.seed = seeds[s];
                seeded.sets.push_back(fmt::format("run.seed={}", *seeded.seed));
            }
            seeded.stem = stem_of_member(study, seeded, hash_of(scene, plan, seeded.seed));
            seeded.duration = scene.run.duration;
            seeded.steps = plan.steps;
            seeded.name = fmt::format("{}_{:.9g}s", seeded.stem, seeded.duration);
            const auto [same, is_new] = known.emplace(
                std::pair(seeded.stem.substr(seeded.stem.rfind('_')), seeded.duration), members.size());
            if (!is_new) fail_for_twins(study, members[same->second], seeded);
            members.push_back(std::move(seeded));
        }
    }
    const std::vector<Assignments> shared = pictures.keys();
    for (Member& member : members) member.framing = shared.at(member.setting);
    return members;
}

namespace {

std::string setting_named(const Study& study, const Member& member, std::optional<std::size_t> without,
                          std::string Variation::*name) {
    std::string text;
    for (std::size_t i = 0; i < member.at.size(); ++i) {
        if (i == without) continue;
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", study.variations[i].*name,
                            study.variations[i].values[member.at[i]].words);
    }
    return text;
}

}  // namespace

std::string variant_names(const Variation& variation) {
    std::vector<std::string> names;
    for (const Variation::Value& value : variation.values) names.push_back(value.words);
    return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<bool> members_of_variants(const Study& study, const std::vector<Member>& members,
                                      const std::vector<std::string>& names) {
    if (names.empty()) return {};
    if (!study.has_variants())
        throw UserError("--variant {}: {} has no [[variant]]; leave it out", names.front(),
                        study.file.string());
    const Variation& variants = study.variations.front();
    std::vector<bool> chosen(variants.values.size());
    for (const std::string& name : names) {
        const auto variant = std::find_if(variants.values.begin(), variants.values.end(),
                                          [&](const Variation::Value& one) { return one.words == name; });
        if (variant == variants.values.end())
            throw UserError("--variant {}: {} has no such variant; there are {}", name, study.file.string(),
                            variant_names(variants));
        chosen[static_cast<std::size_t>(variant - variants.values.begin())] = true;
    }
    std::vector<bool> of_members;
    for (const Member& member : members) of_members.push_back(chosen[member.at.front()]);
    return of_members;
}

std::string setting_text(const Study& study, const Member& member, std::optional<std::size_t> without) {
    return setting_named(study, member, without, &Variation::label);
}

std::string shown_setting(const Study& study, const Member& member, std::optional<std::size_t> without) {
    return setting_named(study, member, without, &Variation::shown);
}

std::string member_text(const Study& study, const Member& member) {
    std::string text = setting_text(study, member);
    if (member.seed) text += fmt::format("{}seed {}", text.empty() ? "" : ", ", *member.seed);
    return text;
}

void EmptyColumns::add_setting(const Scene& scene) {
    for (std::size_t k = 0; k < why_.size(); ++k)
        if (!any_ || !why_[k].empty()) why_[k] = why_column_is_empty(scene, study_.measures[k].column);
    any_ = true;
}

void EmptyColumns::check() const {
    for (std::size_t k = 0; k < why_.size(); ++k)
        if (!why_[k].empty())
            throw UserError("{}: '{}' has no value here: {}; measure another column",
                            study_.measures[k].place, study_.measures[k].column, why_[k]);
}

void PackingSharing::add_setting(const Scene& scene, const Plan& plan) {
    if (settings_ == kMost) return;
    ++settings_;
    if (!scene.start.packs()) return;
    const std::string key = SimulatedBed(scene, plan, 1).packing_key();
    if (key.empty()) return;
    ++packing_;
    packings_.insert(key);
    without_drive_.insert(text_without_drive(scene));
    grows_ = grows_ || scene.start.method == Start::Method::layers;
}

std::string PackingSharing::text() const {
    if (packing_ < 2) return "";
    if (packings_.size() == 1)
        return fmt::format(
            "{} settings begin with the same packing for each seed; it is made once, if it takes longer than "
            "a "
            "second, and found by those that start later",
            packing_);
    if (packings_.size() < packing_)
        return fmt::format(
            "{} settings begin with {} different packings for each seed; each is made once, if it "
            "takes longer than a second, and found by those that start later",
            packing_, packings_.size());
    if (without_drive_.size() == packing_) return "";
    return grows_ ? "settings that differ in the drive share no packing, since radii grow while it moves; "
                    "start.method = \"rain\", with contact.stiffness and run.step given, shares one"
                  : "settings that differ in the drive share no packing, since stiffness and step follow the "
                    "drive; give contact.stiffness and run.step, and one packing serves all";
}

}  // namespace grainreel
