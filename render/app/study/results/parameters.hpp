// What a study ran, in full: each parameter of each setting, and the methods in a paragraph.
#pragma once

#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/app/study/study.hpp"
#include "render/page/facts/methods.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class StudyParameters {
  public:
    // To be called for each setting, in their order.
    void add_setting(const FilmedScene& scene, const Plan& plan);

    // The text of parameters.csv: a row for each key of the scene with all that the plan chose (laws and
    // numbers of all pairs, step, accuracy), without [film]. `value` is what all settings have; where they
    // differ it is empty, and the columns 1, 2, ... have the values of the settings in the order of
    // settings.csv. The first rows name the program, its commit and its compiler.
    std::string table() const;
    // A paragraph for a paper, of the first setting, and what was varied; with its sources.
    Methods methods(const Study& study) const;

  private:
    static constexpr std::size_t kMost = 500;  // settings whose values are listed

    std::vector<std::vector<std::pair<std::string, std::string>>> settings_;
    Methods methods_;  // of the first setting
};

}  // namespace grainreel
