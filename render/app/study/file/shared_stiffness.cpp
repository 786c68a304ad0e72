#include "render/app/study/file/shared_stiffness.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/app/study/file/members.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// The stiffness of one kind of contact in all settings.
struct KindOfContact {
    std::pair<std::string, std::string> between;  // names of species, a mesh or "wall"
    bool hertz = false;
    bool chosen = true;  // by the plan, in all settings
    double least = 0, most = 0;
    std::size_t stiffest = 0;  // number of the setting
    std::size_t settings = 0;  // in so many it is there
};

class KindsOfContact {
  public:
    void add_setting(const Scene& scene, const Plan& plan) {
        const std::size_t count = scene.species.size();
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = a; b < count; ++b)
                add({scene.species[a].name, scene.species[b].name}, scene.between(a, b), plan.between(a, b));
            add({scene.species[a].name, "wall"}, scene.contact.wall[a], plan.wall[a]);
        }
        for (std::size_t k = 0; k < scene.contact.mesh.size(); ++k)
            add({scene.species[k % count].name, scene.meshes[k / count].name}, scene.contact.mesh[k],
                plan.mesh[k]);
        ++settings_;
    }

    // The kind whose stiffness differs most; null where none does.
    const KindOfContact* most_different() const {
        const KindOfContact* worst = nullptr;
        for (const KindOfContact& kind : kinds_)
            if (differs(kind) && (worst == nullptr || kind.most / kind.least > worst->most / worst->least))
                worst = &kind;
        return worst;
    }

    std::string pairs() const {
        std::string text = "\n# The study gives all its members the stiffness of the stiffest.\n";
        for (const KindOfContact& kind : kinds_)
            if (differs(kind))
                text +=
                    fmt::format("[[contact.pair]]\nbetween = [{}, {}]\n{} = {}\n", quoted(kind.between.first),
                                quoted(kind.between.second), kind.hertz ? "modulus" : "stiffness", kind.most);
        return text;
    }

  private:
    // A kind of contact that some settings lack, because they have other species, stays as it is.
    bool differs(const KindOfContact& kind) const {
        return kind.chosen && kind.settings == settings_ && kind.most > kind.least * (1 + 1e-9);
    }

    void add(const std::pair<std::string, std::string>& names, const PairContact& contact,
             const PairPlan& plan) {
        const bool hertz = contact.normal == NormalLaw::hertz;
        const double stiffness = hertz ? plan.modulus : plan.loading_stiffness;
        const auto same = [&](const KindOfContact& kind) { return kind.between == names; };
        auto kind = std::find_if(kinds_.begin(), kinds_.end(), same);
        if (kind == kinds_.end())
            kind = kinds_.insert(kinds_.end(), {names, hertz, true, stiffness, stiffness, settings_, 0});
        kind->chosen = kind->chosen && !contact.stiffness && hertz == kind->hertz;
        kind->least = std::min(kind->least, stiffness);
        if (stiffness > kind->most) kind->most = stiffness, kind->stiffest = settings_;
        ++kind->settings;
    }

    std::vector<KindOfContact> kinds_;
    std::size_t settings_ = 0;
};

bool decides_stiffness(const std::string& key) {
    for (const std::string_view name : {"stiffness", "modulus", "law", "glued_stiffness", "glued_modulus"})
        if (key.starts_with("contact.") && name_of(key) == name) return true;
    return key == "run.overlap" || key == "run.accuracy";
}

// A key that the study varies and that decides the stiffness by itself.
std::optional<std::string> deciding_key(const Study& study) {
    for (const Variation& variation : study.variations) {
        if (decides_stiffness(variation.key)) return variation.key;
        for (const Variation::Value& value : variation.values)
            for (const Assignment& set : value.sets)
                if (decides_stiffness(set.key())) return set.key();
    }
    return std::nullopt;
}

FilmedScene scene_of(const Study& study, const Member& setting) {
    return read_filmed_scene_text(study.scene_text, study.scene, setting.sets, measurable_in);
}

// Whether the scene's text can be continued by such tables; not if it writes its pairs as a list of values.
bool takes_pairs(const Study& study, const std::string& pairs) {
    Study other = study;
    other.scene_text += pairs;
    try {
        scene_of(other, setting_of(other, 0));
        return true;
    } catch (const UserError&) {
        return false;
    }
}

std::string number_text(const KindOfContact& kind, double value) {
    if (kind.hertz || value < 1 || value > 1e9)
        return fmt::format("{:.4g} {}", value, kind.hertz ? "Pa" : "N/m");
    const double digit = std::pow(10, std::max(0.0, std::floor(std::log10(value)) - 3));  // four of them
    return fmt::format("{:.0f} N/m", std::round(value / digit) * digit);
}

}  // namespace

std::string share_stiffness(Study& study) {
    KindsOfContact kinds;
    const std::size_t settings = count_settings(study);
    for (std::size_t number = 0; number < settings && settings > 1; ++number) {
        const FilmedScene scene = scene_of(study, setting_of(study, number));
        kinds.add_setting(scene, plan_with_film(scene));
    }
    const KindOfContact* kind = kinds.most_different();
    if (kind == nullptr) return "";
    const std::string range =
        fmt::format("{} to {}", number_text(*kind, kind->least), number_text(*kind, kind->most));
    const std::string between = fmt::format("between {} and {}", kind->between.first, kind->between.second);
    const std::string unshared = range + " " + between;
    if (const auto key = deciding_key(study))
        return fmt::format("differs from member to member, since the study varies {}: {}", *key, unshared);
    if (!study.one_stiffness)
        return fmt::format("differs from member to member, as the study asks by stiffness = \"own\": {}",
                           unshared);
    const std::string pairs = kinds.pairs();
    if (!takes_pairs(study, pairs))
        return fmt::format(
            "differs from member to member: {}; give contact.stiffness, and all are of one material",
            unshared);
    const std::string stiffest = shown_setting(study, setting_of(study, kind->stiffest));
    study.scene_text += pairs;
    return fmt::format("{} {} in all members, that of {}; each by itself would have {}",
                       number_text(*kind, kind->most), between, stiffest, range);
}

}  // namespace grainreel
