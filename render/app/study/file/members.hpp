// The members of a study: its runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/app/study/study.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

constexpr std::size_t most_members_unasked = 10'000;
constexpr std::size_t most_members = 1'000'000;  // about a gigabyte of lists

// A file of a mesh or of a path, which the study keeps.
struct MemberFile {
    std::string key;         // of the scene, "mesh[0].file"
    std::string from, hash;  // where it is, and what is in it
};

struct Member {
    std::size_t setting = 0;      // of the grid; all its seeds have it
    std::vector<std::size_t> at;  // of each variation, which value
    std::size_t seed_index = 0;
    std::optional<std::uint64_t> seed;
    Assignments sets;  // the study's, the values, where it starts from, the seed
    std::vector<MemberFile> files;
    // Name of its folder: what it is in short, and a hash of its scene with every value as resolved, so that
    // a study that has changed finds the members that have not. The film is left out.
    std::string name;
};

// How many there are. Throws UserError when there are more than `most_members_unasked` and `many_are_meant`
// is not set, or more than `most_members`.
std::size_t count_members(const Study& study, bool many_are_meant);

// All of them, the seeds of a setting one after another. Each setting's scene is read and planned, and given
// to `accept`. Throws UserError at the first that cannot be run, and for two that are the same.
using AcceptSetting = std::function<void(const FilmedScene& scene, const Plan& plan)>;
std::vector<Member> make_members(const Study& study, const AcceptSetting& accept);

// "drive.g_level = 3, species.nut.diameter = 9 mm"; empty where nothing but seeds is varied. `without`: a
// variation that is left out.
std::string setting_text(const Study& study, const Member& member, std::optional<std::size_t> without = {});
// That with the seed.
std::string member_text(const Study& study, const Member& member);

}  // namespace grainreel
