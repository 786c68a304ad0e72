// Makes the members of a study, which are its runs: one for each setting (values of the varied keys) and
// seed. Also finds out which settings begin with the same packing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "render/app/study/study.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

constexpr std::size_t most_members_unasked = 10'000;
constexpr std::size_t most_members = 1'000'000;  // about a gigabyte of lists

// A file that the scene names for a mesh: its surface, or the path along which it moves. The study keeps a
// copy.
struct MemberFile {
    std::string key;         // key of the scene, "mesh[0].file"
    std::string from, hash;  // its path, and a hash of its contents
};

struct Member {
    std::size_t setting = 0;      // number of its setting; members that differ in the seed have the same
    std::vector<std::size_t> at;  // for each variation, the index of the value
    std::size_t seed_index = 0;
    std::optional<std::uint64_t> seed;
    Assignments sets;     // keys to set: for the whole study, then by the values, the start file, the seed
    Assignments framing;  // the keys that let the pictures of all members show the same part
    std::vector<MemberFile> files;
    std::string start_file;  // absolute path of the file that it starts from; empty for none
    // Begin of its folder's name: a short description, and a hash of its complete scene without what does not
    // change its numbers (film, title, name, threads) and without its duration. When a study was changed,
    // this hash tells which members are still the same, and which may go on from a shorter run.
    std::string stem;
    double duration = 0;     // s
    std::int64_t steps = 0;  // of the run, planned
    std::string name;        // of its folder: the stem and the duration
};

// Counts the members. Throws UserError when there are more than `most_members_unasked` and `many_are_meant`
// is not set, or more than `most_members`.
std::size_t count_members(const Study& study, bool many_are_meant);

// The setting of that number without its seeds: its place in the grid and its values for keys of the scene.
// From setting to setting the last variation changes fastest.
std::size_t count_settings(const Study& study);
Member setting_of(const Study& study, std::size_t number);

// Makes all members; the seeds of a setting come one after another. Each setting's scene is read, planned,
// and given to `accept`. Throws UserError at the first member that cannot be run, and for two members that
// are the same.
using AcceptSetting = std::function<void(const FilmedScene& scene, const Plan& plan)>;
std::vector<Member> make_members(const Study& study, const AcceptSetting& accept);

// Which members are of the variants with these names, the values of --variant; empty where no name is given.
// Throws UserError where the study has no such variant.
std::vector<bool> members_of_variants(const Study& study, const std::vector<Member>& members,
                                      const std::vector<std::string>& names);
// "slow, fast, very fast".
std::string variant_names(const Variation& variation);

// The setting in words: "drive.g_level = 3, species.nut.diameter = 9 mm"; empty when only seeds are varied.
// without: a variation that is left out.
std::string setting_text(const Study& study, const Member& member, std::optional<std::size_t> without = {});
// The same with the names that charts and pages have: "Γ = 3, d of nut = 9 mm".
std::string shown_setting(const Study& study, const Member& member, std::optional<std::size_t> without = {});
// The setting with the seed.
std::string member_text(const Study& study, const Member& member);

// Finds out which settings of a study begin with the same packing. The cache lets one of them pack for all.
class PackingSharing {
  public:
    // To be called for each setting when it is planned.
    void add_setting(const Scene& scene, const Plan& plan);

    // If some settings share a packing, says how many packings there are. If settings that differ in the
    // drive alone share none, says why. Otherwise the text is empty, for example where fewer than two
    // settings pack.
    std::string text() const;

  private:
    // No more settings than this are looked at, because each takes some milliseconds.
    static constexpr std::size_t kMost = 200;

    std::size_t settings_ = 0, packing_ = 0;  // settings that were looked at, and those of them that pack
    std::set<std::string> packings_;
    // The scenes as text without their drives. Scenes that differ in the drive alone have the same text.
    std::set<std::string> without_drive_;
    bool grows_ = false;  // whether the radii of some setting grow
};

// Looks for measures whose column has no value in any setting of a study.
class EmptyColumns {
  public:
    explicit EmptyColumns(const Study& study) : study_(study), why_(study.measures.size()) {}
    void add_setting(const Scene& scene);
    // Throws UserError at the first such measure.
    void check() const;

  private:
    const Study& study_;
    std::vector<std::string> why_;  // why each measure's column is empty; empty words where it is not
    bool any_ = false;
};

}  // namespace grainreel
