// What a study ran, in full: each parameter of each setting, and the methods in a paragraph.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/app/study/results/results.hpp"
#include "render/app/study/study.hpp"
#include "render/page/facts/methods.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class StudyParameters {
  public:
    // To be called for each setting, in their order.
    void add_setting(const FilmedScene& scene, const Plan& plan);

    // The text of parameters.csv, "key,unit,value,1,2,3,...,meaning". The columns 1, 2, ... are the settings
    // in the order of settings.csv. The first rows have the settings' names, what was varied and the seeds;
    // the next ones name the program, its commit and its compiler. Then comes a row for each key of the scene
    // with all that the plan chose (laws and numbers of all pairs, step, accuracy), without [film]. `value`
    // is what all settings have; where they differ it is empty. members and results: of the study, for how
    // long each bed settled; empty where nothing has run.
    std::string table(const Study& study, const std::vector<Member>& members = {},
                      const std::vector<MemberResult>& results = {}) const;
    // A paragraph for a paper, of the first setting, and what was varied; with its sources.
    // stiffness: what was told of it, see share_stiffness(); may be empty.
    Methods methods(const Study& study, const std::string& stiffness = "") const;

  private:
    static constexpr std::size_t kMost = 500;  // settings whose values are listed

    std::vector<std::vector<std::pair<std::string, std::string>>> settings_;
    std::optional<std::pair<FilmedScene, Plan>> first_;  // setting
};

}  // namespace grainreel
